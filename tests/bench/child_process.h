// SPDX-License-Identifier: BSD-3-Clause
// Another program, run to its end: what it took.
#pragma once

#include <string>
#include <vector>

namespace ncsim::bench {

struct ChildRun {
  int exit_code = -1;  ///< -1: it did not run, or was killed.
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;
  double peak_mb = 0.0;          ///< Resident, with files that it maps (VmHWM).
  double peak_private_mb = 0.0;  ///< Resident and its own (RssAnon), seen every 10 ms.
};

/// Output goes to /dev/null.
ChildRun RunChild(const std::vector<std::string>& command);

}  // namespace ncsim::bench
