// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/program_files.h"

#include <utility>

#include "sim/base/diagnostics.h"

namespace ncsim::control {
namespace {

std::string FolderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

}  // namespace

const nc::ProgramIndex& ProgramText::index() {
  if (!index_) index_ = std::make_unique<nc::ProgramIndex>(*program);
  return *index_;
}

const nc::SinumerikIndex& ProgramText::sinumerik_index() {
  if (!sinumerik_index_) sinumerik_index_ = std::make_unique<nc::SinumerikIndex>(*program);
  return *sinumerik_index_;
}

ProgramFiles::ProgramFiles(std::shared_ptr<const nc::Program> main,
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

ProgramText* ProgramFiles::Load(const std::string& path) {
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

std::string ProgramFiles::Places() const {
  std::string text;
  for (const std::string& folder : folders_) {
    if (!text.empty()) text += ", ";
    text += folder.empty() ? "./" : folder;
  }
  return text;
}

}  // namespace ncsim::control
