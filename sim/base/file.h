// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ncsim {

/// The bytes of a file. nullopt where it cannot be read (not there, a folder, larger than
/// `max_bytes`); `reason` then says why, in lower case and without the path.
std::optional<std::string> ReadFile(const std::string& path, std::uint64_t max_bytes,
                                    std::string* reason);

}  // namespace ncsim
