// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/start_child.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

namespace ncsim {

pid_t StartChild(std::vector<std::string> command, const std::map<int, int>& descriptors) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int own : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, own, "/dev/null", O_RDWR, 0);
  }
  // By way of numbers that are none of its own, so that none is overwritten before it is copied.
  std::vector<int> between;
  for (const auto& [own, ours] : descriptors) {
    between.push_back(fcntl(ours, F_DUPFD_CLOEXEC, 10));
    posix_spawn_file_actions_adddup2(&actions, between.back(), own);
  }
  pid_t pid = -1;
  const int failed = posix_spawn(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  for (const int fd : between) close(fd);
  return failed == 0 ? pid : -1;
}

}  // namespace ncsim
