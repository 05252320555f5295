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
  /// Maps a file; what cannot be mapped (a pipe) is read. A file that cannot be read, is empty, or
  /// is binary (NUL bytes) is reported; returns null then. A UTF-8 byte order mark is skipped; CR
  /// LF, LF and CR end lines alike; bytes over 127 are fine in comments. The file must not be cut
  /// short while the program is alive.
  static std::shared_ptr<const Program> Load(const std::string& path, Diagnostics* diagnostics);
  /// For tests and generated text. Takes any text.
  static std::shared_ptr<const Program> FromText(std::string name, std::string text);

  const std::string& name() const { return name_; }
  std::string_view text() const { return text_; }
  std::size_t begin() const { return begin_; }  ///< Offset of the first line.
  /// The line that starts at `offset`, without its end.
  std::string_view Line(std::size_t offset) const;
  /// The line with number `line` (from 1), for messages with a caret; "" past the end. Linear.
  std::string_view LineByNumber(int line) const;
  /// A hint that the text before `offset` is not needed soon: its pages leave this process's
  /// memory. The text stays valid.
  void Release(std::size_t offset) const;

 private:
  struct Storage;
  Program(std::string name, std::shared_ptr<const Storage> storage);

  std::string name_;
  std::shared_ptr<const Storage> storage_;
  std::string_view text_;
  std::size_t begin_ = 0;
};

/// Parses the Haas and Fanuc block syntax of the line at `offset` (whose number is `line`) into
/// `block`. Errors go into block->errors, each with a column; the parser always reaches the line's
/// end. Macro syntax and examples: Haas NGC Mill Operator's Manual 2017, "Macros (Optional)".
void ParseBlock(const Program& program, std::size_t offset, int line, Block* block);

}  // namespace ncsim::nc
