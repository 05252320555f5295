// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/peer_run.h"

#include "tests/bench/checker_run.h"

namespace ncsim::bench {

PeerRun RunPeer(const BenchJob& job, peers::Arrangement arrangement, double budget_seconds,
                std::size_t at_least) {
  PeerRun run;
  peers::FclWorld world(job.machine, job.scene, job.job.tools.front(), arrangement);
  bool cutting = false;
  ForEachWindow(job, [&](const motion::Window& window) {
    const double begin = ProcessCpuSeconds();
    const double before = run.seconds;
    for (std::size_t i = cutting ? 0 : FirstCut(window); i < window.motions.size(); ++i) {
      cutting = true;
      if (!world.Check(window.motions[i])) break;
      ++run.motions;
      run.seconds = before + ProcessCpuSeconds() - begin;
      if (run.seconds > budget_seconds && run.motions >= at_least) return false;
    }
    return world.contact().empty();
  });
  run.samples = world.samples();
  run.calls = world.calls();
  if (!world.contact().empty()) run.contact = world.contact()[0] + " and " + world.contact()[1];
  return run;
}

}  // namespace ncsim::bench
