// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/mesh_distance.h"

#include <algorithm>
#include <cmath>

#include "sim/base/units.h"
#include "sim/collision/triangle_pair.h"

namespace ncsim::collision {

namespace {

using Eigen::Vector3d;
using Node = BoxTree::Node;
using Triangle = BoxTree::Triangle;

// Rounding errors as parts of the coordinates' size: a bound is a dozen sums of products (2^-53
// each), their root of three squares.
constexpr double kRounding = 256.0 * 0x1p-53;

double Extent(const BoxTree& tree) {
  if (tree.empty()) return 0.0;
  return (tree.node(0).centre.cwiseAbs() + tree.node(0).half).sum();
}

double SquaredGap(const Vector3d& between, const Vector3d& halves) {
  return (between.cwiseAbs() - halves).cwiseMax(0.0).squaredNorm();
}

}  // namespace

MeshDistance::MeshDistance(const BoxTree& a, const BoxTree& b)
    : a_(&a), b_(&b), extent_(Extent(a) + Extent(b)) {}

// A vector of B's frame, seen along the columns of a matrix that is no rotation by `lack`, has a
// length that is wrong by as much of it.
void MeshDistance::Place(const Eigen::Isometry3d& X_BA) {
  R_BA_ = X_BA.linear();
  turned_ = R_BA_.cwiseAbs();
  p_BA_ = X_BA.translation();
  const double lack =
      (R_BA_.transpose() * R_BA_ - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  pad_ = (kRounding + 8.0 * lack) * (extent_ + p_BA_.cwiseAbs().sum());
}

Triangle MeshDistance::Placed(int i) const {
  const Triangle& t = a_->triangle(i);
  return {R_BA_ * t[0] + p_BA_, R_BA_ * t[1] + p_BA_, R_BA_ * t[2] + p_BA_};
}

// The lower bound that meets the goal with the witness at hand.
void MeshDistance::Aim() {
  aim_ = std::min(goal_.stop_above + pad_, upper_);
  if (upper_ == kInfinity) return;
  const double apart = upper_ + 2.0 * pad_;
  const double relative =
      (apart + goal_.relative_gap * (goal_.floor + pad_)) / (1.0 + goal_.relative_gap);
  aim_ = std::max(0.0, std::min({aim_, apart - goal_.gap, relative}));
}

// On each of the boxes' axes, as one vector for each box; and on the line of their centres.
MeshDistance::Cell MeshDistance::Bound(int a, int b, double at_least) {
  ++evaluations_;
  const Node& box_a = a_->node(a);
  const Node& box_b = b_->node(b);
  const Vector3d between_B = R_BA_ * box_a.centre + p_BA_ - box_b.centre;
  const Vector3d between_A = R_BA_.transpose() * between_B;
  const double gap_B = SquaredGap(between_B, turned_ * box_a.half + box_b.half);
  const double gap_A = SquaredGap(between_A, turned_.transpose() * box_b.half + box_a.half);
  const double centres = between_B.squaredNorm();
  const double along =
      centres - between_B.cwiseAbs().dot(box_b.half) - between_A.cwiseAbs().dot(box_a.half);
  const double gap_centres = along > 0.0 ? along * along / centres : 0.0;
  return {std::max({gap_A, gap_B, gap_centres, at_least}), centres, a, b};
}

// False when what lies below the cell needs no look.
bool MeshDistance::Keep(const Cell& cell) {
  if (cell.squared < aim_ * aim_) return true;
  least_ = std::min(least_, std::sqrt(cell.squared));
  return false;
}

void MeshDistance::Split(const Cell& cell) {
  const Node& a = a_->node(cell.a);
  const Node& b = b_->node(cell.b);
  const bool split_a = b.count > 0 || (a.count == 0 && a.half.sum() > b.half.sum());
  Cell near = split_a ? Bound(a.first, cell.b, cell.squared) : Bound(cell.a, b.first, cell.squared);
  Cell far =
      split_a ? Bound(a.first + 1, cell.b, cell.squared) : Bound(cell.a, b.first + 1, cell.squared);
  if (far.squared < near.squared || (far.squared == near.squared && far.centres < near.centres)) {
    std::swap(near, far);
  }
  if (Keep(far)) stack_.push_back(far);
  if (Keep(near)) stack_.push_back(near);
}

// Triangles of two leaves.
void MeshDistance::Meet(const Cell& cell) {
  const Node& a = a_->node(cell.a);
  const Node& b = b_->node(cell.b);
  const double boxes = std::sqrt(cell.squared);
  for (int i = a.first; i < a.first + a.count; ++i) {
    const Triangle placed = Placed(i);
    for (int j = b.first; j < b.first + b.count; ++j) {
      ++evaluations_;
      const Triangle& other = b_->triangle(j);
      double lower = std::max(boxes, ShadowGap(direction_, placed, other));
      if (lower < aim_) lower = std::max(lower, SearchedGap(placed, other, aim_));
      if (lower < aim_) lower = std::max(lower, Refine(i, j, placed));
      least_ = std::min(least_, lower);
    }
  }
}

// Tries a pair of triangles as the witness; its lower bound.
double MeshDistance::Refine(int i, int j, const Triangle& a) {
  const Triangle& b = b_->triangle(j);
  const NearPoints near = NearestPoints(a, b);
  const Vector3d way = near.a - near.b;
  const double distance = way.norm();
  if (!(distance > 0.0)) {
    upper_ = 0.0;
    Aim();
    return 0.0;
  }
  const Vector3d direction = way / distance;
  if (distance < upper_) {
    upper_ = distance;
    direction_ = direction;
    nearest_a_ = i;
    nearest_b_ = j;
    Aim();
  }
  return std::max(0.0, ShadowGap(direction, a, b));
}

Interval MeshDistance::Surface(const Eigen::Isometry3d& X_BA, const DistanceGoal& goal) {
  if (a_->empty() || b_->empty()) return {kInfinity, kInfinity};
  Place(X_BA);
  goal_ = goal;
  upper_ = least_ = kInfinity;
  evaluations_ = 0;
  stack_.clear();
  // The last pose's witness is a good one here.
  Refine(nearest_a_, nearest_b_, Placed(nearest_a_));
  const Cell root = Bound(0, 0, 0.0);
  if (Keep(root)) stack_.push_back(root);
  while (!stack_.empty() && least_ > 0.0 && upper_ + pad_ >= goal.stop_below &&
         evaluations_ <= goal.max_evaluations) {
    const Cell cell = stack_.back();
    stack_.pop_back();
    if (!Keep(cell)) continue;
    a_->node(cell.a).count > 0 && b_->node(cell.b).count > 0 ? Meet(cell) : Split(cell);
  }
  for (const Cell& cell : stack_) least_ = std::min(least_, std::sqrt(cell.squared));
  return {std::max(0.0, std::min(least_, upper_) - pad_), upper_ + pad_};
}

bool MeshDistance::BoxesApart(const Eigen::Isometry3d& X_BA) {
  Place(X_BA);
  return a_->empty() || b_->empty() || Bound(0, 0, 0.0).squared > pad_ * pad_;
}

}  // namespace ncsim::collision
