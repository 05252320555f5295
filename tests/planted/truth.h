// SPDX-License-Identifier: BSD-3-Clause
// Least values and first zeros of functions over [0, 1], proven from convexity or from a Lipschitz
// constant. Nothing here uses the collision engine or FCL.
#pragma once

#include <functional>
#include <optional>

namespace ncsim::planted {

/// The true value lies between.
struct Bounds {
  double lower = 0.0;
  double upper = 0.0;
};

using Function = std::function<double(double)>;

/// Of a convex function, by golden section until 1e-11 of the range is left; with a Lipschitz
/// constant that gives the lower bound.
Bounds LeastOfConvex(const Function& f, double lipschitz = 0.0);

/// Of a function that changes by no more than `lipschitz` times the step: intervals are halved
/// until no unseen value can be more than `tolerance` below the least that was seen.
Bounds Least(const Function& f, double lipschitz, double floor, double tolerance);

struct Cell {
  double s0 = 0.0, s1 = 1.0, t0 = 0.0, t1 = 1.0;
};
/// The same over a rectangle. `reach_s`, `reach_t`: by how much the value can change in a cell from
/// its middle, with s, and with t.
using Reach = std::function<double(const Cell&)>;
Bounds Least(const std::function<double(double, double)>& f, const Cell& whole,
             const Reach& reach_s, const Reach& reach_t, double floor, double tolerance);

/// The first s with f(s) <= level: above `level` everywhere before `lower`, and not above it at
/// `upper`. nullopt: none was found.
std::optional<Bounds> FirstAtOrBelow(const Function& f, double lipschitz, double level);

}  // namespace ncsim::planted
