// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/align.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ncsim::compare {
namespace {

/// How many runs may be left out of both together before they are found to go on alike.
constexpr std::size_t kFarthest = 400;
/// Pairs of runs of a block that are weighed against each other.
constexpr std::size_t kMostPairs = 1'000'000;
/// Runs of each that may be alike as a whole.
constexpr std::size_t kWhole = 16;

/// Of two runs, in radii: the mean of what their ends are apart, far ones alike.
double Strangeness(const Run& a, const Run& b, const Radii& radii) {
  const auto apart = [&](const Pose& x, const Pose& y) {
    const Distance d = Between(x, y);
    return std::min(1.0, d.position / (d.position + 1000.0 * radii.position) + 0.5 * d.axis);
  };
  return 0.5 * (apart(a.vertices.front(), b.vertices.front()) +
                apart(a.vertices.back(), b.vertices.back()));
}

struct Skip {
  std::size_t a = 0, b = 0;
};

/// The least number of runs to leave out from (i, j) on, so that two go on alike.
Skip NextAlike(const std::vector<Run>& a, const std::vector<Run>& b, std::size_t i, std::size_t j,
               const Radii& radii) {
  const std::size_t rest_a = a.size() - i, rest_b = b.size() - j;
  const auto alike = [&](std::size_t x, std::size_t y) {
    return i + x < a.size() && j + y < b.size() && SameEnds(a[i + x], b[j + y], radii);
  };
  const auto goes_on = [&](std::size_t x, std::size_t y) {
    const bool end = i + x + 1 >= a.size() || j + y + 1 >= b.size();
    return alike(x, y) && (end || alike(x + 1, y + 1));
  };
  for (std::size_t sum = 1; sum <= std::min(kFarthest, rest_a + rest_b); ++sum) {
    // As many of both first.
    for (std::size_t k = 0; k <= sum; ++k) {
      const std::size_t half = (sum + 1) / 2, step = (k + 1) / 2;
      const bool up = k % 2 == 0;
      if (up ? half + step > sum : step > half) continue;
      const std::size_t x = up ? half + step : half - step;
      if (x <= rest_a && sum - x <= rest_b && goes_on(x, sum - x)) return {x, sum - x};
    }
  }
  return {rest_a, rest_b};
}

/// Runs from (i, j) on that begin and end alike as a whole, more of the one than of the other: a
/// rewind has come between. {0, 0} where there are none.
Skip AlikeAsWhole(const std::vector<Run>& a, const std::vector<Run>& b, std::size_t i,
                  std::size_t j, const Radii& radii) {
  if (i >= a.size() || j >= b.size()) return {};
  if (!Within(a[i].vertices.front(), b[j].vertices.front(), radii)) return {};
  const std::size_t most_a = std::min(kWhole, a.size() - i),
                    most_b = std::min(kWhole, b.size() - j);
  for (std::size_t sum = 3; sum <= most_a + most_b; ++sum) {
    for (std::size_t x = sum > most_b ? sum - most_b : 1; x <= std::min(most_a, sum - 1); ++x) {
      const std::size_t y = sum - x;
      if (x == y) continue;
      if (!Within(a[i + x - 1].vertices.back(), b[j + y - 1].vertices.back(), radii)) continue;
      const bool end = i + x == a.size() && j + y == b.size();
      const bool goes_on = i + x < a.size() && j + y < b.size() &&
                           Within(a[i + x].vertices.front(), b[j + y].vertices.front(), radii);
      if (end || goes_on) return {x, y};
    }
  }
  return {};
}

}  // namespace

bool SameEnds(const Run& a, const Run& b, const Radii& radii) {
  return Within(a.vertices.front(), b.vertices.front(), radii) &&
         Within(a.vertices.back(), b.vertices.back(), radii);
}

std::vector<Block> Align(const std::vector<Run>& a, const std::vector<Run>& b, const Radii& radii) {
  std::vector<Block> blocks;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && SameEnds(a[i], b[j], radii)) {
      blocks.push_back({i, i + 1, j, j + 1, true});
      ++i, ++j;
      continue;
    }
    Skip skip = AlikeAsWhole(a, b, i, j, radii);
    if (skip.a == 0) skip = NextAlike(a, b, i, j, radii);
    blocks.push_back({i, i + skip.a, j, j + skip.b, false});
    i += skip.a;
    j += skip.b;
  }
  return blocks;
}

std::vector<RunPair> PairByEnds(const std::vector<Run>& a, const std::vector<Run>& b,
                                const std::vector<std::size_t>& of_a,
                                const std::vector<std::size_t>& of_b, const Radii& radii) {
  const std::size_t n = of_a.size(), m = of_b.size();
  std::vector<RunPair> pairs;
  if (n == m || n * m > kMostPairs) {
    for (std::size_t k = 0; k < std::max(n, m); ++k) {
      pairs.push_back({k < n ? of_a[k] : RunPair::kNone, k < m ? of_b[k] : RunPair::kNone});
    }
    return pairs;
  }
  // The cheapest way to leave out runs and to pair the others (Wagner and Fischer, 1974): a pair
  // costs up to 1, what is left out half of that and a little.
  constexpr double kLeftOut = 0.51;
  std::vector<double> cost((n + 1) * (m + 1), std::numeric_limits<double>::infinity());
  const auto at = [&](std::size_t x, std::size_t y) -> double& { return cost[x * (m + 1) + y]; };
  const auto pair = [&](std::size_t x, std::size_t y) {
    return at(x - 1, y - 1) + Strangeness(a[of_a[x - 1]], b[of_b[y - 1]], radii);
  };
  at(0, 0) = 0.0;
  for (std::size_t x = 0; x <= n; ++x) {
    for (std::size_t y = 0; y <= m; ++y) {
      if (x > 0) at(x, y) = std::min(at(x, y), at(x - 1, y) + kLeftOut);
      if (y > 0) at(x, y) = std::min(at(x, y), at(x, y - 1) + kLeftOut);
      if (x > 0 && y > 0) at(x, y) = std::min(at(x, y), pair(x, y));
    }
  }
  for (std::size_t x = n, y = m; x > 0 || y > 0;) {
    const bool both = x > 0 && y > 0 && at(x, y) == pair(x, y);
    const bool left_a = !both && x > 0 && at(x, y) == at(x - 1, y) + kLeftOut;
    x -= both || left_a ? 1 : 0;
    y -= both || !left_a ? 1 : 0;
    pairs.push_back(
        {both || left_a ? of_a[x] : RunPair::kNone, both || !left_a ? of_b[y] : RunPair::kNone});
  }
  std::reverse(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<RapidEnd> CloseGaps(Toolpath* path, const Radii& radii) {
  std::vector<RapidEnd> closed;
  if (path->runs.empty()) return closed;
  std::vector<Run> runs;
  std::vector<Gap> gaps = {std::move(path->gaps.front())};
  for (std::size_t i = 0; i < path->runs.size(); ++i) {
    Run& run = path->runs[i];
    const bool goes_on = i > 0 && Within(runs.back().vertices.back(), run.vertices.front(), radii);
    if (goes_on) {
      Run& whole = runs.back();
      whole.vertices.insert(whole.vertices.end(), run.vertices.begin(), run.vertices.end());
      whole.pieces.push_back(run.pieces.front());  // from the end of one to the start of the next
      whole.pieces.insert(whole.pieces.end(), run.pieces.begin(), run.pieces.end());
      const std::vector<RapidEnd>& ends = gaps.back().ends;
      if (!ends.empty()) closed.push_back({ends.front().where, run.vertices.front()});
      gaps.back() = std::move(path->gaps[i + 1]);
      continue;
    }
    runs.push_back(std::move(run));
    gaps.push_back(std::move(path->gaps[i + 1]));
  }
  path->runs = std::move(runs);
  path->gaps = std::move(gaps);
  return closed;
}

std::vector<Rest> TakeRests(Toolpath* path, const Radii& radii) {
  std::vector<Rest> taken;
  std::vector<Run> runs;
  std::vector<Gap> gaps;
  if (!path->gaps.empty()) gaps.push_back(std::move(path->gaps.front()));
  for (std::size_t i = 0; i < path->runs.size(); ++i) {
    Run& run = path->runs[i];
    Gap& behind = path->gaps[i + 1];
    const Pose& at = run.vertices.front();
    const bool rests = std::all_of(run.vertices.begin(), run.vertices.end(),
                                   [&](const Pose& pose) { return Within(at, pose, radii); });
    if (rests) {
      gaps.back().tool_change = gaps.back().tool_change || behind.tool_change;
      gaps.back().ends.insert(gaps.back().ends.end(), behind.ends.begin(), behind.ends.end());
      taken.push_back({std::move(run), runs.size()});
      continue;
    }
    runs.push_back(std::move(run));
    gaps.push_back(std::move(behind));
  }
  path->runs = std::move(runs);
  path->gaps = std::move(gaps);
  return taken;
}

Run Join(const Toolpath& path, std::size_t begin, std::size_t end, std::vector<Piece>* pieces) {
  Run whole = path.runs[begin];
  for (std::size_t i = begin + 1; i < end; ++i) {
    const Run& run = path.runs[i];
    Piece rapid;
    const std::vector<RapidEnd>& ends = path.gaps[i].ends;
    rapid.where = ends.empty() ? (*pieces)[run.pieces.front()].where : ends.front().where;
    rapid.rapid = true;
    whole.pieces.push_back(static_cast<std::uint32_t>(pieces->size()));
    pieces->push_back(rapid);
    whole.vertices.insert(whole.vertices.end(), run.vertices.begin(), run.vertices.end());
    whole.pieces.insert(whole.pieces.end(), run.pieces.begin(), run.pieces.end());
  }
  return whole;
}

}  // namespace ncsim::compare
