// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/translation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace ncsim::motion {
namespace {

bool Turns(const Motion& motion, const kinematics::RelativePath& path) {
  const std::vector<int>& joints = path.joint_indices();
  for (std::size_t k = 0; k < joints.size(); ++k) {
    if (path.revolute(k) && motion.q0()[joints[k]] != motion.q1()[joints[k]]) return true;
  }
  return false;
}

/// All the way at once.
Translation Straight(const Motion& motion, const kinematics::RelativePath& path) {
  Translation result;
  result.X_BA = path.Pose(motion.q0());
  result.way = path.Pose(motion.q1()).translation() - result.X_BA.translation();
  return result;
}

/// Each axis at its own time: the longest way is the straight one, and the others together lead no
/// further from it than they go.
Translation InTurn(const DogLeg& dog_leg, const kinematics::RelativePath& path) {
  Translation result;
  result.X_BA = path.Pose(dog_leg.q0);
  JointVector longest_only = dog_leg.q0;
  double longest = 0.0;
  double sum = 0.0;
  for (const int joint : path.joint_indices()) {
    const double way = std::abs(dog_leg.q1[joint] - dog_leg.q0[joint]);
    sum += way;
    if (way <= longest) continue;
    longest = way;
    longest_only = dog_leg.q0;
    longest_only[joint] = dog_leg.q1[joint];
  }
  result.way = path.Pose(longest_only).translation() - result.X_BA.translation();
  result.astray = sum - longest;
  return result;
}

/// With the rotary axes at rest the linear ones go in proportion, but for the rounding of what the
/// control computes.
std::optional<Translation> AlongLine(const Motion& motion, const TcpCurve& curve,
                                     const kinematics::RelativePath& path) {
  constexpr double kRounding = 1e-8;
  if (curve.arc) return std::nullopt;
  for (const int joint : curve.frame->control.rotary()) {
    if (curve.q0[joint] != curve.q1[joint]) return std::nullopt;
  }
  Translation result = Straight(motion, path);
  result.astray = kRounding;
  return result;
}

}  // namespace

bool IsStraight(const Motion& motion, const kinematics::RelativePath& path) {
  if (Turns(motion, path)) return false;
  if (std::holds_alternative<AxisLinear>(motion.path)) return true;
  const auto* dog_leg = std::get_if<DogLeg>(&motion.path);
  if (dog_leg == nullptr) return false;
  // Each joint has gone some part of its way: with all at that of the longest one A would be on the
  // straight way, and the others lead off that by no more than they go.
  double longest = 0.0;
  double sum = 0.0;
  for (const int joint : path.joint_indices()) {
    const double way = std::abs(dog_leg->q1[joint] - dog_leg->q0[joint]);
    longest = std::max(longest, way);
    sum += way;
  }
  return sum - longest <= kStraight;
}

std::optional<Translation> TranslationOf(const Motion& motion, const PairPath& pair) {
  if (Turns(motion, pair.path)) return std::nullopt;
  if (std::holds_alternative<AxisLinear>(motion.path)) return Straight(motion, pair.path);
  if (const auto* dog_leg = std::get_if<DogLeg>(&motion.path)) return InTurn(*dog_leg, pair.path);
  const auto* curve = std::get_if<TcpCurve>(&motion.path);
  return curve != nullptr ? AlongLine(motion, *curve, pair.path) : std::nullopt;
}

}  // namespace ncsim::motion
