// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_programs.h"

#include <array>

#include "sim/base/file.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

constexpr std::size_t kMaxListing = 100'000;

/// "SHAFT" of "/_N_WKS_DIR/_N_SHAFT_SPF" (prefix and suffix are the control's own).
std::string PlainName(std::string_view name) {
  const std::size_t slash = name.find_last_of("/\\:");
  if (slash != std::string_view::npos) name.remove_prefix(slash + 1);
  std::string plain = nc::UpperName(name);
  if (plain.rfind("_N_", 0) == 0) plain.erase(0, 3);
  for (const std::string_view suffix : {"_SPF", "_MPF", ".SPF", ".MPF"}) {
    if (plain.size() > suffix.size() && plain.ends_with(suffix)) {
      plain.erase(plain.size() - suffix.size());
      break;
    }
  }
  return plain;
}

}  // namespace

SinumerikProgram SinumerikPrograms::Find(std::string_view name, ProgramText& caller) {
  files_.ClearError();
  const std::string plain = PlainName(name);
  if (plain.empty()) return {};
  for (ProgramText* text : {&caller, &main()}) {
    if (const nc::SinumerikSection* section = text->sinumerik_index().Find(plain)) {
      return {text, section->begin};
    }
  }
  const auto known = by_name_.find(plain);
  if (known != by_name_.end()) return known->second;
  const SinumerikProgram found = FindFile(plain);
  by_name_.emplace(plain, found);
  return found;
}

SinumerikProgram SinumerikPrograms::FindFile(const std::string& name) {
  const std::array<std::string, 7> candidates = {
      name + ".SPF", name + ".MPF", "_N_" + name + "_SPF", "_N_" + name + "_MPF", name + "_SPF",
      name + "_MPF", name};
  for (const std::string& folder : files_.folders()) {
    const std::map<std::string, std::string>& listing = FilesOf(folder);
    for (const std::string& candidate : candidates) {
      const auto file = listing.find(candidate);
      if (file == listing.end()) continue;
      ProgramText* text = files_.Load(folder + file->second);
      if (text == nullptr) return {};
      const nc::SinumerikIndex& index = text->sinumerik_index();
      const nc::SinumerikSection* section = index.Find(name);
      return {text, section != nullptr ? section->begin : index.sections().front().begin};
    }
  }
  return {};
}

const std::map<std::string, std::string>& SinumerikPrograms::FilesOf(const std::string& folder) {
  const auto [place, added] = listings_.emplace(folder, std::map<std::string, std::string>());
  if (!added) return place->second;
  // Of names that differ in case alone, the first in the order of bytes.
  for (const std::string& file : NamesIn(folder.empty() ? "." : folder)) {
    if (place->second.size() >= kMaxListing) break;
    place->second.emplace(nc::UpperName(file), file);
  }
  return place->second;
}

std::string SinumerikPrograms::Where() const {
  if (!files_.error().empty()) return files_.error();
  return "it stands neither in the program's own file nor in " + files_.Places();
}

}  // namespace ncsim::control
