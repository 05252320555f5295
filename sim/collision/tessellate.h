// SPDX-License-Identifier: BSD-3-Clause
// Tool bodies as meshes, for FCL: its shape primitives are not safe to use
// (docs/decisions/0006-fcl.md).
#pragma once

#include "sim/machine/mesh.h"
#include "sim/machine/tool.h"

namespace ncsim::collision {

/// Greatest distance between a tool body and the mesh around it, mm.
inline constexpr double kSagitta = 0.005;

/// A closed mesh that encloses the solid of revolution, nowhere further than kSagitta from it:
/// rings of tangent planes, arcs of the profile likewise. In frame S (gauge line, Z toward the
/// tool): profile point (z, r) lies at z_S = `length` - z.
machine::TriangleMesh Tessellate(const machine::Profile& profile, double length,
                                 double sagitta = kSagitta);

}  // namespace ncsim::collision
