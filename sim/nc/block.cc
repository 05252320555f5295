// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "sim/base/text.h"
#include "sim/nc/block_parser.h"
#include "sim/nc/expression_parser.h"
#include "sim/nc/program.h"

namespace ncsim::nc {
namespace {

// Far beyond the longest block of a control; they keep a hostile line from eating memory.
constexpr std::size_t kMaxWords = 128;
constexpr std::size_t kMaxComments = 128;
constexpr std::size_t kMaxErrors = 8;

constexpr int kMaxSequenceDigits = 9;
/// Manual 2017, "Preparation": "The letter O is followed by a 5-digit number".
constexpr int kMaxProgramDigits = 5;

constexpr bool IsNumberPart(char c) { return IsDigit(c) || c == '.' || c == '-' || c == '+'; }

constexpr std::uint32_t Bit(char letter) { return 1u << (letter - 'A'); }

}  // namespace

void BlockParser::Parse() {
  block_.block_delete = false;
  block_.program_mark = false;
  block_.sequence = -1;
  block_.program = -1;
  block_.words.clear();
  block_.statements.clear();
  block_.code.clear();
  block_.comments.clear();
  block_.errors.clear();
  block_.doubts.clear();
  ParseLine();
  scanner_.SkipToLineEnd();
  scanner_.SkipLineEnd();
  block_.next = block_.offset + scanner_.consumed();
}

void BlockParser::ParseLine() {
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '%') {
    ParseProgramMark();
    return;
  }
  if (scanner_.Peek() == '/') {
    block_.block_delete = true;
    scanner_.Advance();
  }
  while (true) {
    scanner_.SkipSpaces();
    if (scanner_.AtEnd()) break;
    ParsePart();
  }
  if (repeated_ != 0) CheckRepeats();
  if (!block_.statements.empty() && block_.errors.empty()) CheckStatements();
}

void BlockParser::ParsePart() {
  const char c = scanner_.Peek();
  if (IsLetter(c)) return ParseLetter();
  const int column = scanner_.column();
  switch (c) {
    case '(':
      return ParseComment();
    case '#':
      return ParseAssignment();
    case '[':
      return ParseGate();
    case ',':
      return ParseCommaWord();
    case ';':
      return ParseEndOfBlock();
    case ')':
      scanner_.Advance();
      return Fail(column, "')' without '(': a comment ends at its first ')'");
    case ']':
      scanner_.Advance();
      return Fail(column, "']' without '['");
    case '/':
      scanner_.Advance();
      return Fail(column, "'/' skips a block only at its beginning");
    case '%':
      scanner_.Advance();
      return Fail(column, "'%' must stand on a line of its own");
    default:
      break;
  }
  if (IsNumberPart(c)) {
    while (IsNumberPart(scanner_.Peek())) scanner_.Advance();
    return Fail(column, "a number without an address before it");
  }
  while (scanner_.Peek() == c && !scanner_.AtEnd()) scanner_.Advance();
  Fail(column, c == ':' ? "':' is no address: this control's program numbers begin with O"
                        : Quoted(c) + " has no meaning in a block");
}

void BlockParser::Fail(int column, std::string message) {
  block_.errors.push_back({column, std::move(message)});
  if (block_.errors.size() >= kMaxErrors) scanner_.SkipToLineEnd();
}

void BlockParser::FailLine(int column, std::string message) {
  Fail(column, std::move(message));
  scanner_.SkipToLineEnd();
}

void BlockParser::ParseProgramMark() {
  block_.program_mark = true;
  scanner_.Advance();
  while (true) {
    scanner_.SkipSpaces();
    if (scanner_.AtEnd()) return;
    const char c = scanner_.Peek();
    if (c == '(') {
      ParseComment();
    } else if (c == ';') {
      scanner_.Advance();
    } else {
      return FailLine(scanner_.column(), "'%' must stand on a line of its own");
    }
  }
}

void BlockParser::ParseLetter() {
  const int column = scanner_.column();
  const char address = Upper(scanner_.Peek());
  const char next = scanner_.PeekAfter(1);
  if (address == 'N') return ParseSequence();
  if (address == 'O') return ParseProgramNumber();
  if (IsDigit(next) || next == '.') {
    scanner_.Advance();
    return ParseNumberWord(address, column, false);
  }
  if (IsLetter(next) && ParseKeyword()) return;
  scanner_.Advance();
  ParseValue(address, column, false);
}

/// At the first digit or point, the fast path.
void BlockParser::ParseNumberWord(char address, int column, bool comma) {
  Number number;
  switch (scanner_.ReadNumber(&number)) {
    case NumberStatus::kOk:
      break;
    case NumberStatus::kNoDigits:
      return Fail(column, std::string("the word ") + address + " has a '.' without digits");
    case NumberStatus::kTooLarge:
      return Fail(column,
                  std::string("the number after ") + address + " is too large for the control");
  }
  Word word;
  word.value = number.value;
  word.column = column;
  word.length = LengthFrom(column);
  word.digits = number.digits;
  word.address = address;
  word.comma = comma;
  word.has_point = number.has_point;
  AddWord(word);
}

/// After the address: what is not just digits.
void BlockParser::ParseValue(char address, int column, bool comma) {
  bool spaced = IsSpace(scanner_.Peek());
  scanner_.SkipSpaces();
  const char sign = scanner_.Peek();
  const bool has_sign = sign == '-' || sign == '+';
  if (has_sign) {
    scanner_.Advance();
    spaced = spaced || IsSpace(scanner_.Peek());
    scanner_.SkipSpaces();
  }
  const char c = scanner_.Peek();
  if (c == '#' || c == '[') return ParseExpressionWord(address, column, comma, sign == '-');
  if (!IsDigit(c) && c != '.') {
    if (!has_sign) return ParseLoneLetter(address, column, comma);
    while (IsNumberPart(scanner_.Peek())) scanner_.Advance();
    return Fail(column, std::string("the word ") + address + " has a sign but no number");
  }
  if (spaced) {
    // Manual 2017, "Editing": "There is no space between the X and the Zero".
    Number skipped;
    scanner_.ReadNumber(&skipped);
    return Fail(column, std::string("a space between ") + address +
                            " and its number: the control takes the letter alone for an "
                            "expression, and alarms");
  }
  const std::size_t count = block_.words.size();
  ParseNumberWord(address, column, comma);
  if (sign == '-' && block_.words.size() > count) block_.words.back().value *= -1.0;
}

void BlockParser::ParseExpressionWord(char address, int column, bool comma, bool negative) {
  Word word;
  word.address = address;
  word.column = column;
  word.comma = comma;
  word.is_expression = true;
  if (!ParseExpression(&scanner_, ExpressionForm::kOperand, true, &block_, &word.expression)) {
    return scanner_.SkipToLineEnd();
  }
  if (negative) {
    block_.code.push_back({Op::kNegate, 0.0});
    ++word.expression.end;
  }
  word.length = LengthFrom(column);
  AddWord(word);
}

void BlockParser::ParseLoneLetter(char address, int column, bool comma) {
  // A run of letters is a word of another language ("SUB", "ENDWHILE"): one message, not one a
  // letter.
  std::string run(1, address);
  Scanner ahead = scanner_;
  while (IsLetter(ahead.Peek())) {
    if (run.size() < 12) run += Upper(ahead.Peek());
    ahead.Advance();
  }
  if (run.size() >= 3) {
    scanner_ = ahead;
    return Fail(column, "'" + run + "' is not a word of this control");
  }
  if (comma) return Fail(column, std::string(",") + address + " has no value");
  Word word;
  word.address = address;
  word.column = column;
  word.length = 1;
  word.has_value = false;
  AddWord(word);
}

bool BlockParser::ReadLabel(char address, int max_digits, long* number) {
  const int column = scanner_.column();
  scanner_.Advance();
  long value = 0;
  int digits = 0;
  while (IsDigit(scanner_.Peek())) {
    if (++digits <= max_digits) value = value * 10 + (scanner_.Peek() - '0');
    scanner_.Advance();
  }
  if (digits == 0) {
    FailLine(column, std::string(1, address) + " needs a whole number right after it");
    return false;
  }
  if (digits > max_digits) {
    Fail(column, std::string("the number after ") + address + " has " + std::to_string(digits) +
                     " digits; at most " + std::to_string(max_digits) + " are allowed");
    return false;
  }
  *number = value;
  return true;
}

void BlockParser::ParseSequence() {
  const int column = scanner_.column();
  if (block_.sequence >= 0 || !block_.words.empty() || !block_.statements.empty()) {
    scanner_.Advance();
    while (IsDigit(scanner_.Peek())) scanner_.Advance();
    return Fail(column, "the block number N must stand at the beginning of its block");
  }
  long number = -1;
  if (!ReadLabel('N', kMaxSequenceDigits, &number)) return;
  block_.sequence = number;
  // `N10 /G01`: some posts number the skipped blocks too.
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '/' && !block_.block_delete) {
    block_.block_delete = true;
    scanner_.Advance();
  }
}

void BlockParser::ParseProgramNumber() {
  const int column = scanner_.column();
  if (block_.program >= 0 || !block_.words.empty() || !block_.statements.empty()) {
    return FailLine(column, "the program number O must stand at the beginning of its block");
  }
  long number = -1;
  if (!ReadLabel('O', kMaxProgramDigits, &number)) return;
  block_.program = number;
}

void BlockParser::ParseCommaWord() {
  const int column = scanner_.column();
  scanner_.Advance();
  scanner_.SkipSpaces();
  const char address = Upper(scanner_.Peek());
  if (address != 'R' && address != 'C') {
    return Fail(column, "a comma must be followed by R (corner rounding) or C (chamfer)");
  }
  scanner_.Advance();
  if (IsDigit(scanner_.Peek()) || scanner_.Peek() == '.') {
    return ParseNumberWord(address, column, true);
  }
  ParseValue(address, column, true);
}

void BlockParser::ParseComment() {
  const int column = scanner_.column();
  scanner_.Advance();
  const char* begin = scanner_.position();
  while (!scanner_.AtEnd() && scanner_.Peek() != ')') scanner_.Advance();
  if (scanner_.AtEnd()) return Fail(column, "the comment is never closed: ')' is missing");
  if (block_.comments.size() == kMaxComments) {
    return FailLine(column, "more than " + std::to_string(kMaxComments) + " comments in a block");
  }
  block_.comments.emplace_back(begin, static_cast<std::size_t>(scanner_.position() - begin));
  scanner_.Advance();
}

/// Only comments may follow: anything else would be a second block on the line, whose place the
/// text does not give.
void BlockParser::ParseEndOfBlock() {
  while (true) {
    if (scanner_.Peek() == ';') scanner_.Advance();
    scanner_.SkipSpaces();
    if (scanner_.AtEnd()) return;
    if (scanner_.Peek() == '(') {
      ParseComment();
    } else if (scanner_.Peek() != ';') {
      return FailLine(scanner_.column(), "';' ends the block; only a comment may follow it");
    }
  }
}

void BlockParser::AddWord(const Word& word) {
  if (block_.words.size() == kMaxWords) {
    return FailLine(word.column, "more than " + std::to_string(kMaxWords) + " words in a block");
  }
  if (!word.comma && word.address != 'G' && word.address != 'M') {
    const std::uint32_t bit = Bit(word.address);
    repeated_ |= seen_ & bit;
    seen_ |= bit;
  }
  block_.words.push_back(word);
  if (!block_.statements.empty()) {
    Statement& statement = AddStatement(StatementKind::kWord, word.column);
    statement.length = word.length;
    statement.word = static_cast<int>(block_.words.size()) - 1;
  }
}

/// Sets of I J K are arguments of a macro call (manual 2017, "Alternate Alphabetic Addressing");
/// every other repeated address contradicts itself.
void BlockParser::CheckRepeats() {
  bool macro_call = false;
  for (const Word& word : block_.words) {
    macro_call = macro_call || (word.address == 'G' && (word.value == 65.0 || word.is_expression));
  }
  std::uint32_t wrong = repeated_;
  if (macro_call) wrong &= ~(Bit('I') | Bit('J') | Bit('K'));
  std::uint32_t seen = 0;
  for (const Word& word : block_.words) {
    if (word.comma || (wrong & Bit(word.address)) == 0) continue;
    if ((seen & Bit(word.address)) != 0) {
      Fail(word.column, std::string("the address ") + word.address + " stands twice in the block");
      wrong &= ~Bit(word.address);
    }
    seen |= Bit(word.address);
  }
}

void ParseBlock(const Program& program, std::size_t offset, int line, Block* block) {
  BlockParser parser(program.text(), offset, line, block);
  parser.Parse();
}

}  // namespace ncsim::nc
