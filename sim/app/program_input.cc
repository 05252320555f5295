// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/program_input.h"

#include <filesystem>

#include "sim/app/program_dir.h"
#include "sim/base/file.h"
#include "sim/machine/load.h"

namespace ncsim::app {

namespace fs = std::filesystem;

std::optional<std::string> JobPath(const std::string& program, const std::string& named,
                                   std::string* complaint) {
  if (!named.empty()) return named;
  const std::string appended = program + ".job.toml";
  const std::string replaced = fs::path(program).replace_extension(".job.toml").string();
  const bool has_appended = IsThere(appended);
  const bool has_replaced = IsThere(replaced);
  if (has_appended && has_replaced && appended != replaced) {
    *complaint = program + ": error: both " + appended + " and " + replaced +
                 " are there; name one of them with --job";
    return std::nullopt;
  }
  return has_replaced ? replaced : has_appended ? appended : "";
}

std::optional<std::string> ModelPath(const std::string& program, const std::string& named,
                                     const machine::Job& job, std::string* complaint) {
  const std::string& wanted = named.empty() ? job.model : named;
  if (wanted.empty()) {
    *complaint = program +
                 ": error: no machine is named: --model umc750.urdf, or model = "
                 "\"umc750.urdf\" in the job";
    return std::nullopt;
  }
  const fs::path beside = fs::path(job.path).parent_path() / wanted;
  if (named.empty() && IsFile(beside.string())) return beside.string();
  std::string path = machine::FindModel(wanted, ProgramDir());
  if (!path.empty()) return path;
  *complaint = program + ": error: there is no model '" + wanted +
               "': not a file, and not in $NCSIM_MODELS or among the models that ship";
  return std::nullopt;
}

const nc::Program* SourceLines::Find(int file) {
  auto found = programs_.find(file);
  if (found == programs_.end()) {
    Diagnostics ignored;  // The control has read the file and reported what is wrong with it.
    found = programs_.emplace(file, nc::Program::Load(files_->name(file), &ignored)).first;
  }
  return found->second.get();
}

std::string_view SourceLines::operator()(int file, int line) {
  const nc::Program* program = Find(file);
  return program == nullptr ? "" : program->LineByNumber(line);
}

std::string_view SourceLines::Text(int file) {
  const nc::Program* program = Find(file);
  return program == nullptr ? "" : program->text();
}

}  // namespace ncsim::app
