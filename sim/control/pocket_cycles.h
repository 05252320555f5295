// SPDX-License-Identifier: BSD-3-Clause
// Circular pockets G12 and G13 (Haas NGC Mill Operator's Manual 2017, "G12 Circular Pocket Milling
// CW / G13 ... CCW").
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sim/control/command.h"

namespace ncsim::control {

/// Words of one pass in depth, mm. G91 with L repeats the pass: the caller steps `depth`.
struct CircularPocketWords {
  bool clockwise = false;          ///< G12.
  double first_radius = 0.0;       ///< I.
  std::optional<double> radius;    ///< K: finished radius.
  std::optional<double> stepover;  ///< Q: with K only.
  double tool_radius = 0.0;        ///< Of the D register: geometry + wear; 0 for D0.
  double depth = 0.0;              ///< Z at the bottom, absolute.
};

/// Feeds from `position` (the centre) down to the depth, goes out on a half circle, mills a full
/// circle for each radius (I, I + Q ... K, less the tool radius) joined by half circles, and comes
/// back to the centre on a half circle. The manual pictures the path without dimensions; all of it
/// lies inside the finished circle. `prototype` carries frame, feed, spindle and source. Always in
/// XY. Returns the position at the end, or nullopt with `error` (a control alarm).
std::optional<AxisValues> ExpandCircularPocket(const CircularPocketWords& words,
                                               const Command& prototype, const AxisValues& position,
                                               const std::function<void(const Command&)>& out,
                                               std::string* error);

}  // namespace ncsim::control
