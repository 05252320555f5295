// SPDX-License-Identifier: BSD-3-Clause
// Motions that turn nothing.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "sim/motion/motion.h"

namespace ncsim::motion {

/// Body A seen from B, whatever the lag: turns nothing, and is at every pose within `astray` of
/// some point of the straight way from `X_BA`, its pose at q0, by `way`; mm, in B's frame.
struct Translation {
  Eigen::Isometry3d X_BA = Eigen::Isometry3d::Identity();
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  double astray = 0.0;
};

/// Does no joint of the path turn, and is A at every pose within kStraight of the straight way from
/// q0 to q1: all joints in proportion, or one almost alone?
inline constexpr double kStraight = 1e-3;  // mm: what is left by a post that writes four digits
bool IsStraight(const Motion& motion, const kinematics::RelativePath& path);

/// nullopt where a joint between the two bodies turns, and for curves.
std::optional<Translation> TranslationOf(const Motion& motion, const PairPath& pair);

}  // namespace ncsim::motion
