// SPDX-License-Identifier: BSD-3-Clause
#include "sim/checks/run_finding.h"

#include "sim/base/text.h"
#include "sim/checks/check.h"

namespace ncsim::checks {

Finding FindingAt(const machine::Machine& machine, Rule rule, const motion::Motion& motion,
                  double s, std::string message) {
  Finding finding = MakeFinding(rule, motion.where, std::move(message));
  finding.axes = AxisReadout(machine, motion.At(s));
  finding.time_s = motion.start_time + motion.ElapsedTime(s);
  return finding;
}

std::string AxesText(const Finding& finding) {
  std::string text;
  for (const auto& [letter, value] : finding.axes) {
    text.append(text.empty() ? "" : " ").append(1, letter).append(Fixed(value, 3));
  }
  return text;
}

void RunFinding::Add(const motion::Motion& motion) {
  const bool same_block = motion.where.line == last_.line && motion.where.file == last_.file;
  if (blocks_ == 0 || !same_block) ++blocks_;
  last_ = motion.where;
}

void RunFinding::Close(std::vector<Finding>* findings) {
  if (!open()) return;
  if (blocks_ > 1) {
    finding_.message += " (" + std::to_string(blocks_) + " blocks, the last is line " +
                        std::to_string(last_.line) + ")";
  }
  findings->push_back(std::move(finding_));
  *this = RunFinding();
}

}  // namespace ncsim::checks
