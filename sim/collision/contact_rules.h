// SPDX-License-Identifier: BSD-3-Clause
// What a pair may do on a motion (docs/collision.md): which clearance is contact, and what finding
// a contact makes.
#pragma once

#include <cstdint>

#include "sim/base/finding.h"
#include "sim/collision/pairs.h"
#include "sim/collision/sweep.h"
#include "sim/machine/job.h"

namespace ncsim::collision {

/// The blank is exact until the first feed that cuts it.
struct BlankState {
  bool cut = false;
  std::uint64_t motion = 0;  ///< Number of the motion that made the first cut,
  double s = 0.0;            ///< and where on it.
};

/// Depths that a rapid may start from: what the feeds just before it, or its canned cycle, reached;
/// mm, >= 0.
class RapidReference {
 public:
  /// All that it remembers.
  struct Memory {
    bool after_feed = false;
    double feed_depth = 0.0;
    double depth = 0.0;
    int cycle = 0;
    double cycle_depth = 0.0;
  };

  RapidReference() = default;
  explicit RapidReference(const Memory& memory) : memory_(memory) {}
  const Memory& memory() const { return memory_; }

  /// After each feed: the deepest that was seen on it.
  void OnFeed(double depth);
  /// Before each rapid: the depth at its start. Returns the depth that it may keep.
  double OnRapid(int cycle, double start_depth);
  /// After OnRapid: the feeds that led into the part turn out to have been this deep. Returns what
  /// the rapid may keep.
  double OnFeedsBefore(int cycle, double depth);
  /// Has the tool been in the part at the start of every rapid since the last feed?
  bool inside() const { return memory_.depth > 0.0; }
  /// True when OnRapid's answer depends on the depth at the start of the rapid.
  bool wants_start() const { return memory_.after_feed || memory_.depth > 0.0; }
  void Reset() { *this = RapidReference(); }

 private:
  double Kept(int cycle) const;

  Memory memory_;
};

struct Judgement {
  bool checked = false;  ///< False: nothing to check on this motion.
  bool widened = false;  ///< The caller sets watch.rounding to what smoothing may do to the pair.
  Watch watch;
  Rule rule = Rule::kCollision;
  Severity severity = Severity::kError;
  double tolerance = 0.0;
};

/// `allowed` is the RapidReference's answer; `floor` is PairEngine::floor(): a tool thinner than a
/// tolerance is held against half its greatest depth instead. `blank` is that of the pair, or null;
/// `number` counts the motions.
Judgement Judge(PairRole role, const motion::Motion& motion, const machine::CheckSettings& settings,
                const BlankState* blank, std::uint64_t number, double allowed, double floor);

/// Must such a pair clear what smoothing may do to it? Flutes and what counts as flutes need not:
/// against part and blank they are where they should be.
bool IsWidened(PairRole role);

/// Was the blank still whole at `s` of motion `number`?
bool Uncut(const BlankState& blank, std::uint64_t number, double s);

}  // namespace ncsim::collision
