// SPDX-License-Identifier: BSD-3-Clause
// The folder of --cache.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "sim/base/record_store.h"
#include "sim/collision/outcome_cache.h"

namespace ncsim::app {

class CacheFolder {
 public:
  /// What is left in the folder at the end, at most: what was not used for the longest goes first.
  static constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30U;

  /// Makes the folder where it is not there. nullopt, and `err` says why, where that cannot be.
  static std::optional<CacheFolder> Open(const std::string& folder, std::ostream& err);

  /// What checks of any number of programs may share.
  const collision::OutcomeCache* outcomes() const { return &outcomes_; }
  /// After all checks: says how much was known of `all` outcomes, and what went wrong with the
  /// folder.
  void Finish(std::uint64_t recalled, std::uint64_t all, std::ostream& err) const;

 private:
  CacheFolder(std::unique_ptr<RecordStore> store, const Digest& build)
      : store_(std::move(store)), outcomes_(store_.get(), build) {}

  std::unique_ptr<RecordStore> store_;
  collision::OutcomeCache outcomes_;
};

}  // namespace ncsim::app
