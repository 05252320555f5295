// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/triangle_pair.h"

#include <algorithm>
#include <limits>

namespace ncsim::collision {

namespace {

using Eigen::Vector3d;
using Triangle = BoxTree::Triangle;

// Ericson, "Real-Time Collision Detection", 2005, 5.1.5: by the region of the triangle's plane.
Vector3d NearestOnTriangle(const Vector3d& p, const Triangle& t) {
  const Vector3d ab = t[1] - t[0];
  const Vector3d ac = t[2] - t[0];
  const Vector3d ap = p - t[0];
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return t[0];
  const Vector3d bp = p - t[1];
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) return t[0] + d1 / (d1 - d3) * ab;
  const Vector3d cp = p - t[2];
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) return t[0] + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  const double along = (d4 - d3) + (d5 - d6);
  if (va <= 0.0 && d4 >= d3 && d5 >= d6 && along > 0.0) {
    return t[1] + (d4 - d3) / along * (t[2] - t[1]);
  }
  const double sum = va + vb + vc;
  if (sum <= 0.0) return t[0];  // no area: the edges have what is nearest
  return t[0] + vb / sum * ab + vc / sum * ac;
}

// Ericson, 5.1.9.
NearPoints NearestOnSegments(const Vector3d& p1, const Vector3d& q1, const Vector3d& p2,
                             const Vector3d& q2) {
  const Vector3d d1 = q1 - p1;
  const Vector3d d2 = q2 - p2;
  const Vector3d r = p1 - p2;
  const double a = d1.squaredNorm();
  const double e = d2.squaredNorm();
  const double b = d1.dot(d2);
  const double c = d1.dot(r);
  const double f = d2.dot(r);
  const double det = a * e - b * b;
  double s = det > 0.0 ? std::clamp((b * f - c * e) / det, 0.0, 1.0) : 0.0;
  double t = e > 0.0 ? (b * s + f) / e : 0.0;
  if (t < 0.0 || t > 1.0 || !(e > 0.0)) {
    t = std::clamp(t, 0.0, 1.0);
    s = a > 0.0 ? std::clamp((t * b - c) / a, 0.0, 1.0) : 0.0;
  }
  return {p1 + s * d1, p2 + t * d2};
}

const Vector3d& Farthest(const Triangle& t, const Vector3d& direction) {
  const double d0 = direction.dot(t[0]);
  const double d1 = direction.dot(t[1]);
  const double d2 = direction.dot(t[2]);
  if (d0 >= d1 && d0 >= d2) return t[0];
  return d1 >= d2 ? t[1] : t[2];
}

}  // namespace

NearPoints NearestPoints(const Triangle& a, const Triangle& b) {
  NearPoints best{a[0], b[0]};
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vector3d& on_a, const Vector3d& on_b) {
    const double squared = (on_a - on_b).squaredNorm();
    if (squared >= least) return;
    least = squared;
    best = {on_a, on_b};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    offer(a[i], NearestOnTriangle(a[i], b));
    offer(NearestOnTriangle(b[i], a), b[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      const NearPoints near = NearestOnSegments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
      offer(near.a, near.b);
    }
  }
  return best;
}

double ShadowGap(const Vector3d& direction, const Triangle& a, const Triangle& b) {
  const double lower = std::min({direction.dot(a[0]), direction.dot(a[1]), direction.dot(a[2])});
  return lower - std::max({direction.dot(b[0]), direction.dot(b[1]), direction.dot(b[2])});
}

// Frank and Wolfe's method for the least vector from b to a: `way` is one, and the pair of corners
// that lie least far along it shows the way to a shorter one.
double SearchedGap(const Triangle& a, const Triangle& b, double enough) {
  constexpr int kLines = 4;
  Vector3d way = (a[0] + a[1] + a[2] - b[0] - b[1] - b[2]) / 3.0;
  double best = 0.0;
  for (int i = 0; i < kLines; ++i) {
    const double length = way.norm();
    if (!(length > 0.0) || length < enough) break;
    const Vector3d corners = Farthest(a, -way) - Farthest(b, way);
    best = std::max(best, way.dot(corners) / length);
    if (best >= enough) break;
    const Vector3d toward = corners - way;
    way += std::clamp(-way.dot(toward) / toward.squaredNorm(), 0.0, 1.0) * toward;
  }
  return best;
}

}  // namespace ncsim::collision
