// SPDX-License-Identifier: BSD-3-Clause
// A block of a SINUMERIK program as it stands in the text: syntax only. What a name means
// (variable, axis, address, G command, subprogram) is not known here, as it depends on the
// definitions that were executed; where the text alone decides, the part says so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/nc/block.h"
#include "sim/nc/program.h"
#include "sim/nc/sinumerik_expression.h"

namespace ncsim::nc {

enum class SinumerikPartKind : std::uint8_t {
  kWord,    ///< Letter and number: X10.5, G1, M3, L0054.
  kAssign,  ///< name[indices] = value: X=, X1=, M1=6, R1=, CR=, AX[X1]=, _VAR=, $TC_DP1[1,1]=.
  kName,    ///< A name alone: TRAORI, SUPA, a subprogram.
  kCall,    ///< name(arguments).
  kIf,      ///< `IF value`, to ELSE or ENDIF.
  kIfGoto,  ///< `IF value` before a kGoto of the same block.
  kElse,
  kEndIf,
  kFor,  ///< `FOR name[indices] = value TO second`.
  kEndFor,
  kWhile,
  kEndWhile,
  kLoop,
  kEndLoop,
  kRepeat,  ///< Alone: to UNTIL.
  kUntil,
  kRepeatSection,  ///< `REPEAT target [second_target] [P=value]`.
  kRepeatBlock,    ///< `REPEATB target [P=value]`.
  kEndLabel,
  kGoto,
  kCase,        ///< `CASE value OF`, before its branches.
  kCaseBranch,  ///< `value GOTOx target`.
  kCaseDefault,
  kDefine,       ///< `DEF ... type`, before its names.
  kDefinedName,  ///< `name[sizes] = value`.
  kProcedure,    ///< `PROC name`, before parameters and attributes.
  kParameter,    ///< `[VAR] type name[sizes] = value`.
  kAttribute,    ///< SAVE, SBLOF, DISPLOF ...
  kExternal,     ///< `EXTERN name(types)`, its types as kParameter.
  kCallName,     ///< `CALL value`.
  kCallBlock,    ///< `CALL [value] BLOCK target TO second_target`.
  kCallPath,     ///< `PCALL path(arguments)`; name is the path.
  kModalCall,    ///< `MCALL [name[(arguments)]]`.
  kReturn,       ///< RET, RETB; with arguments it returns to a place of its own.
  kSynchronous,  ///< ID=, WHEN, EVERY, DO ...: the rest of the block belongs to it.
  kUnsimulated,  ///< A statement known by name alone; the rest of the block belongs to it.
};

/// What stands around a value: X=IC(5).
enum class SinumerikModifier : std::uint8_t {
  kNone,
  kAc,
  kIc,
  kDc,
  kAcp,
  kAcn,
  kCoded,   ///< CAC, CIC, CDC, CACP, CACN: a position of a table.
  kOutput,  ///< QU: output without waiting.
};

enum class SinumerikJump : std::uint8_t {
  kForward,   ///< GOTOF
  kBackward,  ///< GOTOB
  kBoth,      ///< GOTO: forward, then backward
  kQuiet,     ///< GOTOC: as GOTO, without an alarm
  kToStart,   ///< GOTOS
};

enum class SinumerikType : std::uint8_t { kBool, kChar, kInt, kReal, kString, kAxis, kFrame };
std::string_view ToString(SinumerikType type);

enum class SinumerikList : std::uint8_t {
  kNone,
  kSet,     ///< `= SET(1,2)`, and `= (1,2)` in a definition.
  kRepeat,  ///< `= REP(0)`
};

/// The place that a jump or repetition names: a label or block number as written, or an expression.
struct SinumerikTarget {
  std::string_view label;  ///< `LBL`, `N100`; it may also be the name of a STRING variable.
  SinumerikExpression expression;
  int column = 0;
  bool empty() const { return label.empty() && expression.empty(); }
};

/// The parts of a block in the order in which they are written.
struct SinumerikPart {
  SinumerikPartKind kind = SinumerikPartKind::kWord;
  SinumerikModifier modifier = SinumerikModifier::kNone;
  SinumerikType type = SinumerikType::kReal;  ///< kDefine, kParameter.
  SinumerikList list = SinumerikList::kNone;
  SinumerikJump jump = SinumerikJump::kForward;
  char letter = 0;             ///< Upper case, of a one-letter address; 0 for a name.
  bool is_integer = false;     ///< kWord: written without a point.
  bool has_arguments = false;  ///< `NAME()` is a call with none.
  bool by_reference = false;   ///< kParameter: VAR.
  bool is_global = false;      ///< kDefine: NCK or CHAN.
  int extension = -1;          ///< kAssign: M1=6 has 1; -1 for none.
  int column = 0;              ///< From 1.
  std::uint32_t length = 0;    ///< Characters of the text.
  double value = 0.0;          ///< kWord.
  std::string_view name;       ///< As written: "X", "X1", "_VAR", "L0054".
  std::uint32_t first_index = 0, index_count = 0;        ///< In SinumerikBlock::arguments.
  std::uint32_t first_argument = 0, argument_count = 0;  ///< Likewise; list elements too.
  std::uint32_t first_target = 0;  ///< In SinumerikBlock::targets: one, or two of a section.
  SinumerikExpression expression;  ///< The value.
  SinumerikExpression second;      ///< kFor: the end; kDefine: the length of a STRING.
};

struct SinumerikBlock {
  std::size_t offset = 0;   ///< Byte offset of the line in the text.
  std::size_t next = 0;     ///< Byte offset of the next line.
  int line = 0;             ///< From 1.
  int skip_level = -1;      ///< `/` is 0, `/3` is 3; -1 for none.
  long sequence = -1;       ///< N, or the number of a main block (`:`).
  bool has_header = false;  ///< `%_N_NAME_MPF`: a program of an archive begins behind this line.
  std::string_view header;  ///< The name after `%`.
  std::string_view label;
  int label_column = 0;
  std::vector<SinumerikPart> parts;
  std::vector<SinumerikTarget> targets;
  std::vector<SinumerikExpression> arguments;
  std::vector<SinumerikCode> code;
  std::string_view comment;
  std::vector<SyntaxError> errors;  ///< Non-empty: the block must not be executed.
};

/// Parses the line at `offset` (whose number is `line`) into `block`, which is reused from block to
/// block so that reading a plain one allocates nothing. Always reaches the line's end.
void ParseSinumerikBlock(const Program& program, std::size_t offset, int line,
                         SinumerikBlock* block);

}  // namespace ncsim::nc
