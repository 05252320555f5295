// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/plane_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/units.h"

namespace ncsim::control {
namespace {

constexpr double kNothing = 1e-9;

double Cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

Point Unit(const Point& v) {
  const double n = v.norm();
  return n > 0.0 ? Point(v / n) : Point::Zero();
}

bool Contains(const Curve& curve, const Point& point) {
  const double along = curve.Along(point);
  return along >= -kNothing && along <= curve.length() + kNothing;
}

double DistanceToPoint(const Curve& curve, const Point& point) {
  double best = std::min((point - curve.start).norm(), (point - curve.end).norm());
  if (curve.arc) {
    if (Contains(curve, point)) {
      best = std::min(best, std::abs((point - curve.centre).norm() - curve.radius));
    }
    return best;
  }
  const Point t = curve.start_tangent();
  if (Contains(curve, point)) best = std::min(best, std::abs(Cross(t, point - curve.start)));
  return best;
}

// Points inside `a` where the distance to `b` can be least without an end of either taking part.
void InnerCandidates(const Curve& a, const Curve& b, std::vector<Point>* out) {
  const auto add = [&](const Point& point) {
    if (Contains(a, point)) out->push_back(point);
  };
  if (!a.arc && b.arc) {
    const Point t = a.start_tangent();
    add(a.start + t * t.dot(b.centre - a.start));
  } else if (a.arc) {
    const Point u = b.arc ? Unit(b.centre - a.centre) : Left(b.start_tangent());
    add(a.centre + a.radius * u);
    add(a.centre - a.radius * u);
  }
}

std::vector<Point> LineCircle(const Curve& line, const Curve& circle) {
  const Point t = line.start_tangent();
  const Point foot = line.start + t * t.dot(circle.centre - line.start);
  const double distance = (foot - circle.centre).norm();
  const double half2 = circle.radius * circle.radius - distance * distance;
  if (half2 < 0.0) return {};
  const double half = std::sqrt(half2);
  return {foot - half * t, foot + half * t};
}

std::vector<Point> CircleCircle(const Curve& a, const Curve& b) {
  const Point between = b.centre - a.centre;
  const double distance = between.norm();
  if (distance < kNothing) return {};
  const double along =
      (a.radius * a.radius - b.radius * b.radius + distance * distance) / (2.0 * distance);
  const double half2 = a.radius * a.radius - along * along;
  if (half2 < 0.0) return {};
  const Point u = between / distance;
  const Point foot = a.centre + along * u;
  const Point half = std::sqrt(half2) * Left(u);
  return {foot - half, foot + half};
}

}  // namespace

Curve Curve::Line(const Point& start, const Point& end) {
  Curve curve;
  curve.start = start;
  curve.end = end;
  return curve;
}

Curve Curve::Arc(const Point& start, const Point& end, const Point& centre, double sweep) {
  Curve curve = Line(start, end);
  curve.arc = true;
  curve.centre = centre;
  curve.radius = (start - centre).norm();
  curve.sweep = sweep;
  return curve;
}

double Curve::length() const { return arc ? radius * std::abs(sweep) : (end - start).norm(); }

Point Curve::start_tangent() const {
  if (!arc) return Unit(end - start);
  const Point left = Left(Unit(start - centre));
  return sweep > 0.0 ? left : Point(-left);
}

Point Curve::end_tangent() const {
  if (!arc) return Unit(end - start);
  const Point left = Left(Unit(end - centre));
  return sweep > 0.0 ? left : Point(-left);
}

double Curve::Along(const Point& point) const {
  if (!arc) return start_tangent().dot(point - start);
  const double turn = Turn(start - centre, point - centre);
  double angle = sweep > 0.0 ? turn : -turn;
  if (angle < 0.0) angle += 2.0 * kPi;
  // A point in the part of the circle that the arc leaves out is before the start or after the end,
  // whichever is nearer.
  const double total = std::abs(sweep);
  if (angle > total + 0.5 * (2.0 * kPi - total)) angle -= 2.0 * kPi;
  return angle * radius;
}

double Turn(const Point& a, const Point& b) { return std::atan2(Cross(a, b), a.dot(b)); }

bool CanOffset(const Curve& curve, double offset) {
  if (!curve.arc) return true;
  const double change = curve.sweep > 0.0 ? -offset : offset;
  return curve.radius + change > kNothing && (curve.end - curve.centre).norm() + change > kNothing;
}

Curve OffsetLeft(const Curve& curve, double offset) {
  const Point start = curve.start + offset * Left(curve.start_tangent());
  const Point end = curve.end + offset * Left(curve.end_tangent());
  return curve.arc ? Curve::Arc(start, end, curve.centre, curve.sweep) : Curve::Line(start, end);
}

std::vector<Point> Intersections(const Curve& a, const Curve& b) {
  if (a.arc && b.arc) return CircleCircle(a, b);
  if (a.arc) return LineCircle(b, a);
  if (b.arc) return LineCircle(a, b);
  const Point t = a.start_tangent();
  const Point u = b.start_tangent();
  const double cross = Cross(t, u);
  if (std::abs(cross) < 1e-12) return {};
  return {Point(a.start + t * (Cross(b.start - a.start, u) / cross))};
}

double Distance(const Curve& a, const Curve& b) {
  for (const Point& point : Intersections(a, b)) {
    if (Contains(a, point) && Contains(b, point)) return 0.0;
  }
  double best = std::min({DistanceToPoint(a, b.start), DistanceToPoint(a, b.end),
                          DistanceToPoint(b, a.start), DistanceToPoint(b, a.end)});
  std::vector<Point> inner;
  InnerCandidates(a, b, &inner);
  for (const Point& point : inner) best = std::min(best, DistanceToPoint(b, point));
  inner.clear();
  InnerCandidates(b, a, &inner);
  for (const Point& point : inner) best = std::min(best, DistanceToPoint(a, point));
  return best;
}

}  // namespace ncsim::control
