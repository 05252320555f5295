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

/// "word" = address + value (ISO 6983). The value is a number, or an expression (`X#1`,
/// `X-[#2+1.]`).
struct Word {
  double value = 0.0;        ///< As written; 0 for an expression.
  Expression expression;     ///< Range in Block::code.
  int column = 0;            ///< From 1.
  std::uint32_t length = 0;  ///< Characters of the text.
  std::uint16_t digits = 0;  ///< Digits written, for words whose field width the control limits.
  char address = 0;          ///< Upper case.
  bool comma = false;  ///< `,R1.` or `,C1.`: corner rounding or chamfer, not the address R or C.
  bool has_point = false;  ///< The number was written with a decimal point (settings 77, 162).
  bool is_expression = false;
  bool has_value =
      true;  ///< False for a lone letter; whether that means anything is the control's.
};

enum class StatementKind : std::uint8_t {
  kWord,        ///< words[word]
  kAssignment,  ///< #target = value
  kCondition,   ///< IF [c] THEN, or the gate of `[c] M99 P1`: if false, the REST of the block is
                ///< ignored.
  kIfGoto,      ///< IF [c] GOTO n
  kGoto,        ///< GOTO n
  kWhile,       ///< WHILE [c] DO n
  kDo,          ///< DO n
  kEnd,         ///< END n
  kPrint,       ///< DPRNT[...], POPEN, PCLOS: no motion.
};

/// The parts of a block in the order in which they are written.
struct Statement {
  StatementKind kind = StatementKind::kWord;
  int column = 0;            ///< From 1.
  std::uint32_t length = 0;  ///< Characters of the text.
  int word = -1;             ///< kWord.
  int loop = 0;              ///< kWhile, kDo, kEnd: 1 to 3.
  Expression target;         ///< kAssignment: the variable number.
  Expression value;  ///< kAssignment: right side; kCondition, kIfGoto, kWhile: the condition.
  Expression label;  ///< kIfGoto, kGoto: block number.
};

/// Lower case, no full stop.
struct SyntaxError {
  int column = 0;  ///< From 1.
  std::string message;
};

/// Reused from block to block, so that reading a plain block allocates nothing.
struct Block {
  std::size_t offset = 0;     ///< Byte offset of the line in the text.
  std::size_t next = 0;       ///< Byte offset of the next line.
  int line = 0;               ///< From 1.
  bool block_delete = false;  ///< `/` stands before it.
  bool program_mark = false;  ///< A `%` line.
  long sequence = -1;         ///< N number; -1 for none.
  long program = -1;          ///< O number; -1 for none.
  std::vector<Word> words;
  std::vector<Statement> statements;       ///< Empty where the block has nothing but words.
  std::vector<ExpressionCode> code;        ///< What the Expressions of this block index.
  std::vector<std::string_view> comments;  ///< Without parentheses.
  std::vector<SyntaxError> errors;         ///< Non-empty: the block must not be executed.
  std::vector<SyntaxError> doubts;         ///< The manual leaves open what the control makes of it.
};

}  // namespace ncsim::nc
