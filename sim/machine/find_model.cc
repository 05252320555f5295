// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <string>
#include <vector>

#include "sim/base/file.h"
#include "sim/machine/load.h"

namespace ncsim::machine {
namespace {

namespace fs = std::filesystem;

std::string FileOrEmpty(const fs::path& path) { return IsFile(path.string()) ? path.string() : ""; }

std::string FindIn(const fs::path& folder, const std::string& name) {
  const std::string with_extension = name + ".urdf";
  for (const std::string& candidate : {name, with_extension}) {
    const std::string found = FileOrEmpty(folder / candidate);
    if (!found.empty()) return found;
  }
  for (const std::string& child : NamesIn(folder.string())) {
    for (const std::string& candidate : {name, with_extension}) {
      if (!candidate.ends_with(".urdf")) continue;
      const std::string found = FileOrEmpty(folder / child / candidate);
      if (!found.empty()) return found;
    }
  }
  return "";
}

}  // namespace

std::string FindModel(const std::string& name, const std::string& program_dir) {
  if (name.empty()) return "";
  const std::string direct = FileOrEmpty(name);
  if (!direct.empty()) return direct;
  std::vector<std::string> folders;
  if (const auto list = EnvironmentVariable("NCSIM_MODELS")) {
    std::string rest = *list;
    while (!rest.empty()) {
      const std::size_t colon = rest.find(':');
      folders.push_back(rest.substr(0, colon));
      rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
    }
  }
  folders.push_back((fs::path(program_dir) / ".." / "share" / "ncsim" / "models").string());
  folders.push_back(NCSIM_SOURCE_MODELS);
  for (const std::string& folder : folders) {
    if (folder.empty()) continue;
    const std::string found = FindIn(folder, name);
    if (!found.empty()) return found;
  }
  return "";
}

}  // namespace ncsim::machine
