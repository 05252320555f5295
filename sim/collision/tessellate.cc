// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/tessellate.h"

#include <algorithm>
#include <cmath>

#include "sim/base/units.h"
#include "sim/collision/profile_shape.h"

namespace ncsim::collision {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<Vector2d> Polyline(const machine::Profile& profile, double sagitta) {
  std::vector<Vector2d> points;
  const auto add = [&points](const Vector2d& p) {
    if (points.empty() || (points.back() - p).norm() > 1e-9) points.push_back(p);
  };
  for (const machine::ProfileElement& e : ClosedElements(profile)) {
    add(e.start);
    if (e.arc) {
      for (const Vector2d& p : CircumscribeArc(e, sagitta)) add(p);
    }
    add(e.end);
  }
  return points;
}

}  // namespace

machine::TriangleMesh Tessellate(const machine::Profile& profile, double length, double sagitta) {
  // Half the allowance along the profile and half around the axis: they add up at most.
  const double half = 0.49 * sagitta;
  const std::vector<Vector2d> points = Polyline(profile, half);
  double r_max = 0.0;
  for (const Vector2d& p : points) r_max = std::max(r_max, p.y());
  const double half_angle = std::acos(r_max / (r_max + half));
  const int sides = std::max(8, static_cast<int>(std::ceil(kPi / half_angle)));
  const double grow = 1.0 / std::cos(kPi / sides);

  machine::TriangleMesh mesh;
  mesh.watertight = true;
  struct Ring {
    int first;
    bool point;  // on the axis
  };
  std::vector<Ring> rings;
  for (const Vector2d& p : points) {
    const bool on_axis = p.y() < 1e-9;
    rings.push_back({static_cast<int>(mesh.vertices.size()), on_axis});
    const int count = on_axis ? 1 : sides;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * kPi * i / sides;
      const double r = on_axis ? 0.0 : p.y() * grow;
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), length - p.x());
    }
  }
  // The profile climbs from the tip, so z_S falls from ring to ring.
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    const Ring& low = rings[k];
    const Ring& high = rings[k + 1];
    for (int i = 0; i < sides; ++i) {
      const int j = (i + 1) % sides;
      if (!low.point) {
        mesh.triangles.push_back({low.first + i, high.first + (high.point ? 0 : j), low.first + j});
      }
      if (!high.point) {
        mesh.triangles.push_back({low.first + (low.point ? 0 : i), high.first + i, high.first + j});
      }
    }
  }
  return mesh;
}

}  // namespace ncsim::collision
