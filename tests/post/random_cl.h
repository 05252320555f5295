// SPDX-License-Identifier: BSD-3-Clause
// Cutter-location files of random motion, in the words of NX: the same text for a seed anywhere.
#pragma once

#include <cstdint>
#include <string>

namespace ncsim::posting {

/// What the motion of a file may be.
struct RandomMotion {
  bool tilts = false;       ///< Tool axes other than Z; else three axes.
  bool turns = false;       ///< Feeds turn the tool axis,
  bool poles = true;        ///< to Z and through it too,
  bool beside_pole = true;  ///< and close by it, where a table must be quick.
  bool holes = false;       ///< Cycles.
  bool winds = false;       ///< A tool axis goes round more often than a table may.
  double feed = 400.0;      ///< mm/min, the greatest.
  int operations = 3;
  int moves = 14;  ///< Of an operation.
};

/// Tips lie within 60 mm of Z and 15 to 95 mm above the part's zero, tool axes at most 88 degrees
/// from Z: great circles between them stay there.
std::string RandomCl(std::uint64_t seed, const RandomMotion& motion);

}  // namespace ncsim::posting
