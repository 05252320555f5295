// SPDX-License-Identifier: BSD-3-Clause
// How far can a point of one link get, as seen from another link, while the joints change? Bounds, never samples.
#pragma once

#include <vector>

#include "kinematics/tree.h"

namespace ncsim::kinematics {

/// A set of points that moves rigidly with a link: everything within `radius` of `p_LC` (in link coordinates).
struct Extent {
  int link = 0;
  Eigen::Vector3d p_LC = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// The joints on the path between two links. What both links hang on is left out: it moves neither against the other.
///
/// Bound (proof): let x(q) = T1(q1) .. Tn(qn) p be a point of `a` seen from `b`, joint 1 next to b. Go from q to q' one
/// joint at a time, joint 1 first. Step k moves a point that stands, in the frame of joint k, where the joints k+1..n
/// at their OLD values put it; it moves by at most |dq_k| (prismatic) or |dq_k| times its distance from axis k at q
/// (revolute: chord <= arc). Rigid motion by the joints before k does not change that length. So
/// |x(q') - x(q)| <= sum_k |dq_k| * r_k(q), with r_k evaluated at q alone. Neighbouring prismatic joints add as vectors.
class RelativePath {
 public:
  /// Path from link `b` (the observer) to link `a`.
  RelativePath(const KinematicTree& tree, int link_b, int link_a);

  bool rigid() const { return steps_.empty(); }
  /// JointVector indices of the joints on the path.
  const std::vector<int>& joint_indices() const { return indices_; }

  /// Greatest displacement of any point of `a`, seen from b, when the joints go from `q` to anywhere in
  /// q +- `deviation` (component-wise, >= 0).
  double Bound(const JointVector& q, const Extent& a, const JointVector& deviation) const;

 private:
  struct Step {
    int joint = 0;       // index into tree.joints()
    int index = 0;       // index into JointVector
    bool on_a_side = true;  // false: the joint lies between b and the common ancestor
  };
  const KinematicTree* tree_;
  int link_a_ = 0;
  int link_b_ = 0;
  std::vector<Step> steps_;    // from b to a
  std::vector<int> indices_;
};

}  // namespace ncsim::kinematics
