// SPDX-License-Identifier: BSD-3-Clause
// How far two ways that are not the same lie apart.
#pragma once

#include "sim/compare/free_space.h"

namespace ncsim::compare {

/// The Frechet distance of the tips alone; then, of the walks that keep the tips so near (or within
/// the radii), the least greatest distance of the axes. Relative to 1e-3, and never less than it
/// is by more than that.
Distance Apart(const Run& a, const Run& b, const Radii& radii);

/// The run with fewer vertices: none that is left out is further than `ratio` times the radii from
/// the chord that takes its place.
Run Thin(const Run& run, const Radii& radii, double ratio);

}  // namespace ncsim::compare
