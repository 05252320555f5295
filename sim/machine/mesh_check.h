// SPDX-License-Identifier: BSD-3-Clause
// What makes a triangle soup a solid that a check may trust.
#pragma once

#include <string>

#include "sim/machine/mesh.h"

namespace ncsim::machine {

inline constexpr double kLargestBody = 50000.0;  ///< mm; a larger one is a mistake of units.
inline constexpr double kSmallestBody = 1.0;     ///< mm.

struct MeshCheck {
  std::string defect;  ///< Why it cannot be trusted; "" if it can.
  std::string note;    ///< What was mended: worth a warning.
};

/// Welds equal vertices (and, where the mesh is open otherwise, those within 1e-6 of its size),
/// drops triangles without area, sets `watertight`, turns a closed mesh that is inside out, and
/// looks at its size. Vertices that are not finite are a defect.
MeshCheck CheckMesh(TriangleMesh* mesh);

/// Signed volume, mm^3: positive for outward normals. Meaningful for a closed mesh.
double SignedVolume(const TriangleMesh& mesh);

/// Lower and upper corner of the box around it; zeros where it is empty.
void BoundingBox(const TriangleMesh& mesh, Eigen::Vector3d* lower, Eigen::Vector3d* upper);

}  // namespace ncsim::machine
