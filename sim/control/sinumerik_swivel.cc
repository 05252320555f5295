// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_swivel.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/sinumerik_drilling_words.h"
#include "sim/control/sinumerik_frame.h"

namespace ncsim::control {
namespace {

enum Mode { kAxisByAxis = 0, kSolidAngle = 1, kProjection = 2, kDirect = 3 };

// rad: an angle this little below a whole turn is one.
constexpr double kSameSwivelAngle = 1e-9;

long ModeOf(const SinumerikCycleArguments& arguments) { return arguments.Whole("_MODE") >> 6; }

std::string Value(const SinumerikCycleArguments& arguments, std::string_view parameter) {
  return std::string(parameter) + " = " + Short(arguments.Number(parameter));
}

Eigen::Vector3d Shift(const SinumerikCycleArguments& a, std::string_view x, std::string_view y,
                      std::string_view z) {
  return {a.Length(x), a.Length(y), a.Length(z)};
}

}  // namespace

SwivelPlane ShiftedPlane(const SinumerikCycleArguments& arguments,
                         const Eigen::Matrix3d& rotation) {
  const SwivelPlane turned = {rotation, Shift(arguments, "_X0", "_Y0", "_Z0")};
  return turned.Then({Eigen::Matrix3d::Identity(), Shift(arguments, "_X1", "_Y1", "_Z1")});
}

bool IsDirectSwivel(const SinumerikCycleArguments& arguments) {
  return ModeOf(arguments) == kDirect;
}

bool IsAxisByAxisSwivel(const SinumerikCycleArguments& arguments) {
  return ModeOf(arguments) == kAxisByAxis;
}

std::optional<Eigen::Matrix3d> SwivelRotation(const SinumerikCycleArguments& arguments,
                                              std::string* unsupported) {
  const std::array<double, 3> angles = {Radians(arguments.Number("_A")),
                                        Radians(arguments.Number("_B")),
                                        Radians(arguments.Number("_C"))};
  constexpr int kY = 2, kZ = 3;
  std::array<int, 3> about = {kZ, kY, 0};
  const long mode = ModeOf(arguments);
  if (mode == kAxisByAxis || mode == kProjection) {
    for (std::size_t i = 0; i < 3; ++i) {
      about.at(i) = static_cast<int>(arguments.Whole("_MODE") >> (2 * i) & 3);
    }
  }
  if (mode == kProjection) {
    const bool first_x = about[0] == 1 && about[1] == kY;
    const bool in_xy = (first_x || (about[0] == kY && about[1] == 1)) && about[2] == kZ;
    const auto plane = SolidAngleRotation(
        {angles.at(first_x ? 0 : 1), angles.at(first_x ? 1 : 0), 0.0}, {true, true, false});
    if (in_xy && plane) return *plane * Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ());
  }
  if (mode == kProjection || mode == kDirect) {
    *unsupported = Value(arguments, "_MODE");
    return std::nullopt;
  }
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    if (angles.at(i) == 0.0) continue;
    if (about.at(i) == 0) {
      *unsupported = Value(arguments, "_MODE");
      return std::nullopt;
    }
    rotation = rotation * Eigen::AngleAxisd(angles.at(i), Eigen::Vector3d::Unit(about.at(i) - 1));
  }
  return rotation;
}

const kinematics::RotarySolution& ChooseSwivel(
    const std::vector<kinematics::RotarySolution>& solutions, long direction, int reference,
    bool endless) {
  const auto angle = [&](const kinematics::RotarySolution& solution) {
    const double value = solution.angles.at(static_cast<std::size_t>(reference));
    return endless ? value - 2.0 * kPi * std::floor((value + kSameSwivelAngle) / (2.0 * kPi))
                   : value;
  };
  const kinematics::RotarySolution* chosen = &solutions.front();
  for (const kinematics::RotarySolution& solution : solutions) {
    const double more = angle(solution) - angle(*chosen);
    if (direction > 0 ? more > 0.0 : more < 0.0) chosen = &solution;
  }
  return *chosen;
}

std::optional<std::string> UnsupportedSwivel(const SinumerikCycleArguments& arguments,
                                             Plane plane) {
  std::string unsupported;
  if (!CheckDisplayMode(arguments, plane, &unsupported)) return unsupported;
  // _ST: units 0 new, 1 additive; tens 1 the tip stays at the part; hundred thousands 2 as _DIR
  // says. The others orient a tool, or are not known.
  const long status = arguments.Whole("_ST");
  constexpr long kTurns = 200'000;
  const long rest = status >= kTurns ? status - kTurns : status;
  if (status < 0 || rest > 11 || Digit(rest, 0) > 1) return Value(arguments, "_ST");
  const long direction = arguments.Whole("_DIR");
  if (direction < -1 || direction > 1) return Value(arguments, "_DIR");
  // A solid angle is of two, a position of the axes of one or two.
  const long mode = ModeOf(arguments);
  const bool by_two = mode == kSolidAngle || mode == kDirect;
  if (by_two && arguments.Number("_C") != 0.0) return Value(arguments, "_C");
  if (arguments.Whole("_MODE") < 0 || mode > kDirect) return Value(arguments, "_MODE");
  return std::nullopt;
}

}  // namespace ncsim::control
