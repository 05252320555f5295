// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/profile_distance.h"

#include <algorithm>
#include <cmath>

#include "sim/collision/convex_minimum.h"

namespace ncsim::collision {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangle = TriangleTree::Triangle;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

RevolvedPose ToolPose(const Eigen::Isometry3d& X_GS, double length) {
  const Vector3d z_S = X_GS.linear().col(2);
  return {X_GS.translation() + length * z_S, -z_S};
}

ProfileDistance::ProfileDistance(const ProfileShape& shape, const TriangleTree& tree)
    : shape_(&shape), tree_(&tree) {}

ProfileDistance::Local ProfileDistance::ToLocal(const Vector3d& p) const {
  const Vector3d v = p - pose_.tip;
  Local local;
  local.z = v.dot(pose_.axis);
  const Vector3d across = v - local.z * pose_.axis;
  local.r = across.norm();
  // On the axis zero is a subgradient across it: the distance is even there.
  local.radial = local.r > 1e-9 ? Vector3d(across / local.r) : Vector3d(Vector3d::Zero());
  return local;
}

Vector3d ProfileDistance::Gradient(const Local& local, const Vector2d& gradient) const {
  return gradient.x() * pose_.axis + gradient.y() * local.radial;
}

template <typename LeastLinear>
double ProfileDistance::Bound(const Local& local, double distance, const Vector2d& gradient,
                              double radius, const LeastLinear& least_linear) const {
  double lower = distance - radius;
  if (shape_->exact().convex()) {
    return std::max(lower, distance + least_linear(Gradient(local, gradient)));
  }
  const ProfileSample hull = shape_->hull().Sample(local.z, local.r);
  lower = std::max(lower, hull.distance + least_linear(Gradient(local, hull.gradient)));
  if (distance <= 0.0 || lower >= upper_) return lower;
  double slabs = kInfinity;
  for (const ProfileChain& slab : shape_->slabs()) {
    const ProfileSample sample = slab.Sample(local.z, local.r);
    double bound = sample.distance - radius;
    if (bound < slabs) {
      bound = std::max(bound, sample.distance + least_linear(Gradient(local, sample.gradient)));
    }
    slabs = std::min(slabs, bound);
    if (slabs < 0.0) return lower;  // maybe inside, where the union is deeper than its slabs
  }
  return std::max(lower, slabs);
}

double ProfileDistance::BoundNode(const TriangleTree::Node& node) const {
  const Local local = ToLocal(node.centre);
  const ProfileSample sample = shape_->exact().Sample(local.z, local.r);
  return Bound(local, sample.distance, sample.gradient, node.half.norm(),
               [&node](const Vector3d& g) { return -g.cwiseAbs().dot(node.half); });
}

double ProfileDistance::BoundPiece(const Triangle& piece, double* at_centre, double* radius) const {
  const Vector3d centre = (piece[0] + piece[1] + piece[2]) / 3.0;
  const Local local = ToLocal(centre);
  const ProfileSample sample = shape_->exact().Sample(local.z, local.r);
  *at_centre = sample.distance;
  double squared = 0.0;
  for (const Vector3d& v : piece) squared = std::max(squared, (v - centre).squaredNorm());
  *radius = std::sqrt(squared);
  return Bound(local, sample.distance, sample.gradient, *radius, [&](const Vector3d& g) {
    return std::min({g.dot(piece[0] - centre), g.dot(piece[1] - centre), g.dot(piece[2] - centre)});
  });
}

void ProfileDistance::Push(const Cell& cell) {
  heap_.push_back(cell);
  std::push_heap(heap_.begin(), heap_.end(),
                 [](const Cell& a, const Cell& b) { return a.lower > b.lower; });
}

void ProfileDistance::PushNode(int index) {
  ++evaluations_;
  const double lower = BoundNode(tree_->node(index));
  if (lower < upper_) Push({lower, index, -1, false});
}

void ProfileDistance::PushPiece(const Triangle& piece, double at_least, bool is_whole) {
  ++evaluations_;
  double at_centre = 0.0;
  double radius = 0.0;
  const double lower = std::max(at_least, BoundPiece(piece, &at_centre, &radius));
  upper_ = std::min(upper_, at_centre);
  if (lower >= upper_) return;
  // Halves of a triangle that is no convex problem become one when they lie outside.
  Push({lower, -1, Keep(piece), is_whole || at_centre > 0.5 * radius});
}

void ProfileDistance::Expand(const Cell& cell, const DistanceGoal& goal) {
  if (cell.node >= 0) {
    const TriangleTree::Node& node = tree_->node(cell.node);
    if (node.count == 0) {
      PushNode(node.first);
      PushNode(node.first + 1);
      return;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      PushPiece(tree_->triangle(i), cell.lower, true);
    }
    return;
  }
  const Triangle piece = pieces_[static_cast<std::size_t>(cell.piece)];
  free_pieces_.push_back(cell.piece);
  const double lower = cell.solve ? std::max(cell.lower, Solve(piece, goal)) : cell.lower;
  if (lower >= upper_) return;
  if (cell.solve && upper_ - lower <= goal.gap) {
    Push({lower, -1, Keep(piece), false});  // good enough: the search ends when it comes up
  } else {
    Halve(piece, lower);
  }
}

int ProfileDistance::Keep(const Triangle& piece) {
  if (free_pieces_.empty()) {
    pieces_.push_back(piece);
    return static_cast<int>(pieces_.size()) - 1;
  }
  const int slot = free_pieces_.back();
  free_pieces_.pop_back();
  pieces_[static_cast<std::size_t>(slot)] = piece;
  return slot;
}

// Where the distance is convex, a triangle is a convex problem. Elsewhere (inside a solid that is
// not convex) -inf.
double ProfileDistance::Solve(const Triangle& piece, const DistanceGoal& goal) {
  const auto least = [&](const ProfileChain& chain) {
    const ConvexMinimum minimum = MinimiseOverTriangle(
        piece,
        [&](const Vector3d& p) {
          ++evaluations_;
          const Local local = ToLocal(p);
          const ProfileSample sample = chain.Sample(local.z, local.r);
          return ConvexSample{sample.distance, Gradient(local, sample.gradient)};
        },
        std::min(upper_, goal.stop_above), 0.5 * goal.gap);
    // A witness of the whole solid: no slab is nearer than the solid itself.
    if (minimum.upper < upper_) {
      const Local local = ToLocal(minimum.at);
      upper_ = std::min(upper_, shape_->exact().Distance(local.z, local.r));
    }
    return minimum.lower;
  };
  if (shape_->exact().convex()) return least(shape_->exact());
  double slabs = kInfinity;
  for (const ProfileChain& slab : shape_->slabs()) {
    slabs = std::min(slabs, least(slab));
    if (slabs < 0.0) break;
  }
  return slabs >= 0.0 ? slabs : least(shape_->hull());
}

void ProfileDistance::Halve(const Triangle& piece, double lower) {
  std::size_t longest = 0;
  double length = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge = (piece[(k + 1) % 3] - piece[k]).squaredNorm();
    if (edge > length) {
      length = edge;
      longest = k;
    }
  }
  const Vector3d& a = piece[longest];
  const Vector3d& b = piece[(longest + 1) % 3];
  const Vector3d& c = piece[(longest + 2) % 3];
  const Vector3d middle = 0.5 * (a + b);
  PushPiece({a, middle, c}, lower, false);
  PushPiece({middle, b, c}, lower, false);
}

Interval ProfileDistance::Surface(const RevolvedPose& pose, const DistanceGoal& goal) {
  pose_ = pose;
  upper_ = kInfinity;
  evaluations_ = 0;
  heap_.clear();
  pieces_.clear();
  free_pieces_.clear();
  if (tree_->empty()) return {kInfinity, kInfinity};
  PushNode(0);
  // What the heap no longer holds is at least the witness away, so the certified bound is the
  // lesser of the heap's top and the witness.
  while (!heap_.empty()) {
    const double lower = heap_.front().lower;
    if (lower >= goal.stop_above || upper_ < goal.stop_below) break;
    const double gap = std::max(goal.gap, goal.relative_gap * (lower - goal.floor));
    if (upper_ - lower <= gap || evaluations_ > goal.max_evaluations) break;
    const Cell cell = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end(),
                  [](const Cell& a, const Cell& b) { return a.lower > b.lower; });
    heap_.pop_back();
    Expand(cell, goal);
  }
  const double lower = heap_.empty() ? upper_ : std::min(upper_, heap_.front().lower);
  return {lower - kKernelError, upper_ + kKernelError};
}

Interval ProfileDistance::Solid(const RevolvedPose& pose, const DistanceGoal& goal) {
  Interval result = Surface(pose, goal);
  if (result.upper < goal.stop_below) {
    result.lower = std::min(result.lower, -shape_->inradius());
    return result;
  }
  std::vector<double> cuts{shape_->z_min()};
  for (double z : tree_->Crossings(pose.tip, pose.axis)) {
    if (z > shape_->z_min() && z < shape_->z_max()) cuts.push_back(z);
  }
  cuts.push_back(shape_->z_max());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] < 1e-6) continue;
    if (!tree_->Contains(pose.tip + 0.5 * (cuts[i] + cuts[i + 1]) * pose.axis)) continue;
    const double least = shape_->LeastOnAxis(cuts[i], cuts[i + 1]);
    result.upper = std::min(result.upper, least + kKernelError);
    result.lower = std::min(result.lower, least - 4e-3);
  }
  return result;
}

bool ProfileDistance::Contained(const RevolvedPose& pose) const {
  return tree_->Contains(pose.tip + shape_->inradius_z() * pose.axis);
}

}  // namespace ncsim::collision
