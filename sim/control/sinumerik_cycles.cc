// SPDX-License-Identifier: BSD-3-Clause
// Cycles of the SINUMERIK (NC programming 12/2019, "Programming cycles externally").
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/sinumerik_cycle_arguments.h"
#include "sim/control/sinumerik_drilling_words.h"
#include "sim/control/sinumerik_holes.h"
#include "sim/control/sinumerik_interpreter.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

constexpr double kStandardFactor = 10.0;  // SD55441 to SD55444, standard value.

}  // namespace

void SinumerikInterpreter::ExecuteCycle(const nc::SinumerikCommand& cycle,
                                        std::span<const nc::SinumerikValue> values,
                                        SourcePosition where) {
  if (cycle.support == nc::Support::kUnsupported) {
    return Unsupported(cycle.name, where, std::string(cycle.meaning));
  }
  const SinumerikCycleArguments arguments(cycle, values, mm_);
  if (std::string error = arguments.Error(); !error.empty()) {
    return log_.Alarm(Rule::kControlAlarm, where, std::move(error));
  }
  if (cycle.name == "CYCLE832") return HighSpeedSettings(arguments, where);
  if (frame_dirty_) RefreshFrame();
  UpdatePrototype();
  if (cycle.name == "CYCLE800") return Swivel(arguments, where);
  if (IsHolePattern(cycle.name)) return MakePattern(arguments, where);
  Drill(arguments, where);
}

/// CYCLE832(tolerance, type[, orientation tolerance]): units of the type 0 switch it off; tens 1:
/// the third parameter is the tolerance of the orientation, deg; else it is the contour's, in mm,
/// times SD55441 to SD55444 (p. 1108). Without parameters: off.
void SinumerikInterpreter::HighSpeedSettings(const SinumerikCycleArguments& arguments,
                                             const SourcePosition& where) {
  contour_tolerance_ = orientation_tolerance_ = 0.0;
  factor_name_ = {};
  const long type = arguments.Whole("_TOLM");
  const long units = type % 10;
  if (type / 100 % 10 != 0) {
    Unsupported("the hundreds of CYCLE832's type", where, "older software switches TRAORI by them");
  }
  if (!arguments.given("_TOL") || units == 0) return;
  contour_tolerance_ = std::max(0.0, arguments.Length("_TOL"));
  if (type / 10 % 10 == 1 && arguments.given("_OTOL")) {
    orientation_tolerance_ = std::max(0.0, Radians(arguments.Number("_OTOL")));
    return;
  }
  constexpr std::array<const char*, 5> kFactors = {"", "SD55443", "SD55442", "SD55441", "SD55444"};
  if (units < 0 || units >= static_cast<long>(kFactors.size())) {
    Unsupported("CYCLE832 of a type that it does not have", where);
    return;
  }
  const auto index = static_cast<std::size_t>(units);
  const std::optional<double>& stated = settings_.tolerance_factors[index];
  factor_name_ = kFactors[index];
  factor_ = stated.value_or(kStandardFactor);
  factor_stated_ = stated.has_value();
  orientation_tolerance_ = std::max(0.0, Radians(contour_tolerance_ * factor_));
}

/// Under TRAORI the tool leans by an orientation tolerance that a factor has made.
void SinumerikInterpreter::CheckToleranceFactor() {
  if (!traori_ || factor_name_.empty()) return;
  const std::string name(factor_name_);
  if (!(factor_ > 0.0)) {
    Unsupported("CYCLE832 with " + name + " = 0 under TRAORI", step_->where,
                "the tolerance of the rotary axes (MD33100) is not known");
  } else if (!factor_stated_) {
    log_.Assume(name,
                Short(factor_) +
                    ": deg of CYCLE832's orientation tolerance for each mm of its "
                    "contour tolerance",
                false);
  }
  factor_name_ = {};
}

/// "" or what in force keeps a drilling cycle from being simulated.
std::string SinumerikInterpreter::CannotDrill() const {
  constexpr double kRounding = 1e-12;
  const Eigen::Vector3d normal = frame_->program.linear.col(AxesOf(plane_).normal);
  if (!Is(kSinComp, "G40")) return "with G41 or G42";
  if (command_.feed_mode == Command::FeedMode::kInverseTime) return "with G93";
  if (plane_ != Plane::kXY && active_.length != 0.0) return "in G18 or G19 with a tool length";
  if (std::abs(normal.norm() - 1.0) > kRounding) return "with SCALE of the drilling axis";
  return "";
}

void SinumerikInterpreter::Drill(const SinumerikCycleArguments& arguments,
                                 const SourcePosition& where) {
  const std::string name(arguments.cycle().name);
  const bool per_revolution = command_.feed_mode == Command::FeedMode::kPerRevolution;
  const SinumerikCycleState state = {plane_, rpm_, command_.feed,
                                     feed_mm_ / 60.0 * (per_revolution ? rpm_ : 1.0)};
  SinumerikCycleAlarm alarm;
  std::string unsupported = CannotDrill();
  if (!unsupported.empty()) return Unsupported(name + " " + unsupported, where);
  const auto call = ReadDrilling(arguments, state, &alarm, &unsupported);
  if (!unsupported.empty()) return Unsupported(name + " with " + unsupported, where);
  if (!call) {
    Alarm(where, alarm.number, name + ": " + alarm.text);
    return;
  }
  if (call->reads_percent) {
    log_.Assume("CYCLE83 _AMODE", "its digits make DAM and FRF percent: depths of single strokes",
                false);
  }
  if (call->spindle) spindle_ = *call->spindle;
  command_.spindle_on = spindle_ != 0 && rpm_ > 0.0;
  if (call->words.feed_in > 0.0) command_.feed = call->words.feed_in;
  BeforeLinearMotion();
  if (log_.stopped() || !CheckFeed()) return;
  command_.cycle = ++cycle_count_;
  const auto end = ExpandSinumerikDrilling(
      call->words, command_, position_, [this](const Command& move) { contour_.Push(move); },
      &alarm);
  if (!end) {
    Alarm(where, alarm.number, name + ": " + alarm.text);
    return;
  }
  position_ = *end;
  if (call->spindle_after) spindle_ = *call->spindle_after;
}

/// HOLES1, HOLES2, CYCLE801: the positions, to be gone to one by one; MCALL acts at each.
void SinumerikInterpreter::MakePattern(const SinumerikCycleArguments& arguments,
                                       const SourcePosition& where) {
  const std::string name(arguments.cycle().name);
  if (!holes_.empty()) return Unsupported(name + " within a modal call at holes", where);
  SinumerikCycleAlarm alarm;
  std::string unsupported;
  const auto holes = SinumerikHoles(arguments, plane_, position_, &alarm, &unsupported);
  if (!unsupported.empty()) return Unsupported(name + " with " + unsupported, where);
  if (!holes) {
    Alarm(where, alarm.number, name + ": " + alarm.text);
    return;
  }
  holes_.assign(holes->rbegin(), holes->rend());
  holes_where_ = where;
}

bool SinumerikInterpreter::NextPosition() {
  moved_ = false;
  if (holes_.empty() || log_.stopped()) return false;
  if (frame_dirty_) RefreshFrame();
  UpdatePrototype();
  BeforeLinearMotion();
  if (log_.stopped()) return false;
  AxisValues end = position_;
  const PlaneAxes axes = AxesOf(plane_);
  unsigned named = 0;
  for (const int axis : {axes.first, axes.second}) {
    end[static_cast<std::size_t>(axis)] = holes_.back()[static_cast<std::size_t>(axis)];
    named |= 1U << axis;
  }
  holes_.pop_back();
  command_.where = holes_where_;
  command_.kind = CommandKind::kRapid;
  command_.end = end;
  command_.named = static_cast<std::uint8_t>(named);
  Push();
  return true;
}

}  // namespace ncsim::control
