// SPDX-License-Identifier: BSD-3-Clause
#include "sim/checks/check.h"

#include <utility>

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

Finding FindingAt(const machine::Machine& machine, Rule rule, const motion::Motion& motion,
                  double s, std::string message) {
  Finding finding = MakeFinding(rule, motion.where, std::move(message));
  finding.axes = machine.Readout(motion.At(s));
  finding.time_s = motion.start_time + motion.ElapsedTime(s);
  return finding;
}

}  // namespace ncsim::checks
