// SPDX-License-Identifier: BSD-3-Clause
// The checker alone, timed: motions are made outside of the clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/collision/checker.h"
#include "tests/bench/impeller_job.h"

namespace ncsim::bench {

/// CPU time of all threads of this process, s.
double ProcessCpuSeconds();

struct CheckerRun {
  std::size_t motions = 0;
  double setup_seconds = 0.0;  ///< Trees of triangles, pairs.
  double seconds = 0.0;        ///< CPU time of Check and Finish.
  collision::CollisionResult result;

  double microseconds_per_motion() const { return 1e6 * seconds / static_cast<double>(motions); }
  double motions_per_second() const { return static_cast<double>(motions) / seconds; }
};

/// The way from the tool changer to the part is long, and no part of what a program repeats.
enum class Approach { kTimed, kUntimed };

/// All pairs, over the first `motions` of the program; an untimed approach does not count.
CheckerRun RunChecker(const BenchJob& job, std::size_t motions,
                      Approach approach = Approach::kTimed);
/// The first feed under TCP in the window, or its end.
std::size_t FirstCut(const motion::Window& window);

struct PairRun {
  std::string names;
  double seconds = 0.0;
  std::uint64_t queries = 0;
  double proven_mm = 0.0;  ///< Least clearance; NaN where the checker keeps none.
  double seen_mm = 0.0;
};

/// Each pair by a checker that knows nothing else: what it costs. Dearest first.
std::vector<PairRun> RunPairs(const BenchJob& job, std::size_t motions);

}  // namespace ncsim::bench
