// SPDX-License-Identifier: BSD-3-Clause
// FCL sampling, timed on the first stretch of the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/bench/impeller_job.h"
#include "tests/peers/fcl_world.h"

namespace ncsim::bench {

struct PeerRun {
  std::size_t motions = 0;
  double seconds = 0.0;  ///< CPU time.
  std::uint64_t samples = 0;
  std::uint64_t calls = 0;
  std::string contact;  ///< "" as it should be.
};

/// As many motions as fit into `budget_seconds` of CPU time, `at_least` in any case; from the first
/// cut on (the way from the tool changer is long, and no part of what the program repeats).
PeerRun RunPeer(const BenchJob& job, peers::Arrangement arrangement, double budget_seconds,
                std::size_t at_least);

}  // namespace ncsim::bench
