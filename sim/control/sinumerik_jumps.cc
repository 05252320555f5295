// SPDX-License-Identifier: BSD-3-Clause
// Jumps, control structures, repetitions (NC programming 12/2019, "Program jumps and branches",
// "Repeat program section", "Control structures"). The partners of a structure are found in the
// text, so that nothing is left over where a jump leaves a loop.
#include <cmath>
#include <utility>

#include "sim/control/sinumerik_flow_state.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using nc::SinumerikJump;
using nc::SinumerikPartner;
using nc::SinumerikTarget;
using nc::TextPosition;

constexpr double kMaxRepetitions = 9999.0;

}  // namespace

/// A label as written, or what a STRING says.
bool SinumerikFlow::State::TargetLabel(const SinumerikTarget& target, std::string* label) {
  if (target.expression.empty()) {
    *label = target.label;
    const auto variable = variables.Find(target.label);
    if (variable == nullptr || variable->type() != nc::SinumerikType::kString ||
        !variable->sizes().empty()) {
      return true;
    }
    *label = variable->value(0).text;
    return true;
  }
  Value value;
  if (!EvaluateAt(target.expression, &value)) return false;
  if (value.type != nc::SinumerikType::kString) {
    return Alarm(target.column, 12150, "the target of a jump must be of type STRING");
  }
  *label = value.text;
  return true;
}

std::optional<TextPosition> SinumerikFlow::State::FindLabel(const std::string& label,
                                                            SinumerikJump jump) {
  const nc::SinumerikIndex& index = level().text->sinumerik_index();
  const nc::SinumerikSection& section = index.SectionAt(block.offset);
  if (jump != SinumerikJump::kBackward) {
    const auto found = index.FindForward(label, block.next, section.end);
    if (found || jump == SinumerikJump::kForward) return found;
  }
  return index.FindBackward(label, section.begin.offset, block.next);
}

bool SinumerikFlow::State::Goto(const Part& part) {
  if (part.jump == SinumerikJump::kToStart) {
    LeaveSections();
    if (!SetPending(Action::kJump, part.column)) return false;
    pending.target = level().start;
    return false;
  }
  const SinumerikTarget& target = block.targets[part.first_target];
  std::string label;
  if (!TargetLabel(target, &label)) return false;
  const auto found = FindLabel(label, part.jump);
  if (!found) {
    if (part.jump == SinumerikJump::kQuiet) return true;
    return Alarm(target.column, 14080, "the jump destination " + label + " was not found");
  }
  if (SetPending(Action::kJump, part.column)) pending.target = *found;
  return false;
}

/// The first branch whose constant equals the value; else DEFAULT; else the next block.
bool SinumerikFlow::State::Case(std::size_t index) {
  Value value;
  if (!EvaluateAt(block.parts[index].expression, &value)) return false;
  for (std::size_t i = index + 1; i < block.parts.size(); ++i) {
    const Part& branch = block.parts[i];
    if (branch.kind == PartKind::kCaseBranch) {
      Value constant;
      Value equal;
      if (!EvaluateAt(branch.expression, &constant)) return false;
      const std::string error = nc::ApplyBinary(nc::SinumerikOp::kEqual, value, constant, &equal);
      if (!error.empty()) return Alarm(branch.column, error);
      if (equal.number == 0.0) continue;
    }
    Goto(branch);
    return false;
  }
  return false;
}

/// Sections that the target does not lie in end here.
void SinumerikFlow::State::JumpTo(TextPosition target) {
  const ProgramText* text = level().text;
  while (level().kind == LevelKind::kSection &&
         (target.offset < level().start.offset || target.offset >= level().end)) {
    levels.pop_back();
  }
  if (level().text != text) {
    Unsupported(pending.column, "a jump out of the section of another program was not simulated");
    stopped = true;
    return;
  }
  level().next = target;
}

TextPosition SinumerikFlow::State::Behind(const ProgramText& text, TextPosition position) {
  nc::Scanner scanner(text.program->text(), position.offset);
  scanner.SkipToLineEnd();
  scanner.SkipLineEnd();
  return {position.offset + scanner.consumed(), position.line + 1};
}

void SinumerikFlow::State::Structure(const Part& part) {
  const SinumerikPartner* partner = level().text->sinumerik_index().Partner(block.offset);
  if (partner == nullptr || !partner->error.empty()) {
    Alarm(part.column, partner == nullptr
                           ? nc::AlarmText(12640, "a control structure that is not closed")
                           : partner->error);
    return;
  }
  bool holds = true;
  switch (part.kind) {
    case PartKind::kIf:
      if (!Condition(part, &holds) || holds) return;
      return JumpTo(Behind(partner->else_block.value_or(partner->other)));
    case PartKind::kElse:
      return JumpTo(Behind(partner->other));
    case PartKind::kWhile:
      if (Condition(part, &holds) && !holds) JumpTo(Behind(partner->other));
      return;
    case PartKind::kUntil:
      if (Condition(part, &holds) && !holds) JumpTo(Behind(partner->other));
      return;
    case PartKind::kFor:
      return StructureFor(part, *partner);
    case PartKind::kEndFor:
      JumpTo(partner->other);
      loop_back = partner->other.offset;
      return;
    case PartKind::kEndWhile:
    case PartKind::kEndLoop:
      return JumpTo(partner->other);
    default:
      return;  // ENDIF, LOOP, REPEAT: nothing to do.
  }
}

/// The variable counts up by one; the end is computed anew each time.
void SinumerikFlow::State::StructureFor(const Part& part, const SinumerikPartner& partner) {
  const bool again = loop_back.has_value();
  loop_back.reset();
  Value value;
  Value end;
  if (again) {
    if (!LoopVariable(part, &value)) return;
    value.number += 1.0;
  } else if (!EvaluateAt(part.expression, &value)) {
    return;
  }
  if (!SetLoopVariable(part, value) || !LoopVariable(part, &value)) return;
  if (!EvaluateAt(part.second, &end)) return;
  Value beyond;
  const std::string error = nc::ApplyBinary(nc::SinumerikOp::kGreater, value, end, &beyond);
  if (!error.empty()) {
    Alarm(part.column, error);
  } else if (beyond.number != 0.0) {
    JumpTo(Behind(partner.other));
  }
}

void SinumerikFlow::State::AddSection(Level section, int column) {
  if (!SetPending(Action::kSection, column)) return;
  section.kind = LevelKind::kSection;
  section.text = section.text == nullptr ? level().text : section.text;
  section.next = section.start;
  section.started = true;
  section.modal = level().modal;
  pending.callee = std::move(section);
}

/// REPEAT and REPEATB with labels: P more passes of what the labels mark.
void SinumerikFlow::State::Repeat(const Part& part) {
  Level section;
  section.passes = 1;
  if (!part.expression.empty()) {
    Value value;
    if (!EvaluateAt(part.expression, &value)) return;
    const bool valid =
        value.is_number() && std::round(value.number) >= 0.0 && value.number <= kMaxRepetitions;
    if (!valid) {
      Alarm(part.column, 12100, "the number of repetitions is not 0 to 9999");
      return;
    }
    section.passes = static_cast<long>(std::round(value.number));
  }
  if (!RepeatRange(part, &section) || section.passes == 0) return;
  AddSection(std::move(section), part.column);
}

/// From the first label to the second, to ENDLABEL, or to the REPEAT itself. Labels are looked for
/// backward, then forward.
bool SinumerikFlow::State::RepeatRange(const Part& part, Level* section) {
  const nc::SinumerikIndex& index = level().text->sinumerik_index();
  const nc::SinumerikSection& program = index.SectionAt(block.offset);
  std::string names[2];
  TextPosition places[2];
  const std::size_t count = block.targets[part.first_target + 1].empty() ? 1 : 2;
  for (std::size_t i = 0; i < count; ++i) {
    const SinumerikTarget& target = block.targets[part.first_target + i];
    if (!TargetLabel(target, &names[i])) return false;
    auto found = FindLabel(names[i], SinumerikJump::kBackward);
    if (!found) found = FindLabel(names[i], SinumerikJump::kForward);
    if (!found) {
      return Alarm(target.column, 14080, "the label " + names[i] + " was not found");
    }
    places[i] = *found;
  }
  section->start = places[0];
  if (part.kind == PartKind::kRepeatBlock) {
    section->end = Behind(places[0]).offset;
    return true;
  }
  if (count == 2) {
    section->end = Behind(places[1]).offset;
    const bool around = places[0].offset <= block.offset && block.offset < section->end;
    if (places[1].offset >= places[0].offset && !around) return true;
    return Alarm(part.column, 14082, "the labels do not mark a section beside the REPEAT");
  }
  const bool before = places[0].offset < block.offset;
  const std::size_t limit = before ? block.offset : program.end;
  const auto end_label = index.FindForward("ENDLABEL", places[0].offset, limit);
  section->end = end_label ? Behind(*end_label).offset : limit;
  return true;
}

/// `CALL [name] BLOCK label TO label`: once, the blocks of both labels included.
void SinumerikFlow::State::CallBlock(const Part& part) {
  Level section;
  section.text = level().text;
  std::size_t from = block.offset;
  if (!part.expression.empty()) {
    Value name;
    if (!EvaluateAt(part.expression, &name)) return;
    const SinumerikProgram found = programs.Find(name.text, *level().text);
    if (found.text == nullptr) return ReportMissing(name.text, part.column);
    section.text = found.text;
    from = found.begin.offset;
  }
  const nc::SinumerikIndex& index = section.text->sinumerik_index();
  const nc::SinumerikSection& program = index.SectionAt(from);
  TextPosition places[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const SinumerikTarget& target = block.targets[part.first_target + i];
    std::string label;
    if (!TargetLabel(target, &label)) return;
    const auto found = index.FindForward(label, program.begin.offset, program.end);
    if (!found) {
      Alarm(target.column, 14082, "the label " + label + " was not found");
      return;
    }
    places[i] = *found;
  }
  if (places[1].offset < places[0].offset) {
    Alarm(part.column, 14082, "the second label stands before the first");
    return;
  }
  section.start = places[0];
  section.end = Behind(*section.text, places[1]).offset;
  AddSection(std::move(section), part.column);
}

}  // namespace ncsim::control
