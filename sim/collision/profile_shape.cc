// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/profile_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "sim/base/units.h"

namespace ncsim::collision {

namespace {

using Eigen::Vector2d;
using machine::ProfileElement;

constexpr double kTiny = 1e-12;

// Polar angle about an arc's centre: 0 toward the tip, pi / 2 outward, pi toward the gauge line.
double ArcAngle(const Vector2d& v) { return std::atan2(v.y(), -v.x()); }

double Cross(const Vector2d& a, const Vector2d& b) {
  // In the plane (-z, r), where the arc's angle turns counter-clockwise.
  return -a.x() * b.y() + a.y() * b.x();
}

ProfileElement Straight(const Vector2d& start, const Vector2d& end) {
  return {start, end, false, Vector2d::Zero()};
}

bool ConvexOutward(const ProfileElement& e) {
  return Cross(e.start - e.centre, e.end - e.centre) >= 0.0 && e.end.x() >= e.start.x();
}

std::vector<ProfileElement> HullElements(const std::vector<ProfileElement>& elements) {
  std::vector<Vector2d> points;
  for (const ProfileElement& e : elements) {
    const std::vector<Vector2d> more =
        e.arc ? CircumscribeArc(e, 1e-3) : std::vector<Vector2d>{e.start, e.end};
    points.insert(points.end(), more.begin(), more.end());
  }
  return ConvexHull(std::move(points)).elements;
}

// Greedy, from the tip: a part takes elements for as long as it stays convex when closed.
std::vector<ConvexProfile> ConvexParts(const std::vector<ProfileElement>& elements) {
  std::vector<ConvexProfile> parts;
  std::vector<ProfileElement> closed;
  machine::Profile part;
  for (const ProfileElement& e : elements) {
    part.elements.push_back(e);
    std::vector<ProfileElement> more = ClosedElements(part);
    if (closed.empty() || IsConvex(more)) {
      closed = std::move(more);
      continue;
    }
    parts.emplace_back(closed);
    part.elements = {e};
    closed = ClosedElements(part);
  }
  parts.emplace_back(closed);
  return parts;
}

}  // namespace

machine::Profile ConvexHull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  const double first = points.front().x();
  const double last = points.back().x();
  points.insert(points.begin(), Vector2d(first, 0.0));
  points.emplace_back(last, 0.0);
  std::vector<Vector2d> hull;
  for (const Vector2d& p : points) {
    while (hull.size() >= 2) {
      const Vector2d a = hull.back() - hull[hull.size() - 2];
      const Vector2d b = p - hull.back();
      if (a.x() * b.y() - a.y() * b.x() < 0.0) break;  // turns toward the axis: convex
      hull.pop_back();
    }
    if (hull.empty() || (hull.back() - p).norm() > kTiny) hull.push_back(p);
  }
  machine::Profile result;
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    result.elements.push_back(Straight(hull[i], hull[i + 1]));
  }
  return result;
}

std::vector<ProfileElement> ClosedElements(const machine::Profile& profile) {
  std::vector<ProfileElement> result;
  const auto add = [&result](const ProfileElement& e) {
    if ((e.end - e.start).norm() > kTiny) result.push_back(e);
  };
  const Vector2d first = profile.elements.front().start;
  const Vector2d last = profile.elements.back().end;
  add(Straight({first.x(), 0.0}, first));
  for (const ProfileElement& e : profile.elements) {
    add(e.arc && ConvexOutward(e) ? e : Straight(e.start, e.end));
  }
  add(Straight(last, {last.x(), 0.0}));
  return result;
}

std::vector<Vector2d> CircumscribeArc(const ProfileElement& element, double sagitta) {
  const Vector2d from = element.start - element.centre;
  const double radius = std::max(from.norm(), (element.end - element.centre).norm());
  const double a0 = ArcAngle(from);
  const double sweep = std::max(0.0, ArcAngle(element.end - element.centre) - a0);
  // A corner of tangents at a0 and a0 + step is radius / cos(step / 2) from the centre.
  const double step = 2.0 * std::acos(radius / (radius + sagitta));
  const int count = std::max(1, static_cast<int>(std::ceil(sweep / step)));
  const double corner = radius / std::cos(0.5 * sweep / count);
  std::vector<Vector2d> points{element.start};
  for (int i = 0; i < count; ++i) {
    const double angle = a0 + sweep * (i + 0.5) / count;
    points.push_back(element.centre + corner * Vector2d(-std::cos(angle), std::sin(angle)));
  }
  points.push_back(element.end);
  return points;
}

ProfileChain::ProfileChain(const std::vector<ProfileElement>& elements) {
  for (const ProfileElement& e : elements) {
    Element out;
    out.arc = e.arc;
    out.start = e.start;
    out.end = e.end;
    out.length = (e.end - e.start).norm();
    out.direction = (e.end - e.start) / out.length;
    out.centre = e.centre;
    out.from = out.to = Vector2d::Zero();
    if (e.arc) {
      out.radius = std::max((e.start - e.centre).norm(), (e.end - e.centre).norm());
      out.from = (e.start - e.centre).normalized();
      out.to = (e.end - e.centre).normalized();
    }
    elements_.push_back(out);
  }
}

Vector2d ProfileChain::Nearest(double z, double r) const {
  const Vector2d p(z, r);
  Vector2d nearest = Vector2d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const Element& e : elements_) {
    Vector2d q;
    if (!e.arc) {
      const double t = std::clamp(e.direction.dot(p - e.start), 0.0, e.length);
      q = e.start + t * e.direction;
    } else {
      const Vector2d v = p - e.centre;
      const double norm = v.norm();
      if (norm > kTiny && Cross(e.from, v) >= 0.0 && Cross(v, e.to) >= 0.0) {
        q = e.centre + v * (e.radius / norm);
      } else {
        q = (p - e.start).squaredNorm() < (p - e.end).squaredNorm() ? e.start : e.end;
      }
    }
    const double squared = (p - q).squaredNorm();
    if (squared < least) {
      least = squared;
      nearest = q;
    }
  }
  return nearest;
}

bool ProfileChain::Inside(double z, double r) const {
  for (const Element& e : elements_) {
    if (z < e.start.x() || z > e.end.x() || e.end.x() <= e.start.x()) continue;
    double limit = 0.0;
    if (e.arc) {
      const double dz = z - e.centre.x();
      limit = e.centre.y() + std::sqrt(std::max(0.0, e.radius * e.radius - dz * dz));
    } else {
      limit =
          e.start.y() + (e.end.y() - e.start.y()) * (z - e.start.x()) / (e.end.x() - e.start.x());
    }
    if (r <= limit) return true;
  }
  return false;
}

double ProfileChain::Distance(double z, double r) const {
  const double d = (Vector2d(z, r) - Nearest(z, r)).norm();
  return Inside(z, r) ? -d : d;
}

ProfileShape::ProfileShape(const machine::Profile& profile) {
  const std::vector<ProfileElement> elements = ClosedElements(profile);
  exact_ = ProfileChain(elements);
  z_min_ = elements.front().start.x();
  z_max_ = elements.back().end.x();
  for (const ProfileElement& e : elements) {
    r_max_ = std::max({r_max_, e.start.y(), e.end.y()});
    if (e.arc) r_max_ = std::max(r_max_, e.centre.y() + (e.start - e.centre).norm());
  }
  parts_ = ConvexParts(elements);
  hull_ = convex() ? parts_.front() : ConvexProfile(HullElements(elements));
  inradius_ =
      -MinimiseOnAxis(z_min_, z_max_, 1e-3, -std::numeric_limits<double>::infinity(), &inradius_z_);
}

double ProfileShape::LeastOnAxis(double z0, double z1) const {
  z0 = std::max(z0, z_min_);
  z1 = std::min(z1, z_max_);
  if (z1 < z0) return std::numeric_limits<double>::infinity();
  double at = 0.0;
  return MinimiseOnAxis(z0, z1, 3e-3, -inradius_ - 1e-3, &at);
}

// Best first over intervals; the distance changes by no more than the way along the axis. A
// constant stretch (a cylinder longer than wide) cannot be told from its neighbours, so the
// distance that any ball can have there is the other stop: `stop`, or half the length, or the
// greatest radius.
double ProfileShape::MinimiseOnAxis(double z0, double z1, double gap, double stop,
                                    double* at) const {
  struct Piece {
    double lower, centre, half;
    bool operator<(const Piece& o) const { return lower > o.lower; }
  };
  const double least = std::max(stop, -r_max_);
  std::priority_queue<Piece> queue;
  double best = std::numeric_limits<double>::infinity();
  const auto push = [&](double centre, double half) {
    const double d = exact_.Distance(centre, 0.0);
    if (d < best) {
      best = d;
      *at = centre;
    }
    queue.push({std::max(d - half, least), centre, half});
  };
  push(0.5 * (z0 + z1), 0.5 * (z1 - z0));
  for (int i = 0; i < 200000 && !queue.empty(); ++i) {
    const Piece piece = queue.top();
    if (piece.lower >= best - gap) break;
    queue.pop();
    push(piece.centre - 0.5 * piece.half, 0.5 * piece.half);
    push(piece.centre + 0.5 * piece.half, 0.5 * piece.half);
  }
  return best;
}

}  // namespace ncsim::collision
