// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "sim/base/finding.h"

namespace ncsim::app {

/// Exit codes of every command. Scripts rely on them.
enum ExitCode {
  kExitPass = 0,
  kExitFail = 1,
  kExitUnproven = 2,
  kExitBadInput = 3,  ///< Or bad usage.
  kExitInternalError = 4,
};

/// Of a verdict.
ExitCode ExitOf(Verdict verdict);

/// Runs a command; `args` without the program's name. Reports go to `out`, trouble to `err`.
/// Throws nothing; returns an ExitCode.
int Run(std::vector<std::string> args, std::ostream& out, std::ostream& err);

/// The exit code of several programs: the first present of 4, 3, 1, 2, 0.
int CombinedExit(const std::vector<int>& codes);

}  // namespace ncsim::app
