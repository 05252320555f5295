// SPDX-License-Identifier: BSD-3-Clause
// A program as the motion of the tool against the part, whatever it was written in: runs of feeds,
// each a chain of chords, and the rapids between them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/base/finding.h"
#include "sim/compare/pose.h"

namespace ncsim::compare {

/// A block or record that feeds.
struct Piece {
  SourcePosition where;
  double feed = 0.0;   ///< mm/s of the tip against the part, as programmed; 0: not known.
  double slack = 0.0;  ///< mm/s: what the rounding of its ends makes of a feed that a time tells.
  bool rapid = false;  ///< Not a feed: the straight way over a gap that has been closed.
};

/// Feeds that follow each other. Chord k leads from vertex k to vertex k + 1.
struct Run {
  std::vector<Pose> vertices;
  std::vector<std::uint32_t> pieces;  ///< Of each chord: index into Toolpath::pieces.

  std::size_t chords() const { return pieces.size(); }
};

struct RapidEnd {
  SourcePosition where;
  Pose pose;
  bool turns = false;  ///< The tool axis at its start was another.
};

/// What lies between two runs.
struct Gap {
  std::vector<RapidEnd> ends;
  bool tool_change = false;
};

struct Toolpath {
  std::vector<Piece> pieces;
  std::vector<Run> runs;
  std::vector<Gap> gaps = {{}};  ///< Before run i; the last one after the last run.
  std::vector<SourcePosition> dwells;
  /// Proven: no pose of the motion lies further from its chord than this.
  Distance chord_error;
};

/// A way of the tool, s in [0, 1].
struct Curve {
  std::function<Pose(double)> at;
  /// Upper bounds of |p''(s)| and |u''(s)| anywhere: by these the chords are laid.
  Distance bend;
  /// What bend does not bound.
  double loose = 0.0;
};

/// Builds a Toolpath from motions in program order.
class ToolpathBuilder {
 public:
  /// Chords are laid so that they deviate from the motion by no more than `chord_error`.
  explicit ToolpathBuilder(const Distance& chord_error) : wanted_(chord_error) {}

  /// A feed from where the tool stands.
  void Feed(const SourcePosition& where, double feed, const Curve& curve, double slack = 0.0);
  void Rapid(const SourcePosition& where, const Pose& end);
  void ToolChange() { path_.gaps.back().tool_change = true; }
  void Dwell(const SourcePosition& where) { path_.dwells.push_back(where); }
  const Pose& pose() const { return pose_; }
  Toolpath Take();

 private:
  void AddVertex(const Pose& pose);

  const Distance wanted_;
  Toolpath path_;
  Pose pose_;
  bool feeding_ = false;
};

/// Length of a run's chords, mm, between two places on it: chord index + part of the chord.
double Length(const Run& run, double from, double to);
/// The pose at a place.
Pose At(const Run& run, double place);
/// The chord on which a place lies; the one behind it at a vertex.
std::size_t ChordAt(const Run& run, double place);
/// The part of a run between two places.
Run Cut(const Run& run, double from, double to);

}  // namespace ncsim::compare
