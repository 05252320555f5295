// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/to_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/arc.h"
#include "sim/motion/top_speed.h"

namespace ncsim::control {
namespace {

using motion::MotionKind;

constexpr std::uint8_t kLinearBits = 1U << kX | 1U << kY | 1U << kZ;
// A joint that would move less (mm, rad) rests: rounding of sums, far below any control's
// increment.
constexpr double kRests = 1e-9;
// Relative: rounding of a feed that is programmed to be just the axis' rate.
constexpr double kRounding = 1e-6;
// rad: an arc that is no full circle and ends this near its start is a point.
constexpr double kNoSweep = 1e-9;
// A normal that is an axis but for rounding: that axis runs along the helix.
constexpr double kAlongAxis = 1e-12;

struct Circle {
  Eigen::Vector3d centre, e1, e2, pitch, end_error;
  double radius = 0.0, sweep = 0.0;
  double Length() const { return std::hypot(radius * sweep, (pitch + end_error).norm()); }
};

// `normal` is a unit vector; counter-clockwise is seen from its tip.
Circle CircleThrough(const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                     const Eigen::Vector3d& about, const Eigen::Vector3d& normal, bool clockwise,
                     bool full) {
  Circle circle;
  circle.centre = about + normal * normal.dot(start - about);
  const Eigen::Vector3d r0 = start - circle.centre;
  circle.radius = r0.norm();
  circle.e1 = circle.radius > 0.0 ? Eigen::Vector3d(r0 / circle.radius) : normal.unitOrthogonal();
  circle.e2 = normal.cross(circle.e1);
  circle.pitch = normal * normal.dot(end - start);
  const Eigen::Vector3d r1 = end - circle.centre;
  double angle = std::atan2(r1.dot(circle.e2), r1.dot(circle.e1));
  if (full) {
    angle = clockwise ? -2.0 * kPi : 2.0 * kPi;
  } else if (std::abs(angle) < kNoSweep) {
    angle = 0.0;
  } else if (clockwise && angle > 0.0) {
    angle -= 2.0 * kPi;
  } else if (!clockwise && angle < 0.0) {
    angle += 2.0 * kPi;
  }
  circle.sweep = angle;
  circle.end_error =
      end - (circle.centre + circle.pitch +
             circle.radius * (std::cos(angle) * circle.e1 + std::sin(angle) * circle.e2));
  return circle;
}

template <typename PathType>
void CopyCircle(const Circle& circle, PathType* path) {
  path->centre = circle.centre;
  path->e1 = circle.e1;
  path->e2 = circle.e2;
  path->pitch = circle.pitch;
  path->end_error = circle.end_error;
  path->radius = circle.radius;
  path->phi0 = 0.0;
  path->sweep = circle.sweep;
}

bool IsMachine(const Command& command) {
  return command.kind == CommandKind::kMachineRapid || command.kind == CommandKind::kMachineFeed;
}
bool IsTcp(const Command& command) {
  return command.frame->rotation == Frame::Rotation::kTcp && !IsMachine(command);
}

// The linear axes that a frame moves with those named.
std::uint8_t Coupled(const Eigen::Matrix3d& linear, std::uint8_t named) {
  std::uint8_t moved = 0;
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      const bool moves = (named & 1U << from) != 0 && linear(to, from) != 0.0;
      if (moves) moved |= static_cast<std::uint8_t>(1U << to);
    }
  }
  return moved;
}

// The arc's normal in program coordinates.
Eigen::Vector3d NormalOf(const Command& command) {
  if (!command.arc_normal.isZero(0.0)) return command.arc_normal;
  return Eigen::Vector3d::Unit(AxesOf(command.plane).normal);
}

// Where a frame leads the normal of a plane: the vector that stays square to it.
Eigen::Vector3d LeadNormal(const Eigen::Matrix3d& linear, const Eigen::Vector3d& normal) {
  return (linear.inverse().transpose() * normal).normalized();
}

// The axes that the command moves: those named, and what the frame couples with them.
std::uint8_t MovingAxes(const Command& command, bool track_tcp_rapids) {
  std::uint8_t named = command.named;
  if (IsMachine(command)) return named;
  const PlaneAxes plane = AxesOf(command.plane);
  if (command.kind == CommandKind::kArc) {
    named |= static_cast<std::uint8_t>(1U << plane.first | 1U << plane.second);
    if (!command.arc_normal.isZero(0.0)) named |= kLinearBits;
  }
  const Frame& frame = *command.frame;
  if (frame.program.active) named |= Coupled(frame.program.linear, named);
  if (IsTcp(command) &&
      (command.kind != CommandKind::kRapid || track_tcp_rapids || (named & kLinearBits) != 0)) {
    named |= kLinearBits;
  }
  return named;
}

}  // namespace

ToMotion::ToMotion(const machine::Machine& machine, Frames* frames, MotionOptions options,
                   const AxisValues& start, RunSink* sink, RunLog* log, RunSummary* summary)
    : machine_(&machine),
      frames_(frames),
      options_(options),
      sink_(sink),
      log_(log),
      summary_(summary),
      q_(machine.Home()) {
  const JointVector stated = frames_->axes().Joints(start);
  for (int axis = kX; axis < kNumAxes; ++axis) {
    if (!frames_->axes().has(axis)) continue;
    q_[frames_->axes().joint(axis)] = stated[frames_->axes().joint(axis)];
  }
}

AxisValues ToMotion::position() const {
  AxisValues values = frames_->axes().Values(q_);
  for (std::size_t i = 0; i < kNumAxes; ++i) values[i] -= turns_[i];
  return values;
}

void ToMotion::Renumber(int axis, double value) {
  if (!frames_->axes().has(axis)) return;
  turns_[static_cast<std::size_t>(axis)] = q_[frames_->axes().joint(axis)] - value;
}

JointVector ToMotion::Target(const Command& command) {
  const AxisValues machine =
      IsMachine(command) ? command.end : frames_->ToMachine(command.frame, command.end);
  const std::uint8_t moving = MovingAxes(command, options_.track_tcp_rapids);
  JointVector q1 = q_;
  for (int axis = kX; axis < kNumAxes; ++axis) {
    const std::size_t i = static_cast<std::size_t>(axis);
    if ((moving & 1U << i) == 0 || !frames_->axes().has(axis)) continue;
    const int joint = frames_->axes().joint(axis);
    const double value = machine[i] + turns_[i];
    if (std::abs(value - q_[joint]) > kRests) q1[joint] = value;
  }
  return q1;
}

void ToMotion::SetFacts(const Command& command) {
  motion_.where = command.where;
  motion::Facts& facts = motion_.facts;
  facts.feed = 0.0;
  facts.tcp = IsTcp(command);
  facts.spindle_on = command.spindle_on;
  facts.brake_conflict = false;
  facts.exact_stop = command.exact_stop;
  facts.tool = command.tool;
  facts.offset = command.frame->offset_index;
  facts.cycle = command.cycle;
  facts.names_linear = !IsMachine(command) && (command.named & kLinearBits) != 0;
  facts.corner_rounding = facts.orientation_tolerance = 0.0;
  facts.wrap_note = command.wrap_note;
}

void ToMotion::Execute(const Command& command) {
  if (log_->stopped()) return;
  SetFacts(command);
  if (command.kind == CommandKind::kDwell || command.kind == CommandKind::kToolChange) {
    const bool dwell = command.kind == CommandKind::kDwell;
    motion_.path = motion::AxisLinear{q_, q_};
    motion_.duration = dwell ? command.dwell : 0.0;
    Send(command, dwell ? MotionKind::kDwell : MotionKind::kToolChange);
    return;
  }
  const JointVector q1 = Target(command);
  if (!q1.allFinite()) {
    log_->Alarm(Rule::kControlAlarm, command.where, "a position beyond what the control can hold");
    return;
  }
  const bool rapid =
      command.kind == CommandKind::kRapid || command.kind == CommandKind::kMachineRapid;
  if (!command.exact_stop && (!rapid || options_.rounds_rapids)) {
    motion_.facts.corner_rounding = command.corner_rounding;
    motion_.facts.orientation_tolerance = command.orientation_tolerance;
  }
  if (rapid) {
    if (q1 != q_) Rapid(command, q1);
    return;
  }
  const bool tcp = IsTcp(command);
  if (command.kind == CommandKind::kArc) {
    tcp ? TcpArc(command, q1) : Arc(command, q1);
  } else if (q1 != q_) {
    tcp ? TcpFeed(command, q1) : Feed(command, q1);
  }
}

void ToMotion::Rapid(const Command& command, const JointVector& q1) {
  if (IsTcp(command) && options_.track_tcp_rapids) {
    motion::TcpCurve curve;
    SetCurve(command, q1, &curve);
    motion_.path = std::move(curve);
    motion_.duration = TcpTime(motion_);
  } else {
    motion::DogLeg rapid = MakeRapid(frames_->axes(), command.rapid, q_, q1);
    motion_.duration = motion::Duration(rapid);
    motion_.path = std::move(rapid);
  }
  Send(command, MotionKind::kRapid);
}

// Length that the feed counts for the rotary axes, mm.
double ToMotion::RotaryLength(const JointVector& q1) const {
  double square = 0.0;
  for (int axis = kA; axis < kNumAxes; ++axis) {
    if (!frames_->axes().has(axis)) continue;
    const int joint = frames_->axes().joint(axis);
    const double turn = std::abs(q1[joint] - q_[joint]);
    const double diameter = options_.rotary_diameter[static_cast<std::size_t>(axis - kA)];
    const double length =
        diameter > 0.0 ? 0.5 * diameter * turn : Degrees(turn) * options_.degree_counts_as;
    square += length * length;
  }
  return std::sqrt(square);
}

// Without TCP a Haas control does not slow down for an axis: it stops with an alarm (Haas NGC Mill
// Operator's Manual 2017, G01). Where the diameter of a rotary axis is not stated, its speed is a
// guess, and the block takes longer instead. `most`: the way of each axis if it kept its top speed.
bool ToMotion::CheckRates(const Command& command, const JointVector& most, double rotary) {
  for (int axis = kC; axis >= kX; --axis) {
    if (!frames_->axes().has(axis)) continue;
    const machine::Axis& data = frames_->axes().data(axis);
    const double way = most[frames_->axes().joint(axis)];
    if (!(data.rapid > 0.0) || way <= motion_.duration * data.rapid * (1.0 + kRounding)) continue;
    const bool guessed = data.rotary && rotary > 0.0 &&
                         command.feed_mode != Command::FeedMode::kInverseTime &&
                         !(options_.rotary_diameter[static_cast<std::size_t>(axis - kA)] > 0.0);
    if (guessed || options_.slows_down) {
      motion_.duration = way / data.rapid;
      continue;
    }
    const auto rate = [&](double value) {
      return data.rotary ? Fixed(Degrees(value), 1) + " deg/s" : Fixed(60.0 * value, 0) + " mm/min";
    };
    const std::string needs = motion_.duration > 0.0 ? rate(way / motion_.duration) : "no time";
    log_->Alarm(Rule::kControlAlarm, command.where,
                std::string("maximum feed rate exceeded: axis ") + data.letter + " would need " +
                    needs + ", its rate is " + rate(data.rapid));
    return false;
  }
  return true;
}

bool ToMotion::FeedTime(const Command& command, double length, double rotary) {
  const double way = std::hypot(length, rotary);
  if (!(command.feed > 0.0)) {
    log_->Alarm(Rule::kFeedMissing, command.where, "a feed move without a feed rate");
    return false;
  }
  const bool inverse = command.feed_mode == Command::FeedMode::kInverseTime;
  motion_.duration = inverse ? 1.0 / command.feed : way / command.feed;
  motion_.facts.feed = inverse ? way * command.feed : command.feed;
  return true;
}

void ToMotion::Feed(const Command& command, const JointVector& q1) {
  const AxisMap& axes = frames_->axes();
  double square = 0.0;
  for (int axis = kX; axis <= kZ; ++axis) {
    if (!axes.has(axis)) continue;
    const double way = q1[axes.joint(axis)] - q_[axes.joint(axis)];
    square += way * way;
  }
  const double rotary = options_.rotary_follows && square > 0.0 ? 0.0 : RotaryLength(q1);
  if (!FeedTime(command, std::sqrt(square), rotary)) return;
  if (!CheckRates(command, (q1 - q_).cwiseAbs(), rotary)) return;
  motion_.path = motion::AxisLinear{q_, q1};
  Send(command, MotionKind::kFeed);
}

void ToMotion::Arc(const Command& command, const JointVector& q1) {
  const AxisMap& axes = frames_->axes();
  if (!axes.has(kX) || !axes.has(kY) || !axes.has(kZ)) {
    log_->Report(Rule::kUnsupportedCode, command.where, "an arc needs the axes X, Y and Z");
    return;
  }
  AxisValues about = command.end;
  for (std::size_t i = 0; i < 3; ++i) about[i] = command.centre[static_cast<int>(i)];
  motion::AxisArc arc;
  arc.q0 = q_;
  arc.q1 = q1;
  arc.linear = {axes.joint(kX), axes.joint(kY), axes.joint(kZ)};
  const Eigen::Matrix3d& linear = command.frame->program.linear;
  const Eigen::Vector3d normal = LeadNormal(linear, NormalOf(command));
  const bool mirrored = linear.determinant() < 0.0;
  const Circle circle = CircleThrough(Linear(axes.Values(q_)), Linear(axes.Values(q1)),
                                      Linear(frames_->ToMachine(command.frame, about)), normal,
                                      command.clockwise != mirrored, command.full_circle);
  CopyCircle(circle, &arc);
  const double rotary = options_.rotary_follows ? 0.0 : RotaryLength(q1);
  if (!FeedTime(command, circle.Length(), rotary)) return;
  JointVector most = (q1 - q_).cwiseAbs();
  for (int axis = kX; axis <= kZ; ++axis) {
    if (std::abs(normal[axis]) > 1.0 - kAlongAxis) continue;
    most[axes.joint(axis)] = std::min(circle.radius * std::abs(circle.sweep), circle.Length());
  }
  if (!CheckRates(command, most, rotary)) return;
  motion_.path = std::move(arc);
  Send(command, MotionKind::kArc);
}

void ToMotion::SetCurve(const Command& command, const JointVector& q1, motion::TcpCurve* curve) {
  curve->frame = frames_->Tcp(command.frame);
  curve->q0 = q_;
  curve->q1 = q1;
  Eigen::Vector3d u_B;
  curve->frame->control.TipInTable(q_, curve->frame->length, &curve->p0_B, &u_B);
  curve->p1_B = frames_->InTable(command.frame).Point(Linear(command.end));
  curve->centre = curve->e1 = curve->e2 = curve->pitch = curve->end_error = Eigen::Vector3d::Zero();
  if (command.orientation == Orientation::kVector) LeadToolAxis(command, curve);
}

void ToMotion::LeadToolAxis(const Command& command, motion::TcpCurve* curve) {
  using kinematics::GreatCircle;
  const std::vector<int>& rotary = curve->frame->control.rotary();
  const bool turns = std::any_of(rotary.begin(), rotary.end(),
                                 [&](int joint) { return curve->q1[joint] != q_[joint]; });
  if (!turns || rotary.size() < 2) return;
  auto circle = std::make_shared<GreatCircle>();
  const std::array<double, 2> from = {q_[rotary[0]], q_[rotary[1]]};
  const GreatCircle::Fault fault = GreatCircle::Make(
      curve->frame->control, from, {curve->q1[rotary[0]], curve->q1[rotary[1]]}, circle.get());
  if (fault == GreatCircle::Fault::kNoTurn) return;
  if (fault != GreatCircle::Fault::kNone || circle->start() != from) {
    log_->ReportOnce("great circle", Rule::kUnsupportedCode, command.where,
                     "the tool axis on a great circle from or through the pole, or to the other "
                     "solution of the rotary axes, was not simulated: taken as in proportion");
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) curve->q1[rotary[i]] = circle->end()[i];
  curve->frame->control.SolveLinear(curve->p1_B, curve->frame->length, &curve->q1);
  curve->great_circle = std::move(circle);
}

// The time that the slowest axis needs.
double ToMotion::TcpTime(const motion::Motion& motion) const {
  const JointVector most = motion::TravelAtTopSpeed(motion);
  double time = 0.0;
  for (const machine::Axis& axis : machine_->axes) {
    if (axis.rapid > 0.0) time = std::max(time, most[axis.joint] / axis.rapid);
  }
  return time;
}

void ToMotion::TcpFeed(const Command& command, const JointVector& q1) {
  motion::TcpCurve curve;
  SetCurve(command, q1, &curve);
  const double length = (curve.p1_B - curve.p0_B).norm();
  const bool turns_only = options_.rotary_follows && length < kRests;
  if (!FeedTime(command, length, turns_only ? RotaryLength(curve.q1) : 0.0)) return;
  motion_.path = std::move(curve);
  motion_.duration = std::max(motion_.duration, TcpTime(motion_));
  Send(command, MotionKind::kFeed);
}

void ToMotion::TcpArc(const Command& command, const JointVector& q1) {
  motion::TcpCurve curve;
  SetCurve(command, q1, &curve);
  const ProgramInTable& in_table = frames_->InTable(command.frame);
  const bool mirrored = in_table.linear.determinant() < 0.0;
  const Circle circle = CircleThrough(curve.p0_B, curve.p1_B, in_table.Point(command.centre),
                                      LeadNormal(in_table.linear, NormalOf(command)),
                                      command.clockwise != mirrored, command.full_circle);
  curve.arc = true;
  CopyCircle(circle, &curve);
  if (!FeedTime(command, circle.Length(), 0.0)) return;
  motion_.path = std::move(curve);
  motion_.duration = std::max(motion_.duration, TcpTime(motion_));
  Send(command, MotionKind::kArc);
}

void ToMotion::Send(const Command& command, MotionKind kind) {
  const JointVector& q1 = motion_.q1();
  if (kind == MotionKind::kFeed || kind == MotionKind::kArc) {
    int moving = 0;
    bool braked = false;
    for (int axis = kX; axis < kNumAxes; ++axis) {
      if (!frames_->axes().has(axis) ||
          q1[frames_->axes().joint(axis)] == q_[frames_->axes().joint(axis)]) {
        continue;
      }
      ++moving;
      braked = braked || (command.brakes & 1U << axis) != 0;
    }
    motion_.facts.brake_conflict = braked && (moving > 1 || kind == MotionKind::kArc);
  }
  motion_.kind = kind;
  motion_.start_time = time_;
  time_ += motion_.duration;
  q_ = q1;
  ++summary_->motions;
  summary_->motion_time = time_;
  sink_->OnMotion(motion_);
}

}  // namespace ncsim::control
