// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/toolpath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ncsim::compare {
namespace {

/// Chords of one piece: beyond it the chords are as they are, and the error says so.
constexpr double kMostChords = 1e6;
/// A step (mm, and of the unit vector) that is no motion: rounding of the kinematics.
constexpr double kRests = 1e-9;

/// A function with |f''| <= bend lies within bend h^2 / 8 of its chord over a step h of s (linear
/// interpolation, e.g. Stoer and Bulirsch, Numerical Analysis, section 2.1.4).
double ChordError(double bend, double chords) { return bend / (8.0 * chords * chords); }

double ChordsFor(double bend, double error) {
  return bend > 0.0 ? std::ceil(std::sqrt(bend / (8.0 * error))) : 1.0;
}

}  // namespace

void ToolpathBuilder::AddVertex(const Pose& pose) {
  Run& run = path_.runs.back();
  const Distance step = Between(run.vertices.back(), pose);
  if (step.position < kRests && step.axis < kRests) return;
  run.vertices.push_back(pose);
  run.pieces.push_back(static_cast<std::uint32_t>(path_.pieces.size() - 1));
}

void ToolpathBuilder::Feed(const SourcePosition& where, double feed, const Curve& curve,
                           double slack) {
  double chords = std::max({1.0, ChordsFor(curve.bend.position, wanted_.position),
                            ChordsFor(curve.bend.axis, wanted_.axis)});
  if (!(chords <= kMostChords)) chords = kMostChords;
  Distance& error = path_.chord_error;
  error.position = std::max(error.position, ChordError(curve.bend.position, chords) + curve.loose);
  error.axis = std::max(error.axis, ChordError(curve.bend.axis, chords));
  if (!feeding_) {
    path_.runs.emplace_back();
    path_.runs.back().vertices.push_back(curve.at(0.0));
  }
  path_.pieces.push_back({where, feed, slack, false});
  const auto count = static_cast<int>(chords);
  for (int i = 1; i <= count; ++i) AddVertex(curve.at(static_cast<double>(i) / chords));
  pose_ = curve.at(1.0);
  const bool empty = path_.runs.back().chords() == 0;
  if (empty) path_.runs.pop_back();
  if (!empty && !feeding_) path_.gaps.emplace_back();
  feeding_ = !empty;
}

void ToolpathBuilder::Rapid(const SourcePosition& where, const Pose& end) {
  const Distance step = Between(pose_, end);
  if (step.position < kRests && step.axis < kRests) return;
  path_.gaps.back().ends.push_back({where, end, step.axis >= kRests});
  pose_ = end;
  feeding_ = false;
}

Toolpath ToolpathBuilder::Take() { return std::exchange(path_, {}); }

std::size_t ChordAt(const Run& run, double place) {
  return std::min(static_cast<std::size_t>(std::max(place, 0.0)), run.chords() - 1);
}

Pose At(const Run& run, double place) {
  const std::size_t chord = ChordAt(run, place);
  return Lerp(run.vertices[chord], run.vertices[chord + 1], place - static_cast<double>(chord));
}

double Length(const Run& run, double from, double to) {
  const std::size_t first = ChordAt(run, from), last = ChordAt(run, to);
  const auto on_chord = [&](std::size_t chord, double s0, double s1) {
    return (s1 - s0) * (run.vertices[chord + 1].p - run.vertices[chord].p).norm();
  };
  const double s0 = from - static_cast<double>(first), s1 = to - static_cast<double>(last);
  if (first == last) return on_chord(first, s0, s1);
  double length = on_chord(first, s0, 1.0) + on_chord(last, 0.0, s1);
  for (std::size_t chord = first + 1; chord < last; ++chord) length += on_chord(chord, 0.0, 1.0);
  return length;
}

Run Cut(const Run& run, double from, double to) {
  const std::size_t first = ChordAt(run, from);
  Run cut;
  cut.vertices.push_back(At(run, from));
  for (std::size_t chord = first; chord < run.chords() && static_cast<double>(chord) < to;
       ++chord) {
    cut.vertices.push_back(static_cast<double>(chord + 1) <= to ? run.vertices[chord + 1]
                                                                : At(run, to));
    cut.pieces.push_back(run.pieces[chord]);
  }
  if (cut.pieces.empty()) {
    cut.vertices.push_back(cut.vertices.front());
    cut.pieces.push_back(run.pieces[first]);
  }
  return cut;
}

}  // namespace ncsim::compare
