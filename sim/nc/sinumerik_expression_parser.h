// SPDX-License-Identifier: BSD-3-Clause
// Internal to sim/nc: the text of a SINUMERIK expression -> postfix code.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/nc/scanner.h"
#include "sim/nc/sinumerik_block.h"

namespace ncsim::nc {

/// Compiles into the block's code. A function that returns false has added one error to the block;
/// the scanner then stands somewhere in the line.
class SinumerikExpressionParser {
 public:
  SinumerikExpressionParser(Scanner* scanner, SinumerikBlock* block)
      : scanner_(*scanner), block_(*block) {}

  /// Up to where no operator follows.
  bool Parse(SinumerikExpression* expression);
  /// One constant or name, with its sign: a branch of CASE.
  bool ParseConstant(SinumerikExpression* expression);
  /// Behind an opening bracket, up to and past `close`: the expressions between the commas, empty
  /// ones for what is omitted.
  bool ParseList(char close, std::uint32_t* first, std::uint32_t* count);
  /// Adds an error; returns false.
  bool Fail(int column, int alarm, std::string message);

 private:
  struct Operator {
    SinumerikOp op = SinumerikOp::kReal;
    int priority = -1;     ///< -1: no operator here.
    std::size_t size = 0;  ///< Characters.
  };

  Operator PeekOperator() const;
  bool ParseBinary(int lowest, bool sign_allowed);
  bool ParseUnary(bool sign_allowed);
  bool ParseOperand();
  bool ParseNamed(std::string_view name, int column);
  bool ParseInner(char close, std::uint16_t* count);
  bool Emit(const SinumerikCode& code);
  bool EmitNumber(const std::string& error, double value, bool is_integer, int column);

  Scanner& scanner_;
  SinumerikBlock& block_;
  int depth_ = 0;
};

/// "X", "X1", "_VAR", "$AA_IM": a letter with digits, or a name; "" where none stands here.
std::string_view PeekOperandName(const Scanner& scanner);

}  // namespace ncsim::nc
