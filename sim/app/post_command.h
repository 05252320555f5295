// SPDX-License-Identifier: BSD-3-Clause
// `ncsim post`: post proposes, check judges.
#pragma once

#include <ostream>

#include "sim/app/options.h"

namespace ncsim::app {

/// Writes the program and says what check found; returns an exit code: of check's verdict, unproven
/// where no job says where the part stands, pass with --no-check. What cannot be posted is bad
/// input, and then nothing is written.
int Post(const PostCommandOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ncsim::app
