// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/child.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>

#include "sim/base/text.h"

namespace ncsim::nightly {
namespace {

using Clock = std::chrono::steady_clock;

/// What the child needs between fork and exec, where nothing may be allocated.
struct Start {
  std::vector<char*> words;
  const char *folder, *out, *err;
  pid_t parent;
  int answer;  ///< Takes the errno of what failed; closed by exec.
};

bool Redirect(const char* path, int flags, int to) {
  const int from = open(path, flags, 0666);
  if (from < 0 || from == to) return from == to;
  return dup2(from, to) == to && close(from) == 0;
}

/// In the child. Other threads of the parent may have held any lock: system calls only.
[[noreturn]] void Become(const Start& start) {
  constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
  // Whoever kills the parent, and however, kills the child; but for a parent that is dead already.
  const bool bound = prctl(PR_SET_PDEATHSIG, SIGKILL) == 0;
  if (bound && getppid() != start.parent) _exit(127);
  if (bound && setpgid(0, 0) == 0 && Redirect("/dev/null", O_RDONLY, STDIN_FILENO) &&
      Redirect(start.out, kNew, STDOUT_FILENO) && Redirect(start.err, kNew, STDERR_FILENO) &&
      chdir(start.folder) == 0) {
    execv(start.words.front(), start.words.data());
  }
  const int failed = errno;
  _exit(write(start.answer, &failed, sizeof failed) > 0 ? 127 : 126);
}

}  // namespace

int StartChild(std::vector<std::string> command, const std::string& folder, const std::string& out,
               const std::string& err, pid_t* pid) {
  std::array<int, 2> answer{};
  if (pipe2(answer.data(), O_CLOEXEC) != 0) return errno;
  Start start{{}, folder.c_str(), out.c_str(), err.c_str(), getpid(), answer[1]};
  for (std::string& word : command) start.words.push_back(word.data());
  start.words.push_back(nullptr);
  *pid = fork();
  int failed = *pid < 0 ? errno : 0;
  if (*pid == 0) Become(start);
  close(answer[1]);
  // Nothing comes where exec has closed the other end.
  if (*pid > 0 && read(answer[0], &failed, sizeof failed) > 0) waitpid(*pid, nullptr, 0);
  close(answer[0]);
  return failed;
}

ChildRun RunChild(const std::vector<std::string>& command, const std::string& folder,
                  const std::string& out, const std::string& err, double timeout) {
  ChildRun run;
  pid_t pid = 0;
  if (const int failed = StartChild(command, folder, out, err, &pid); failed != 0) {
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
