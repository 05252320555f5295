// SPDX-License-Identifier: BSD-3-Clause
// Mesh files: STL, OBJ, PLY, DAE, GLB.
#pragma once

#include <string>

#include "sim/machine/mesh.h"

namespace ncsim::machine {

struct MeshFile {
  TriangleMesh mesh;   ///< Scaled, welded, outward; as far as it could be read.
  std::string defect;  ///< Why it cannot be trusted, as the end of a sentence whose subject is the
                       ///< file; "" if it can.
  std::string note;    ///< What was mended; "" for nothing.
};

/// Whether files of this name state their own unit (DAE, GLB): assimp then gives metres.
bool StatesUnit(const std::string& path);

/// Reads, scales (a negative scale mirrors; triangles then keep facing outward), checks and mends a
/// mesh file. Never throws.
MeshFile ReadMeshFile(const std::string& path, const Eigen::Vector3d& scale_to_mm);

/// Makes an STL file consistent before assimp sees it: trailing bytes go, a triangle count that is
/// too large for the file becomes what the file has (and `defect` says so). Text files are left
/// alone, but must be complete.
void MendStl(std::string* bytes, std::string* defect);

}  // namespace ncsim::machine
