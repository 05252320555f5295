// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/bench_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/bench/checker_run.h"
#include "tests/bench/child_process.h"
#include "tests/bench/peer_run.h"

namespace ncsim::bench {
namespace {

bool Complain(const collision::CollisionResult& result) {
  for (std::size_t i = 0; i < std::min<std::size_t>(10, result.findings.size()); ++i) {
    const Finding& finding = result.findings[i];
    std::printf("UNEXPECTED: line %d: %s\n", finding.where.line, finding.message.c_str());
  }
  std::fflush(stdout);
  return result.findings.empty();
}

constexpr const char* kSamplingHead =
    "| | first blocks | us/block | blocks/s | poses/block | calls/block | us/call "
    "| checker is faster by, same blocks | by, whole program |\n"
    "|---|---|---|---|---|---|---|---|---|\n";

bool PrintSamplingRow(const char* name, const PeerRun& peer, const CheckerRun& same,
                      const CheckerRun& whole) {
  const double n = static_cast<double>(peer.motions);
  const double us = 1e6 * peer.seconds / n;
  std::printf("| %s | %zu | %.1f | %.0f | %.1f | %.1f | %.2f | %.1f | %.1f |\n", name, peer.motions,
              us, 1e6 / us, static_cast<double>(peer.samples) / n,
              static_cast<double>(peer.calls) / n,
              1e6 * peer.seconds / static_cast<double>(peer.calls),
              us / same.microseconds_per_motion(), us / whole.microseconds_per_motion());
  if (!peer.contact.empty()) std::printf("UNEXPECTED: contact of %s\n", peer.contact.c_str());
  std::fflush(stdout);
  return peer.contact.empty();
}

void PrintCheckerRow(const char* name, const CheckerRun& run, const CheckerRun& same,
                     const CheckerRun& whole) {
  const double us = run.microseconds_per_motion();
  const double queries = static_cast<double>(run.result.queries);
  std::printf("| %s | %zu | %.2f | %.0f | - | %.3f | %.2f | %.1f | %.1f |\n", name, run.motions, us,
              run.motions_per_second(), queries / static_cast<double>(run.motions),
              1e6 * run.seconds / queries, us / same.microseconds_per_motion(),
              us / whole.microseconds_per_motion());
  std::fflush(stdout);
}

}  // namespace

bool PrintChecker(const BenchJob& job, const ImpellerSpec& spec) {
  const CheckerRun run = RunChecker(job, static_cast<std::size_t>(spec.blocks));
  const double queries = static_cast<double>(run.result.queries);
  std::printf(
      "| checker | blocks | us/block | blocks/s | queries/block | us/query | setup s |\n"
      "|---|---|---|---|---|---|---|\n"
      "| certified | %zu | %.2f | %.0f | %.3f | %.2f | %.2f |\n",
      run.motions, run.microseconds_per_motion(), run.motions_per_second(),
      queries / static_cast<double>(run.motions), 1e6 * run.seconds / queries, run.setup_seconds);
  return Complain(run.result);
}

bool PrintPairs(const BenchJob& job, const ImpellerSpec& spec) {
  std::printf(
      "| pair | us/block | queries/block | us/query | proven mm | seen mm |\n"
      "|---|---|---|---|---|---|\n");
  double seconds = 0.0;
  const double n = spec.blocks;
  for (const PairRun& run : RunPairs(job, static_cast<std::size_t>(spec.blocks))) {
    const double queries = static_cast<double>(run.queries);
    seconds += run.seconds;
    std::printf("| %s | %.3f | %.4f | %.1f | %.2f | %.2f |\n", run.names.c_str(),
                1e6 * run.seconds / n, queries / n, 1e6 * run.seconds / queries, run.proven_mm,
                run.seen_mm);
  }
  std::printf("| all | %.2f | | | | |\n", 1e6 * seconds / n);
  std::fflush(stdout);
  return true;
}

bool PrintPeers(const BenchJob& job, const ImpellerSpec& spec, double budget_seconds) {
  struct Peer {
    peers::Arrangement arrangement;
    const char* name;
  };
  const Peer all[] = {{peers::Arrangement::kPlain, "FCL collide, tool as cylinders, every pair"},
                      {peers::Arrangement::kBest, "FCL collide, tool as meshes, AABB trees"}};
  const CheckerRun whole = RunChecker(job, static_cast<std::size_t>(spec.blocks));
  std::printf("%s", kSamplingHead);
  bool clear = Complain(whole.result);
  for (const Peer& peer : all) {
    const PeerRun run = RunPeer(job, peer.arrangement, budget_seconds, 60);
    clear =
        PrintSamplingRow(peer.name, run, RunChecker(job, run.motions, Approach::kUntimed), whole) &&
        clear;
  }
  const std::size_t tenth = static_cast<std::size_t>(spec.blocks) / 10;
  const CheckerRun fcl = RunChecker(WithToolAsMeshes(job), tenth, Approach::kUntimed);
  PrintCheckerRow("certified, shank and holder by FCL too", fcl,
                  RunChecker(job, tenth, Approach::kUntimed), whole);
  PrintCheckerRow("**certified**", whole, whole, whole);
  return clear;
}

bool PrintDistances(const BenchJob& job, double budget_seconds) {
  const PeerRun run = RunPeer(job, peers::Arrangement::kDistance, budget_seconds, 1);
  const CheckerRun same = RunChecker(job, run.motions, Approach::kUntimed);
  std::printf("%s", kSamplingHead);
  return PrintSamplingRow("FCL distance, tool as meshes, every pair", run, same, same);
}

bool PrintText(const std::string& ncsim, const ImpellerSpec& spec, const std::string& folder,
               const std::vector<TextRun>& runs) {
  std::printf(
      "| blocks | jobs | wall s | CPU s | blocks/s of wall time | blocks/s of CPU time "
      "| peak MB | of it private | exit code |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  bool passed = true;
  ChildRun first;
  for (const TextRun& text : runs) {
    ImpellerSpec longer = spec;
    longer.blocks = text.blocks;
    const auto job = MakeImpellerJob(longer, folder);
    if (!job) return false;
    const ChildRun run = RunChild(
        {ncsim, "check", job->program, "--assume", "all", "--jobs", std::to_string(text.jobs)});
    std::printf("| %d | %d | %.2f | %.2f | %.0f | %.0f | %.0f | %.0f | %d |\n", text.blocks,
                text.jobs, run.wall_seconds, run.cpu_seconds, text.blocks / run.wall_seconds,
                text.blocks / run.cpu_seconds, run.peak_mb, run.peak_private_mb, run.exit_code);
    const int more = text.blocks - runs.front().blocks;
    if (more > 0) {
      std::printf("| the further %d | %d | | | %.0f | %.0f | | | |\n", more, text.jobs,
                  more / (run.wall_seconds - first.wall_seconds),
                  more / (run.cpu_seconds - first.cpu_seconds));
    } else {
      first = run;
    }
    std::fflush(stdout);
    passed = passed && run.exit_code == 0;
  }
  return passed;
}

}  // namespace ncsim::bench
