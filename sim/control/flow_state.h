// SPDX-License-Identifier: BSD-3-Clause
// Internal to Flow. Blocks are executed in flow.cc; jumps, loops, calls and returns in
// flow_calls.cc.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/control/flow.h"
#include "sim/control/macro_variables.h"
#include "sim/control/subprograms.h"

namespace ncsim::control {

struct Flow::State {
  enum class CallKind { kMain, kLocal, kSubprogram, kMacro };
  enum class Action { kNone, kGoto, kCall, kReturn, kEndLoop };

  /// An active DO.
  struct Loop {
    int number = 0;
    nc::TextPosition begin;  ///< Of the DO block.
    nc::TextPosition end;    ///< Of the END block.
  };
  struct Frame {
    CallKind kind = CallKind::kMain;
    ProgramText* text = nullptr;
    nc::TextPosition start;  ///< Where each repetition begins.
    nc::TextPosition next;
    long repeats = 1;
    bool started = false;  ///< Past the program's head: a further O number or `%` ends it.
    std::array<Loop, 3> loops;
    std::size_t loop_count = 0;
  };
  /// What the block does at its end.
  struct Pending {
    Action action = Action::kNone;
    int column = 0;
    long label = 0;  ///< kGoto: block number; kEndLoop: loop number.
    Frame callee;    ///< kCall.
    LocalVariables arguments;
  };

  State(std::shared_ptr<const nc::Program> main, FlowOptions flow_options, SystemVariables* system,
        SourceFiles* files, Report report_to);

  // flow.cc
  /// Reads and executes the next block; words are left in `out`.
  void Step(ResolvedBlock* out);
  bool EndsProgram();
  void ExecuteWords(ResolvedBlock* out);
  void ExecuteStatements(ResolvedBlock* out);
  bool Execute(const nc::Statement& statement, ResolvedBlock* out, bool* ignore_rest);
  bool Assign(const nc::Statement& statement);
  bool AssignSystem(long number, const nc::MacroValue& value, int column);
  bool Resolve(const nc::Word& word, ResolvedBlock* out);
  void RoundComputed(ResolvedBlock* out);
  bool EvaluateAt(nc::Expression expression, int column, nc::MacroValue* value);
  bool Condition(nc::Expression expression, int column, bool* holds);
  void ReportBlock();
  void ReportSyntax();
  void ReleasePages();

  // flow_calls.cc
  void Apply();
  void JumpTo(long label, int column);
  bool FindBlock(long label, int column, nc::TextPosition* position);
  void LeaveLoopsNotAround(std::size_t offset);
  void EnterLoop(const nc::Statement& statement);
  bool FindLoopEnd(int number, int column, nc::TextPosition* end);
  void EndLoop(int number, int column);
  void HandleFlowCode(ResolvedBlock* out);
  void LocalCall(ResolvedBlock* out);
  void SubprogramCall(ResolvedBlock* out, bool macro);
  void ReturnOrJump(ResolvedBlock* out);
  void JumpIfNoInput(ResolvedBlock* out);
  bool TakeRepeats(ResolvedBlock* out, long highest, long* repeats);
  bool FindSubprogram(ResolvedBlock* out, Subprogram* found);
  bool TakeArguments(ResolvedBlock* out, LocalVariables* arguments);
  void SetPending(Action action, long label, int column);
  void Call(Frame callee, int column);
  void Return();
  void EndOfText();

  Frame& frame() { return frames.back(); }
  SourcePosition Here(int column);
  void Alarm(int column, std::string message);
  void Unsupported(int column, std::string message);
  /// Once a place and rule.
  void ReportOnce(Rule rule, int column, std::string message);

  FlowOptions options;
  Report report;
  Subprograms subprograms;
  MacroVariables variables;
  std::vector<Frame> frames;
  nc::Block block;
  nc::Block ahead;  ///< For scanning without executing.
  Pending pending;
  char flow_code = 0;  ///< Of the block: 'G' (G65) or the last digit of M96 to M99; 0 for none.
  int flow_code_column = 0;
  bool several_flow_codes = false;
  bool computed = false;  ///< A word of the block was computed.
  bool stopped = false;
  bool ended = false;
  std::uint64_t blocks = 0;
  std::size_t released = 0;
  std::map<std::pair<int, std::size_t>, nc::TextPosition> loop_ends;  ///< By file and DO offset.
  std::set<std::tuple<int, int, Rule>> reported;
};

}  // namespace ncsim::control
