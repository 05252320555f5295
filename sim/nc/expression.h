// SPDX-License-Identifier: BSD-3-Clause
// Macro expressions, compiled to postfix code; evaluated without recursion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ncsim::nc {

/// Operators and functions of the Haas NGC Mill Operator's Manual 2017, "Macros": "Functions",
/// "Operators".
enum class Op : std::uint8_t {
  kConstant,
  kVariable,  ///< # or #[ ]: pops a number, pushes the variable's value.
  kNegate,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kMod,
  kAnd,
  kOr,
  kXor,
  kEq,
  kNe,
  kGt,
  kLt,
  kGe,
  kLe,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan,
  kAtan2,  ///< ATAN[a]/[b].
  kSqrt,
  kAbs,
  kRound,         ///< To the nearest integer.
  kRoundAddress,  ///< ROUND inside an address: to the places of that address.
  kFix,
};

struct ExpressionCode {
  Op op = Op::kConstant;
  double constant = 0.0;
};

/// A range of Block::code.
struct Expression {
  std::uint32_t begin = 0, end = 0;
  bool empty() const { return begin == end; }
};

/// Operands that an expression may have waiting; the compiler reports one that needs more.
inline constexpr std::size_t kMaxOperands = 64;

/// A macro value; undefined is #0 (empty), which differs from 0.
using MacroValue = std::optional<double>;

/// Where an expression reads its variables.
class VariableReader {
 public:
  virtual ~VariableReader() = default;
  /// Returns false when the control has no such variable (an alarm).
  virtual bool Read(long number, MacroValue* value) = 0;
  /// Decimal places of the address that is being computed: what ROUND rounds to there. 4 for inch,
  /// 3 for mm and degrees (manual 2017, "Notes on Functions").
  virtual int address_decimals() const { return 4; }
};

/// Evaluates; on failure returns false and says why ("division by zero", "#7999 is not a variable
/// of this control"). An undefined operand counts as 0, except that EQ and NE tell it from 0, and
/// that a bare variable, or minus one, stays undefined.
bool Evaluate(const std::vector<ExpressionCode>& code, Expression expression,
              VariableReader& variables, MacroValue* value, std::string* error);

}  // namespace ncsim::nc
