// SPDX-License-Identifier: BSD-3-Clause
// The tool's orientation under TRAORI: A3 B3 C3, A2 B2 C2, and how it goes from block to block (NC
// programming 12/2019, "Tool orientation"; MD21100, MD21102, MD21104).
#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "kinematics/reachable.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/sinumerik_interpreter.h"

namespace ncsim::control {
namespace {

// A vector as programmed has a direction.
constexpr double kNoVector = 1e-9;
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

/// The tool axis (tip to holder) of A3 B3 C3 or A2 B2 C2, in program coordinates; not of length 1.
std::optional<Eigen::Vector3d> SinumerikInterpreter::TakeToolAxis() {
  const auto take = [this](char digit, Eigen::Vector3d* values) {
    bool any = false;
    for (int i = 0; i < 3; ++i) {
      const std::string name = {"ABC"[i], digit};
      if (Peek(name) == nullptr) continue;
      const SinumerikItem* item = Take(name);
      if (item == nullptr) return false;
      (*values)[i] = item->value;
      any = true;
    }
    return any;
  };
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  if (take('3', &values)) return values;
  if (!take('2', &values)) return std::nullopt;
  const bool euler = settings_.orientation_by_g50 ? Is(kSinOrientationAngles, "ORIEULER")
                                                  : settings_.orientation_euler;
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const double a = Radians(values[0]), b = Radians(values[1]), c = Radians(values[2]);
  if (euler) {
    return AngleAxisd(a, Vector3d::UnitZ()) * AngleAxisd(b, Vector3d::UnitX()) * Vector3d::UnitZ();
  }
  return AngleAxisd(c, Vector3d::UnitZ()) * AngleAxisd(b, Vector3d::UnitY()) *
         AngleAxisd(a, Vector3d::UnitX()) * Vector3d::UnitZ();
}

/// Sets the rotary axes of `end` to what an orientation in the block asks for. False: stopped.
bool SinumerikInterpreter::TakeOrientation(AxisValues* end, unsigned* named) {
  const std::optional<Eigen::Vector3d> axis = TakeToolAxis();
  if (!axis) return !log_.stopped();
  if (!traori_) {
    Unsupported("an orientation vector without TRAORI", step_->where);
    return true;
  }
  if (!(axis->norm() > kNoVector)) {
    return Alarm(step_->where, 14112, "an orientation vector of length 0");
  }
  return Reach(*axis, end, named);
}

bool SinumerikInterpreter::Reach(const Eigen::Vector3d& axis, AxisValues* end, unsigned* named) {
  const kinematics::FiveAxis& five_axis = parts_.frames->five_axis();
  const Eigen::Vector3d u_B = parts_.frames->InTable(frame_).Vector(axis).normalized();
  AxisValues machine = position_;
  for (std::size_t i = kA; i < kNumAxes; ++i) machine[i] += frame_->offset[i];
  const JointVector q = axes_.Joints(machine);
  std::array<double, 2> from{};
  const std::vector<int>& rotary = five_axis.rotary();
  for (std::size_t i = 0; i < rotary.size(); ++i) from.at(i) = q[rotary[i]];
  const auto solutions =
      kinematics::ReachableRotary(five_axis, u_B, from, RotaryLimitsOf(*parts_.machine, five_axis));
  if (solutions.empty()) {
    return five_axis.SolveRotary(u_B).empty()
               ? Alarm(step_->where, 14112, "the machine cannot tilt the tool to this orientation")
               : Alarm(step_->where, 10720,
                       "this orientation lies behind the software limits of the rotary axes");
  }
  JointVector reached = q;
  for (std::size_t i = 0; i < rotary.size(); ++i) reached[rotary[i]] = solutions[0].angles.at(i);
  const AxisValues values = axes_.Values(reached);
  for (int i = kA; i < kNumAxes; ++i) {
    if (!axes_.has(i)) continue;
    const std::size_t axis_index = static_cast<std::size_t>(i);
    (*end)[axis_index] = values[axis_index] - frame_->offset[axis_index];
    *named |= 1U << i;
  }
  return true;
}

}  // namespace ncsim::control
