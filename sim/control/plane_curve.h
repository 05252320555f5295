// SPDX-License-Identifier: BSD-3-Clause
// Lines and arcs of a plane, as cutter compensation needs them: offset, intersection, distance. mm,
// rad.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ncsim::control {

using Point = Eigen::Vector2d;

/// A line from `start` to `end`, or an arc about `centre` with the signed sweep (counter-clockwise
/// positive). The radius of an arc may differ a little between its ends (a control's tolerance):
/// `radius` is that of the start.
struct Curve {
  Point start = Point::Zero();
  Point end = Point::Zero();
  bool arc = false;
  Point centre = Point::Zero();
  double radius = 0.0;
  double sweep = 0.0;

  static Curve Line(const Point& start, const Point& end);
  static Curve Arc(const Point& start, const Point& end, const Point& centre, double sweep);

  double length() const;
  /// Unit tangents in the direction of travel; zero for a point.
  Point start_tangent() const;
  Point end_tangent() const;
  /// Distance along the curve of a point of its line or circle: from 0 at the start to length() at
  /// the end, negative before it, greater after.
  double Along(const Point& point) const;
};

/// The unit normal to the left of a unit tangent.
inline Point Left(const Point& tangent) { return {-tangent.y(), tangent.x()}; }

/// The angle from `a` to `b`, left positive, in (-pi, pi].
double Turn(const Point& a, const Point& b);

/// True where the offset to the left by `offset` (negative: right) leaves an arc a radius greater
/// than nothing.
bool CanOffset(const Curve& curve, double offset);
/// Needs CanOffset().
Curve OffsetLeft(const Curve& curve, double offset);

/// Points that the lines or circles of `a` and `b` (beyond their ends too) have in common: none,
/// one or two.
std::vector<Point> Intersections(const Curve& a, const Curve& b);

/// The least distance between points of `a` and `b`.
double Distance(const Curve& a, const Curve& b);

}  // namespace ncsim::control
