// SPDX-License-Identifier: BSD-3-Clause
// Some windows of motions are checked at a time, on as many threads as there are; what comes out
// does not depend on how many that is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/collision/outcome_cache.h"
#include "sim/collision/pair_check.h"
#include "sim/collision/pair_report.h"
#include "sim/motion/window.h"

namespace ncsim::collision {

/// Windows of the longest batch. The first one has one, each next one twice as many: what is known
/// of the least clearances after it spares the next one work.
inline constexpr std::size_t kMostWindows = 8;

/// A pair over a whole program.
struct WatchedPair {
  WatchedPair(const machine::Machine& machine, const machine::CheckSettings& settings, Pair pair,
              BlankState* blank_state)
      : setup(machine, settings, std::move(pair)), content(ContentOf(setup)), blank(blank_state) {}

  /// report.least() is a clearance that holds over the whole program.
  bool has_clearance() const;

  PairSetup setup;
  Digest content;     ///< Of the setup.
  BlankState* blank;  ///< Of the pair's blank, or null.
  PairCarry carry;
  PairReport report;
};
using WatchedPairs = std::vector<std::unique_ptr<WatchedPair>>;

using SharedWindow = std::shared_ptr<const motion::Window>;

/// Motions that follow each other with one tool, and the pairs that they move.
struct BatchRun {
  SharedWindow window;                         ///< Keeps the motions.
  std::vector<const motion::Motion*> motions;  ///< At least one.
  std::uint64_t number = 0;                    ///< Of the first of them.
  bool tool_changed = false;                   ///< Another tool than in the run before.
  double tool_length = 0.0;
  std::vector<WatchedPairs*> groups;  ///< In the order in which pairs are told of.
  std::unique_ptr<motion::Travel> travel;
  std::unique_ptr<KnownRun> known;    ///< Null without a cache.
  std::vector<PairOutcome> outcomes;  ///< For each pair of each group.
};
using Batch = std::vector<BatchRun>;

/// Checks batches, beside the thread that asks for it.
class BatchRunner {
 public:
  BatchRunner();
  ~BatchRunner();
  BatchRunner(const BatchRunner&) = delete;
  BatchRunner& operator=(const BatchRunner&) = delete;

  /// Fills in what the batch's runs lack. `batch`, its pairs and the machine are left alone until
  /// Wait(). `cache` may be null.
  void Start(const machine::Machine& machine, const OutcomeCache* cache, Batch* batch);
  /// Returns when it is done; rethrows what it threw.
  void Wait();

 private:
  struct Group;
  std::unique_ptr<Group> group_;
};

/// A least clearance as it is handed to a run: up to 6 % more, so that it, and what is kept of the
/// run, is the same one as long as clearances elsewhere change but little.
double RoundedLeast(double least);

/// Makes the outcomes of a batch that is done part of its pairs' reports, in program order.
void Tell(Batch* batch, NumberedFindings* findings);

}  // namespace ncsim::collision
