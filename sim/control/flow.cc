// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/flow.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sim/base/text.h"
#include "sim/control/flow_state.h"
#include "sim/control/limits.h"

namespace ncsim::control {
namespace {

/// What a message may carry of a comment: printable ASCII, and not too much of it.
std::string Printable(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 80)) result += c >= ' ' && c < '\x7f' ? c : '?';
  return result;
}

/// The digit that names the flow code: 'G' for G65, '6' to '9' for M96 to M99, else 0.
char FlowCodeOf(char address, double value) {
  if (address == 'G') return value == 65.0 ? 'G' : '\0';
  if (value == 96.0) return '6';
  if (value == 97.0) return '7';
  if (value == 98.0) return '8';
  return value == 99.0 ? '9' : '\0';
}

}  // namespace

ResolvedWord* ResolvedBlock::Find(char address) {
  for (ResolvedWord& word : words) {
    if (word.address == address && !word.comma) return &word;
  }
  return nullptr;
}

ResolvedWord* ResolvedBlock::FindComma(char address) {
  for (ResolvedWord& word : words) {
    if (word.address == address && word.comma) return &word;
  }
  return nullptr;
}

Flow::State::State(std::shared_ptr<const nc::Program> main, FlowOptions flow_options,
                   SystemVariables* system, SourceFiles* files, Report report_to)
    : options(std::move(flow_options)),
      report(std::move(report_to)),
      subprograms(std::move(main), options.subprogram_folders, files),
      variables(options, system) {
  Frame first;
  first.text = &subprograms.main();
  first.start = {first.text->program->begin(), 1};
  first.next = first.start;
  frames.push_back(first);
}

Flow::Flow(std::shared_ptr<const nc::Program> main, FlowOptions options, SystemVariables* system,
           SourceFiles* files, Report report)
    : state_(std::make_unique<State>(std::move(main), std::move(options), system, files,
                                     std::move(report))) {}

Flow::~Flow() = default;

FlowEvent Flow::Next(ResolvedBlock* block) {
  State& state = *state_;
  while (true) {
    if (!state.stopped && !state.ended) state.Apply();
    if (state.stopped) return FlowEvent::kStopped;
    if (state.ended) return FlowEvent::kProgramEnd;
    state.Step(block);
    if (!state.stopped && !block->words.empty()) return FlowEvent::kBlock;
  }
}

void Flow::End() { state_->ended = true; }

std::uint64_t Flow::blocks_executed() const { return state_->blocks; }

bool Flow::ReadVariable(long number, nc::MacroValue* value) {
  return state_->variables.Read(number, value);
}

SourcePosition Flow::State::Here(int column) { return {frame().text->file, block.line, column}; }

void Flow::State::Alarm(int column, std::string message) {
  report(MakeFinding(Rule::kControlAlarm, Here(column), std::move(message)));
  stopped = true;
}

void Flow::State::Unsupported(int column, std::string message) {
  ReportOnce(Rule::kUnsupportedCode, column, std::move(message));
}

void Flow::State::ReportOnce(Rule rule, int column, std::string message) {
  if (!reported.emplace(frame().text->file, block.line, rule).second) return;
  report(MakeFinding(rule, Here(column), std::move(message)));
}

void Flow::State::Step(ResolvedBlock* out) {
  out->words.clear();
  out->comments.clear();
  Frame& current = frame();
  const nc::Program& program = *current.text->program;
  if (current.next.offset >= program.text().size()) return EndOfText();
  if (blocks >= options.max_blocks) {
    block.line = current.next.line;
    Unsupported(1, "stopped after " + std::to_string(blocks) +
                       " blocks: a loop does not end, or the program is longer than this bound");
    stopped = true;
    return;
  }
  ++blocks;
  nc::ParseBlock(program, current.next.offset, current.next.line, &block);
  ReleasePages();
  const bool skipped = block.block_delete && options.block_delete;
  if (!block.errors.empty() && !skipped) return ReportSyntax();
  if (EndsProgram()) return EndOfText();
  current.next = {block.next, block.line + 1};
  if (skipped) return;
  flow_code = 0;
  several_flow_codes = false;
  computed = false;
  if (block.statements.empty()) {
    ExecuteWords(out);
  } else {
    ExecuteStatements(out);
  }
  if (!block.doubts.empty()) ReportBlock();
  if (stopped) return;
  if (computed && flow_code != 'G') RoundComputed(out);
  if (flow_code != 0) HandleFlowCode(out);
  out->where = Here(1);
  out->block_delete = block.block_delete;
  out->comments.insert(out->comments.end(), block.comments.begin(), block.comments.end());
}

/// A program ends at the next O number, and at the `%` after it.
bool Flow::State::EndsProgram() {
  Frame& current = frame();
  if ((block.program_mark || block.program >= 0) && current.started) return true;
  if (block.program >= 0 || !block.words.empty() || !block.statements.empty()) {
    current.started = true;
  }
  return false;
}

void Flow::State::ReleasePages() {
  constexpr std::size_t kStep = std::size_t{4} << 20;
  if (block.next < released) released = block.next;
  if (block.next - released < kStep) return;
  released = block.next;
  frame().text->program->Release(released);
}

void Flow::State::ExecuteWords(ResolvedBlock* out) {
  for (const nc::Word& word : block.words) {
    if (!Resolve(word, out)) return;
  }
}

void Flow::State::ExecuteStatements(ResolvedBlock* out) {
  bool ignore_rest = false;
  for (const nc::Statement& statement : block.statements) {
    if (!Execute(statement, out, &ignore_rest) || ignore_rest) return;
  }
}

bool Flow::State::Execute(const nc::Statement& statement, ResolvedBlock* out, bool* ignore_rest) {
  bool holds = true;
  switch (statement.kind) {
    case nc::StatementKind::kWord:
      return Resolve(block.words[static_cast<std::size_t>(statement.word)], out);
    case nc::StatementKind::kAssignment:
      return Assign(statement);
    case nc::StatementKind::kCondition:
      if (!Condition(statement.value, statement.column, &holds)) return false;
      *ignore_rest = !holds;
      return true;
    case nc::StatementKind::kIfGoto:
      if (!Condition(statement.value, statement.column, &holds)) return false;
      if (!holds) return true;
      [[fallthrough]];
    case nc::StatementKind::kGoto: {
      nc::MacroValue label;
      if (!EvaluateAt(statement.label, statement.column, &label)) return false;
      // "The GOTO rounds the variable or expression result" (manual 2017, "Computed Branch").
      const double rounded = std::floor(label.value_or(0.0) + 0.5);
      SetPending(Action::kGoto, std::lround(std::clamp(rounded, -1.0, 1e9)), statement.column);
      return true;
    }
    case nc::StatementKind::kWhile:
    case nc::StatementKind::kDo:
      EnterLoop(statement);
      return !stopped;
    case nc::StatementKind::kEnd:
      SetPending(Action::kEndLoop, statement.loop, statement.column);
      return true;
    case nc::StatementKind::kPrint:
      return true;
  }
  return true;
}

bool Flow::State::Condition(nc::Expression expression, int column, bool* holds) {
  nc::MacroValue value;
  if (!EvaluateAt(expression, column, &value)) return false;
  *holds = value.value_or(0.0) != 0.0;
  return true;
}

bool Flow::State::EvaluateAt(nc::Expression expression, int column, nc::MacroValue* value) {
  std::string error;
  const bool done = nc::Evaluate(block.code, expression, variables, value, &error);
  if (!done) Alarm(column, std::move(error));
  return done;
}

bool Flow::State::Assign(const nc::Statement& statement) {
  nc::MacroValue target;
  nc::MacroValue value;
  if (!EvaluateAt(statement.target, statement.column, &target)) return false;
  if (!EvaluateAt(statement.value, statement.column, &value)) return false;
  const double number = target.value_or(-1.0);
  const double whole = std::round(number);
  if (!(whole >= 0.0 && whole <= 999999.0) || std::abs(number - whole) > 1e-4) {
    Alarm(statement.column, "the number of the variable to set is " +
                                (target ? Short(number) : std::string("undefined")));
    return false;
  }
  const long index = static_cast<long>(whole);
  if (index == 3000 || index == 3006) return AssignSystem(index, value, statement.column);
  if (variables.Write(index, value)) return true;
  Alarm(statement.column, "#" + std::to_string(index) + " cannot be set on this control");
  return false;
}

/// #3000=n (TEXT): alarm 1000+n. #3006=n (TEXT): a stop, after which the operator goes on.
bool Flow::State::AssignSystem(long number, const nc::MacroValue& value, int column) {
  if (number == 3006) return true;
  const long alarm = std::lround(std::clamp(value.value_or(0.0), 0.0, 999.0));
  std::string message = "alarm " + std::to_string(1000 + alarm) + " of the program itself";
  if (!block.comments.empty()) message += ": " + Printable(block.comments.front());
  Alarm(column, std::move(message));
  return false;
}

bool Flow::State::Resolve(const nc::Word& word, ResolvedBlock* out) {
  ResolvedWord resolved;
  resolved.value = word.value;
  resolved.has_point = word.has_point;
  if (word.is_expression) {
    nc::MacroValue value;
    variables.SetAddress(word.address);
    const bool done = EvaluateAt(word.expression, word.column, &value);
    variables.SetAddress(0);
    if (!done) return false;
    if (!value) return true;
    if (std::abs(*value) > kMaxWord) {
      Alarm(word.column, std::string("the value computed for ") + word.address + ", " +
                             Short(*value, 0) + ", is out of range");
      return false;
    }
    resolved.value = *value;
    resolved.has_point = true;
    resolved.from_expression = true;
    computed = true;
  } else if (!word.has_value) {
    report(MakeFinding(Rule::kSyntax, Here(word.column),
                       std::string("the letter ") + word.address +
                           " has no value: an address expression error on this control"));
    stopped = true;
    return false;
  }
  resolved.address = word.address;
  resolved.comma = word.comma;
  resolved.column = word.column;
  if (word.address == 'M' || word.address == 'G') {
    // The rounding of computed words comes later, as G65 takes its arguments unrounded.
    const double code_value =
        resolved.from_expression ? std::round(resolved.value * 10.0) / 10.0 : resolved.value;
    const char code = FlowCodeOf(word.address, code_value);
    if (code != 0) {
      several_flow_codes = several_flow_codes || flow_code != 0;
      flow_code = code;
      flow_code_column = word.column;
    }
  }
  out->words.push_back(resolved);
  return true;
}

/// "When a variable or expression is used in place of an address value, the value is rounded to the
/// least significant digit" (manual 2017, "Address Substitution").
void Flow::State::RoundComputed(ResolvedBlock* out) {
  for (ResolvedWord& word : out->words) {
    if (!word.from_expression) continue;
    const double scale = std::pow(10.0, variables.DecimalsOf(word.address));
    word.value = std::round(word.value * scale) / scale;
  }
}

void Flow::State::ReportBlock() {
  for (const nc::SyntaxError& doubt : block.doubts) {
    Unsupported(doubt.column, doubt.message);
  }
}

/// The control stops at the first one; a user wants to see the others as well.
void Flow::State::ReportSyntax() {
  int count = 0;
  const auto send = [&](const nc::Block& wrong) {
    for (const nc::SyntaxError& error : wrong.errors) {
      if (count++ >= kMaxSyntaxFindings) return;
      report(MakeFinding(Rule::kSyntax, {frame().text->file, wrong.line, error.column},
                         error.message));
    }
  };
  send(block);
  stopped = true;
  const nc::Program& program = *frame().text->program;
  std::size_t offset = block.next;
  for (int i = 1; i <= kMaxSyntaxLines && offset < program.text().size(); ++i) {
    if (count >= kMaxSyntaxFindings) return;
    nc::ParseBlock(program, offset, block.line + i, &ahead);
    if (ahead.program_mark) return;
    send(ahead);
    offset = ahead.next;
  }
}

}  // namespace ncsim::control
