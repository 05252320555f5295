// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "sim/base/run_finding.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/checks/check.h"

namespace ncsim::checks {
namespace {

/// Half of the last digit of a control that reads 0.001 deg: a turn of 180.000 or 360.000 counts as
/// just that.
constexpr double kHalfDigit = Radians(0.0005);
/// Travel limits: as in travel-limit.
constexpr double kLimitTolerance = 1e-9;
/// mm: a linear axis that moves less rests.
constexpr double kRestsOverWrap = 1e-6;

class RotaryWrapCheck : public Check {
 public:
  explicit RotaryWrapCheck(const machine::Machine& machine) : machine_(&machine) {
    for (const machine::Axis& axis : machine.axes) {
      (axis.rotary ? rotary_ : linear_).push_back(&axis);
    }
  }

  void OnMotion(const motion::Motion& motion, std::vector<Finding>* findings) override {
    if (!IsFeed(motion)) return;
    const machine::Axis* turning = LongTurn(motion);
    if (turning == nullptr || (!motion.facts.tcp && Harmless(motion, *turning))) {
      run_.Close(findings);
      return;
    }
    const std::optional<motion::JointVector> nearer = NearerEnd(motion);
    if (!nearer) {
      run_.Close(findings);
      return;
    }
    const Severity severity = motion.facts.tcp ? Severity::kError : Severity::kWarning;
    if (run_.open() && run_.finding().severity != severity) run_.Close(findings);
    if (!run_.open()) {
      run_.Start(
          FindingAt(*machine_, Rule::kRotaryWrap, motion, 0.0, Message(motion, *turning, *nearer)));
      run_.finding().severity = severity;
    }
    run_.Add(motion.where);
  }

  void Finish(std::vector<Finding>* findings) override { run_.Close(findings); }

 private:
  /// The rotary axis that turns furthest, if by more than 180 degrees.
  const machine::Axis* LongTurn(const motion::Motion& motion) const {
    const machine::Axis* longest = nullptr;
    double most = kPi + kHalfDigit;
    for (const machine::Axis* axis : rotary_) {
      const double turn = std::abs(motion.q1()[axis->joint] - motion.q0()[axis->joint]);
      if (turn > most) {
        most = turn;
        longest = axis;
      }
    }
    return longest;
  }

  /// Without TCP: indexing (the linear axes rest), and whole revolutions, are what the programmer
  /// asked for.
  bool Harmless(const motion::Motion& motion, const machine::Axis& turning) const {
    const motion::JointVector turn = motion.q1() - motion.q0();
    if (std::abs(std::remainder(turn[turning.joint], 2.0 * kPi)) <= kHalfDigit) return true;
    return !std::holds_alternative<motion::AxisArc>(motion.path) &&
           std::all_of(linear_.begin(), linear_.end(), [&](const machine::Axis* axis) {
             return std::abs(turn[axis->joint]) <= kRestsOverWrap;
           });
  }

  /// q1 with other rotary positions: the same tool axis, within the limits, less than 180 degrees
  /// from q0 on every rotary axis. Of several, the one with the shortest turn.
  std::optional<motion::JointVector> NearerEnd(const motion::Motion& motion) const {
    std::optional<motion::JointVector> best;
    double best_turn = kPi - kHalfDigit;
    const auto consider = [&](motion::JointVector q) {
      double longest = 0.0;
      for (const machine::Axis* axis : rotary_) {
        double& angle = q[axis->joint];
        const double from = motion.q0()[axis->joint];
        angle += 2.0 * kPi * std::round((from - angle) / (2.0 * kPi));
        if (angle < axis->lower - kLimitTolerance || angle > axis->upper + kLimitTolerance) return;
        longest = std::max(longest, std::abs(angle - from));
      }
      if (longest < best_turn) {
        best_turn = longest;
        best = q;
      }
    };
    consider(motion.q1());
    if (!machine_->five_axis) return best;
    const kinematics::FiveAxis& five_axis = *machine_->five_axis;
    Eigen::Vector3d p_BT_B, u_B;
    five_axis.TipInTable(motion.q1(), 0.0, &p_BT_B, &u_B);
    for (const kinematics::RotarySolution& solution : five_axis.SolveRotary(u_B)) {
      motion::JointVector q = motion.q1();
      const std::vector<int>& joints = five_axis.rotary();
      for (std::size_t i = 0; i < joints.size(); ++i) q[joints[i]] = solution.angles.at(i);
      // At the pole the second axis is free: it may as well stay.
      if (solution.at_pole && joints.size() == 2) q[joints[1]] = motion.q0()[joints[1]];
      consider(std::move(q));
    }
    return best;
  }

  std::string Message(const motion::Motion& motion, const machine::Axis& turning,
                      const motion::JointVector& nearer) const {
    const double from = motion.q0()[turning.joint];
    const double to = motion.q1()[turning.joint];
    std::string end;
    double away = 0.0;
    for (const machine::Axis* axis : rotary_) {
      end += (end.empty() ? "" : " ") + std::string(1, axis->letter) +
             Fixed(Degrees(nearer[axis->joint]), 3);
      away = std::max(away, std::abs(nearer[axis->joint] - motion.q0()[axis->joint]));
    }
    return std::string("axis ") + turning.letter + " turns " +
           Fixed(Degrees(std::abs(to - from)), 3) + " deg in a feed, from " +
           Fixed(Degrees(from), 3) + " to " + Fixed(Degrees(to), 3) + "; the same tool axis at " +
           end + " is only " + Fixed(Degrees(away), 3) + " deg away" +
           std::string(motion.facts.wrap_note);
  }

  const machine::Machine* machine_;
  std::vector<const machine::Axis*> rotary_;
  std::vector<const machine::Axis*> linear_;
  RunFinding run_;
};

}  // namespace

std::unique_ptr<Check> RotaryWrap(const machine::Machine& machine) {
  return std::make_unique<RotaryWrapCheck>(machine);
}

}  // namespace ncsim::checks
