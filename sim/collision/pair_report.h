// SPDX-License-Identifier: BSD-3-Clause
// A pair's outcomes, run after run of motions, made into findings and its least clearance.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sim/base/finding.h"
#include "sim/collision/pair_outcome.h"
#include "sim/collision/pairs.h"

namespace ncsim::collision {

/// Findings with the number of the motion where each begins.
using NumberedFindings = std::vector<std::pair<std::uint64_t, Finding>>;

class PairReport {
 public:
  /// In program order. `last` is the number of the last motion of the run. A fault that goes on
  /// from the run before is one with it.
  void Add(const Pair& pair, PairOutcome outcome, std::uint64_t last, NumberedFindings* findings);
  /// After the last motion.
  void Finish(const Pair& pair, NumberedFindings* findings);

  /// Over all motions so far.
  const Interval& least() const { return least_; }
  const SourcePosition& least_where() const { return least_where_; }
  bool touched() const { return touched_; }
  bool uncertified() const { return uncertified_; }
  std::uint64_t queries() const { return queries_; }

 private:
  std::optional<ContactRun>& open(ContactRun::Kind kind);
  void Close(const Pair& pair, std::optional<ContactRun>* run, NumberedFindings* findings);

  std::array<std::optional<ContactRun>, ContactRun::kKinds> open_;
  Interval least_ = PairOutcome().least;
  SourcePosition least_where_;
  bool touched_ = false;
  bool uncertified_ = false;
  std::uint64_t queries_ = 0;
};

}  // namespace ncsim::collision
