// SPDX-License-Identifier: BSD-3-Clause
// Macro expressions, compiled to postfix code; evaluated without recursion.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ncsim::nc {

struct ExpressionCode {
  std::uint8_t op = 0;  ///< Defined in expression.cc.
  double constant = 0.0;
};

/// A range of Block::code.
struct Expression {
  std::uint32_t begin = 0, end = 0;
  bool empty() const { return begin == end; }
};

/// A macro value; undefined is #0 (empty), which differs from 0.
using MacroValue = std::optional<double>;

/// Where an expression reads its variables. Returns false when the control has no such variable (an alarm).
class VariableReader {
 public:
  virtual ~VariableReader() = default;
  virtual bool Read(long number, MacroValue* value) = 0;
};

/// Evaluates; on failure returns false and says why ("division by zero", "#7999 is not a variable of this control").
bool Evaluate(const std::vector<ExpressionCode>& code, Expression expression, VariableReader& variables,
              MacroValue* value, std::string* error);

}  // namespace ncsim::nc
