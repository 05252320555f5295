// SPDX-License-Identifier: BSD-3-Clause
// What the check of one pair over one run of motions found: plain data, to be told later.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sim/base/finding.h"
#include "sim/base/run_finding.h"
#include "sim/collision/contact_text.h"
#include "sim/collision/profile_distance.h"

namespace ncsim::collision {

/// Consecutive motions with the same fault.
struct ContactRun {
  enum class Kind { kContact, kNear, kSpindleStopped };
  static constexpr int kKinds = 3;

  Kind kind = Kind::kContact;
  RunFinding blocks;                  ///< Its finding has no message yet.
  std::uint64_t first = 0, last = 0;  ///< Numbers of motions.
  bool done = false;                  ///< The same fault on the next motion would be another run.
  ContactWords words;
  double least = std::numeric_limits<double>::infinity();  ///< Clearance, mm; minus the depth.
};

struct PairOutcome {
  std::vector<ContactRun> runs;  ///< In the order in which they ended.
  std::string uncertified;       ///< Why the pair cannot be certified; "" where it is.
  SourcePosition uncertified_where;
  std::uint64_t uncertified_number = 0;
  bool touched = false;
  /// Least clearance over the run; upper is +inf where nothing was seen that is of interest.
  Interval least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  SourcePosition least_where;
  std::uint64_t queries = 0;
};

}  // namespace ncsim::collision
