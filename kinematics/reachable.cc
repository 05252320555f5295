// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/reachable.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ncsim::kinematics {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

constexpr double kLimitTolerance = 1e-9;  // rad

/// `angle` and whole turns, as near to `from` as the limits let it; nullopt where they let none.
std::optional<double> Nearest(double angle, double from, double lower, double upper) {
  const double first = std::ceil((lower - kLimitTolerance - angle) / kWholeTurn);
  const double last = std::floor((upper + kLimitTolerance - angle) / kWholeTurn);
  if (!(first <= last)) return std::nullopt;
  return angle + kWholeTurn * std::clamp(std::round((from - angle) / kWholeTurn), first, last);
}

}  // namespace

std::vector<RotarySolution> ReachableRotary(const FiveAxis& five_axis, const Eigen::Vector3d& u_B,
                                            const std::array<double, 2>& from,
                                            const RotaryLimits& limits) {
  const std::size_t count = five_axis.rotary().size();
  std::vector<RotarySolution> reachable;
  for (const RotarySolution& solution : five_axis.SolveRotary(u_B)) {
    RotarySolution found = solution;
    bool within = true;
    for (std::size_t k = 0; k < count; ++k) {
      // Of two joints the second is the free one.
      const bool free = solution.at_pole && k + 1 == count;
      const std::optional<double> angle =
          free ? std::clamp(from[k], limits.lower[k], limits.upper[k])
               : Nearest(solution.angles[k], from[k], limits.lower[k], limits.upper[k]);
      within = within && angle.has_value();
      found.angles[k] = angle.value_or(0.0);
    }
    if (within) reachable.push_back(found);
  }
  const auto distance = [&](const RotarySolution& solution) {
    double squares = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      squares += (solution.angles[k] - from[k]) * (solution.angles[k] - from[k]);
    }
    return squares;
  };
  std::stable_sort(
      reachable.begin(), reachable.end(),
      [&](const RotarySolution& a, const RotarySolution& b) { return distance(a) < distance(b); });
  return reachable;
}

}  // namespace ncsim::kinematics
