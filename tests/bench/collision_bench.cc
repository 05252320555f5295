// SPDX-License-Identifier: BSD-3-Clause
// Collision checking of one impeller-like five-axis program: the certified checker beside FCL
// sampling, in one run on one core. `--help` lists what can be asked; docs/performance.md has the
// results.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "tests/bench/checker_run.h"
#include "tests/bench/impeller_job.h"

namespace {

using namespace ncsim;

constexpr const char* kUsage =
    "ncsim_collision_bench [--blocks N] [--triangles N] [--studs N] [--clearance MM]\n"
    "    [--allowance MM] [--only SECTION]... [--keep FOLDER]\n"
    "  SECTION: ours (default), pairs (what each pair costs)\n";

struct Options {
  bench::ImpellerSpec spec;
  std::vector<std::string> only;
  std::string keep;  // folder for the job's files
};

bool Parse(int argc, char** argv, Options* options) {
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (i + 1 >= argc) return false;
    const char* value = argv[++i];
    if (key == "--blocks") {
      options->spec.blocks = std::atoi(value);
    } else if (key == "--triangles") {
      options->spec.triangles = std::atoi(value);
    } else if (key == "--studs") {
      options->spec.studs = std::atoi(value);
    } else if (key == "--clearance") {
      options->spec.clearance = std::atof(value);
    } else if (key == "--allowance") {
      options->spec.allowance = std::atof(value);
    } else if (key == "--only") {
      options->only.emplace_back(value);
    } else if (key == "--keep") {
      options->keep = value;
    } else {
      return false;
    }
  }
  return true;
}

void Ours(const bench::BenchJob& job, int blocks) {
  const bench::CheckerRun run = bench::RunChecker(job, static_cast<std::size_t>(blocks));
  const double queries = static_cast<double>(run.result.queries);
  std::printf(
      "checker: %zu motions, %zu findings, setup %.2f s, %.3f s of CPU time\n"
      "  %.0f blocks/s, %.2f us/block, %.3f queries/block, %.2f us/query\n",
      run.motions, run.result.findings.size(), run.setup_seconds, run.seconds,
      run.motions_per_second(), run.microseconds_per_motion(),
      queries / static_cast<double>(run.motions), 1e6 * run.seconds / queries);
  for (std::size_t i = 0; i < run.result.findings.size() && i < 10; ++i) {
    const Finding& finding = run.result.findings[i];
    std::printf("  line %d: %s\n", finding.where.line, finding.message.c_str());
  }
}

void Pairs(const bench::BenchJob& job, int blocks) {
  std::printf(
      "| pair | us/block | queries/block | us/query | proven mm | seen mm |\n"
      "|---|---|---|---|---|---|\n");
  double seconds = 0.0;
  const double n = blocks;
  for (const bench::PairRun& run : bench::RunPairs(job, static_cast<std::size_t>(blocks))) {
    const double queries = static_cast<double>(run.queries);
    seconds += run.seconds;
    std::printf("| %s | %.3f | %.4f | %.1f | %.2f | %.2f |\n", run.names.c_str(),
                1e6 * run.seconds / n, queries / n, 1e6 * run.seconds / queries, run.proven_mm,
                run.seen_mm);
  }
  std::printf("sum of the pairs: %.2f us/block\n", 1e6 * seconds / n);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!Parse(argc, argv, &options)) {
    std::cerr << kUsage;
    return 3;
  }
  if (options.only.empty()) options.only = {"ours"};
  const bench::BenchFolder folder;
  const auto job =
      bench::MakeImpellerJob(options.spec, options.keep.empty() ? folder.path() : options.keep);
  if (!job) return 1;
  for (const std::string& section : options.only) {
    if (section == "ours") Ours(*job, options.spec.blocks);
    if (section == "pairs") Pairs(*job, options.spec.blocks);
  }
  return 0;
}
