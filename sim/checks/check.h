// SPDX-License-Identifier: BSD-3-Clause
// Checks that need axes and facts but no bodies: a file a rule.
#pragma once

#include <memory>
#include <vector>

#include "sim/base/finding.h"
#include "sim/machine/machine.h"
#include "sim/motion/motion.h"

namespace ncsim::checks {

class Check {
 public:
  virtual ~Check() = default;
  /// Motions in program order.
  virtual void OnMotion(const motion::Motion& motion, std::vector<Finding>* findings) = 0;
  /// After the last motion: what a run still held back.
  virtual void Finish(std::vector<Finding>* findings) = 0;
};

/// travel-limit: an axis leaves its limits anywhere in a motion; one finding a run of blocks and
/// axis, at the first point.
std::unique_ptr<Check> TravelLimit(const machine::Machine& machine);
/// rotary-wrap: see the design's definition (docs/findings.md).
std::unique_ptr<Check> RotaryWrap(const machine::Machine& machine);
/// singularity, axis-speed, clamp, spindle-stopped, rotary-under-tcp.
std::unique_ptr<Check> Singularity(const machine::Machine& machine);
std::unique_ptr<Check> AxisSpeed(const machine::Machine& machine);
std::unique_ptr<Check> Clamp(const machine::Machine& machine);
std::unique_ptr<Check> SpindleStopped(const machine::Machine& machine);
std::unique_ptr<Check> RotaryUnderTcp(const machine::Machine& machine);

/// All of them, in the order in which they report.
std::vector<std::unique_ptr<Check>> AllChecks(const machine::Machine& machine);

/// A finding at parameter s of a motion, with the axes' positions and the time there.
Finding FindingAt(const machine::Machine& machine, Rule rule, const motion::Motion& motion,
                  double s, std::string message);

}  // namespace ncsim::checks
