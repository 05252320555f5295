// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_flow.h"

#include <algorithm>
#include <utility>

#include "sim/control/limits.h"
#include "sim/control/sinumerik_flow_state.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
SinumerikItem* SinumerikStep::Find(char letter) {
  for (SinumerikItem& item : items) {
    const bool hit = item.kind == SinumerikItemKind::kWord && item.letter == letter;
    if (hit && item.extension < 0 && !item.used) return &item;
  }
  return nullptr;
}

SinumerikFlow::State::State(std::shared_ptr<const nc::Program> main,
                            SinumerikFlowOptions flow_options, SinumerikSystem* flow_system,
                            SourceFiles* files, Report report_to)
    : options(std::move(flow_options)),
      system(flow_system),
      report(std::move(report_to)),
      programs(std::move(main), options.subprogram_folders, files),
      variables(options.r_parameters) {
  Start();
}

SinumerikFlow::SinumerikFlow(std::shared_ptr<const nc::Program> main, SinumerikFlowOptions options,
                             SinumerikSystem* system, SourceFiles* files, Report report)
    : state_(std::make_unique<State>(std::move(main), std::move(options), system, files,
                                     std::move(report))) {}

SinumerikFlow::~SinumerikFlow() = default;

SinumerikEvent SinumerikFlow::Next(SinumerikStep* step) {
  State& state = *state_;
  while (true) {
    if (!state.stopped && !state.ended) state.Apply();
    if (state.stopped) return SinumerikEvent::kStopped;
    if (!state.events.empty()) {
      const SinumerikEvent event = state.events.front();
      state.events.pop_front();
      return event;
    }
    if (state.ended) return SinumerikEvent::kEnd;
    state.Step(step);
    if (!state.stopped && !step->items.empty()) return SinumerikEvent::kStep;
  }
}

const SinumerikModalCall* SinumerikFlow::PathMotionDone() { return state_->PathMotionDone(); }

bool SinumerikFlow::busy() const {
  const bool calls = state_->pending.action == State::Action::kCall && state_->pending.callee.modal;
  return calls || state_->stopped || state_->levels.back().modal;
}

std::uint64_t SinumerikFlow::blocks_executed() const { return state_->blocks; }

bool SinumerikFlow::ReadVariable(std::string_view name, nc::SinumerikValue* value) {
  nc::SinumerikFault fault;
  return state_->ReadName(name, {}, value, &fault);
}

/// An archive begins with its first main program.
void SinumerikFlow::State::Start() {
  Level first;
  first.text = &programs.main();
  const nc::Program& program = *first.text->program;
  first.start = {program.begin(), 1};
  if (program.Line(program.begin()).substr(0, 1) == "%") {
    const auto& sections = first.text->sinumerik_index().sections();
    const nc::SinumerikSection* chosen = &sections.front();
    for (const nc::SinumerikSection& section : sections) {
      if (!chosen->is_main && section.is_main) chosen = &section;
    }
    first.start = chosen->begin;
    first.started = true;
  }
  first.next = first.start;
  levels.push_back(std::move(first));
}

bool SinumerikFlow::State::Alarm(int column, std::string message) {
  report(MakeFinding(Rule::kControlAlarm, Here(column), std::move(message)));
  stopped = true;
  return false;
}

bool SinumerikFlow::State::Alarm(int column, int alarm, std::string message) {
  return Alarm(column, nc::AlarmText(alarm, std::move(message)));
}

void SinumerikFlow::State::Unsupported(int column, std::string message) {
  if (!reported.emplace(level().text->file, block.line, column).second) return;
  report(MakeFinding(Rule::kUnsupportedCode, Here(column), std::move(message)));
}

/// What cannot be computed stops the program: nothing behind it could be trusted.
bool SinumerikFlow::State::Fail(const nc::SinumerikFault& fault) {
  if (!fault.unsupported) return Alarm(fault.column, fault.message);
  Unsupported(fault.column, fault.message + "; the program was not followed any further");
  stopped = true;
  return false;
}

bool SinumerikFlow::State::EvaluateAt(nc::SinumerikExpression expression, Value* value) {
  nc::SinumerikFault fault;
  return nc::Evaluate(block, expression, *this, value, &fault) || Fail(fault);
}

bool SinumerikFlow::State::Condition(const Part& part, bool* holds) {
  Value value;
  if (!EvaluateAt(part.expression, &value)) return false;
  if (!value.is_number()) return Alarm(part.column, 12150, "a condition must be of type BOOL");
  *holds = value.number != 0.0;
  return true;
}

void SinumerikFlow::State::Step(SinumerikStep* out) {
  out->items.clear();
  out->values.clear();
  if (level().kind == LevelKind::kSection && level().next.offset >= level().end) {
    return Return();
  }
  if (level().next.offset >= level().text->program->text().size()) return EndOfText();
  if (blocks >= options.max_blocks) {
    block.line = level().next.line;
    Unsupported(1, "stopped after " + std::to_string(blocks) +
                       " blocks: a loop does not end, or the program is longer than this bound");
    stopped = true;
    return;
  }
  if (!ReadBlock()) return;
  Execute(out);
}

/// False: there is nothing to execute, or the program ends here.
bool SinumerikFlow::State::ReadBlock() {
  ++blocks;
  const nc::TextPosition at = level().next;
  ParseBlock(at);
  ReleasePages();
  if (block.has_header && (level().started || level().kind != LevelKind::kMain)) {
    EndOfText();
    return false;
  }
  level().next = {block.next, block.line + 1};
  if (block.has_header) return false;
  const bool skipped = block.skip_level >= 0 && (options.skip_levels >> block.skip_level & 1u) != 0;
  if (skipped) return false;
  if (!block.errors.empty()) {
    ReportSyntax();
    return false;
  }
  if (block.parts.empty()) return false;
  level().started = true;
  return true;
}

SinumerikMacros::Scope SinumerikFlow::State::MacroScope() const {
  std::size_t owner = levels.size() - 1;
  while (owner > 0 && levels[owner].kind == LevelKind::kSection) --owner;
  return {levels[owner].text, levels[owner].start.offset};
}

/// Where macros stand in the line their text is parsed instead; columns are those of their names.
void SinumerikFlow::State::ParseBlock(nc::TextPosition at) {
  const nc::Program& program = *level().text->program;
  nc::ParseSinumerikBlock(program, at.offset, at.line, &block);
  const auto macro = macros.Expand(MacroScope(), program.Line(at.offset));
  if (!macro) return;
  const std::size_t next = block.next;
  expanded = nc::Program::FromText(program.name(), macro->line);
  nc::ParseSinumerikBlock(*expanded, expanded->begin(), at.line, &block);
  block.offset = at.offset;
  block.next = next;
  const auto place = [&](int* column) {
    const auto index = static_cast<std::size_t>(std::max(1, *column) - 1);
    *column = macro->columns[std::min(index, macro->columns.size() - 1)];
  };
  for (nc::SinumerikPart& part : block.parts) place(&part.column);
  for (nc::SinumerikTarget& target : block.targets) place(&target.column);
  for (nc::SinumerikCode& code : block.code) place(&code.column);
  for (nc::SyntaxError& error : block.errors) place(&error.column);
}

void SinumerikFlow::State::ReleasePages() {
  constexpr std::size_t kStep = std::size_t{4} << 20;
  if (block.next < released) released = block.next;
  if (block.next - released < kStep) return;
  released = block.next;
  level().text->program->Release(released);
}

void SinumerikFlow::State::Execute(SinumerikStep* out) {
  groups_seen = 0;
  letters_seen = 0;
  m_words = 0;
  syntax_group_seen = false;
  called = false;
  if (loop_back && *loop_back != block.offset) loop_back.reset();
  out->where = Here(1);
  out->sequence = block.sequence;
  out->skip_level = block.skip_level;
  out->in_subprogram = std::any_of(levels.begin(), levels.end(), [](const Level& level_) {
    return level_.kind == LevelKind::kSubprogram;
  });
  out->comment = block.comment;
  for (std::size_t i = 0; i < block.parts.size(); ++i) {
    if (!ExecutePart(&i, out)) break;
  }
  if (!called) return;
  // `NAME P3`: passes of the call.
  SinumerikItem* passes = out->Find('P');
  if (passes == nullptr) return;
  constexpr double kMaxPasses = 9999.0;
  if (!(passes->value >= 0.0 && passes->value <= kMaxPasses)) {
    Alarm(passes->column, 12100, "the number of passes is not 0 to 9999");
    return;
  }
  if (pending.action == Action::kCall) {
    pending.callee.passes = static_cast<long>(passes->value);
    if (pending.callee.passes == 0) pending.action = Action::kNone;
  }
  out->items.erase(out->items.begin() + (passes - out->items.data()));
}

bool SinumerikFlow::State::ExecutePart(std::size_t* index, SinumerikStep* out) {
  const Part& part = block.parts[*index];
  bool holds = false;
  switch (part.kind) {
    case PartKind::kWord:
    case PartKind::kAssign:
    case PartKind::kName:
    case PartKind::kCall:
      return ExecuteWordPart(part, out);
    case PartKind::kIfGoto:
      if (!Condition(part, &holds)) return false;
      if (!holds) ++*index;  // The jump is the next part.
      return true;
    case PartKind::kGoto:
      return Goto(part);
    case PartKind::kCase:
      return Case(*index);
    case PartKind::kRepeatSection:
    case PartKind::kRepeatBlock:
      Repeat(part);
      return !stopped;
    case PartKind::kDefine:
      Define();
      return false;
    case PartKind::kProcedure:
    case PartKind::kExternal:
      return false;
    case PartKind::kCallName:
      CallByName(part);
      return !stopped;
    case PartKind::kCallBlock:
      CallBlock(part);
      return !stopped;
    case PartKind::kCallPath:
      return CallSubprogram(part, part.name);
    case PartKind::kModalCall:
      SetModalCall(part);
      return false;
    case PartKind::kReturn:
      if (part.argument_count > 0 || nc::SameName(part.name, "RETB")) {
        Unsupported(part.column, nc::UpperName(part.name) +
                                     " with a place to return to was not simulated: taken as RET");
      }
      return SetPending(Action::kReturn, part.column);
    case PartKind::kSynchronous:
    case PartKind::kUnsimulated:
      ReportUnsimulated(part);
      return false;
    case PartKind::kEndLabel:
      return true;
    default:
      Structure(part);
      return false;
  }
}

bool SinumerikFlow::State::ExecuteWordPart(const Part& part, SinumerikStep* out) {
  switch (part.kind) {
    case PartKind::kWord:
      return AddWord(part, out);
    case PartKind::kAssign:
      return Assign(part, out);
    default:
      return AddName(part, out);
  }
}

void SinumerikFlow::State::ReportUnsimulated(const Part& part) {
  const std::string name = nc::UpperName(part.name);
  if (part.kind == PartKind::kSynchronous) {
    return Unsupported(part.column, "the synchronised action (" + name + ") was not simulated");
  }
  if (name == "DEFINE" && block.parts.size() > 1 &&
      macros.Define(MacroScope(), level().text->program->Line(block.offset), block.parts[1].name)) {
    return;
  }
  Unsupported(part.column, name + " was not simulated");
}

/// The control stops at the first one; a user wants to see the others as well.
void SinumerikFlow::State::ReportSyntax() {
  int count = 0;
  const auto send = [&](const Block& wrong) {
    for (const nc::SyntaxError& error : wrong.errors) {
      if (count++ >= kMaxSyntaxFindings) return;
      report(MakeFinding(Rule::kSyntax, {level().text->file, wrong.line, error.column},
                         error.message));
    }
  };
  send(block);
  stopped = true;
  const nc::Program& program = *level().text->program;
  std::size_t offset = block.next;
  for (int i = 1; i <= kMaxSyntaxLines && offset < program.text().size(); ++i) {
    if (count >= kMaxSyntaxFindings) return;
    nc::ParseSinumerikBlock(program, offset, block.line + i, &ahead);
    if (ahead.has_header) return;
    send(ahead);
    offset = ahead.next;
  }
}

}  // namespace ncsim::control
