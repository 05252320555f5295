// SPDX-License-Identifier: BSD-3-Clause
// From a tool axis in the part to rotary positions that a machine can take from where it stands.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "kinematics/five_axis.h"

namespace ncsim::kinematics {

/// Where the two rotary joints may stand, rad, in FiveAxis::rotary() order; endless by default.
struct RotaryLimits {
  std::array<double, 2> lower{-std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};
  std::array<double, 2> upper{std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};
};

/// The positions within the limits that turn the tool axis to `u_B` (unit): of each branch (each
/// of FiveAxis::SolveRotary's solutions) the one that is nearest to `from`, each joint by itself
/// and by whole turns; a joint that is free at the pole keeps its value. The branch that is nearer
/// comes first (by the root of the sum of squares of the turns; of equals, SolveRotary's first).
/// Empty where u_B cannot be reached. Angles are not folded. Limits hold to 1e-9 rad.
std::vector<RotarySolution> ReachableRotary(const FiveAxis& five_axis, const Eigen::Vector3d& u_B,
                                            const std::array<double, 2>& from,
                                            const RotaryLimits& limits);

}  // namespace ncsim::kinematics
