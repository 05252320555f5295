// SPDX-License-Identifier: BSD-3-Clause
#include "sim/checks/check.h"

#include "sim/base/units.h"

namespace ncsim::checks {

std::vector<std::unique_ptr<Check>> AllChecks(const machine::Machine& machine) {
  std::vector<std::unique_ptr<Check>> checks;
  checks.push_back(TravelLimit(machine));
  checks.push_back(RotaryWrap(machine));
  checks.push_back(Singularity(machine));
  checks.push_back(AxisSpeed(machine));
  checks.push_back(Clamp(machine));
  checks.push_back(SpindleStopped(machine));
  checks.push_back(RotaryUnderTcp(machine));
  return checks;
}

std::vector<std::pair<char, double>> AxisReadout(const machine::Machine& machine,
                                                 const motion::JointVector& q) {
  std::vector<std::pair<char, double>> readout;
  readout.reserve(machine.axes.size());
  for (const machine::Axis& axis : machine.axes) {
    readout.emplace_back(axis.letter, axis.rotary ? Degrees(q[axis.joint]) : q[axis.joint]);
  }
  return readout;
}

bool IsFeed(const motion::Motion& motion) {
  return motion.kind == motion::MotionKind::kFeed || motion.kind == motion::MotionKind::kArc;
}

}  // namespace ncsim::checks
