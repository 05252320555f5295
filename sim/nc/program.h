// SPDX-License-Identifier: BSD-3-Clause
// The text of an NC program. Mapped, not copied: private memory does not grow with its length.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "sim/base/diagnostics.h"
#include "sim/nc/block.h"

namespace ncsim::nc {

class Program {
 public:
  /// Maps a file. A file that cannot be read, is empty, or is binary (NUL bytes) is reported; returns null then. A UTF-8
  /// byte order mark is skipped; CR LF, LF and CR end lines alike; bytes over 127 are fine in comments.
  static std::shared_ptr<const Program> Load(const std::string& path, Diagnostics* diagnostics);
  /// For tests and generated text.
  static std::shared_ptr<const Program> FromText(std::string name, std::string text);

  const std::string& name() const { return name_; }
  std::string_view text() const { return text_; }
  std::size_t begin() const { return begin_; }  ///< Offset of the first line.
  /// The line that starts at `offset`, without its end.
  std::string_view Line(std::size_t offset) const;
  /// The line with number `line` (from 1), for messages with a caret. Linear.
  std::string_view LineByNumber(int line) const;

 private:
  struct Mapping;
  std::string name_;
  std::shared_ptr<Mapping> mapping_;
  std::string_view text_;
  std::size_t begin_ = 0;
};

/// Parses the Haas and Fanuc block syntax of the line at `offset` (whose number is `line`) into `block`. Errors go into
/// block->errors, in full sentences with a column; the parser always reaches the line's end.
void ParseBlock(const Program& program, std::size_t offset, int line, Block* block);

}  // namespace ncsim::nc
