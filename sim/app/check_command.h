// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "sim/app/options.h"

namespace ncsim::app {

/// `ncsim check`: all programs, in the order of the command line whatever --jobs is. Returns an
/// ExitCode.
int Check(const CheckOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ncsim::app
