// SPDX-License-Identifier: BSD-3-Clause
// What a SINUMERIK keeps: settable frames ($P_UIFR) and the edges of tools ($TC_DP). mm, rad.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/control/sinumerik_frame.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/tool.h"

namespace ncsim::control {

/// G500, G54 ... G57, G505 ... G599: indices 0 ... 99 of $P_UIFR.
inline constexpr int kNumSettableFrames = 100;

struct EdgeData {
  double length = 0.0;  ///< $TC_DP3 + $TC_DP12.
  double radius = 0.0;  ///< $TC_DP6 + $TC_DP15.
};

class SinumerikRegisters {
 public:
  SinumerikRegisters(const machine::Machine& machine, const machine::Job& job,
                     const machine::ToolTable& tools);

  static std::string FrameName(int index);
  const SettableFrame& frame(int index) const { return frames_[static_cast<std::size_t>(index)]; }
  SettableFrame* MutableFrame(int index) { return &frames_[static_cast<std::size_t>(index)]; }

  /// Null: the tool has no such edge. D0 is an edge of zeros.
  std::optional<EdgeData> Edge(int tool, int edge) const;
  /// $TC_DPn[tool, edge], mm; 0 where nobody has set it.
  double Parameter(int number, int tool, int edge) const;
  void SetParameter(int number, int tool, int edge, double value);

 private:
  std::array<SettableFrame, kNumSettableFrames> frames_;
  std::map<std::pair<int, int>, std::map<int, double>> edges_;  ///< (tool, edge) -> $TC_DPn.
};

}  // namespace ncsim::control
