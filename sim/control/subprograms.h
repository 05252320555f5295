// SPDX-License-Identifier: BSD-3-Clause
// Where the control finds the subprograms that a program calls (Haas NGC Mill Operator's Manual
// 2017, "M98 Subprogram Call", "Setting Up Search Locations").
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/finding.h"
#include "sim/control/program_files.h"
#include "sim/nc/program.h"
#include "sim/nc/program_index.h"

namespace ncsim::control {

struct Subprogram {
  ProgramText* text = nullptr;  ///< Null: not found.
  nc::TextPosition begin;
};

class Subprograms {
 public:
  /// `folders` are searched after the main program's own.
  Subprograms(std::shared_ptr<const nc::Program> main, const std::vector<std::string>& folders,
              SourceFiles* files)
      : files_(std::move(main), folders, files) {}

  ProgramText& main() { return files_.main(); }
  /// O program `number`: in the calling text, in the main program's, then as a file of its own
  /// (O01234.nc, O1234.nc, 01234.nc, ... in the search folders).
  Subprogram Find(long number, ProgramText& caller);
  /// `M98 (USB0/O00001.nc)`: the path under a search folder, with or without its leading folders,
  /// which are the control's own devices.
  Subprogram FindPath(std::string_view path);
  /// "part's folder, 'subs'": for messages.
  std::string Places() const { return files_.Places(); }
  /// Why the last Find found nothing, if it is not just absence; else "".
  const std::string& error() const { return files_.error(); }

 private:
  Subprogram FindFile(const std::vector<std::string>& names);

  ProgramFiles files_;
  std::map<long, Subprogram> by_number_;  ///< Files only.
  std::map<std::string, Subprogram, std::less<>> by_name_;
};

}  // namespace ncsim::control
