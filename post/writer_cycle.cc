// SPDX-License-Identifier: BSD-3-Clause
// Hole cycles: G81 to G89 with G98 and G99, or a modal call and its positions.
#include <algorithm>
#include <cmath>

#include "post/plane_axes.h"
#include "post/writer.h"

namespace ncsim::post {
namespace {

constexpr double kNoDepth = 1e-6;  // mm

}  // namespace

void NcWriter::Handle(const ClCycleOff&) { EndCycle(); }

void NcWriter::EndCycle() {
  if (!cycle_) return;
  cycle_.reset();
  Emit(Block::kCycleEnd);
  // Where the cycle has left the axis of the tool is no word that was printed.
  for (const Value value : {Value::kX, Value::kY, Value::kZ}) printer_.Forget(value);
  printer_.Forget(Group::kMotion);
}

void NcWriter::SetHole(const PlanHole& hole) {
  const ClHoleCycle& cycle = *hole.hole.cycle;
  const double unit = data_.unit_mm(), sign = hole.negative ? -1.0 : 1.0;
  const int along = AxesOf(hole.plane).normal;
  const double point = hole.point.xyz[along];
  // A cycle that has to end at its reference does nothing: then that is where the feed begins.
  const double surface = cycle.bottom < -kNoDepth ? 0.0 : cycle.clearance;
  const bool to_clearance = hole.hole.level == ClHole::Level::kClearance;
  const double retract = to_clearance ? cycle.clearance : hole.hole.retract;
  values_.Set(Value::kHoleReference, (point + sign * surface) / unit);
  values_.Set(Value::kHoleClearance, (point + sign * cycle.clearance) / unit);
  values_.Set(Value::kHoleDistance, (cycle.clearance - surface) / unit);
  values_.Set(Value::kHoleBottom, (point + sign * cycle.bottom) / unit);
  values_.Set(Value::kHoleDepth, (surface - cycle.bottom) / unit);
  values_.Set(Value::kHoleRetract, (point + sign * retract) / unit);
  SetSteps(cycle.steps);
  values_.Clear(Value::kHolePitch);
  const double speed = values_.number(Value::kSpeed).value_or(0.0);
  if (cycle.kind == ClCycleKind::kTap && cycle.feed.per_revolution) {
    values_.Set(Value::kHolePitch, cycle.feed.value / unit);
  } else if (cycle.kind == ClCycleKind::kTap && speed > 0.0) {
    values_.Set(Value::kHolePitch, cycle.feed.value * 60.0 / speed / unit);
  }
  values_.Clear(Value::kHoleDwell);
  if (cycle.dwell > 0.0) {
    if (cycle.dwell_in_revolutions && speed <= 0.0) {
      Problem("a dwell of revolutions, and the spindle stands");
    }
    const double revolution = speed > 0.0 ? 60.0 / speed : 0.0;
    values_.Set(Value::kHoleDwell,
                cycle.dwell_in_revolutions ? cycle.dwell * revolution : cycle.dwell);
  }
  ClFeed feed = cycle.feed;
  if (feed.per_revolution && !mode_->per_revolution) {
    if (speed <= 0.0) Problem("a feed per revolution, and the spindle stands");
    feed = {feed.value * speed / 60.0, false};
  }
  SetFeed(feed, 0.0, false);

  SetPose(hole.point);
  Eigen::Vector3d bottom = hole.point.xyz;
  bottom[along] += sign * cycle.bottom;
  SetPoint(bottom);
  Want(Group::kPlane, KeyOf(hole.plane));
  Want(Group::kMotion, "rapid");
  // A modal call has its level among its arguments.
  if (!data_.modal_call) Want(Group::kReturn, to_clearance ? "clearance" : "initial");
}

void NcWriter::SetSteps(const std::vector<double>& steps) {
  for (const Value value : {Value::kHoleStep, Value::kHoleFirstStep, Value::kHoleNextStep,
                            Value::kHoleStepFall, Value::kHoleStepFactor}) {
    values_.Clear(value);
  }
  if (steps.empty()) return;
  const double unit = data_.unit_mm(), first = steps.front(), next = steps.back();
  if (first == next) {
    values_.Set(Value::kHoleStep, next / unit);
    return;
  }
  values_.Set(Value::kHoleFirstStep, first / unit);
  values_.Set(Value::kHoleNextStep, next / unit);
  values_.Set(Value::kHoleStepFall, (first - next) / unit);
  values_.Set(Value::kHoleStepFactor, next / first);
}

bool NcWriter::GoesOn(const PlanHole& hole, double level) const {
  if (!cycle_ || cycle_->cycle != hole.hole.cycle) return false;
  const bool to_clearance = hole.hole.level == ClHole::Level::kClearance;
  if (to_clearance != cycle_->to_clearance) return false;
  const double half = 0.5 * data_.Increment(Value::kZ);
  const double reference = *values_.number(Value::kHoleReference);
  const bool same_height = std::abs(reference - cycle_->reference) < half;
  if (data_.modal_call) return same_height && std::abs(level - cycle_->level) < half;
  if (!to_clearance) return std::abs(level - cycle_->level) < half;
  // The axis of the tool goes to another clearance only after the others: not where that is higher.
  const double up = hole.negative ? -1.0 : 1.0;
  return up * (level - cycle_->level) < half;
}

void NcWriter::BeginCycle(const PlanHole& hole, int along, double level) {
  const double up = hole.negative ? -1.0 : 1.0;
  const double half = 0.5 * data_.Increment(Value::kZ);
  const Eigen::Vector3d at = hole.point.xyz;
  const double level_mm = level * data_.unit_mm();
  // At its level before it goes across, and not below the level where the cycle starts.
  if (up * (here_[along] - level) < -half) {
    Eigen::Vector3d raised = pose_.xyz;
    raised[along] = level_mm;
    RapidTo(raised);
  } else if (up * (here_[along] - level) > half && hole.hole.level != ClHole::Level::kClearance) {
    Eigen::Vector3d across = at;
    across[along] = pose_.xyz[along];
    RapidTo(across);
    across[along] = level_mm;
    RapidTo(across);
  }
}

void NcWriter::Handle(const PlanHole& hole) {
  if (!positioned_) {
    Problem("a hole before the machine is positioned");
    return;
  }
  if (!mode_->cycles) {
    Problem("mode '" + mode_->name + "' has no cycles");
    return;
  }
  std::string why;
  const bool left = modal_->spindle.clockwise.has_value() && !*modal_->spindle.clockwise;
  const BlockTemplate* begin = data_.Cycle(*hole.hole.cycle, left, &why);
  if (begin == nullptr) {
    Problem(why);
    return;
  }
  const int along = AxesOf(hole.plane).normal;
  SetHole(hole);
  const double level = data_.AsPrinted(Value::kZ, *values_.number(Value::kHoleRetract));
  if (!GoesOn(hole, level)) {
    EndCycle();
    Switch();
    BeginCycle(hole, along, level);
    SetHole(hole);
    EmitTemplate(*begin, BlockPrinter::Counts::kAnything);
    cycle_ = ActiveCycle{hole.hole.cycle, hole.hole.level == ClHole::Level::kClearance, level,
                         *values_.number(Value::kHoleReference)};
    if (data_.modal_call) Emit(Block::kHole);
  } else if (!Emit(Block::kHole)) {
    Problem("a hole prints nothing: it is where the one before is");
  }
  cycle_->level = level;
  PlanPose end = hole.point;
  end.xyz[along] = level * data_.unit_mm();
  Arrive(end);
}

}  // namespace ncsim::post
