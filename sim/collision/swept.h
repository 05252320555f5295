// SPDX-License-Identifier: BSD-3-Clause
// What a body sweeps when the rotary joint that it hangs on turns: a solid of revolution on the
// joint's parent, which that joint does not move any more.
#pragma once

#include <memory>

#include "kinematics/relative_bound.h"
#include "sim/collision/bodies.h"
#include "sim/collision/profile_distance.h"
#include "sim/collision/profile_shape.h"
#include "sim/machine/machine.h"

namespace ncsim::collision {

/// The least convex solid of revolution around all that a body sweeps.
struct SweptBody {
  kinematics::Extent extent;  ///< On the joint's parent link.
  RevolvedPose pose;          ///< In the parent link's frame.
  ProfileShape shape;
};

/// Null where the joint is not rotary.
std::shared_ptr<const SweptBody> Sweep(const machine::Machine& machine, const MeshBody& body);

/// A pair of meshes with one of them swept: its clearance is never more than the pair's.
struct SweptPair {
  std::shared_ptr<const SweptBody> swept;
  std::shared_ptr<const MeshBody> mesh;
  bool mesh_is_a = false;  ///< For the motion bound; else the swept body is A.

  const kinematics::Extent& extent_a() const { return mesh_is_a ? mesh->extent : swept->extent; }
  int link_b() const { return mesh_is_a ? swept->extent.link : mesh->extent.link; }
};

}  // namespace ncsim::collision
