// SPDX-License-Identifier: BSD-3-Clause
// Where two bodies touch: a point on each, for the report. Nothing is proven with it.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "sim/collision/pairs.h"
#include "sim/collision/profile_distance.h"

namespace ncsim::collision {

/// A point on the surface of each body.
struct Witness {
  Eigen::Vector3d a, b;
};

/// The mesh's point (b) that is deepest in the solid of revolution, or nearest to it, to 0.001 mm
/// of depth; and the nearest point of the solid's surface (a). In the mesh's frame. nullopt: there
/// is no mesh.
std::optional<Witness> FindWitness(const ProfileShape& a, const TriangleTree& b,
                                   const RevolvedPose& pose);

/// With A at X_BA, in the frame of B's link. Two meshes: a point that both surfaces have, or else
/// where they are nearest. nullopt: not found.
std::optional<Witness> FindWitness(const Pair& pair, const Eigen::Isometry3d& X_BA);

}  // namespace ncsim::collision
