// SPDX-License-Identifier: BSD-3-Clause
#include "tests/planted/truth.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <vector>

namespace ncsim::planted {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBracket = 1e-11;
constexpr double kFirstWidth = 1e-6;  // of the interval in which a first contact is told

struct Open {
  double lower;  // no value in the cell is below
  Cell cell;
  bool along_s;  // which side matters more
  bool operator<(const Open& other) const { return lower > other.lower; }
};

bool FirstIn(const Function& f, double lipschitz, double level, double s0, double s1,
             double* clear_to, double* found) {
  const double s = 0.5 * (s0 + s1);
  const double value = f(s);
  if (value <= level) *found = std::min(*found, s);
  if (value - 0.5 * lipschitz * (s1 - s0) > level) return false;
  if (s1 - s0 < kFirstWidth) {
    *clear_to = std::min(*clear_to, s0);
    return value <= level;
  }
  return FirstIn(f, lipschitz, level, s0, s, clear_to, found) ||
         FirstIn(f, lipschitz, level, s, std::min(s1, *found), clear_to, found);
}

}  // namespace

Bounds LeastOfConvex(const Function& f, double lipschitz) {
  constexpr double kGolden = 0.6180339887498949;
  double s0 = 0.0;
  double s1 = 1.0;
  double a = s1 - kGolden * (s1 - s0);
  double b = s0 + kGolden * (s1 - s0);
  double fa = f(a);
  double fb = f(b);
  double least = std::min({f(0.0), f(1.0), fa, fb});
  while (s1 - s0 > kBracket) {
    if (fa <= fb) {
      s1 = b;
      b = a;
      fb = fa;
      a = s1 - kGolden * (s1 - s0);
      fa = f(a);
      least = std::min(least, fa);
    } else {
      s0 = a;
      a = b;
      fa = fb;
      b = s0 + kGolden * (s1 - s0);
      fb = f(b);
      least = std::min(least, fb);
    }
  }
  return {least - 2.0 * lipschitz * kBracket, least};
}

Bounds Least(const Function& f, double lipschitz, double floor, double tolerance) {
  return Least([&f](double s, double /*t*/) { return f(s); }, Cell{0.0, 1.0, 0.0, 0.0},
               [lipschitz](const Cell& c) { return 0.5 * lipschitz * (c.s1 - c.s0); },
               [](const Cell&) { return 0.0; }, floor, tolerance);
}

Bounds Least(const std::function<double(double, double)>& f, const Cell& whole,
             const Reach& reach_s, const Reach& reach_t, double floor, double tolerance) {
  double least = std::min(f(whole.s0, whole.t0), f(whole.s1, whole.t0));
  std::priority_queue<Open> cells;
  const auto look = [&](const Cell& c) {
    const double value = f(0.5 * (c.s0 + c.s1), 0.5 * (c.t0 + c.t1));
    least = std::min(least, value);
    const double by_s = reach_s(c);
    const double by_t = reach_t(c);
    const double lower = std::max(floor, value - by_s - by_t);
    if (lower < least) cells.push({lower, c, by_s >= by_t});
  };
  look(whole);
  while (!cells.empty() && cells.top().lower < least - tolerance) {
    Cell first = cells.top().cell;
    Cell second = first;
    if (cells.top().along_s) {
      first.s1 = second.s0 = 0.5 * (first.s0 + first.s1);
    } else {
      first.t1 = second.t0 = 0.5 * (first.t0 + first.t1);
    }
    cells.pop();
    look(first);
    look(second);
  }
  return {cells.empty() ? least : std::min(least, cells.top().lower), least};
}

std::optional<Bounds> FirstAtOrBelow(const Function& f, double lipschitz, double level) {
  if (f(0.0) <= level) return Bounds{0.0, 0.0};
  double clear_to = 1.0;
  double found = f(1.0) <= level ? 1.0 : kInfinity;
  FirstIn(f, lipschitz, level, 0.0, 1.0, &clear_to, &found);
  if (found == kInfinity) return std::nullopt;
  return Bounds{std::min(clear_to, found), found};
}

}  // namespace ncsim::planted
