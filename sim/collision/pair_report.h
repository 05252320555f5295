// SPDX-License-Identifier: BSD-3-Clause
// A pair's outcomes, run after run of motions, made into findings and its least clearance.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sim/base/finding.h"
#include "sim/base/run_finding.h"
#include "sim/collision/pair_check.h"
#include "sim/collision/pair_outcome.h"

namespace ncsim::collision {

/// Findings with the number of the motion where each begins.
using NumberedFindings = std::vector<std::pair<std::uint64_t, Finding>>;

class PairReport {
 public:
  /// In program order. `number` is that of the first motion of the run. A fault that goes on from
  /// the run before is one with it.
  void Add(const PairSetup& setup, const motion::Travel& run, std::uint64_t number,
           PairOutcome outcome, NumberedFindings* findings);
  /// After the last motion.
  void Finish(const PairSetup& setup, NumberedFindings* findings);

  /// Over all motions so far.
  const Interval& least() const { return least_; }
  const SourcePosition& least_where() const { return least_where_; }
  /// By how much the pair was widened for smoothing, at most, mm.
  double widened() const { return widened_; }
  bool touched() const { return touched_; }
  bool uncertified() const { return uncertified_; }
  std::uint64_t queries() const { return queries_; }

 private:
  /// A fault that may go on in the next run.
  struct Open {
    ContactRun run;
    RunFinding blocks;
    std::uint64_t first = 0, last = 0;  ///< Numbers of motions.
  };

  void Take(const PairSetup& setup, Open next, NumberedFindings* findings);
  static void Close(const PairSetup& setup, std::optional<Open>* run, NumberedFindings* findings);

  std::array<std::optional<Open>, ContactRun::kKinds> open_;
  Interval least_ = PairOutcome().least;
  SourcePosition least_where_;
  double widened_ = 0.0;
  bool touched_ = false;
  bool uncertified_ = false;
  std::uint64_t queries_ = 0;
};

}  // namespace ncsim::collision
