// SPDX-License-Identifier: BSD-3-Clause
// The path between two links of a tree, with everything that is fixed folded together.
#pragma once

#include <vector>

#include "kinematics/tree.h"

namespace ncsim::kinematics {

/// One moving joint of a Chain. A joint between B and the common ancestor is met from its child's
/// side: its axis is reversed, so that the joint's value keeps its sign.
struct ChainStep {
  int index = 0;  ///< Into JointVector.
  bool revolute = false;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< Unit; J turns about it (through the origin)
                                                    ///< or slides along it.
  Eigen::Isometry3d X_after =
      Eigen::Isometry3d::Identity();  ///< What is fixed between this joint and the next.

  /// J(position) y.
  Eigen::Vector3d Apply(double position, const Eigen::Vector3d& y) const;
};

/// X_BA(q) = X_before J_1(q_1) X_after_1 J_2(q_2) ... J_n(q_n) X_after_n, joint 1 next to B. What
/// both links hang on is left out.
class Chain {
 public:
  Chain(const KinematicTree& tree, int link_b, int link_a);

  const Eigen::Isometry3d& X_before() const { return X_before_; }
  const std::vector<ChainStep>& steps() const { return steps_; }
  /// X_BA(q).
  Eigen::Isometry3d Pose(const JointVector& q) const;

 private:
  Eigen::Isometry3d X_before_ = Eigen::Isometry3d::Identity();
  std::vector<ChainStep> steps_;
};

/// `v` turned by `angle` (rad, right-handed) about the unit vector `axis`.
Eigen::Vector3d Turn(const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& v);
/// The same, of the angle's cosine and sine.
inline Eigen::Vector3d Turn(const Eigen::Vector3d& axis, double cosine, double sine,
                            const Eigen::Vector3d& v) {
  return cosine * v + sine * axis.cross(v) + (1.0 - cosine) * axis.dot(v) * axis;
}

}  // namespace ncsim::kinematics
