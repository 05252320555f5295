// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_expression_parser.h"

#include <algorithm>
#include <array>
#include <utility>

#include "sim/nc/sinumerik_token.h"

namespace ncsim::nc {
namespace {

constexpr int kDeepest = 40;
constexpr std::size_t kMaxOperations = 4096;

/// NC programming 12/2019, p. 444, from the lowest: comparison binds weakest.
enum Priority {
  kComparison,
  kConcatenation,
  kOr,
  kXor,
  kAnd,
  kBitOr,
  kBitXor,
  kBitAnd,
  kSum,
  kProduct,
  kFrames
};

struct NamedOperator {
  std::string_view name;
  SinumerikOp op;
  int priority;
};
constexpr std::array<NamedOperator, 8> kNamedOperators = {{
    {"AND", SinumerikOp::kAnd, kAnd},
    {"B_AND", SinumerikOp::kBitAnd, kBitAnd},
    {"B_OR", SinumerikOp::kBitOr, kBitOr},
    {"B_XOR", SinumerikOp::kBitXor, kBitXor},
    {"DIV", SinumerikOp::kDiv, kProduct},
    {"MOD", SinumerikOp::kMod, kProduct},
    {"OR", SinumerikOp::kOr, kOr},
    {"XOR", SinumerikOp::kXor, kXor},
}};

/// Words that end an expression, and are no operand.
constexpr std::array<std::string_view, 16> kReserved = {
    "BLOCK", "CALL",  "DEFAULT", "DO",    "ELSE", "ENDIF", "EVERY", "GOTO",
    "GOTOB", "GOTOC", "GOTOF",   "GOTOS", "IF",   "OF",    "TO",    "WHEN"};

bool IsArithmetic(SinumerikOp op) {
  return op == SinumerikOp::kMultiply || op == SinumerikOp::kDivide || op == SinumerikOp::kDiv ||
         op == SinumerikOp::kMod || op == SinumerikOp::kAdd || op == SinumerikOp::kSubtract ||
         op == SinumerikOp::kChain;
}

}  // namespace

std::string_view PeekOperandName(const Scanner& scanner) {
  if (!IsLetter(scanner.Peek()) || IsNameStart(scanner.PeekAfter(1))) return PeekName(scanner);
  std::size_t size = 1;
  while (IsDigit(scanner.PeekAfter(size))) ++size;
  return {scanner.position(), size};
}

bool SinumerikExpressionParser::Fail(int column, int alarm, std::string message) {
  block_.errors.push_back({column, AlarmText(alarm, std::move(message))});
  return false;
}

bool SinumerikExpressionParser::Emit(const SinumerikCode& code) {
  if (block_.code.size() >= kMaxOperations)
    return Fail(code.column, 12540, "the block is too complex");
  block_.code.push_back(code);
  return true;
}

bool SinumerikExpressionParser::Parse(SinumerikExpression* expression) {
  expression->begin = static_cast<std::uint32_t>(block_.code.size());
  if (!ParseBinary(kComparison, true)) return false;
  expression->end = static_cast<std::uint32_t>(block_.code.size());
  return true;
}

bool SinumerikExpressionParser::ParseConstant(SinumerikExpression* expression) {
  scanner_.SkipSpaces();
  expression->begin = static_cast<std::uint32_t>(block_.code.size());
  if (!ParseUnary(true)) return false;
  expression->end = static_cast<std::uint32_t>(block_.code.size());
  return true;
}

bool SinumerikExpressionParser::ParseList(char close, std::uint32_t* first, std::uint32_t* count) {
  const int opening = scanner_.column() - 1;
  *first = static_cast<std::uint32_t>(block_.arguments.size());
  *count = 0;
  scanner_.SkipSpaces();
  if (scanner_.Peek() == close) {
    scanner_.Advance();
    return true;
  }
  while (true) {
    scanner_.SkipSpaces();
    SinumerikExpression argument;
    const char c = scanner_.Peek();
    if (scanner_.AtEnd()) {
      return Fail(opening, 12080, std::string("'") + close + "' is missing");
    }
    if (c != ',' && c != close && !Parse(&argument)) return false;
    block_.arguments.push_back(argument);
    ++*count;
    scanner_.SkipSpaces();
    if (scanner_.Peek() == close) break;
    if (scanner_.Peek() != ',') {
      return Fail(scanner_.AtEnd() ? opening : scanner_.column(), 12080,
                  std::string("',' or '") + close + "' is missing");
    }
    scanner_.Advance();
  }
  scanner_.Advance();
  return true;
}

SinumerikExpressionParser::Operator SinumerikExpressionParser::PeekOperator() const {
  const char c = scanner_.Peek();
  const char next = scanner_.PeekAfter(1);
  switch (c) {
    case '*':
      return {SinumerikOp::kMultiply, kProduct, 1};
    case '/':
      return {SinumerikOp::kDivide, kProduct, 1};
    case '+':
      return {SinumerikOp::kAdd, kSum, 1};
    case '-':
      return {SinumerikOp::kSubtract, kSum, 1};
    case ':':
      return {SinumerikOp::kChain, kFrames, 1};
    case '=':
      if (next == '=') return {SinumerikOp::kEqual, kComparison, 2};
      return {};
    case '<':
      if (next == '<') return {SinumerikOp::kConcatenate, kConcatenation, 2};
      if (next == '>') return {SinumerikOp::kNotEqual, kComparison, 2};
      if (next == '=') return {SinumerikOp::kLessEqual, kComparison, 2};
      return {SinumerikOp::kLess, kComparison, 1};
    case '>':
      if (next == '=') return {SinumerikOp::kGreaterEqual, kComparison, 2};
      return {SinumerikOp::kGreater, kComparison, 1};
    default:
      break;
  }
  const std::string_view name = PeekName(scanner_);
  if (name.empty()) return {};
  for (const NamedOperator& named : kNamedOperators) {
    if (SameName(name, named.name)) return {named.op, named.priority, name.size()};
  }
  return {};
}

/// Operators of at least the priority `lowest`, from left to right.
bool SinumerikExpressionParser::ParseBinary(int lowest, bool sign_allowed) {
  if (++depth_ > kDeepest) {
    return Fail(scanner_.column(), 12540, "the expression is nested too deeply");
  }
  scanner_.SkipSpaces();
  const int start = scanner_.column();
  if (sign_allowed && scanner_.Peek() == '<' && scanner_.PeekAfter(1) == '<') {
    scanner_.Advance(2);
    SinumerikCode code;
    code.op = SinumerikOp::kToString;
    code.column = start;
    if (!ParseBinary(kConcatenation + 1, true) || !Emit(code)) return false;
  } else if (!ParseUnary(sign_allowed)) {
    return false;
  }
  while (true) {
    scanner_.SkipSpaces();
    const Operator found = PeekOperator();
    if (found.priority < lowest) break;
    SinumerikCode code;
    code.op = found.op;
    code.column = scanner_.column();
    scanner_.Advance(found.size);
    const bool sign = !IsArithmetic(found.op);
    scanner_.SkipSpaces();
    if (found.op == SinumerikOp::kConcatenate && scanner_.Peek() == '<') {
      return Fail(scanner_.column(), 12080, "an operand is missing before '<'");
    }
    if (!ParseBinary(found.priority + 1, sign) || !Emit(code)) return false;
  }
  --depth_;
  return true;
}

bool SinumerikExpressionParser::ParseUnary(bool sign_allowed) {
  scanner_.SkipSpaces();
  const int column = scanner_.column();
  const char c = scanner_.Peek();
  if (c == '+' || c == '-') {
    if (!sign_allowed) {
      return Fail(column, 12080,
                  std::string("the sign '") + c + "' right behind an operator needs parentheses");
    }
    scanner_.Advance();
    scanner_.SkipSpaces();
    if (scanner_.Peek() == '"') {
      return Fail(column, 12150, "a string has no sign");
    }
    const std::size_t before = block_.code.size();
    if (!ParseUnary(false)) return false;
    if (c == '+') return true;
    SinumerikCode& last = block_.code.back();
    const bool constant = last.op == SinumerikOp::kReal || last.op == SinumerikOp::kInteger;
    if (constant && block_.code.size() == before + 1) {
      last.number = -last.number;
      return true;
    }
    SinumerikCode code;
    code.op = SinumerikOp::kNegate;
    code.column = column;
    return Emit(code);
  }
  const std::string_view name = PeekName(scanner_);
  const bool bits = SameName(name, "B_NOT");
  if (!bits && !SameName(name, "NOT")) return ParseOperand();
  if (++depth_ > kDeepest) return Fail(column, 12540, "the expression is nested too deeply");
  scanner_.Advance(name.size());
  SinumerikCode code;
  code.op = bits ? SinumerikOp::kBitNot : SinumerikOp::kNot;
  code.column = column;
  if (!ParseUnary(true)) return false;
  --depth_;
  return Emit(code);
}

bool SinumerikExpressionParser::EmitNumber(const std::string& error, double value, bool is_integer,
                                           int column) {
  if (!error.empty()) {
    block_.errors.push_back({column, error});
    return false;
  }
  SinumerikCode code;
  code.op = is_integer ? SinumerikOp::kInteger : SinumerikOp::kReal;
  code.column = column;
  code.number = value;
  return Emit(code);
}

bool SinumerikExpressionParser::ParseOperand() {
  const int column = scanner_.column();
  const char c = scanner_.Peek();
  SinumerikNumber number;
  if (IsDigit(c) || c == '.') {
    const std::string error = ReadSinumerikNumber(&scanner_, &number);
    return EmitNumber(error, number.value, number.is_integer, column);
  }
  if (c == '\'') {
    const std::string error = ReadSinumerikBits(&scanner_, &number);
    return EmitNumber(error, number.value, true, column);
  }
  if (c == '"') {
    SinumerikCode code;
    code.op = SinumerikOp::kString;
    code.column = column;
    const std::string error = ReadSinumerikString(&scanner_, &code.name);
    if (error.empty()) return Emit(code);
    block_.errors.push_back({column, error});
    return false;
  }
  if (c == '(') {
    scanner_.Advance();
    if (!ParseBinary(kComparison, true)) return false;
    scanner_.SkipSpaces();
    if (scanner_.Peek() != ')') return Fail(column, 12080, "')' is missing");
    scanner_.Advance();
    return true;
  }
  const std::string_view name = PeekOperandName(scanner_);
  if (!name.empty()) return ParseNamed(name, column);
  if (scanner_.AtEnd() || c == ';') return Fail(column, 12080, "an operand is missing here");
  return Fail(column, 12080, Quoted(c) + " is no operand");
}

bool SinumerikExpressionParser::ParseNamed(std::string_view name, int column) {
  for (const NamedOperator& named : kNamedOperators) {
    if (SameName(name, named.name)) {
      return Fail(column, 12080, "an operand is missing before " + std::string(named.name));
    }
  }
  for (const std::string_view reserved : kReserved) {
    if (SameName(name, reserved)) {
      return Fail(column, 12080, "an operand is missing before " + std::string(reserved));
    }
  }
  if (name.size() > kMaxSinumerikName) {
    return Fail(column, 12420, "the name is longer than 31 characters");
  }
  scanner_.Advance(name.size());
  SinumerikCode code;
  code.column = column;
  if (SameName(name, "TRUE") || SameName(name, "FALSE")) {
    code.op = SinumerikOp::kBool;
    code.number = name.size() == 4 ? 1.0 : 0.0;
    return Emit(code);
  }
  code.op = SinumerikOp::kName;
  code.name = name;
  Scanner ahead = scanner_;
  ahead.SkipSpaces();
  if (ahead.Peek() == '[' || ahead.Peek() == '(') {
    const bool call = ahead.Peek() == '(';
    scanner_ = ahead;
    scanner_.Advance();
    if (call) code.op = SinumerikOp::kCall;
    if (!ParseInner(call ? ')' : ']', &code.count)) return false;
  }
  return Emit(code);
}

/// Arguments or indices of an operand: their code stands before its own.
bool SinumerikExpressionParser::ParseInner(char close, std::uint16_t* count) {
  const int opening = scanner_.column() - 1;
  if (++depth_ > kDeepest) return Fail(opening, 12540, "the expression is nested too deeply");
  scanner_.SkipSpaces();
  *count = 0;
  if (scanner_.Peek() == close) {
    scanner_.Advance();
    --depth_;
    return true;
  }
  while (true) {
    scanner_.SkipSpaces();
    const char c = scanner_.Peek();
    SinumerikCode omitted;
    omitted.op = SinumerikOp::kOmitted;
    omitted.column = scanner_.column();
    const bool empty = c == ',' || c == close;
    if (empty ? !Emit(omitted) : !ParseBinary(kComparison, true)) return false;
    ++*count;
    scanner_.SkipSpaces();
    if (scanner_.Peek() == close) break;
    if (scanner_.Peek() != ',') {
      return Fail(scanner_.AtEnd() ? opening : scanner_.column(), 12080,
                  std::string("',' or '") + close + "' is missing");
    }
    scanner_.Advance();
  }
  scanner_.Advance();
  --depth_;
  return true;
}

}  // namespace ncsim::nc
