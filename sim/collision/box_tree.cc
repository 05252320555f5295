// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/box_tree.h"

#include <algorithm>
#include <limits>

namespace ncsim::collision {

namespace {

using Eigen::Vector3d;

constexpr int kLeafSize = 3;

}  // namespace

BoxTree::BoxTree(const machine::TriangleMesh& mesh) {
  triangles_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    triangles_.push_back({mesh.vertices[static_cast<std::size_t>(t[0])],
                          mesh.vertices[static_cast<std::size_t>(t[1])],
                          mesh.vertices[static_cast<std::size_t>(t[2])]});
  }
  if (triangles_.empty()) return;
  nodes_.reserve(2 * triangles_.size());
  nodes_.emplace_back();
  Build(0, 0, static_cast<int>(triangles_.size()));
}

void BoxTree::Build(int index, int begin, int end) {
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

}  // namespace ncsim::collision
