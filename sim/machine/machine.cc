// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/machine.h"

#include <algorithm>

#include "sim/base/units.h"
#include "sim/machine/tool.h"

namespace ncsim::machine {

const Axis* Machine::FindAxis(char letter) const {
  for (const Axis& axis : axes) {
    if (axis.letter == letter) return &axis;
  }
  return nullptr;
}

bool Machine::Disabled(int link_a, int link_b) const {
  return std::any_of(disabled_pairs.begin(), disabled_pairs.end(), [&](const LinkPair& pair) {
    return (pair.link_a == link_a && pair.link_b == link_b) ||
           (pair.link_a == link_b && pair.link_b == link_a);
  });
}

// The axes of M are X, Y, Z of the control, whichever side a linear axis carries.
Eigen::Vector3d Machine::Coordinates(const Eigen::Vector3d& p_M,
                                     const kinematics::JointVector& q) const {
  Eigen::Vector3d coordinates = p_M - tree.Pose(spindle_link, q).translation();
  for (const Axis& axis : axes) {
    if (!axis.rotary) coordinates[axis.letter - 'X'] += q[axis.joint];
  }
  return coordinates;
}

kinematics::JointVector Machine::Home() const {
  kinematics::JointVector q = kinematics::JointVector::Zero(tree.num_moving());
  for (const Axis& axis : axes) q[axis.joint] = axis.home;
  return q;
}

AxisReadout Machine::Readout(const kinematics::JointVector& q) const {
  AxisReadout readout;
  readout.reserve(axes.size());
  for (const Axis& axis : axes) {
    readout.emplace_back(axis.letter, axis.rotary ? Degrees(q[axis.joint]) : q[axis.joint]);
  }
  return readout;
}

const Tool* ToolTable::Find(int number) const {
  for (const Tool& tool : tools) {
    if (tool.number == number) return &tool;
  }
  return nullptr;
}

std::string ToolBodyName(int number, std::string_view part) {
  return "T" + std::to_string(number) + "." + std::string(part);
}

}  // namespace ncsim::machine
