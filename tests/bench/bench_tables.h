// SPDX-License-Identifier: BSD-3-Clause
// The tables of ncsim_collision_bench, as Markdown on standard output. False: something that must
// not happen did (a contact in a job that has none, a verdict that is not `pass`).
#pragma once

#include <string>
#include <vector>

#include "tests/bench/impeller_job.h"

namespace ncsim::bench {

/// The checker alone, over the whole program.
bool PrintChecker(const BenchJob& job, const ImpellerSpec& spec);
/// What each pair costs the checker.
bool PrintPairs(const BenchJob& job, const ImpellerSpec& spec);
/// FCL sampling beside the checker; each peer runs for about `budget_seconds` of CPU time.
bool PrintPeers(const BenchJob& job, const ImpellerSpec& spec, double budget_seconds);
/// What a least clearance costs by sampling: exact distances. Slow.
bool PrintDistances(const BenchJob& job, double budget_seconds);

struct TextRun {
  int blocks = 0;
  int jobs = 1;
};
/// From text to verdict: `ncsim check` as a process of its own. The files go to `folder`.
bool PrintText(const std::string& ncsim, const ImpellerSpec& spec, const std::string& folder,
               const std::vector<TextRun>& runs);

}  // namespace ncsim::bench
