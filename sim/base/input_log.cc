// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/input_log.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <system_error>
#include <utility>

#include "sim/base/digest.h"

namespace ncsim {
namespace {

namespace fs = std::filesystem;

/// Bytes. Nobody reads a larger file; nc::Program would map it, and its check is done again.
constexpr std::uintmax_t kLargest = std::uintmax_t{1} << 32U;

struct Log {
  std::mutex mutex;
  std::map<std::pair<Input::Kind, std::string>, std::string> states;
};

Log& TheLog() {
  static Log log;
  return log;
}

std::atomic<bool>& LogIsOn() {
  static std::atomic<bool> on{false};
  return on;
}

std::string ContentNow(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return "nothing";
  if (!fs::is_regular_file(status)) return "no file";
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return "unreadable";
  if (size > kLargest) return std::to_string(size) + " bytes";
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream && size > 0) return "unreadable";
  return ToString(DigestOf(bytes.view()));
}

std::string PlaceNow(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_regular_file(status)) return "file";
  if (fs::is_directory(status)) return "folder";
  return fs::exists(status) ? "something" : "nothing";
}

std::string ListingNow(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    names.push_back(it->path().filename().string());
  }
  if (error) return "nothing";
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string& name : names) all.append(name).push_back('\0');
  return ToString(DigestOf(all));
}

}  // namespace

void StartInputLog() {
  const std::lock_guard lock(TheLog().mutex);
  TheLog().states.clear();
  LogIsOn() = true;
}

std::vector<Input> LoggedInputs() {
  const std::lock_guard lock(TheLog().mutex);
  std::vector<Input> inputs;
  for (const auto& [what, state] : TheLog().states) {
    inputs.push_back({what.first, what.second, state});
  }
  return inputs;
}

std::string StateNow(Input::Kind kind, const std::string& name) {
  switch (kind) {
    case Input::Kind::kContent:
      return ContentNow(name);
    case Input::Kind::kPlace:
      return PlaceNow(name);
    case Input::Kind::kListing:
      return ListingNow(name);
    case Input::Kind::kVariable:
      break;
  }
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? "unset" : "=" + std::string(value);
}

void LogContent(const std::string& path, std::string_view bytes) {
  if (LogIsOn()) LogInput(Input::Kind::kContent, path, ToString(DigestOf(bytes)));
}

void LogInput(Input::Kind kind, const std::string& name, std::string state) {
  if (!LogIsOn()) return;
  const std::lock_guard lock(TheLog().mutex);
  const auto [known, is_new] = TheLog().states.try_emplace({kind, name}, state);
  if (!is_new && known->second != state) known->second = kUnsteady;
}

void LogAsItIs(Input::Kind kind, const std::string& name) {
  if (LogIsOn()) LogInput(kind, name, StateNow(kind, name));
}

}  // namespace ncsim
