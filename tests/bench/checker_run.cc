// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/checker_run.h"

#include <time.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "sim/collision/threads.h"

namespace ncsim::bench {
namespace {

constexpr machine::Profile machine::Tool::*kToolBodies[] = {
    &machine::Tool::flutes, &machine::Tool::shank, &machine::Tool::holder};

motion::Window Slice(const motion::Window& window, std::size_t begin, std::size_t end) {
  motion::Window slice;
  slice.motions.assign(window.motions.begin() + static_cast<std::ptrdiff_t>(begin),
                       window.motions.begin() + static_cast<std::ptrdiff_t>(end));
  return slice;
}

/// One pair: its bodies, and nothing else.
struct Scene {
  machine::Scene scene;
  machine::ToolTable tools;
  std::unique_ptr<collision::CollisionChecker> checker;
  PairRun run;
};

std::vector<std::unique_ptr<Scene>> SinglePairs(const BenchJob& job) {
  std::vector<std::unique_ptr<Scene>> scenes;
  const auto add = [&](Scene scene) {
    scenes.push_back(std::make_unique<Scene>(std::move(scene)));
    Scene& kept = *scenes.back();
    kept.checker = std::make_unique<collision::CollisionChecker>(job.machine, kept.scene,
                                                                 kept.tools, job.job.check);
  };
  const auto& bodies = job.scene.bodies;
  machine::Tool bare = job.job.tools.front();
  for (const auto body : kToolBodies) (bare.*body).elements.clear();
  const char* const names[] = {"flutes", "shank", "holder"};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      Scene scene;
      scene.scene.bodies = {bodies[i]};
      scene.tools.tools = {bare};
      scene.tools.tools.front().*kToolBodies[k] = job.job.tools.front().*kToolBodies[k];
      scene.run.names = std::string(names[k]) + " - " + bodies[i].name;
      add(std::move(scene));
    }
    for (std::size_t k = i + 1; k < bodies.size(); ++k) {
      Scene scene;
      scene.scene.bodies = {bodies[i], bodies[k]};
      scene.tools.tools = {bare};
      scene.run.names = bodies[i].name + " - " + bodies[k].name;
      add(std::move(scene));
    }
  }
  return scenes;
}

}  // namespace

double ProcessCpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::size_t FirstCut(const motion::Window& window) {
  const auto first = std::find_if(
      window.motions.begin(), window.motions.end(),
      [](const motion::Motion& motion) { return motion.facts.tcp && motion::IsFeed(motion); });
  return static_cast<std::size_t>(first - window.motions.begin());
}

CheckerRun RunChecker(const BenchJob& job, std::size_t motions, Approach approach) {
  CheckerRun run;
  const collision::ThreadLimit one(1);
  const machine::ToolTable tools{job.job.tools};
  double start = ProcessCpuSeconds();
  collision::CollisionChecker checker(job.machine, job.scene, tools, job.job.check);
  run.setup_seconds = ProcessCpuSeconds() - start;
  motion::Window part;
  bool timed = approach == Approach::kTimed;
  ForEachWindow(job, [&](const motion::Window& window) {
    std::size_t begin = 0;
    if (!timed) {
      begin = FirstCut(window);
      timed = begin < window.motions.size();
      part = Slice(window, 0, begin);
      checker.Check(part);
    }
    part = Slice(window, begin, std::min(window.motions.size(), begin + motions - run.motions));
    run.motions += part.motions.size();
    const double from = ProcessCpuSeconds();
    checker.Check(std::move(part));
    run.seconds += ProcessCpuSeconds() - from;
    return run.motions < motions;
  });
  start = ProcessCpuSeconds();
  run.result = checker.Finish();
  run.seconds += ProcessCpuSeconds() - start;
  return run;
}

std::vector<PairRun> RunPairs(const BenchJob& job, std::size_t motions) {
  const collision::ThreadLimit one(1);
  std::vector<std::unique_ptr<Scene>> scenes = SinglePairs(job);
  std::size_t done = 0;
  ForEachWindow(job, [&](const motion::Window& window) {
    const motion::Window part = Slice(window, 0, std::min(window.motions.size(), motions - done));
    for (const auto& scene : scenes) {
      const double begin = ProcessCpuSeconds();
      scene->checker->Check(part);
      scene->run.seconds += ProcessCpuSeconds() - begin;
    }
    done += part.motions.size();
    return done < motions;
  });
  std::vector<PairRun> runs;
  for (const auto& scene : scenes) {
    const double begin = ProcessCpuSeconds();
    const collision::CollisionResult result = scene->checker->Finish();
    scene->run.seconds += ProcessCpuSeconds() - begin;
    if (result.queries == 0) continue;  // rigid, or declared no pair
    scene->run.queries = result.queries;
    scene->run.proven_mm = scene->run.seen_mm = std::numeric_limits<double>::quiet_NaN();
    if (!result.clearances.empty()) {
      scene->run.proven_mm = result.clearances.front().proven_mm;
      scene->run.seen_mm = result.clearances.front().seen_mm;
    }
    runs.push_back(scene->run);
  }
  std::sort(runs.begin(), runs.end(),
            [](const PairRun& a, const PairRun& b) { return a.seconds > b.seconds; });
  return runs;
}

}  // namespace ncsim::bench
