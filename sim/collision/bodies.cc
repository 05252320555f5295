// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/bodies.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/collision/content.h"
#include "sim/collision/tessellate.h"

namespace ncsim::collision {

namespace {

using Eigen::Vector3d;

std::string Defect(const machine::SceneBody& body) {
  if (!body.defect.empty()) return body.defect;
  if (body.mesh.triangles.empty()) return "the mesh is empty";
  for (const Vector3d& v : body.mesh.vertices) {
    if (!v.allFinite()) return "the mesh has a vertex that is not a number";
  }
  // A hollow shell has no inside: a body within it would go unseen.
  if (!body.mesh.watertight) return "the mesh is not watertight";
  return "";
}

machine::TriangleMesh Usable(const machine::SceneBody& body) {
  return Defect(body).empty() ? body.mesh : machine::TriangleMesh{};
}

kinematics::Extent ExtentOf(const machine::SceneBody& body) {
  kinematics::Extent extent;
  extent.link = body.link;
  if (body.mesh.vertices.empty()) return extent;
  Vector3d lower = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d upper = -lower;
  for (const Vector3d& v : body.mesh.vertices) {
    lower = lower.cwiseMin(v);
    upper = upper.cwiseMax(v);
  }
  extent.p_LC = 0.5 * (lower + upper);
  for (const Vector3d& v : body.mesh.vertices) {
    extent.radius = std::max(extent.radius, (v - extent.p_LC).norm());
  }
  return extent;
}

const char* Word(machine::BodyKind kind) {
  switch (kind) {
    case machine::BodyKind::kShank:
      return "shank";
    case machine::BodyKind::kHolder:
      return "holder";
    default:
      return "flutes";
  }
}

}  // namespace

struct MeshBody::Trees {
  explicit Trees(const machine::TriangleMesh& mesh) {
    oneapi::tbb::parallel_invoke([&] { tree.emplace(mesh); }, [&] { boxes.emplace(mesh); },
                                 [&] { fcl.emplace(mesh); });
  }
  std::optional<TriangleTree> tree;
  std::optional<BoxTree> boxes;
  std::optional<FclMesh> fcl;
};

MeshBody::MeshBody(const machine::SceneBody& body) : MeshBody(body, Trees(Usable(body))) {}

MeshBody::MeshBody(const machine::SceneBody& body, Trees trees)
    : name(body.name),
      kind(body.kind),
      defect(Defect(body)),
      extent(ExtentOf(body)),
      tree(*std::move(trees.tree)),
      boxes(*std::move(trees.boxes)),
      fcl(*std::move(trees.fcl)),
      content(ContentOf(body)) {}

std::vector<std::shared_ptr<const MeshBody>> MeshBodiesOf(const machine::Scene& scene) {
  std::vector<std::shared_ptr<const MeshBody>> bodies(scene.bodies.size());
  // Isolated: a thread that waits for a tree takes no other program's work meanwhile.
  oneapi::tbb::this_task_arena::isolate([&] {
    oneapi::tbb::parallel_for(
        std::size_t{0}, bodies.size(),
        [&](std::size_t i) { bodies[i] = std::make_shared<const MeshBody>(scene.bodies[i]); },
        oneapi::tbb::simple_partitioner());
  });
  return bodies;
}

const machine::Profile& ProfileOf(const machine::Tool& tool, machine::BodyKind kind) {
  if (kind == machine::BodyKind::kShank) return tool.shank;
  if (kind == machine::BodyKind::kHolder) return tool.holder;
  return tool.flutes;
}

ToolBody::ToolBody(const machine::Tool& tool_data, machine::BodyKind body_kind, int spindle_link)
    : name(machine::ToolBodyName(tool_data.number, Word(body_kind))),
      kind(body_kind),
      tool(tool_data.number),
      length(tool_data.length),
      shape(ProfileOf(tool_data, body_kind)),
      fcl(Tessellate(ProfileOf(tool_data, body_kind), tool_data.length)) {
  extent.link = spindle_link;
  extent.p_LC = Vector3d(0.0, 0.0, length - 0.5 * (shape.z_min() + shape.z_max()));
  extent.radius = std::hypot(0.5 * (shape.z_max() - shape.z_min()), shape.r_max());
  reach = std::hypot(std::max(std::abs(shape.z_min()), std::abs(shape.z_max())), shape.r_max());
  double cutter = 0.5 * tool_data.diameter;
  if (!tool_data.flutes.empty()) cutter = ProfileShape(tool_data.flutes).r_max();
  thin = kind == machine::BodyKind::kShank && shape.r_max() <= cutter + 1e-6;
  content = ContentOf(*this, ProfileOf(tool_data, body_kind));
}

}  // namespace ncsim::collision
