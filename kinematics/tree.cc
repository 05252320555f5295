// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace ncsim::kinematics {

KinematicTree::KinematicTree(std::vector<Link> links, std::vector<Joint> joints)
    : joints_(std::move(joints)) {
  const int count = static_cast<int>(links.size());
  std::vector<int> parent_joint(links.size(), -1);
  for (int j = 0; j < static_cast<int>(joints_.size()); ++j) {
    assert(joints_[j].parent_link >= 0 && joints_[j].parent_link < count);
    assert(joints_[j].child_link >= 0 && joints_[j].child_link < count);
    assert(parent_joint[joints_[j].child_link] < 0);
    parent_joint[joints_[j].child_link] = j;
  }

  // Breadth first from the root; siblings keep the order of their joints.
  std::vector<int> order;
  for (int i = 0; i < count; ++i) {
    if (parent_joint[i] < 0) order.push_back(i);
  }
  assert(order.size() == 1 || count == 0);
  for (std::size_t next = 0; next < order.size(); ++next) {
    for (const Joint& joint : joints_) {
      if (joint.parent_link == order[next]) order.push_back(joint.child_link);
    }
  }
  assert(static_cast<int>(order.size()) == count);

  std::vector<int> place(links.size(), -1);
  for (const int old : order) {
    place[old] = static_cast<int>(links_.size());
    links_.push_back({std::move(links[old].name), parent_joint[old]});
  }
  for (int j = 0; j < static_cast<int>(joints_.size()); ++j) {
    Joint& joint = joints_[j];
    joint.parent_link = place[joint.parent_link];
    joint.child_link = place[joint.child_link];
    joint.index = -1;
    if (joint.type == JointType::kFixed) continue;
    assert(std::abs(joint.axis.norm() - 1.0) < 1e-9);
    joint.index = static_cast<int>(moving_.size());
    moving_.push_back(j);
  }
  assert(moving_.size() <= static_cast<std::size_t>(kMaxJoints));
}

int KinematicTree::FindLink(std::string_view name) const {
  const auto it = std::find_if(links_.begin(), links_.end(),
                               [&](const Link& link) { return link.name == name; });
  return it == links_.end() ? -1 : static_cast<int>(it - links_.begin());
}

int KinematicTree::FindJoint(std::string_view name) const {
  const auto it = std::find_if(joints_.begin(), joints_.end(),
                               [&](const Joint& joint) { return joint.name == name; });
  return it == joints_.end() ? -1 : static_cast<int>(it - joints_.begin());
}

Eigen::Isometry3d KinematicTree::JointTransform(int joint_index, double position) const {
  const Joint& joint = joints_[joint_index];
  Eigen::Isometry3d X_PC = joint.X_PJ;
  switch (joint.type) {
    case JointType::kFixed:
      break;
    case JointType::kPrismatic:
      X_PC.translation() += X_PC.linear() * (position * joint.axis);
      break;
    case JointType::kRevolute:
      X_PC.linear() =
          joint.X_PJ.linear() * Eigen::AngleAxisd(position, joint.axis).toRotationMatrix();
      break;
  }
  return X_PC;
}

Eigen::Isometry3d KinematicTree::Pose(int link, const JointVector& q) const {
  Eigen::Isometry3d X_ML = Eigen::Isometry3d::Identity();
  for (int j = links_[link].parent_joint; j >= 0; j = links_[joints_[j].parent_link].parent_joint) {
    X_ML = JointTransform(j, joints_[j].index < 0 ? 0.0 : q[joints_[j].index]) * X_ML;
  }
  return X_ML;
}

void KinematicTree::Poses(const JointVector& q, std::vector<Eigen::Isometry3d>* X_ML) const {
  X_ML->resize(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const int j = links_[i].parent_joint;
    if (j < 0) {
      (*X_ML)[i].setIdentity();
      continue;
    }
    const Joint& joint = joints_[j];
    (*X_ML)[i] =
        (*X_ML)[joint.parent_link] * JointTransform(j, joint.index < 0 ? 0.0 : q[joint.index]);
  }
}

std::vector<int> KinematicTree::MovingJointsTo(int link) const {
  std::vector<int> moving;
  for (int j = links_[link].parent_joint; j >= 0; j = links_[joints_[j].parent_link].parent_joint) {
    if (joints_[j].index >= 0) moving.push_back(j);
  }
  std::reverse(moving.begin(), moving.end());
  return moving;
}

}  // namespace ncsim::kinematics
