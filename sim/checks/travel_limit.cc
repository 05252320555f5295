// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string_view>

#include "sim/base/run_finding.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/checks/check.h"
#include "sim/checks/excursion.h"
#include "sim/machine/settings.h"

namespace ncsim::checks {
namespace {

/// Rounding of the interpreter's arithmetic, far below the last digit of any control: a position on
/// the limit is fine.
constexpr double kToleranceMm = 1e-6;
constexpr double kToleranceRad = 1e-9;

/// One side of one axis.
struct Side {
  const machine::Axis* axis = nullptr;
  double sense = 1.0;  ///< +1 for the upper limit, -1 for the lower.
  double limit = 0.0;
  double tolerance = 0.0;
  RunFinding run;
  double worst = 0.0;      ///< Greatest excess of the run, mm or rad.
  std::string_view alarm;  ///< The control's, at the run's first motion.
  RunFinding unproven;
};

std::string Number(double value, double excess) {
  // Three decimals, unless that would print the limit itself.
  return Fixed(value, excess < 0.0005 ? 6 : 3);
}

std::string Message(Side& side) {
  const bool rotary = side.axis->rotary;
  const auto shown = [&](double value) { return rotary ? Degrees(value) : value; };
  const std::string_view unit = rotary ? " deg" : " mm";
  const std::string alarm = side.alarm.empty() ? "" : " (alarm " + std::string(side.alarm) + ")";
  const double reached = shown(side.limit + side.sense * side.worst);
  return std::string("axis ") + side.axis->letter + " reaches " +
         Number(reached, shown(side.worst)).append(unit) + ", limit " +
         Short(shown(side.limit)).append(unit) + alarm + "; it leaves at " +
         ToString(side.run.finding().axes);
}

class TravelLimitCheck : public Check {
 public:
  explicit TravelLimitCheck(const machine::Machine& machine)
      : machine_(&machine), alarms_(machine::LimitAlarmsOf(machine.control.dialect)) {
    for (const machine::Axis& axis : machine.axes) {
      const double tolerance = axis.rotary ? kToleranceRad : kToleranceMm;
      if (std::isfinite(axis.lower))
        sides_.push_back({&axis, -1.0, axis.lower, tolerance, {}, 0.0, {}, {}});
      if (std::isfinite(axis.upper))
        sides_.push_back({&axis, 1.0, axis.upper, tolerance, {}, 0.0, {}, {}});
    }
  }

  void OnMotion(const motion::Motion& motion, std::vector<Finding>* findings) override {
    // Of what is not monotone, the box of the whole motion settles most.
    const bool monotone = IsMonotone(motion);
    if (!monotone) box_ = motion::Box(motion, motion::Whole(motion));
    const motion::JointVector& low = monotone ? motion.q0() : box_.lower;
    const motion::JointVector& high = monotone ? motion.q1() : box_.upper;
    for (Side& side : sides_) {
      const int joint = side.axis->joint;
      // Written so that a NaN goes on to the full examination.
      if (side.sense * (low[joint] - side.limit) <= side.tolerance &&
          side.sense * (high[joint] - side.limit) <= side.tolerance) {
        Close(side, findings);
      } else {
        Examine(motion, side, findings);
      }
    }
  }

  void Finish(std::vector<Finding>* findings) override {
    for (Side& side : sides_) Close(side, findings);
  }

 private:
  void Examine(const motion::Motion& motion, Side& side, std::vector<Finding>* findings) {
    const Bound bound{side.axis->joint, side.sense, side.limit, side.tolerance};
    const Excursion excursion = FindExcursion(motion, bound, side.run.open() ? side.worst : 0.0);
    switch (excursion.outcome) {
      case Excursion::Outcome::kInside:
        Close(side, findings);
        return;
      case Excursion::Outcome::kOutside:
        side.unproven.Close(findings);
        if (!side.run.open()) {
          side.run.Start(
              FindingAt(*machine_, Rule::kTravelLimit, motion, excursion.s, std::string()));
          side.worst = 0.0;
          const double end = motion.q1()[side.axis->joint];
          const bool ends_behind = side.sense * (end - side.limit) > side.tolerance;
          side.alarm = ends_behind ? alarms_.end : alarms_.way;
        }
        side.run.Add(motion.where);
        side.worst = std::max(side.worst, excursion.worst);
        return;
      case Excursion::Outcome::kUnproven:
        CloseRun(side, findings);
        if (!side.unproven.open()) {
          side.unproven.Start(FindingAt(*machine_, Rule::kUncertified, motion, excursion.s,
                                        std::string("axis ") + side.axis->letter +
                                            " runs so close to its limit that staying inside "
                                            "could not be proven"));
        }
        side.unproven.Add(motion.where);
        return;
    }
  }

  static void CloseRun(Side& side, std::vector<Finding>* findings) {
    if (!side.run.open()) return;
    side.run.finding().message = Message(side);
    side.run.Close(findings);
  }

  static void Close(Side& side, std::vector<Finding>* findings) {
    CloseRun(side, findings);
    side.unproven.Close(findings);
  }

  const machine::Machine* machine_;
  const machine::LimitAlarms alarms_;
  std::vector<Side> sides_;
  motion::JointBox box_;
};

}  // namespace

std::unique_ptr<Check> TravelLimit(const machine::Machine& machine) {
  return std::make_unique<TravelLimitCheck>(machine);
}

}  // namespace ncsim::checks
