// SPDX-License-Identifier: BSD-3-Clause
#include "post/rotary_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

namespace ncsim::post {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kSame = 1e-9;  // rad

double Distance(const Rotary& a, const Rotary& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

double Travel(const Rotary& a, const Rotary& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]);
}

class Follower {
 public:
  Follower(const PartGeometry& geometry, const std::vector<Eigen::Vector3d>& axes,
           double pole_tolerance)
      : geometry_(geometry), axes_(axes), pole_tolerance_(pole_tolerance) {}

  /// Where axis i is met coming from `from`; none where that would leave the limits.
  std::optional<PartGeometry::Way> Next(std::size_t i, const Rotary& from) const {
    return geometry_.Follow(axes_[i], from, pole_tolerance_);
  }

  /// How many axes follow axis i continuously when it is met at `start`.
  std::size_t Stretch(std::size_t i, Rotary start) const {
    std::size_t end = i;
    while (end + 1 < axes_.size()) {
      const auto next = Next(end + 1, start);
      if (!next) break;
      start = next->end;
      ++end;
    }
    return end - i;
  }

  /// All positions for axis i: branches, turns within limits, and at the pole what comes next.
  std::vector<Rotary> Starts(std::size_t i, const Rotary& from) const {
    std::vector<Rotary> starts;
    const auto add = [&](const Rotary& rotary) {
      const bool known = std::any_of(starts.begin(), starts.end(), [&](const Rotary& start) {
        return Distance(start, rotary) < kSame;
      });
      if (!known) starts.push_back(rotary);
    };
    for (const Rotary& rotary : geometry_.Reach(axes_[i], from)) AddTurns(rotary, add);
    if (!starts.empty() && geometry_.AtPole(axes_[i])) {
      std::size_t leaves = i;
      while (leaves < axes_.size() && geometry_.AtPole(axes_[leaves])) ++leaves;
      if (leaves < axes_.size()) {
        for (const Rotary& later : geometry_.Reach(axes_[leaves], from)) {
          AddTurns({starts[0][0], later[1]}, add);
        }
      }
    }
    return starts;
  }

 private:
  /// The position itself, and one turn either way of an axis with limits: what is nearer to the
  /// other limit leaves more to wind up.
  template <typename Add>
  void AddTurns(const Rotary& rotary, const Add& add) const {
    add(rotary);
    for (std::size_t k = 0; k < geometry_.num_rotary(); ++k) {
      const double lower = geometry_.limits().lower[k], upper = geometry_.limits().upper[k];
      if (!std::isfinite(lower) || !std::isfinite(upper)) continue;
      for (const double sense : {-kTurn, kTurn}) {
        Rotary turned = rotary;
        turned[k] += sense;
        if (turned[k] > lower - kSame && turned[k] < upper + kSame) add(turned);
      }
    }
  }

  const PartGeometry& geometry_;
  const std::vector<Eigen::Vector3d>& axes_;
  double pole_tolerance_;
};

/// The position for axis i from which most axes follow, of equals the nearest.
std::optional<Rotary> Longest(const Follower& follower, std::size_t i, const Rotary& from) {
  std::optional<Rotary> best;
  std::size_t longest = 0;
  for (const Rotary& start : follower.Starts(i, from)) {
    const std::size_t stretch = follower.Stretch(i, start);
    const bool nearer = best && stretch == longest && Travel(start, from) < Travel(*best, from);
    if (!best || stretch > longest || nearer) {
      best = start;
      longest = stretch;
    }
  }
  return longest > 0 ? best : std::nullopt;
}

std::optional<RotaryPath> Follow(const Follower& follower, std::size_t count, const Rotary& start,
                                 std::size_t* unreachable) {
  RotaryPath path;
  path.rotary.push_back(start);
  for (std::size_t i = 1; i < count; ++i) {
    auto next = follower.Next(i, path.rotary.back());
    if (!next) {
      const auto again = Longest(follower, i - 1, path.rotary.back());
      if (!again) {
        *unreachable = i;
        return std::nullopt;
      }
      path.rewinds.push_back({i - 1, path.rotary.back()});
      path.travel += Travel(*again, path.rotary.back());
      path.rotary.back() = *again;
      next = follower.Next(i, *again);
    }
    if (Distance(next->start, path.rotary.back()) > kSame) ++path.pole_turns;
    path.travel += Travel(next->start, path.rotary.back()) + Travel(next->start, next->end);
    path.rotary.push_back(next->end);
  }
  return path;
}

}  // namespace

std::vector<RotaryPath> RankRotary(const PartGeometry& geometry,
                                   const std::vector<Eigen::Vector3d>& axes_P, const Rotary& from,
                                   double pole_tolerance, std::size_t* unreachable) {
  std::vector<RotaryPath> ranked;
  if (axes_P.empty()) return ranked;
  const Follower follower(geometry, axes_P, pole_tolerance);
  std::size_t farthest = 0;
  for (const Rotary& start : follower.Starts(0, from)) {
    std::size_t stopped = 0;
    auto path = Follow(follower, axes_P.size(), start, &stopped);
    farthest = std::max(farthest, stopped);
    if (!path) continue;
    path->travel += Travel(start, from);
    ranked.push_back(std::move(*path));
  }
  if (ranked.empty()) *unreachable = farthest;
  std::stable_sort(ranked.begin(), ranked.end(), [](const RotaryPath& a, const RotaryPath& b) {
    return std::tuple(a.rewinds.size(), a.pole_turns, a.travel) <
           std::tuple(b.rewinds.size(), b.pole_turns, b.travel);
  });
  return ranked;
}

}  // namespace ncsim::post
