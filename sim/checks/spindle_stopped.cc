// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/run_finding.h"
#include "sim/checks/check.h"

namespace ncsim::checks {
namespace {

class SpindleStoppedCheck : public Check {
 public:
  explicit SpindleStoppedCheck(const machine::Machine& machine) : machine_(&machine) {}

  void OnMotion(const motion::Motion& motion, std::vector<Finding>* findings) override {
    if (!IsFeed(motion)) return;  // The spindle may well stand in a rapid.
    if (motion.facts.spindle_on) {
      run_.Close(findings);
      return;
    }
    if (!run_.open()) {
      run_.Start(FindingAt(*machine_, Rule::kSpindleStopped, motion, 0.0,
                           "feed with the spindle stopped"));
    }
    run_.Add(motion.where);
  }

  void Finish(std::vector<Finding>* findings) override { run_.Close(findings); }

 private:
  const machine::Machine* machine_;
  RunFinding run_;
};

}  // namespace

std::unique_ptr<Check> SpindleStopped(const machine::Machine& machine) {
  return std::make_unique<SpindleStoppedCheck>(machine);
}

}  // namespace ncsim::checks
