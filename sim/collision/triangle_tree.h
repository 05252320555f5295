// SPDX-License-Identifier: BSD-3-Clause
// A mesh as a tree of boxes: for branch and bound, and for point-in-solid tests.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/machine/mesh.h"

namespace ncsim::collision {

class TriangleTree {
 public:
  struct Node {
    Eigen::Vector3d centre, half;  ///< Box, mm.
    int first = 0;  ///< Leaf: first triangle. Else: left child; the right one follows it.
    int count = 0;  ///< Triangles of a leaf; 0 for an inner node.
  };
  using Triangle = std::array<Eigen::Vector3d, 3>;

  explicit TriangleTree(const machine::TriangleMesh& mesh);

  bool empty() const { return triangles_.empty(); }
  const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
  const Triangle& triangle(int index) const { return triangles_[static_cast<std::size_t>(index)]; }
  int size() const { return static_cast<int>(triangles_.size()); }

  /// Is `p` inside the solid that the (closed, outward) mesh bounds? Counts crossings of a ray with
  /// their sign, so shells may overlap; a ray that passes near an edge is replaced, at last by the
  /// sum of solid angles (Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", IEEE
  /// Trans. Biomed. Eng. 30, 1983).
  bool Contains(const Eigen::Vector3d& p) const;

  /// Parameters t at which the line origin + t direction meets a triangle, ascending; edges count
  /// for both sides.
  std::vector<double> Crossings(const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& direction) const;

  /// A vertex of each connected piece of the mesh.
  const std::vector<Eigen::Vector3d>& representatives() const { return representatives_; }

 private:
  void Build(int node, int begin, int end);
  double SolidAngles(const Eigen::Vector3d& p) const;

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> representatives_;
};

}  // namespace ncsim::collision
