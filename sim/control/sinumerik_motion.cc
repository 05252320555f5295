// SPDX-License-Identifier: BSD-3-Clause
// Motion: G0-G3, CIP, CT, AC IC DC ACP ACN, polar coordinates, G4, G74 (NC programming 12/2019,
// "Motion commands").
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/arc.h"
#include "sim/control/sinumerik_interpreter.h"

namespace ncsim::control {
namespace {

using Modifier = nc::SinumerikModifier;

constexpr double kTurn = 360.0;
// deg: a modulo axis this near to the end of a turn stands at its end.
constexpr double kSameAngle = 1e-7;
// Beyond this TURN= is a mistake (NC programming 12/2019, p. 205).
constexpr double kMaxTurns = 999.0;

}  // namespace

/// G4 and what approaches a point of the machine: alone in the block.
void SinumerikInterpreter::ExecuteAction(const SinumerikItem& item) {
  item.command->name == "G4" ? Dwell() : MachinePoint(item);
}

void SinumerikInterpreter::Dwell() {
  const bool seconds = Peek("F") != nullptr;
  if (!seconds && Peek("S") == nullptr) {
    Alarm(step_->where, 12080, "G4 needs F or S");
    return;
  }
  const SinumerikItem* item = Take(seconds ? "F" : "S");
  if (item == nullptr) return;
  double time = std::max(0.0, item->value);
  if (!seconds) time = rpm_ > 0.0 ? 60.0 * time / rpm_ : 0.0;
  command_.kind = CommandKind::kDwell;
  command_.dwell = time;
  command_.end = position_;
  contour_.Push(command_);
}

/// G74 X=0 Y=0: to the reference point of each axis that is named; G75 FP=1 X=0 Y=0 to a fixed
/// point (MD30600).
void SinumerikInterpreter::MachinePoint(const SinumerikItem& item) {
  const std::string name(item.command->name);
  if (traori_) {
    Alarm(step_->where, 16918, name + " for axes of an active transformation");
    return;
  }
  const bool fixed = name == "G75";
  double point = 1.0;
  if (fixed && Peek("FP") != nullptr) {
    const SinumerikItem* number = Take("FP");
    if (number == nullptr) return;
    point = number->value;
  }
  if (!(point >= 1.0 && point <= kNumFixedPoints) || point != std::floor(point)) {
    Alarm(step_->where, 12160, "FP=" + Short(point) + " is no fixed point");
    return;
  }
  const auto& fixed_point = settings_.fixed_points[static_cast<std::size_t>(point) - 1];
  AxisValues target{};
  unsigned named = 0;
  for (int axis = kX; axis < kNumAxes; ++axis) {
    const std::size_t i = static_cast<std::size_t>(axis);
    const std::string machine_axis = {kLetters[i], '1'};
    for (const std::string& word : {std::string(1, kLetters[i]), machine_axis}) {
      if (!axes_.has(axis) || Peek(word) == nullptr) continue;
      if (Take(word) == nullptr) return;
      if (fixed && !fixed_point[i]) {
        return Unsupported("G75 without MD30600 of " + word.substr(0, 1), step_->where);
      }
      named |= 1U << axis;
      target[i] = fixed ? *fixed_point[i] : axes_.data(axis).home;
    }
  }
  if (!fixed) log_.Assume("reference point", "G74 goes to the model's home position", false);
  PushMachine(CommandKind::kMachineRapid, named, target);
}

void SinumerikInterpreter::PushMachine(CommandKind kind, unsigned named, const AxisValues& target) {
  if (log_.stopped()) return;
  contour_.Flush();
  command_.kind = kind;
  command_.named = static_cast<std::uint8_t>(named);
  command_.end = target;
  contour_.Push(command_);
  position_ = parts_.frames->ToProgram(frame_, parts_.to_motion->position());
  contour_.SetPosition(position_);
}

/// POS[X]=10 [FA[X]=500], alone in its block: a line. More axes would go each at its own rate; what
/// stands beside it is left over, and said. POSA[X]=10 is under way until WAITP(X): what moves
/// before is not followed.
void SinumerikInterpreter::PositionAxis() {
  const bool across = Peek("POS") == nullptr;
  SinumerikItem* item = Peek(across ? "POSA" : "POS");
  item->used = true;
  const bool indexed = item->value_count == 1 && !item->is_text;
  const std::string name = indexed ? step_->values[item->first_value].text : "";
  const std::size_t i = name.size() == 1 ? kLetters.find(name[0]) : kLetters.npos;
  if (i >= kNumAxes || !axes_.has(static_cast<int>(i))) {
    return Unsupported("POS", Where(*item), "it names no axis of this machine");
  }
  if (traori_) return Unsupported("POS under TRAORI", Where(*item));
  const int axis = static_cast<int>(i);
  AxisValues end = position_;
  if (!(axes_.data(axis).rotary ? RotaryTarget(axis, *item, &end[i])
                                : LinearTarget(axis, *item, &end[i]))) {
    return;
  }
  carry_[i] = 0.0;
  if (axis <= kZ) BeforeLinearMotion();
  if (log_.stopped()) return;
  const SinumerikItem* feed = Peek("FA") == nullptr ? nullptr : Take("FA");
  command_.kind = feed != nullptr && feed->value > 0.0 ? CommandKind::kFeed : CommandKind::kRapid;
  if (command_.kind == CommandKind::kFeed) {
    command_.feed_mode = Command::FeedMode::kPerMinute;
    command_.feed = feed->value * feed_mm_ / 60.0;
  }
  command_.end = end;
  command_.named = static_cast<std::uint8_t>(1U << axis);
  Push();
  if (across) {
    contour_.Flush();
    under_way_ |= 1U << axis;
  }
  moved_ = false;  // No path motion: a modal call does not follow it.
}

void SinumerikInterpreter::ExecuteMotion() {
  if (Peek("POS") != nullptr || Peek("POSA") != nullptr) return PositionAxis();
  const bool suppressed = suppress_ != nullptr;
  if (suppressed) {
    if (!Is(kSinComp, "G40")) Unsupported(suppress_->name, step_->where, "with G41 or G42 active");
    if (swivel_.active && suppress_->name == "G53") {
      Unsupported("G53 while CYCLE800 is active", step_->where,
                  "it leaves the rotation of the tables (PAROT) in force");
    }
    UseFrame(SuppressedFrame());
    command_.frame = frame_;
  }
  AxisValues end = position_;
  unsigned named = 0;
  SinumerikArcWords arc;
  const bool is_line = motion_ == MotionMode::kRapid || motion_ == MotionMode::kLine ||
                       motion_ == MotionMode::kThread;
  const bool is_arc = !is_line;
  if (is_arc) TakePole(&arc);
  const bool go = TakeTargets(&end, &named) && TakePolar(&end, &named) &&
                  (!is_arc || TakeArcWords(&arc)) &&
                  TakeOrientation(is_arc ? &arc : nullptr, &end, &named) && TakePitch();
  constexpr unsigned kAside = 1U << kX | 1U << kY;
  if (tool_frame() && !suppressed && ((named & kAside) != 0 || is_arc)) {
    Unsupported("X, Y or an arc under TOROT", step_->where,
                "where X points is not known (SD42980)");
  }
  const bool has_arc_words =
      is_arc && (arc.centre[0] || arc.centre[1] || arc.centre[2] || arc.angle);
  if (go && (named != 0 || has_arc_words)) {
    arc.end_named = (named & kLinearAxes) != 0;
    command_.end = end;
    if ((named & kLinearAxes) != 0 || is_arc) BeforeLinearMotion();
    if (!log_.stopped() && (motion_ == MotionMode::kRapid || CheckFeed())) {
      is_arc ? MoveOnArc(arc) : Move(end, named);
    }
  }
  if (suppressed && !log_.stopped()) UseFrame(MakeFrame());
}

bool SinumerikInterpreter::TakeTargets(AxisValues* end, unsigned* named) {
  for (SinumerikItem& item : step_->items) {
    if (item.kind != SinumerikItemKind::kWord || item.used || item.letter == 0) continue;
    const std::size_t i = kLetters.find(item.letter);
    if (i >= kNumAxes || item.extension >= 0 || !axes_.has(static_cast<int>(i))) continue;
    item.used = true;
    if (item.is_text) return Alarm(Where(item), 12150, "an axis needs a number");
    const int axis = static_cast<int>(i);
    double value = 0.0;
    if (!(axes_.data(axis).rotary ? RotaryTarget(axis, item, &value)
                                  : LinearTarget(axis, item, &value))) {
      return false;
    }
    (*end)[i] = value;
    carry_[i] = 0.0;
    carry_turned_[i] = false;
    *named |= 1U << axis;
  }
  return true;
}

bool SinumerikInterpreter::LinearTarget(int axis, const SinumerikItem& item, double* value) {
  const std::size_t i = static_cast<std::size_t>(axis);
  const double programmed = item.value * mm_;
  const bool adds =
      item.modifier == Modifier::kIc || (item.modifier == Modifier::kNone && incremental_);
  switch (item.modifier) {
    case Modifier::kNone:
    case Modifier::kAc:
    case Modifier::kIc:
      if (adds && carry_turned_[i] && carry_[i] != 0.0) {
        Unsupported("an incremental move behind a turn of the frame", Where(item),
                    "whether it goes from the old or the new coordinates is not known");
      }
      *value = adds ? position_[i] + carry_[i] + programmed : programmed;
      return true;
    case Modifier::kDc:
      return Alarm(Where(item), 16800, "DC for an axis that is no modulo axis");
    case Modifier::kAcp:
      return Alarm(Where(item), 16810, "ACP for an axis that is no modulo axis");
    case Modifier::kAcn:
      return Alarm(Where(item), 16820, "ACN for an axis that is no modulo axis");
    case Modifier::kCoded:
    case Modifier::kOutput:
      break;
  }
  Unsupported("a coded position", Where(item));
  *value = position_[i];
  return true;
}

bool SinumerikInterpreter::RotaryTarget(int axis, const SinumerikItem& item, double* value) {
  const std::size_t i = static_cast<std::size_t>(axis);
  const bool adds =
      item.modifier == Modifier::kIc || (item.modifier == Modifier::kNone && incremental_);
  if (adds) {
    *value = position_[i] + carry_[i] + Radians(item.value);
    return true;
  }
  if (settings_.rotary[i - kA].modulo && item.modifier != Modifier::kCoded &&
      item.modifier != Modifier::kOutput) {
    return ModuloTarget(axis, item, value);
  }
  if (item.modifier == Modifier::kNone || item.modifier == Modifier::kAc) {
    *value = Radians(item.value);
    return true;
  }
  return LinearTarget(axis, item, value);
}

/// The turn on which a modulo axis gets to a position (MD30455): AC and a plain position stay
/// within the turn, unless bit 2 makes a plain position go the shortest way.
bool SinumerikInterpreter::ModuloTarget(int axis, const SinumerikItem& item, double* value) {
  const std::size_t i = static_cast<std::size_t>(axis);
  const SinumerikSettings::RotaryAxis& data = settings_.rotary[i - kA];
  const Modifier modifier =
      item.modifier == Modifier::kNone && data.shortest ? Modifier::kDc : item.modifier;
  double target = item.value;
  if (data.folds) target -= kTurn * std::floor(target / kTurn);
  const bool plain = item.modifier == Modifier::kNone || item.modifier == Modifier::kAc;
  if (!(target >= 0.0 && (target < kTurn || (plain && target == kTurn)))) {
    return Alarm(Where(item), 16830,
                 std::string(1, kLetters[i]) + Short(item.value, 5) +
                     " is beyond 0 to 360 of the modulo axis (MD30455 bit 0 = 0)");
  }
  const double here = Degrees(position_[i]);
  double turns = std::floor((here + kSameAngle) / kTurn);
  if (modifier == Modifier::kDc) turns = std::floor((here - target) / kTurn + 0.5);
  const double same_turn = target + kTurn * std::floor((here - target) / kTurn);
  if (modifier == Modifier::kAcp || modifier == Modifier::kAcn) {
    const bool stays = std::abs(std::remainder(here - target, kTurn)) <= kSameAngle;
    turns = std::round((same_turn - target) / kTurn);
    if (stays) turns = std::round((here - target) / kTurn);
    if (!stays && modifier == Modifier::kAcp) turns += 1.0;
  }
  *value = Radians(target) + 2.0 * kPi * turns;
  return true;
}

/// AP= and RP=, about the pole; what is not programmed is where the position is.
bool SinumerikInterpreter::TakePolar(AxisValues* end, unsigned* named) {
  if (Peek("AP") == nullptr && Peek("RP") == nullptr) return true;
  const PlaneAxes plane = AxesOf(plane_);
  const std::size_t first = static_cast<std::size_t>(plane.first);
  const std::size_t second = static_cast<std::size_t>(plane.second);
  if ((*named & (1U << first | 1U << second)) != 0) {
    return Alarm(step_->where, 12080, "AP= or RP= beside an axis of the plane");
  }
  const Eigen::Vector2d from = Eigen::Vector2d(position_[first], position_[second]) - pole_;
  double angle = std::atan2(from.y(), from.x());
  double radius = from.norm();
  if (Peek("AP") != nullptr) {
    const SinumerikItem* item = Take("AP");
    if (item == nullptr) return false;
    angle = Radians(item->value) + (item->modifier == Modifier::kIc ? angle : 0.0);
  }
  if (Peek("RP") != nullptr) {
    const SinumerikItem* item = Take("RP");
    if (item == nullptr) return false;
    radius = item->value * mm_ + (item->modifier == Modifier::kIc ? radius : 0.0);
  }
  (*end)[first] = pole_.x() + radius * std::cos(angle);
  (*end)[second] = pole_.y() + radius * std::sin(angle);
  carry_[first] = carry_[second] = 0.0;
  *named |= 1U << first | 1U << second;
  return true;
}

/// G2 or G3 with AP= or RP= and no centre goes about the pole.
void SinumerikInterpreter::TakePole(SinumerikArcWords* words) {
  const bool circle = motion_ == MotionMode::kClockwise || motion_ == MotionMode::kCounterClockwise;
  if (!circle || (Peek("AP") == nullptr && Peek("RP") == nullptr)) return;
  for (const std::string_view name : {"I", "J", "K", "CR", "AR"}) {
    if (Peek(name) != nullptr) return;
  }
  const PlaneAxes plane = AxesOf(plane_);
  words->centre[static_cast<std::size_t>(plane.first)] = pole_.x();
  words->centre[static_cast<std::size_t>(plane.second)] = pole_.y();
}

/// G33, G331, G332: the pitch I, J, K of the thread times the spindle's speed is the feed. With
/// G331 and G332 the control turns the spindle itself; a negative pitch turns it the other way.
bool SinumerikInterpreter::TakePitch() {
  if (motion_ != MotionMode::kThread) return true;
  double pitch = 0.0;
  for (const std::string_view letter : {"I", "J", "K"}) {
    if (Peek(letter) == nullptr) continue;
    const SinumerikItem* item = Take(letter);
    if (item == nullptr) return false;
    pitch = std::max(pitch, std::abs(item->value * mm_));
  }
  const bool rigid = !Is(kSinMotion, "G33");
  command_.feed_mode = Command::FeedMode::kPerRevolution;
  command_.feed = pitch * rpm_ / 60.0;
  command_.spindle_on = rpm_ > 0.0 && (rigid || spindle_ != 0);
  command_.exact_stop = true;
  return true;
}

bool SinumerikInterpreter::TakeArcWords(SinumerikArcWords* words) {
  words->clockwise = motion_ == MotionMode::kClockwise;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string_view letter = std::string_view("IJK").substr(i, 1);
    if (Peek(letter) == nullptr) continue;
    const SinumerikItem* item = Take(letter);
    if (item == nullptr) return false;
    const double start = item->modifier == Modifier::kAc ? 0.0 : position_[i];
    words->centre[i] = start + item->value * mm_;
  }
  const auto number = [&](std::string_view name, double unit, std::optional<double>* value) {
    if (Peek(name) == nullptr) return;
    if (const SinumerikItem* item = Take(name)) *value = item->value * unit;
  };
  number("CR", mm_, &words->radius);
  number("AR", kPi / 180.0, &words->angle);
  if (motion_ == MotionMode::kTangent) words->tangent = tangent_;
  if (motion_ != MotionMode::kThroughPoint) return !log_.stopped();
  Eigen::Vector3d through(position_[kX], position_[kY], position_[kZ]);
  for (int i = 0; i < 3; ++i) {
    const std::string name = {"IJK"[i], '1'};
    if (Peek(name) == nullptr) continue;
    const SinumerikItem* item = Take(name);
    if (item == nullptr) return false;
    const bool adds =
        item->modifier == Modifier::kIc || (item->modifier == Modifier::kNone && incremental_);
    through[i] = item->value * mm_ + (adds ? through[i] : 0.0);
  }
  words->through = through;
  return !log_.stopped();
}

bool SinumerikInterpreter::CheckFeed() {
  if (tool_ == 0 && !no_tool_reported_) {
    no_tool_reported_ = true;
    log_.Report(Rule::kToolMissing, step_->where, "a feed move with no tool in the spindle");
  }
  const bool inverse = command_.feed_mode == Command::FeedMode::kInverseTime;
  if (command_.feed > 0.0 && (!inverse || feed_in_block_)) return true;
  std::string message = "a feed move without F (alarm 10860)";
  if (inverse) message = "G93 needs F in every block that feeds (alarm 10860)";
  if (motion_ == MotionMode::kThread) {
    message =
        std::string(modal_.codes[kSinMotion]->name) + " needs a pitch I, J or K and a speed S";
  } else if (feed_word_ > 0.0 && !inverse) {
    message = "feed per revolution with the spindle speed 0";
  }
  log_.Alarm(Rule::kFeedMissing, step_->where, std::move(message));
  return false;
}

void SinumerikInterpreter::Move(const AxisValues& end, unsigned named) {
  command_.kind = motion_ == MotionMode::kRapid ? CommandKind::kRapid : CommandKind::kFeed;
  command_.end = end;
  command_.named = static_cast<std::uint8_t>(named);
  if (motion_ == MotionMode::kLine && !TakeCorner()) return;
  const Eigen::Vector3d way(end[kX] - position_[kX], end[kY] - position_[kY],
                            end[kZ] - position_[kZ]);
  Push();
  if (!way.isZero(0.0)) tangent_ = way;
}

/// WAITP(X): the axes are where POSA has sent them.
void SinumerikInterpreter::WaitForAxes(std::span<const nc::SinumerikValue> axes) {
  for (const nc::SinumerikValue& axis : axes) {
    const std::size_t i = axis.text.size() == 1 ? kLetters.find(axis.text[0]) : kLetters.npos;
    if (i < kNumAxes) under_way_ &= ~(1U << i);
  }
}

/// What is inserted between this line and the next one; RNDM rounds where nothing else is asked
/// for.
bool SinumerikInterpreter::TakeCorner() {
  const auto length = [&](std::string_view name, double* value) {
    if (Peek(name) == nullptr) return;
    if (const SinumerikItem* item = Take(name)) *value = std::max(0.0, item->value * mm_);
  };
  length("RND", &command_.corner_radius);
  length("CHR", &command_.corner_chamfer);
  length("CHF", &command_.corner_chamfer_length);
  if (modal_rounding_ == 0.0) return !log_.stopped();
  if (command_.corner_radius + command_.corner_chamfer + command_.corner_chamfer_length > 0.0) {
    Unsupported("RND, CHR or CHF under RNDM", step_->where, "which of them the control takes");
  }
  const PlaneAxes plane = AxesOf(plane_);
  for (const int axis : {plane.first, plane.second}) {
    const std::size_t i = static_cast<std::size_t>(axis);
    if (command_.end[i] != position_[i]) command_.corner_radius = modal_rounding_;
  }
  return !log_.stopped();
}

/// TURN= makes that many circles before, the other axes in proportion.
void SinumerikInterpreter::MoveOnArc(const SinumerikArcWords& words) {
  double turns = 0.0;
  if (Peek("TURN") != nullptr) {
    const SinumerikItem* item = Take("TURN");
    if (item == nullptr) return;
    turns = std::floor(item->value);
    if (!(turns >= 0.0 && turns <= kMaxTurns)) {
      Alarm(Where(*item), 12160, "TURN= is not 0 to 999");
      return;
    }
  }
  const AxisValues start = position_;
  const bool led = traori_ && command_.orientation == Orientation::kVector;
  if (turns > 0.0 && led && RotaryJoints(start) != RotaryJoints(command_.end)) {
    Unsupported("TURN= while the tool vector turns", step_->where);
  }
  const std::string error = MakeSinumerikArc(
      start, words, {settings_.circle_error, settings_.circle_error_factor}, &command_);
  if (!error.empty()) {
    log_.Alarm(Rule::kArcError, step_->where, error);
    return;
  }
  if (!CheckArcFrame()) return;
  unsigned named = 0;
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    if (command_.end[i] != start[i]) named |= 1U << i;
  }
  const PlaneAxes plane = AxesOf(plane_);
  named |= 1U << plane.first | 1U << plane.second;
  command_.named = static_cast<std::uint8_t>(named);
  const Command last = command_;
  const Arc arc = ArcOf(start, last);
  const double all = std::abs(arc.sweep) + 2.0 * kPi * turns;
  for (double turn = 1.0; turn <= turns && !log_.stopped(); turn += 1.0) {
    for (std::size_t i = 0; i < kNumAxes; ++i) {
      command_.end[i] = start[i] + (last.end[i] - start[i]) * (2.0 * kPi * turn / all);
    }
    for (const int axis : {plane.first, plane.second}) {
      command_.end[static_cast<std::size_t>(axis)] = start[static_cast<std::size_t>(axis)];
    }
    command_.full_circle = true;
    Push();
  }
  if (log_.stopped()) return;
  command_ = last;
  Push();
  tangent_ = EndTangent(last);
}

/// False: an arc that is none any more in this frame, and it has been said.
bool SinumerikInterpreter::CheckArcFrame() {
  const Eigen::Matrix3d& linear = frame_->program.linear;
  const Eigen::Matrix3d square = linear.transpose() * linear;
  constexpr double kRounding = 1e-12;
  const bool similar =
      (square - Eigen::Matrix3d::Identity() * square(0, 0)).norm() <= kRounding * square(0, 0);
  const bool flat = !command_.arc_normal.isZero(0.0);
  if (similar && !(flat && command_.comp != Command::Comp::kOff)) return true;
  Unsupported(similar ? "CIP with G41 or G42" : "an arc with different scales of the axes",
              step_->where);
  log_.Stop();
  return false;
}

void SinumerikInterpreter::Push() {
  const bool compensates = command_.comp != Command::Comp::kOff;
  if (compensates && edge_ == 0) {
    Alarm(step_->where, 10750, "G41 or G42 without an edge D");
    return;
  }
  if (compensates && (traori_ || plane_ != Plane::kXY)) {
    Unsupported("G41 or G42 outside G17, or under TRAORI", step_->where);
    command_.comp = Command::Comp::kOff;
  }
  if (traori_ && command_.orientation == Orientation::kVector) PassPole();
  if (log_.stopped()) return;
  contour_.Push(command_);
  position_ = command_.end;
  moved_ = true;
  const bool led = traori_ && command_.orientation == Orientation::kVector;
  if (!led || (command_.named & ~kLinearAxes) == 0) return;
  // Where the great circle has led the rotary axes to.
  const AxisValues machine = parts_.to_motion->position();
  for (std::size_t i = kA; i < kNumAxes; ++i) position_[i] = machine[i] - frame_->offset[i];
}

}  // namespace ncsim::control
