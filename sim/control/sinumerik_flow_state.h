// SPDX-License-Identifier: BSD-3-Clause
// Internal to SinumerikFlow. Blocks are read and taken apart in sinumerik_flow.cc, words and names
// in sinumerik_resolve.cc, assignments and definitions in sinumerik_assign.cc, jumps and control
// structures in sinumerik_jumps.cc, calls and returns in sinumerik_calls.cc.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "sim/control/sinumerik_flow.h"
#include "sim/control/sinumerik_macros.h"
#include "sim/control/sinumerik_programs.h"
#include "sim/control/sinumerik_variables.h"

namespace ncsim::control {

struct SinumerikFlow::State final : nc::SinumerikReader {
  using Block = nc::SinumerikBlock;
  using Part = nc::SinumerikPart;
  using PartKind = nc::SinumerikPartKind;
  using Value = nc::SinumerikValue;

  enum class LevelKind { kMain, kSubprogram, kSection };
  enum class Action { kNone, kJump, kCall, kSection, kReturn };

  struct Level {
    LevelKind kind = LevelKind::kMain;
    ProgramText* text = nullptr;
    nc::TextPosition start;  ///< Where each pass begins.
    nc::TextPosition next;
    std::size_t end = 0;  ///< kSection: the offset behind its last block.
    long passes = 1;
    bool started = false;     ///< Past the program's head: a further `%` line ends it.
    bool save = false;        ///< PROC with SAVE.
    bool modal = false;       ///< Called by MCALL: its motions call nothing.
    std::vector<bool> given;  ///< Which parameters were passed ($P_SUBPAR).
    SinumerikScope parameters;
  };
  /// An argument of a call, evaluated; `variable` is what it stands for, if it is just that.
  struct Argument {
    Value value;
    std::shared_ptr<SinumerikVariable> variable;
  };
  /// What the block does at its end.
  struct Pending {
    Action action = Action::kNone;
    int column = 0;
    nc::TextPosition target;  ///< kJump.
    Level callee;             ///< kCall, kSection.
  };

  State(std::shared_ptr<const nc::Program> main, SinumerikFlowOptions flow_options,
        SinumerikSystem* flow_system, SourceFiles* files, Report report_to);

  // sinumerik_flow.cc
  void Start();
  void Step(SinumerikStep* out);
  bool ReadBlock();
  void Execute(SinumerikStep* out);
  /// False: the rest of the block is left out.
  bool ExecutePart(std::size_t* index, SinumerikStep* out);
  bool ExecuteWordPart(const Part& part, SinumerikStep* out);
  bool Condition(const Part& part, bool* holds);
  bool EvaluateAt(nc::SinumerikExpression expression, Value* value);
  void ParseBlock(nc::TextPosition at);
  void ReportSyntax();
  void ReportUnsimulated(const Part& part);
  void ReleasePages();
  bool Fail(const nc::SinumerikFault& fault);

  // sinumerik_resolve.cc
  bool ReadName(std::string_view name, const std::vector<Value>& indices, Value* value,
                nc::SinumerikFault* fault) override;
  bool CallFunction(std::string_view name, const std::vector<Value>& arguments, Value* value,
                    nc::SinumerikFault* fault) override;
  bool ReadVariable(const std::shared_ptr<SinumerikVariable>& variable,
                    const std::vector<Value>& indices, Value* value, nc::SinumerikFault* fault);
  bool ReadParameter(const std::vector<Value>& indices, Value* value, nc::SinumerikFault* fault);
  bool ReadSystem(std::string_view name, const std::vector<Value>& indices, Value* value,
                  nc::SinumerikFault* fault);
  bool AddWord(const Part& part, SinumerikStep* out);
  bool AddGCode(const nc::SinumerikCommand* command, const Part& part, SinumerikStep* out);
  bool AddName(const Part& part, SinumerikStep* out);
  bool AddCommandCall(const nc::SinumerikCommand& command, const Part& part, SinumerikStep* out);
  bool AddValuedWord(const Part& part, SinumerikStep* out);
  bool CheckRepeated(const Part& part);
  bool RaiseAlarm(const Part& part);

  // sinumerik_assign.cc
  bool Assign(const Part& part, SinumerikStep* out);
  bool AssignVariable(const Part& part, const std::shared_ptr<SinumerikVariable>& variable);
  bool AssignList(const Part& part, const std::shared_ptr<SinumerikVariable>& variable,
                  std::size_t offset);
  bool AssignElement(const Part& part, SinumerikVariable* variable, std::vector<Value> indices,
                     const Value& value);
  bool AssignParameter(const Part& part);
  bool AssignSystem(const Part& part);
  bool SetLoopVariable(const Part& part, const Value& value);
  bool LoopVariable(const Part& part, Value* value);
  bool EvaluateList(std::uint32_t first, std::uint32_t count, std::vector<Value>* values);
  void Define();
  bool DefineOne(const Part& definition, const Part& name, std::size_t text_length);

  // sinumerik_jumps.cc
  bool Goto(const Part& part);
  bool Case(std::size_t index);
  bool TargetLabel(const nc::SinumerikTarget& target, std::string* label);
  std::optional<nc::TextPosition> FindLabel(const std::string& label, nc::SinumerikJump jump);
  void JumpTo(nc::TextPosition target);
  void Structure(const Part& part);
  void StructureFor(const Part& part, const nc::SinumerikPartner& partner);
  nc::TextPosition Behind(nc::TextPosition position) { return Behind(*level().text, position); }
  /// The line after the one at `position`.
  static nc::TextPosition Behind(const ProgramText& text, nc::TextPosition position);
  void Repeat(const Part& part);
  bool RepeatRange(const Part& part, Level* section);
  void CallBlock(const Part& part);
  void AddSection(Level section, int column);

  // sinumerik_calls.cc
  bool CallSubprogram(const Part& part, std::string_view name);
  void CallByName(const Part& part);
  void SetModalCall(const Part& part);
  bool EvaluateArguments(const Part& part, std::vector<Argument>* arguments);
  bool Bind(SinumerikProgram program, std::vector<Argument> arguments, int column, Level* callee);
  bool BindParameter(const Part& parameter, Argument* argument, bool given, int column,
                     SinumerikScope* scope);
  void Call(Level callee, int column);
  void Return();
  void LeaveSections();
  void EndOfText();
  void Apply();
  bool SetPending(Action action, int column);
  const SinumerikModalCall* PathMotionDone();
  void ReportMissing(std::string_view name, int column);

  Level& level() { return levels.back(); }
  SinumerikMacros::Scope MacroScope() const;
  SourcePosition Here(int column) { return {level().text->file, block.line, column}; }
  /// Returns false, to be returned.
  bool Alarm(int column, std::string message);
  bool Alarm(int column, int alarm, std::string message);
  /// Once a place.
  void Unsupported(int column, std::string message);

  SinumerikFlowOptions options;
  SinumerikSystem* system;
  Report report;
  SinumerikPrograms programs;
  SinumerikVariables variables;
  std::vector<Level> levels;
  Block block;
  Block ahead;  ///< For reading without executing.
  Pending pending;
  std::deque<SinumerikEvent> events;
  SinumerikModalCall modal;
  SinumerikMacros macros;
  std::shared_ptr<const nc::Program> expanded;   ///< The block, where macros stood in it.
  std::shared_ptr<SinumerikVariable> last_read;  ///< What ReadName() found last.
  std::size_t last_offset = 0;
  std::optional<std::size_t> loop_back;  ///< Offset of the FOR that its ENDFOR goes back to.
  std::uint64_t groups_seen = 0;         ///< G groups of the block, a bit a group.
  std::uint32_t letters_seen = 0;        ///< Addresses of the block, a bit a letter.
  int m_words = 0;
  bool syntax_group_seen = false;
  bool called = false;  ///< The block calls a subprogram, found or not.
  bool stopped = false;
  bool ended = false;
  std::uint64_t blocks = 0;
  std::size_t released = 0;
  std::set<std::tuple<int, int, int>> reported;
};

}  // namespace ncsim::control
