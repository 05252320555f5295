// SPDX-License-Identifier: BSD-3-Clause
// Internal to sim/nc: one line of text -> Block. Words, comments and what stands before them are in
// block.cc, macro statements in statement.cc.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/nc/block.h"
#include "sim/nc/scanner.h"

namespace ncsim::nc {

class BlockParser {
 public:
  BlockParser(std::string_view text, std::size_t offset, int line, Block* block)
      : scanner_(text, offset), block_(*block) {
    block_.offset = offset;
    block_.line = line;
  }

  /// From the start of a line to the start of the next; block->errors has what went wrong.
  void Parse();

 private:
  void ParseLine();
  void ParsePart();
  void Fail(int column, std::string message);
  /// For an error after which the rest of the line has no meaning.
  void FailLine(int column, std::string message);

  // block.cc
  void ParseProgramMark();
  void ParseLetter();
  void ParseNumberWord(char address, int column, bool comma);
  void ParseValue(char address, int column, bool comma);
  void ParseExpressionWord(char address, int column, bool comma, bool negative);
  void ParseLoneLetter(char address, int column, bool comma);
  void ParseSequence();
  void ParseProgramNumber();
  bool ReadLabel(char address, int max_digits, long* number);
  void ParseCommaWord();
  void ParseComment();
  void ParseEndOfBlock();
  void AddWord(const Word& word);
  void CheckRepeats();

  // statement.cc
  bool ParseKeyword();
  void ParseAssignment();
  void ParseGate();
  void ParseIf(int column);
  void ParseGoto(StatementKind kind, int column, Expression condition);
  void ParseWhile(int column);
  void ParseLoop(StatementKind kind, int column, Expression condition);
  void ParsePrint(int column);
  bool ParseCondition(Expression* condition);
  Statement& AddStatement(StatementKind kind, int column);
  void CheckStatements();
  void CheckPlace(const Statement& statement, std::size_t index);

  std::uint32_t LengthFrom(int column) const {
    return static_cast<std::uint32_t>(scanner_.column() - column);
  }

  Scanner scanner_;
  Block& block_;
  std::uint32_t seen_ = 0;      ///< Addresses of the block, a bit a letter.
  std::uint32_t repeated_ = 0;  ///< Those that came again.
};

}  // namespace ncsim::nc
