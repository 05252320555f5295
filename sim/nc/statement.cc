// SPDX-License-Identifier: BSD-3-Clause
// Macro statements of a block (Haas NGC Mill Operator's Manual 2017, "Macro Statements").
#include <string>

#include "sim/base/text.h"
#include "sim/nc/block_parser.h"
#include "sim/nc/expression_parser.h"

namespace ncsim::nc {
namespace {

constexpr std::size_t kMaxStatements = 256;

bool IsJump(StatementKind kind) {
  return kind == StatementKind::kGoto || kind == StatementKind::kIfGoto ||
         kind == StatementKind::kEnd;
}

bool IsLoop(StatementKind kind) {
  return kind == StatementKind::kWhile || kind == StatementKind::kDo;
}

}  // namespace

/// At a letter that another letter follows. False, and nothing consumed, where no keyword stands
/// here.
bool BlockParser::ParseKeyword() {
  const int column = scanner_.column();
  const Scanner start = scanner_;
  if (scanner_.Take("IF")) {
    ParseIf(column);
  } else if (scanner_.Take("GOTO")) {
    ParseGoto(StatementKind::kGoto, column, {});
  } else if (scanner_.Take("WHILE") || scanner_.Take("WH")) {
    ParseWhile(column);
  } else if (scanner_.Take("DO")) {
    ParseLoop(StatementKind::kDo, column, {});
  } else if (scanner_.Take("END")) {
    ParseLoop(StatementKind::kEnd, column, {});
  } else if (scanner_.Take("DPRNT") || scanner_.Take("POPEN") || scanner_.Take("PCLOS")) {
    ParsePrint(column);
  } else if (scanner_.Take("THEN")) {
    Fail(column, "THEN without IF [ ] before it");
  } else {
    scanner_ = start;
    return false;
  }
  return true;
}

Statement& BlockParser::AddStatement(StatementKind kind, int column) {
  std::vector<Statement>& statements = block_.statements;
  if (statements.empty()) {
    // The words so far were a plain block's.
    for (std::size_t i = 0; i < block_.words.size(); ++i) {
      Statement word;
      word.column = block_.words[i].column;
      word.length = block_.words[i].length;
      word.word = static_cast<int>(i);
      statements.push_back(word);
    }
  }
  if (statements.size() >= kMaxStatements) {
    FailLine(column, "more than " + std::to_string(kMaxStatements) + " statements in a block");
  }
  Statement statement;
  statement.kind = kind;
  statement.column = column;
  statement.length = LengthFrom(column);
  return statements.emplace_back(statement);
}

bool BlockParser::ParseCondition(Expression* condition) {
  scanner_.SkipSpaces();
  if (scanner_.Peek() != '[') {
    FailLine(scanner_.column(), "a condition in brackets [ ] is missing here");
    return false;
  }
  if (!ParseExpression(&scanner_, ExpressionForm::kOperand, false, &block_, condition)) {
    scanner_.SkipToLineEnd();
    return false;
  }
  return true;
}

void BlockParser::ParseAssignment() {
  const int column = scanner_.column();
  Expression target;
  Expression value;
  // The target's own code is the variable's number: the last step, which would read it, is left
  // out.
  if (!ParseExpression(&scanner_, ExpressionForm::kOperand, false, &block_, &target)) {
    return scanner_.SkipToLineEnd();
  }
  --target.end;
  scanner_.SkipSpaces();
  if (scanner_.Peek() != '=') {
    return FailLine(column, "a variable without an address before it or '=' after it");
  }
  scanner_.Advance();
  if (!ParseExpression(&scanner_, ExpressionForm::kFull, false, &block_, &value)) {
    return scanner_.SkipToLineEnd();
  }
  Statement& statement = AddStatement(StatementKind::kAssignment, column);
  statement.target = target;
  statement.value = value;
}

/// `[#1 EQ #2] M99 P5`.
void BlockParser::ParseGate() {
  const int column = scanner_.column();
  Expression condition;
  if (!ParseCondition(&condition)) return;
  AddStatement(StatementKind::kCondition, column).value = condition;
  scanner_.SkipSpaces();
  Scanner ahead = scanner_;
  Number number;
  const bool returns = ahead.Take("M") && ahead.ReadNumber(&number) == NumberStatus::kOk &&
                       number.value == 99.0 && !number.has_point;
  if (!returns) Fail(column, "a condition without IF or WHILE must have M99 right after it");
}

void BlockParser::ParseIf(int column) {
  Expression condition;
  if (!ParseCondition(&condition)) return;
  scanner_.SkipSpaces();
  if (scanner_.Take("THEN")) {
    AddStatement(StatementKind::kCondition, column).value = condition;
    return;
  }
  if (scanner_.Take("GOTO")) return ParseGoto(StatementKind::kIfGoto, column, condition);
  FailLine(scanner_.column(), "IF [ ] must be followed by GOTO or THEN");
}

void BlockParser::ParseGoto(StatementKind kind, int column, Expression condition) {
  Expression label;
  scanner_.SkipSpaces();
  const char c = scanner_.Peek();
  if (IsDigit(c)) {
    Number number;
    const int place = scanner_.column();
    if (scanner_.ReadNumber(&number) != NumberStatus::kOk) {
      return FailLine(place, "the block number after GOTO is too large");
    }
    label.begin = static_cast<std::uint32_t>(block_.code.size());
    label.end = label.begin + 1;
    block_.code.push_back({Op::kConstant, number.value});
  } else if (c == '#' || c == '[') {
    if (!ParseExpression(&scanner_, ExpressionForm::kOperand, false, &block_, &label)) {
      return scanner_.SkipToLineEnd();
    }
  } else {
    return FailLine(column, "GOTO needs a block number, a variable or an expression in brackets");
  }
  Statement& statement = AddStatement(kind, column);
  statement.value = condition;
  statement.label = label;
}

void BlockParser::ParseWhile(int column) {
  Expression condition;
  if (!ParseCondition(&condition)) return;
  scanner_.SkipSpaces();
  if (!scanner_.Take("DO")) {
    return FailLine(scanner_.column(), "WHILE [ ] must be followed by DO1, DO2 or DO3");
  }
  ParseLoop(StatementKind::kWhile, column, condition);
}

void BlockParser::ParseLoop(StatementKind kind, int column, Expression condition) {
  scanner_.SkipSpaces();
  Number number;
  const int place = scanner_.column();
  const NumberStatus status = scanner_.ReadNumber(&number);
  const bool valid = status == NumberStatus::kOk && !number.has_point &&
                     (number.value == 1.0 || number.value == 2.0 || number.value == 3.0);
  if (!valid) {
    return FailLine(place, "the number of a DO or END must be 1, 2 or 3");
  }
  Statement& statement = AddStatement(kind, column);
  statement.value = condition;
  statement.loop = static_cast<int>(number.value);
}

/// Text for a printer: nothing here can move. Brackets must match.
void BlockParser::ParsePrint(int column) {
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '[') {
    int depth = 0;
    do {
      if (scanner_.AtEnd()) return FailLine(column, "the bracket of DPRNT is never closed");
      if (scanner_.Peek() == '[') ++depth;
      if (scanner_.Peek() == ']') --depth;
      scanner_.Advance();
    } while (depth > 0);
  }
  AddStatement(StatementKind::kPrint, column);
}

void BlockParser::CheckStatements() {
  for (std::size_t i = 0; i < block_.statements.size(); ++i) {
    CheckPlace(block_.statements[i], i);
  }
}

void BlockParser::CheckPlace(const Statement& statement, std::size_t index) {
  const std::vector<Statement>& all = block_.statements;
  const bool alone = all.size() == 1;
  const bool last = index + 1 == all.size();
  const StatementKind kind = statement.kind;
  if (IsLoop(kind) && !alone) {
    return Fail(statement.column, "WHILE and DO must stand alone in their block");
  }
  if (kind == StatementKind::kPrint && !alone) {
    return Fail(statement.column, "DPRNT must be the only command in its block");
  }
  if (kind == StatementKind::kEnd && !last) {
    return Fail(statement.column, "END must be the last word of its block");
  }
  if (!IsJump(kind)) return;
  for (std::size_t i = 0; i < index; ++i) {
    if (all[i].kind == StatementKind::kCondition) {
      return Fail(statement.column, "THEN may not be used with GOTO or END");
    }
    if (IsJump(all[i].kind)) {
      return Fail(statement.column, "a block can have only one GOTO or END");
    }
  }
}

}  // namespace ncsim::nc
