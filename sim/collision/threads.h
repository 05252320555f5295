// SPDX-License-Identifier: BSD-3-Clause
// How many threads check collisions; what they find does not depend on it.
#pragma once

#include <memory>

namespace ncsim::collision {

/// As many as the processors that this process may use.
int DefaultThreads();

/// While it lives, a program that is checked keeps to `count` threads, its own among them. Of
/// several limits the least holds.
class ThreadLimit {
 public:
  explicit ThreadLimit(int count);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

/// Is there no thread but the one that asks?
bool OnlyOneThread();

}  // namespace ncsim::collision
