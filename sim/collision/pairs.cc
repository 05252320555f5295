// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ncsim::collision {

namespace {

using machine::BodyKind;

bool Rigid(const machine::Machine& machine, int link_a, int link_b) {
  return kinematics::RelativePath(machine.tree, link_b, link_a).rigid();
}

// Moving joints between the spindle and a link: the fewer, the nearer to the tool.
std::size_t JointsToSpindle(const machine::Machine& machine, int link) {
  return kinematics::RelativePath(machine.tree, machine.spindle_link, link).joint_indices().size();
}

// How far points of one body get, as seen from the other's link, for a unit step of every joint
// about home: the better choice of A gives tighter bounds.
double Reach(const machine::Machine& machine, const kinematics::Extent& a,
             const kinematics::Extent& b) {
  const kinematics::RelativePath path(machine.tree, b.link, a.link);
  const motion::JointVector unit = motion::JointVector::Ones(machine.tree.num_moving());
  return path.Bound(machine.Home(), a, unit);
}

void ChooseA(const machine::Machine& machine, std::shared_ptr<const MeshBody> a,
             std::shared_ptr<const MeshBody> b, Pair* pair) {
  // The bound under TCP wants the tool side as A.
  const bool tcp = machine.five_axis.has_value() &&
                   Rigid(machine, a->extent.link, machine.spindle_link) &&
                   Rigid(machine, b->extent.link, machine.table_link);
  if (!tcp && Reach(machine, b->extent, a->extent) < Reach(machine, a->extent, b->extent))
    std::swap(a, b);
  pair->mesh_a = std::move(a);
  pair->b = std::move(b);
}

// The pair (a, b) with b swept, if b has a rotary joint of its own.
std::shared_ptr<const SweptPair> PairOfSwept(const machine::Machine& machine,
                                             const std::shared_ptr<const MeshBody>& a,
                                             const std::shared_ptr<const SweptBody>& swept_b) {
  if (swept_b == nullptr) return nullptr;
  const bool mesh_is_a =
      Reach(machine, a->extent, swept_b->extent) <= Reach(machine, swept_b->extent, a->extent);
  return std::make_shared<const SweptPair>(SweptPair{swept_b, a, mesh_is_a});
}

PairRole RoleOf(BodyKind a, BodyKind b) {
  return a == BodyKind::kStock || b == BodyKind::kStock ? PairRole::kOtherBlank
                                                        : PairRole::kNeverTouch;
}

PairRole RoleOf(const ToolBody& tool, BodyKind other) {
  const bool flutes = tool.kind == BodyKind::kFlutes;
  if (other == BodyKind::kPart) {
    return flutes      ? PairRole::kFlutesPart
           : tool.thin ? PairRole::kThinShankPart
                       : PairRole::kNeverTouch;
  }
  if (other == BodyKind::kStock) {
    return flutes      ? PairRole::kFlutesBlank
           : tool.thin ? PairRole::kThinShankBlank
                       : PairRole::kOtherBlank;
  }
  return PairRole::kNeverTouch;
}

}  // namespace

std::vector<Pair> ScenePairs(const machine::Machine& machine, const MeshBodies& bodies) {
  std::vector<Pair> pairs;
  std::map<const MeshBody*, std::shared_ptr<const SweptBody>> swept;
  const auto swept_of = [&](const std::shared_ptr<const MeshBody>& body) {
    const auto [entry, is_new] = swept.try_emplace(body.get());
    if (is_new) entry->second = Sweep(machine, *body);
    return entry->second;
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t k = i + 1; k < bodies.size(); ++k) {
      std::shared_ptr<const MeshBody> a = bodies[i];
      std::shared_ptr<const MeshBody> b = bodies[k];
      const int link_a = a->extent.link;
      const int link_b = b->extent.link;
      if (Rigid(machine, link_a, link_b)) continue;
      const bool links = a->kind == BodyKind::kMachine && b->kind == BodyKind::kMachine;
      if (links && machine.Disabled(link_a, link_b)) continue;
      if (JointsToSpindle(machine, link_b) < JointsToSpindle(machine, link_a)) std::swap(a, b);
      Pair pair;
      pair.role = RoleOf(a->kind, b->kind);
      pair.names = {a->name, b->name};
      pair.swept = PairOfSwept(machine, a, swept_of(b));
      if (pair.swept == nullptr) pair.swept = PairOfSwept(machine, b, swept_of(a));
      ChooseA(machine, std::move(a), std::move(b), &pair);
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

std::vector<Pair> ToolPairs(const machine::Machine& machine, const machine::Tool& tool,
                            const MeshBodies& bodies) {
  std::vector<Pair> pairs;
  for (BodyKind kind : {BodyKind::kFlutes, BodyKind::kShank, BodyKind::kHolder}) {
    if (ProfileOf(tool, kind).empty()) continue;
    const auto body = std::make_shared<const ToolBody>(tool, kind, machine.spindle_link);
    for (const auto& other : bodies) {
      if (Rigid(machine, machine.spindle_link, other->extent.link)) continue;
      Pair pair;
      pair.role = RoleOf(*body, other->kind);
      pair.tool = body;
      pair.b = other;
      pair.names = {body->name, other->name};
      pairs.push_back(std::move(pair));
    }
  }
  // The first cut is judged before whatever else touches the blank on the same motion.
  std::stable_partition(pairs.begin(), pairs.end(),
                        [](const Pair& pair) { return pair.role == PairRole::kFlutesBlank; });
  return pairs;
}

}  // namespace ncsim::collision
