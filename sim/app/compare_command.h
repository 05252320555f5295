// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "sim/app/options.h"
#include "sim/nc/program.h"

namespace ncsim::app {

/// `ncsim compare A B`: do two programs describe the same motion of the tool in the part? Returns
/// an ExitCode.
int Compare(const CompareOptions& options, std::ostream& out, std::ostream& err);

struct HeldTogether {
  int exit_code = 0;
  std::string text;  ///< How near they are in a line; of what does not pass, the report. "" where
                     ///< one of them cannot be read.
};
/// The same for a program B that is in no file yet.
HeldTogether CompareText(const CompareOptions& options, std::shared_ptr<const nc::Program> tested,
                         std::ostream& err);

}  // namespace ncsim::app
