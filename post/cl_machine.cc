// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_machine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

/// Files print axes with three to ten decimals.
constexpr double kUnitTolerance = 1e-3;
constexpr double kSecondsPerMinute = 60.0;

}  // namespace

void ClMachine::Take(ClRecord&& record) {
  where_ = record.where;
  if (ended_ && !std::holds_alternative<cl::Text>(record.statement)) {
    return ErrorOnce(&said_.after_end, "a statement after FINI: what follows is not read");
  }
  const bool point = std::holds_alternative<cl::Point>(record.statement);
  if (!point && circle_ && circle_->end) CloseArc();
  if (!point && !std::holds_alternative<cl::Unknown>(record.statement)) list_ = List::kNone;
  std::visit([this](auto&& statement) { On(std::move(statement)); }, std::move(record.statement));
}

void ClMachine::ErrorAt(const SourcePosition& where, const std::string& message) {
  diagnostics_->Error(name_, where.line, where.column, message);
}

void ClMachine::ErrorOnce(bool* said, const std::string& message) {
  if (!*said) Error(message);
  *said = true;
}

void ClMachine::NeedFlavour(const std::string& what) {
  if (flavour_ != ClFlavour::kApt) return;
  ErrorOnce(&said_.flavour, what + " depends on the system that wrote the file, and nothing in " +
                                "it says which: name it (nx, creo or solidworks)");
}

std::optional<Eigen::Vector3d> ClMachine::Unit(const Eigen::Vector3d& vector,
                                               const std::string& what) {
  const double length = vector.norm();
  if (std::abs(length - 1.0) <= kUnitTolerance) return vector / length;
  Error(what + " has the length " + Short(length) + ", not 1");
  return std::nullopt;
}

std::optional<ClPose> ClMachine::PoseOf(const Eigen::Vector3d& point,
                                        const std::optional<Eigen::Vector3d>& axis) {
  if (axis) {
    const std::optional<Eigen::Vector3d> unit = Unit(*axis, "the tool axis");
    if (!unit) return std::nullopt;
    axis_ = *unit;
  } else if (flavour_ != ClFlavour::kNx) {
    if (axis_ != Eigen::Vector3d::UnitZ()) NeedFlavour("a point without a tool axis after a tilt");
    axis_ = Eigen::Vector3d::UnitZ();
  }
  return ClPose{point * scale_, axis_};
}

void ClMachine::On(cl::Goto&& to) {
  const bool rapid = rapid_;
  if (const auto pose = PoseOf(to.point, to.axis)) MoveTo(*pose);
  rapid_ = false;
  list_ = rapid ? List::kRapid : List::kMotion;
}

void ClMachine::On(cl::Point&& to) {
  if (list_ == List::kNone) return Error("a line of numbers that follows no GOTO");
  if (list_ == List::kRapid) {
    return Error("a list of points after RAPID: whether all are rapids is not settled");
  }
  if (const auto pose = PoseOf(to.point, to.axis)) MoveTo(*pose);
}

void ClMachine::On(cl::GoDelta&& by) {
  if (!pose_) return Error("GODLTA, and where the tool stands is not known");
  const Eigen::Vector3d way =
      by.along_axis ? Eigen::Vector3d(pose_->axis_M * *by.along_axis) : by.delta;
  MoveTo({pose_->tip_M + way * scale_, pose_->axis_M});
  rapid_ = false;
}

void ClMachine::On(cl::From&& from) {
  DropCircle();
  const auto pose = PoseOf(from.point, from.axis);
  if (!pose) return;
  pose_ = *pose;
  Emit(ClPosition{*pose});
}

void ClMachine::On(cl::GoHome&& home) {
  DropCircle();
  if (cycle_) Error("GOHOME inside a cycle: CYCLE/OFF is missing");
  rapid_ = false;
  if (!home.point) {
    pose_.reset();
    Emit(ClHome{std::move(home.words)});
  } else if (const auto pose = PoseOf(*home.point, home.axis)) {
    Line(*pose, true, true);
  }
}

void ClMachine::On(cl::Rapid&&) {
  if (cycle_) return Error("RAPID inside a cycle: CYCLE/OFF is missing");
  rapid_ = true;
}

ClFeed ClMachine::ToFeed(const cl::Feed& feed) {
  if (!feed.unit && !said_.feed_unit) {
    said_.feed_unit = true;
    diagnostics_->Warning(name_, where_.line, where_.column,
                          std::string("a feed rate without a unit is taken for ") +
                              (per_revolution_ ? "one per revolution" : "one per minute"));
  }
  const ClFeedUnit unit =
      feed.unit.value_or(per_revolution_ ? ClFeedUnit::kPerRev : ClFeedUnit::kPerMinute);
  switch (unit) {
    case ClFeedUnit::kMmPerMinute:
      return {feed.value / kSecondsPerMinute, false};
    case ClFeedUnit::kInchPerMinute:
      return {feed.value * kMmPerInch / kSecondsPerMinute, false};
    case ClFeedUnit::kPerMinute:
      return {feed.value * scale_ / kSecondsPerMinute, false};
    case ClFeedUnit::kMmPerRev:
      return {feed.value, true};
    case ClFeedUnit::kInchPerRev:
      return {feed.value * kMmPerInch, true};
    case ClFeedUnit::kPerRev:
      break;
  }
  return {feed.value * scale_, true};
}

void ClMachine::On(cl::Feed&& feed) {
  if (!(feed.value > 0.0)) return Error("a feed rate should be greater than 0");
  if (rapid_) Error("FEDRAT between RAPID and its motion: which of the two counts is not settled");
  feed_ = ToFeed(feed);
  per_revolution_ = feed_->per_revolution;
}

ClFeed ClMachine::FeedForMotion() {
  if (!feed_) ErrorOnce(&said_.feed, "a feed motion without a feed rate: FEDRAT is missing");
  return feed_.value_or(ClFeed{});
}

void ClMachine::MoveTo(const ClPose& pose) {
  if (circle_) return AddToArc(pose);
  if (cycle_) return Hole(pose);
  Line(pose, rapid_, false);
}

void ClMachine::Line(const ClPose& pose, bool rapid, bool home) {
  BeforeMotion();
  ClMotion motion;
  motion.rapid = rapid;
  motion.home = home;
  motion.start = pose_;
  motion.end = pose;
  if (!rapid) motion.feed = FeedForMotion();
  pose_ = pose;
  Emit(std::move(motion));
}

void ClMachine::On(cl::Circle&& circle) {
  DropCircle();
  NeedFlavour("the sense of a CIRCLE");
  const auto normal = Unit(circle.normal, "the axis of the CIRCLE");
  if (!pose_) Error("CIRCLE, and where the tool stands is not known");
  if (rapid_) Error("RAPID before a CIRCLE");
  if (cycle_) Error("CIRCLE inside a cycle: CYCLE/OFF is missing");
  rapid_ = false;
  const bool good = normal && pose_ && !cycle_;
  if (circle.radius) *circle.radius *= scale_;
  // NX names the axis about which the motion is clockwise.
  const double sense = flavour_ == ClFlavour::kNx ? -1.0 : 1.0;
  circle_.emplace(OpenCircle{
      where_,
      ClArcBuilder(pose_ ? pose_->tip_M : Eigen::Vector3d::Zero(), circle.centre * scale_,
                   sense * normal.value_or(Eigen::Vector3d::UnitZ()), circle.radius, circle.times),
      !good,
      {}});
}

void ClMachine::AddToArc(const ClPose& pose) {
  std::string error;
  if (!circle_->broken && !circle_->builder.Add(pose.tip_M, &error)) {
    circle_->broken = true;
    Error(error);
  }
  circle_->end = pose;
}

void ClMachine::CloseArc() {
  const OpenCircle circle = std::move(*circle_);
  circle_.reset();
  ClMotion motion;
  motion.start = pose_;
  motion.end = *circle.end;
  pose_ = *circle.end;
  std::string error;
  if (!circle.broken) motion.arc = circle.builder.Finish(&error);
  if (!error.empty()) ErrorAt(circle.where, error);
  if (!motion.arc) return;
  BeforeMotion();
  motion.feed = FeedForMotion();
  EmitAt(circle.where, std::move(motion));
}

void ClMachine::DropCircle() {
  if (circle_) ErrorAt(circle_->where, "no GOTO follows the CIRCLE");
  circle_.reset();
}

void ClMachine::ReadDepth(const cl::Cycle& cycle, ClHoleCycle* hole_cycle) {
  NeedFlavour("the sign of a CYCLE's depth");
  hole_cycle->clearance = *cycle.clearance * scale_;
  if (flavour_ == ClFlavour::kNx) {
    hole_cycle->bottom = *cycle.depth * scale_;
  } else {
    if (*cycle.depth < 0.0) Error("the depth of a CYCLE should not be negative");
    hole_cycle->bottom = -*cycle.depth * scale_;
  }
  if (hole_cycle->clearance < hole_cycle->bottom)
    Error("the clearance of the CYCLE lies below its bottom");
}

void ClMachine::On(cl::Cycle&& cycle) {
  DropCircle();
  auto hole_cycle = std::make_shared<ClHoleCycle>();
  hole_cycle->kind = cycle.kind;
  hole_cycle->where = where_;
  ReadDepth(cycle, hole_cycle.get());
  if (cycle.feed && !(cycle.feed->value > 0.0)) Error("a feed rate should be greater than 0");
  hole_cycle->feed = cycle.feed ? ToFeed(*cycle.feed) : FeedForMotion();
  for (const double step : cycle.steps) hole_cycle->steps.push_back(step * scale_);
  hole_cycle->dwell = cycle.dwell.value_or(0.0);
  hole_cycle->dwell_in_revolutions = cycle.dwell_in_revolutions;
  if (cycle.sink_diameter) hole_cycle->sink_diameter = *cycle.sink_diameter * scale_;
  switch (cycle.retract) {
    case cl::Cycle::Retract::kUnstated:
      level_ = ClHole::Level::kClearance;
      break;
    case cl::Cycle::Retract::kAuto:
      level_ = ClHole::Level::kInitial;
      break;
    case cl::Cycle::Retract::kDistance:
      level_ = ClHole::Level::kDistance;
      break;
  }
  retract_ = cycle.retract_distance * scale_;
  if (level_ == ClHole::Level::kDistance && retract_ < hole_cycle->bottom) {
    Error("the CYCLE retracts to below its bottom");
  }
  initial_ = pose_;
  cycle_ = last_cycle_ = std::move(hole_cycle);
}

void ClMachine::On(cl::CycleSwitch&& what) {
  switch (what.what) {
    case cl::CycleSwitch::What::kOff:
      cycle_.reset();
      return Emit(ClCycleOff{});
    case cl::CycleSwitch::What::kOn:
      if (!last_cycle_) return Error("CYCLE/ON, and no cycle before it");
      initial_ = pose_;
      cycle_ = last_cycle_;
      return;
    case cl::CycleSwitch::What::kInit:
    case cl::CycleSwitch::What::kClear:
      // The cycle that follows names its retract itself.
      return;
  }
}

void ClMachine::Hole(const ClPose& pose) {
  BeforeMotion();
  ClHole hole;
  hole.cycle = cycle_;
  hole.start = pose_;
  hole.point = pose;
  hole.level = level_;
  hole.retract = level_ == ClHole::Level::kDistance ? retract_ : cycle_->clearance;
  if (level_ == ClHole::Level::kInitial && initial_) {
    const double height = pose.axis_M.dot(initial_->tip_M - pose.tip_M);
    hole.retract = std::max(height, cycle_->clearance);
  }
  pose_ = ClPose{pose.tip_M + pose.axis_M * hole.retract, pose.axis_M};
  Emit(std::move(hole));
}

}  // namespace ncsim::post
