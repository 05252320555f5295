// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/file.h"

#include <filesystem>
#include <fstream>
#include <system_error>

namespace ncsim {

std::optional<std::string> ReadFile(const std::string& path, std::uint64_t max_bytes,
                                    std::string* reason) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    *reason = "no such file";
    return std::nullopt;
  }
  if (!fs::is_regular_file(status)) {
    *reason = "not a file";
    return std::nullopt;
  }
  const std::uint64_t size = fs::file_size(path, error);
  if (!error && size > max_bytes) {
    *reason = "the file has " + std::to_string(size) + " bytes; at most " +
              std::to_string(max_bytes) + " are read";
    return std::nullopt;
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(error ? 0 : static_cast<std::size_t>(size), '\0');
  if (error || !stream || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    *reason = "the file cannot be read";
    return std::nullopt;
  }
  return bytes;
}

}  // namespace ncsim
