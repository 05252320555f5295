// SPDX-License-Identifier: BSD-3-Clause
// Do two runs describe the same way? The Frechet distance of polygonal curves, by their free-space
// diagram (Alt and Godau, Computing the Frechet distance between two polygonal curves, 1995): both
// are walked from start to end, neither ever back, and at each instant the two poses are within the
// radii. Exact but for rounding, and no sampling: on a pair of chords walked in proportion each
// distance is a convex function, so its greatest value is at an end.
#pragma once

#include <vector>

#include "sim/compare/toolpath.h"

namespace ncsim::compare {

/// A place on each run, as Length() counts them.
struct Step {
  double a = 0.0, b = 0.0;
};

/// Where two runs can be walked together.
struct Walk {
  bool complete = false;  ///< To the end of both.
  bool cut = false;       ///< Given up: more cells than were allowed.
  /// From the start to the end, or as far as they can be walked; between two steps both go in
  /// proportion, on one chord each. Of all ways one that keeps close. Empty where the start itself
  /// is further apart than the radii.
  std::vector<Step> steps;
};

/// Walks both from their starts. The work is in proportion to the cells that can be reached: pairs
/// of chords that are near each other.
Walk WalkTogether(const Run& a, const Run& b, const Radii& radii,
                  std::size_t most_cells = static_cast<std::size_t>(-1));

/// The part of the chord from `from` to `to` that is within the radii of `pose`: [lower, upper] of
/// [0, 1]; empty where lower > upper.
struct Interval {
  double lower = 1.0, upper = 0.0;
  bool empty() const { return lower > upper; }
};
Interval Near(const Pose& pose, const Pose& from, const Pose& to, const Radii& radii);

}  // namespace ncsim::compare
