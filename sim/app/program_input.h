// SPDX-License-Identifier: BSD-3-Clause
// What a program needs besides its text, and where it is found: job, model, source lines.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/base/finding.h"
#include "sim/machine/job.h"
#include "sim/nc/program.h"

namespace ncsim::app {

/// Path of the job: the one named, else PROGRAM.job.toml (part.nc.job.toml or part.job.toml); ""
/// for none. nullopt, and a complaint, where both are there.
std::optional<std::string> JobPath(const std::string& program, const std::string& named,
                                   std::string* complaint);

/// Path of the model: the one named, else the job's. nullopt, and a complaint, where there is none.
std::optional<std::string> ModelPath(const std::string& program, const std::string& named,
                                     const machine::Job& job, std::string* complaint);

/// Source lines for carets, of the programs and of the subprogram files that they call.
class SourceLines {
 public:
  /// `files` outlives this.
  explicit SourceLines(const SourceFiles& files) : files_(&files) {}
  /// The text of a file that has been read.
  void Know(int file, std::shared_ptr<const nc::Program> program) {
    programs_[file] = std::move(program);
  }
  std::string_view operator()(int file, int line);
  /// All of a file; empty where it cannot be read.
  std::string_view Text(int file);

 private:
  const nc::Program* Find(int file);

  const SourceFiles* files_;
  std::map<int, std::shared_ptr<const nc::Program>> programs_;
};

}  // namespace ncsim::app
