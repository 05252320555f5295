// SPDX-License-Identifier: BSD-3-Clause
// Where the block numbers and the O programs of a text are. Built in one pass, and only for
// programs that jump or call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/nc/program.h"

namespace ncsim::nc {

/// Place of a line.
struct TextPosition {
  std::size_t offset = 0;
  int line = 1;
};

/// One program of a text: from its O number (or the text's start) up to the next O number, the
/// closing `%`, or the end.
struct ProgramRange {
  long number = -1;  ///< O number; -1 for none.
  TextPosition begin;
  std::size_t end = 0;  ///< Offset.
};

class ProgramIndex {
 public:
  explicit ProgramIndex(const Program& program);

  /// In the order of the text; at least one.
  const std::vector<ProgramRange>& programs() const { return programs_; }
  /// The program with that O number; null for none.
  const ProgramRange* FindProgram(long number) const;
  /// The program in which `offset` lies.
  const ProgramRange& ProgramAt(std::size_t offset) const;

  enum class Search { kMissing, kFound, kAmbiguous };
  /// Block number `number` in `range`, looked for from `from` to the range's end and then from its
  /// start. kAmbiguous: it stands there more than once, and `position` is the first so found.
  Search FindBlock(long number, const ProgramRange& range, std::size_t from,
                   TextPosition* position) const;

 private:
  struct Label {
    std::uint32_t number;
    int line;
    std::size_t offset;
  };
  std::vector<ProgramRange> programs_;
  std::vector<Label> labels_;  ///< By number, then offset.
};

}  // namespace ncsim::nc
