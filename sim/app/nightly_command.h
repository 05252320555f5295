// SPDX-License-Identifier: BSD-3-Clause
// `ncsim nightly`: many programs, one table, history.
#pragma once

#include <ostream>

#include "sim/app/options.h"

namespace ncsim::app {

/// Returns an ExitCode: of a night, that of its verdicts after the baseline; of a shard 0 when it
/// has left its file, whatever the verdicts are.
int Nightly(const NightlyOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ncsim::app
