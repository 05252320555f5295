// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/checker.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "sim/collision/batch.h"
#include "sim/machine/margins.h"

namespace ncsim::collision {

namespace {

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
        const machine::CheckSettings& check, const OutcomeCache* known)
      : machine(&machine_data), tools(&tool_table), settings(check), cache(known) {}

  bool Trusted(const Pair& pair);
  BlankState* BlankOf(const Pair& pair);
  WatchedPairs Watch(std::vector<Pair> pairs);
  void ChangeTool(const motion::Motion& motion);
  void ReportBroken(const SourcePosition& where);
  void OnRun(std::vector<const motion::Motion*> motions, const SharedWindow& window);
  void OnWindow(const SharedWindow& window);
  void Turn();
  void Complete();

  const machine::Machine* machine;
  const machine::ToolTable* tools;
  machine::CheckSettings settings;
  const OutcomeCache* cache;
  MeshBodies bodies;
  std::map<const MeshBody*, BlankState> blanks;
  NumberedFindings findings;
  WatchedPairs scene;
  std::map<int, WatchedPairs> by_tool;  // kept, so that a tool's least clearance spans all its uses
  WatchedPairs* in_spindle = nullptr;
  int tool = 0;
  std::set<int> unknown_tools;
  std::set<const MeshBody*> broken;
  std::vector<const MeshBody*> newly_broken;  // not reported yet
  std::uint64_t number = 0;                   // of motions so far
  std::uint64_t outcomes = 0, recalled = 0;
  double lean = 0.0;
  Batch filling, running;
  std::size_t windows = 0;  // in `filling`
  std::size_t batch_size = 1;
  // Last, so that it is gone first: its work uses all of the above.
  BatchRunner runner;
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

WatchedPairs CollisionChecker::State::Watch(std::vector<Pair> pairs) {
  WatchedPairs watched;
  for (Pair& pair : pairs) {
    if (!Trusted(pair)) continue;
    BlankState* blank = BlankOf(pair);
    machine::CheckSettings check = settings;
    check.clearance =
        NearMissClearance(*machine, settings, AsMarginBody(*pair.b),
                          pair.tool ? AsMarginBody(*pair.tool) : AsMarginBody(*pair.mesh_a));
    if (machine->nominal_shapes && HasMachineBody(pair)) {
      // The verdict turns on the margin; what is proven elsewhere is a quarter below what is seen.
      check.exact_below = std::max(check.exact_below, 1.5 * machine::kNominalMargin);
    }
    watched.push_back(std::make_unique<WatchedPair>(*machine, check, std::move(pair), blank));
  }
  return watched;
}

void CollisionChecker::State::ChangeTool(const motion::Motion& motion) {
  tool = motion.facts.tool;
  in_spindle = nullptr;
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

void CollisionChecker::State::ReportBroken(const SourcePosition& where) {
  for (const MeshBody* body : newly_broken) {
    Finding finding =
        MakeFinding(Rule::kUncertified, where,
                    "nothing was checked against " + body->name + ": " + body->defect);
    finding.bodies = {body->name};
    findings.emplace_back(number + 1, std::move(finding));
  }
  newly_broken.clear();
}

void CollisionChecker::State::OnRun(std::vector<const motion::Motion*> motions,
                                    const SharedWindow& window) {
  if (motions.empty()) return;
  const motion::Motion& first = *motions.front();
  BatchRun run;
  run.tool_changed = first.facts.tool != tool;
  if (run.tool_changed) ChangeTool(first);
  ReportBroken(first.where);
  const machine::Tool* data = tools->Find(tool);
  run.tool_length = data == nullptr ? 0.0 : data->length;
  run.window = window;
  run.number = number + 1;
  // The tool first: its flutes decide whether the blank is still whole.
  if (in_spindle != nullptr) run.groups.push_back(in_spindle);
  run.groups.push_back(&scene);
  number += motions.size();
  run.motions = std::move(motions);
  filling.push_back(std::move(run));
}

// Runs of motions that follow each other with one tool; a dwell that states no axes is passed over.
void CollisionChecker::State::OnWindow(const SharedWindow& window) {
  std::vector<const motion::Motion*> run;
  for (const motion::Motion& motion : window->motions) {
    if (motion.q0().size() != machine->tree.num_moving()) continue;
    const bool follows = !run.empty() && motion.facts.tool == run.back()->facts.tool &&
                         SamePose(run.back()->q1(), motion.q0());
    if (!follows) OnRun(std::exchange(run, {}), window);
    run.push_back(&motion);
  }
  OnRun(std::move(run), window);
  if (++windows >= batch_size) Turn();
}

// The batch that was being checked is done; the one that is full is begun.
void CollisionChecker::State::Turn() {
  Complete();
  running = std::exchange(filling, {});
  windows = 0;
  batch_size = std::min(2 * batch_size, kMostWindows);
  runner.Start(*machine, cache, &running);
}

void CollisionChecker::State::Complete() {
  Batch done;
  // Whatever is thrown, there is nothing half checked to be told.
  try {
    runner.Wait();
  } catch (...) {
    running.clear();
    throw;
  }
  done.swap(running);
  for (const BatchRun& run : done) {
    outcomes += run.outcomes.size();
    if (run.known != nullptr) recalled += run.known->recalled();
    lean = std::max(lean, run.travel->orientation_tolerance());
  }
  Tell(&done, &findings);
}

CollisionChecker::CollisionChecker(const machine::Machine& machine, const machine::Scene& scene,
                                   const machine::ToolTable& tools,
                                   const machine::CheckSettings& settings,
                                   const OutcomeCache* cache)
    : state_(std::make_unique<State>(machine, tools, settings, cache)) {
  state_->bodies = MeshBodiesOf(scene);
  state_->scene = state_->Watch(ScenePairs(machine, state_->bodies));
}

CollisionChecker::~CollisionChecker() = default;

void CollisionChecker::Check(motion::Window window) {
  state_->OnWindow(std::make_shared<const motion::Window>(std::move(window)));
}

CollisionResult CollisionChecker::Finish() {
  state_->Turn();
  state_->Complete();
  CollisionResult result;
  result.outcomes = state_->outcomes;
  result.recalled = state_->recalled;
  result.orientation_tolerance = state_->lean;
  std::vector<WatchedPairs*> all{&state_->scene};
  for (auto& [tool, pairs] : state_->by_tool) all.push_back(&pairs);
  for (WatchedPairs* pairs : all) {
    for (const auto& watched : *pairs) {
      const Pair& pair = watched->setup.pair;
      PairReport& report = watched->report;
      report.Finish(watched->setup, &state_->findings);
      result.queries += report.queries();
      if (watched->has_clearance()) {
        result.clearances.push_back({pair.names, report.least().lower, report.least().upper,
                                     report.least_where(), report.widened()});
      }
      if (pair.role != PairRole::kFlutesPart || report.least().upper >= 0.0) continue;
      const DeepestCut cut{pair.tool->tool, -report.least().upper, report.least_where()};
      if (!result.cuts.empty() && result.cuts.back().tool == cut.tool) {
        if (cut.depth_mm > result.cuts.back().depth_mm) result.cuts.back() = cut;
      } else {
        result.cuts.push_back(cut);
      }
    }
  }
  // By motion, then in an order that no window has a part in.
  std::stable_sort(state_->findings.begin(), state_->findings.end(),
                   [](const auto& a, const auto& b) {
                     return std::tie(a.first, a.second.rule, a.second.bodies) <
                            std::tie(b.first, b.second.rule, b.second.bodies);
                   });
  for (auto& [number, finding] : state_->findings) result.findings.push_back(std::move(finding));
  state_->findings.clear();
  return result;
}

}  // namespace ncsim::collision
