// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/child.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>

#include "sim/base/text.h"

namespace ncsim::nightly {
namespace {

using Clock = std::chrono::steady_clock;

/// The words of a command as exec takes them. The words must outlive it.
std::vector<char*> Pointers(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

int Spawn(std::vector<std::string> words, const std::string& folder, const std::string& out,
          const std::string& err, pid_t* pid) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), kNew, 0666);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), kNew, 0666);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int failed = posix_spawn(pid, words.front().c_str(), &actions, &attributes,
                                 Pointers(words).data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return failed;
}

}  // namespace

ChildRun RunChild(const std::vector<std::string>& command, const std::string& folder,
                  const std::string& out, const std::string& err, double timeout) {
  ChildRun run;
  pid_t pid = 0;
  if (const int failed = Spawn(command, folder, out, err, &pid); failed != 0) {
    run.trouble = "could not be started: " + std::generic_category().message(failed);
    return run;
  }
  const auto deadline = Clock::now() + std::chrono::duration<double>(timeout);
  siginfo_t ended{};
  // WNOWAIT: while it is not waited for, its number names this group and no other.
  while (waitid(P_PID, static_cast<id_t>(pid), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         ended.si_pid == 0 && Clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const bool late = ended.si_pid == 0;
  kill(-pid, SIGKILL);  // Also what it has started itself.
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (late) {
    run.trouble = "took longer than " + Short(timeout) + " s and was stopped";
  } else if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    run.trouble = "crashed: signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
  } else {
    run.exit_code = WEXITSTATUS(status);
  }
  return run;
}

}  // namespace ncsim::nightly
