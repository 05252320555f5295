// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/subprograms.h"

#include <array>

#include "sim/base/file.h"

namespace ncsim::control {
namespace {

constexpr std::array<std::string_view, 4> kExtensions = {"", ".nc", ".NC", ".txt"};

/// O01234, O1234, o01234, ..., 01234, 1234: with and without leading zeros.
std::vector<std::string> NamesOf(long number) {
  const std::string plain = std::to_string(number);
  std::vector<std::string> names;
  for (const std::string_view prefix : {"O", "o", ""}) {
    for (std::size_t width = 5; width >= 4; --width) {
      if (plain.size() < width) {
        names.push_back(std::string(prefix) + std::string(width - plain.size(), '0') + plain);
      }
    }
    names.push_back(std::string(prefix) + plain);
  }
  return names;
}

}  // namespace

Subprogram Subprograms::Find(long number, ProgramText& caller) {
  files_.ClearError();
  for (ProgramText* text : {&caller, &main()}) {
    if (const nc::ProgramRange* range = text->index().FindProgram(number)) {
      return {text, range->begin};
    }
  }
  const auto known = by_number_.find(number);
  if (known != by_number_.end()) return known->second;
  Subprogram found = FindFile(NamesOf(number));
  if (found.text != nullptr) {
    const nc::ProgramRange* range = found.text->index().FindProgram(number);
    if (range != nullptr) found.begin = range->begin;
  }
  by_number_.emplace(number, found);
  return found;
}

Subprogram Subprograms::FindPath(std::string_view path) {
  files_.ClearError();
  const auto known = by_name_.find(path);
  if (known != by_name_.end()) return known->second;
  std::vector<std::string> names;
  if (path.find("..") == std::string_view::npos) {
    std::string_view rest = path;
    while (true) {
      while (!rest.empty() && rest.front() == '/') rest.remove_prefix(1);
      if (rest.empty()) break;
      names.emplace_back(rest);
      const std::size_t slash = rest.find('/');
      if (slash == std::string_view::npos) break;
      rest.remove_prefix(slash);
    }
  }
  const Subprogram found = FindFile(names);
  by_name_.emplace(std::string(path), found);
  return found;
}

Subprogram Subprograms::FindFile(const std::vector<std::string>& names) {
  for (const std::string& folder : files_.folders()) {
    for (const std::string& name : names) {
      for (const std::string_view extension : kExtensions) {
        std::string path = folder;
        path += name;
        path += extension;
        if (!IsFile(path)) continue;
        ProgramText* text = files_.Load(path);
        if (text == nullptr) return {};
        return {text, text->index().programs().front().begin};
      }
    }
  }
  return {};
}

}  // namespace ncsim::control
