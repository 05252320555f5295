// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <variant>

#include "sim/base/run_finding.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/checks/check.h"

namespace ncsim::checks {
namespace {

/// rad, a millionth of a degree: far below the resolution of any control.
constexpr double kMoves = 2e-8;

constexpr int kSamplesForWords = 64;  // of a motion, for the words of a finding alone

class RotaryUnderTcpCheck : public Check {
 public:
  explicit RotaryUnderTcpCheck(const machine::Machine& machine) : machine_(&machine) {}

  void OnMotion(const motion::Motion& motion, std::vector<Finding>*) override {
    if (motion.kind != motion::MotionKind::kRapid || !motion.facts.tcp) return;
    for (const machine::Axis& axis : machine_->axes) {
      if (!axis.rotary) continue;
      const double turn = motion.q1()[axis.joint] - motion.q0()[axis.joint];
      if (std::abs(turn) <= kMoves) continue;
      if (!run_.open()) {
        const bool held = std::holds_alternative<motion::TcpCurve>(motion.path);
        run_.Start(
            FindingAt(*machine_, Rule::kRotaryUnderTcp, motion, 0.0,
                      std::string("a rapid turns axis ") + axis.letter + " by " +
                          Fixed(Degrees(turn), 3) + " deg while TCP is active: " +
                          (held ? Swing(motion) : "the tip does not hold its point on the way")));
      }
      run_.Add(motion.where);
      return;
    }
  }

  /// One finding for the whole program: the habit is the fault, not the block.
  void Finish(std::vector<Finding>* findings) override { run_.Close(findings); }

 private:
  /// What the linear axes do so that the tip keeps to its way over the part.
  std::string Swing(const motion::Motion& motion) const {
    motion::JointVector farthest = motion::JointVector::Zero(motion.q0().size());
    for (int i = 1; i <= kSamplesForWords; ++i) {
      const double s = static_cast<double>(i) / kSamplesForWords;
      farthest = farthest.cwiseMax((motion.At(s) - motion.q0()).cwiseAbs());
    }
    std::string text = "the linear axes swing at rapid to lead the tip with the part, ";
    bool first = true;
    for (const machine::Axis& axis : machine_->axes) {
      if (axis.rotary) continue;
      if (!first) text += ", ";
      first = false;
      text += axis.letter + (" by up to " + Fixed(farthest[axis.joint], 1)) + " mm";
    }
    return text + "; turn the axis before TCP is switched on";
  }

  const machine::Machine* machine_;
  RunFinding run_;
};

}  // namespace

std::unique_ptr<Check> RotaryUnderTcp(const machine::Machine& machine) {
  return std::make_unique<RotaryUnderTcpCheck>(machine);
}

}  // namespace ncsim::checks
