// SPDX-License-Identifier: BSD-3-Clause
// Statements of the SINUMERIK language: jumps, control structures, calls, synchronised actions (NC
// programming 12/2019, "Flexible NC programming").
#include <algorithm>
#include <array>
#include <optional>

#include "sim/base/text.h"
#include "sim/nc/sinumerik_block_parser.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::nc {
namespace {

using PartKind = SinumerikPartKind;

struct Keyword {
  std::string_view name;
  PartKind kind;
};
/// By name.
constexpr std::array<Keyword, 42> kKeywords = {{
    {"CALL", PartKind::kCallName},
    {"CASE", PartKind::kCase},
    {"CTABDEF", PartKind::kUnsimulated},
    {"DEF", PartKind::kDefine},
    {"DEFINE", PartKind::kUnsimulated},
    {"DO", PartKind::kSynchronous},
    {"ELSE", PartKind::kElse},
    {"ENDFOR", PartKind::kEndFor},
    {"ENDIF", PartKind::kEndIf},
    {"ENDLABEL", PartKind::kEndLabel},
    {"ENDLOOP", PartKind::kEndLoop},
    {"ENDPROC", PartKind::kReturn},
    {"ENDWHILE", PartKind::kEndWhile},
    {"EVERY", PartKind::kSynchronous},
    {"EXTCALL", PartKind::kCallName},
    {"EXTERN", PartKind::kExternal},
    {"FOR", PartKind::kFor},
    {"FROM", PartKind::kSynchronous},
    {"GOTO", PartKind::kGoto},
    {"GOTOB", PartKind::kGoto},
    {"GOTOC", PartKind::kGoto},
    {"GOTOF", PartKind::kGoto},
    {"GOTOS", PartKind::kGoto},
    {"ID", PartKind::kSynchronous},
    {"IDS", PartKind::kSynchronous},
    {"IF", PartKind::kIf},
    {"ISOCALL", PartKind::kUnsimulated},
    {"LOOP", PartKind::kLoop},
    {"MCALL", PartKind::kModalCall},
    {"PCALL", PartKind::kCallPath},
    {"PROC", PartKind::kProcedure},
    {"REDEF", PartKind::kUnsimulated},
    {"REPEAT", PartKind::kRepeat},
    {"REPEATB", PartKind::kRepeatBlock},
    {"RET", PartKind::kReturn},
    {"RETB", PartKind::kReturn},
    {"SETINT", PartKind::kUnsimulated},
    {"TO", PartKind::kElse},
    {"UNTIL", PartKind::kUntil},
    {"WHEN", PartKind::kSynchronous},
    {"WHENEVER", PartKind::kSynchronous},
    {"WHILE", PartKind::kWhile},
}};

const Keyword* FindKeyword(std::string_view name) {
  const std::string upper = UpperName(name);
  const auto found = std::lower_bound(
      kKeywords.begin(), kKeywords.end(), upper,
      [](const Keyword& keyword, std::string_view key) { return keyword.name < key; });
  return found != kKeywords.end() && found->name == upper ? found : nullptr;
}

std::optional<SinumerikJump> JumpOf(std::string_view name) {
  if (SameName(name, "GOTOF")) return SinumerikJump::kForward;
  if (SameName(name, "GOTOB")) return SinumerikJump::kBackward;
  if (SameName(name, "GOTO")) return SinumerikJump::kBoth;
  if (SameName(name, "GOTOC")) return SinumerikJump::kQuiet;
  if (SameName(name, "GOTOS")) return SinumerikJump::kToStart;
  return std::nullopt;
}

/// "Blocks with control elements" may carry no label and may not be skipped.
bool IsStructure(PartKind kind) {
  switch (kind) {
    case PartKind::kIf:
    case PartKind::kElse:
    case PartKind::kEndIf:
    case PartKind::kFor:
    case PartKind::kEndFor:
    case PartKind::kWhile:
    case PartKind::kEndWhile:
    case PartKind::kLoop:
    case PartKind::kEndLoop:
    case PartKind::kRepeat:
    case PartKind::kUntil:
      return true;
    default:
      return false;
  }
}

}  // namespace

/// False, and nothing consumed, where the name is no keyword.
bool SinumerikBlockParser::ParseKeyword(std::string_view name) {
  // The longest keyword has 8 letters; `$` begins none.
  if (name.size() > 8 || name[0] == '$' || name[0] == '_') return false;
  const Keyword* keyword = FindKeyword(name);
  if (keyword == nullptr) return false;
  ParseStatement(keyword->kind, name);
  return true;
}

void SinumerikBlockParser::ParseStatement(PartKind kind, std::string_view name) {
  SinumerikPart part = Begin(kind, name, scanner_.column());
  scanner_.Advance(name.size());
  switch (kind) {
    case PartKind::kIf:
      return ParseIf(part);
    case PartKind::kElse:
      if (!SameName(name, "ELSE")) return Fail(part.column, 12080, UpperName(name) + " alone");
      if (!synchronous_) return AddAlone(part);
      if (has_else_) return Fail(part.column, 12080, "a second ELSE");
      has_else_ = true;
      return;
    case PartKind::kFor:
      return ParseFor(part);
    case PartKind::kWhile:
    case PartKind::kUntil:
      return ParseCondition(part);
    case PartKind::kGoto:
      return ParseGoto(part);
    case PartKind::kCase:
      return ParseCase(part);
    case PartKind::kRepeat:
    case PartKind::kRepeatBlock:
      return ParseRepeat(part);
    case PartKind::kDefine:
      return ParseDefine(part);
    case PartKind::kProcedure:
      return ParseProcedure(part);
    case PartKind::kExternal:
      return ParseExternal(part);
    case PartKind::kCallName:
      return ParseCallStatement(part);
    case PartKind::kCallPath:
      return ParsePathCall(part);
    case PartKind::kModalCall:
      return ParseModalCall(part);
    case PartKind::kReturn:
      return ParseReturn(part);
    case PartKind::kSynchronous:
      return ParseSynchronous(part);
    case PartKind::kUnsimulated:
      if (SameName(name, "DEFINE")) return ParseMacro(part);
      if (SameName(name, "REDEF")) return ParseRedefine(part);
      Add(part);
      return scanner_.SkipToLineEnd();
    default:
      return AddAlone(part);
  }
}

/// A part that must be the only one of its block.
void SinumerikBlockParser::AddAlone(const SinumerikPart& part) {
  const std::string name = UpperName(part.name);
  if (!block_.parts.empty()) {
    return Fail(part.column, 12080, name + " must be the first word of its block");
  }
  if (IsStructure(part.kind) && (block_.skip_level >= 0 || !block_.label.empty())) {
    return Fail(part.column, 12630, "a block with " + name + " has a label or can be skipped");
  }
  Add(part);
  scanner_.SkipSpaces();
  if (!AtBlockEnd()) Fail(scanner_.column(), 12080, "nothing may follow " + name);
}

void SinumerikBlockParser::ParseCondition(SinumerikPart part) {
  if (!expressions_.Parse(&part.expression)) return scanner_.SkipToLineEnd();
  AddAlone(part);
}

void SinumerikBlockParser::ParseIf(SinumerikPart part) {
  if (!expressions_.Parse(&part.expression)) return scanner_.SkipToLineEnd();
  scanner_.SkipSpaces();
  const std::string_view next = PeekName(scanner_);
  if (!JumpOf(next)) return AddAlone(part);
  part.kind = PartKind::kIfGoto;
  if (Add(part) != nullptr) ParseStatement(PartKind::kGoto, next);
}

void SinumerikBlockParser::ParseFor(SinumerikPart part) {
  scanner_.SkipSpaces();
  part.name = PeekOperandName(scanner_);
  if (part.name.empty()) return Fail(part.column, 12080, "FOR needs a variable");
  const std::string_view variable = part.name;
  scanner_.Advance(variable.size());
  scanner_.SkipSpaces();
  if (!ParseAssigned(&part)) return;
  if (part.list != SinumerikList::kNone || part.modifier != SinumerikModifier::kNone) {
    return Fail(part.column, 12080, "FOR needs a plain start value");
  }
  if (!TakeName("TO")) return Fail(scanner_.column(), 12080, "TO is missing");
  if (!expressions_.Parse(&part.second)) return scanner_.SkipToLineEnd();
  AddAlone(part);
}

/// A label, a block number, or an expression of type STRING.
bool SinumerikBlockParser::ParseTarget(SinumerikTarget* target) {
  scanner_.SkipSpaces();
  target->column = scanner_.column();
  if (scanner_.Peek() == ':' && IsDigit(scanner_.PeekAfter(1))) {
    const char* begin = scanner_.position();
    scanner_.Advance();
    while (IsDigit(scanner_.Peek())) scanner_.Advance();
    target->label = {begin, static_cast<std::size_t>(scanner_.position() - begin)};
    return true;
  }
  const std::string_view name = PeekOperandName(scanner_);
  if (!name.empty() && name[0] != '$') {
    Scanner ahead = scanner_;
    ahead.Advance(name.size());
    ahead.SkipSpaces();
    const char c = ahead.Peek();
    const bool plain = c != '[' && c != '(' && !(c == '<' && ahead.PeekAfter(1) == '<');
    if (plain) {
      if (name.size() == 1 || (!IsNameStart(name[1]) && Upper(name[0]) != 'N')) {
        Fail(target->column, 12080,
             "'" + std::string(name) + "' is neither label nor block number");
        return false;
      }
      if (name[0] == '_' && name.size() > 1 && IsDigit(name[1])) {
        Fail(target->column, 12080, "'" + std::string(name) + "' is no label");
        return false;
      }
      scanner_.Advance(name.size());
      target->label = name;
      return true;
    }
  }
  if (AtBlockEnd()) {
    Fail(target->column, 12080, "a label or block number is missing here");
    return false;
  }
  if (expressions_.Parse(&target->expression)) return true;
  scanner_.SkipToLineEnd();
  return false;
}

bool SinumerikBlockParser::ParseJumpWord(SinumerikPart* part) {
  const std::optional<SinumerikJump> jump = JumpOf(part->name);
  part->jump = *jump;
  if (*jump == SinumerikJump::kToStart) return true;
  SinumerikTarget target;
  if (!ParseTarget(&target)) return false;
  part->first_target = static_cast<std::uint32_t>(block_.targets.size());
  block_.targets.push_back(target);
  return true;
}

void SinumerikBlockParser::ParseGoto(SinumerikPart part) {
  if (ParseJumpWord(&part)) Add(part);
}

/// `CASE value OF 1 GOTOF L1 2 GOTOF L2 DEFAULT GOTOF L3`.
void SinumerikBlockParser::ParseCase(SinumerikPart part) {
  if (!expressions_.Parse(&part.expression)) return scanner_.SkipToLineEnd();
  if (!TakeName("OF")) return Fail(scanner_.column(), 12080, "OF is missing");
  if (Add(part) == nullptr) return;
  std::size_t branches = 0;
  while (true) {
    scanner_.SkipSpaces();
    if (AtBlockEnd()) break;
    SinumerikPart branch = Begin(PartKind::kCaseBranch, {}, scanner_.column());
    const bool is_default = TakeName("DEFAULT");
    if (is_default) branch.kind = PartKind::kCaseDefault;
    if (!is_default && !expressions_.ParseConstant(&branch.expression)) {
      return scanner_.SkipToLineEnd();
    }
    if (!ParseBranch(&branch) || Add(branch) == nullptr) return;
    ++branches;
    if (is_default) break;
  }
  if (branches == 0) return Fail(part.column, 12080, "CASE has no branch");
  scanner_.SkipSpaces();
  if (!AtBlockEnd()) Fail(scanner_.column(), 12080, "nothing may follow DEFAULT and its jump");
}

bool SinumerikBlockParser::ParseBranch(SinumerikPart* branch) {
  scanner_.SkipSpaces();
  branch->name = PeekName(scanner_);
  const std::optional<SinumerikJump> jump = JumpOf(branch->name);
  if (!jump || *jump == SinumerikJump::kToStart) {
    Fail(scanner_.column(), 12080, "a branch of CASE needs GOTO, GOTOF, GOTOB or GOTOC");
    return false;
  }
  scanner_.Advance(branch->name.size());
  return ParseJumpWord(branch);
}

/// `REPEAT` alone begins a loop to UNTIL; `REPEAT L1 [L2] [P=n]` and `REPEATB L [P=n]` repeat what
/// is marked by labels.
void SinumerikBlockParser::ParseRepeat(SinumerikPart part) {
  scanner_.SkipSpaces();
  if (AtBlockEnd() && part.kind == PartKind::kRepeat) return AddAlone(part);
  const bool section = part.kind == PartKind::kRepeat;
  if (section) part.kind = PartKind::kRepeatSection;
  SinumerikTarget first;
  SinumerikTarget second;
  if (!ParseTarget(&first)) return;
  scanner_.SkipSpaces();
  const auto at_count = [&] {
    return Upper(scanner_.Peek()) == 'P' && !IsNameStart(scanner_.PeekAfter(1));
  };
  if (section && !AtBlockEnd() && !at_count() && !ParseTarget(&second)) return;
  part.first_target = static_cast<std::uint32_t>(block_.targets.size());
  block_.targets.push_back(first);
  block_.targets.push_back(second);
  scanner_.SkipSpaces();
  if (at_count()) {
    scanner_.Advance();
    scanner_.SkipSpaces();
    if (scanner_.Peek() == '=') scanner_.Advance();
    if (!expressions_.Parse(&part.expression)) return scanner_.SkipToLineEnd();
  }
  if (Add(part) == nullptr) return;
  scanner_.SkipSpaces();
  if (!AtBlockEnd()) {
    Fail(scanner_.column(), 12080,
         "nothing but P may follow the labels of " + UpperName(part.name));
  }
}

/// `CALL value`, `CALL [value] BLOCK l1 TO l2`, `EXTCALL value`.
void SinumerikBlockParser::ParseCallStatement(SinumerikPart part) {
  scanner_.SkipSpaces();
  if (!NextIs("BLOCK")) {
    const std::string_view name = PeekOperandName(scanner_);
    if (name.size() > 1 && name[0] != '$' && !IsNameStart(name[1])) {
      return Fail(scanner_.column(), 12080,
                  "'" + std::string(name) + "' is no value of type STRING");
    }
    if (name.size() == 1) return Fail(scanner_.column(), 12080, "an address is no name");
    if (!expressions_.Parse(&part.expression)) return scanner_.SkipToLineEnd();
    const SinumerikCode& last = block_.code[part.expression.end - 1];
    if (last.op == SinumerikOp::kCall &&
        part.expression.end - part.expression.begin == static_cast<std::uint32_t>(last.count) + 1) {
      return Fail(last.column, 12080, "CALL takes no arguments");
    }
  }
  if (TakeName("BLOCK")) {
    part.kind = PartKind::kCallBlock;
    SinumerikTarget first;
    SinumerikTarget second;
    if (!ParseTarget(&first)) return;
    if (!TakeName("TO")) return Fail(scanner_.column(), 12080, "TO is missing");
    if (!ParseTarget(&second)) return;
    part.first_target = static_cast<std::uint32_t>(block_.targets.size());
    block_.targets.push_back(first);
    block_.targets.push_back(second);
  }
  if (Add(part) == nullptr) return;
  scanner_.SkipSpaces();
  if (!AtBlockEnd() && !NextIs("CALL")) {
    Fail(scanner_.column(), 12080, "nothing may follow a call by name");
  }
}

/// `PCALL /_N_WKS_DIR/_N_SHAFT_WPD/SHAFT(par1, par2)`.
void SinumerikBlockParser::ParsePathCall(SinumerikPart part) {
  scanner_.SkipSpaces();
  const char* begin = scanner_.position();
  while (!AtBlockEnd() && !IsSpace(scanner_.Peek()) && scanner_.Peek() != '(') scanner_.Advance();
  part.name = {begin, static_cast<std::size_t>(scanner_.position() - begin)};
  if (part.name.empty()) return Fail(part.column, 12080, "PCALL needs a path");
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '(') {
    scanner_.Advance();
    part.has_arguments = true;
    if (!expressions_.ParseList(')', &part.first_argument, &part.argument_count)) {
      return scanner_.SkipToLineEnd();
    }
  }
  Add(part);
  scanner_.SkipSpaces();
  if (!AtBlockEnd()) Fail(scanner_.column(), 12080, "nothing may follow the path of PCALL");
}

void SinumerikBlockParser::ParseModalCall(SinumerikPart part) {
  part.name = {};
  scanner_.SkipSpaces();
  if (!AtBlockEnd()) {
    part.name = PeekOperandName(scanner_);
    if (part.name.size() < 2 || part.name[0] == '$') {
      return Fail(scanner_.column(), 12080, "MCALL needs the name of a subprogram");
    }
    scanner_.Advance(part.name.size());
    scanner_.SkipSpaces();
    if (scanner_.Peek() == '(') {
      scanner_.Advance();
      part.has_arguments = true;
      if (!expressions_.ParseList(')', &part.first_argument, &part.argument_count)) {
        return scanner_.SkipToLineEnd();
      }
    }
  }
  Add(part);
  scanner_.SkipSpaces();
  if (!AtBlockEnd()) Fail(scanner_.column(), 12080, "nothing may follow the call of MCALL");
}

void SinumerikBlockParser::ParseReturn(SinumerikPart part) {
  scanner_.SkipSpaces();
  if (scanner_.Peek() == '(') {
    scanner_.Advance();
    part.has_arguments = true;
    if (!expressions_.ParseList(')', &part.first_argument, &part.argument_count)) {
      return scanner_.SkipToLineEnd();
    }
  }
  Add(part);
}

/// `ID=1 WHENEVER condition DO ...`: what follows DO stands as parts of its own behind this one.
void SinumerikBlockParser::ParseSynchronous(SinumerikPart part) {
  if (synchronous_) return Fail(part.column, 12080, UpperName(part.name) + " behind DO");
  synchronous_ = true;
  if (Add(part) == nullptr) return;
  std::string_view name = part.name;
  if (SameName(name, "ID") || SameName(name, "IDS")) {
    scanner_.SkipSpaces();
    if (scanner_.Peek() != '=' || scanner_.PeekAfter(1) == '=') {
      return Fail(scanner_.column(), 12080,
                  "'=' and a number are missing behind " + UpperName(name));
    }
    scanner_.Advance();
    SinumerikExpression number;
    if (!expressions_.Parse(&number)) return scanner_.SkipToLineEnd();
    scanner_.SkipSpaces();
    name = PeekName(scanner_);
    const Keyword* next = name.empty() ? nullptr : FindKeyword(name);
    if (next == nullptr || next->kind != PartKind::kSynchronous) {
      return Fail(scanner_.column(), 12080, "a condition or DO is missing here");
    }
    scanner_.Advance(name.size());
  }
  if (!SameName(name, "DO")) {
    scanner_.SkipSpaces();
    // `WHEN G710 (condition) DO`: the unit that the condition is computed in.
    if (Upper(scanner_.Peek()) == 'G' && IsDigit(scanner_.PeekAfter(1))) {
      scanner_.Advance();
      while (IsDigit(scanner_.Peek())) scanner_.Advance();
    }
    SinumerikExpression condition;
    if (!expressions_.Parse(&condition)) return scanner_.SkipToLineEnd();
    if (!TakeName("DO")) return Fail(scanner_.column(), 12080, "DO is missing");
  }
  scanner_.SkipSpaces();
  if (AtBlockEnd()) Fail(scanner_.column(), 12080, "nothing stands behind DO");
}

}  // namespace ncsim::nc
