// SPDX-License-Identifier: BSD-3-Clause
// DEF, PROC, EXTERN, and the statements of definition files (NC programming 12/2019, "Variables",
// "Subprogram technique").
#include <array>

#include "sim/nc/sinumerik_block_parser.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::nc {
namespace {

using PartKind = SinumerikPartKind;

constexpr std::size_t kMaxSizes = 3;

constexpr std::array<SinumerikType, 7> kTypes = {
    SinumerikType::kBool,   SinumerikType::kChar, SinumerikType::kInt,  SinumerikType::kReal,
    SinumerikType::kString, SinumerikType::kAxis, SinumerikType::kFrame};

/// Of DEF, without a value: where the variable is kept, and when it is set anew.
constexpr std::array<std::string_view, 9> kScopes = {"NCK",   "CHAN",  "SYNR",  "SYNW", "SYNRW",
                                                     "INIPO", "INIRE", "INICF", "PRLOC"};
/// Of DEF, with a value: access rights, unit, limits.
constexpr std::array<std::string_view, 12> kValued = {
    "APR", "APW", "APX", "APRP", "APWP", "APXP", "APRB", "APWB", "APXB", "PHU", "LLI", "ULI"};
constexpr std::array<std::string_view, 13> kAttributes = {
    "ACTBLOCNO", "DELAYFSTOF", "DELAYFSTON", "DISPLOF", "DISPLON", "ICYCOF", "ICYCON",
    "IPTRLOCK",  "IPTRUNLOCK", "PREPRO",     "SAVE",    "SBLOF",   "SBLON"};

template <std::size_t N>
bool Contains(const std::array<std::string_view, N>& names, std::string_view name) {
  for (const std::string_view candidate : names) {
    if (SameName(name, candidate)) return true;
  }
  return false;
}

}  // namespace

bool SinumerikBlockParser::ParseType(SinumerikPart* part) {
  scanner_.SkipSpaces();
  const std::string_view name = PeekName(scanner_);
  for (const SinumerikType type : kTypes) {
    if (!SameName(name, ToString(type))) continue;
    part->type = type;
    scanner_.Advance(name.size());
    return true;
  }
  Fail(scanner_.column(), 12080,
       "a type is missing here: INT, REAL, BOOL, CHAR, STRING[n], AXIS or FRAME");
  return false;
}

/// `DEF [NCK] REAL name[sizes] = value, name ...`.
void SinumerikBlockParser::ParseDefine(SinumerikPart part) {
  if (!block_.parts.empty()) return Fail(part.column, 12080, "DEF must be the first word");
  if (!ParseDefinitionHead(&part) || Add(part) == nullptr) return;
  do {
    scanner_.SkipSpaces();
    if (!ParseDefinedName()) return;
    scanner_.SkipSpaces();
    const bool more = scanner_.Peek() == ',';
    if (more) scanner_.Advance();
    if (!more) break;
  } while (true);
  if (!AtBlockEnd()) Fail(scanner_.column(), 12080, "',' or the end of the block is missing here");
}

/// Up to the first name.
bool SinumerikBlockParser::ParseDefinitionHead(SinumerikPart* part) {
  const auto skip_attributes = [&] {
    while (true) {
      scanner_.SkipSpaces();
      const std::string_view name = PeekName(scanner_);
      if (Contains(kScopes, name)) {
        if (SameName(name, "NCK") || SameName(name, "CHAN")) part->is_global = true;
        scanner_.Advance(name.size());
      } else if (!Contains(kValued, name)) {
        return true;
      } else if (!ParseAttributeValue(name)) {
        return false;
      }
    }
  };
  if (!skip_attributes() || !ParseType(part)) return false;
  if (part->type == SinumerikType::kString) {
    scanner_.SkipSpaces();
    if (scanner_.Peek() != '[') {
      Fail(scanner_.column(), 12080, "STRING needs its length in brackets");
      return false;
    }
    scanner_.Advance();
    if (!expressions_.Parse(&part->second)) {
      scanner_.SkipToLineEnd();
      return false;
    }
    scanner_.SkipSpaces();
    if (scanner_.Peek() != ']') {
      Fail(scanner_.column(), 12080, "']' is missing");
      return false;
    }
    scanner_.Advance();
  }
  return skip_attributes();
}

/// `APW 5`, `LLI -100.0`: not needed to run a program.
bool SinumerikBlockParser::ParseAttributeValue(std::string_view name) {
  scanner_.Advance(name.size());
  SinumerikExpression value;
  if (expressions_.ParseConstant(&value)) return true;
  scanner_.SkipToLineEnd();
  return false;
}

bool SinumerikBlockParser::ParseDefinedName() {
  const std::string_view name = PeekName(scanner_);
  const int column = scanner_.column();
  if (name.empty() || name[0] == '$') {
    Fail(column, 12080,
         "the name of a variable is missing here (two letters or underscores first)");
    return false;
  }
  if (name.size() > kMaxSinumerikName) {
    Fail(column, 12420, "the name is longer than 31 characters");
    return false;
  }
  scanner_.Advance(name.size());
  SinumerikPart part = Begin(PartKind::kDefinedName, name, column);
  if (!ParseSizes(&part)) return false;
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '=') {
    scanner_.Advance();
    scanner_.SkipSpaces();
    const bool list = part.index_count > 0 && scanner_.Peek() == '(';
    if (list) {
      // `= (1,2)` is short for SET.
      scanner_.Advance();
      part.list = SinumerikList::kSet;
      if (!expressions_.ParseList(')', &part.first_argument, &part.argument_count)) {
        scanner_.SkipToLineEnd();
        return false;
      }
    } else if (!ParseModified(&part)) {
      if (!block_.errors.empty() || !expressions_.Parse(&part.expression)) {
        scanner_.SkipToLineEnd();
        return false;
      }
    }
  }
  return Add(part) != nullptr;
}

/// `[3,4]`, or nothing.
bool SinumerikBlockParser::ParseSizes(SinumerikPart* part) {
  scanner_.SkipSpaces();
  if (scanner_.Peek() != '[') return true;
  const int column = scanner_.column();
  scanner_.Advance();
  if (!expressions_.ParseList(']', &part->first_index, &part->index_count)) {
    scanner_.SkipToLineEnd();
    return false;
  }
  if (part->index_count == 0 || part->index_count > kMaxSizes) {
    Fail(column, 12190, "an array has one to three sizes");
    return false;
  }
  return true;
}

/// `PROC NAME(REAL A, VAR INT B, REAL C = 1) SAVE DISPLOF`.
void SinumerikBlockParser::ParseProcedure(SinumerikPart part) {
  scanner_.SkipSpaces();
  part.name = PeekOperandName(scanner_);
  if (part.name.size() < 2) return Fail(part.column, 12080, "PROC needs a name");
  scanner_.Advance(part.name.size());
  if (Add(part) == nullptr) return;
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '(' && !ParseParameters(true)) return;
  while (true) {
    scanner_.SkipSpaces();
    if (AtBlockEnd()) return;
    const std::string_view name = PeekName(scanner_);
    if (!Contains(kAttributes, name)) {
      return Fail(scanner_.column(), 12080, "this is no attribute of PROC");
    }
    const SinumerikPart attribute = Begin(PartKind::kAttribute, name, scanner_.column());
    scanner_.Advance(name.size());
    if (Add(attribute) == nullptr) return;
  }
}

void SinumerikBlockParser::ParseExternal(SinumerikPart part) {
  scanner_.SkipSpaces();
  part.name = PeekOperandName(scanner_);
  if (part.name.size() < 2)
    return Fail(part.column, 12080, "EXTERN needs the name of a subprogram");
  scanner_.Advance(part.name.size());
  if (Add(part) == nullptr) return;
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '(' && !ParseParameters(false)) return;
  scanner_.SkipSpaces();
  if (!AtBlockEnd()) Fail(scanner_.column(), 12080, "nothing may follow the declaration");
}

bool SinumerikBlockParser::ParseParameters(bool named) {
  scanner_.Advance();
  scanner_.SkipSpaces();
  if (scanner_.Peek() == ')') {
    scanner_.Advance();
    return true;
  }
  while (true) {
    if (!ParseParameter(named)) return false;
    scanner_.SkipSpaces();
    if (scanner_.Peek() == ')') break;
    if (scanner_.Peek() != ',') {
      Fail(scanner_.column(), 12080, "',' or ')' is missing");
      return false;
    }
    scanner_.Advance();
  }
  scanner_.Advance();
  return true;
}

bool SinumerikBlockParser::ParseParameter(bool named) {
  scanner_.SkipSpaces();
  SinumerikPart part = Begin(PartKind::kParameter, {}, scanner_.column());
  part.by_reference = TakeName("VAR");
  if (!ParseType(&part)) return false;
  scanner_.SkipSpaces();
  // The length of a STRING is that of what is passed.
  if (part.type == SinumerikType::kString && scanner_.Peek() == '[') {
    SinumerikPart length;
    if (!ParseSizes(&length)) return false;
    scanner_.SkipSpaces();
  }
  if (named) {
    part.name = PeekName(scanner_);
    if (part.name.empty()) {
      Fail(scanner_.column(), 12080, "the name of a parameter is missing here");
      return false;
    }
    scanner_.Advance(part.name.size());
  }
  if (!ParseSizes(&part)) return false;
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '=') {
    scanner_.Advance();
    if (!expressions_.Parse(&part.expression)) {
      scanner_.SkipToLineEnd();
      return false;
    }
  }
  return Add(part) != nullptr;
}

/// `DEFINE name AS text`: a macro. Its text stands for the name anywhere, so it is not simulated.
void SinumerikBlockParser::ParseMacro(SinumerikPart part) {
  scanner_.SkipSpaces();
  const std::string_view name = PeekOperandName(scanner_);
  if (name.empty() || name[0] == '$') {
    return Fail(part.column, 12080, "DEFINE needs a name");
  }
  scanner_.Advance(name.size());
  if (!TakeName("AS")) return Fail(scanner_.column(), 12080, "AS is missing");
  scanner_.SkipSpaces();
  if (AtBlockEnd()) return Fail(part.column, 12080, "the text of the macro is missing");
  SinumerikPart macro = Begin(PartKind::kDefinedName, name, part.column);
  if (Add(part) == nullptr || Add(macro) == nullptr) return;
  scanner_.SkipToLineEnd();
}

/// `REDEF name APR 7 INIRE value`: access rights and start values, by definition files.
void SinumerikBlockParser::ParseRedefine(SinumerikPart part) {
  scanner_.SkipSpaces();
  const std::string_view name = PeekName(scanner_);
  if (name.empty()) return Fail(part.column, 12080, "REDEF needs the name of a variable");
  scanner_.Advance(name.size());
  bool has_scope = false;
  while (true) {
    scanner_.SkipSpaces();
    if (AtBlockEnd()) break;
    const int column = scanner_.column();
    const std::string_view attribute = PeekName(scanner_);
    if (Contains(kValued, attribute)) {
      if (!ParseAttributeValue(attribute)) return;
    } else if (Contains(kScopes, attribute) && !has_scope) {
      has_scope = true;
      scanner_.Advance(attribute.size());
      scanner_.SkipSpaces();
      SinumerikExpression value;
      if (!AtBlockEnd() && !expressions_.Parse(&value)) return scanner_.SkipToLineEnd();
    } else {
      return Fail(column, 12080, "this is no attribute of REDEF");
    }
  }
  Add(part);
}

}  // namespace ncsim::nc
