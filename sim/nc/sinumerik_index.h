// SPDX-License-Identifier: BSD-3-Clause
// Where the programs of a SINUMERIK archive, the labels, the block numbers and the partners of the
// control structures are. Built in one pass, and only for programs that jump, branch or call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sim/nc/program_index.h"
#include "sim/nc/sinumerik_block.h"

namespace ncsim::nc {

/// One program of a text: behind its `%_N_NAME_MPF` line, up to the next one.
struct SinumerikSection {
  std::string name;      ///< Upper case, without `_N_` and `_MPF`; "" for a text without a header.
  bool is_main = false;  ///< `_MPF`.
  TextPosition begin;
  std::size_t end = 0;  ///< Offset.
};

/// Where the other blocks of a control structure stand. For IF: ELSE, if there is one, and ENDIF;
/// for ELSE: ENDIF; for a loop's first block: its last one; for that: the first.
struct SinumerikPartner {
  TextPosition other;
  std::optional<TextPosition> else_block;
  std::string error;  ///< Instead: why there is none, with the alarm.
};

class SinumerikIndex {
 public:
  explicit SinumerikIndex(const Program& program);

  /// In the order of the text; at least one.
  const std::vector<SinumerikSection>& sections() const { return sections_; }
  /// By upper case name; null for none.
  const SinumerikSection* Find(std::string_view name) const;
  const SinumerikSection& SectionAt(std::size_t offset) const;

  /// The first block with that label (any case) or number (`N100`, `:100`) at or behind `from`, up
  /// to `end`; nullopt for none.
  std::optional<TextPosition> FindForward(std::string_view label, std::size_t from,
                                          std::size_t end) const;
  /// The last one before `from`, from `begin` on.
  std::optional<TextPosition> FindBackward(std::string_view label, std::size_t begin,
                                           std::size_t from) const;
  /// Of the control structure whose block stands at `offset`; null: no control structure there.
  const SinumerikPartner* Partner(std::size_t offset) const;

 private:
  /// `number` of a block number; 0 for a label. Small, as long programs number every block.
  struct Place {
    std::uint32_t number;
    int line;
    std::size_t offset;
  };
  static bool IsBefore(const Place& place, std::size_t offset) { return place.offset < offset; }
  struct Open {
    SinumerikPartKind kind;
    TextPosition at;
    std::optional<TextPosition> else_block;
  };
  void AddLine(const Program& program, TextPosition at);
  void AddStructure(SinumerikPartKind kind, TextPosition at);
  void Close(std::size_t end);
  /// All places of a label or number, by offset.
  std::span<const Place> Places(std::string_view label) const;

  std::vector<SinumerikSection> sections_;
  std::map<std::string, std::vector<Place>, std::less<>> labels_;
  std::vector<Place> numbers_;  ///< By number, then offset.
  std::unordered_map<std::size_t, SinumerikPartner> partners_;
  std::vector<Open> open_;
  SinumerikBlock block_;
};

}  // namespace ncsim::nc
