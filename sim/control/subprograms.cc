// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/subprograms.h"

#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "sim/base/diagnostics.h"

namespace ncsim::control {
namespace {

constexpr std::array<std::string_view, 4> kExtensions = {"", ".nc", ".NC", ".txt"};

bool IsFile(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

std::string FolderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

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

const nc::ProgramIndex& ProgramText::index() {
  if (!index_) index_ = std::make_unique<nc::ProgramIndex>(*program);
  return *index_;
}

Subprograms::Subprograms(std::shared_ptr<const nc::Program> main,
                         const std::vector<std::string>& folders, SourceFiles* files)
    : files_(files) {
  auto text = std::make_unique<ProgramText>();
  text->program = std::move(main);
  text->file = files_->Add(text->program->name());
  folders_.push_back(FolderOf(text->program->name()));
  for (const std::string& folder : folders) {
    folders_.push_back(folder.empty() || folder.back() == '/' ? folder : folder + '/');
  }
  texts_.push_back(std::move(text));
}

Subprogram Subprograms::Find(long number, ProgramText& caller) {
  error_.clear();
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
  error_.clear();
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
  for (const std::string& folder : folders_) {
    for (const std::string& name : names) {
      for (const std::string_view extension : kExtensions) {
        std::string path = folder;
        path += name;
        path += extension;
        if (!IsFile(path)) continue;
        ProgramText* text = Load(path);
        if (text == nullptr) return {};
        return {text, text->index().programs().front().begin};
      }
    }
  }
  return {};
}

ProgramText* Subprograms::Load(const std::string& path) {
  const auto known = by_path_.find(path);
  if (known != by_path_.end()) return known->second;
  Diagnostics diagnostics;
  auto program = nc::Program::Load(path, &diagnostics);
  ProgramText* text = nullptr;
  if (program == nullptr) {
    error_ = path + " " + (diagnostics.all().empty() ? "" : diagnostics.all().front().message);
  } else {
    texts_.push_back(std::make_unique<ProgramText>());
    text = texts_.back().get();
    text->program = std::move(program);
    text->file = files_->Add(path);
  }
  by_path_.emplace(path, text);
  return text;
}

std::string Subprograms::Places() const {
  std::string text;
  for (const std::string& folder : folders_) {
    if (!text.empty()) text += ", ";
    text += folder.empty() ? "./" : folder;
  }
  return text;
}

}  // namespace ncsim::control
