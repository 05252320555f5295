// SPDX-License-Identifier: BSD-3-Clause
// Calls of subprograms and their end (NC programming 12/2019, "Subprogram technique").
#include <algorithm>
#include <utility>

#include "sim/base/text.h"
#include "sim/control/sinumerik_flow_state.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using nc::SinumerikType;

/// Main program and 15 levels of subprograms.
constexpr std::size_t kMaxPrograms = 16;
constexpr std::size_t kMaxLevels = 32;
/// Before PROC there may be comments only.
constexpr int kMaxHeadLines = 1000;

}  // namespace

bool SinumerikFlow::State::SetPending(Action action, int column) {
  // RET behind M17, or M30 behind RET, say the same thing twice.
  if (pending.action == Action::kReturn && action == Action::kReturn) return true;
  if (pending.action != Action::kNone) {
    return Alarm(column, 12080, "two jumps or calls in a block");
  }
  pending.action = action;
  pending.column = column;
  return true;
}

/// Carries out what the block just executed does at its end.
void SinumerikFlow::State::Apply() {
  const Action action = std::exchange(pending.action, Action::kNone);
  switch (action) {
    case Action::kNone:
      return;
    case Action::kJump:
      return JumpTo(pending.target);
    case Action::kCall:
    case Action::kSection:
      return Call(std::move(pending.callee), pending.column);
    case Action::kReturn:
      LeaveSections();
      return Return();
  }
}

void SinumerikFlow::State::Call(Level callee, int column) {
  const auto programs_open =
      static_cast<std::size_t>(std::count_if(levels.begin(), levels.end(), [](const Level& open) {
        return open.kind != LevelKind::kSection;
      }));
  const bool section = callee.kind == LevelKind::kSection;
  if (levels.size() >= kMaxLevels || (!section && programs_open >= kMaxPrograms)) {
    Alarm(column, 14012,
          "subprograms are nested deeper than " + std::to_string(kMaxPrograms) + " levels");
    return;
  }
  if (callee.kind == LevelKind::kSubprogram) variables.PushLevel(callee.parameters);
  if (callee.save) events.push_back(SinumerikEvent::kSave);
  callee.modal = callee.modal || level().modal;
  callee.next = callee.start;
  levels.push_back(std::move(callee));
}

/// RET and M17 within a repetition end the program that it stands in.
void SinumerikFlow::State::LeaveSections() {
  while (level().kind == LevelKind::kSection) levels.pop_back();
}

void SinumerikFlow::State::Return() {
  Level& current = level();
  if (current.kind == LevelKind::kMain) {
    ended = true;
    return;
  }
  if (current.save) events.push_back(SinumerikEvent::kRestore);
  if (current.passes > 1) {
    --current.passes;
    current.next = current.start;
    if (current.kind == LevelKind::kSubprogram) {
      variables.ResetLevel(current.parameters);
    }
    if (current.save) events.push_back(SinumerikEvent::kSave);
    return;
  }
  if (current.kind == LevelKind::kSubprogram) variables.PopLevel();
  const bool was_modal = current.modal;
  levels.pop_back();
  if (was_modal && !level().modal) events.push_back(SinumerikEvent::kModalEnd);
}

/// A text may end without M17 or M30.
void SinumerikFlow::State::EndOfText() {
  LeaveSections();
  Return();
}

void SinumerikFlow::State::ReportMissing(std::string_view name, int column) {
  const std::string upper = nc::UpperName(name.substr(0, 100));
  std::string text;
  for (const char c : upper) text += c >= ' ' && c < '\x7f' ? c : '?';
  // Names of a letter and digits (L54) are near to many.
  const bool slip = text.size() > 3 && !IsDigit(text[1]);
  Unsupported(column, "the subprogram " + text + " was not simulated" +
                          (slip ? DidYouMean(text, nc::SinumerikCommandNames()) : "") + ": " +
                          programs.Where() + "; the control has it or stops with alarm 14011");
}

/// By its name, with the arguments of the part.
bool SinumerikFlow::State::CallSubprogram(const Part& part, std::string_view name) {
  std::vector<Argument> arguments;
  called = true;
  const SinumerikProgram found = programs.Find(name, *level().text);
  if (found.text == nullptr) {
    ReportMissing(name, part.column);
    return true;
  }
  if (!EvaluateArguments(part, &arguments)) return false;
  Level callee;
  if (!Bind(found, std::move(arguments), part.column, &callee)) return false;
  if (!SetPending(Action::kCall, part.column)) return false;
  pending.callee = std::move(callee);
  return true;
}

/// `CALL value`, `EXTCALL value`.
void SinumerikFlow::State::CallByName(const Part& part) {
  Value name;
  if (!EvaluateAt(part.expression, &name)) return;
  if (name.type != SinumerikType::kString) {
    Alarm(part.column, 12150, nc::UpperName(part.name) + " needs a value of type STRING");
    return;
  }
  CallSubprogram(part, name.text);
}

/// `MCALL NAME(...)`, or `MCALL` to end it.
void SinumerikFlow::State::SetModalCall(const Part& part) {
  modal = {};
  if (part.name.empty()) return;
  if (!EvaluateList(part.first_argument, part.argument_count, &modal.arguments)) return;
  modal.name = nc::UpperName(part.name);
  modal.where = Here(part.column);
  const nc::SinumerikCommand* command = nc::FindSinumerikCommand(part.name);
  const bool cycle = command != nullptr && command->kind == nc::SinumerikCommandKind::kCycle;
  if (cycle && command->support != nc::Support::kUnsupported) {
    modal.command = command;
  } else if (programs.Find(modal.name, *level().text).text != nullptr) {
    return;
  } else if (cycle) {
    modal.command = command;
  } else {
    ReportMissing(modal.name, part.column);
    modal = {};
  }
}

const SinumerikModalCall* SinumerikFlow::State::PathMotionDone() {
  if (modal.name.empty() || level().modal || stopped) return nullptr;
  if (modal.command != nullptr) return &modal;
  // What the block itself does at its end comes after the modal call, so it must not have any.
  if (pending.action != Action::kNone) {
    Unsupported(pending.column,
                "a jump, call or end in a block with motion under MCALL was not "
                "simulated");
    stopped = true;
    return nullptr;
  }
  std::vector<Argument> arguments;
  for (const Value& value : modal.arguments) arguments.push_back({value, nullptr});
  const SinumerikProgram found = programs.Find(modal.name, *level().text);
  Level callee;
  if (found.text == nullptr || !Bind(found, std::move(arguments), 1, &callee)) return nullptr;
  callee.modal = true;
  if (SetPending(Action::kCall, 1)) pending.callee = std::move(callee);
  return nullptr;
}

bool SinumerikFlow::State::EvaluateArguments(const Part& part, std::vector<Argument>* arguments) {
  for (std::uint32_t i = 0; i < part.argument_count; ++i) {
    const nc::SinumerikExpression expression = block.arguments[part.first_argument + i];
    Argument argument;
    if (expression.empty()) {
      argument.value = Value::Omitted();
      arguments->push_back(std::move(argument));
      continue;
    }
    const nc::SinumerikCode& last = block.code[expression.end - 1];
    const bool name = last.op == nc::SinumerikOp::kName;
    // A whole array has no value, only a name.
    if (name && last.count == 0) {
      const auto variable = variables.Find(last.name);
      if (variable != nullptr && !variable->sizes().empty()) {
        argument.variable = variable;
        argument.value = Value::Default(variable->type());
        arguments->push_back(std::move(argument));
        continue;
      }
    }
    last_read = nullptr;
    if (!EvaluateAt(expression, &argument.value)) return false;
    if (name && last_read != nullptr) {
      argument.variable = last_read->size() == 1 && last_read->sizes().empty()
                              ? last_read
                              : std::make_shared<SinumerikVariable>(last_read, last_offset);
    }
    arguments->push_back(std::move(argument));
  }
  return true;
}

/// Makes the level of a called program, its parameters set.
bool SinumerikFlow::State::Bind(SinumerikProgram program, std::vector<Argument> arguments,
                                int column, Level* callee) {
  callee->kind = LevelKind::kSubprogram;
  callee->text = program.text;
  callee->start = program.begin;
  const nc::Program& text = *program.text->program;
  nc::TextPosition at = program.begin;
  for (int i = 0; i < kMaxHeadLines && at.offset < text.text().size(); ++i) {
    nc::ParseSinumerikBlock(text, at.offset, at.line, &ahead);
    if (ahead.has_header || !ahead.parts.empty() || !ahead.errors.empty()) break;
    at = {ahead.next, at.line + 1};
  }
  const bool has_head = at.offset < text.text().size() && ahead.errors.empty() &&
                        !ahead.parts.empty() && ahead.parts[0].kind == PartKind::kProcedure;
  std::size_t count = 0;
  if (has_head) {
    // The default values are code of the head: it stands in for the block while they are computed.
    for (const Part& part : ahead.parts) {
      if (part.kind == PartKind::kAttribute) {
        callee->save = callee->save || nc::SameName(part.name, "SAVE");
      }
      if (part.kind != PartKind::kParameter) continue;
      const bool given = count < arguments.size() && !arguments[count].value.omitted;
      Argument argument;
      if (count < arguments.size()) argument = std::move(arguments[count]);
      ++count;
      callee->given.push_back(given);
      if (!BindParameter(part, &argument, given, column, &callee->parameters)) return false;
    }
  }
  if (count >= arguments.size()) return true;
  return Alarm(column, 12340,
               "the call has " + std::to_string(arguments.size()) + " arguments, the subprogram " +
                   std::to_string(count) + " parameters");
}

bool SinumerikFlow::State::BindParameter(const Part& parameter, Argument* argument, bool given,
                                         int column, SinumerikScope* scope) {
  const std::string name = nc::UpperName(parameter.name);
  const bool array = parameter.index_count > 0;
  if (given && (parameter.by_reference || array)) {
    if (argument->variable == nullptr) {
      return Alarm(column, 12320, "the argument for " + name + " is not a variable");
    }
    const bool fits = argument->variable->type() == parameter.type &&
                      argument->variable->sizes().size() == parameter.index_count;
    if (!fits) {
      return Alarm(column, 12330, "the argument for " + name + " has another type or size");
    }
    if (!scope->emplace(name, argument->variable).second) {
      return Alarm(column, 12170, "the parameter " + name + " is defined twice");
    }
    return true;
  }
  std::vector<std::size_t> sizes(parameter.index_count, 1);
  auto variable =
      std::make_shared<SinumerikVariable>(parameter.type, std::move(sizes), nc::kMaxString);
  std::string error;
  if (given) {
    if (argument->variable != nullptr && !argument->variable->sizes().empty()) {
      return Alarm(column, 12330, "the argument for " + name + " is an array");
    }
    error = variable->Set(0, argument->value);
  } else if (!parameter.expression.empty()) {
    Value value;
    nc::SinumerikFault fault;
    if (!nc::Evaluate(ahead, parameter.expression, *this, &value, &fault)) {
      fault.column = column;
      return Fail(fault);
    }
    error = variable->Set(0, value);
  }
  if (!error.empty()) return Alarm(column, "parameter " + name + ": " + error);
  if (scope->emplace(name, std::move(variable)).second) return true;
  return Alarm(column, 12170, "the parameter " + name + " is defined twice");
}

}  // namespace ncsim::control
