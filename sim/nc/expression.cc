// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/expression.h"

#include <array>
#include <cmath>
#include <limits>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::nc {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

/// No operation lets a NaN through, so that NaN on the stack can stand for "undefined".
bool Defined(double value) { return !std::isnan(value); }
double OrZero(double value) { return Defined(value) ? value : 0.0; }

/// Operands of AND, OR, XOR: "only the integer portion of the floating point number is used"
/// (manual 2017, "Logical Operators"). False beyond what a double counts exactly.
bool IntegerPart(double value, std::int64_t* integer) {
  constexpr double kLimit = 9007199254740992.0;  // 2^53
  if (!(std::abs(value) <= kLimit)) return false;
  *integer = static_cast<std::int64_t>(std::trunc(value));
  return true;
}

bool Logical(Op op, double a, double b, double* result, std::string* error) {
  std::int64_t left = 0;
  std::int64_t right = 0;
  if (!IntegerPart(a, &left) || !IntegerPart(b, &right)) {
    *error = "an operand of AND, OR or XOR is too large to be an integer";
    return false;
  }
  if (op == Op::kAnd) {
    *result = static_cast<double>(left & right);
  } else if (op == Op::kOr) {
    *result = static_cast<double>(left | right);
  } else {
    *result = static_cast<double>(left ^ right);
  }
  return true;
}

/// EQ and NE tell the undefined value from 0.
bool Equal(double a, double b) {
  if (!Defined(a) || !Defined(b)) return Defined(a) == Defined(b);
  return a == b;
}

bool Binary(Op op, double raw_a, double raw_b, double* result, std::string* error) {
  const double a = OrZero(raw_a);
  const double b = OrZero(raw_b);
  switch (op) {
    case Op::kAdd:
      *result = a + b;
      return true;
    case Op::kSubtract:
      *result = a - b;
      return true;
    case Op::kMultiply:
      *result = a * b;
      return true;
    case Op::kDivide:
    case Op::kMod:
      if (b == 0.0) {
        *error = "division by zero";
        return false;
      }
      *result = op == Op::kDivide ? a / b : std::fmod(a, b);
      return true;
    case Op::kEq:
      *result = Equal(raw_a, raw_b) ? 1.0 : 0.0;
      return true;
    case Op::kNe:
      *result = Equal(raw_a, raw_b) ? 0.0 : 1.0;
      return true;
    case Op::kGt:
      *result = a > b ? 1.0 : 0.0;
      return true;
    case Op::kLt:
      *result = a < b ? 1.0 : 0.0;
      return true;
    case Op::kGe:
      *result = a >= b ? 1.0 : 0.0;
      return true;
    case Op::kLe:
      *result = a <= b ? 1.0 : 0.0;
      return true;
    case Op::kAtan2:
      if (a == 0.0 && b == 0.0) {
        *error = "ATAN[0]/[0] has no value";
        return false;
      }
      *result = Degrees(std::atan2(a, b));
      return true;
    default:
      return Logical(op, a, b, result, error);
  }
}

bool Unary(Op op, double a, int decimals, double* result, std::string* error) {
  switch (op) {
    case Op::kSin:
      *result = std::sin(Radians(a));
      return true;
    case Op::kCos:
      *result = std::cos(Radians(a));
      return true;
    case Op::kTan:
      if (std::abs(std::remainder(a, 180.0)) == 90.0) {
        *error = "TAN[" + Short(a) + "] has no value";
        return false;
      }
      *result = std::tan(Radians(a));
      return true;
    case Op::kAsin:
    case Op::kAcos:
      if (std::abs(a) > 1.0) {
        *error =
            (op == Op::kAsin ? "ASIN[" : "ACOS[") + Short(a) + "]: the argument is outside -1 to 1";
        return false;
      }
      *result = Degrees(op == Op::kAsin ? std::asin(a) : std::acos(a));
      return true;
    case Op::kAtan:
      *result = Degrees(std::atan(a));
      return true;
    case Op::kSqrt:
      if (a < 0.0) {
        *error = "SQRT of a negative number, " + Short(a);
        return false;
      }
      *result = std::sqrt(a);
      return true;
    case Op::kAbs:
      *result = std::abs(a);
      return true;
    case Op::kRound:
      *result = std::round(a);
      return true;
    case Op::kRoundAddress: {
      const double scale = std::pow(10.0, decimals);
      *result = std::round(a * scale) / scale;
      return true;
    }
    default:
      *result = std::trunc(a);
      return true;
  }
}

/// `number` is the value in `#[number]`.
bool ReadVariable(VariableReader& variables, double number, double* result, std::string* error) {
  constexpr double kHighest = 999999.0;
  constexpr double kWholeTolerance = 1e-4;
  if (!Defined(number)) {
    *error = "the number of a variable is undefined";
    return false;
  }
  const double whole = std::round(number);
  if (!(whole >= 0.0 && whole <= kHighest) || std::abs(number - whole) > kWholeTolerance) {
    *error = "#[" + Short(number) + "] is not a variable of this control";
    return false;
  }
  const long index = static_cast<long>(whole);
  MacroValue value;
  if (index != 0 && !variables.Read(index, &value)) {
    *error = "#" + std::to_string(index) + " is not a variable of this control";
    return false;
  }
  *result = value.has_value() ? *value : kUndefined;
  return true;
}

}  // namespace

bool Evaluate(const std::vector<ExpressionCode>& code, Expression expression,
              VariableReader& variables, MacroValue* value, std::string* error) {
  std::array<double, kMaxOperands> stack{};
  std::size_t size = 0;
  for (std::uint32_t i = expression.begin; i < expression.end; ++i) {
    const ExpressionCode& step = code[i];
    if (step.op == Op::kConstant) {
      stack[size++] = step.constant;
      continue;
    }
    double& top = stack[size - 1];
    if (step.op == Op::kVariable) {
      if (!ReadVariable(variables, top, &top, error)) return false;
    } else if (step.op == Op::kNegate) {
      top = -top;
    } else if ((step.op >= Op::kAdd && step.op <= Op::kLe) || step.op == Op::kAtan2) {
      --size;
      double& left = stack[size - 1];
      if (!Binary(step.op, left, stack[size], &left, error)) return false;
    } else {
      const int decimals = step.op == Op::kRoundAddress ? variables.address_decimals() : 0;
      if (!Unary(step.op, OrZero(top), decimals, &top, error)) return false;
    }
    if (std::isinf(stack[size - 1])) {
      *error = "a value is too large for the control";
      return false;
    }
  }
  if (size == 0) {
    value->reset();
  } else if (Defined(stack[0])) {
    *value = stack[0];
  } else {
    value->reset();
  }
  return true;
}

}  // namespace ncsim::nc
