// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/triangle_tree.h"

#include <Eigen/Eigenvalues>
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

constexpr int kTurned = 512;  // triangles; the box of more is not turned

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

Eigen::AlignedBox3d Bounds(const std::vector<TriangleTree::Triangle>& triangles, int begin,
                           int end) {
  Eigen::AlignedBox3d box;
  for (int i = begin; i < end; ++i) {
    for (const Vector3d& v : triangles[static_cast<std::size_t>(i)]) box.extend(v);
  }
  return box;
}

// Three times a coordinate of the centroid.
double Place(const TriangleTree::Triangle& t, int axis) {
  return t[0][axis] + t[1][axis] + t[2][axis];
}

struct Bin {
  Eigen::AlignedBox3d box;
  int count = 0;

  double Cost() const {
    const Vector3d s = box.sizes();
    return count == 0 ? 0.0 : count * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
  }
  void Add(const Bin& other) {
    box.extend(other.box);
    count += other.count;
  }
};

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
bool MeetsBox(const WideBoxes& boxes, int lane, const Vector3d& origin, const Vector3d& direction,
              double from) {
  double lo = from;
  double hi = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double centre = static_cast<double>(boxes.centre[k][lane]);
    double pad = 1e-9 * (1.0 + std::abs(centre));
    for (const auto& half : boxes.half) pad += std::abs(static_cast<double>(half[k][lane]));
    const double offset = centre - origin[k];
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
  const Vector3d local = origin - tree.origin();
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const TriangleTree::Node& node = tree.node(stack.back());
    stack.pop_back();
    for (int lane = 0; lane < node.count; ++lane) {
      if (!MeetsBox(node.boxes, lane, local, direction, from)) continue;
      if (node.child[lane] >= 0) {
        stack.push_back(node.child[lane]);
        continue;
      }
      const int leaf = ~node.child[lane];
      for (int i = 0; i < tree.leaf_size(leaf); ++i) {
        if (!visit(kWide * leaf + i)) return;
      }
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
  box_ = Bounds(triangles_, 0, size());
  origin_ = box_.center();
  nodes_.emplace_back();
  Build(0, {0, size()});
  PackLeaves();
}

// Ranges are cut in two, the longest first, until there are eight.
void TriangleTree::Build(int index, Range whole) {
  std::array<Range, kWide> ranges{whole};
  int count = 1;
  while (count < kWide) {
    const auto longest = std::max_element(
        ranges.begin(), ranges.begin() + count,
        [](const Range& a, const Range& b) { return a.end - a.begin < b.end - b.begin; });
    if (longest->end - longest->begin <= kWide) break;
    const int middle = Split(*longest);
    ranges[static_cast<std::size_t>(count++)] = {middle, longest->end};
    longest->end = middle;
  }
  Node node;
  node.count = count;
  for (int lane = 0; lane < kWide; ++lane) {
    // Lanes to spare repeat the last.
    const Range range = ranges[static_cast<std::size_t>(std::min(lane, count - 1))];
    SetBox(range, lane, &node.boxes);
    if (lane >= count) continue;
    if (range.end - range.begin <= kWide) {
      node.child[lane] = ~(range.begin / kWide);
    } else {
      node.child[lane] = static_cast<int>(nodes_.size());
      nodes_.emplace_back();
      Build(node.child[lane], range);
    }
  }
  nodes_[static_cast<std::size_t>(index)] = node;
}

// Where the surface of the two boxes, each times its triangles, is least: long triangles go apart
// from short ones. Leaves are full but for the last: the left side takes a multiple of eight.
int TriangleTree::Split(Range range) {
  int axis = 0;
  int left = (range.end - range.begin) / 2;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    for (const Cut& cut : Cuts(range, k)) {
      if (cut.cost >= least) continue;
      least = cut.cost;
      left = cut.left;
      axis = k;
    }
  }
  const int middle = range.begin + std::clamp((left + kWide / 2) / kWide * kWide, kWide,
                                              (range.end - range.begin - 1) / kWide * kWide);
  std::nth_element(
      triangles_.begin() + range.begin, triangles_.begin() + middle, triangles_.begin() + range.end,
      [axis](const Triangle& a, const Triangle& b) { return Place(a, axis) < Place(b, axis); });
  return middle;
}

// Between bins of equal width. A sample of many triangles tells as much as all of them.
std::vector<TriangleTree::Cut> TriangleTree::Cuts(Range range, int axis) const {
  constexpr int kBins = 16;
  constexpr int kSample = 1024;
  const int stride = 1 + (range.end - range.begin) / kSample;
  double lower = std::numeric_limits<double>::infinity();
  double upper = -lower;
  for (int i = range.begin; i < range.end; i += stride) {
    lower = std::min(lower, Place(triangle(i), axis));
    upper = std::max(upper, Place(triangle(i), axis));
  }
  std::vector<Cut> cuts;
  if (!(upper > lower)) return cuts;
  const double scale = kBins / (upper - lower);
  std::array<Bin, kBins> bins;
  for (int i = range.begin; i < range.end; i += stride) {
    const int at = static_cast<int>((Place(triangle(i), axis) - lower) * scale);
    Bin& bin = bins[static_cast<std::size_t>(std::min(at, kBins - 1))];
    for (const Vector3d& v : triangle(i)) bin.box.extend(v);
    bin.count += stride;
  }
  std::array<Bin, kBins> right = bins;
  for (std::size_t i = kBins - 1; i-- > 0;) right[i].Add(right[i + 1]);
  Bin sum;
  for (std::size_t i = 0; i + 1 < kBins; ++i) {
    sum.Add(bins[i]);
    cuts.push_back({sum.Cost() + right[i + 1].Cost(), sum.count});
  }
  return cuts;
}

void TriangleTree::SetBox(Range range, int lane, WideBoxes* boxes) const {
  OrientedBox box = BoxAlong(Eigen::Matrix3d::Identity(), range);
  if (range.end - range.begin <= kTurned) {
    const OrientedBox turned = BoxAlong(PrincipalAxes(range), range);
    if (turned.half.sum() < box.half.sum()) box = turned;
  }
  for (int k = 0; k < 3; ++k) {
    boxes->centre[k][lane] = static_cast<float>(box.centre[k]);
    for (int i = 0; i < 3; ++i) {
      boxes->half[i][k][lane] = static_cast<float>(box.half[i] * box.axes(k, i));
    }
  }
}

Eigen::Matrix3d TriangleTree::PrincipalAxes(Range range) const {
  const int corners = 3 * (range.end - range.begin);
  Vector3d mean = Vector3d::Zero();
  for (int i = range.begin; i < range.end; ++i)
    mean += triangle(i)[0] + triangle(i)[1] + triangle(i)[2];
  mean /= corners;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int i = range.begin; i < range.end; ++i) {
    for (const Vector3d& v : triangle(i)) spread += (v - mean) * (v - mean).transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
}

TriangleTree::OrientedBox TriangleTree::BoxAlong(const Eigen::Matrix3d& axes, Range range) const {
  OrientedBox box;
  box.axes = axes.cast<float>().cast<double>();
  const Eigen::Matrix3d inverse = box.axes.inverse();
  Eigen::AlignedBox3d bounds;
  for (int i = range.begin; i < range.end; ++i) {
    for (const Vector3d& v : triangle(i)) bounds.extend(inverse * (v - origin_));
  }
  box.centre = (box.axes * bounds.center()).cast<float>().cast<double>();
  const Vector3d moved = inverse * box.centre;
  box.half = (bounds.max() - moved).cwiseMax(moved - bounds.min());
  // More than single precision may turn or move a face.
  box.half.array() += 1e-6 * box.half.sum();
  return box;
}

void TriangleTree::PackLeaves() {
  leaves_.resize(static_cast<std::size_t>((size() + kWide - 1) / kWide));
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    for (int lane = 0; lane < kWide; ++lane) {
      // Lanes to spare repeat the last.
      const Triangle& t = triangle(std::min(static_cast<int>(leaf) * kWide + lane, size() - 1));
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vector3d p = t[corner] - origin_;
        for (int k = 0; k < 3; ++k) {
          leaves_[leaf].corner[corner][k][lane] = static_cast<float>(p[k]);
        }
      }
    }
  }
}

bool TriangleTree::Contains(const Vector3d& p) const {
  if (empty()) return false;
  if (!box_.contains(p)) return false;
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
