// SPDX-License-Identifier: BSD-3-Clause
// Looking at files. Inputs of a check are looked at through here only (nc::Program, which maps its
// file, logs it itself), so that the log of inputs is whole: tests/architecture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ncsim {

/// The bytes of a file. nullopt where it cannot be read (not there, a folder, larger than
/// `max_bytes`); `reason` then says why, in lower case and without the path.
std::optional<std::string> ReadFile(const std::string& path, std::uint64_t max_bytes,
                                    std::string* reason);

bool IsThere(const std::string& path);
bool IsFile(const std::string& path);
bool IsFolder(const std::string& path);

/// What lies in a folder, in order of bytes; empty where it cannot be read.
std::vector<std::string> NamesIn(const std::string& folder);

/// nullopt where it is not set.
std::optional<std::string> EnvironmentVariable(const std::string& name);

}  // namespace ncsim
