// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/hole_patterns.h"

#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/hole_moves.h"

namespace ncsim::control {

std::optional<std::vector<AxisValues>> HolePattern(const PatternWords& words, Plane plane,
                                                   const AxisValues& at, std::string* error) {
  const std::string name = "G" + std::to_string(words.code);
  if (!(words.distance > 0.0)) {
    *error = name + " needs I greater than 0";
    return std::nullopt;
  }
  if (!(words.count >= 1.0 && words.count <= kMaxPatternHoles) ||
      words.count != std::floor(words.count)) {
    *error = name + " needs L, a whole number of holes from 1 to " +
             std::to_string(kMaxPatternHoles) + ", not " + Short(words.count);
    return std::nullopt;
  }
  if (words.code == 71 && !words.spacing) {
    *error = "G71 needs K, the angle between holes";
    return std::nullopt;
  }
  const int count = static_cast<int>(words.count);
  if (words.code == 72) return HolesOnLine(at, plane, words.distance, words.angle, count);
  const double step = words.code == 70 ? 2.0 * kPi / count : words.spacing.value_or(0.0);
  return HolesOnArc(at, plane, words.distance, words.angle, step, count);
}

}  // namespace ncsim::control
