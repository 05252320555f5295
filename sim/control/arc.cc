// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/arc.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::control {
namespace {

// Below this an end is the start (and a radius nothing): sums of G91 words differ from the sum by
// rounding only.
constexpr double kSameArcPoint = 1e-7;

constexpr char kCentreLetter[3] = {'I', 'J', 'K'};

struct PlaneVector {
  double first = 0.0, second = 0.0;
};

// Signed sweep from angle a0 to a1 the given way round; (0, 2 pi] in magnitude.
double Sweep(double a0, double a1, bool clockwise) {
  double sweep = clockwise ? a0 - a1 : a1 - a0;
  while (sweep <= 0.0) sweep += 2.0 * kPi;
  while (sweep > 2.0 * kPi) sweep -= 2.0 * kPi;
  return clockwise ? -sweep : sweep;
}

// The centre of an arc of radius |r| over the chord, relative to the start; |r| may fall short of
// half the chord by half the tolerance.
std::optional<PlaneVector> CentreFromRadius(PlaneVector chord, double r, bool clockwise,
                                            double tolerance, std::string* error) {
  const double length = std::hypot(chord.first, chord.second);
  if (length < kSameArcPoint) {
    *error = "an arc with R needs an end point that is not the start; a full circle needs I, J, K";
    return std::nullopt;
  }
  const double radius = std::abs(r);
  const double half = 0.5 * length;
  if (!(radius >= half - 0.5 * tolerance)) {  // Written so that a NaN fails.
    *error = "radius R " + Short(r) + " mm does not reach the end point: half the chord is " +
             Short(half) + " mm";
    return std::nullopt;
  }
  const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
  // To the left of the chord for a counter-clockwise arc of at most 180 degrees.
  const double side = (clockwise == (r > 0.0)) ? -1.0 : 1.0;
  return PlaneVector{0.5 * chord.first - side * height * chord.second / length,
                     0.5 * chord.second + side * height * chord.first / length};
}

std::optional<PlaneVector> CentreFromOffsets(Plane plane, const ArcWords& words,
                                             std::string* error) {
  const PlaneAxes axes = AxesOf(plane);
  const std::optional<double>& normal = words.ijk[static_cast<std::size_t>(axes.normal)];
  if (normal && *normal != 0.0) {
    *error = std::string(1, kCentreLetter[axes.normal]) + " is not a letter of an arc in " +
             PlaneName(plane);
    return std::nullopt;
  }
  const std::optional<double>& first = words.ijk[static_cast<std::size_t>(axes.first)];
  const std::optional<double>& second = words.ijk[static_cast<std::size_t>(axes.second)];
  if (!first && !second) {
    *error = std::string("an arc needs R, or ") + kCentreLetter[std::min(axes.first, axes.second)] +
             " and " + kCentreLetter[std::max(axes.first, axes.second)];
    return std::nullopt;
  }
  return PlaneVector{first.value_or(0.0), second.value_or(0.0)};
}

bool HasOffsets(const ArcWords& words) {
  return std::any_of(words.ijk.begin(), words.ijk.end(),
                     [](const auto& w) { return w.has_value(); });
}

}  // namespace

std::string PlaneName(Plane plane) {
  switch (plane) {
    case Plane::kZX:
      return "G18";
    case Plane::kYZ:
      return "G19";
    case Plane::kXY:
      break;
  }
  return "G17";
}

std::optional<Arc> ResolveArc(Plane plane, const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                              const ArcWords& words, double tolerance, std::string* error) {
  const PlaneAxes axes = AxesOf(plane);
  const PlaneVector chord{end[axes.first] - start[axes.first],
                          end[axes.second] - start[axes.second]};
  if (words.r && HasOffsets(words)) {
    *error = "an arc has R as well as I, J or K";
    return std::nullopt;
  }
  const std::optional<PlaneVector> to_centre =
      words.r ? CentreFromRadius(chord, *words.r, words.clockwise, tolerance, error)
              : CentreFromOffsets(plane, words, error);
  if (!to_centre) return std::nullopt;

  Arc arc;
  arc.centre = start;
  arc.centre[axes.first] += to_centre->first;
  arc.centre[axes.second] += to_centre->second;
  arc.start_radius = std::hypot(to_centre->first, to_centre->second);
  const PlaneVector from_centre{chord.first - to_centre->first, chord.second - to_centre->second};
  arc.end_radius = std::hypot(from_centre.first, from_centre.second);
  if (!(arc.start_radius > kSameArcPoint) || !std::isfinite(arc.start_radius)) {
    *error = "the radius of the arc is 0";
    return std::nullopt;
  }
  if (!(std::abs(arc.start_radius - arc.end_radius) <= tolerance)) {
    *error = "the end point is not on the arc: radius " + Short(arc.start_radius) +
             " mm at the start, " + Short(arc.end_radius) + " mm at the end (limit " +
             Short(tolerance) + " mm apart)";
    return std::nullopt;
  }
  arc.start_angle = std::atan2(-to_centre->second, -to_centre->first);
  arc.full_circle = std::hypot(chord.first, chord.second) < kSameArcPoint;
  arc.sweep = arc.full_circle
                  ? (words.clockwise ? -2.0 * kPi : 2.0 * kPi)
                  : Sweep(arc.start_angle, std::atan2(from_centre.second, from_centre.first),
                          words.clockwise);
  return arc;
}

bool MakeArc(const AxisValues& start, const ArcWords& words, double tolerance, Command* command,
             std::string* error) {
  const std::optional<Arc> arc =
      ResolveArc(command->plane, {start[kX], start[kY], start[kZ]},
                 {command->end[kX], command->end[kY], command->end[kZ]}, words, tolerance, error);
  if (!arc) return false;
  command->kind = CommandKind::kArc;
  command->centre = arc->centre;
  command->clockwise = words.clockwise;
  command->full_circle = arc->full_circle;
  return true;
}

Arc ArcOf(const AxisValues& start, const Command& command) {
  const PlaneAxes axes = AxesOf(command.plane);
  const auto from_centre = [&](const AxisValues& point) {
    return PlaneVector{point[static_cast<std::size_t>(axes.first)] - command.centre[axes.first],
                       point[static_cast<std::size_t>(axes.second)] - command.centre[axes.second]};
  };
  const PlaneVector a = from_centre(start);
  const PlaneVector b = from_centre(command.end);
  Arc arc;
  arc.centre = command.centre;
  arc.start_radius = std::hypot(a.first, a.second);
  arc.end_radius = std::hypot(b.first, b.second);
  arc.start_angle = std::atan2(a.second, a.first);
  arc.full_circle = command.full_circle;
  arc.sweep = command.full_circle
                  ? (command.clockwise ? -2.0 * kPi : 2.0 * kPi)
                  : Sweep(arc.start_angle, std::atan2(b.second, b.first), command.clockwise);
  return arc;
}

}  // namespace ncsim::control
