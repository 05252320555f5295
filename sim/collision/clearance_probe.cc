// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/clearance_probe.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/collision/engine.h"
#include "sim/collision/pairs.h"

namespace ncsim::collision {
namespace {

struct ProbedPair {
  Pair pair;
  std::unique_ptr<PairEngine> engine;
};

std::vector<ProbedPair> Probed(std::vector<Pair> pairs) {
  std::vector<ProbedPair> probed;
  for (Pair& pair : pairs) {
    const bool broken = !pair.b->defect.empty() || (pair.mesh_a && !pair.mesh_a->defect.empty());
    if (pair.role != PairRole::kNeverTouch || broken) continue;
    auto engine = pair.tool ? MakeEngine(pair.tool, pair.b) : MakeEngine(pair.mesh_a, pair.b);
    probed.push_back({std::move(pair), std::move(engine)});
  }
  return probed;
}

}  // namespace

struct ClearanceProbe::State {
  const machine::Machine* machine;
  const machine::ToolTable* tools;
  MeshBodies bodies;
  std::vector<ProbedPair> scene;
  std::map<int, std::vector<ProbedPair>> by_tool;
};

ClearanceProbe::ClearanceProbe(const machine::Machine& machine, const machine::Scene& scene,
                               const machine::ToolTable& tools)
    : state_(std::make_unique<State>()) {
  state_->machine = &machine;
  state_->tools = &tools;
  for (const machine::SceneBody& body : scene.bodies) {
    state_->bodies.push_back(std::make_shared<const MeshBody>(body));
  }
  state_->scene = Probed(ScenePairs(machine, state_->bodies));
}

ClearanceProbe::~ClearanceProbe() = default;

std::optional<SeenClearance> ClearanceProbe::At(const kinematics::JointVector& q, int tool) {
  auto [known, is_new] = state_->by_tool.try_emplace(tool);
  const machine::Tool* data = state_->tools->Find(tool);
  if (is_new && data != nullptr) {
    known->second = Probed(ToolPairs(*state_->machine, *data, state_->bodies));
  }
  std::vector<Eigen::Isometry3d> X_ML;
  state_->machine->tree.Poses(q, &X_ML);
  const auto pose = [&](int link) -> const Eigen::Isometry3d& {
    return X_ML[static_cast<std::size_t>(link)];
  };
  // Of the balls around the bodies, the nearest first: few pairs are left to look at.
  std::vector<std::pair<double, ProbedPair*>> order;
  for (std::vector<ProbedPair>* group : {&state_->scene, &known->second}) {
    for (ProbedPair& probed : *group) {
      const kinematics::Extent& a = probed.pair.extent_a();
      const kinematics::Extent& b = probed.pair.b->extent;
      const double centres = (pose(a.link) * a.p_LC - pose(b.link) * b.p_LC).norm();
      order.emplace_back(centres - a.radius - b.radius, &probed);
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::optional<SeenClearance> least;
  for (const auto& [bound, probed] : order) {
    if (least && bound >= least->clearance_mm) break;
    DistanceGoal goal;
    goal.gap = 0.05;
    goal.relative_gap = 0.02;
    if (least) goal.stop_above = least->clearance_mm;
    const Eigen::Isometry3d X_BA =
        pose(probed->pair.link_b()).inverse(Eigen::Isometry) * pose(probed->pair.extent_a().link);
    const std::optional<Interval> seen = probed->engine->Solid(X_BA, goal);
    if (!seen || (least && seen->upper >= least->clearance_mm)) continue;
    least = {seen->upper, &probed->pair.names};
  }
  return least;
}

}  // namespace ncsim::collision
