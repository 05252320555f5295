// SPDX-License-Identifier: BSD-3-Clause
// A machine of ten bodies on ten links, in the layout and about the size of a Haas UMC-750: X, Y, Z
// carry the spindle, B and C the table.
#pragma once

#include <filesystem>

namespace ncsim::bench {

/// Writes bench.urdf, bench.srdf, bench.toml and their meshes; false where that fails.
bool WriteMachine(const std::filesystem::path& folder);

}  // namespace ncsim::bench
