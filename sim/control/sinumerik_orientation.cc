// SPDX-License-Identifier: BSD-3-Clause
// The tool's orientation under TRAORI: A3 B3 C3, A2 B2 C2, and how it goes from block to block (NC
// programming 12/2019, "Tool orientation"; MD21100 to MD21108, MD21180, MD24540).
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kinematics/great_circle.h"
#include "kinematics/reachable.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/sinumerik_interpreter.h"
#include "sim/control/sinumerik_lead_tilt.h"

namespace ncsim::control {
namespace {

// A vector as programmed has a direction.
constexpr double kNoVector = 1e-9;
// rad: an orientation that is the pole, and a rotary axis on its limit.
constexpr double kSame = 1e-9;
// An arc that leaves its plane by no more, for each mm of its chord, is no helix.
constexpr double kFlat = 1e-9;
constexpr std::string_view kWrapNote =
    "; what decides is machine data: MD21104 = 1 with ORIAXES and MD30455 bit 2 = 0, as here, "
    "turns "
    "the modulo axis back within 0 to 360 deg; MD30455 bit 2 = 1 takes the shortest way on; "
    "MD21104 "
    "= 0 with ORIWKS interpolates the tool vector, and the axis goes on past 360 deg";

}  // namespace

/// MD21104 = 1: group 51 decides; else ORIWKS goes along the vector, ORIMKS by the axes.
bool SinumerikInterpreter::vector_path() const {
  if (!traori_) return false;
  if (settings_.orientation_by_g51) return !Is(kSinOrientationPath, "ORIAXES");
  return Is(kSinOrientationSystem, "ORIWKS");
}

std::string_view SinumerikInterpreter::WrapNote() const {
  const auto turns_back = [&](int axis) {
    const SinumerikSettings::RotaryAxis& data = settings_.rotary[static_cast<std::size_t>(axis)];
    return data.modulo && !data.shortest;
  };
  const bool any = turns_back(0) || turns_back(1) || turns_back(2);
  return traori_ && any && !vector_path() ? kWrapNote : std::string_view();
}

/// A3 B3 C3 for '3' and so on; what is not programmed is 0.
std::optional<Eigen::Vector3d> SinumerikInterpreter::TakeTriple(char digit) {
  std::optional<Eigen::Vector3d> values;
  for (int i = 0; i < 3; ++i) {
    const std::string name = {"ABC"[i], digit};
    if (Peek(name) == nullptr) continue;
    const SinumerikItem* item = Take(name);
    if (item == nullptr) return std::nullopt;
    if (!values) values = Eigen::Vector3d::Zero();
    (*values)[i] = item->value;
  }
  return values;
}

/// The tool axis (tip to holder) of A3 B3 C3 or A2 B2 C2, in program coordinates; not of length 1.
std::optional<Eigen::Vector3d> SinumerikInterpreter::TakeToolAxis() {
  if (const std::optional<Eigen::Vector3d> vector = TakeTriple('3')) return vector;
  const std::optional<Eigen::Vector3d> angles = TakeTriple('2');
  if (!angles) return std::nullopt;
  bool euler = settings_.orientation_euler;
  if (settings_.orientation_by_g50) {
    euler = Is(kSinOrientationAngles, "ORIEULER");
    if (!euler && !Is(kSinOrientationAngles, "ORIRPY")) {
      const std::string_view code = modal_.codes[kSinOrientationAngles]->name;
      Unsupported("A2, B2, C2 with " + std::string(code), step_->where,
                  "what it makes of the angles is not known");
    }
  }
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const double a = Radians((*angles)[0]), b = Radians((*angles)[1]), c = Radians((*angles)[2]);
  if (euler) {
    return AngleAxisd(a, Vector3d::UnitZ()) * AngleAxisd(b, Vector3d::UnitX()) * Vector3d::UnitZ();
  }
  return AngleAxisd(c, Vector3d::UnitZ()) * AngleAxisd(b, Vector3d::UnitY()) *
         AngleAxisd(a, Vector3d::UnitX()) * Vector3d::UnitZ();
}

/// A4 B4 C4 at the start of a block, which its end keeps, or A5 B5 C5 at its end; kept by later
/// blocks.
void SinumerikInterpreter::TakeSurfaceNormal() {
  for (const char digit : {'4', '5'}) {
    const std::optional<Eigen::Vector3d> normal = TakeTriple(digit);
    if (normal) surface_normal_ = *normal;
  }
}

/// The path's direction at the end of the line or arc to `end`; nullopt: it has none, or a helix.
std::optional<Eigen::Vector3d> SinumerikInterpreter::WayAt(const SinumerikArcWords* arc,
                                                           const AxisValues& end) const {
  const Eigen::Vector3d way(end[kX] - position_[kX], end[kY] - position_[kY],
                            end[kZ] - position_[kZ]);
  if (motion_ == MotionMode::kThread) return std::nullopt;
  if (arc == nullptr) return way.isZero(0.0) ? std::nullopt : std::optional(way);
  Command command = command_;
  command.end = end;
  SinumerikArcWords words = *arc;
  words.end_named = !way.isZero(0.0);
  const CircleTolerance tolerance = {settings_.circle_error, settings_.circle_error_factor};
  if (!MakeSinumerikArc(position_, words, tolerance, &command).empty()) return std::nullopt;
  const Eigen::Vector3d chord(command.end[kX] - position_[kX], command.end[kY] - position_[kY],
                              command.end[kZ] - position_[kZ]);
  if (command.kind != CommandKind::kArc) return chord;  // CT, straight on.
  const bool flat = std::abs(chord.dot(ArcNormal(command))) <= kFlat * (1.0 + chord.norm());
  return flat ? std::optional(EndTangent(command)) : std::nullopt;
}

/// LEAD and TILT: against the surface's normal (Z where none is programmed), along the path at
/// `end`.
std::optional<Eigen::Vector3d> SinumerikInterpreter::TakeLeaning(const SinumerikArcWords* arc,
                                                                 const AxisValues& end) {
  const std::optional<Eigen::Vector3d> way = WayAt(arc, end);
  const bool along = Is(kSinOrientationPath, "ORIPATH");
  std::array<bool, 2> named{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string_view name = i == 0 ? "LEAD" : "TILT";
    named.at(i) = Peek(name) != nullptr;
    if (!named.at(i)) continue;
    const SinumerikItem* item = Take(name);
    if (item == nullptr) return std::nullopt;
    leaning_.at(i) = Radians(item->value);
  }
  const bool any = named[0] || named[1];
  const auto unsupported = [this](std::string_view name, const std::string& why = "") {
    Unsupported(name, step_->where, why);
    return std::nullopt;
  };
  if (!any && (!along || !traori_ || (!way && arc == nullptr))) return std::nullopt;
  if ((!named[0] && leaning_[0] != 0.0) || (!named[1] && leaning_[1] != 0.0) || !any) {
    return unsupported("a block with ORIPATH, LEAD or TILT that does not state both angles",
                       "whether the ones before stay is not known");
  }
  if (!traori_) return unsupported("LEAD or TILT without TRAORI");
  if (!Is(kSinOrientationSystem, "ORIWKS")) return unsupported("LEAD or TILT with ORIMKS");
  if (!way) {
    return unsupported("LEAD or TILT in a block that is neither a line nor a flat arc",
                       "it has no path tangent here");
  }
  const int order = settings_.leaning_mode / 10 % 10;
  if (order > static_cast<int>(LeanOrder::kTiltThenLeadAboutTurnedSide) ||
      (along && settings_.leaning_mode % 10 != 0)) {
    return unsupported("MD21094 = " + std::to_string(settings_.leaning_mode),
                       "how LEAD and TILT hold along the path");
  }
  constexpr std::string_view kSense = ": the manual draws its sense and does not state it";
  if (leaning_[0] != 0.0) {
    log_.Assume("LEAD", "above 0 leans the tool the way it goes" + std::string(kSense), true);
  }
  if (leaning_[1] != 0.0) {
    log_.Assume("TILT", "above 0 turns right-handed about its axis" + std::string(kSense), true);
  }
  const auto axis =
      LeanedAxis(surface_normal_, *way, leaning_[0], leaning_[1], static_cast<LeanOrder>(order));
  if (!axis) return unsupported("LEAD or TILT where the surface's normal is along the path");
  return axis;
}

/// Sets the rotary axes of `end` to what an orientation in the block asks for. False: stopped.
bool SinumerikInterpreter::TakeOrientation(const SinumerikArcWords* arc, AxisValues* end,
                                           unsigned* named) {
  TakeSurfaceNormal();
  std::optional<Eigen::Vector3d> axis = TakeToolAxis();
  if (!axis) axis = TakeLeaning(arc, *end);
  if (!axis) return !log_.stopped();
  if (!traori_) {
    Unsupported("an orientation vector without TRAORI", step_->where);
    return true;
  }
  if (!(axis->norm() > kNoVector)) {
    return Alarm(step_->where, 14112, "an orientation vector of length 0");
  }
  if (tool_frame()) {
    Unsupported("an orientation vector under TOROT", step_->where,
                "where X points is not known (SD42980)");
  }
  return Reach(*axis, end, named);
}

/// Where the rotary joints stand for `values` (program coordinates of the active frame), in
/// FiveAxis::rotary() order.
std::array<double, 2> SinumerikInterpreter::RotaryJoints(AxisValues values) const {
  for (std::size_t i = kA; i < kNumAxes; ++i) values[i] += frame_->offset[i];
  const JointVector q = axes_.Joints(values);
  std::array<double, 2> joints{};
  const std::vector<int>& rotary = parts_.frames->five_axis().rotary();
  for (std::size_t i = 0; i < rotary.size(); ++i) joints.at(i) = q[rotary[i]];
  return joints;
}

void SinumerikInterpreter::SetRotary(const std::array<double, 2>& joints, AxisValues* end) const {
  const std::vector<int>& rotary = parts_.frames->five_axis().rotary();
  JointVector q = axes_.Joints(*end);
  for (std::size_t i = 0; i < rotary.size(); ++i) q[rotary[i]] = joints.at(i);
  const AxisValues values = axes_.Values(q);
  for (const int joint : rotary) {
    for (std::size_t i = kA; i < kNumAxes; ++i) {
      if (axes_.joint(static_cast<int>(i)) == joint) (*end)[i] = values[i] - frame_->offset[i];
    }
  }
}

/// With ORIMKS a vector is one of the machine's directions; with ORIWKS it turns with the frame.
Eigen::Vector3d SinumerikInterpreter::InTable(const Eigen::Vector3d& axis) {
  Eigen::Vector3d u = axis;
  const Eigen::Matrix3d& linear = frame_->program.linear;
  const Eigen::Matrix3d square = linear.transpose() * linear;
  constexpr double kRounding = 1e-12;
  if ((square - Eigen::Matrix3d::Identity() * square(0, 0)).norm() > kRounding * square(0, 0)) {
    Unsupported("an orientation vector in a frame with different scales of the axes", step_->where);
  }
  if (Is(kSinOrientationSystem, "ORIMKS")) u = frame_->program.linear.inverse() * u;
  return parts_.frames->InTable(frame_).Vector(u).normalized();
}

/// Sets the rotary axes of `end` to the position that the control takes: along a vector's path the
/// one that the path leads to, else the nearer one. False: stopped.
bool SinumerikInterpreter::Reach(const Eigen::Vector3d& axis, AxisValues* end, unsigned* named) {
  const kinematics::FiveAxis& five_axis = parts_.frames->five_axis();
  const Eigen::Vector3d u_B = InTable(axis);
  // A program repeats its vector from block to block: then nothing turns, not even by rounding.
  AxisValues here = position_;
  for (std::size_t i = kA; i < kNumAxes; ++i) here[i] += frame_->offset[i];
  Eigen::Vector3d p_B, now_B;
  five_axis.TipInTable(axes_.Joints(here), 0.0, &p_B, &now_B);
  if (now_B.cross(u_B).norm() < kSame && now_B.dot(u_B) > 0.0) return true;
  const std::array<double, 2> from = RotaryJoints(position_);
  const auto all = kinematics::ReachableRotary(five_axis, u_B, from, {});
  if (all.empty()) {
    return Alarm(step_->where, 14112, "the machine cannot tilt the tool to this orientation");
  }
  std::array<double, 2> reached = all[0].angles;
  bool led = false;
  for (const kinematics::RotarySolution& solution : all) {
    kinematics::GreatCircle circle;
    const bool leads =
        vector_path() && !led &&
        kinematics::GreatCircle::Make(five_axis, from, solution.angles, &circle) ==
            kinematics::GreatCircle::Fault::kNone &&
        kinematics::AngleFromPole(five_axis, from, solution.angles) >= settings_.pole_limit;
    if (leads) reached = solution.angles;
    led = led || leads;
  }
  if (!WithinLimits(u_B, from, led, &reached)) return false;
  SetRotary(reached, end);
  for (int i = kA; i < kNumAxes; ++i) {
    if (axes_.has(i)) *named |= 1U << i;
  }
  return true;
}

/// MD21180: where a position lies behind the software limits, another one or alarm 10720.
bool SinumerikInterpreter::WithinLimits(const Eigen::Vector3d& u_B,
                                        const std::array<double, 2>& from, bool led,
                                        std::array<double, 2>* reached) {
  const kinematics::FiveAxis& five_axis = parts_.frames->five_axis();
  const kinematics::RotaryLimits limits = RotaryLimitsOf(*parts_.machine, five_axis);
  const auto written = [&](const std::array<double, 2>& angles) {
    std::string text;
    for (std::size_t i = 0; i < five_axis.rotary().size(); ++i) {
      for (const machine::Axis& axis : parts_.machine->axes) {
        if (axis.joint != five_axis.rotary()[i]) continue;
        text += (text.empty() ? "" : " ") + std::string(1, axis.letter) +
                Fixed(Degrees(angles.at(i)), 3);
      }
    }
    return text;
  };
  bool within = true;
  for (std::size_t i = 0; i < five_axis.rotary().size(); ++i) {
    within = within && reached->at(i) >= limits.lower.at(i) - kSame &&
             reached->at(i) <= limits.upper.at(i) + kSame;
  }
  if (within) return true;
  const std::string position = "the tool is leaned to this orientation the nearest way at " +
                               written(*reached) + ", behind the software limits";
  const int units = settings_.limit_mode % 10;
  const auto others = kinematics::ReachableRotary(five_axis, u_B, from, limits);
  if (others.empty()) return Alarm(step_->where, 10720, position + ", and there is no other way");
  const bool stops = units == 0 || (units == 1 && led);
  if (stops && settings_.limit_mode_stated) {
    return Alarm(step_->where, 10720,
                 position + "; " + written(others[0].angles) + " would do, but MD21180 = " +
                     std::to_string(settings_.limit_mode) + " does not let the control take it");
  }
  if (stops) {
    log_.ReportOnce("MD21180", Rule::kUnsupportedCode, step_->where,
                    position +
                        "; the control stops there with alarm 10720 (MD21180 = 0), or goes "
                        "to " +
                        written(others[0].angles) +
                        ", as simulated (MD21180 = 2): state MD21180 in the job");
  }
  if (settings_.limit_mode >= 10) {
    Unsupported("MD21180 = " + std::to_string(settings_.limit_mode), step_->where, position);
  }
  *reached = others[0].angles;
  if (led) command_.orientation = Orientation::kAxes;
  return true;
}

/// MD21108: a tool vector that comes as near to the pole (C's axis) as MD24540 is led otherwise.
/// Pushes what goes before the command, or lets its rotary axes go in proportion.
void SinumerikInterpreter::PassPole() {
  using kinematics::GreatCircle;
  const kinematics::FiveAxis& five_axis = parts_.frames->five_axis();
  const std::array<double, 2> from = RotaryJoints(position_);
  const std::array<double, 2> to = RotaryJoints(command_.end);
  const double turn = std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1]));
  if (five_axis.rotary().size() < 2 || turn < kSame) return;
  GreatCircle circle;
  const GreatCircle::Fault fault = GreatCircle::Make(five_axis, from, to, &circle);
  const int mode = settings_.pole_mode;
  if (fault == GreatCircle::Fault::kUnreachable) {
    if (mode / 10'000 == 1) {
      command_.orientation = Orientation::kAxes;
    } else {
      Alarm(step_->where, 14112, "the machine cannot tilt the tool to what lies on its way");
    }
    return;
  }
  const bool near = kinematics::AngleFromPole(five_axis, from, to) < settings_.pole_limit;
  if (fault == GreatCircle::Fault::kNoTurn) {
    if (near) return;  // C alone.
    return Unsupported("rotary axes that move and leave the tool vector as it was, under ORIVECT",
                       step_->where, "whether the control turns them is not known");
  }
  if (!near) return;
  const double start = kinematics::AngleFromPole(five_axis, from, from);
  const bool at_pole = start < kSame;
  const int digit = at_pole ? mode % 10 : start < settings_.pole_limit ? mode / 10 % 10 : 0;
  if (!settings_.pole_stated) {
    log_.Assume("MD21108",
                "0: a tool vector that comes within " + Short(Degrees(settings_.pole_limit)) +
                    " deg (MD24540) of the axis of C is led by the rotary axes in proportion",
                false);
  }
  if (digit == 1 && at_pole && fault == GreatCircle::Fault::kNone) {
    return TurnAtPole(circle.start());
  }
  if (digit != 0 || mode / 100 % 10 != 0) {
    Unsupported("MD21108 = " + std::to_string(mode), step_->where,
                "a path of the tool vector near the pole");
  }
  if (std::abs(to[1] - from[1]) > kPi + kSame) {
    Unsupported("a turn of more than 180 deg under ORIVECT near the pole", step_->where,
                "which way the control goes is not known");
  }
  command_.orientation = Orientation::kAxes;
}

/// A block before the one in hand: the axis that is free at the pole turns to where the circle
/// begins.
void SinumerikInterpreter::TurnAtPole(const std::array<double, 2>& start) {
  const Command block = command_;
  AxisValues turned = position_;
  SetRotary(start, &turned);
  command_.end = turned;
  command_.orientation = Orientation::kAxes;
  if (command_.kind == CommandKind::kArc) command_.kind = CommandKind::kFeed;
  contour_.Push(command_);
  position_ = turned;
  command_ = block;
}

}  // namespace ncsim::control
