// SPDX-License-Identifier: BSD-3-Clause
// Another program, started beside a test or a benchmark.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

namespace ncsim {

/// Starts the program whose path is the first word; whoever calls waits for its end. It reads and
/// writes /dev/null, but what `descriptors` says: its own numbers, and the open files of this
/// process that lie there. Nothing else of this process that is closed by exec comes with it. -1
/// where it does not start.
pid_t StartChild(std::vector<std::string> command, const std::map<int, int>& descriptors = {});

}  // namespace ncsim
