// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/chain.h"

#include <algorithm>
#include <cmath>

namespace ncsim::kinematics {
namespace {

/// Joints (indices into tree.joints()) from `link` up to the root, nearest first; fixed ones too.
std::vector<int> JointsToRoot(const KinematicTree& tree, int link) {
  std::vector<int> joints;
  for (int joint = tree.links()[link].parent_joint; joint >= 0;
       joint = tree.links()[tree.joints()[joint].parent_link].parent_joint) {
    joints.push_back(joint);
  }
  return joints;
}

}  // namespace

Eigen::Vector3d Turn(const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& v) {
  return Turn(axis, std::cos(angle), std::sin(angle), v);
}

Eigen::Vector3d ChainStep::Apply(double position, const Eigen::Vector3d& y) const {
  if (revolute) return Turn(axis, position, y);
  return y + position * axis;
}

Chain::Chain(const KinematicTree& tree, int link_b, int link_a) {
  std::vector<int> up = JointsToRoot(tree, link_b);
  std::vector<int> down = JointsToRoot(tree, link_a);
  while (!up.empty() && !down.empty() && up.back() == down.back()) {
    up.pop_back();
    down.pop_back();
  }
  std::reverse(down.begin(), down.end());

  Eigen::Isometry3d* fixed = &X_before_;
  steps_.reserve(up.size() + down.size());  // `fixed` points into it
  const auto add_step = [&](const Joint& joint, double sense) {
    steps_.push_back({joint.index, joint.type == JointType::kRevolute, sense * joint.axis,
                      Eigen::Isometry3d::Identity()});
    fixed = &steps_.back().X_after;
  };
  for (const int j : up) {
    const Joint& joint = tree.joints()[j];
    if (joint.type != JointType::kFixed) add_step(joint, -1.0);
    *fixed = *fixed * joint.X_PJ.inverse();
  }
  for (const int j : down) {
    const Joint& joint = tree.joints()[j];
    *fixed = *fixed * joint.X_PJ;
    if (joint.type != JointType::kFixed) add_step(joint, 1.0);
  }
}

Eigen::Isometry3d Chain::Pose(const JointVector& q) const {
  Eigen::Isometry3d X = X_before_;
  for (const ChainStep& step : steps_) {
    if (step.revolute) {
      X.linear() = X.linear() * Eigen::AngleAxisd(q[step.index], step.axis).toRotationMatrix();
    } else {
      X.translation() += X.linear() * (q[step.index] * step.axis);
    }
    X = X * step.X_after;
  }
  return X;
}

}  // namespace ncsim::kinematics
