// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/control_kinematics.h"

#include <string>
#include <utility>
#include <vector>

#include "sim/machine/rotary_centre.h"

namespace ncsim::control {
namespace {

using kinematics::FiveAxis;
using kinematics::Joint;
using kinematics::JointVector;
using kinematics::KinematicTree;
using kinematics::Link;

// Closer than this, in mm, two centres are the same: settings have four decimals of an inch.
constexpr double kSameCentre = 1e-5;

// The way of the gauge line, in the machine frame, when X, Y and Z go by `values`.
Eigen::Vector3d GaugeTravel(const machine::Machine& machine, const Eigen::Vector3d& values) {
  const KinematicTree& tree = machine.tree;
  JointVector q = JointVector::Zero(tree.num_moving());
  const Eigen::Vector3d from = tree.Pose(machine.spindle_link, q).translation();
  for (int i = 0; i < 3; ++i) q[machine.FindAxis("XYZ"[i])->joint] = values[i];
  return tree.Pose(machine.spindle_link, q).translation() - from;
}

// Index into tree.joints() of the rotary joint that carries the table and is next to the base.
int FirstTableRotary(const machine::Machine& machine) {
  for (const int joint : machine.tree.MovingJointsTo(machine.table_link)) {
    if (machine.tree.joints()[static_cast<std::size_t>(joint)].type ==
        kinematics::JointType::kRevolute) {
      return joint;
    }
  }
  return -1;
}

// The same tree with the rotary axes of the table moved by `shift` (machine frame, all axes at 0)
// and the table where it was: a link "believed_table" on the old one undoes the shift.
std::optional<FiveAxis> Shifted(const machine::Machine& machine, int first_rotary,
                                const Eigen::Vector3d& shift) {
  const KinematicTree& tree = machine.tree;
  const JointVector zero = JointVector::Zero(tree.num_moving());
  std::vector<Link> links = tree.links();
  std::vector<Joint> joints = tree.joints();
  Joint& first = joints[static_cast<std::size_t>(first_rotary)];
  first.X_PJ.translation() += tree.Pose(first.parent_link, zero).linear().transpose() * shift;

  Joint back;
  back.name = "believed_table_joint";
  back.parent_link = machine.table_link;
  back.child_link = static_cast<int>(links.size());
  back.X_PJ.translation() = -(tree.Pose(machine.table_link, zero).linear().transpose() * shift);
  Link table;
  table.name = "believed_table";
  table.parent_joint = static_cast<int>(joints.size());
  joints.push_back(back);
  links.push_back(table);
  const KinematicTree believed(std::move(links), std::move(joints));
  const std::string spindle = tree.links()[static_cast<std::size_t>(machine.spindle_link)].name;
  return FiveAxis::Make(believed, believed.FindLink(spindle), believed.FindLink("believed_table"));
}

}  // namespace

ControlKinematics MakeControlKinematics(const machine::Machine& machine,
                                        const std::optional<Eigen::Vector3d>& stated_centre) {
  ControlKinematics result;
  result.five_axis = machine.five_axis;
  const std::optional<Eigen::Vector3d> centre = machine::RotaryCentre(machine);
  if (!stated_centre || !centre) return result;
  const Eigen::Vector3d error = *stated_centre - *centre;
  if (error.norm() < kSameCentre) return result;
  const Eigen::Vector3d shift = GaugeTravel(machine, error);
  result.five_axis = Shifted(machine, FirstTableRotary(machine), shift);
  result.centre_error = shift.norm();
  return result;
}

kinematics::RotaryLimits RotaryLimitsOf(const machine::Machine& machine,
                                        const kinematics::FiveAxis& five_axis) {
  kinematics::RotaryLimits limits;
  for (std::size_t i = 0; i < five_axis.rotary().size(); ++i) {
    for (const machine::Axis& axis : machine.axes) {
      if (axis.joint != five_axis.rotary()[i]) continue;
      limits.lower.at(i) = axis.lower;
      limits.upper.at(i) = axis.upper;
    }
  }
  return limits;
}

}  // namespace ncsim::control
