// SPDX-License-Identifier: BSD-3-Clause
#include "post/rotary_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "sim/base/units.h"

namespace ncsim::post {
namespace {

constexpr double kSame = 1e-9;  // rad
/// Where to rewind: as late as can be, and earlier in the stretch since the last rewind, where
/// check finds that in the way.
constexpr std::array<double, 4> kEarlier = {0.0, 0.25, 0.5, 0.75};

double Distance(const Rotary& a, const Rotary& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

bool SamePlaces(const RotaryPath& a, const RotaryPath& b) {
  return std::equal(a.rewinds.begin(), a.rewinds.end(), b.rewinds.begin(), b.rewinds.end(),
                    [](const auto& x, const auto& y) { return x.at == y.at; });
}

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

/// From axis to axis: where the turn at the pole before the motion ends, and where the motion does.
using Steps = std::vector<PartGeometry::Way>;

/// Rewinds where the limit is met, or `earlier` (0 to 1) of the way back to the last rewind.
std::optional<RotaryPath> Follow(const Follower& follower, std::size_t count, const Rotary& start,
                                 double earlier, std::size_t* unreachable) {
  RotaryPath path;
  Steps steps{{start, start}};
  while (steps.size() < count) {
    const std::size_t i = steps.size();
    if (const auto next = follower.Next(i, steps.back().end)) {
      steps.push_back(*next);
      continue;
    }
    const std::size_t since = path.rewinds.empty() ? 0 : path.rewinds.back().at;
    std::size_t at = i - 1 - static_cast<std::size_t>(earlier * static_cast<double>(i - 1 - since));
    auto again = Longest(follower, at, steps[at].end);
    if (at < i - 1 && (!again || at + follower.Stretch(at, *again) < i)) {
      at = i - 1;  // The earlier place leads no further.
      again = Longest(follower, at, steps[at].end);
    }
    if (!again) {
      *unreachable = i;
      return std::nullopt;
    }
    steps.resize(at + 1);
    path.rewinds.push_back({at, steps[at].end});
    steps[at].end = *again;
  }
  auto rewind = path.rewinds.begin();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Rotary arrived = steps[i].end;
    if (rewind != path.rewinds.end() && rewind->at == i) {
      arrived = rewind->before;
      path.travel += Travel(arrived, steps[i].end);
      ++rewind;
    }
    if (i > 0) {
      const Rotary& last = steps[i - 1].end;
      if (Distance(steps[i].start, last) > kSame) ++path.pole_turns;
      path.travel += Travel(steps[i].start, last) + Travel(steps[i].start, arrived);
    }
    path.rotary.push_back(steps[i].end);
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
    for (const double earlier : kEarlier) {
      std::size_t stopped = 0;
      auto path = Follow(follower, axes_P.size(), start, earlier, &stopped);
      farthest = std::max(farthest, stopped);
      if (!path) break;
      path->earlier = earlier;
      path->travel += Travel(start, from);
      const bool known = std::any_of(ranked.begin(), ranked.end(), [&](const RotaryPath& other) {
        return SamePlaces(other, *path) && Distance(other.rotary[0], start) < kSame;
      });
      if (known) continue;
      ranked.push_back(std::move(*path));
      if (ranked.back().rewinds.empty()) break;
    }
  }
  if (ranked.empty()) *unreachable = farthest;
  std::stable_sort(ranked.begin(), ranked.end(), [](const RotaryPath& a, const RotaryPath& b) {
    return std::tuple(a.rewinds.size(), a.pole_turns, a.earlier, a.travel) <
           std::tuple(b.rewinds.size(), b.pole_turns, b.earlier, b.travel);
  });
  return ranked;
}

}  // namespace ncsim::post
