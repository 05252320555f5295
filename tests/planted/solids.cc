// SPDX-License-Identifier: BSD-3-Clause
#include "tests/planted/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/collision/test_shapes.h"
#include "tests/planted/truth.h"

namespace ncsim::planted {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// 0 inside.
double DistanceToPolygon(const Vector2d& p, const std::vector<Vector2d>& base) {
  bool inside = true;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < base.size(); ++i) {
    const Vector2d& a = base[i];
    const Vector2d edge = base[(i + 1) % base.size()] - a;
    inside = inside && Cross(edge, p - a) >= 0.0;
    const double along = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - along * edge).squaredNorm());
  }
  return inside ? 0.0 : std::sqrt(least);
}

/// 0 inside: the prism is a product of a polygon and an interval.
double DistanceToPrism(const Vector3d& p, const Prism& prism) {
  const double z = std::max({prism.z0 - p.z(), p.z() - prism.z1, 0.0});
  const double across = DistanceToPolygon(p.head<2>(), prism.base);
  return std::sqrt(across * across + z * z);
}

double DistanceToTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                          const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  const std::array<Vector3d, 3> corners{a, b, c};
  bool above = true;  // the foot of the perpendicular is in the triangle
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d edge = corners[(i + 1) % 3] - corners[i];
    const Vector3d from = p - corners[i];
    above = above && n.dot(edge.cross(from)) >= 0.0;
    const double along = std::clamp(from.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (from - along * edge).norm());
  }
  return above ? std::abs(n.normalized().dot(p - a)) : least;
}

/// 0 inside.
double DistanceToFacets(const Vector3d& p, const machine::TriangleMesh& mesh) {
  bool inside = true;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vector3d& b = mesh.vertices[static_cast<std::size_t>(t[1])];
    const Vector3d& c = mesh.vertices[static_cast<std::size_t>(t[2])];
    inside = inside && (b - a).cross(c - a).dot(p - a) <= 0.0;
    least = std::min(least, DistanceToTriangle(p, a, b, c));
  }
  return inside ? 0.0 : least;
}

/// Least of DistanceToPrism over the piece of the axis that a capsule is made about: a convex
/// function along it.
double CapsuleClearance(const Cutter& cutter, const ToolPose& tool, const Prism& prism) {
  const Vector3d low = tool.tip + (cutter.z0 + cutter.radius) * tool.axis;
  const double length = cutter.z1 - cutter.z0 - 2.0 * cutter.radius;
  if (length <= 0.0) return DistanceToPrism(low, prism) - cutter.radius;
  const Vector3d along = length * tool.axis;
  return LeastOfConvex([&](double t) { return DistanceToPrism(low + t * along, prism); }).upper -
         cutter.radius;
}

double UprightClearance(const Cutter& cutter, const ToolPose& tool, const Prism& prism) {
  // Signed grows with rho, and is convex in z with its least at the middle, whatever rho.
  const double rho = DistanceToPolygon(tool.tip.head<2>(), prism.base);
  const double z = std::clamp(cutter.Middle(), prism.z0 - tool.tip.z(), prism.z1 - tool.tip.z());
  return cutter.Signed(rho, z);
}

/// Of a rim to the plane z = 0. Where it is below, the tool that is smaller by d all around has its
/// rim d further in and d further from the end: it rises by d (|cos| + sin).
double RimClearance(double rim_z, double sine, double cosine, double radius) {
  const double height = rim_z - radius * sine;
  return height >= 0.0 ? height : height / (std::abs(cosine) + sine);
}

double PlaneClearance(const Cutter& cutter, const ToolPose& tool) {
  const double cosine = tool.axis.z();
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double low = tool.tip.z() + cutter.z0 * cosine;
  const double high = tool.tip.z() + cutter.z1 * cosine;
  return std::max(cutter.Floor(), std::min(RimClearance(low, sine, cosine, cutter.radius),
                                           RimClearance(high, sine, cosine, cutter.radius)));
}

void Append(const machine::TriangleMesh& from, bool inside_out, machine::TriangleMesh* mesh) {
  const int first = static_cast<int>(mesh->vertices.size());
  mesh->vertices.insert(mesh->vertices.end(), from.vertices.begin(), from.vertices.end());
  for (auto t : from.triangles) {
    if (inside_out) std::swap(t[1], t[2]);
    mesh->triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

Prism BoxPrism(const Vector3d& lower, const Vector3d& upper) {
  return {{{lower.x(), lower.y()},
           {upper.x(), lower.y()},
           {upper.x(), upper.y()},
           {lower.x(), upper.y()}},
          lower.z(),
          upper.z()};
}

/// Top of an open pocket: the frame between the two rectangles in place of the two tops.
void OpenTop(machine::TriangleMesh* mesh) {
  // BoxMesh: triangles 2 and 3 are the top, of vertices 4, 5, 7, 6 around; the inner box follows.
  mesh->triangles.erase(mesh->triangles.begin() + 14, mesh->triangles.begin() + 16);
  mesh->triangles.erase(mesh->triangles.begin() + 2, mesh->triangles.begin() + 4);
  constexpr std::array<int, 4> kAround{4, 5, 7, 6};
  for (std::size_t i = 0; i < 4; ++i) {
    const int a = kAround[i];
    const int b = kAround[(i + 1) % 4];
    mesh->triangles.push_back({a, b, b + 8});
    mesh->triangles.push_back({a, b + 8, a + 8});
  }
}

}  // namespace

double Cutter::Signed(double rho, double z) const {
  const auto core = [&](double dz) {
    const double dr = rho - (radius - corner);
    return std::hypot(std::max(dr, 0.0), std::max(dz, 0.0)) + std::min(std::max(dr, dz), 0.0) -
           corner;
  };
  if (round_top) return core(std::abs(z - Middle()) - (0.5 * (z1 - z0) - corner));
  if (z > z1) return std::hypot(std::max(rho - radius, 0.0), z - z1);
  const double lower = core(z0 + corner - z);
  return lower > 0.0 ? lower : std::max(lower, z - z1);
}

machine::Profile Cutter::Profile() const {
  machine::Profile profile;
  const auto add = [&profile](const Vector2d& a, const Vector2d& b) {
    if (a != b) profile.elements.push_back({a, b, false, Vector2d::Zero()});
  };
  const double flat = radius - corner;
  const double top = round_top ? z1 - corner : z1;
  add({z0, 0.0}, {z0, flat});
  if (corner > 0.0) {
    profile.elements.push_back({{z0, flat}, {z0 + corner, radius}, true, {z0 + corner, flat}});
  }
  add({z0 + corner, radius}, {top, radius});
  if (round_top) {
    profile.elements.push_back({{top, radius}, {z1, flat}, true, {top, flat}});
    add({z1, flat}, {z1, 0.0});
  } else {
    add({z1, radius}, {z1, 0.0});
  }
  return profile;
}

double Clearance(const Cutter& cutter, const ToolPose& tool, const Part& part) {
  if (std::holds_alternative<HalfSpace>(part)) return PlaneClearance(cutter, tool);
  if (const auto* facets = std::get_if<Facets>(&part)) {
    const Vector3d centre = tool.tip + cutter.Middle() * tool.axis;
    return DistanceToFacets(centre, facets->mesh) - cutter.radius;
  }
  const Prism& prism = std::get<Prism>(part);
  if (tool.axis == Vector3d::UnitZ()) return UprightClearance(cutter, tool, prism);
  return CapsuleClearance(cutter, tool, prism);
}

Solid Block(const Vector3d& lower, const Vector3d& upper) {
  return {{BoxPrism(lower, upper)}, collision::BoxMesh(lower, upper)};
}

Solid PrismSolid(const std::vector<Vector2d>& base, double z0, double z1) {
  Solid solid;
  solid.parts.emplace_back(Prism{base, z0, z1});
  machine::TriangleMesh& mesh = solid.mesh;
  const int n = static_cast<int>(base.size());
  for (double z : {z0, z1}) {
    for (const Vector2d& p : base) mesh.vertices.emplace_back(p.x(), p.y(), z);
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
    if (i == 0 || j == 0) continue;
    mesh.triangles.push_back({0, j, i});
    mesh.triangles.push_back({n, n + i, n + j});
  }
  mesh.watertight = true;
  return solid;
}

std::vector<Vector2d> RegularBase(int sides, double radius, double turn) {
  std::vector<Vector2d> base;
  for (int i = 0; i < sides; ++i) {
    const double angle = turn + 2.0 * std::numbers::pi * i / sides;
    base.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return base;
}

Solid PocketBlock(const Vector3d& lower, const Vector3d& upper, const Vector3d& inner_lower,
                  const Vector3d& inner_upper) {
  Solid solid;
  const bool open = inner_upper.z() >= upper.z();
  Append(collision::BoxMesh(lower, upper), false, &solid.mesh);
  Append(collision::BoxMesh(
             inner_lower, {inner_upper.x(), inner_upper.y(), std::min(inner_upper.z(), upper.z())}),
         true, &solid.mesh);
  if (open) OpenTop(&solid.mesh);
  solid.mesh.watertight = true;
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d below = upper;
    below[axis] = inner_lower[axis];
    solid.parts.emplace_back(BoxPrism(lower, below));
    Vector3d above = lower;
    above[axis] = inner_upper[axis];
    if (axis < 2 || !open) solid.parts.emplace_back(BoxPrism(above, upper));
  }
  return solid;
}

Solid Plate(double half, double thickness) {
  return {{HalfSpace{}}, collision::BoxMesh({-half, -half, -thickness}, {half, half, 0.0})};
}

Solid FacetedSphere(double radius, int rings) {
  const machine::TriangleMesh mesh = collision::SphereMesh(Vector3d::Zero(), radius, rings);
  return {{Facets{mesh}}, mesh};
}

}  // namespace ncsim::planted
