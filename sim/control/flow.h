// SPDX-License-Identifier: BSD-3-Clause
// Program flow and macros: which block comes next, and what its words are worth. Knows no modal state and no axes.
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

/// A word whose value is known: expressions evaluated, undefined ones dropped (`X1. Y#1` = `X1.`), nothing scaled yet.
struct ResolvedWord {
  char address = 0;
  bool has_point = false;   ///< True also for expressions: a computed value is never scaled.
  bool from_expression = false;
  bool used = false;        ///< Set by whoever consumed it. What is left over is `unsupported-code`.
  int column = 0;
  double value = 0.0;
};

struct ResolvedBlock {
  SourcePosition where;          ///< Column 1 of the block.
  bool block_delete = false;     ///< `/` stands before it (the flow has already left it out when the switch is on).
  std::vector<ResolvedWord> words;  ///< N, O and `%` are gone; so are the words of flow codes (M97 P L ...).
  std::vector<std::string_view> comments;

  ResolvedWord* Find(char address);
};

/// System variables (#2001.., #3000.., #4001.., #5001.., #20000+n): the controller's. Locals, #100.. and loops are the
/// flow's own.
class SystemVariables {
 public:
  virtual ~SystemVariables() = default;
  /// False: no such variable. Reading a position makes the controller flush its contour stage first.
  virtual bool Read(long number, nc::MacroValue* value) = 0;
  virtual bool Write(long number, nc::MacroValue value) = 0;
};

struct FlowOptions {
  bool block_delete = false;         ///< The operator's switch.
  bool optional_stop = false;
  std::uint64_t max_blocks = 50'000'000;  ///< Executed blocks; beyond it the loop "does not end".
  std::vector<std::string> subprogram_folders;  ///< Searched for O programs, after the main program's folder and file.
};

enum class FlowEvent {
  kBlock,       ///< A block with words to execute (maybe none left).
  kProgramEnd,  ///< End of text or `%`, or M99 in the main program (which would start it again).
  kStopped,     ///< An alarm has been reported as a finding; the program goes no further.
};

/// Runs a program. Use: while (Next(&block) == kBlock) { execute block.words; }. Flow words that act at the block's end
/// (M97, M98, M99, G65, M96, GOTO) act when Next() is called again. G65 P and M97/M98 P L are consumed here; aliases
/// (O9000-9019) are `unsupported-code`.
class Flow {
 public:
  using Report = std::function<void(Finding)>;
  Flow(std::shared_ptr<const nc::Program> main, FlowOptions options, SystemVariables* system,
       SourceFiles* files, Report report);
  ~Flow();

  FlowEvent Next(ResolvedBlock* block);
  /// M30 or M02: the next call returns kProgramEnd.
  void End();
  std::uint64_t blocks_executed() const;
  /// For `#4201`-like reads and tests: value of a local or common variable.
  bool ReadVariable(long number, nc::MacroValue* value);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::control
