// SPDX-License-Identifier: BSD-3-Clause
// How near, or how deep, a solid of revolution is to a mesh: branch and bound with certificates.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "sim/collision/profile_shape.h"
#include "sim/collision/triangle_tree.h"

namespace ncsim::collision {

/// A certified interval for a clearance, mm; negative where the bodies overlap.
struct Interval {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// Where the solid of revolution stands in the mesh's frame: p(z) = tip + z axis.
struct RevolvedPose {
  Eigen::Vector3d tip;
  Eigen::Vector3d axis;  ///< Unit, from the tip toward the gauge line.
};

/// The pose of a tool whose frame S (gauge line, Z toward the tool) stands at X_GS in the mesh's
/// frame G.
RevolvedPose ToolPose(const Eigen::Isometry3d& X_GS, double length);

/// When to stop: as soon as one of these holds.
struct DistanceGoal {
  /// upper - lower <= max(gap, relative_gap * (lower - floor)): tight near `floor`, loose far above
  /// it.
  double gap = 2e-3;
  double relative_gap = 0.0;
  double floor = 0.0;
  double stop_above = std::numeric_limits<double>::infinity();   ///< lower is at least this.
  double stop_below = -std::numeric_limits<double>::infinity();  ///< upper is less than this.
  int max_evaluations = 200000;  ///< The interval is then wide, but still right.
};

/// Bounds on the least signed distance, over all points of the mesh's SURFACE, to the solid. Each
/// bound of a box or a piece of triangle is the best of two: the signed distance changes by no more
/// than the way; and where it is convex (the whole hull; a slab from outside) it lies above its
/// tangent plane. Floating-point error is covered by kKernelError.
class ProfileDistance {
 public:
  /// Both outlive this.
  ProfileDistance(const ProfileShape& shape, const TriangleTree& tree);

  Interval Surface(const RevolvedPose& pose, const DistanceGoal& goal);

  /// The same over all points of the mesh's SOLID: minus the least amount by which the profile must
  /// shrink to clear it. From any common inner point the way toward the axis never leads to a
  /// greater distance and ends on the mesh's surface or on the axis, so beside the surface only the
  /// axis inside the solid needs a look. The axis part of `upper` is within 0.003.
  Interval Solid(const RevolvedPose& pose, const DistanceGoal& goal);

  /// Is the middle of the solid's greatest ball inside the mesh? With no surface contact: is the
  /// tool inside it?
  bool Contained(const RevolvedPose& pose) const;

 private:
  struct Cell {
    double lower = 0.0;
    int node = -1;       ///< A box of the tree,
    int piece = -1;      ///< or else a piece of a triangle: index into pieces_.
    bool solve = false;  ///< A piece to be tried as a convex problem; else only halving helps.
  };
  struct Local {
    double z = 0.0, r = 0.0;
    Eigen::Vector3d radial;
  };
  Local ToLocal(const Eigen::Vector3d& p) const;
  Eigen::Vector3d Gradient(const Local& local, const Eigen::Vector2d& gradient) const;
  template <typename LeastLinear>
  double Bound(const Local& local, double distance, const Eigen::Vector2d& gradient, double radius,
               const LeastLinear& least_linear) const;
  double BoundNode(const TriangleTree::Node& node) const;
  double BoundPiece(const TriangleTree::Triangle& piece, double* at_centre, double* radius) const;
  void PushNode(int node);
  void PushPiece(const TriangleTree::Triangle& piece, double at_least, bool is_whole);
  int Keep(const TriangleTree::Triangle& piece);
  void Expand(const Cell& cell, const DistanceGoal& goal);
  double Solve(const TriangleTree::Triangle& piece, const DistanceGoal& goal);
  void Halve(const TriangleTree::Triangle& piece, double lower);
  void Push(const Cell& cell);

  const ProfileShape* shape_;
  const TriangleTree* tree_;
  RevolvedPose pose_;
  double upper_ = 0.0;
  int evaluations_ = 0;
  std::vector<Cell> heap_;
  std::vector<TriangleTree::Triangle> pieces_;
  std::vector<int> free_pieces_;
};

/// Covers rounding in the kernel for coordinates up to some metres, mm: chiefly the direction of
/// gradients within 1e-6 of the surface, over the width of a triangle.
inline constexpr double kKernelError = 1e-5;

}  // namespace ncsim::collision
