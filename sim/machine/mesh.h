// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace ncsim::machine {

/// Triangles with outward normals (counter-clockwise seen from outside), mm.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  /// Every edge is shared by two triangles of opposite sense (or by two such pairs, where solids
  /// touch in an edge).
  bool watertight = false;
};

}  // namespace ncsim::machine
