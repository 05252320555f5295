// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/collision/tessellate.h"

namespace ncsim::collision {

namespace {

using machine::BodyKind;

constexpr double kSweptSagitta = 0.5;  // mm

bool Rigid(const machine::Machine& machine, int link_a, int link_b) {
  return kinematics::RelativePath(machine.tree, link_b, link_a).rigid();
}

bool Disabled(const machine::Machine& machine, int link_a, int link_b) {
  return std::any_of(machine.disabled_pairs.begin(), machine.disabled_pairs.end(),
                     [&](const machine::LinkPair& pair) {
                       return (pair.link_a == link_a && pair.link_b == link_b) ||
                              (pair.link_a == link_b && pair.link_b == link_a);
                     });
}

// Moving joints between the spindle and a link: the fewer, the nearer to the tool.
std::size_t JointsToSpindle(const machine::Machine& machine, int link) {
  return kinematics::RelativePath(machine.tree, machine.spindle_link, link).joint_indices().size();
}

// How far points of one body get, as seen from the other's link, for a unit step of every joint
// about home: the better choice of A gives tighter bounds.
double Reach(const machine::Machine& machine, const MeshBody& a, const MeshBody& b) {
  const kinematics::RelativePath path(machine.tree, b.extent.link, a.extent.link);
  const motion::JointVector unit = motion::JointVector::Ones(machine.tree.num_moving());
  return path.Bound(machine.Home(), a.extent, unit);
}

void ChooseA(const machine::Machine& machine, std::shared_ptr<const MeshBody> a,
             std::shared_ptr<const MeshBody> b, Pair* pair) {
  // The bound under TCP wants the tool side as A.
  const bool tcp = machine.five_axis.has_value() &&
                   Rigid(machine, a->extent.link, machine.spindle_link) &&
                   Rigid(machine, b->extent.link, machine.table_link);
  if (!tcp && Reach(machine, *b, *a) < Reach(machine, *a, *b)) std::swap(a, b);
  pair->mesh_a = std::move(a);
  pair->b = std::move(b);
}

// What `body` sweeps when the rotary joint that its link hangs on turns, as a body of the joint's
// parent: the convex solid of revolution around all of it. Null where that joint is not rotary.
std::shared_ptr<const MeshBody> SweptBody(const machine::Machine& machine, const MeshBody& body) {
  const std::vector<int> moving = machine.tree.MovingJointsTo(body.extent.link);
  if (moving.empty() || body.tree.empty()) return nullptr;
  const kinematics::Joint& joint = machine.tree.joints()[static_cast<std::size_t>(moving.back())];
  if (joint.type != kinematics::JointType::kRevolute) return nullptr;
  // X_PJ with Z along the joint's axis.
  Eigen::Isometry3d X_PZ = joint.X_PJ;
  X_PZ.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), joint.axis));
  const motion::JointVector zero = motion::JointVector::Zero(machine.tree.num_moving());
  const Eigen::Isometry3d X_PL =
      kinematics::RelativePath(machine.tree, joint.parent_link, body.extent.link).Pose(zero);
  const Eigen::Isometry3d X_ZL = X_PZ.inverse() * X_PL;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < body.tree.size(); ++i) {
    for (const Eigen::Vector3d& v : body.tree.triangle(i)) {
      const Eigen::Vector3d p = X_ZL * v;
      points.emplace_back(p.z(), std::hypot(p.x(), p.y()));
    }
  }
  machine::SceneBody swept;
  swept.name = body.name;
  swept.kind = body.kind;
  swept.link = joint.parent_link;
  swept.mesh = Tessellate(ConvexHull(std::move(points)), 0.0, kSweptSagitta);
  // Tessellate points its Z down the profile.
  for (Eigen::Vector3d& v : swept.mesh.vertices) {
    v = X_PZ * Eigen::Vector3d(v.x(), -v.y(), -v.z());
  }
  return std::make_shared<const MeshBody>(swept);
}

// The pair (a, b) with b swept, if b has a rotary joint of its own.
std::shared_ptr<const Pair> SweptPair(const machine::Machine& machine, const Pair& pair,
                                      const std::shared_ptr<const MeshBody>& a,
                                      const std::shared_ptr<const MeshBody>& swept_b) {
  if (swept_b == nullptr) return nullptr;
  auto swept = std::make_shared<Pair>();
  swept->role = pair.role;
  swept->names = pair.names;
  ChooseA(machine, a, swept_b, swept.get());
  return swept;
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
  std::map<const MeshBody*, std::shared_ptr<const MeshBody>> swept;
  const auto swept_of = [&](const std::shared_ptr<const MeshBody>& body) {
    const auto [entry, is_new] = swept.try_emplace(body.get());
    if (is_new) entry->second = SweptBody(machine, *body);
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
      if (links && Disabled(machine, link_a, link_b)) continue;
      if (JointsToSpindle(machine, link_b) < JointsToSpindle(machine, link_a)) std::swap(a, b);
      Pair pair;
      pair.role = RoleOf(a->kind, b->kind);
      pair.names = {a->name, b->name};
      pair.swept = SweptPair(machine, pair, a, swept_of(b));
      if (pair.swept == nullptr) pair.swept = SweptPair(machine, pair, b, swept_of(a));
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
