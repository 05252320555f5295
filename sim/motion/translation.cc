// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/translation.h"

#include <algorithm>
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
  return {path.Pose(motion.q1()).translation() - path.Pose(motion.q0()).translation(), 0.0};
}

/// Each axis at its own time: the longest way is the straight one, and the others together lead no
/// further from it than they go.
Translation InTurn(const DogLeg& dog_leg, const kinematics::RelativePath& path) {
  const Eigen::Vector3d start = path.Pose(dog_leg.q0).translation();
  Translation result;
  double longest = 0.0;
  double sum = 0.0;
  for (const int joint : path.joint_indices()) {
    if (dog_leg.q0[joint] == dog_leg.q1[joint]) continue;
    JointVector q = dog_leg.q0;
    q[joint] = dog_leg.q1[joint];
    const Eigen::Vector3d way = path.Pose(q).translation() - start;
    sum += way.norm();
    if (way.norm() <= longest) continue;
    longest = way.norm();
    result.way = way;
  }
  result.astray = std::max(0.0, sum - longest);
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

std::optional<Translation> TranslationOf(const Motion& motion, const PairPath& pair) {
  if (Turns(motion, pair.path)) return std::nullopt;
  if (std::holds_alternative<AxisLinear>(motion.path)) return Straight(motion, pair.path);
  if (const auto* dog_leg = std::get_if<DogLeg>(&motion.path)) return InTurn(*dog_leg, pair.path);
  const auto* curve = std::get_if<TcpCurve>(&motion.path);
  return curve != nullptr ? AlongLine(motion, *curve, pair.path) : std::nullopt;
}

}  // namespace ncsim::motion
