// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/swept.h"

#include <cmath>
#include <utility>
#include <vector>

namespace ncsim::collision {

std::shared_ptr<const SweptBody> Sweep(const machine::Machine& machine, const MeshBody& body) {
  const std::vector<int> moving = machine.tree.MovingJointsTo(body.extent.link);
  if (moving.empty() || body.tree.empty()) return nullptr;
  const kinematics::Joint& joint = machine.tree.joints()[static_cast<std::size_t>(moving.back())];
  if (joint.type != kinematics::JointType::kRevolute) return nullptr;
  // X_PJ with Z along the joint's axis.
  Eigen::Isometry3d X_PZ = joint.X_PJ;
  X_PZ.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), joint.axis));
  const kinematics::JointVector zero = kinematics::JointVector::Zero(machine.tree.num_moving());
  const Eigen::Isometry3d X_PL =
      kinematics::RelativePath(machine.tree, joint.parent_link, body.extent.link).Pose(zero);
  const Eigen::Isometry3d X_ZL = X_PZ.inverse() * X_PL;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < body.tree.size(); ++i) {
    for (const Eigen::Vector3d& v : body.tree.triangle(i)) {
      const Eigen::Vector3d p = X_ZL * v;
      points.emplace_back(p.z(), std::hypot(p.x(), p.y()));
    }
  }
  const RevolvedPose pose{X_PZ.translation(), X_PZ.linear().col(2)};
  ProfileShape shape(ConvexHull(std::move(points)));
  const double middle = 0.5 * (shape.z_min() + shape.z_max());
  const kinematics::Extent extent{joint.parent_link, pose.tip + middle * pose.axis,
                                  std::hypot(0.5 * (shape.z_max() - shape.z_min()), shape.r_max())};
  return std::make_shared<const SweptBody>(SweptBody{extent, pose, std::move(shape)});
}

}  // namespace ncsim::collision
