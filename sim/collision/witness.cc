// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/witness.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace ncsim::collision {

namespace {

using Eigen::Vector3d;
using Triangle = TriangleTree::Triangle;

constexpr double kClose = 5e-4;         // mm above the least distance
constexpr int kMaxEvaluations = 30000;  // the best point so far must do then

// Best first: the signed distance changes by no more than the way.
class Search {
 public:
  Search(const ProfileShape& shape, const TriangleTree& tree, const RevolvedPose& pose)
      : shape_(shape), tree_(tree), pose_(pose) {}

  Vector3d Run() {
    ProfileDistance kernel(shape_, tree_);
    DistanceGoal goal;
    goal.gap = kClose;
    const double enough = kernel.Surface(pose_, goal).upper + kClose;
    PushNode(0);
    while (best_ > enough && !heap_.empty() && evaluations_ < kMaxEvaluations) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Cell cell = heap_.back();
      heap_.pop_back();
      if (cell.lower < best_) Expand(cell);
    }
    return at_;
  }

  Vector3d NearestOnSolid(const Vector3d& p) const {
    const Vector3d v = p - pose_.tip;
    const double z = v.dot(pose_.axis);
    const Vector3d across = v - z * pose_.axis;
    const double r = across.norm();
    const Vector3d radial = r > 1e-9 ? Vector3d(across / r) : pose_.axis.unitOrthogonal();
    const ProfileSample sample = shape_.exact().Sample(z, r);
    const Eigen::Vector2d step = sample.distance * sample.gradient;
    return p - step.x() * pose_.axis - step.y() * radial;
  }

 private:
  struct Cell {
    double lower = 0.0;
    int node = -1;   // of the tree, or else
    Triangle piece;  // of a triangle
    bool operator<(const Cell& other) const { return lower > other.lower; }
  };

  double Distance(const Vector3d& p) {
    ++evaluations_;
    const Vector3d v = p - pose_.tip;
    const double z = v.dot(pose_.axis);
    return shape_.exact().Distance(z, (v - z * pose_.axis).norm());
  }

  double Look(const Vector3d& p) {
    const double distance = Distance(p);
    if (distance < best_) {
      best_ = distance;
      at_ = p;
    }
    return distance;
  }

  void Push(const Cell& cell) {
    if (cell.lower >= best_) return;
    heap_.push_back(cell);
    std::push_heap(heap_.begin(), heap_.end());
  }

  void PushNode(int index) {
    const TriangleTree::Node& node = tree_.node(index);
    Push({Distance(node.centre) - node.half.norm(), index, {}});
  }

  void PushPiece(const Triangle& piece) {
    const Vector3d centre = (piece[0] + piece[1] + piece[2]) / 3.0;
    double squared = 0.0;
    for (const Vector3d& v : piece) squared = std::max(squared, (v - centre).squaredNorm());
    Push({Look(centre) - std::sqrt(squared), -1, piece});
  }

  void Expand(const Cell& cell) {
    if (cell.node < 0) {
      const auto& [a, b, c] = cell.piece;
      const Vector3d ab = 0.5 * (a + b);
      const Vector3d bc = 0.5 * (b + c);
      const Vector3d ca = 0.5 * (c + a);
      for (const Triangle& piece :
           {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}}) {
        PushPiece(piece);
      }
      return;
    }
    const TriangleTree::Node& node = tree_.node(cell.node);
    if (node.count == 0) {
      PushNode(node.first);
      PushNode(node.first + 1);
      return;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      for (const Vector3d& corner : tree_.triangle(i)) Look(corner);
      PushPiece(tree_.triangle(i));
    }
  }

  const ProfileShape& shape_;
  const TriangleTree& tree_;
  const RevolvedPose pose_;
  std::vector<Cell> heap_;
  double best_ = std::numeric_limits<double>::infinity();
  Vector3d at_ = Vector3d::Zero();
  int evaluations_ = 0;
};

}  // namespace

Witness FindWitness(const ProfileShape& a, const TriangleTree& b, const RevolvedPose& pose) {
  Search search(a, b, pose);
  const Vector3d p = search.Run();
  return {search.NearestOnSolid(p), p};
}

std::optional<Witness> FindWitness(const Pair& pair, const Eigen::Isometry3d& X_BA) {
  if (pair.tool) {
    if (pair.b->tree.empty()) return std::nullopt;
    return FindWitness(pair.tool->shape, pair.b->tree, ToolPose(X_BA, pair.tool->length));
  }
  const auto points = CommonOrNearestPoints(pair.mesh_a->fcl, pair.b->fcl, X_BA);
  if (!points) return std::nullopt;
  return Witness{points->first, points->second};
}

}  // namespace ncsim::collision
