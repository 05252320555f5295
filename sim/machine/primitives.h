// SPDX-License-Identifier: BSD-3-Clause
// Box, cylinder and sphere as closed meshes that contain the true shape: vertices lie outside,
// facets touch it.
#pragma once

#include "sim/machine/mesh.h"

namespace ncsim::machine {

/// Greatest distance of a facet's vertex from the true surface, where the triangle budget allows
/// it; mm.
inline constexpr double kPrimitiveSagitta = 0.005;
inline constexpr int kMaxPrimitiveTriangles = 20000;

/// Centred on the origin.
TriangleMesh MakeBox(const Eigen::Vector3d& size);

/// Axis z, centred on the origin, circumscribed. The ends are exact. `excess` (optional): how far
/// vertices stand outside, mm.
TriangleMesh MakeCylinder(double radius, double height, double* excess = nullptr);

/// A geodesic icosahedron, centred on the origin, circumscribed. `excess` as above.
TriangleMesh MakeSphere(double radius, double* excess = nullptr);

/// Adds `offset` to every vertex.
void Translate(const Eigen::Vector3d& offset, TriangleMesh* mesh);

}  // namespace ncsim::machine
