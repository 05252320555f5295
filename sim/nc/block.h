// SPDX-License-Identifier: BSD-3-Clause
// A block as it stands in the text: syntax only, lossless in position; no semantics, no machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/nc/expression.h"

namespace ncsim::nc {

/// "word" = address + value (ISO 6983). The value is a number, or an expression (`X#1`, `X-[#2+1.]`).
struct Word {
  char address = 0;       ///< Upper case.
  bool has_point = false; ///< The number was written with a decimal point (settings 77, 162).
  bool is_expression = false;
  bool has_value = true;  ///< False for a lone letter.
  std::uint16_t digits = 0;  ///< Digits written, for words whose field width the control limits.
  int column = 0;         ///< From 1.
  double value = 0.0;     ///< As written; undefined for an expression.
  Expression expression;  ///< Range in Block::code.
};

enum class StatementKind : std::uint8_t {
  kWord,        ///< words[index]
  kAssignment,  ///< #target = value
  kCondition,   ///< IF [c] THEN: if false, the REST of the block is ignored. Also the gate of `[c] M99 P1`.
  kIfGoto,      ///< IF [c] GOTO n
  kGoto,
  kWhile,       ///< WHILE [c] DO n
  kDo,          ///< DO n
  kEnd,         ///< END n
  kPrint,       ///< DPRNT[...], POPEN, PCLOS: no motion
};

/// The parts of a block in the order in which they are written.
struct Statement {
  StatementKind kind = StatementKind::kWord;
  int column = 0;
  int word = -1;           ///< kWord.
  Expression target;       ///< kAssignment: the variable number.
  Expression value;        ///< kAssignment: right side; kCondition, kIfGoto, kWhile: the condition.
  Expression label;        ///< kIfGoto, kGoto: block number; kWhile, kDo, kEnd: loop number.
};

struct SyntaxError {
  int column = 0;
  std::string message;
};

/// Reused from block to block, so that reading a plain block allocates nothing.
struct Block {
  std::size_t offset = 0;  ///< Byte offset of the line in the text.
  std::size_t next = 0;    ///< Byte offset of the next line.
  int line = 0;            ///< From 1.
  bool block_delete = false;
  bool program_mark = false;  ///< A `%` line.
  long sequence = -1;      ///< N number; -1 for none.
  long program = -1;       ///< O number; -1 for none.
  std::vector<Word> words;
  std::vector<Statement> statements;
  std::vector<ExpressionCode> code;      ///< What the Expressions of this block index.
  std::vector<std::string_view> comments;  ///< Without parentheses.
  std::vector<SyntaxError> errors;         ///< Non-empty: the block must not be executed.
};

}  // namespace ncsim::nc
