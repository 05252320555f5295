// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/file.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "sim/base/input_log.h"

namespace ncsim {
namespace {

namespace fs = std::filesystem;

fs::file_status LoggedStatus(const std::string& path) {
  LogAsItIs(Input::Kind::kPlace, path);
  std::error_code error;
  return fs::status(path, error);
}

std::optional<std::string> ReadBytes(const std::string& path, std::uint64_t max_bytes,
                                     std::string* reason) {
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

}  // namespace

std::optional<std::string> ReadFile(const std::string& path, std::uint64_t max_bytes,
                                    std::string* reason) {
  std::optional<std::string> bytes = ReadBytes(path, max_bytes, reason);
  if (bytes) {
    LogContent(path, *bytes);
  } else {
    LogAsItIs(Input::Kind::kContent, path);
  }
  return bytes;
}

bool IsThere(const std::string& path) { return fs::exists(LoggedStatus(path)); }
bool IsFile(const std::string& path) { return fs::is_regular_file(LoggedStatus(path)); }
bool IsFolder(const std::string& path) { return fs::is_directory(LoggedStatus(path)); }

std::vector<std::string> NamesIn(const std::string& folder) {
  LogAsItIs(Input::Kind::kListing, folder);
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    names.push_back(it->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<std::string> EnvironmentVariable(const std::string& name) {
  LogAsItIs(Input::Kind::kVariable, name);
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

}  // namespace ncsim
