// SPDX-License-Identifier: BSD-3-Clause
// Blocks to lines: prints what has changed, and knows what the control has from what was printed.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "post/post_data.h"

namespace ncsim::post {

/// What each group is to be; nullptr where that is not known or of no matter.
using WantedCodes = std::array<const std::string*, kGroups>;

class BlockPrinter {
 public:
  enum class Counts : std::uint8_t {
    kAnything,  ///< A line stays where any of its names prints.
    kPosition,  ///< Only coordinates keep a line: feed and codes alone are no motion.
  };

  /// `data` must outlive this.
  explicit BlockPrinter(const PostData& data);

  /// The lines of `block`. What cannot be printed as it is goes to `problems`.
  std::vector<std::string> Print(const BlockTemplate& block, const Values& values,
                                 const WantedCodes& codes, Counts counts,
                                 std::vector<std::string>* problems);
  /// A text that is printed as it is: its words are then the control's.
  void Written(std::string_view text);

  /// The control may have something else than was printed last.
  void ForgetAll();
  void ForgetPositions();
  void ForgetFeeds();
  void Forget(Value value);
  void Forget(Group group);
  /// Rotary axes and tool axis are there, by other words.
  void AxisIs(const Values& values);
  /// Spindle and coolant are off.
  void SwitchedOff();
  /// Whether the control has the wanted code of a group (where one is wanted).
  bool Has(Group group, const WantedCodes& codes) const;

 private:
  struct Line;
  class Run;
  struct Memory {
    std::vector<std::string> words;  ///< As last printed; "" where not known.
    std::array<std::string, kGroups> codes;
  };
  void Note(const WrittenWord& word);
  std::string TextOf(const WordFormat& word, const Values& values) const;
  std::string Comment(std::string_view text) const;

  const PostData& data_;
  Memory memory_;
  /// Of every code of the post, in the form of WrittenWord::code: its group and the code.
  std::vector<std::pair<std::string, std::pair<std::size_t, std::string>>> known_codes_;
};

}  // namespace ncsim::post
