// SPDX-License-Identifier: BSD-3-Clause
// Expressions of the SINUMERIK language, compiled to postfix code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ncsim::nc {

/// NC programming 12/2019, pp. 442-444.
enum class SinumerikOp : std::uint8_t {
  kReal,
  kInteger,
  kBool,
  kString,
  kOmitted,  ///< An argument that is not there: `CYCLE83(1,,3)`.
  kName,     ///< A variable, an axis or a named constant; pops `count` indices.
  kCall,     ///< A function; pops `count` arguments.
  kNegate,
  kNot,
  kBitNot,
  kToString,  ///< `<<` without a left operand.
  kMultiply,
  kDivide,  ///< REAL.
  kDiv,
  kMod,
  kAdd,
  kSubtract,
  kBitAnd,
  kBitXor,
  kBitOr,
  kAnd,
  kXor,
  kOr,
  kConcatenate,
  kEqual,
  kNotEqual,
  kGreater,
  kLess,
  kGreaterEqual,
  kLessEqual,
  kChain,  ///< `:` between frames.
};

struct SinumerikCode {
  SinumerikOp op = SinumerikOp::kReal;
  std::uint16_t count = 0;  ///< kName, kCall.
  int column = 0;           ///< From 1.
  double number = 0.0;
  std::string_view name;  ///< kName, kCall, kString; into the program's text.
};

/// A range of SinumerikBlock::code.
struct SinumerikExpression {
  std::uint32_t begin = 0, end = 0;
  bool empty() const { return begin == end; }
};

}  // namespace ncsim::nc
