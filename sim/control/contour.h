// SPDX-License-Identifier: BSD-3-Clause
// The contour stage: what must wait for the next moves. Corner rounding and chamfers (,R ,C;
// corner.h) and cutter compensation (G40-G42; cutter_comp.h). Commands in, commands out, in program
// coordinates.
#pragma once

#include <functional>
#include <memory>

#include "sim/base/finding.h"
#include "sim/control/command.h"
#include "sim/control/corner.h"

namespace ncsim::control {

struct ContourOptions {
  bool type_b = false;        ///< Setting 43.
  bool fanuc_corners = true;  ///< Setting 58: FANUC (true) or YASNAC.
  double least_arc_feed =
      1.0;                ///< Setting 44 / 100: how far the feed falls in a compensated inside arc.
  bool long_lead = true;  ///< What turns compensation on and off is as long as the radius.
  CornerNames corner_names;
};

class Contour {
 public:
  using Out = std::function<void(const Command&)>;
  using Report = std::function<void(Finding)>;
  /// `corner_report`: what cannot be cut at a corner; empty: as `report`.
  Contour(const ContourOptions& options, Out out, const Report& report,
          const Report& corner_report = {});
  ~Contour();

  /// `start` is the program position before the first command; later ones are chained, except after
  /// a command in machine coordinates (kMachineRapid, kMachineFeed, kToolChange), which
  /// SetPosition() must follow.
  void SetPosition(const AxisValues& start);
  /// Passes `command` on at once when nothing waits and no compensation is active.
  void Push(const Command& command);
  /// Sends on all that waits (macro read of a position, tool change, frame change). A compensated
  /// path cannot be joined over it: `unsupported-code` where that matters.
  void Flush();
  /// M00, M01, M02 or M30 at `where`: Flush, and a control-alarm if compensation is still
  /// `commanded` (G41 or G42 in force).
  void Stop(const SourcePosition& where, bool commanded);
  /// Whether compensation looks for bottlenecks beyond the corner of two moves; it does at first.
  void LookAhead(bool on);
  /// Where the tool is after Flush(), in program coordinates: beside the programmed position while
  /// compensation is active.
  AxisValues position() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::control
