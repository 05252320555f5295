// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/collision/mesh_distance.h"

namespace ncsim::collision {

namespace {

using Eigen::Isometry3d;

constexpr double kWayBudget = 0.2;  // mm beyond what is needed of a whole way
constexpr int kWayEvaluations = 1000;

class ToolEngine final : public PairEngine {
 public:
  ToolEngine(std::shared_ptr<const ToolBody> a, std::shared_ptr<const MeshBody> b)
      : a_(std::move(a)), b_(std::move(b)), kernel_(a_->shape, b_->tree) {}

  std::optional<Interval> Clearance(const Isometry3d& X_BA, const DistanceGoal& goal) override {
    return kernel_.Surface(ToolPose(X_BA, a_->length), goal);
  }
  std::optional<double> ClearanceAllTheWay(const Isometry3d& X_BA, const Eigen::Vector3d& way,
                                           double need) override {
    if (need < 0.0 && !a_->shape.convex()) return std::nullopt;
    DistanceGoal goal;
    goal.floor = need;
    goal.relative_gap = 0.2;
    goal.stop_above = need + kWayBudget;
    goal.stop_below = need;
    goal.max_evaluations = kWayEvaluations;
    return kernel_.AllTheWay(ToolPose(X_BA, a_->length), way, goal).lower;
  }
  bool Contained(const Isometry3d& X_BA) override {
    return kernel_.Contained(ToolPose(X_BA, a_->length));
  }
  std::optional<Interval> Solid(const Isometry3d& X_BA, const DistanceGoal& goal) override {
    return kernel_.Solid(ToolPose(X_BA, a_->length), goal);
  }
  bool Confirms(const Isometry3d& X_BA) override {
    const std::optional<bool> hit = Collide(a_->fcl, b_->fcl, X_BA);
    if (!hit.has_value() || *hit || Contained(X_BA)) return true;
    // A body wholly inside the tool: its surface meets nothing either.
    const RevolvedPose pose = ToolPose(X_BA, a_->length);
    return std::any_of(b_->tree.representatives().begin(), b_->tree.representatives().end(),
                       [&](const Eigen::Vector3d& p) {
                         const double z = (p - pose.tip).dot(pose.axis);
                         const double r = (p - pose.tip - z * pose.axis).norm();
                         return a_->shape.exact().Distance(z, r) < 0.0;
                       });
  }
  double Budget(double need) const override { return std::max(20.0, need); }
  double thrift() const override { return 0.9; }
  bool has_depth() const override { return true; }
  double floor() const override { return -a_->shape.inradius(); }

 private:
  std::shared_ptr<const ToolBody> a_;
  std::shared_ptr<const MeshBody> b_;
  ProfileDistance kernel_;
};

class SweptEngine final : public PairEngine {
 public:
  explicit SweptEngine(std::shared_ptr<const SweptPair> pair)
      : pair_(std::move(pair)), kernel_(pair_->swept->shape, pair_->mesh->tree) {}

  std::optional<Interval> Clearance(const Isometry3d& X_BA, const DistanceGoal& goal) override {
    return kernel_.Surface(Pose(X_BA), goal);
  }
  std::optional<double> ClearanceAllTheWay(const Isometry3d& /*X_BA*/,
                                           const Eigen::Vector3d& /*way*/,
                                           double /*need*/) override {
    return std::nullopt;
  }
  bool Contained(const Isometry3d& X_BA) override { return kernel_.Contained(Pose(X_BA)); }
  std::optional<Interval> Solid(const Isometry3d& X_BA, const DistanceGoal& goal) override {
    return kernel_.Solid(Pose(X_BA), goal);
  }
  // Its contacts are none of the pair's.
  bool Confirms(const Isometry3d& /*X_BA*/) override { return false; }
  double Budget(double need) const override { return std::max(20.0, need); }
  double thrift() const override { return 0.9; }
  bool has_depth() const override { return true; }
  double floor() const override { return -pair_->swept->shape.inradius(); }

 private:
  // In the mesh's frame.
  RevolvedPose Pose(const Isometry3d& X_BA) const {
    const RevolvedPose& pose = pair_->swept->pose;
    const Isometry3d X_GP = pair_->mesh_is_a ? X_BA.inverse() : X_BA;
    return {X_GP * pose.tip, X_GP.linear() * pose.axis};
  }

  std::shared_ptr<const SweptPair> pair_;
  ProfileDistance kernel_;
};

class MeshEngine final : public PairEngine {
 public:
  MeshEngine(std::shared_ptr<const MeshBody> a, std::shared_ptr<const MeshBody> b)
      : a_(std::move(a)), b_(std::move(b)), kernel_(a_->boxes, b_->boxes) {}

  std::optional<Interval> Clearance(const Isometry3d& X_BA, const DistanceGoal& goal) override {
    if (!a_->fcl.ok() || !b_->fcl.ok() || !X_BA.matrix().allFinite()) return std::nullopt;
    Interval result = kernel_.Surface(X_BA, goal);
    if (result.lower > 0.0) return result;
    // The surfaces meet, or nearly so: FCL says which.
    const std::optional<double> distance = Distance(a_->fcl, b_->fcl, X_BA, result.upper);
    if (!distance.has_value()) return std::nullopt;
    result.lower = *distance - kFclDistanceError;
    result.upper = std::min(result.upper, *distance);
    return result;
  }
  std::optional<double> ClearanceAllTheWay(const Isometry3d& /*X_BA*/,
                                           const Eigen::Vector3d& /*way*/,
                                           double /*need*/) override {
    return std::nullopt;
  }
  bool Contained(const Isometry3d& X_BA) override {
    if (kernel_.BoxesApart(X_BA)) return false;
    const Isometry3d X_AB = X_BA.inverse();
    const auto inside = [](const MeshBody& inner, const MeshBody& outer, const Isometry3d& X) {
      return std::any_of(inner.tree.representatives().begin(), inner.tree.representatives().end(),
                         [&](const Eigen::Vector3d& p) { return outer.tree.Contains(X * p); });
    };
    return inside(*a_, *b_, X_BA) || inside(*b_, *a_, X_AB);
  }
  std::optional<Interval> Solid(const Isometry3d& X_BA, const DistanceGoal& goal) override {
    std::optional<Interval> result = Clearance(X_BA, goal);
    if (result.has_value() && result->upper > 0.0 && Contained(X_BA)) result = Interval{0.0, 0.0};
    return result;
  }
  bool Confirms(const Isometry3d& X_BA) override {
    const std::optional<bool> hit = Collide(a_->fcl, b_->fcl, X_BA);
    return !hit.has_value() || *hit || Contained(X_BA);
  }
  double Budget(double need) const override { return std::max(20.0, need); }
  double thrift() const override { return 0.6; }
  bool has_depth() const override { return false; }
  double floor() const override { return 0.0; }

 private:
  std::shared_ptr<const MeshBody> a_;
  std::shared_ptr<const MeshBody> b_;
  MeshDistance kernel_;
};

}  // namespace

std::unique_ptr<PairEngine> MakeEngine(std::shared_ptr<const ToolBody> a,
                                       std::shared_ptr<const MeshBody> b) {
  return std::make_unique<ToolEngine>(std::move(a), std::move(b));
}

std::unique_ptr<PairEngine> MakeEngine(std::shared_ptr<const SweptPair> pair) {
  return std::make_unique<SweptEngine>(std::move(pair));
}

std::unique_ptr<PairEngine> MakeEngine(std::shared_ptr<const MeshBody> a,
                                       std::shared_ptr<const MeshBody> b) {
  return std::make_unique<MeshEngine>(std::move(a), std::move(b));
}

}  // namespace ncsim::collision
