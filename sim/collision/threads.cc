// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/threads.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <cstddef>

namespace ncsim::collision {

using oneapi::tbb::global_control;

struct ThreadLimit::Control {
  global_control control;
};

int DefaultThreads() { return oneapi::tbb::info::default_concurrency(); }

ThreadLimit::ThreadLimit(int count)
    : control_(new Control{global_control(global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(count))}) {}

ThreadLimit::~ThreadLimit() = default;

bool OnlyOneThread() {
  return global_control::active_value(global_control::max_allowed_parallelism) <= 1;
}

}  // namespace ncsim::collision
