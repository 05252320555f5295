// SPDX-License-Identifier: BSD-3-Clause
// How near two meshes are: branch and bound over their trees, with certificates.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "sim/collision/box_tree.h"
#include "sim/collision/profile_distance.h"

namespace ncsim::collision {

/// Bounds on the distance of two meshes' SURFACES. What lies in two boxes is no nearer than the
/// gaps between the boxes' shadows on lines: on the three axes of either, which add as a vector.
/// Two triangles are no nearer than the gap between their shadows on ANY line: the one through the
/// points that were found nearest gives all of the distance, and a wrong one only gives less. So no
/// bound hangs on how those points were found.
class MeshDistance {
 public:
  /// Both outlive this.
  MeshDistance(const BoxTree& a, const BoxTree& b);

  /// With A at X_BA in the frame of B. Where the surfaces meet, or nearly so, `lower` is 0 and
  /// `upper` may be far off: what to call contact is not decided here. Rounding is covered for a
  /// pose whose rotation is one to rounding, and beyond that for what it lacks.
  Interval Surface(const Eigen::Isometry3d& X_BA, const DistanceGoal& goal);

  /// Are the meshes' boxes apart? Then neither is inside the other.
  bool BoxesApart(const Eigen::Isometry3d& X_BA);

 private:
  struct Cell {
    double squared = 0.0;  ///< of the lower bound
    double centres = 0.0;  ///< squared distance of the boxes' centres
    int a = 0, b = 0;      ///< nodes
  };
  void Place(const Eigen::Isometry3d& X_BA);
  void Aim();
  Cell Bound(int a, int b, double at_least);
  void Split(const Cell& cell);
  void Meet(const Cell& cell);
  double Refine(int i, int j, const BoxTree::Triangle& a);
  BoxTree::Triangle Placed(int i) const;
  bool Keep(const Cell& cell);

  const BoxTree* a_;
  const BoxTree* b_;
  double extent_ = 0.0;  // of the coordinates, mm
  int nearest_a_ = 0;    // triangles of the last witness
  int nearest_b_ = 0;
  // Of the query at hand:
  Eigen::Matrix3d R_BA_, turned_;  // turned_: how far R_BA spreads a box along each axis
  Eigen::Vector3d p_BA_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::UnitX();  // from the witness on B to that on A
  DistanceGoal goal_;
  double pad_ = 0.0;    // covers rounding, mm
  double upper_ = 0.0;  // of the witness
  double aim_ = 0.0;    // nothing is left to do where the lower bound is this
  double least_ = 0.0;  // of the lower bounds that were left
  int evaluations_ = 0;
  std::vector<Cell> stack_;
};

}  // namespace ncsim::collision
