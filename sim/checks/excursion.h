// SPDX-License-Identifier: BSD-3-Clause
// Where a motion first takes a joint past a bound, and how far: proven over the whole motion, not
// sampled.
#pragma once

#include "sim/motion/motion.h"

namespace ncsim::checks {

/// One side of a joint's travel, mm or rad. Outside: sense * (q - limit) > tolerance.
struct Bound {
  int joint = 0;
  double sense = 1.0;  ///< +1: `limit` is the upper one; -1: the lower.
  double limit = 0.0;
  double tolerance = 0.0;
};

struct Excursion {
  enum class Outcome {
    kInside,    ///< No point of the motion is outside.
    kOutside,   ///< The point at `s` is.
    kUnproven,  ///< No point outside was found, but near `s` the proof did not close.
  };
  Outcome outcome = Outcome::kInside;
  double s = 0.0;  ///< First parameter that is outside.
  /// Greatest excess, sense * (q - limit), to within 100 tolerances: of the motion, or of the run
  /// if that is more.
  double worst = 0.0;
};

/// True where every joint is monotone over the motion, so that its ends are its extremes:
/// axis-linear and dog-leg paths, and a straight TCP path without turning.
bool IsMonotone(const motion::Motion& motion);

/// The ends of a monotone motion decide. For the others the
/// span is divided until motion::Box proves each piece inside or an actual point is outside.
/// `known_worst` is the greatest excess found so far in a run of blocks: a motion that cannot
/// exceed it is not searched for its own.
Excursion FindExcursion(const motion::Motion& motion, const Bound& bound, double known_worst);

}  // namespace ncsim::checks
