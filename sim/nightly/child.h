// SPDX-License-Identifier: BSD-3-Clause
// Another process, run to its end or stopped.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace ncsim::nightly {

/// Starts `command` in `folder`; what it prints goes to the files `out` and `err`. It leads a
/// process group of its own, and is killed (SIGKILL) when the thread that has started it ends,
/// however that comes about; what it starts itself is not. Returns 0, or the errno of what failed.
int StartChild(std::vector<std::string> command, const std::string& folder, const std::string& out,
               const std::string& err, pid_t* pid);

struct ChildRun {
  int exit_code = -1;   ///< -1: it did not come to one.
  std::string trouble;  ///< "was stopped after 600 s", "was killed by signal 11 (...)"; else "".
};

/// Starts a child and waits for its end; nothing of its group is left when this returns. `timeout`
/// in s.
ChildRun RunChild(const std::vector<std::string>& command, const std::string& folder,
                  const std::string& out, const std::string& err, double timeout);

}  // namespace ncsim::nightly
