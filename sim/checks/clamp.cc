// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/run_finding.h"
#include "sim/checks/check.h"

namespace ncsim::checks {
namespace {

class ClampCheck : public Check {
 public:
  explicit ClampCheck(const machine::Machine& machine) : machine_(&machine) {}

  void OnMotion(const motion::Motion& motion, std::vector<Finding>* findings) override {
    if (!IsFeed(motion)) return;  // A rapid between two such feeds does not end the run.
    if (!motion.facts.brake_conflict) {
      run_.Close(findings);
      return;
    }
    if (!run_.open()) {
      run_.Start(FindingAt(*machine_, Rule::kClamp, motion, 0.0,
                           "a rotary axis feeds with its brake commanded on: the control releases "
                           "it and sets it again in every block"));
    }
    run_.Add(motion.where);
  }

  void Finish(std::vector<Finding>* findings) override { run_.Close(findings); }

 private:
  const machine::Machine* machine_;
  RunFinding run_;
};

}  // namespace

std::unique_ptr<Check> Clamp(const machine::Machine& machine) {
  return std::make_unique<ClampCheck>(machine);
}

}  // namespace ncsim::checks
