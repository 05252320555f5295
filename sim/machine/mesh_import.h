// SPDX-License-Identifier: BSD-3-Clause
// assimp meets the code here and nowhere else.
#pragma once

#include <string>

#include "sim/machine/mesh.h"

namespace ncsim::machine {

/// What assimp makes of the bytes of a mesh file: raw triangles in the file's unit (DAE, GLB:
/// metres), Z up (GLB is turned; the up axis of a DAE is ignored). `extension` in lower case.
/// Empty, with a reason in `defect`, where it fails.
///
/// assimp 5.2 dereferences bad pointers, aborts, loops and leaks on broken OBJ, PLY, DAE, GLB and
/// text STL files, so those are read in a child process with limits on time and memory; binary STL,
/// which is made consistent first, is read here.
TriangleMesh ImportMesh(const std::string& bytes, const std::string& extension,
                        std::string* defect);

}  // namespace ncsim::machine
