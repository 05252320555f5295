// SPDX-License-Identifier: BSD-3-Clause
// Closed meshes of a stated fineness, for benchmarks; the same bytes every time.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "sim/machine/mesh.h"

namespace ncsim::bench {

/// A globe: a pole, `rings` closed rings of `sides` points each, a pole. `point(ring, side)` gives
/// the points, the sides counter-clockwise seen from the last pole; 2 * sides * rings triangles.
machine::TriangleMesh GlobeMesh(int rings, int sides, const Eigen::Vector3d& first_pole,
                                const Eigen::Vector3d& last_pole,
                                const std::function<Eigen::Vector3d(int, int)>& point);

/// A solid of revolution about Z. `meridian`: (z, r) from the lower end to the upper one, without
/// the points on the axis; edges longer than `pitch` (mm) are divided.
machine::TriangleMesh RevolvedMesh(const std::vector<Eigen::Vector2d>& meridian, double pitch,
                                   int sides);

struct Block {
  Eigen::Vector3d lower, upper;
  bool hollow = false;  ///< Takes away what the blocks before it put there.
};

/// The surface of a union of blocks, in squares of at most `pitch` (mm) halved.
machine::TriangleMesh BlockMesh(const std::vector<Block>& blocks, double pitch);

/// Binary STL; false where it cannot be written.
bool WriteStl(const machine::TriangleMesh& mesh, const std::string& path);

}  // namespace ncsim::bench
