// SPDX-License-Identifier: BSD-3-Clause
// Another process, run to its end or stopped.
#pragma once

#include <string>
#include <vector>

namespace ncsim::nightly {

struct ChildRun {
  int exit_code = -1;   ///< -1: it did not come to one.
  std::string trouble;  ///< "was stopped after 600 s", "was killed by signal 11 (...)"; else "".
};

/// Runs `command` in `folder`; what it prints goes to the files `out` and `err`. It leads a process
/// group of its own, of which nothing is left when this returns. `timeout` in s.
ChildRun RunChild(const std::vector<std::string>& command, const std::string& folder,
                  const std::string& out, const std::string& err, double timeout);

}  // namespace ncsim::nightly
