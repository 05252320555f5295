// SPDX-License-Identifier: BSD-3-Clause
// Distances that need no search, for the conformance test. Nothing here is shared with the kernel.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/collision/triangle_tree.h"

namespace ncsim::collision::closed {

using Eigen::Vector3d;
using Triangle = TriangleTree::Triangle;

/// The point of a triangle nearest to `p` (Ericson, "Real-Time Collision Detection", 2005, 5.1.5).
inline Vector3d NearestOnTriangle(const Vector3d& p, const Triangle& t) {
  const Vector3d ab = t[1] - t[0];
  const Vector3d ac = t[2] - t[0];
  const double d1 = ab.dot(p - t[0]);
  const double d2 = ac.dot(p - t[0]);
  if (d1 <= 0.0 && d2 <= 0.0) return t[0];
  const double d3 = ab.dot(p - t[1]);
  const double d4 = ac.dot(p - t[1]);
  if (d3 >= 0.0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return t[0] + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - t[2]);
  const double d6 = ac.dot(p - t[2]);
  if (d6 >= 0.0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return t[0] + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
  }
  return t[0] + (vb * ab + vc * ac) / (va + vb + vc);
}

/// Between two segments (Ericson, 5.1.9).
inline double SegmentSegment(const Vector3d& p, const Vector3d& p_end, const Vector3d& q,
                             const Vector3d& q_end) {
  const Vector3d u = p_end - p;
  const Vector3d v = q_end - q;
  const Vector3d w = p - q;
  const double a = u.squaredNorm();
  const double e = v.squaredNorm();
  const double f = v.dot(w);
  const double c = u.dot(w);
  const double b = u.dot(v);
  const double denominator = a * e - b * b;
  double s =
      denominator > 1e-12 * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  const double t = std::clamp((b * s + f) / e, 0.0, 1.0);
  s = std::clamp((b * t - c) / a, 0.0, 1.0);
  return (p + s * u - q - t * v).norm();
}

/// Between a segment and a triangle.
inline double SegmentTriangle(const Vector3d& p, const Vector3d& q, const Triangle& t) {
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double at_p = n.dot(p - t[0]);
  const double at_q = n.dot(q - t[0]);
  if (at_p * at_q < 0.0) {
    const Vector3d x = p + at_p / (at_p - at_q) * (q - p);
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      inside = inside && n.dot((t[(k + 1) % 3] - t[k]).cross(x - t[k])) >= 0.0;
    }
    if (inside) return 0.0;
  }
  double least =
      std::min((p - NearestOnTriangle(p, t)).norm(), (q - NearestOnTriangle(q, t)).norm());
  for (std::size_t k = 0; k < 3; ++k) {
    least = std::min(least, SegmentSegment(p, q, t[k], t[(k + 1) % 3]));
  }
  return least;
}

/// Signed distance of (z, r) to a cylinder about the axis.
inline double Cylinder(double z, double r, double z0, double z1, double radius) {
  const double along = std::max(z0 - z, z - z1);
  const double across = r - radius;
  return std::min(std::max(along, across), 0.0) +
         std::hypot(std::max(along, 0.0), std::max(across, 0.0));
}

/// Signed distance of (z, r) to a cone from a point at the origin to a disc of `radius` at
/// `height`.
inline double Cone(double z, double r, double height, double radius) {
  const auto segment = [z, r](double z0, double r0, double z1, double r1) {
    const double t = std::clamp(((z - z0) * (z1 - z0) + (r - r0) * (r1 - r0)) /
                                    ((z1 - z0) * (z1 - z0) + (r1 - r0) * (r1 - r0)),
                                0.0, 1.0);
    return std::hypot(z - z0 - t * (z1 - z0), r - r0 - t * (r1 - r0));
  };
  const double d = std::min(segment(0, 0, height, radius), segment(height, 0, height, radius));
  return z <= height && r * height <= z * radius ? -d : d;
}

}  // namespace ncsim::collision::closed
