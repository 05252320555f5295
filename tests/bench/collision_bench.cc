// SPDX-License-Identifier: BSD-3-Clause
// Collision checking of one impeller-like five-axis program: the certified checker beside FCL
// sampling, in one run on one core; then text to verdict, memory, and how cost grows.
// docs/performance.md has the results.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "tests/bench/bench_tables.h"
#include "tests/bench/growth.h"
#include "tests/bench/impeller_job.h"

namespace {

using namespace ncsim;

constexpr const char* kUsage =
    "ncsim_collision_bench [--smoke] [--only SECTION]... [--blocks N] [--triangles N] [--studs N]\n"
    "    [--clearance MM] [--allowance MM] [--budget SECONDS] [--large N] [--jobs N]\n"
    "    [--svg FILE] [--keep FOLDER]\n"
    "  SECTION: ours, peers, text, growth; and only if asked for: pairs (what each costs),\n"
    "    distances (FCL's exact distances at every pose)\n"
    "  --budget: CPU time for each peer   --large: the longest program\n"
    "  --jobs: text to verdict also with so many   --keep: leave the job's files there\n";

struct Options {
  bench::ImpellerSpec spec;
  std::vector<std::string> only;
  double budget = 15.0;
  int large = 1'200'000;
  int jobs = 1;
  std::string svg;
  std::string keep;
  bool smoke = false;

  bool Wants(const char* section) const {
    return std::find(only.begin(), only.end(), section) != only.end();
  }
};

bool Set(const std::string& key, const char* value, Options* options) {
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
  } else if (key == "--budget") {
    options->budget = std::atof(value);
  } else if (key == "--large") {
    options->large = std::atoi(value);
  } else if (key == "--jobs") {
    options->jobs = std::atoi(value);
  } else if (key == "--only") {
    options->only.emplace_back(value);
  } else if (key == "--svg") {
    options->svg = value;
  } else if (key == "--keep") {
    options->keep = value;
  } else {
    return false;
  }
  return true;
}

bool Parse(int argc, char** argv, Options* options) {
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--smoke") {
      options->smoke = true;
      options->spec.blocks = 600;
      options->spec.triangles = 2'000;
      options->budget = 0.3;
      options->large = 1'000;
    } else if (i + 1 >= argc || !Set(argv[i], argv[i + 1], options)) {
      return false;
    } else {
      ++i;
    }
  }
  if (options->only.empty()) options->only = {"ours", "peers", "text", "growth"};
  return options->spec.blocks > 0 && options->spec.triangles > 0;
}

std::string ProcessorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string LoadAverage() {
  std::ifstream in("/proc/loadavg");
  std::string load;
  in >> load;
  return load;
}

bench::GrowthPlan Plan(const Options& options) {
  if (options.smoke) return {{500, 1'000}, {1'000, 2'000}, {0, 1}, {1.0}};
  const int most = std::min(options.large, 1'000'000);
  bench::GrowthPlan plan{
      {}, {1'000, 10'000, 100'000, 1'000'000}, {0, 5, 10, 20, 40}, {0, 1, 2, 3, 5}};
  for (const int blocks : {10'000, 30'000, 100'000, 300'000, 1'000'000}) {
    if (blocks <= most) plan.blocks.push_back(blocks);
  }
  return plan;
}

bool Run(const Options& options, const std::string& folder) {
  const auto job = bench::MakeImpellerJob(options.spec, folder);
  if (!job) return false;
  std::printf("%s; load %s. %d blocks, part of %d triangles, %zu bodies, threshold %.1f mm\n",
              ProcessorName().c_str(), LoadAverage().c_str(), options.spec.blocks,
              options.spec.triangles, job->scene.bodies.size() + 3, options.spec.clearance);
  bool good = true;
  if (options.Wants("ours")) good = bench::PrintChecker(*job, options.spec) && good;
  if (options.Wants("pairs")) good = bench::PrintPairs(*job, options.spec) && good;
  if (options.Wants("peers")) good = bench::PrintPeers(*job, options.spec, options.budget) && good;
  if (options.Wants("distances")) good = bench::PrintDistances(*job, options.budget) && good;
  if (options.Wants("text")) {
    std::vector<bench::TextRun> runs{
        {options.spec.blocks / 10, 1}, {options.spec.blocks, 1}, {options.large, 1}};
    if (options.jobs > 1) {
      runs.push_back({options.spec.blocks, options.jobs});
      runs.push_back({options.large, options.jobs});
    }
    good = bench::PrintText(NCSIM_PROGRAM, options.spec, folder + "/text", runs) && good;
  }
  if (options.Wants("growth")) {
    bench::ImpellerSpec spec = options.spec;
    spec.blocks = std::max(500, spec.blocks / 5);
    const auto series = bench::PrintGrowth(spec, Plan(options), folder + "/growth");
    if (!options.svg.empty()) good = bench::WriteGrowthSvg(series, options.svg) && good;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!Parse(argc, argv, &options)) {
    std::fputs(kUsage, stderr);
    return 3;
  }
  const bench::BenchFolder folder;
  return Run(options, options.keep.empty() ? folder.path() : options.keep) ? 0 : 1;
}
