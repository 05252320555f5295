// SPDX-License-Identifier: BSD-3-Clause
// Hole positions of G70 (bolt circle), G71 (arc) and G72 (line): Haas NGC Mill Operator's Manual
// 2017, G70-G72, F7.20.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/control/command.h"

namespace ncsim::control {

struct PatternWords {
  int code = 0;           ///< 70, 71 or 72.
  double distance = 0.0;  ///< I: radius of the circle, or distance between holes (G72); mm, > 0.
  double angle =
      0.0;  ///< J: first hole, or direction of the line; rad, from the plane's first axis.
  std::optional<double> spacing;  ///< K of G71: rad, signed.
  double count = 0.0;             ///< L: as programmed.
};

/// Programs say tens of holes; beyond this the word is a mistake.
inline constexpr int kMaxPatternHoles = 10'000;

/// The holes in order: `at` (program coordinates; the centre of the circle, or the first hole of
/// G72) moved in the plane. nullopt with `error` (a control alarm, in words).
std::optional<std::vector<AxisValues>> HolePattern(const PatternWords& words, Plane plane,
                                                   const AxisValues& at, std::string* error);

}  // namespace ncsim::control
