// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_block.h"

#include <algorithm>
#include <array>
#include <utility>

#include "sim/base/text.h"
#include "sim/nc/sinumerik_block_parser.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::nc {
namespace {

// Beyond what 512 characters can hold; they keep a hostile line from eating memory.
constexpr std::size_t kMaxParts = 256;

struct NamedModifier {
  std::string_view name;
  SinumerikModifier modifier;
};
constexpr std::array<NamedModifier, 11> kModifiers = {{
    {"AC", SinumerikModifier::kAc},
    {"ACN", SinumerikModifier::kAcn},
    {"ACP", SinumerikModifier::kAcp},
    {"CAC", SinumerikModifier::kCoded},
    {"CACN", SinumerikModifier::kCoded},
    {"CACP", SinumerikModifier::kCoded},
    {"CDC", SinumerikModifier::kCoded},
    {"CIC", SinumerikModifier::kCoded},
    {"DC", SinumerikModifier::kDc},
    {"IC", SinumerikModifier::kIc},
    {"QU", SinumerikModifier::kOutput},
}};

bool IsSign(char c) { return c == '-' || c == '+'; }

}  // namespace

std::string_view ToString(SinumerikType type) {
  constexpr std::array<std::string_view, 7> kNames = {"BOOL",   "CHAR", "INT",  "REAL",
                                                      "STRING", "AXIS", "FRAME"};
  return kNames[static_cast<std::size_t>(type)];
}

void SinumerikBlockParser::Parse() {
  block_.skip_level = -1;
  block_.sequence = -1;
  block_.has_header = false;
  block_.header = {};
  block_.label = {};
  block_.parts.clear();
  block_.targets.clear();
  block_.arguments.clear();
  block_.code.clear();
  block_.comment = {};
  block_.errors.clear();
  ParseLine();
  if (scanner_.consumed() > kMaxSinumerikBlock && block_.errors.empty()) {
    Fail(1, 12540, "the block is longer than 512 characters");
  }
  if (scanner_.Peek() == ';' && !scanner_.AtEnd()) {
    const char* begin = scanner_.position() + 1;
    scanner_.SkipToLineEnd();
    block_.comment = {begin, static_cast<std::size_t>(scanner_.position() - begin)};
  }
  scanner_.SkipToLineEnd();
  scanner_.SkipLineEnd();
  block_.next = block_.offset + scanner_.consumed();
}

void SinumerikBlockParser::Fail(int column, int alarm, std::string message) {
  expressions_.Fail(column, alarm, std::move(message));
  scanner_.SkipToLineEnd();
}

SinumerikPart SinumerikBlockParser::Begin(SinumerikPartKind kind, std::string_view name,
                                          int column) const {
  SinumerikPart part;
  part.kind = kind;
  part.name = name;
  part.column = column;
  return part;
}

SinumerikPart* SinumerikBlockParser::Add(const SinumerikPart& part) {
  if (block_.parts.size() == kMaxParts) {
    Fail(part.column, 12540, "the block is too complex");
    return nullptr;
  }
  SinumerikPart& added = block_.parts.emplace_back(part);
  added.length = static_cast<std::uint32_t>(scanner_.column() - part.column);
  return &added;
}

bool SinumerikBlockParser::NextIs(std::string_view upper) const {
  return SameName(PeekName(scanner_), upper);
}

bool SinumerikBlockParser::TakeName(std::string_view upper) {
  scanner_.SkipSpaces();
  if (!NextIs(upper)) return false;
  scanner_.Advance(upper.size());
  return true;
}

void SinumerikBlockParser::ParseLine() {
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '%') return ParseHeader();
  if (scanner_.Peek() == '/' && !ParseSkip()) return;
  if (!ParseSequence()) return;
  ParseLabel();
  while (true) {
    scanner_.SkipSpaces();
    if (AtBlockEnd()) return;
    ParsePart();
  }
}

/// `%_N_SHAFT123_MPF` (NC programming 12/2019, p. 43).
void SinumerikBlockParser::ParseHeader() {
  scanner_.Advance();
  const char* begin = scanner_.position();
  while (!AtBlockEnd() && !IsSpace(scanner_.Peek())) scanner_.Advance();
  block_.has_header = true;
  block_.header = {begin, static_cast<std::size_t>(scanner_.position() - begin)};
  scanner_.SkipSpaces();
  if (!AtBlockEnd()) Fail(scanner_.column(), 12080, "'%' and its name must stand alone");
}

/// `/`, `/0` to `/9`: skip levels. Several may stand in a row: the first counts.
bool SinumerikBlockParser::ParseSkip() {
  scanner_.Advance();
  block_.skip_level = 0;
  if (IsDigit(scanner_.Peek())) {
    block_.skip_level = scanner_.Peek() - '0';
    scanner_.Advance();
    if (IsDigit(scanner_.Peek())) {
      Fail(1, 12080, "a skip level is 0 to 9");
      return false;
    }
  }
  scanner_.SkipSpaces();
  return true;
}

/// N, or `:` of a main block.
bool SinumerikBlockParser::ParseSequence() {
  const char c = Upper(scanner_.Peek());
  if ((c != 'N' && c != ':') || !IsDigit(scanner_.PeekAfter(1))) return true;
  const int column = scanner_.column();
  scanner_.Advance();
  const long number = scanner_.ReadDigits();
  if (number < 0) {
    Fail(column, 12160, "a block number with more than 9 digits");
    return false;
  }
  block_.sequence = number;
  scanner_.SkipSpaces();
  return true;
}

void SinumerikBlockParser::ParseLabel() {
  const std::string_view name = PeekName(scanner_);
  if (name.empty() || name[0] == '$' || scanner_.PeekAfter(name.size()) != ':') return;
  block_.label = name;
  block_.label_column = scanner_.column();
  if (name.size() > kMaxSinumerikName) {
    return Fail(block_.label_column, 12420, "the label is longer than 31 characters");
  }
  scanner_.Advance(name.size() + 1);
}

void SinumerikBlockParser::ParsePart() {
  const char c = scanner_.Peek();
  if (IsLetter(c) && !IsNameStart(scanner_.PeekAfter(1))) return ParseLetter();
  const std::string_view name = PeekName(scanner_);
  if (!name.empty()) return ParseName(name);
  const int column = scanner_.column();
  if (c == '&') return scanner_.Advance();
  if (IsDigit(c) || c == '.' || IsSign(c)) {
    return Fail(column, 12080, "a number without an address before it");
  }
  if (c == '/') return Fail(column, 12080, "'/' skips a block only at its beginning");
  if (c == '(') return Fail(column, 12080, "'(' without a name before it");
  Fail(column, 12080, Quoted(c) + " has no meaning in a block");
}

/// A one-letter address: with its number, an extension (`M1=6`) or `=`.
void SinumerikBlockParser::ParseLetter() {
  const int column = scanner_.column();
  const char letter = Upper(scanner_.Peek());
  if (letter == 'N' && IsDigit(scanner_.PeekAfter(1))) {
    return Fail(column, 12080, "the block number N must stand at the beginning of its block");
  }
  const char next = scanner_.PeekAfter(1);
  if (IsDigit(next) || next == '.' || IsSign(next)) return ParseNumberWord(letter, column);
  scanner_.Advance();
  scanner_.SkipSpaces();
  const bool equals = scanner_.Peek() == '=' && scanner_.PeekAfter(1) != '=';
  if (equals || scanner_.Peek() == '[') return ParseLetterAssign(letter, column, 1, -1);
  Fail(column, 12080, std::string("the address ") + letter + " has no value");
}

void SinumerikBlockParser::ParseNumberWord(char letter, int column) {
  const char* begin = scanner_.position();
  scanner_.Advance();
  const char sign = scanner_.Peek();
  if (IsSign(sign)) scanner_.Advance();
  SinumerikNumber number;
  if (IsSign(sign) && !IsDigit(scanner_.Peek()) && scanner_.Peek() != '.') {
    return Fail(column, 12080, std::string("the address ") + letter + " has a sign but no number");
  }
  const std::string error = ReadSinumerikNumber(&scanner_, &number);
  if (!error.empty()) {
    block_.errors.push_back({column, error});
    return scanner_.SkipToLineEnd();
  }
  const auto size = static_cast<std::size_t>(scanner_.position() - begin);
  const char behind = scanner_.Peek();
  if (behind == '_') {
    return Fail(scanner_.column(), 12080, "a blank is missing before the name");
  }
  if (number.is_integer && !IsSign(sign) &&
      (IsSpace(behind) || behind == '=' || behind == '(' || behind == '[')) {
    Scanner ahead = scanner_;
    ahead.SkipSpaces();
    const char c = ahead.Peek();
    if (c == '=' || c == '[' || c == '(') {
      scanner_ = ahead;
      if (c == '(') return ParseLetterCall(letter, column, size);
      return ParseLetterAssign(letter, column, size, static_cast<int>(number.value));
    }
  }
  SinumerikPart part;
  part.kind = SinumerikPartKind::kWord;
  part.letter = letter;
  part.is_integer = number.is_integer;
  part.column = column;
  part.value = sign == '-' ? -number.value : number.value;
  part.name = {begin, size};
  Add(part);
}

/// At `=` or `[` behind a letter and, if not -1, its extension.
void SinumerikBlockParser::ParseLetterAssign(char letter, int column, std::size_t name_size,
                                             int extension) {
  if (letter == 'N' || (letter == 'G' && extension >= 0)) {
    return Fail(scanner_.column(), 12080,
                std::string("the address ") + letter +
                    " takes no extension and no '=' behind its "
                    "number");
  }
  if (scanner_.Peek() == '[' && extension >= 0) {
    return Fail(scanner_.column(), 12080,
                std::string("the address ") + letter + " has a number and an index");
  }
  const std::string_view name(scanner_.position() - (scanner_.column() - column), name_size);
  SinumerikPart part = Begin(SinumerikPartKind::kAssign, name, column);
  part.letter = letter;
  part.extension = extension;
  if (ParseAssigned(&part)) Add(part);
}

/// `L340(_B10)`: a subprogram; M functions may call one too.
void SinumerikBlockParser::ParseLetterCall(char letter, int column, std::size_t name_size) {
  if (letter != 'L' && letter != 'M') {
    return Fail(scanner_.column(), 12080, std::string("'(' behind the address ") + letter);
  }
  const std::string_view name(scanner_.position() - (scanner_.column() - column), name_size);
  SinumerikPart part = Begin(SinumerikPartKind::kCall, name, column);
  part.has_arguments = true;
  scanner_.Advance();
  if (!expressions_.ParseList(')', &part.first_argument, &part.argument_count)) {
    return scanner_.SkipToLineEnd();
  }
  Add(part);
}

void SinumerikBlockParser::ParseName(std::string_view name) {
  const int column = scanner_.column();
  if (name.size() > kMaxSinumerikName + 1) {
    return Fail(column, 12420, "the name is longer than 31 characters");
  }
  if (ParseKeyword(name)) return;
  scanner_.Advance(name.size());
  SinumerikPart part = Begin(SinumerikPartKind::kName, name, column);
  Scanner ahead = scanner_;
  ahead.SkipSpaces();
  const char c = ahead.Peek();
  if (c == '(') {
    scanner_ = ahead;
    scanner_.Advance();
    part.kind = SinumerikPartKind::kCall;
    part.has_arguments = true;
    if (!expressions_.ParseList(')', &part.first_argument, &part.argument_count)) {
      return scanner_.SkipToLineEnd();
    }
  } else if (c == '[' || c == '=') {
    scanner_ = ahead;
    part.kind = SinumerikPartKind::kAssign;
    const bool axis = name.size() > 2 && SameName(name.substr(0, 2), "AX") &&
                      std::all_of(name.begin() + 2, name.end(), IsDigit);
    if (c == '[' && axis) return Fail(scanner_.column(), 12080, "an axis takes no index");
    if (!ParseAssigned(&part)) return;
  } else if (name[0] == '$') {
    return Fail(column, 12080, "a system variable that is neither set nor used");
  }
  Add(part);
}

/// At `[` or `=`: indices, `=`, the value. False: an error was added.
bool SinumerikBlockParser::ParseAssigned(SinumerikPart* part) {
  if (scanner_.Peek() == '[') {
    scanner_.Advance();
    if (!expressions_.ParseList(']', &part->first_index, &part->index_count)) {
      scanner_.SkipToLineEnd();
      return false;
    }
    scanner_.SkipSpaces();
  }
  if (scanner_.Peek() != '=' || scanner_.PeekAfter(1) == '=') {
    Fail(scanner_.column(), 12080, "'=' is missing behind " + std::string(part->name));
    return false;
  }
  scanner_.Advance();
  scanner_.SkipSpaces();
  if (ParseModified(part)) return true;
  if (block_.errors.empty()) {
    if (expressions_.Parse(&part->expression)) {
      scanner_.SkipSpaces();
      if (scanner_.Peek() != '=') return true;
      Fail(scanner_.column(), 12080, "'=' behind a value");
    }
  }
  scanner_.SkipToLineEnd();
  return false;
}

/// `AC(5)`, `SET(1,2)`, `REP(0)`. False: it is a plain value, or an error was added.
bool SinumerikBlockParser::ParseModified(SinumerikPart* part) {
  const std::string_view name = PeekName(scanner_);
  if (name.empty()) return false;
  SinumerikModifier modifier = SinumerikModifier::kNone;
  for (const NamedModifier& named : kModifiers) {
    if (SameName(name, named.name)) modifier = named.modifier;
  }
  SinumerikList list = SinumerikList::kNone;
  if (SameName(name, "SET")) list = SinumerikList::kSet;
  if (SameName(name, "REP")) list = SinumerikList::kRepeat;
  if (modifier == SinumerikModifier::kNone && list == SinumerikList::kNone) return false;
  Scanner ahead = scanner_;
  ahead.Advance(name.size());
  ahead.SkipSpaces();
  if (ahead.Peek() != '(') return false;
  const int column = scanner_.column();
  scanner_ = ahead;
  scanner_.Advance();
  part->modifier = modifier;
  part->list = list;
  if (!expressions_.ParseList(')', &part->first_argument, &part->argument_count)) return false;
  if (list != SinumerikList::kNone) {
    if (part->argument_count > 0) return true;
  } else if (part->argument_count == 1 && !block_.arguments.back().empty()) {
    part->expression = block_.arguments.back();
    return true;
  }
  expressions_.Fail(column, 12080, UpperName(name) + " needs a value in its parentheses");
  return false;
}

void ParseSinumerikBlock(const Program& program, std::size_t offset, int line,
                         SinumerikBlock* block) {
  SinumerikBlockParser parser(program.text(), offset, line, block);
  parser.Parse();
}

}  // namespace ncsim::nc
