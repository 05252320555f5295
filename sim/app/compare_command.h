// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "sim/app/options.h"

namespace ncsim::app {

/// `ncsim compare A B`: do two programs describe the same motion of the tool in the part? Returns
/// an ExitCode.
int Compare(const CompareOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ncsim::app
