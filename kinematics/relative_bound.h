// SPDX-License-Identifier: BSD-3-Clause
// How far can a point of one link get, as seen from another link, while the joints change? Bounds,
// never samples.
#pragma once

#include <limits>
#include <vector>

#include "kinematics/chain.h"
#include "kinematics/tree.h"

namespace ncsim::kinematics {

/// A set of points that moves rigidly with a link: everything within `radius` of `p_LC` (in link
/// coordinates).
struct Extent {
  int link = 0;
  Eigen::Vector3d p_LC = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// Greatest distance between two positions of a point at radius 1 that turns by at most `angle` (>=
/// 0, rad): the chord, and the diameter from half a turn on; never less, and for small angles the
/// arc.
double Chord(double angle);

/// See RelativePath::Weights.
struct TravelWeights {
  JointVector joints;   ///< mm per mm, or mm per rad.
  double linear = 0.0;  ///< mm per mm of the prismatic joints' displacement as one vector.
};

/// The joints on the path between two links. What both links hang on is left out: it moves neither
/// against the other.
///
/// Bound (proof): let x(q) = T1(q1) .. Tn(qn) p be a point of `a` seen from `b`, joint 1 next to b.
/// Go from q to q' one joint at a time, joint 1 first. Step k moves a point that stands, in the
/// frame of joint k, where the joints k+1..n at their OLD values put it; it moves by at most |dq_k|
/// (prismatic) or Chord(|dq_k|) times its distance from axis k at q (revolute). Rigid motion by the
/// joints before k does not change that length. So |x(q') - x(q)| <= sum_k |dq_k| * r_k(q), with
/// r_k evaluated at q alone. Neighbouring prismatic joints, with no revolute joint between them,
/// keep their directions d_k to each other and add as vectors: |sum dq_k d_k| <= sqrt(sum_ij |dq_i|
/// |dq_j| |d_i . d_j|), the root of the sum of squares for orthogonal ones.
class RelativePath {
 public:
  /// Path from link `b` (the observer) to link `a`. Keeps nothing of `tree`.
  RelativePath(const KinematicTree& tree, int link_b, int link_a);

  bool rigid() const { return indices_.empty(); }
  /// JointVector indices of the joints on the path, from b to a.
  const std::vector<int>& joint_indices() const { return indices_; }
  /// Of joint_indices()[k].
  bool revolute(std::size_t k) const { return chain_.steps()[k].revolute; }
  /// True when a joint of the path differs between `q0` and `q1`.
  bool MovesBetween(const JointVector& q0, const JointVector& q1) const;

  /// X_BA at q.
  Eigen::Isometry3d Pose(const JointVector& q) const { return chain_.Pose(q); }

  /// Greatest displacement of any point of `a` (its p_LC in coordinates of link_a), seen from b,
  /// when the joints go from `q` to anywhere in q +- `deviation` (component-wise, >= 0).
  /// `prismatic_limit` (mm): what the caller knows about the joint displacement of any run of
  /// neighbouring prismatic joints, where that is less than the corner of the box.
  double Bound(const JointVector& q, const Extent& a, const JointVector& deviation,
               double prismatic_limit = std::numeric_limits<double>::infinity()) const;

  /// What the bound comes to anywhere in a box: with |dq| the changes of the joints between two
  /// poses of the box `middle` +- `half`, and |dp| the root of the sum of squares over all
  /// prismatic joints, no point of `a`, seen from b, moves further than joints . |dq| + linear *
  /// |dp|. (As for Bound, with r_k at its greatest: the centre of `a`, in the frame of joint k, is
  /// no further from where it is at `middle` than the joints behind it can take it.)
  TravelWeights Weights(const JointVector& middle, const JointVector& half, const Extent& a) const;

 private:
  /// A run of neighbouring prismatic joints: steps first..last-1, `directions` in one common frame.
  struct Slide {
    int first = 0;
    int last = 0;
    std::vector<Eigen::Vector3d> directions;
    bool square = true;  ///< The directions are at right angles to each other.
  };
  double SlideBound(const Slide& slide, const JointVector& deviation) const;

  Chain chain_;
  std::vector<int> indices_;
  std::vector<Slide> slides_;
};

}  // namespace ncsim::kinematics
