// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_arc.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/arc.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// mm: points closer than this are one.
constexpr double kSamePoint = 1e-9;
// Relative: three points whose triangle is flatter lie on a line.
constexpr double kCollinear = 1e-9;
// rad: an angle below is none.
constexpr double kNoAngle = 1e-9;

/// The plane's coordinates of start and end, and the way back.
struct ArcInPlane {
  ArcInPlane(const AxisValues& from, const Command& command) : axes(AxesOf(command.plane)) {
    start = Of(from);
    end = Of(command.end);
  }
  Vector2d Of(const AxisValues& values) const {
    return {values[static_cast<std::size_t>(axes.first)],
            values[static_cast<std::size_t>(axes.second)]};
  }
  PlaneAxes axes;
  Vector2d start, end;
};

Vector2d Turned(const Vector2d& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(),
          std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

std::string EndPoint(std::string why) { return nc::AlarmText(14040, std::move(why)); }

std::string Accept(const AxisValues& start, const ArcInPlane& plane, const Vector2d& centre,
                   bool clockwise, Command* command) {
  command->kind = CommandKind::kArc;
  command->centre = {start[kX], start[kY], start[kZ]};
  command->centre[plane.axes.first] = centre.x();
  command->centre[plane.axes.second] = centre.y();
  command->arc_normal.setZero();
  command->clockwise = clockwise;
  command->full_circle = (plane.end - plane.start).norm() < kSamePoint;
  return "";
}

std::string ByRadius(const AxisValues& start, const ArcInPlane& plane, double radius,
                     bool clockwise, const CircleTolerance& tolerance, Command* command) {
  const Vector2d chord = plane.end - plane.start;
  const double length = chord.norm();
  if (length < kSamePoint) return EndPoint("CR= with an end that is the start");
  const double size = std::abs(radius);
  const double limit = std::max(tolerance.constant, size * tolerance.factor);
  if (0.5 * length > size + 0.5 * limit) {
    return nc::AlarmText(
        14095, "CR=" + Short(radius) + " is too small: the end is " + Short(length) + " mm away");
  }
  const double height = std::sqrt(std::max(0.0, size * size - 0.25 * length * length));
  const Vector2d left(-chord.y() / length, chord.x() / length);
  const bool on_left = (radius > 0.0) != clockwise;
  const Vector2d centre = plane.start + 0.5 * chord + (on_left ? height : -height) * left;
  return Accept(start, plane, centre, clockwise, command);
}

std::string ByAngle(const AxisValues& start, const ArcInPlane& plane, double angle, bool clockwise,
                    Command* command) {
  const Vector2d chord = plane.end - plane.start;
  if (!(angle > kNoAngle && angle < 2.0 * kPi - kNoAngle) || chord.norm() < kSamePoint) {
    return EndPoint(
        "AR= with an end needs an angle between 0 and 360, and an end that is not "
        "the start");
  }
  const Vector2d left(-chord.y(), chord.x());
  const double height = 0.5 / std::tan(0.5 * angle);
  const Vector2d centre = plane.start + 0.5 * chord + (clockwise ? -height : height) * left;
  return Accept(start, plane, centre, clockwise, command);
}

/// AR and the centre: the end follows.
std::string ByAngleAboutCentre(const AxisValues& start, ArcInPlane plane, const Vector2d& centre,
                               double angle, bool clockwise, Command* command) {
  if (!(angle > kNoAngle && angle <= 2.0 * kPi + kNoAngle)) {
    return EndPoint("AR= is not between 0 and 360");
  }
  const bool full = angle > 2.0 * kPi - kNoAngle;
  const Vector2d radius = plane.start - centre;
  if (radius.norm() < kSamePoint) return EndPoint("the radius of the arc is 0");
  plane.end = full ? plane.start : centre + Turned(radius, clockwise ? -angle : angle);
  command->end[static_cast<std::size_t>(plane.axes.first)] = plane.end.x();
  command->end[static_cast<std::size_t>(plane.axes.second)] = plane.end.y();
  return Accept(start, plane, centre, clockwise, command);
}

std::string ByCentre(const AxisValues& start, const ArcInPlane& plane, Vector2d centre,
                     bool clockwise, const CircleTolerance& tolerance, Command* command) {
  const double r0 = (plane.start - centre).norm(), r1 = (plane.end - centre).norm();
  if (r0 < kSamePoint) return EndPoint("the radius of the arc is 0");
  const double limit = std::max(tolerance.constant, r0 * tolerance.factor);
  if (!(std::abs(r0 - r1) <= limit)) {
    return EndPoint("the end point is not on the arc: radius " + Short(r0) + " mm at the start, " +
                    Short(r1) + " mm at the end (limit " + Short(limit) + " mm apart)");
  }
  const Vector2d chord = plane.end - plane.start;
  if (chord.norm() >= kSamePoint) {
    const Vector2d along = chord.normalized();
    const Vector2d off = along * along.dot(centre - plane.start - 0.5 * chord);
    // Of a nearly full circle the way to the middle would be far; its end is met in proportion.
    if (off.norm() <= limit) centre -= off;
  }
  return Accept(start, plane, centre, clockwise, command);
}

/// Through three points, wherever they lie.
std::string ThroughPoint(const AxisValues& start, const Vector3d& through, Command* command) {
  const Vector3d s(start[kX], start[kY], start[kZ]);
  const Vector3d e(command->end[kX], command->end[kY], command->end[kZ]);
  const Vector3d a = through - s, b = e - s;
  const Vector3d normal = a.cross(b);
  if (normal.norm() <= kCollinear * a.norm() * b.norm() || (b - a).norm() < kSamePoint) {
    return nc::AlarmText(14920, "the intermediate point of CIP is on a line with start and end");
  }
  command->kind = CommandKind::kArc;
  command->centre = s + (a.squaredNorm() * b.cross(normal) + b.squaredNorm() * normal.cross(a)) /
                            (2.0 * normal.squaredNorm());
  command->arc_normal = normal.normalized();
  command->clockwise = false;
  command->full_circle = false;
  return "";
}

std::string Tangential(const AxisValues& start, const ArcInPlane& plane, const Vector3d& tangent,
                       Command* command) {
  const Vector2d along(tangent[plane.axes.first], tangent[plane.axes.second]);
  const Vector2d chord = plane.end - plane.start;
  if (along.norm() < kSamePoint || chord.norm() < kSamePoint) {
    return EndPoint("CT has no direction to go on with, or no way to go");
  }
  const Vector2d left = Vector2d(-along.y(), along.x()).normalized();
  const double aside = left.dot(chord);
  if (std::abs(aside) <= kCollinear * chord.norm()) {
    command->kind = CommandKind::kFeed;
    return along.dot(chord) > 0.0 ? "" : EndPoint("CT would have to turn back");
  }
  const Vector2d centre = plane.start + left * (chord.squaredNorm() / (2.0 * aside));
  return Accept(start, plane, centre, aside < 0.0, command);
}

}  // namespace

std::string MakeSinumerikArc(const AxisValues& start, const SinumerikArcWords& words,
                             const CircleTolerance& tolerance, Command* command) {
  if (words.through) return ThroughPoint(start, *words.through, command);
  const ArcInPlane plane(start, *command);
  if (words.tangent) return Tangential(start, plane, *words.tangent, command);
  const auto& c = words.centre;
  const bool has_centre = c[0] || c[1] || c[2];
  if (words.radius && (has_centre || words.angle)) {
    return nc::AlarmText(12080, "CR= beside I, J, K or AR=");
  }
  if (words.radius) {
    return ByRadius(start, plane, *words.radius, words.clockwise, tolerance, command);
  }
  if (words.angle && !has_centre) {
    return ByAngle(start, plane, *words.angle, words.clockwise, command);
  }
  const auto at = [&](int axis) {
    const std::size_t i = static_cast<std::size_t>(axis);
    return c[i].value_or(start[i]);
  };
  const Vector2d centre(at(plane.axes.first), at(plane.axes.second));
  if (words.angle) {
    if (words.end_named) return nc::AlarmText(12080, "AR= beside a centre and an end");
    return ByAngleAboutCentre(start, plane, centre, *words.angle, words.clockwise, command);
  }
  return ByCentre(start, plane, centre, words.clockwise, tolerance, command);
}

Eigen::Vector3d ArcNormal(const Command& arc) {
  if (!arc.arc_normal.isZero(0.0)) return arc.arc_normal;
  return Eigen::Vector3d::Unit(AxesOf(arc.plane).normal);
}

Eigen::Vector3d EndTangent(const Command& arc) {
  const Eigen::Vector3d radius =
      Eigen::Vector3d(arc.end[kX], arc.end[kY], arc.end[kZ]) - arc.centre;
  const Eigen::Vector3d normal = ArcNormal(arc);
  return arc.clockwise ? radius.cross(normal) : normal.cross(radius);
}

}  // namespace ncsim::control
