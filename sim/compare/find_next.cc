// SPDX-License-Identifier: BSD-3-Clause
// Behind a stretch where two runs differ: the first place from which they go on alike.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/compare/run_compare.h"

namespace ncsim::compare {
namespace {

/// Blocks of each run that are searched, and places that are tried.
constexpr std::size_t kBlocks = 64;
constexpr std::size_t kTries = 60;

/// Ends of the pieces of a run behind a place, vertices.
std::vector<std::size_t> PieceEnds(const Run& run, double from, std::size_t most) {
  std::vector<std::size_t> ends;
  for (std::size_t chord = ChordAt(run, from); chord < run.chords() && ends.size() < most;
       ++chord) {
    const bool last = chord + 1 == run.chords() || run.pieces[chord + 1] != run.pieces[chord];
    if (last && static_cast<double>(chord + 1) > from) ends.push_back(chord + 1);
  }
  return ends;
}

/// Places on the chords [first, last) of a run that are near `pose`: of each stretch one.
std::vector<double> Nears(const Run& run, const Pose& pose, double from, std::size_t last,
                          const Radii& radii) {
  std::vector<double> places;
  bool touching = false;
  for (std::size_t chord = ChordAt(run, from); chord < last; ++chord) {
    const Interval near = Near(pose, run.vertices[chord], run.vertices[chord + 1], radii);
    if (near.empty()) {
      touching = false;
      continue;
    }
    const Pose &begin = run.vertices[chord], &end = run.vertices[chord + 1];
    const Eigen::Vector3d way = end.p - begin.p;
    const double square = way.squaredNorm();
    const double foot = square > 0.0 ? way.dot(pose.p - begin.p) / square : near.lower;
    // Not at the very edge of what is near, from which no way may lead on.
    const double aside = foot < near.lower || foot > near.upper ? 0.25 : 0.0;
    const double margin = aside * (near.upper - near.lower);
    const double place =
        std::max(from, static_cast<double>(chord) +
                           std::clamp(foot, near.lower + margin, near.upper - margin));
    const bool goes_on = touching && near.lower == 0.0;
    touching = near.upper == 1.0;
    // The way that has just been left is not a new one.
    const bool left = place == from || (static_cast<double>(chord) + near.lower <= from &&
                                        static_cast<double>(chord) + near.upper >= from);
    if (!goes_on && !left) places.push_back(place);
  }
  return places;
}

/// Both go on alike for the next block of the reference.
bool GoOnAlike(const Run& reference, const Run& tested, const Step& at, const Radii& radii) {
  const double end = static_cast<double>(tested.chords());
  const std::vector<std::size_t> ends = PieceEnds(reference, at.a, 1);
  if (ends.empty()) return Within(At(reference, at.a), At(tested, end), radii);
  const auto to = static_cast<double>(ends.front());
  const double wanted = 1.5 * Length(reference, at.a, to) + 10.0 * radii.position;
  double b = at.b, length = 0.0;
  while (b < end && length < wanted) {
    const double next = std::min(end, std::floor(b) + 1.0);
    length += Length(tested, b, next);
    b = next;
  }
  const Run ahead = Cut(reference, at.a, to);
  const Walk walk = WalkTogether(ahead, Cut(tested, at.b, b), radii);
  // The walk may end with the tested one beyond the reference's end, and the reference behind it.
  return !walk.steps.empty() &&
         Within(At(ahead, walk.steps.back().a), ahead.vertices.back(), radii) &&
         Length(ahead, walk.steps.back().a, static_cast<double>(ahead.chords())) <=
             2.0 * radii.position;
}

}  // namespace

std::vector<Step> FindNext(const Run& reference, const Run& tested, const Step& from,
                           const Radii& radii) {
  const std::vector<std::size_t> a_ends = PieceEnds(reference, from.a, kBlocks);
  const std::vector<std::size_t> b_ends = PieceEnds(tested, from.b, kBlocks);
  const std::size_t last = b_ends.empty() ? tested.chords() : b_ends.back();
  std::vector<std::pair<double, Step>> candidates;
  const auto offer = [&](double a, const Pose& pose) {
    for (const double b : Nears(tested, pose, from.b, last, radii)) {
      candidates.push_back({Length(reference, from.a, a) + Length(tested, from.b, b), {a, b}});
    }
  };
  offer(from.a, At(reference, from.a));  // A way of the tested one that leads back.
  for (const std::size_t end : a_ends) {
    offer(static_cast<double>(end), reference.vertices[end]);
    // A way of the reference that leads back, and that the tested one leaves out.
    if (Within(reference.vertices[end], At(tested, from.b), radii)) {
      candidates.push_back({Length(reference, from.a, static_cast<double>(end)),
                            {static_cast<double>(end), from.b}});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  for (std::size_t i = 0; i < std::min(kTries, candidates.size()); ++i) {
    if (GoOnAlike(reference, tested, candidates[i].second, radii)) return {candidates[i].second};
  }
  return {};
}

}  // namespace ncsim::compare
