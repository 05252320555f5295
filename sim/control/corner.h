// SPDX-License-Identifier: BSD-3-Clause
// ,R and ,C between two G01 blocks (Haas NGC Mill Operator's Manual 2017, G01 "Corner Rounding and
// Chamfering"); RND=, CHR= and CHF= of the SINUMERIK.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/base/finding.h"
#include "sim/control/command.h"

namespace ncsim::control {

/// How a control writes corners, for messages.
struct CornerNames {
  std::string_view round = ",R", chamfer = ",C", chamfer_length = "CHF=";
};

/// Commands in, commands out, in program coordinates: a G01 with ,R or ,C waits for the G01 that
/// ends the corner (a dwell may stand between), is shortened, and an arc or a line is put in. What
/// the manual forbids is a control-alarm, and the corner is then left sharp.
class CornerStage {
 public:
  using Out = std::function<void(const Command&)>;
  using Report = std::function<void(Finding)>;
  CornerStage(Out out, Report report, const CornerNames& names = {});

  bool waiting() const { return first_.has_value(); }
  void SetPosition(const AxisValues& start) { position_ = start; }
  void Push(const Command& command);
  void Flush();

 private:
  bool Insert(Command* second);
  bool Alarm(const std::string& why);
  void Hold(const Command& command);
  void Send();

  const CornerNames names_;
  Out out_;
  Report report_;
  AxisValues position_{};         ///< Programmed end of the last command.
  AxisValues start_{};            ///< Where first_ starts: its own corner may have moved it.
  std::optional<Command> first_;  ///< The G01 with ,R or ,C.
  std::vector<Command> dwells_;   ///< Between the two.
};

}  // namespace ncsim::control
