// SPDX-License-Identifier: BSD-3-Clause
// A mesh as a tree of boxes, eight to a node: for branch and bound, and for point-in-solid tests.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "sim/collision/wide_bounds.h"
#include "sim/machine/mesh.h"

namespace ncsim::collision {

class TriangleTree {
 public:
  using Triangle = std::array<Eigen::Vector3d, 3>;
  struct Node {
    WideBoxes boxes;        ///< Padded: they hold what is below.
    int child[kWide] = {};  ///< A node, or the complement of a leaf.
    int count = 0;
  };

  explicit TriangleTree(const machine::TriangleMesh& mesh);

  bool empty() const { return triangles_.empty(); }
  int size() const { return static_cast<int>(triangles_.size()); }
  const Triangle& triangle(int index) const { return triangles_[static_cast<std::size_t>(index)]; }

  /// The root is node 0.
  const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
  /// The triangles from kWide * index on, kWide of them but in the last leaf.
  const WideTriangles& leaf(int index) const { return leaves_[static_cast<std::size_t>(index)]; }
  int leaf_size(int index) const { return std::min(kWide, size() - kWide * index); }
  /// Of boxes and leaves, and how far any of them reaches from there in a coordinate, mm.
  const Eigen::Vector3d& origin() const { return origin_; }
  double reach() const { return 0.5 * box_.sizes().maxCoeff(); }

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
  struct Range {
    int begin, end;
  };
  struct Cut {
    double cost;
    int left;  // triangles
  };
  void Build(int node, Range whole);
  int Split(Range range);
  std::vector<Cut> Cuts(Range range, int axis) const;
  struct OrientedBox {
    Eigen::Vector3d centre, half;
    Eigen::Matrix3d axes;
  };
  Eigen::Matrix3d PrincipalAxes(Range range) const;
  OrientedBox BoxAlong(const Eigen::Matrix3d& axes, Range range) const;
  void SetBox(Range range, int lane, WideBoxes* boxes) const;
  void PackLeaves();
  double SolidAngles(const Eigen::Vector3d& p) const;

  std::vector<Node> nodes_;
  std::vector<WideTriangles> leaves_;
  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> representatives_;
  Eigen::AlignedBox3d box_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

}  // namespace ncsim::collision
