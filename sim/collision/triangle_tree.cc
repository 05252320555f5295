// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/triangle_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "sim/base/units.h"

namespace ncsim::collision {

namespace {

using Eigen::Vector3d;

constexpr int kLeafSize = 3;

std::vector<Vector3d> Representatives(const machine::TriangleMesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&parent](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      parent[static_cast<std::size_t>(i)] =
          parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
      i = parent[static_cast<std::size_t>(i)];
    }
    return i;
  };
  for (const auto& t : mesh.triangles) {
    for (int k = 1; k < 3; ++k) {
      parent[static_cast<std::size_t>(find(t[static_cast<std::size_t>(k)]))] = find(t[0]);
    }
  }
  std::vector<bool> seen(mesh.vertices.size(), false);
  std::vector<Vector3d> result;
  for (const auto& t : mesh.triangles) {
    const auto root = static_cast<std::size_t>(find(t[0]));
    if (!seen[root]) result.push_back(mesh.vertices[root]);
    seen[root] = true;
  }
  return result;
}

enum class Crossing { kNone, kClean, kNearEdge };

// Moeller and Trumbore; `sign` is +1 where the line leaves the solid.
Crossing Cross(const TriangleTree::Triangle& tri, const Vector3d& origin, const Vector3d& direction,
               double* t, int* sign) {
  constexpr double kEdge = 1e-9;
  const Vector3d e1 = tri[1] - tri[0];
  const Vector3d e2 = tri[2] - tri[0];
  const Vector3d h = direction.cross(e2);
  const double det = e1.dot(h);
  const double scale = e1.norm() * e2.norm();
  if (std::abs(det) <= 1e-12 * scale) {
    // Seen edge-on. Only a line in (nearly) the triangle's own plane can matter.
    const Vector3d n = e1.cross(e2);
    const double off = n.norm() > 0.0 ? std::abs(n.dot(origin - tri[0])) / n.norm() : 0.0;
    return off < 1e-6 ? Crossing::kNearEdge : Crossing::kNone;
  }
  const Vector3d s = origin - tri[0];
  const double u = s.dot(h) / det;
  if (u < -kEdge || u > 1.0 + kEdge) return Crossing::kNone;
  const Vector3d q = s.cross(e1);
  const double v = direction.dot(q) / det;
  if (v < -kEdge || u + v > 1.0 + kEdge) return Crossing::kNone;
  *t = e2.dot(q) / det;
  *sign = det < 0.0 ? 1 : -1;
  const bool near = u < kEdge || v < kEdge || u + v > 1.0 - kEdge;
  return near ? Crossing::kNearEdge : Crossing::kClean;
}

// Does the line meet the box, at a parameter of at least `from`?
bool MeetsBox(const TriangleTree::Node& node, const Vector3d& origin, const Vector3d& direction,
              double from) {
  double lo = from;
  double hi = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double pad = node.half[k] + 1e-9 * (1.0 + std::abs(node.centre[k]));
    const double offset = node.centre[k] - origin[k];
    if (std::abs(direction[k]) < 1e-300) {
      if (std::abs(offset) > pad) return false;
      continue;
    }
    const double a = (offset - pad) / direction[k];
    const double b = (offset + pad) / direction[k];
    lo = std::max(lo, std::min(a, b));
    hi = std::min(hi, std::max(a, b));
  }
  return lo <= hi;
}

// Calls `visit` for each triangle whose leaf the line meets, until it returns false.
void VisitLine(const TriangleTree& tree, const Vector3d& origin, const Vector3d& direction,
               double from, const std::function<bool(int)>& visit) {
  if (tree.empty()) return;
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const TriangleTree::Node& node = tree.node(stack.back());
    stack.pop_back();
    if (!MeetsBox(node, origin, direction, from)) continue;
    if (node.count == 0) {
      stack.push_back(node.first + 1);
      stack.push_back(node.first);
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      if (!visit(i)) return;
    }
  }
}

}  // namespace

TriangleTree::TriangleTree(const machine::TriangleMesh& mesh) {
  triangles_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    triangles_.push_back({mesh.vertices[static_cast<std::size_t>(t[0])],
                          mesh.vertices[static_cast<std::size_t>(t[1])],
                          mesh.vertices[static_cast<std::size_t>(t[2])]});
  }
  representatives_ = Representatives(mesh);
  if (triangles_.empty()) return;
  nodes_.reserve(2 * triangles_.size());
  nodes_.emplace_back();
  Build(0, 0, static_cast<int>(triangles_.size()));
}

void TriangleTree::Build(int index, int begin, int end) {
  Vector3d lo = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d hi = -lo;
  Vector3d clo = lo;
  Vector3d chi = hi;
  for (int i = begin; i < end; ++i) {
    const Triangle& t = triangle(i);
    for (const Vector3d& v : t) {
      lo = lo.cwiseMin(v);
      hi = hi.cwiseMax(v);
    }
    const Vector3d c = t[0] + t[1] + t[2];
    clo = clo.cwiseMin(c);
    chi = chi.cwiseMax(c);
  }
  Node& node = nodes_[static_cast<std::size_t>(index)];
  node.centre = 0.5 * (lo + hi);
  node.half = 0.5 * (hi - lo);
  if (end - begin <= kLeafSize) {
    node.first = begin;
    node.count = end - begin;
    return;
  }
  int axis = 0;
  (chi - clo).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                   triangles_.begin() + end, [axis](const Triangle& a, const Triangle& b) {
                     return a[0][axis] + a[1][axis] + a[2][axis] <
                            b[0][axis] + b[1][axis] + b[2][axis];
                   });
  const int left = static_cast<int>(nodes_.size());
  node.first = left;
  node.count = 0;
  nodes_.emplace_back();
  nodes_.emplace_back();
  Build(left, begin, middle);
  Build(left + 1, middle, end);
}

bool TriangleTree::Contains(const Vector3d& p) const {
  if (empty()) return false;
  const Node& root = nodes_.front();
  if (((p - root.centre).cwiseAbs() - root.half).maxCoeff() > 0.0) return false;
  static const std::array<Vector3d, 4> kDirections = {
      Vector3d(0.5773, 0.2113, 0.7887), Vector3d(-0.3137, 0.9219, 0.2271),
      Vector3d(0.8131, -0.4877, 0.3181), Vector3d(-0.1931, -0.3307, -0.9238)};
  for (const Vector3d& direction : kDirections) {
    int winding = 0;
    bool clean = true;
    VisitLine(*this, p, direction, 0.0, [&](int i) {
      double t = 0.0;
      int sign = 0;
      const Crossing crossing = Cross(triangle(i), p, direction, &t, &sign);
      if (crossing == Crossing::kNone) return true;
      if (crossing == Crossing::kNearEdge || std::abs(t) < 1e-9) {
        clean = false;
        return false;
      }
      if (t > 0.0) winding += sign;
      return true;
    });
    if (clean) return winding != 0;
  }
  return std::abs(SolidAngles(p)) > 2.0 * kPi;
}

double TriangleTree::SolidAngles(const Vector3d& p) const {
  double sum = 0.0;
  for (const Triangle& t : triangles_) {
    const Vector3d a = t[0] - p;
    const Vector3d b = t[1] - p;
    const Vector3d c = t[2] - p;
    const double na = a.norm();
    const double nb = b.norm();
    const double nc = c.norm();
    const double numerator = a.dot(b.cross(c));
    const double denominator = na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb;
    sum += 2.0 * std::atan2(numerator, denominator);
  }
  return sum;
}

std::vector<double> TriangleTree::Crossings(const Vector3d& origin,
                                            const Vector3d& direction) const {
  std::vector<double> result;
  VisitLine(*this, origin, direction, -std::numeric_limits<double>::infinity(), [&](int i) {
    double t = 0.0;
    int sign = 0;
    const Triangle& tri = triangle(i);
    if (Cross(tri, origin, direction, &t, &sign) != Crossing::kNone && sign != 0) {
      result.push_back(t);
    } else if (sign == 0) {
      // Edge-on triangles bound no interval of their own, but their corners may.
      for (const Vector3d& v : tri) {
        const double at = direction.dot(v - origin) / direction.squaredNorm();
        if ((origin + at * direction - v).norm() < 1e-6) result.push_back(at);
      }
    }
    return true;
  });
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace ncsim::collision
