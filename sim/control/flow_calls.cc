// SPDX-License-Identifier: BSD-3-Clause
// Jumps, loops, subprograms: Haas NGC Mill Operator's Manual 2017, "Control Statements", "M97",
// "M98", "M99", "G65".
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "sim/base/text.h"
#include "sim/control/flow_state.h"

namespace ncsim::control {
namespace {

/// "G65 calls can be nested up to 9 times" (manual 2017, "G65"); for M97 and M98 the manual gives
/// no figure.
constexpr std::size_t kMaxMacroLevels = 9;
constexpr std::size_t kMaxCalls = 10;
constexpr long kMaxRepeats = 99;         ///< M97, M98: "L - Repeats (1-99) times".
constexpr long kMaxMacroRepeats = 9999;  ///< G65: "Lnnnn".

/// "Alphabetic Addressing" (manual 2017, "Macro Arguments"); 0: not passable. I J K: their first
/// set.
constexpr std::array<int, 26> kArgument = {1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                           0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
/// "Integer Argument Passing": these are whole numbers, the others count in the last decimal place.
constexpr std::string_view kIntegerArguments = "DEFHMST";
constexpr int kMaxArgumentSets = 10;  ///< Of I J K: #4 to #33.

std::optional<long> ToWhole(double value) {
  constexpr double kHighest = 1e9;
  constexpr double kTolerance = 1e-6;
  const double whole = std::round(value);
  if (!(whole >= 0.0 && whole <= kHighest) || std::abs(value - whole) > kTolerance) {
    return std::nullopt;
  }
  return static_cast<long>(whole);
}

void DropUsed(ResolvedBlock* out) {
  const auto used = [](const ResolvedWord& word) { return word.used; };
  out->words.erase(std::remove_if(out->words.begin(), out->words.end(), used), out->words.end());
}

}  // namespace

void Flow::State::SetPending(Action action, long label, int column) {
  if (pending.action != Action::kNone) {
    return Alarm(column, "two jumps or calls in one block");
  }
  pending.action = action;
  pending.label = label;
  pending.column = column;
}

/// Carries out what the block just executed does at its end.
void Flow::State::Apply() {
  const Action action = std::exchange(pending.action, Action::kNone);
  switch (action) {
    case Action::kNone:
      return;
    case Action::kGoto:
      return JumpTo(pending.label, pending.column);
    case Action::kCall:
      return Call(pending.callee, pending.column);
    case Action::kReturn:
      return Return();
    case Action::kEndLoop:
      return EndLoop(static_cast<int>(pending.label), pending.column);
  }
}

// --- Jumps and loops ---

bool Flow::State::FindBlock(long label, int column, nc::TextPosition* position) {
  const nc::ProgramIndex& index = frame().text->index();
  const nc::ProgramRange& range = index.ProgramAt(block.offset);
  switch (index.FindBlock(label, range, block.next, position)) {
    case nc::ProgramIndex::Search::kFound:
      return true;
    case nc::ProgramIndex::Search::kMissing:
      Alarm(column, "the program has no block N" + std::to_string(label));
      return false;
    case nc::ProgramIndex::Search::kAmbiguous:
      Unsupported(column, "block N" + std::to_string(label) +
                              " stands more than once in the program; which one the control finds "
                              "is not documented");
      return true;
  }
  return false;
}

void Flow::State::JumpTo(long label, int column) {
  nc::TextPosition position;
  if (!FindBlock(label, column, &position)) return;
  LeaveLoopsNotAround(position.offset);
  frame().next = position;
}

void Flow::State::LeaveLoopsNotAround(std::size_t offset) {
  Frame& current = frame();
  while (current.loop_count > 0) {
    const Loop& loop = current.loops[current.loop_count - 1];
    if (offset > loop.begin.offset && offset <= loop.end.offset) return;
    --current.loop_count;
  }
}

void Flow::State::EnterLoop(const nc::Statement& statement) {
  nc::TextPosition end;
  if (!FindLoopEnd(statement.loop, statement.column, &end)) return;
  bool holds = true;
  if (statement.kind == nc::StatementKind::kWhile &&
      !Condition(statement.value, statement.column, &holds)) {
    return;
  }
  Frame& current = frame();
  // Coming back from its END, the loop is still the innermost one.
  if (current.loop_count > 0 &&
      current.loops[current.loop_count - 1].begin.offset == block.offset) {
    --current.loop_count;
  }
  if (!holds) {
    nc::ParseBlock(*current.text->program, end.offset, end.line, &ahead);
    current.next = {ahead.next, end.line + 1};
    return;
  }
  if (current.loop_count == current.loops.size()) {
    return Alarm(statement.column, "loops are nested deeper than 3 levels");
  }
  current.loops[current.loop_count++] = {statement.loop, {block.offset, block.line}, end};
}

/// The END that belongs to the DO of the current block.
bool Flow::State::FindLoopEnd(int number, int column, nc::TextPosition* end) {
  const auto key = std::pair(frame().text->file, block.offset);
  const auto known = loop_ends.find(key);
  if (known != loop_ends.end()) {
    *end = known->second;
    return true;
  }
  const nc::Program& program = *frame().text->program;
  std::string open = std::to_string(number);  // Loop numbers, innermost last.
  nc::TextPosition at = {block.next, block.line + 1};
  while (at.offset < program.text().size()) {
    nc::ParseBlock(program, at.offset, at.line, &ahead);
    if (ahead.program_mark || ahead.program >= 0) break;
    for (const nc::Statement& statement : ahead.statements) {
      const char digit = static_cast<char>('0' + statement.loop);
      const bool begins =
          statement.kind == nc::StatementKind::kDo || statement.kind == nc::StatementKind::kWhile;
      if (begins) {
        if (open.find(digit) != std::string::npos) {
          Alarm(column, std::string("DO") + digit + " of line " + std::to_string(at.line) +
                            " stands inside another DO" + digit);
          return false;
        }
        open += digit;
      } else if (statement.kind == nc::StatementKind::kEnd) {
        if (open.back() != digit) {
          Alarm(column, std::string("END") + digit + " of line " + std::to_string(at.line) +
                            " does not belong to DO" + open.back());
          return false;
        }
        open.pop_back();
      }
      if (open.empty()) {
        *end = at;
        loop_ends.emplace(key, at);
        return true;
      }
    }
    at = {ahead.next, at.line + 1};
  }
  Alarm(column, std::string("DO") + open.back() + " has no END" + open.back());
  return false;
}

void Flow::State::EndLoop(int number, int column) {
  Frame& current = frame();
  if (current.loop_count == 0 || current.loops[current.loop_count - 1].number != number) {
    const std::string digit = std::to_string(number);
    return Alarm(column, "END" + digit + " is reached without its DO" + digit +
                             ": a loop cannot be entered by a jump");
  }
  current.next = current.loops[current.loop_count - 1].begin;
}

// --- Calls ---

void Flow::State::HandleFlowCode(ResolvedBlock* out) {
  if (several_flow_codes) {
    return Alarm(flow_code_column, "only one of G65, M96, M97, M98 and M99 may stand in a block");
  }
  for (ResolvedWord& word : out->words) {
    if (word.column == flow_code_column) word.used = true;
  }
  switch (flow_code) {
    case 'G':
      SubprogramCall(out, true);
      break;
    case '6':
      JumpIfNoInput(out);
      break;
    case '7':
      LocalCall(out);
      break;
    case '8':
      SubprogramCall(out, false);
      break;
    default:
      ReturnOrJump(out);
      break;
  }
  DropUsed(out);
}

/// L of the block. False after an alarm.
bool Flow::State::TakeRepeats(ResolvedBlock* out, long highest, long* repeats) {
  *repeats = 1;
  ResolvedWord* word = out->Find('L');
  if (word == nullptr) return true;
  word->used = true;
  const std::optional<long> value = ToWhole(word->value);
  if (!value || *value < 1 || *value > highest) {
    Alarm(word->column, "L" + Short(word->value) + ": the number of repetitions must be 1 to " +
                            std::to_string(highest));
    return false;
  }
  *repeats = *value;
  return true;
}

void Flow::State::LocalCall(ResolvedBlock* out) {
  Frame callee;
  callee.kind = CallKind::kLocal;
  callee.text = frame().text;
  callee.started = true;
  ResolvedWord* word = out->Find('P');
  if (word == nullptr) return Alarm(flow_code_column, "M97 needs the block number in P");
  word->used = true;
  const std::optional<long> label = ToWhole(word->value);
  if (!label) return Alarm(word->column, "P" + Short(word->value) + " is not a block number");
  if (!TakeRepeats(out, kMaxRepeats, &callee.repeats)) return;
  if (!FindBlock(*label, word->column, &callee.start)) return;
  SetPending(Action::kCall, 0, flow_code_column);
  pending.callee = callee;
}

/// By P, or by the path in the block's comment. False: reported.
bool Flow::State::FindSubprogram(ResolvedBlock* out, Subprogram* found) {
  ResolvedWord* word = out->Find('P');
  std::string name;
  if (word != nullptr) {
    word->used = true;
    const std::optional<long> number = ToWhole(word->value);
    if (!number || *number > 99999) {
      Alarm(word->column, "P" + Short(word->value) + " is not a program number");
      return false;
    }
    *found = subprograms.Find(*number, *frame().text);
    const std::string digits = std::to_string(*number);
    name = "O" + std::string(digits.size() < 5 ? 5 - digits.size() : 0, '0') + digits;
  } else if (!block.comments.empty()) {
    *found = subprograms.FindPath(block.comments.front());
    name = "(" + std::string(block.comments.front()) + ")";
  } else {
    Alarm(flow_code_column, "the call needs a program number in P or a path in parentheses");
    return false;
  }
  if (found->text != nullptr) return true;
  const std::string why = subprograms.error();
  Unsupported(word != nullptr ? word->column : flow_code_column,
              why.empty()
                  ? "subprogram " + name + " was not found in the program's own file nor in " +
                        subprograms.Places() + "; what it does was not simulated"
                  : "subprogram " + name + " was not simulated: " + why);
  return false;
}

void Flow::State::SubprogramCall(ResolvedBlock* out, bool macro) {
  Frame callee;
  callee.kind = macro ? CallKind::kMacro : CallKind::kSubprogram;
  Subprogram found;
  const bool known = FindSubprogram(out, &found);
  if (stopped) return;
  if (!TakeRepeats(out, macro ? kMaxMacroRepeats : kMaxRepeats, &callee.repeats)) return;
  LocalVariables arguments;
  if (macro && !TakeArguments(out, &arguments)) return;
  if (!known) return;
  callee.text = found.text;
  callee.start = found.begin;
  SetPending(Action::kCall, 0, flow_code_column);
  pending.callee = callee;
  pending.arguments = arguments;
}

/// Every letter of the block but G, and P and L, which are taken already.
bool Flow::State::TakeArguments(ResolvedBlock* out, LocalVariables* arguments) {
  std::array<int, 26> seen{};
  bool scaled = false;
  for (ResolvedWord& word : out->words) {
    if (word.used || word.address == 'G' || word.comma) continue;
    const auto letter = static_cast<std::size_t>(word.address - 'A');
    int variable = kArgument[letter];
    if (variable == 0) {
      Alarm(word.column, std::string("G65 cannot pass the letter ") + word.address);
      return false;
    }
    const int set = seen[letter]++;
    if (set >= kMaxArgumentSets) {
      Alarm(word.column, "more than 10 sets of I J K");
      return false;
    }
    variable += 3 * set;
    word.used = true;
    double value = word.value;
    if (!word.has_point && kIntegerArguments.find(word.address) == std::string_view::npos) {
      value *= std::pow(10.0, -variables.DecimalsOf('X'));
      scaled = scaled || value != 0.0;
    }
    (*arguments)[static_cast<std::size_t>(variable)] = value;
  }
  if (scaled) {
    ReportOnce(Rule::kNumberScale, flow_code_column,
               "an argument of G65 without decimal point counts in the last decimal place");
  }
  return true;
}

void Flow::State::Call(Frame callee, int column) {
  if (frames.size() > kMaxCalls) {
    return Alarm(column,
                 "subprograms are nested deeper than " + std::to_string(kMaxCalls) + " levels");
  }
  if (callee.kind == CallKind::kMacro) {
    if (variables.levels() > kMaxMacroLevels) {
      return Alarm(column, "G65 calls are nested deeper than " + std::to_string(kMaxMacroLevels) +
                               " levels");
    }
    variables.PushLocals(pending.arguments);
  }
  callee.next = callee.start;
  frames.push_back(callee);
}

/// M99, or M99 Pn, which "jumps to the appropriate block of the current program" and returns
/// nowhere.
void Flow::State::ReturnOrJump(ResolvedBlock* out) {
  ResolvedWord* word = out->Find('P');
  if (word == nullptr) return SetPending(Action::kReturn, 0, flow_code_column);
  word->used = true;
  const std::optional<long> label = ToWhole(word->value);
  if (!label) return Alarm(word->column, "P" + Short(word->value) + " is not a block number");
  SetPending(Action::kGoto, *label, word->column);
}

void Flow::State::Return() {
  Frame& current = frame();
  if (current.repeats > 1) {
    --current.repeats;
    current.next = current.start;
    current.started = current.kind == CallKind::kLocal;
    current.loop_count = 0;
    return;
  }
  if (current.kind == CallKind::kMain) {
    ended = true;
    return;
  }
  if (current.kind == CallKind::kMacro) variables.PopLocals();
  frames.pop_back();
}

void Flow::State::JumpIfNoInput(ResolvedBlock* out) {
  for (const char address : {'P', 'Q'}) {
    if (ResolvedWord* word = out->Find(address)) word->used = true;
  }
  Unsupported(
      flow_code_column,
      "M96 jumps by an input of the machine, which is not known here; taken as on: no jump");
}

void Flow::State::EndOfText() {
  if (frame().kind == CallKind::kMain) {
    ended = true;
    return;
  }
  if (frame().next.offset >= frame().text->program->text().size()) {
    block.line = frame().next.line - 1;
  }
  Alarm(1, "the subprogram ends without M99 (alarm 312)");
}

}  // namespace ncsim::control
