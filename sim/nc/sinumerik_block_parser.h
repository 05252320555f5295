// SPDX-License-Identifier: BSD-3-Clause
// Internal to sim/nc: one line of a SINUMERIK program -> SinumerikBlock. Words, assignments and
// calls are in sinumerik_block.cc, statements in sinumerik_statement.cc, definitions in
// sinumerik_definition.cc.
#pragma once

#include <string>
#include <string_view>

#include "sim/nc/scanner.h"
#include "sim/nc/sinumerik_block.h"
#include "sim/nc/sinumerik_expression_parser.h"

namespace ncsim::nc {

class SinumerikBlockParser {
 public:
  SinumerikBlockParser(std::string_view text, std::size_t offset, int line, SinumerikBlock* block)
      : scanner_(text, offset), block_(*block), expressions_(&scanner_, block) {
    block_.offset = offset;
    block_.line = line;
  }

  void Parse();

 private:
  // sinumerik_block.cc
  void ParseLine();
  void ParseHeader();
  bool ParseSkip();
  bool ParseSequence();
  void ParseLabel();
  void ParsePart();
  void ParseLetter();
  void ParseNumberWord(char letter, int column);
  void ParseLetterAssign(char letter, int column, std::size_t name_size, int extension);
  void ParseLetterCall(char letter, int column, std::size_t name_size);
  void ParseName(std::string_view name);
  bool ParseAssigned(SinumerikPart* part);
  bool ParseModified(SinumerikPart* part);
  /// An error after which the rest of the line has no meaning.
  void Fail(int column, int alarm, std::string message);
  SinumerikPart* Add(const SinumerikPart& part);
  SinumerikPart Begin(SinumerikPartKind kind, std::string_view name, int column) const;
  /// At the end of the block's code: its comment may follow.
  bool AtBlockEnd() const { return scanner_.AtEnd() || scanner_.Peek() == ';'; }
  bool TakeName(std::string_view upper);
  bool NextIs(std::string_view upper) const;

  // sinumerik_statement.cc
  bool ParseKeyword(std::string_view name);
  void ParseStatement(SinumerikPartKind kind, std::string_view name);
  void ParseCondition(SinumerikPart part);
  void ParseIf(SinumerikPart part);
  void ParseFor(SinumerikPart part);
  void ParseGoto(SinumerikPart part);
  void ParseCase(SinumerikPart part);
  bool ParseBranch(SinumerikPart* branch);
  void ParseRepeat(SinumerikPart part);
  void ParseCallStatement(SinumerikPart part);
  void ParsePathCall(SinumerikPart part);
  void ParseModalCall(SinumerikPart part);
  void ParseReturn(SinumerikPart part);
  void ParseSynchronous(SinumerikPart part);
  bool ParseTarget(SinumerikTarget* target);
  bool ParseJumpWord(SinumerikPart* part);
  void AddAlone(const SinumerikPart& part);

  // sinumerik_definition.cc
  void ParseDefine(SinumerikPart part);
  bool ParseDefinitionHead(SinumerikPart* part);
  bool ParseAttributeValue(std::string_view name);
  bool ParseDefinedName();
  bool ParseType(SinumerikPart* part);
  bool ParseSizes(SinumerikPart* part);
  void ParseProcedure(SinumerikPart part);
  void ParseExternal(SinumerikPart part);
  bool ParseParameters(bool named);
  bool ParseParameter(bool named);
  void ParseMacro(SinumerikPart part);
  void ParseRedefine(SinumerikPart part);

  Scanner scanner_;
  SinumerikBlock& block_;
  SinumerikExpressionParser expressions_;
  bool synchronous_ = false;  ///< Behind DO.
  bool has_else_ = false;
};

}  // namespace ncsim::nc
