// SPDX-License-Identifier: BSD-3-Clause
// Program flow and macros: which block comes next, and what its words are worth. Knows no modal
// state and no axes.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/finding.h"
#include "sim/nc/block.h"
#include "sim/nc/program.h"

namespace ncsim::control {

/// A word whose value is known: expressions evaluated, and rounded to the places of their address
/// (Haas NGC Mill Operator's Manual 2017, "Address Substitution"); undefined ones dropped (`X1.
/// Y#1` = `X1.`). Nothing is scaled yet.
struct ResolvedWord {
  double value = 0.0;
  int column = 0;  ///< From 1.
  char address = 0;
  bool comma = false;      ///< `,R` or `,C`: not the address R or C.
  bool has_point = false;  ///< True also for expressions: a computed value is never scaled.
  bool from_expression = false;
  bool used = false;  ///< Set by whoever consumed it. What is left over is `unsupported-code`.
};

struct ResolvedBlock {
  SourcePosition where;  ///< Column 1 of the block.
  /// `/` stands before it (the flow has already left it out when the switch is on).
  bool block_delete = false;
  /// N, O and `%` are gone; so are the words of flow codes (M97 P L ...).
  std::vector<ResolvedWord> words;
  std::vector<std::string_view> comments;

  /// The first word with that address, commas left out; null for none.
  ResolvedWord* Find(char address);
  /// `,R` or `,C`.
  ResolvedWord* FindComma(char address);
};

/// System variables (#2001.., #3000.., #4001.., #5001.., #20000+n): the controller's. The flow's
/// own are locals (#1-#33), #100.., #10000.., and #3000, #3003, #3004, #3006, #3030, #3032, #3033.
class SystemVariables {
 public:
  virtual ~SystemVariables() = default;
  /// False: no such variable. Reading a position makes the controller flush its contour stage
  /// first.
  virtual bool Read(long number, nc::MacroValue* value) = 0;
  virtual bool Write(long number, nc::MacroValue value) = 0;
  /// The program reads a common variable (#100.., #10000..) that it has not set. The control keeps
  /// them over power-off, so that "undefined" is an assumption. Once a variable.
  virtual void AssumeUndefined(long number) = 0;
  /// Decimal places of a length in the control's unit: 4 for inch, 3 for mm. Computed words are
  /// rounded to it, and the integer arguments of G65 are scaled by it (manual 2017, "Integer
  /// Argument Passing").
  virtual int length_decimals() const { return 4; }
};

struct FlowOptions {
  bool block_delete = false;  ///< The operator's switch.
  bool optional_stop = false;
  std::uint64_t max_blocks = 50'000'000;  ///< Executed blocks; beyond it the loop "does not end".
  std::vector<std::string>
      subprogram_folders;  ///< Searched for O programs, after the main program's folder and file.
};

enum class FlowEvent {
  kBlock,       ///< A block with words to execute.
  kProgramEnd,  ///< End of text or `%`, End(), or M99 in the main program (which would start it
                ///< again, for ever).
  kStopped,     ///< An alarm has been reported as a finding; the program goes no further.
};

/// Runs a program. Use: while (Next(&block) == kBlock) { execute block.words; }. Blocks that have
/// no words for the controller (comments, assignments, GOTO, M97 alone) are not handed out. Flow
/// words that act at the block's end (M97, M98, M99, G65, GOTO, END) act when Next() is called
/// again; G65 P and M97/M98 P L are consumed here.
///
/// What the control does and we cannot know is reported as `unsupported-code`, and the program goes
/// on after it: a subprogram that is not found, M96, a jump to a block number that stands twice, an
/// expression whose meaning the manual leaves open. A syntax error or an alarm stops; further
/// syntax errors of the same text are then reported too, up to a bound. Rules of flow: manual 2017,
/// "Control Statements", "Subprograms", "M97", "M98", "M99", "G65".
class Flow {
 public:
  using Report = std::function<void(Finding)>;
  /// Adds the names of the texts to `files`, the main program's first.
  Flow(std::shared_ptr<const nc::Program> main, FlowOptions options, SystemVariables* system,
       SourceFiles* files, Report report);
  ~Flow();

  FlowEvent Next(ResolvedBlock* block);
  /// M30 or M02: the next call of Next() returns kProgramEnd.
  void End();
  std::uint64_t blocks_executed() const;  ///< Lines read.
  /// For `#4201`-like reads and tests: value of a local or common variable.
  bool ReadVariable(long number, nc::MacroValue* value);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::control
