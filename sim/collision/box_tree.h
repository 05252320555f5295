// SPDX-License-Identifier: BSD-3-Clause
// A mesh as a binary tree of boxes along its axes: for pairs of meshes, whose boxes are held
// against each other. (TriangleTree is for a solid of revolution against eight boxes at once.)
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/machine/mesh.h"

namespace ncsim::collision {

class BoxTree {
 public:
  struct Node {
    Eigen::Vector3d centre, half;  ///< Holds what is below, mm.
    int first = 0;  ///< Leaf: first triangle. Else: left child; the right one follows it.
    int count = 0;  ///< Triangles of a leaf; 0 for an inner node.
  };
  using Triangle = std::array<Eigen::Vector3d, 3>;

  explicit BoxTree(const machine::TriangleMesh& mesh);

  bool empty() const { return triangles_.empty(); }
  /// The root is node 0.
  const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
  const Triangle& triangle(int index) const { return triangles_[static_cast<std::size_t>(index)]; }

 private:
  void Build(int node, int begin, int end);

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace ncsim::collision
