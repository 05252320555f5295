// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "sim/base/run_finding.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/checks/check.h"
#include "sim/motion/top_speed.h"

namespace ncsim::checks {
namespace {

/// Relative: rounding of a feed that was programmed to be just the axis' rate.
constexpr double kSpeedRounding = 1e-6;
/// mm, rad: what moves less rests.
constexpr double kRests = 1e-9;

double TipPathLength(const motion::TcpCurve& curve) {
  if (!curve.arc) return (curve.p1_B - curve.p0_B).norm();
  return std::hypot(curve.radius * curve.sweep, (curve.pitch + curve.end_error).norm());
}

/// What the programmed feed asks of the most demanded axis.
struct Demand {
  const machine::Axis* axis = nullptr;
  double ratio = 0.0;  ///< Needed rate over the axis' own; infinite where the tip rests.
};

class AxisSpeedCheck : public Check {
 public:
  explicit AxisSpeedCheck(const machine::Machine& machine) : machine_(&machine) {}

  void OnMotion(const motion::Motion& motion, std::vector<Finding>* findings) override {
    if (!IsFeed(motion)) return;
    const auto* curve = std::get_if<motion::TcpCurve>(&motion.path);
    const Demand demand = curve == nullptr ? Demand() : Worst(motion, TipPathLength(*curve));
    if (demand.ratio <= 1.0 + kSpeedRounding) {
      run_.Close(findings);
      return;
    }
    if (!run_.open()) {
      run_.Start(FindingAt(*machine_, Rule::kAxisSpeed, motion, 0.0, ""));
      worst_ = 0.0;
    }
    if (demand.ratio > worst_) {
      worst_ = demand.ratio;
      run_.finding().message = Message(motion, *demand.axis, TipPathLength(*curve), demand.ratio);
    }
    run_.Add(motion.where);
  }

  void Finish(std::vector<Finding>* findings) override { run_.Close(findings); }

 private:
  Demand Worst(const motion::Motion& motion, double length) const {
    Demand worst;
    if (!(motion.facts.feed > 0.0)) return worst;  // Feed-missing is the control's to report.
    const double time = length > kRests ? length / motion.facts.feed : 0.0;
    double slowest = 0.0;  // s
    const motion::JointVector travel = motion::TravelAtTopSpeed(motion);
    for (const machine::Axis& axis : machine_->axes) {
      if (!(axis.rapid > 0.0)) continue;
      const double way = travel[axis.joint];
      const double needed = way / axis.rapid;
      if (!(way > kRests) || !(needed > slowest)) continue;
      slowest = needed;
      worst.axis = &axis;
      worst.ratio = time > 0.0 ? needed / time : std::numeric_limits<double>::infinity();
    }
    return worst;
  }

  static std::string Message(const motion::Motion& motion, const machine::Axis& axis, double length,
                             double ratio) {
    const auto rate = [&](double value) {
      return axis.rotary ? Fixed(Degrees(value), 1) + " deg/s" : Fixed(60.0 * value, 0) + " mm/min";
    };
    const std::string feed = Fixed(60.0 * motion.facts.feed, 1) + " mm/min";
    const std::string name = std::string("axis ") + axis.letter;
    if (!std::isfinite(ratio)) {
      return name +
             " moves while the tip rests: no feed sets its speed, so it runs at its rate of " +
             rate(axis.rapid) + " and the block takes " + Fixed(motion.duration, 3) + " s";
    }
    return name + " would have to run at " + rate(axis.rapid * ratio) + " to hold a tip feed of " +
           feed + ", its rate is " + rate(axis.rapid) + ": the block takes " +
           Fixed(motion.duration, 3) + " s instead of " + Fixed(length / motion.facts.feed, 3) +
           " s";
  }

  const machine::Machine* machine_;
  RunFinding run_;
  double worst_ = 0.0;
};

}  // namespace

std::unique_ptr<Check> AxisSpeed(const machine::Machine& machine) {
  return std::make_unique<AxisSpeedCheck>(machine);
}

}  // namespace ncsim::checks
