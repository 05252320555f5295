// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/checker.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "sim/collision/pair_monitor.h"
#include "sim/machine/margins.h"

namespace ncsim::collision {

namespace {

using Monitors = std::vector<std::unique_ptr<PairMonitor>>;

bool HasMachineBody(const Pair& pair) {
  return pair.b->kind == machine::BodyKind::kMachine ||
         (pair.mesh_a && pair.mesh_a->kind == machine::BodyKind::kMachine);
}

template <typename Body>
machine::MarginBody AsMarginBody(const Body& body) {
  return {body.name, body.kind, body.extent.link};
}

}  // namespace

struct CollisionChecker::State {
  State(const machine::Machine& machine_data, const machine::ToolTable& tool_table,
        const machine::CheckSettings& check)
      : machine(&machine_data), tools(&tool_table), settings(check) {}

  bool Trusted(const Pair& pair);
  BlankState* BlankOf(const Pair& pair);
  Monitors Watch(std::vector<Pair> pairs);
  void ChangeTool(const motion::Motion& motion);
  void OnRun(std::vector<const motion::Motion*> motions);
  void OnWindow(const motion::Window& window);

  const machine::Machine* machine;
  const machine::ToolTable* tools;
  machine::CheckSettings settings;
  MeshBodies bodies;
  std::map<const MeshBody*, BlankState> blanks;
  NumberedFindings findings;
  Monitors scene;
  std::map<int, Monitors> by_tool;  // kept, so that a tool's least clearance spans all its uses
  Monitors* in_spindle = nullptr;
  int tool = 0;
  std::set<int> unknown_tools;
  std::set<const MeshBody*> broken;
  std::vector<const MeshBody*> newly_broken;  // not reported yet
  std::uint64_t number = 0;                   // of motions so far
};

bool CollisionChecker::State::Trusted(const Pair& pair) {
  bool trusted = true;
  for (const MeshBody* body : {pair.mesh_a.get(), pair.b.get()}) {
    if (body == nullptr || body->defect.empty()) continue;
    trusted = false;
    if (broken.insert(body).second) newly_broken.push_back(body);
  }
  return trusted;
}

BlankState* CollisionChecker::State::BlankOf(const Pair& pair) {
  if (pair.b->kind == machine::BodyKind::kStock) return &blanks[pair.b.get()];
  if (pair.mesh_a && pair.mesh_a->kind == machine::BodyKind::kStock) {
    return &blanks[pair.mesh_a.get()];
  }
  return nullptr;
}

Monitors CollisionChecker::State::Watch(std::vector<Pair> pairs) {
  Monitors monitors;
  for (Pair& pair : pairs) {
    if (!Trusted(pair)) continue;
    BlankState* blank = BlankOf(pair);
    machine::CheckSettings check = settings;
    check.clearance =
        NearMissClearance(*machine, settings, AsMarginBody(*pair.b),
                          pair.tool ? AsMarginBody(*pair.tool) : AsMarginBody(*pair.mesh_a));
    if (machine->nominal_shapes && HasMachineBody(pair)) {
      // The verdict turns on the margin; what is proven elsewhere is a quarter below what is seen.
      check.exact_below = 1.5 * machine::kNominalMargin;
    }
    monitors.push_back(
        std::make_unique<PairMonitor>(*machine, check, std::move(pair), blank, &findings));
  }
  return monitors;
}

void CollisionChecker::State::ChangeTool(const motion::Motion& motion) {
  tool = motion.facts.tool;
  if (in_spindle != nullptr) {
    for (const auto& monitor : *in_spindle) monitor->Pause();
  }
  in_spindle = nullptr;
  for (const auto& monitor : scene) monitor->OnToolChange();
  if (tool == 0) return;
  const machine::Tool* data = tools->Find(tool);
  if (data == nullptr) {
    if (unknown_tools.insert(tool).second) {
      findings.emplace_back(number + 1,
                            MakeFinding(Rule::kUncertified, motion.where,
                                        "the shape of T" + std::to_string(tool) +
                                            " is not known, so nothing was checked against it"));
    }
    return;
  }
  auto [entry, is_new] = by_tool.try_emplace(tool);
  if (is_new) entry->second = Watch(ToolPairs(*machine, *data, bodies));
  in_spindle = &entry->second;
}

void CollisionChecker::State::OnRun(std::vector<const motion::Motion*> motions) {
  if (motions.empty()) return;
  const motion::Motion& first = *motions.front();
  if (first.facts.tool != tool) ChangeTool(first);
  const machine::Tool* data = tools->Find(tool);
  const kinematics::FiveAxis* five_axis = machine->five_axis ? &*machine->five_axis : nullptr;
  const motion::Travel travel(machine->tree, five_axis, data == nullptr ? 0.0 : data->length,
                              std::move(motions));
  for (const MeshBody* body : newly_broken) {
    Finding finding =
        MakeFinding(Rule::kUncertified, first.where,
                    "nothing was checked against " + body->name + ": " + body->defect);
    finding.bodies = {body->name};
    findings.emplace_back(number + 1, std::move(finding));
  }
  newly_broken.clear();
  // The tool first: its flutes decide whether the blank is still whole.
  if (in_spindle != nullptr) {
    for (const auto& monitor : *in_spindle) monitor->OnRun(travel, number + 1);
  }
  for (const auto& monitor : scene) monitor->OnRun(travel, number + 1);
  number += travel.size();
}

// Runs of motions that follow each other with one tool; a dwell that states no axes is passed over.
void CollisionChecker::State::OnWindow(const motion::Window& window) {
  std::vector<const motion::Motion*> run;
  for (const motion::Motion& motion : window.motions) {
    if (motion.q0().size() != machine->tree.num_moving()) continue;
    const bool follows = !run.empty() && motion.facts.tool == run.back()->facts.tool &&
                         SamePose(run.back()->q1(), motion.q0());
    if (!follows) OnRun(std::exchange(run, {}));
    run.push_back(&motion);
  }
  OnRun(std::move(run));
}

CollisionChecker::CollisionChecker(const machine::Machine& machine, const machine::Scene& scene,
                                   const machine::ToolTable& tools,
                                   const machine::CheckSettings& settings)
    : state_(std::make_unique<State>(machine, tools, settings)) {
  for (const machine::SceneBody& body : scene.bodies) {
    state_->bodies.push_back(std::make_shared<const MeshBody>(body));
  }
  state_->scene = state_->Watch(ScenePairs(machine, state_->bodies));
}

CollisionChecker::~CollisionChecker() = default;

void CollisionChecker::Check(const motion::Window& window) { state_->OnWindow(window); }

CollisionResult CollisionChecker::Finish() {
  CollisionResult result;
  std::vector<Monitors*> all{&state_->scene};
  for (auto& [tool, monitors] : state_->by_tool) all.push_back(&monitors);
  for (Monitors* monitors : all) {
    for (const auto& monitor : *monitors) {
      monitor->Finish();
      result.queries += monitor->queries();
      const PairSweep& sweep = monitor->sweep();
      if (monitor->has_clearance()) {
        result.clearances.push_back(
            {monitor->pair().names, sweep.least().lower, sweep.least().upper, sweep.least_where()});
      }
      if (monitor->pair().role != PairRole::kFlutesPart || !sweep.has_least()) continue;
      const DeepestCut cut{monitor->pair().tool->tool, std::max(0.0, -sweep.least().upper),
                           sweep.least_where()};
      if (!result.cuts.empty() && result.cuts.back().tool == cut.tool) {
        if (cut.depth_mm > result.cuts.back().depth_mm) result.cuts.back() = cut;
      } else {
        result.cuts.push_back(cut);
      }
    }
  }
  std::stable_sort(state_->findings.begin(), state_->findings.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [number, finding] : state_->findings) result.findings.push_back(std::move(finding));
  state_->findings.clear();
  return result;
}

}  // namespace ncsim::collision
