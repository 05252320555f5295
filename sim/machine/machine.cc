// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/machine.h"

#include "sim/base/units.h"
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

}  // namespace ncsim::machine
