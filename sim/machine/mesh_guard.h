// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace ncsim::machine {

/// Looks at the bytes of a mesh file before assimp does, for what would make it hang, run out of
/// memory or of stack: element counts that the file cannot hold (PLY), headers without an end,
/// nesting deeper than any model's (DAE, GLB). Returns the defect, "" if there is none. `extension`
/// in lower case: "ply", "dae", "glb"; others pass.
std::string GuardMesh(std::string_view extension, std::string_view bytes);

}  // namespace ncsim::machine
