// SPDX-License-Identifier: BSD-3-Clause
// Where the control finds the subprograms that a SINUMERIK program calls: in the calling text and
// the main program's (archives have several), then as files of the search folders.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/control/program_files.h"

namespace ncsim::control {

struct SinumerikProgram {
  ProgramText* text = nullptr;  ///< Null: not found.
  nc::TextPosition begin;
};

class SinumerikPrograms {
 public:
  SinumerikPrograms(std::shared_ptr<const nc::Program> main,
                    const std::vector<std::string>& folders, SourceFiles* files)
      : files_(std::move(main), folders, files) {}

  ProgramText& main() { return files_.main(); }
  /// `name` as a call has it: SHAFT, _N_SHAFT_SPF, /_N_WKS_DIR/_N_SHAFT_WPD/SHAFT, "A/B.SPF". Of a
  /// path only the last part counts: the folders before it are the control's own.
  SinumerikProgram Find(std::string_view name, ProgramText& caller);
  /// Where was looked, or why what was found could not be read: for messages.
  std::string Where() const;

 private:
  SinumerikProgram FindFile(const std::string& name);
  const std::map<std::string, std::string>& FilesOf(const std::string& folder);

  ProgramFiles files_;
  std::map<std::string, SinumerikProgram, std::less<>> by_name_;
  /// Of each folder, the names of its files in upper case and as they are.
  std::map<std::string, std::map<std::string, std::string>> listings_;
};

}  // namespace ncsim::control
