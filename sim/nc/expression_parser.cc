// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/expression_parser.h"

#include <array>
#include <string_view>
#include <utility>

namespace ncsim::nc {
namespace {

/// What waits on the operator stack.
enum class Waiting : std::uint8_t { kBracket, kFunction, kPrefix, kInfix };

struct Entry {
  Waiting kind = Waiting::kBracket;
  Op op = Op::kConstant;
  int precedence = 0;
  int column = 0;
};

struct Name {
  std::string_view text;
  Op op;
  int precedence;
};

constexpr std::array<Name, 10> kFunctions = {{{"SIN", Op::kSin, 0},
                                              {"COS", Op::kCos, 0},
                                              {"TAN", Op::kTan, 0},
                                              {"ASIN", Op::kAsin, 0},
                                              {"ACOS", Op::kAcos, 0},
                                              {"ATAN", Op::kAtan, 0},
                                              {"SQRT", Op::kSqrt, 0},
                                              {"ABS", Op::kAbs, 0},
                                              {"ROUND", Op::kRound, 0},
                                              {"FIX", Op::kFix, 0}}};

// The manual names the operators and gives no order; this is Fanuc's, which Haas programs rely on.
// ReportMixed() says so where it decides the result.
constexpr std::array<Name, 14> kOperators = {{{"*", Op::kMultiply, 3},
                                              {"/", Op::kDivide, 3},
                                              {"+", Op::kAdd, 2},
                                              {"-", Op::kSubtract, 2},
                                              {"MOD", Op::kMod, 3},
                                              {"AND", Op::kAnd, 3},
                                              {"OR", Op::kOr, 2},
                                              {"XOR", Op::kXor, 2},
                                              {"EQ", Op::kEq, 1},
                                              {"NE", Op::kNe, 1},
                                              {"GT", Op::kGt, 1},
                                              {"LT", Op::kLt, 1},
                                              {"GE", Op::kGe, 1},
                                              {"LE", Op::kLe, 1}}};

constexpr int kPrefixPrecedence = 4;
constexpr std::size_t kMaxWaiting = 96;
constexpr std::size_t kMaxDepth = 32;
/// A block's expressions together; far beyond what a control's line buffer holds.
constexpr std::size_t kMaxCode = 2000;

bool IsLogical(Op op) { return op == Op::kAnd || op == Op::kOr || op == Op::kXor; }

/// Shunting-yard with bounded stacks, so that hostile nesting costs neither stack nor memory.
class ExpressionParser {
 public:
  ExpressionParser(Scanner* scanner, ExpressionForm form, bool in_address, Block* block)
      : scanner_(*scanner), form_(form), in_address_(in_address), block_(*block) {}

  bool Parse(Expression* expression) {
    expression->begin = static_cast<std::uint32_t>(block_.code.size());
    while (!done_) {
      scanner_.SkipSpaces();
      if (!(want_operand_ ? ReadOperand() : ReadOperator())) return false;
    }
    expression->end = static_cast<std::uint32_t>(block_.code.size());
    return true;
  }

 private:
  bool Fail(int column, std::string message) {
    block_.errors.push_back({column, std::move(message)});
    return false;
  }
  bool Fail(std::string message) { return Fail(scanner_.column(), std::move(message)); }

  bool Push(const Entry& entry) {
    if (waiting_size_ == kMaxWaiting) return Fail("the expression is nested too deeply");
    waiting_[waiting_size_++] = entry;
    return true;
  }

  bool Emit(Op op, double constant = 0.0) {
    if (block_.code.size() >= kMaxCode) return Fail("the expressions of this block are too long");
    if (op == Op::kConstant && ++operands_ > kMaxOperands) {
      return Fail("the expression is nested too deeply");
    }
    const bool binary = (op >= Op::kAdd && op <= Op::kLe) || op == Op::kAtan2;
    if (binary) --operands_;
    block_.code.push_back({op, constant});
    return true;
  }

  bool ReadOperand() {
    const char c = scanner_.Peek();
    const int column = scanner_.column();
    const bool after_hash = waiting_size_ > 0 && waiting_[waiting_size_ - 1].op == Op::kVariable &&
                            waiting_[waiting_size_ - 1].kind == Waiting::kPrefix;
    if (c == '[') return OpenBracket();
    if (c == '#') {
      scanner_.Advance();
      return Push({Waiting::kPrefix, Op::kVariable, kPrefixPrecedence, column});
    }
    if (IsDigit(c) || c == '.') return ReadConstant(after_hash);
    if (after_hash) return Fail("'#' needs the number of a variable or a bracket after it");
    if (c == '-' || c == '+') {
      scanner_.Advance();
      if (c == '+') return true;
      return Push({Waiting::kPrefix, Op::kNegate, kPrefixPrecedence, column});
    }
    if (IsLetter(c)) return ReadFunction();
    if (scanner_.AtEnd()) return Fail("the expression ends where a value is expected");
    return Fail("expected a value, found " + Quoted(c));
  }

  bool ReadConstant(bool after_hash) {
    const int column = scanner_.column();
    Number number;
    const NumberStatus status = scanner_.ReadNumber(&number);
    if (status == NumberStatus::kNoDigits) return Fail(column, "'.' without digits is no number");
    if (status == NumberStatus::kTooLarge) {
      return Fail(column, "the number is too large for the control");
    }
    if (after_hash && number.has_point) {
      return Fail(column, "the number of a variable has no decimal point");
    }
    if (!Emit(Op::kConstant, number.value)) return false;
    return OperandDone();
  }

  bool ReadFunction() {
    const int column = scanner_.column();
    for (const Name& function : kFunctions) {
      if (!scanner_.Take(function.text)) continue;
      scanner_.SkipSpaces();
      if (scanner_.Peek() != '[') {
        return Fail(column, std::string(function.text) + " needs its argument in brackets [ ]");
      }
      const Op op = function.op == Op::kRound && in_address_ ? Op::kRoundAddress : function.op;
      return Push({Waiting::kFunction, op, 0, column}) && OpenBracket();
    }
    std::string name;
    while (IsLetter(scanner_.Peek()) && name.size() < 8) {
      name += Upper(scanner_.Peek());
      scanner_.Advance();
    }
    return Fail(column, "'" + name + "' is not a function of this control");
  }

  bool OpenBracket() {
    if (depth_ == kMaxDepth) {
      return Fail("brackets are nested deeper than " + std::to_string(kMaxDepth) + " levels");
    }
    if (!Push({Waiting::kBracket, Op::kConstant, 0, scanner_.column()})) return false;
    ++depth_;
    logical_[depth_] = Op::kConstant;
    other_[depth_] = false;
    scanner_.Advance();
    return true;
  }

  /// A value is complete: what binds tighter than every operator takes it. In kOperand form at the
  /// outermost level that is all.
  bool OperandDone() {
    if (!PopWhileAtLeast(kPrefixPrecedence)) return false;
    want_operand_ = false;
    done_ = form_ == ExpressionForm::kOperand && depth_ == 0;
    return true;
  }

  bool PopWhileAtLeast(int precedence) {
    while (waiting_size_ > 0) {
      const Entry& top = waiting_[waiting_size_ - 1];
      if (top.kind == Waiting::kBracket || top.kind == Waiting::kFunction) return true;
      if (top.precedence < precedence) return true;
      --waiting_size_;
      if (!Emit(top.op)) return false;
    }
    return true;
  }

  bool ReadOperator() {
    if (scanner_.Peek() == ']' && depth_ > 0) return CloseBracket();
    const int column = scanner_.column();
    for (const Name& name : kOperators) {
      if (!scanner_.Take(name.text)) continue;
      if (!PopWhileAtLeast(name.precedence)) return false;
      ReportMixed(name.op, column);
      want_operand_ = true;
      return Push({Waiting::kInfix, name.op, name.precedence, column});
    }
    if (depth_ == 0) {
      done_ = true;
      return PopWhileAtLeast(0);
    }
    const int open = waiting_[LastBracket()].column;
    if (scanner_.AtEnd()) {
      return Fail(open, "'[' is never closed");
    }
    return Fail("expected an operator or ']', found " + Quoted(scanner_.Peek()));
  }

  std::size_t LastBracket() const {
    std::size_t i = waiting_size_;
    while (i > 0 && waiting_[i - 1].kind != Waiting::kBracket) --i;
    return i == 0 ? 0 : i - 1;
  }

  bool CloseBracket() {
    scanner_.Advance();
    if (!PopWhileAtLeast(0)) return false;
    --waiting_size_;  // The bracket itself.
    --depth_;
    if (waiting_size_ > 0 && waiting_[waiting_size_ - 1].kind == Waiting::kFunction) {
      const Entry function = waiting_[--waiting_size_];
      if (function.op == Op::kAtan && TakeSecondArgument()) {
        block_.doubts.push_back(
            {function.column,
             "ATAN[a]/[b] is read as Fanuc's arc tangent of a/b, while the Haas manual documents "
             "ATAN[x] alone; write ATAN[a/b] where the quadrant is known"});
        return Push({Waiting::kFunction, Op::kAtan2, 0, function.column}) && OpenBracket() &&
               (want_operand_ = true);
      }
      if (!Emit(function.op)) return false;
    }
    return OperandDone();
  }

  /// Past the `/` of ATAN[a]/[b], if that is what follows.
  bool TakeSecondArgument() {
    Scanner ahead = scanner_;
    ahead.SkipSpaces();
    if (ahead.Peek() != '/') return false;
    ahead.Advance();
    ahead.SkipSpaces();
    if (ahead.Peek() != '[') return false;
    scanner_ = ahead;
    return true;
  }

  void ReportMixed(Op op, int column) {
    Op& logical = logical_[depth_];
    bool mixed = logical != Op::kConstant && logical != op;
    if (IsLogical(op)) {
      mixed = mixed || other_[depth_];
      logical = op;
    } else {
      other_[depth_] = true;
    }
    if (!mixed || reported_mixed_) return;
    reported_mixed_ = true;
    block_.doubts.push_back({column,
                             "AND, OR or XOR beside another operator without brackets: the manual "
                             "does not say which binds first; write brackets"});
  }

  Scanner& scanner_;
  const ExpressionForm form_;
  const bool in_address_;
  Block& block_;
  std::array<Entry, kMaxWaiting> waiting_;
  std::size_t waiting_size_ = 0;
  // By bracket depth: the logical operator seen there (kConstant: none), and whether any other was.
  std::array<Op, kMaxDepth + 1> logical_{};
  std::array<bool, kMaxDepth + 1> other_{};
  std::size_t depth_ = 0;
  std::size_t operands_ = 0;
  bool want_operand_ = true;
  bool done_ = false;
  bool reported_mixed_ = false;
};

}  // namespace

bool ParseExpression(Scanner* scanner, ExpressionForm form, bool in_address, Block* block,
                     Expression* expression) {
  ExpressionParser parser(scanner, form, in_address, block);
  return parser.Parse(expression);
}

}  // namespace ncsim::nc
