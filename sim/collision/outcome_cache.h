// SPDX-License-Identifier: BSD-3-Clause
// Outcomes that earlier checks have left in a folder: what has not changed is not computed again.
// Results never depend on it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/record_store.h"
#include "sim/collision/content.h"
#include "sim/collision/outcome_record.h"

namespace ncsim::collision {

/// What is known of one run of motions, pair by pair: a record of the store.
class KnownRun {
 public:
  /// `pairs` outcomes are to be had. The store outlives this.
  KnownRun(RecordStore* store, const Digest& build, const motion::Travel& run, std::uint64_t number,
           std::size_t pairs);

  /// Of the pair with `content`, before its check. Threads may ask at a time, each for pairs of its
  /// own.
  Digest KeyOf(const Digest& content, const PairCarry& carry, const BlankState* blank) const;
  /// The outcome of this key, if it is known: fills in what the check would have. `pair` counts
  /// the pairs.
  bool Recall(std::size_t pair, const Digest& key, PairOutcome* outcome, PairCarry* carry,
              BlankState* blank);
  void Keep(std::size_t pair, const Digest& key, const PairOutcome& outcome, const PairCarry& carry,
            const BlankState* blank);

  /// When each pair has been recalled or kept: adds what is new to the record, which other runs of
  /// the same motions share.
  void Save();
  /// Pairs that were known.
  std::uint64_t recalled() const;

 private:
  struct Entry {
    Digest key;
    std::string_view bytes;
  };
  struct Use {
    Digest key;
    bool recalled = false;
    std::string_view known;
    std::string fresh;
  };
  static std::vector<Entry> Entries(std::string_view record);

  RecordStore* store_;
  RunPlace place_;
  Digest name_;
  std::string record_;
  std::vector<Entry> entries_;  // into record_, in the order of their keys
  std::vector<Use> uses_;
};

class OutcomeCache {
 public:
  /// The store outlives this. Outcomes of another `build` of the program are not known.
  OutcomeCache(RecordStore* store, const Digest& build) : store_(store), build_(build) {}

  std::unique_ptr<KnownRun> Open(const motion::Travel& run, std::uint64_t number,
                                 std::size_t pairs) const {
    return std::make_unique<KnownRun>(store_, build_, run, number, pairs);
  }

 private:
  RecordStore* store_;
  Digest build_;
};

}  // namespace ncsim::collision
