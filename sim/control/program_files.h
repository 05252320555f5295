// SPDX-License-Identifier: BSD-3-Clause
// The texts of a run, each loaded once, and the folders that a control looks for subprograms in.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/finding.h"
#include "sim/nc/program.h"
#include "sim/nc/program_index.h"
#include "sim/nc/sinumerik_index.h"

namespace ncsim::control {

/// A loaded text. An index is built at its first use, in the language that asks for it.
struct ProgramText {
  std::shared_ptr<const nc::Program> program;
  int file = 0;  ///< Index into SourceFiles.

  const nc::ProgramIndex& index();
  const nc::SinumerikIndex& sinumerik_index();

 private:
  std::unique_ptr<nc::ProgramIndex> index_;
  std::unique_ptr<nc::SinumerikIndex> sinumerik_index_;
};

class ProgramFiles {
 public:
  /// `folders` are searched after the main program's own.
  ProgramFiles(std::shared_ptr<const nc::Program> main, const std::vector<std::string>& folders,
               SourceFiles* files);

  ProgramText& main() { return *texts_.front(); }
  /// "" or with a '/' at the end.
  const std::vector<std::string>& folders() const { return folders_; }
  /// Null: not readable, and error() says why at the first attempt.
  ProgramText* Load(const std::string& path);
  /// "part's folder, 'subs'": for messages.
  std::string Places() const;
  /// Why the last search found nothing, if it is not just absence; else "".
  const std::string& error() const { return error_; }
  void ClearError() { error_.clear(); }

 private:
  std::vector<std::unique_ptr<ProgramText>> texts_;  ///< The main program's first.
  std::map<std::string, ProgramText*> by_path_;      ///< Null: tried, and not readable.
  std::vector<std::string> folders_;
  SourceFiles* files_;
  std::string error_;
};

}  // namespace ncsim::control
