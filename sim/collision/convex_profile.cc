// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/convex_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/units.h"

namespace ncsim::collision {

namespace {

using Eigen::Vector2d;
using machine::ProfileElement;

// Unit outward normal: the direction of travel turned away from the axis.
Vector2d LineNormal(const ProfileElement& e) {
  const Vector2d direction = (e.end - e.start).normalized();
  return {-direction.y(), direction.x()};
}
Vector2d StartNormal(const ProfileElement& e) {
  return e.arc ? Vector2d((e.start - e.centre).normalized()) : LineNormal(e);
}
Vector2d EndNormal(const ProfileElement& e) {
  return e.arc ? Vector2d((e.end - e.centre).normalized()) : LineNormal(e);
}

// 0 toward the tip, pi / 2 outward, pi toward the gauge line.
double Angle(const Vector2d& normal) { return std::atan2(normal.y(), -normal.x()); }

// Positive where `b` lies beyond `a` on the turn from the tip outward.
double Turn(const Vector2d& a, const Vector2d& b) { return a.y() * b.x() - a.x() * b.y(); }

}  // namespace

bool IsConvex(const std::vector<ProfileElement>& elements) {
  constexpr double kRounding = 1e-9;
  double previous = 0.0;
  for (const ProfileElement& e : elements) {
    const double start = Angle(StartNormal(e));
    const double end = Angle(EndNormal(e));
    if (start < previous - kRounding || end < start - kRounding) return false;
    previous = end;
  }
  return true;
}

ConvexProfile::ConvexProfile(const std::vector<ProfileElement>& elements) {
  Vector2d normal(-1.0, 0.0);
  const auto turn_at = [&](const Vector2d& corner, const Vector2d& next) {
    if (Turn(normal, next) > 0.0 || normal.dot(next) < 0.0)
      rounds_.push_back({corner, 0.0, normal, next});
  };
  for (const ProfileElement& e : elements) {
    turn_at(e.start, StartNormal(e));
    normal = EndNormal(e);
    if (e.arc) {
      const double radius = std::max((e.start - e.centre).norm(), (e.end - e.centre).norm());
      rounds_.push_back({e.centre, radius, StartNormal(e), normal});
    } else {
      lines_.push_back({normal, std::max(normal.dot(e.start), normal.dot(e.end))});
    }
  }
  turn_at(elements.back().end, {1.0, 0.0});
}

ConvexProfile::Support ConvexProfile::At(double z, double r) const {
  const Vector2d p(z, r);
  // Rounding must not leave a point between two sectors. A normal that far outside its sector puts
  // the line no further than that outside the solid.
  const double slack = 1e-12 * (1.0 + std::abs(z) + r);
  Support best;
  best.distance = -std::numeric_limits<double>::infinity();
  for (const Line& line : lines_) {
    const double distance = line.normal.dot(p) - line.offset;
    if (distance > best.distance) best = {distance, line.normal, 0.0};
  }
  for (const Round& round : rounds_) {
    const Vector2d v = p - round.centre;
    const double after = Turn(round.from, v);
    const double before = Turn(v, round.to);
    if (after < -slack || before < -slack) continue;
    const double length = v.norm();
    const bool centred = length < std::numeric_limits<double>::min();
    // Near a corner or the centre the direction of v is rounding: only normals of the sector make
    // lines that support the solid.
    Vector2d normal = round.from;
    if (!centred && after >= 0.0) normal = before >= 0.0 ? Vector2d(v / length) : round.to;
    const double distance = normal.dot(v) - round.radius;
    if (distance <= best.distance) continue;
    best = {distance, normal, 1.0 / std::max(length, 1e-9)};
  }
  return best;
}

}  // namespace ncsim::collision
