// SPDX-License-Identifier: BSD-3-Clause
#include "tests/peers/fcl_world.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kinematics/relative_bound.h"
#include "sim/base/units.h"
#include "sim/collision/tessellate.h"

namespace ncsim::peers {
namespace {

using machine::BodyKind;
using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

constexpr double kStep = 0.1;          // mm
constexpr double kTurn = 0.05;         // degrees
constexpr double kToolSagitta = 0.03;  // mm: a 64-gon around the holder
constexpr int kPieces = 8;             // of a motion, to measure the tip's way
constexpr std::size_t kGroups = 3;     // spindle side, table side, at rest

struct Shape {
  Geometry geometry;
  Eigen::Isometry3d X_LG = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_MG = Eigen::Isometry3d::Identity();  // at the present sample
};

/// A link's shape, fixture, part, or a body of the tool: one shape, or several primitives.
struct Body {
  std::string name;
  BodyKind kind = BodyKind::kMachine;
  int link = 0;
  bool tool = false;
  std::vector<Shape> shapes;
};

Geometry MeshGeometry(const machine::TriangleMesh& mesh) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  model->beginModel();
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

/// A cylinder around each straight element, a sphere for a ball.
std::vector<Shape> Primitives(const machine::Profile& profile, double length) {
  std::vector<Shape> shapes;
  for (const machine::ProfileElement& element : profile.elements) {
    Shape shape;
    double z = 0.5 * (element.start.x() + element.end.x());
    if (element.arc) {
      z = element.centre.x();
      shape.geometry = std::make_shared<fcl::Sphered>((element.end - element.centre).norm());
    } else if (element.end.x() > element.start.x()) {
      shape.geometry = std::make_shared<fcl::Cylinderd>(
          std::max(element.start.y(), element.end.y()), element.end.x() - element.start.x());
    } else {
      continue;
    }
    shape.X_LG.translation().z() = length - z;
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

std::vector<Body> Bodies(const machine::Machine& machine, const machine::Scene& scene,
                         const machine::Tool& tool, bool primitives) {
  std::vector<Body> bodies;
  const std::array<std::pair<const machine::Profile*, BodyKind>, 3> parts{
      {{&tool.flutes, BodyKind::kFlutes},
       {&tool.shank, BodyKind::kShank},
       {&tool.holder, BodyKind::kHolder}}};
  const std::array<const char*, 3> words{"flutes", "shank", "holder"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& [profile, kind] = parts[i];
    if (profile->empty()) continue;
    Body body{
        "T" + std::to_string(tool.number) + "." + words[i], kind, machine.spindle_link, true, {}};
    if (primitives) {
      body.shapes = Primitives(*profile, tool.length);
    } else {
      body.shapes.push_back(
          Shape{MeshGeometry(collision::Tessellate(*profile, tool.length, kToolSagitta))});
    }
    bodies.push_back(std::move(body));
  }
  for (const machine::SceneBody& body : scene.bodies) {
    bodies.push_back({body.name, body.kind, body.link, false, {}});
    bodies.back().shapes.push_back(Shape{MeshGeometry(body.mesh)});
  }
  return bodies;
}

bool IsPair(const machine::Machine& machine, const Body& a, const Body& b) {
  if (kinematics::RelativePath(machine.tree, a.link, b.link).rigid()) return false;
  if (a.kind == BodyKind::kFlutes && b.kind == BodyKind::kPart) return false;
  if (a.kind != BodyKind::kMachine || b.kind != BodyKind::kMachine) return true;
  return std::none_of(machine.disabled_pairs.begin(), machine.disabled_pairs.end(),
                      [&](const machine::LinkPair& pair) {
                        return (pair.link_a == a.link && pair.link_b == b.link) ||
                               (pair.link_a == b.link && pair.link_b == a.link);
                      });
}

}  // namespace

int SampleCount(const machine::Machine& machine, double tool_length, const motion::Motion& motion) {
  Eigen::Vector3d last, tip, axis;
  machine.five_axis->TipInTable(motion.q0(), tool_length, &last, &axis);
  double way = 0.0;
  for (int i = 1; i <= kPieces; ++i) {
    machine.five_axis->TipInTable(motion.At(static_cast<double>(i) / kPieces), tool_length, &tip,
                                  &axis);
    way += (tip - last).norm();
    last = tip;
  }
  double turn = 0.0;
  for (const int joint : machine.five_axis->rotary()) {
    turn = std::max(turn, std::abs(motion.q1()[joint] - motion.q0()[joint]));
  }
  return std::max({1, static_cast<int>(std::ceil(way / kStep)),
                   static_cast<int>(std::ceil(Degrees(turn) / kTurn))});
}

struct FclWorld::World {
  using Object = fcl::CollisionObjectd;

  World(const machine::Machine& machine_data, const machine::Scene& scene,
        const machine::Tool& tool_data, Arrangement how);

  void Manage();
  void Place(const motion::JointVector& q);
  bool AllPairs();
  bool Broadphase();
  bool Meet(std::size_t a, std::size_t b);
  static bool OnCandidate(Object* a, Object* b, void* data);

  const machine::Machine* machine;
  int tool_number;
  double tool_length;
  Arrangement arrangement;
  std::vector<Body> bodies;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<std::vector<bool>> is_pair;
  std::vector<Eigen::Isometry3d> X_ML;
  bool tool_in = false;
  std::vector<std::string> contact;
  std::uint64_t samples = 0;
  std::uint64_t calls = 0;
  // For the broadphase: an object a body.
  std::vector<char> object_ids;  // only their addresses count
  std::vector<std::unique_ptr<Object>> objects;
  std::array<fcl::DynamicAABBTreeCollisionManagerd, kGroups> groups;
};

FclWorld::World::World(const machine::Machine& machine_data, const machine::Scene& scene,
                       const machine::Tool& tool_data, Arrangement how)
    : machine(&machine_data),
      tool_number(tool_data.number),
      tool_length(tool_data.length),
      arrangement(how),
      bodies(Bodies(machine_data, scene, tool_data, how == Arrangement::kPlain)),
      is_pair(bodies.size(), std::vector<bool>(bodies.size())) {
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      if (!IsPair(machine_data, bodies[a], bodies[b])) continue;
      pairs.emplace_back(a, b);
      is_pair[a][b] = is_pair[b][a] = true;
    }
  }
  if (how == Arrangement::kBest) Manage();
}

void FclWorld::World::Manage() {
  object_ids.resize(bodies.size());
  const std::vector<int> to_spindle = machine->tree.MovingJointsTo(machine->spindle_link);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    objects.push_back(std::make_unique<Object>(bodies[i].shapes[0].geometry));
    objects.back()->setUserData(&object_ids[i]);
    const std::vector<int> joints = machine->tree.MovingJointsTo(bodies[i].link);
    const std::size_t group =
        joints.empty() ? 2 : (!to_spindle.empty() && joints[0] == to_spindle[0] ? 0 : 1);
    groups[group].registerObject(objects.back().get());
  }
  Place(machine->Home());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    objects[i]->setTransform(bodies[i].shapes[0].X_MG);
    objects[i]->computeAABB();
  }
  for (auto& group : groups) group.setup();
}

void FclWorld::World::Place(const motion::JointVector& q) {
  machine->tree.Poses(q, &X_ML);
  for (Body& body : bodies) {
    for (Shape& shape : body.shapes) {
      shape.X_MG = X_ML[static_cast<std::size_t>(body.link)] * shape.X_LG;
    }
  }
}

bool FclWorld::World::Meet(std::size_t a, std::size_t b) {
  for (const Shape& shape_a : bodies[a].shapes) {
    for (const Shape& shape_b : bodies[b].shapes) {
      ++calls;
      bool meet = false;
      if (arrangement == Arrangement::kDistance) {
        fcl::DistanceResultd result;
        meet = fcl::distance(shape_a.geometry.get(), shape_a.X_MG, shape_b.geometry.get(),
                             shape_b.X_MG, fcl::DistanceRequestd(), result) <= 0.0;
      } else {
        fcl::CollisionResultd result;
        meet = fcl::collide(shape_a.geometry.get(), shape_a.X_MG, shape_b.geometry.get(),
                            shape_b.X_MG, fcl::CollisionRequestd(), result) > 0;
      }
      if (!meet) continue;
      contact = {bodies[a].name, bodies[b].name};
      return true;
    }
  }
  return false;
}

bool FclWorld::World::AllPairs() {
  return std::any_of(pairs.begin(), pairs.end(), [this](const auto& pair) {
    return (tool_in || !bodies[pair.first].tool) && Meet(pair.first, pair.second);
  });
}

bool FclWorld::World::OnCandidate(Object* a, Object* b, void* data) {
  auto& world = *static_cast<World*>(data);
  const auto id = [&world](const Object& object) {
    return static_cast<std::size_t>(static_cast<const char*>(object.getUserData()) -
                                    world.object_ids.data());
  };
  const std::size_t i = std::min(id(*a), id(*b));
  const std::size_t k = std::max(id(*a), id(*b));
  if (!world.is_pair[i][k] || (world.bodies[i].tool && !world.tool_in)) return false;
  return world.Meet(i, k);  // true ends the search
}

bool FclWorld::World::Broadphase() {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    objects[i]->setTransform(bodies[i].shapes[0].X_MG);
    objects[i]->computeAABB();
  }
  groups[0].update();
  groups[1].update();
  groups[0].collide(&groups[1], this, OnCandidate);
  if (contact.empty()) groups[0].collide(&groups[2], this, OnCandidate);
  if (contact.empty()) groups[1].collide(&groups[2], this, OnCandidate);
  if (contact.empty()) groups[0].collide(this, OnCandidate);
  if (contact.empty()) groups[1].collide(this, OnCandidate);
  return !contact.empty();
}

FclWorld::FclWorld(const machine::Machine& machine, const machine::Scene& scene,
                   const machine::Tool& tool, Arrangement arrangement)
    : world_(std::make_unique<World>(machine, scene, tool, arrangement)) {}

FclWorld::~FclWorld() = default;

bool FclWorld::Check(const motion::Motion& motion) {
  World& world = *world_;
  if (!world.contact.empty()) return false;
  if (motion.q0().size() != world.machine->tree.num_moving()) return true;
  world.tool_in = motion.facts.tool == world.tool_number;
  const int count = SampleCount(*world.machine, world.tool_length, motion);
  for (int i = 1; i <= count; ++i) {
    world.Place(motion.At(static_cast<double>(i) / count));
    ++world.samples;
    if (world.arrangement == Arrangement::kBest ? world.Broadphase() : world.AllPairs()) {
      return false;
    }
  }
  return true;
}

const std::vector<std::string>& FclWorld::contact() const { return world_->contact; }
std::uint64_t FclWorld::samples() const { return world_->samples; }
std::uint64_t FclWorld::calls() const { return world_->calls; }

std::vector<std::vector<std::string>> FclWorld::pairs() const {
  std::vector<std::vector<std::string>> names;
  for (const auto& [a, b] : world_->pairs) {
    names.push_back({world_->bodies[a].name, world_->bodies[b].name});
  }
  return names;
}

}  // namespace ncsim::peers
