// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/machine.h"

#include "sim/machine/tool.h"

namespace ncsim::machine {

const Axis* Machine::FindAxis(char letter) const {
  for (const Axis& axis : axes) {
    if (axis.letter == letter) return &axis;
  }
  return nullptr;
}

kinematics::JointVector Machine::Home() const {
  kinematics::JointVector q = kinematics::JointVector::Zero(tree.num_moving());
  for (const Axis& axis : axes) q[axis.joint] = axis.home;
  return q;
}

const Tool* ToolTable::Find(int number) const {
  for (const Tool& tool : tools) {
    if (tool.number == number) return &tool;
  }
  return nullptr;
}

}  // namespace ncsim::machine
