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
  bool watertight = false;  ///< Every edge is shared by exactly two triangles of opposite sense.
};

}  // namespace ncsim::machine
