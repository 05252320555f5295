// SPDX-License-Identifier: BSD-3-Clause
// What the check of one pair over one run of motions found: plain data, to be told later.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sim/base/finding.h"
#include "sim/collision/profile_distance.h"
#include "sim/collision/sweep.h"

namespace ncsim::collision {

/// Consecutive motions with the same fault. Motions are counted from the first of the run.
struct ContactRun {
  enum class Kind { kContact, kNear, kSpindleStopped };
  static constexpr int kKinds = 3;

  Kind kind = Kind::kContact;
  Rule rule = Rule::kCollision;
  Severity severity = Severity::kError;
  std::size_t first = 0, last = 0;
  /// Where it is told of: where a contact begins, where two bodies are nearest.
  std::size_t motion = 0;
  PathPoint at;
  std::vector<std::array<double, 3>> points;               ///< As Finding::points.
  double least = std::numeric_limits<double>::infinity();  ///< Clearance, mm; minus the depth.
  double tolerance = 0.0;                                  ///< mm, of the rule.
  double lean = 0.0;      ///< rad: the turn of the tool axis that `tolerance` allows for.
  bool only_lag = false;  ///< Not on the polyline of infinite acceleration.
  bool done = false;      ///< The same fault on the next motion would be another run.
};

struct PairOutcome {
  std::vector<ContactRun> runs;    ///< In the order in which they ended.
  std::string uncertified;         ///< Why the pair cannot be certified; "" where it is.
  std::size_t uncertified_at = 0;  ///< The motion where that was found.
  bool touched = false;
  /// Least clearance over the run; upper is +inf where nothing was seen that is of interest.
  Interval least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  std::size_t least_at = 0;  ///< The motion where that was seen.
  double widened = 0.0;      ///< mm: what the pair was to clear for smoothing, at most.
  std::uint64_t queries = 0;
};

}  // namespace ncsim::collision
