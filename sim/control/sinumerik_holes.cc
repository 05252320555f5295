// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_holes.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/arc.h"
#include "sim/control/hole_moves.h"
#include "sim/control/hole_patterns.h"
#include "sim/control/sinumerik_drilling_words.h"

namespace ncsim::control {
namespace {

using Holes = std::vector<AxisValues>;

AxisValues InPlane(Plane plane, AxisValues at, double first, double second) {
  const PlaneAxes axes = AxesOf(plane);
  at[static_cast<std::size_t>(axes.first)] = first;
  at[static_cast<std::size_t>(axes.second)] = second;
  return at;
}

double FromZero(Plane plane, const AxisValues& at) {
  const PlaneAxes axes = AxesOf(plane);
  return std::hypot(at[static_cast<std::size_t>(axes.first)],
                    at[static_cast<std::size_t>(axes.second)]);
}

/// From the end that is nearer to the zero point.
Holes Row(const SinumerikCycleArguments& a, Plane plane, const AxisValues& position, int count) {
  const double angle = Radians(a.Number("STA1"));
  const AxisValues reference = InPlane(plane, position, a.Length("SPCA"), a.Length("SPCO"));
  const AxisValues first =
      HolesOnLine(reference, plane, std::abs(a.Length("FDIS")), angle, 2).back();
  Holes holes = HolesOnLine(first, plane, std::abs(a.Length("DBH")), angle, count);
  if (FromZero(plane, holes.front()) > FromZero(plane, holes.back())) {
    std::reverse(holes.begin(), holes.end());
  }
  return holes;
}

/// Rows along the axis with the smaller distance, to and fro. It begins at the end of an axis that
/// the middle of the grid, seen from SPCA and SPCO, makes the nearer one.
Holes Grid(const SinumerikCycleArguments& a, Plane plane, const AxisValues& position, int columns,
           int rows) {
  const double distance[2] = {std::abs(a.Length("_DIS1")), std::abs(a.Length("_DIS2"))};
  const double origin[2] = {a.Length("_SPCA"), a.Length("_SPCO")};
  const int count[2] = {columns, rows};
  const std::size_t inner = distance[0] <= distance[1] ? 0 : 1;
  const std::size_t outer = 1 - inner;
  const auto forward = [&](std::size_t k) {
    return 0.5 * (count[k] - 1) * distance[k] >= origin[k];
  };
  const double angle = Radians(a.Number("_STA"));
  Holes holes;
  for (int i = 0; i < count[outer]; ++i) {
    for (int j = 0; j < count[inner]; ++j) {
      double at[2];
      const bool to = forward(inner) == (i % 2 == 0);
      at[outer] = (forward(outer) ? i : count[outer] - 1 - i) * distance[outer];
      at[inner] = (to ? j : count[inner] - 1 - j) * distance[inner];
      holes.push_back(InPlane(plane, position,
                              origin[0] + at[0] * std::cos(angle) - at[1] * std::sin(angle),
                              origin[1] + at[0] * std::sin(angle) + at[1] * std::cos(angle)));
    }
  }
  return holes;
}

}  // namespace

bool IsHolePattern(std::string_view cycle) {
  return cycle == "HOLES1" || cycle == "HOLES2" || cycle == "CYCLE801";
}

std::optional<Holes> SinumerikHoles(const SinumerikCycleArguments& arguments, Plane plane,
                                    const AxisValues& position, SinumerikCycleAlarm* alarm,
                                    std::string* unsupported) {
  const bool grid = arguments.cycle().name == "CYCLE801";
  // A frame outlines the grid; positions are hidden; the way between them is an arc.
  if (!CheckAllZero(arguments, "_VARI _UMODE _ANG1 _ANG2 _HIDE _NSP", unsupported) ||
      !CheckDisplayMode(arguments, plane, unsupported)) {
    return std::nullopt;
  }
  const long columns = std::abs(arguments.Whole(grid ? "_NUM1" : "NUM"));
  const long rows = grid ? std::abs(arguments.Whole("_NUM2")) : 1;
  if (columns == 0 || rows == 0) {
    *alarm = {grid ? 62105 : 61103, "the number of holes is 0"};
    return std::nullopt;
  }
  if (columns > kMaxPatternHoles || rows > kMaxPatternHoles || columns * rows > kMaxPatternHoles) {
    *unsupported = "more than " + std::to_string(kMaxPatternHoles) + " holes";
    return std::nullopt;
  }
  const int count = static_cast<int>(columns);
  if (grid) return Grid(arguments, plane, position, count, static_cast<int>(rows));
  if (arguments.cycle().name == "HOLES1") return Row(arguments, plane, position, count);
  double step = arguments.Number("INDA");
  if (step == 0.0) step = 360.0 / count;
  if (std::abs(step) * (count - 1) >= 360.0) {
    *alarm = {61106, Short(count, 0) + " holes " + Short(step) + " deg apart overlap"};
    return std::nullopt;
  }
  return HolesOnArc(InPlane(plane, position, arguments.Length("CPA"), arguments.Length("CPO")),
                    plane, std::abs(arguments.Length("RAD")), Radians(arguments.Number("STA1")),
                    Radians(step), count);
}

}  // namespace ncsim::control
