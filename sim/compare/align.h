// SPDX-License-Identifier: BSD-3-Clause
// Which run of one program is which of the other: in order, by where they begin and end.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/compare/toolpath.h"

namespace ncsim::compare {

/// Runs [a0, a1) of one and [b0, b1) of the other belong together. One of each with the same ends;
/// or a stretch in which the programs differ.
struct Block {
  std::size_t a0 = 0, a1 = 0, b0 = 0, b1 = 0;
  bool same_ends = false;
};

bool SameEnds(const Run& a, const Run& b, const Radii& radii);

/// All runs of both, in order.
std::vector<Block> Align(const std::vector<Run>& a, const std::vector<Run>& b, const Radii& radii);

/// A run of each; kNone where one has no partner.
struct RunPair {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t a = kNone, b = kNone;
};

/// Pairs runs, given by their indices, so that their ends lie near each other. In order.
std::vector<RunPair> PairByEnds(const std::vector<Run>& a, const std::vector<Run>& b,
                                const std::vector<std::size_t>& of_a,
                                const std::vector<std::size_t>& of_b, const Radii& radii);

/// Joins runs where the second begins where the first ends: what lies between them leads back to
/// where it began, and the feed goes on. Returns the first rapid of each such gap, with the pose
/// where the feed was left.
std::vector<RapidEnd> CloseGaps(Toolpath* path, const Radii& radii);

/// A run that is shorter than the tolerance, and before which of the others it stood.
struct Rest {
  Run run;
  std::size_t before = 0;
};

/// Takes out runs that are shorter than the tolerance: where points are rounded they may fall away,
/// or grow beyond it.
std::vector<Rest> TakeRests(Toolpath* path, const Radii& radii);

/// Runs [begin, end) as one, each gap closed by a straight rapid, for which `pieces` gets entries.
Run Join(const Toolpath& path, std::size_t begin, std::size_t end, std::vector<Piece>* pieces);

}  // namespace ncsim::compare
