// SPDX-License-Identifier: BSD-3-Clause
// Canned cycles expanded to commands (Haas manual 96-8210, "Canned Cycles"); the geometry of all
// drilling cycles exists once.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sim/control/command.h"

namespace ncsim::control {

/// Modal words of an active cycle, absolute program coordinates where they are positions; mm, s.
struct CycleWords {
  int code = 0;                      ///< 73, 74, 76, 77, 81 ... 89.
  double r = 0.0;                    ///< R plane along the plane's normal axis.
  double z = 0.0;                    ///< Hole bottom.
  std::optional<double> q, i, j, k;  ///< Pecks, shifts: magnitudes.
  double dwell = 0.0;                ///< P.
  bool return_to_initial = true;     ///< G98.
  double retract_feed_factor = 1.0;  ///< J of G74/G84.
};

struct CycleSettings {
  double setting22 = 0.0;  ///< G73 retract and G83 re-approach gap, mm.
  double setting52 = 0.0;  ///< G83 retract above R, mm.
  int setting27 = 0;       ///< G76/G77 shift direction: 0 X+, 1 X-, 2 Y+, 3 Y-.
};

/// One hole. `prototype` carries frame, plane, feed, spindle and source; `position` is the program
/// position before the hole; `hole` the in-plane target. Commands go to `out` in order; returns the
/// program position after it, or nullopt with `error` (a control alarm, in words: "G83 with Q and
/// I").
std::optional<AxisValues> ExpandCycle(const CycleWords& words, const CycleSettings& settings,
                                      const Command& prototype, const AxisValues& position,
                                      const AxisValues& hole, double initial_level,
                                      const std::function<void(const Command&)>& out,
                                      std::string* error);

}  // namespace ncsim::control
