// SPDX-License-Identifier: BSD-3-Clause
// What is solid, ready for distance queries. Built once; pairs share it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinematics/relative_bound.h"
#include "sim/base/digest.h"
#include "sim/collision/box_tree.h"
#include "sim/collision/fcl_backend.h"
#include "sim/collision/profile_shape.h"
#include "sim/collision/triangle_tree.h"
#include "sim/machine/job.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"

namespace ncsim::collision {

/// A link's shape, a fixture, the part or the blank.
struct MeshBody {
  explicit MeshBody(const machine::SceneBody& body);

  std::string name;
  machine::BodyKind kind = machine::BodyKind::kMachine;
  std::string defect;  ///< Non-empty: cannot be trusted, and why.
  kinematics::Extent extent;
  TriangleTree tree;
  BoxTree boxes;
  FclMesh fcl;
  Digest content;  ///< Of all that it was made of.

 private:
  struct Trees;
  MeshBody(const machine::SceneBody& body, Trees trees);
};

/// The trees are built on as many threads as there are.
std::vector<std::shared_ptr<const MeshBody>> MeshBodiesOf(const machine::Scene& scene);

/// Flutes, shank or holder: a solid of revolution in frame S of the spindle link.
struct ToolBody {
  ToolBody(const machine::Tool& tool, machine::BodyKind body_kind, int spindle_link);

  std::string name;  ///< "T3.holder"
  machine::BodyKind kind = machine::BodyKind::kFlutes;
  int tool = 0;
  double length = 0.0;  ///< Gauge line to tip, mm.
  double reach = 0.0;   ///< From the tip to the farthest point, or a little more, mm.
  kinematics::Extent extent;
  ProfileShape shape;
  FclMesh fcl;  ///< Circumscribed.
  /// A shank no wider than the cutter.
  bool thin = false;
  Digest content;  ///< Of all that it was made of.
};

/// The profile of a part of a tool.
const machine::Profile& ProfileOf(const machine::Tool& tool, machine::BodyKind kind);

}  // namespace ncsim::collision
