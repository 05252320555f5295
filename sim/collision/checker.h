// SPDX-License-Identifier: BSD-3-Clause
// Contacts and clearances over whole motions. FCL stays behind this header. Knows no NC text and no
// control.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/finding.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"
#include "sim/motion/window.h"

namespace ncsim::collision {

/// The least clearance of a pair over the program: never less than `proven_mm` anywhere, `seen_mm`
/// at `where`.
struct PairClearance {
  std::vector<std::string> bodies;  ///< Tool side first: {"T3.holder", "vise_jaw"}.
  double proven_mm = 0.0;
  double seen_mm = 0.0;
  SourcePosition where;
  /// What smoothing may take the pair off its programmed motions, at most: it was to clear that
  /// much wherever it applies.
  double widened_mm = 0.0;
};

/// The deepest that each tool's flutes went into the part in feeds (mm, >= 0).
struct DeepestCut {
  int tool = 0;
  double depth_mm = 0.0;
  SourcePosition where;
};

class OutcomeCache;

struct CollisionResult {
  std::vector<Finding> findings;  ///< In program order; one for a run of blocks in contact.
  std::vector<PairClearance> clearances;
  std::vector<DeepestCut> cuts;
  double orientation_tolerance = 0.0;  ///< rad: greatest motion::Facts::orientation_tolerance.
  std::uint64_t queries = 0;           ///< Poses at which a clearance was computed, over all pairs.
  /// Pairs over runs of motions, and those of them that the cache knew: nothing else depends on it.
  std::uint64_t outcomes = 0, recalled = 0;
};

/// Checks every pair of bodies that can move against each other, over the whole of every motion: an
/// interval is proven clear when the clearance at one of its poses exceeds motion::RelativeBound,
/// else it is split; a hit is a pose.
class CollisionChecker {
 public:
  /// All outlive it. `cache` may be null.
  CollisionChecker(const machine::Machine& machine, const machine::Scene& scene,
                   const machine::ToolTable& tools, const machine::CheckSettings& settings,
                   const OutcomeCache* cache = nullptr);
  ~CollisionChecker();

  /// Windows in program order. Returns before they are checked, on as many threads as oneTBB's
  /// global_control allows; the result is the same for any number of them.
  void Check(motion::Window window);
  CollisionResult Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::collision
