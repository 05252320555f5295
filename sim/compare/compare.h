// SPDX-License-Identifier: BSD-3-Clause
// Two programs held together as continuous motion of tip and tool axis in the part.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/compare/fault_log.h"
#include "sim/compare/run_compare.h"
#include "sim/compare/toolpath.h"

namespace ncsim::compare {

struct Comparison {
  std::vector<Finding> findings;  ///< In the order of the tested program's motion.
  /// The greatest anywhere along feeds that both have: proven, what chords deviate included.
  Largest position;  ///< mm
  Largest angle;     ///< rad
  std::vector<Added> added;
  std::uint64_t runs = 0;    ///< Runs of feeds that both have.
  double feed_length = 0.0;  ///< mm, of the reference.
};

/// Chords of both programs should deviate by no more than this from the motions.
Distance ChordErrorFor(const Tolerances& tolerances);

/// Each of the two is described in the part frame. The reference is what is right.
Comparison Compare(Toolpath reference, Toolpath tested, const Tolerances& tolerances,
                   const SourceFiles& files);

}  // namespace ncsim::compare
