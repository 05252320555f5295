// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/magnitude.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ncsim::compare {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRelative = 5e-4;
/// Pairs of chords that are looked at; where there are more the runs are thinned.
constexpr std::size_t kMostCells = 200'000;
/// Of the radii: what thinning may take off.
constexpr double kThin = 2e-4;
constexpr double kMostDoublings = 60;

/// The least factor in [1, ...] for which `fits`, which holds for all above one for which it holds.
template <typename Fits>
double LeastFactor(double lower, const Fits& fits) {
  if (fits(lower)) return lower;
  double upper = lower;
  for (int i = 0; i < kMostDoublings && !fits(upper *= 2.0); ++i) lower = upper;
  while (upper - lower > kRelative * lower) {
    const double middle = 0.5 * (lower + upper);
    (fits(middle) ? upper : lower) = middle;
  }
  return upper;
}

/// Of the chord from `from` to `to`: how far `pose` lies from it.
double FromChord(const Pose& pose, const Pose& from, const Pose& to, const Radii& radii) {
  const Eigen::Vector3d way = (to.p - from.p) / radii.position, turn = (to.u - from.u) / radii.axis;
  const double square = way.squaredNorm() + turn.squaredNorm();
  const double along =
      way.dot(pose.p - from.p) / radii.position + turn.dot(pose.u - from.u) / radii.axis;
  const double s = square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
  return Ratio(Between(pose, Lerp(from, to, s)), radii);
}

}  // namespace

/// Douglas and Peucker's.
Run Thin(const Run& run, const Radii& radii, double ratio) {
  std::vector<bool> keep(run.vertices.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, run.vertices.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double most = ratio;
    std::size_t worst = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off = FromChord(run.vertices[i], run.vertices[first], run.vertices[last], radii);
      if (off > most) {
        most = off;
        worst = i;
      }
    }
    if (worst == 0) continue;
    keep[worst] = true;
    open.emplace_back(first, worst);
    open.emplace_back(worst, last);
  }
  Run thin;
  thin.vertices.push_back(run.vertices.front());
  for (std::size_t i = 1; i < run.vertices.size(); ++i) {
    if (!keep[i]) continue;
    thin.vertices.push_back(run.vertices[i]);
    thin.pieces.push_back(run.pieces[i - 1]);
  }
  return thin;
}

namespace {

/// Two runs, thinned as far as the radii at which they are held together ask for.
class Thinned {
 public:
  Thinned(const Run& a, const Run& b) : a_(a), b_(b) {}

  bool Fit(const Radii& radii) {
    for (double ratio = kThin; ratio < 1.0; ratio *= 2.0) {
      const Walk walk = WalkTogether(a_, b_, radii, kMostCells);
      if (!walk.cut) return walk.complete;
      a_ = Thin(a_, radii, ratio);
      b_ = Thin(b_, radii, ratio);
    }
    return WalkTogether(a_, b_, radii).complete;
  }

 private:
  Run a_, b_;
};

}  // namespace

Distance Apart(const Run& a, const Run& b, const Radii& radii) {
  const Distance first = Between(a.vertices.front(), b.vertices.front());
  const Distance last = Between(a.vertices.back(), b.vertices.back());
  constexpr double kSlack = 1.0 + 1e-6;  // of the ends themselves
  Thinned tips(a, b), axes(a, b);
  const double position = LeastFactor(
      kSlack * std::max({first.position, last.position, 0.01 * radii.position}), [&](double r) {
        return tips.Fit({r, kInfinite});
      });
  const double near = std::max(position * (1.0 + kRelative), radii.position);
  const double axis =
      LeastFactor(kSlack * std::max({first.axis, last.axis, 0.01 * radii.axis}), [&](double r) {
        return axes.Fit({near, r});
      });
  return {position, axis};
}

}  // namespace ncsim::compare
