// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/rotary_centre.h"

namespace ncsim::machine {
namespace {

struct Line {
  Eigen::Vector3d point;
  Eigen::Vector3d direction;
};

Line AxisLine(const kinematics::KinematicTree& tree, int joint, const kinematics::JointVector& q) {
  const kinematics::Joint& j = tree.joints()[static_cast<std::size_t>(joint)];
  const Eigen::Isometry3d X_MJ = tree.Pose(j.parent_link, q) * j.X_PJ;
  return {X_MJ.translation(), X_MJ.linear() * j.axis};
}

}  // namespace

std::optional<Eigen::Vector3d> RotaryCentre(const Machine& machine) {
  if (!machine.five_axis) return std::nullopt;
  kinematics::JointVector q = kinematics::JointVector::Zero(machine.tree.num_moving());
  std::vector<Line> rotary;
  for (const int j : machine.tree.MovingJointsTo(machine.table_link)) {
    const kinematics::Joint& joint = machine.tree.joints()[static_cast<std::size_t>(j)];
    if (joint.type == kinematics::JointType::kRevolute) {
      rotary.push_back(AxisLine(machine.tree, j, q));
    }
  }
  if (rotary.size() != 2) return std::nullopt;
  const Line& tilt = rotary[0];
  const double along = (rotary[1].point - tilt.point).dot(tilt.direction);
  const Eigen::Vector3d p_M = tilt.point + along * tilt.direction;
  const Eigen::Vector3d p_BT_B =
      machine.tree.Pose(machine.table_link, q).inverse(Eigen::Isometry) * p_M;
  machine.five_axis->SolveLinear(p_BT_B, 0.0, &q);
  Eigen::Vector3d values;
  for (int i = 0; i < 3; ++i) {
    const Axis* axis = machine.FindAxis("XYZ"[i]);
    if (axis == nullptr) return std::nullopt;
    values[i] = q[axis->joint];
  }
  return values;
}

}  // namespace ncsim::machine
