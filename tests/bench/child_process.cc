// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/child_process.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "tests/support/start_child.h"

namespace ncsim::bench {
namespace {

/// A field of /proc/PID/status in MB; 0 where it is not (the process has ended).
void ReadStatus(pid_t pid, ChildRun* run) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/status");
  for (std::string key; in >> key;) {
    double kilobytes = 0.0;
    if (key == "VmHWM:" && in >> kilobytes) run->peak_mb = std::max(run->peak_mb, kilobytes / 1024);
    if (key == "RssAnon:" && in >> kilobytes) {
      run->peak_private_mb = std::max(run->peak_private_mb, kilobytes / 1024);
    }
  }
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildRun RunChild(const std::vector<std::string>& command) {
  ChildRun run;
  const auto begin = std::chrono::steady_clock::now();
  const pid_t pid = StartChild(command);
  if (pid < 0) return run;
  rusage usage{};
  int status = 0;
  while (wait4(pid, &status, WNOHANG, &usage) == 0) {
    ReadStatus(pid, &run);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  run.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.cpu_seconds = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  return run;
}

}  // namespace ncsim::bench
