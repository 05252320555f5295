// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/witness.h"

namespace ncsim::collision {

std::optional<Witness> FindWitness(const ProfileShape& a, const TriangleTree& b,
                                   const RevolvedPose& pose) {
  ProfileDistance kernel(a, b);
  DistanceGoal goal;
  goal.gap = 1e-3;
  kernel.Surface(pose, goal);
  if (!kernel.witness().has_value()) return std::nullopt;
  return Witness{kernel.NearestOnSurface(*kernel.witness()), *kernel.witness()};
}

std::optional<Witness> FindWitness(const Pair& pair, const Eigen::Isometry3d& X_BA) {
  if (pair.tool) {
    return FindWitness(pair.tool->shape, pair.b->tree, ToolPose(X_BA, pair.tool->length));
  }
  const auto points = CommonOrNearestPoints(pair.mesh_a->fcl, pair.b->fcl, X_BA);
  if (!points) return std::nullopt;
  return Witness{points->first, points->second};
}

}  // namespace ncsim::collision
