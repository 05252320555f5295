// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_value.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "sim/base/text.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::nc {
namespace {

bool IsInteger(const SinumerikValue& value) {
  return value.type == SinumerikType::kInt || value.type == SinumerikType::kChar ||
         value.type == SinumerikType::kBool;
}

bool InIntRange(double value) { return value >= -kMaxInteger - 1.0 && value <= kMaxInteger; }

std::string WrongTypes(std::string_view operation, const SinumerikValue& a,
                       const SinumerikValue& b) {
  return AlarmText(12150, "the operation " + std::string(operation) + " takes no " +
                              std::string(ToString(a.is_number() ? b.type : a.type)));
}

std::string Checked(double value, bool is_integer, SinumerikValue* result) {
  if (!std::isfinite(value) || (is_integer && !InIntRange(value))) {
    return AlarmText(14051, "the result is out of range");
  }
  *result = is_integer ? SinumerikValue::Int(value) : SinumerikValue::Real(value);
  return "";
}

std::string Arithmetic(SinumerikOp op, const SinumerikValue& a, const SinumerikValue& b,
                       SinumerikValue* result) {
  if (!a.is_number() || !b.is_number()) return WrongTypes("of arithmetic", a, b);
  const bool integer = IsInteger(a) && IsInteger(b);
  const double x = a.number;
  const double y = b.number;
  switch (op) {
    case SinumerikOp::kAdd:
      return Checked(x + y, integer, result);
    case SinumerikOp::kSubtract:
      return Checked(x - y, integer, result);
    case SinumerikOp::kMultiply:
      return Checked(x * y, integer, result);
    default:
      break;
  }
  if (y == 0.0) return AlarmText(14051, "division by zero");
  if (op == SinumerikOp::kDivide) return Checked(x / y, false, result);
  if (op == SinumerikOp::kDiv) return Checked(std::trunc(x / y), true, result);
  return Checked(std::fmod(x, y), integer, result);
}

std::string Logical(SinumerikOp op, const SinumerikValue& a, const SinumerikValue& b,
                    SinumerikValue* result) {
  if (!a.is_number() || !b.is_number()) return WrongTypes("AND, OR or XOR", a, b);
  const bool x = a.number != 0.0;
  const bool y = b.number != 0.0;
  const bool value = op == SinumerikOp::kAnd ? x && y : op == SinumerikOp::kOr ? x || y : x != y;
  *result = SinumerikValue::Bool(value);
  return "";
}

std::string Bits(const SinumerikValue& value, std::int32_t* bits) {
  SinumerikValue integer;
  const std::string error = value.is_number() ? Convert(value, SinumerikType::kInt, &integer)
                                              : WrongTypes("on bits", value, value);
  if (error.empty()) *bits = static_cast<std::int32_t>(integer.number);
  return error;
}

std::string Bitwise(SinumerikOp op, const SinumerikValue& a, const SinumerikValue& b,
                    SinumerikValue* result) {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::string error = Bits(a, &x);
  if (error.empty()) error = Bits(b, &y);
  if (!error.empty()) return error;
  const std::int32_t value = op == SinumerikOp::kBitAnd  ? (x & y)
                             : op == SinumerikOp::kBitOr ? (x | y)
                                                         : (x ^ y);
  *result = SinumerikValue::Int(value);
  return "";
}

/// -1, 0, 1.
int Order(const SinumerikValue& a, const SinumerikValue& b) {
  if (!a.is_number()) return std::clamp(a.text.compare(b.text), -1, 1);
  const bool integer = IsInteger(a) && IsInteger(b);
  if (integer ? a.number == b.number : RelativelyEqual(a.number, b.number)) return 0;
  return a.number < b.number ? -1 : 1;
}

std::string Compare(SinumerikOp op, const SinumerikValue& a, const SinumerikValue& b,
                    SinumerikValue* result) {
  const bool comparable = a.is_number() ? b.is_number() : a.type == b.type;
  if (!comparable || a.type == SinumerikType::kFrame) return WrongTypes("of comparison", a, b);
  const int order = Order(a, b);
  bool holds = false;
  switch (op) {
    case SinumerikOp::kEqual:
      holds = order == 0;
      break;
    case SinumerikOp::kNotEqual:
      holds = order != 0;
      break;
    case SinumerikOp::kGreater:
      holds = order > 0;
      break;
    case SinumerikOp::kLess:
      holds = order < 0;
      break;
    case SinumerikOp::kGreaterEqual:
      holds = order >= 0;
      break;
    default:
      holds = order <= 0;
      break;
  }
  *result = SinumerikValue::Bool(holds);
  return "";
}

std::string Chain(const SinumerikValue& a, const SinumerikValue& b, SinumerikValue* result) {
  constexpr std::size_t kMaxChain = 64;
  if (a.type != SinumerikType::kFrame || b.type != SinumerikType::kFrame) {
    return AlarmText(12180, "':' chains frames only");
  }
  SinumerikFrame frame;
  for (const SinumerikValue* value : {&a, &b}) {
    if (!value->frame) continue;
    frame.chain.insert(frame.chain.end(), value->frame->chain.begin(), value->frame->chain.end());
  }
  if (frame.chain.size() > kMaxChain) return AlarmText(12540, "too long a chain of frames");
  *result = SinumerikValue::Frame(std::move(frame));
  return "";
}

std::string Join(std::string text, SinumerikValue* result) {
  if (text.size() > kMaxString) {
    return AlarmText(12210, "the string has more than 200 characters");
  }
  *result = SinumerikValue::String(std::move(text));
  return "";
}

}  // namespace

SinumerikValue SinumerikValue::Real(double value) {
  SinumerikValue result;
  result.number = value;
  return result;
}

SinumerikValue SinumerikValue::Int(double value) {
  SinumerikValue result = Real(value);
  result.type = SinumerikType::kInt;
  return result;
}

SinumerikValue SinumerikValue::Bool(bool value) {
  SinumerikValue result = Real(value ? 1.0 : 0.0);
  result.type = SinumerikType::kBool;
  return result;
}

SinumerikValue SinumerikValue::String(std::string value) {
  SinumerikValue result;
  result.type = SinumerikType::kString;
  result.text = std::move(value);
  return result;
}

SinumerikValue SinumerikValue::Axis(std::string name) {
  SinumerikValue result = String(std::move(name));
  result.type = SinumerikType::kAxis;
  return result;
}

SinumerikValue SinumerikValue::Frame(SinumerikFrame frame) {
  SinumerikValue result;
  result.type = SinumerikType::kFrame;
  result.frame = std::make_shared<const SinumerikFrame>(std::move(frame));
  return result;
}

SinumerikValue SinumerikValue::Omitted() {
  SinumerikValue result;
  result.omitted = true;
  return result;
}

SinumerikValue SinumerikValue::Default(SinumerikType type) {
  SinumerikValue result;
  result.type = type;
  return result;
}

bool RelativelyEqual(double a, double b) {
  constexpr double kRelative = 1e-12;
  return a == b || std::abs(a - b) <= kRelative * std::max(std::abs(a), std::abs(b));
}

std::string Convert(const SinumerikValue& value, SinumerikType type, SinumerikValue* converted) {
  if (value.type == type) {
    *converted = value;
    return "";
  }
  const SinumerikValue result = SinumerikValue::Default(type);
  if (type == SinumerikType::kString && value.type == SinumerikType::kChar) {
    *converted = SinumerikValue::String(std::string(1, static_cast<char>(value.number)));
    return "";
  }
  if (type == SinumerikType::kChar && value.type == SinumerikType::kString &&
      value.text.size() == 1) {
    *converted = result;
    converted->number = static_cast<unsigned char>(value.text[0]);
    return "";
  }
  if (!value.is_number() || !result.is_number()) {
    return AlarmText(
        12150, "a " + std::string(ToString(value.type)) + " is no " + std::string(ToString(type)));
  }
  double number = value.number;
  switch (type) {
    case SinumerikType::kBool:
      number = number != 0.0 ? 1.0 : 0.0;
      break;
    case SinumerikType::kChar:
    case SinumerikType::kInt: {
      number = std::round(number);
      const bool fits =
          type == SinumerikType::kInt ? InIntRange(number) : number >= 0.0 && number <= 255.0;
      if (!fits)
        return AlarmText(12160, "the value is beyond the range of " + std::string(ToString(type)));
      break;
    }
    default:
      break;
  }
  *converted = result;
  converted->number = number;
  return "";
}

std::string ToText(const SinumerikValue& value) {
  constexpr int kDecimals = 10;
  switch (value.type) {
    case SinumerikType::kString:
    case SinumerikType::kAxis:
      return value.text;
    case SinumerikType::kFrame:
      return "";
    case SinumerikType::kChar:
      return std::string(1, static_cast<char>(value.number));
    default:
      return Short(value.number, kDecimals);
  }
}

std::string ApplyUnary(SinumerikOp op, const SinumerikValue& a, SinumerikValue* result) {
  if (op == SinumerikOp::kToString) {
    if (a.type == SinumerikType::kFrame) return WrongTypes("<<", a, a);
    return Join(ToText(a), result);
  }
  if (!a.is_number()) return WrongTypes("with one operand", a, a);
  switch (op) {
    case SinumerikOp::kNegate:
      return Checked(-a.number, IsInteger(a), result);
    case SinumerikOp::kNot:
      *result = SinumerikValue::Bool(a.number == 0.0);
      return "";
    default: {
      std::int32_t bits = 0;
      std::string error = Bits(a, &bits);
      if (error.empty()) *result = SinumerikValue::Int(~bits);
      return error;
    }
  }
}

std::string ApplyBinary(SinumerikOp op, const SinumerikValue& a, const SinumerikValue& b,
                        SinumerikValue* result) {
  switch (op) {
    case SinumerikOp::kMultiply:
    case SinumerikOp::kDivide:
    case SinumerikOp::kDiv:
    case SinumerikOp::kMod:
    case SinumerikOp::kAdd:
    case SinumerikOp::kSubtract:
      return Arithmetic(op, a, b, result);
    case SinumerikOp::kBitAnd:
    case SinumerikOp::kBitXor:
    case SinumerikOp::kBitOr:
      return Bitwise(op, a, b, result);
    case SinumerikOp::kAnd:
    case SinumerikOp::kXor:
    case SinumerikOp::kOr:
      return Logical(op, a, b, result);
    case SinumerikOp::kConcatenate:
      if (a.type == SinumerikType::kFrame || b.type == SinumerikType::kFrame) {
        return WrongTypes("<<", a, b);
      }
      return Join(ToText(a) + ToText(b), result);
    case SinumerikOp::kChain:
      return Chain(a, b, result);
    default:
      return Compare(op, a, b, result);
  }
}

namespace {

/// The values that wait while postfix code is run.
class Stack {
 public:
  Stack(SinumerikReader& reader, SinumerikFault* fault) : reader_(reader), fault_(*fault) {}

  bool Run(const SinumerikCode& code) {
    fault_ = {};
    fault_.column = code.column;
    switch (code.op) {
      case SinumerikOp::kReal:
        return Push(SinumerikValue::Real(code.number));
      case SinumerikOp::kInteger:
        return Push(SinumerikValue::Int(code.number));
      case SinumerikOp::kBool:
        return Push(SinumerikValue::Bool(code.number != 0.0));
      case SinumerikOp::kString:
        return Push(SinumerikValue::String(std::string(code.name)));
      case SinumerikOp::kOmitted:
        return Push(SinumerikValue::Omitted());
      case SinumerikOp::kName:
        return Name(code);
      case SinumerikOp::kCall:
        return Call(code);
      case SinumerikOp::kNegate:
      case SinumerikOp::kNot:
      case SinumerikOp::kBitNot:
      case SinumerikOp::kToString:
        return Done(ApplyUnary(code.op, values_.back(), &values_.back()));
      default:
        break;
    }
    const SinumerikValue right = std::move(values_.back());
    values_.pop_back();
    SinumerikValue result;
    const std::string error = ApplyBinary(code.op, values_.back(), right, &result);
    values_.back() = std::move(result);
    return Done(error);
  }
  SinumerikValue& top() { return values_.back(); }

 private:
  bool Push(SinumerikValue value) {
    values_.push_back(std::move(value));
    return true;
  }
  bool Done(const std::string& error) {
    fault_.message = error;
    return error.empty();
  }
  std::vector<SinumerikValue> Take(std::size_t count) {
    const auto first = values_.end() - static_cast<std::ptrdiff_t>(count);
    std::vector<SinumerikValue> taken(std::make_move_iterator(first),
                                      std::make_move_iterator(values_.end()));
    values_.erase(first, values_.end());
    return taken;
  }
  bool Name(const SinumerikCode& code) {
    const std::vector<SinumerikValue> indices = Take(code.count);
    SinumerikValue value;
    for (const SinumerikValue& index : indices) {
      if (index.omitted) return Done(AlarmText(12410, "an index is missing"));
    }
    return reader_.ReadName(code.name, indices, &value, &fault_) && Push(std::move(value));
  }
  bool Call(const SinumerikCode& code) {
    const std::vector<SinumerikValue> arguments = Take(code.count);
    SinumerikValue value;
    const SinumerikFunction* function = FindSinumerikFunction(code.name);
    if (function == nullptr) {
      return reader_.CallFunction(code.name, arguments, &value, &fault_) && Push(std::move(value));
    }
    bool omitted = false;
    for (const SinumerikValue& argument : arguments) omitted = omitted || argument.omitted;
    if (omitted || arguments.size() < function->least || arguments.size() > function->most) {
      return Done(
          AlarmText(14020, std::string(function->name) + " has the wrong number of arguments"));
    }
    return Done(function->call(arguments, &value)) && Push(std::move(value));
  }

  SinumerikReader& reader_;
  SinumerikFault& fault_;
  std::vector<SinumerikValue> values_;
};

}  // namespace

bool Evaluate(const SinumerikBlock& block, SinumerikExpression expression, SinumerikReader& reader,
              SinumerikValue* value, SinumerikFault* fault) {
  if (expression.empty()) {
    *value = SinumerikValue::Omitted();
    return true;
  }
  Stack stack(reader, fault);
  for (std::uint32_t i = expression.begin; i < expression.end; ++i) {
    if (!stack.Run(block.code[i])) return false;
  }
  *value = std::move(stack.top());
  return true;
}

}  // namespace ncsim::nc
