// SPDX-License-Identifier: BSD-3-Clause
// What the words and names of a block are worth.
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/base/text.h"
#include "sim/control/limits.h"
#include "sim/control/sinumerik_flow_state.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using nc::SinumerikCommand;
using nc::SinumerikCommandKind;
using nc::SinumerikFault;
using nc::SinumerikValue;

constexpr int kMaxMWords = 5;

bool Fault(SinumerikFault* fault, std::string message) {
  fault->message = std::move(message);
  return false;
}

/// Alarms that SETAL raises and after which the program goes on: messages (Diagnostics manual, "NC
/// part program alarms": 62000 to 62999, 65000 to 65999, 67000 and more).
bool IsMessage(double number) {
  return (number >= 62000.0 && number < 63000.0) || (number >= 65000.0 && number < 66000.0) ||
         number >= 67000.0;
}

}  // namespace

// --- names in expressions ---

bool SinumerikFlow::State::ReadName(std::string_view name, const std::vector<Value>& indices,
                                    Value* value, SinumerikFault* fault) {
  last_read = nullptr;
  const bool indexed_r = name.size() == 1 && Upper(name[0]) == 'R' && !indices.empty();
  if (indexed_r) return ReadParameter(indices, value, fault);
  if (const long number = RParameterNumber(name); number >= 0 && indices.empty()) {
    return ReadParameter({Value::Int(static_cast<double>(number))}, value, fault);
  }
  if (name[0] == '$' || IsGlobalRParameter(name)) return ReadSystem(name, indices, value, fault);
  if (const auto variable = variables.Find(name)) {
    return ReadVariable(variable, indices, value, fault);
  }
  if (indices.empty()) {
    if (const double* constant = nc::FindSinumerikConstant(name)) {
      *value = Value::Int(*constant);
      return true;
    }
    const std::string upper = nc::UpperName(name);
    if (system->IsAxis(upper)) {
      *value = Value::Axis(upper);
      return true;
    }
    // `$P_UIFR[1,X,TR]`: the component is an index.
    if (IsFrameComponent(name)) {
      *value = Value::String(upper);
      return true;
    }
  }
  if (macros.IsNamedOnly(name)) {
    fault->unsupported = true;
    return Fault(fault, "the macro " + std::string(name) + " was not simulated");
  }
  return Fault(fault, nc::AlarmText(12550, "the name " + std::string(name) + " is not defined"));
}

bool SinumerikFlow::State::ReadVariable(const std::shared_ptr<SinumerikVariable>& variable,
                                        const std::vector<Value>& indices, Value* value,
                                        SinumerikFault* fault) {
  const bool component = variable->type() == nc::SinumerikType::kFrame &&
                         indices.size() == variable->sizes().size() + 2;
  // One index more than a STRING has: a character of it.
  const bool character = variable->type() == nc::SinumerikType::kString &&
                         indices.size() == variable->sizes().size() + 1;
  std::size_t offset = 0;
  const std::vector<Value> place(indices.begin(), indices.end() - (component   ? 2
                                                                   : character ? 1
                                                                               : 0));
  std::string error = variable->OffsetOf(place, &offset);
  if (!error.empty()) return Fault(fault, std::move(error));
  if (character) {
    const std::string& text = variable->value(offset).text;
    const double at = indices.back().is_number() ? indices.back().number : -1.0;
    if (!(at >= 0.0 && at < static_cast<double>(text.size()))) {
      return Fault(fault, nc::AlarmText(17020, "the string has no character there"));
    }
    *value = Value::Default(nc::SinumerikType::kChar);
    value->number = static_cast<unsigned char>(text[static_cast<std::size_t>(at)]);
    return true;
  }
  if (component) {
    error = ReadFrameComponent(variable->value(offset), indices[indices.size() - 2].text,
                               indices.back().text, value);
    fault->unsupported = !error.empty();
    return error.empty() || Fault(fault, std::move(error));
  }
  *value = variable->value(offset);
  last_read = variable;
  last_offset = offset;
  return true;
}

bool SinumerikFlow::State::ReadParameter(const std::vector<Value>& indices, Value* value,
                                         SinumerikFault* fault) {
  const std::shared_ptr<SinumerikVariable>& r = variables.r_parameters();
  std::size_t offset = 0;
  std::string error = r->OffsetOf(indices, &offset);
  if (!error.empty()) return Fault(fault, std::move(error));
  if (variables.TakeUnset(offset)) system->AssumeZero("R" + std::to_string(offset));
  *value = r->value(offset);
  last_read = r;
  last_offset = offset;
  return true;
}

bool SinumerikFlow::State::ReadSystem(std::string_view name, const std::vector<Value>& indices,
                                      Value* value, SinumerikFault* fault) {
  const std::string upper = nc::UpperName(name);
  if (upper == "$PI") {
    *value = Value::Real(std::numbers::pi);
    return true;
  }
  if (upper == "$P_SUBPAR") {
    const double index = indices.size() == 1 ? indices[0].number : 0.0;
    std::size_t owner = levels.size() - 1;
    while (owner > 0 && levels[owner].kind == LevelKind::kSection) --owner;
    const std::vector<bool>& given = levels[owner].given;
    const bool known = index >= 1.0 && index <= static_cast<double>(given.size());
    *value = Value::Bool(known && given[static_cast<std::size_t>(index) - 1]);
    return true;
  }
  std::string message;
  switch (system->Read(upper, indices, value, &message)) {
    case SinumerikSystem::Access::kDone:
      return true;
    case SinumerikSystem::Access::kUnknown:
      fault->unsupported = true;
      return Fault(fault, message.empty() ? "the system variable " + upper + " was not simulated"
                                          : std::move(message));
    case SinumerikSystem::Access::kAlarm:
      break;
  }
  return Fault(fault, std::move(message));
}

bool SinumerikFlow::State::CallFunction(std::string_view name, const std::vector<Value>& arguments,
                                        Value* value, SinumerikFault* fault) {
  const std::string upper = nc::UpperName(name);
  if (upper == "ISVAR" && arguments.size() == 1 && !arguments[0].text.empty() &&
      arguments[0].text[0] != '$') {
    const std::string& text = arguments[0].text;
    const std::string_view plain = std::string_view(text).substr(0, text.find('['));
    *value = Value::Bool(variables.Find(plain) != nullptr || RParameterNumber(plain) >= 0 ||
                         nc::UpperName(plain) == "R");
    return true;
  }
  fault->unsupported = true;
  return Fault(fault, "the function " + upper + " was not simulated");
}

// --- parts of a block ---

/// Alarms 16420 and 12010: an axis or an address that stands twice.
bool SinumerikFlow::State::CheckRepeated(const Part& part) {
  constexpr std::string_view kAxes = "ABCUVWXYZQ";
  if (part.letter == 'M') {
    if (++m_words <= kMaxMWords) return true;
    return Alarm(part.column, 12010, "more than five M functions in a block");
  }
  if (part.extension >= 0 || part.index_count > 0 || part.letter == 'H' || part.letter == 'G') {
    return true;
  }
  const std::uint32_t bit = 1u << (part.letter - 'A');
  const bool repeated = (letters_seen & bit) != 0;
  letters_seen |= bit;
  if (!repeated) return true;
  const std::string letter(1, part.letter);
  if (kAxes.find(part.letter) != std::string_view::npos) {
    return Alarm(part.column, 16420, "the axis " + letter + " stands twice in the block");
  }
  return Alarm(part.column, 12010, "the address " + letter + " stands twice in the block");
}

bool SinumerikFlow::State::AddWord(const Part& part, SinumerikStep* out) {
  if (part.letter == 'G') {
    const SinumerikCommand* command = nc::FindSinumerikG(part.value);
    if (command != nullptr) return AddGCode(command, part, out);
    return Alarm(part.column, 12470, "G" + Short(part.value) + " is no G code of the control");
  }
  if (part.letter == 'L') return CallSubprogram(part, part.name);
  if (!CheckRepeated(part)) return false;
  SinumerikItem item;
  item.letter = part.letter;
  item.is_integer = part.is_integer;
  item.column = part.column;
  item.value = part.value;
  item.name = part.name;
  if (std::abs(part.value) > kMaxWord) {
    return Alarm(part.column, 12160,
                 "the value of " + std::string(1, part.letter) + " is out of range");
  }
  if (part.letter == 'M' && (part.value == 2.0 || part.value == 17.0 || part.value == 30.0)) {
    item.used = true;
    if (!SetPending(Action::kReturn, part.column)) return false;
  }
  out->items.push_back(item);
  return true;
}

bool SinumerikFlow::State::AddGCode(const SinumerikCommand* command, const Part& part,
                                    SinumerikStep* out) {
  if (command->group > 0) {
    const std::uint64_t bit = std::uint64_t{1} << (command->group - 1);
    if ((groups_seen & bit) != 0) {
      const int alarm = nc::IsSyntaxGroup(command->group) ? 12070 : 12060;
      return Alarm(part.column, alarm,
                   "G group " + std::to_string(command->group) + " stands twice in the block");
    }
    groups_seen |= bit;
    if (nc::IsSyntaxGroup(command->group)) {
      if (syntax_group_seen) {
        return Alarm(part.column, 12070,
                     "two commands in the block that define what its words mean");
      }
      syntax_group_seen = true;
    }
  }
  SinumerikItem item;
  item.kind = SinumerikItemKind::kCommand;
  item.column = part.column;
  item.command = command;
  item.name = part.name;
  item.value = part.letter == 'G' ? part.value : 0.0;
  out->items.push_back(item);
  return true;
}

/// A name alone or with arguments: a command of the control, or a subprogram.
bool SinumerikFlow::State::AddName(const Part& part, SinumerikStep* out) {
  const SinumerikCommand* command = nc::FindSinumerikCommand(part.name);
  if (command == nullptr || command->kind == SinumerikCommandKind::kMCode ||
      (command->kind == SinumerikCommandKind::kAddress && part.kind == PartKind::kCall)) {
    if (!macros.IsNamedOnly(part.name)) return CallSubprogram(part, part.name);
    Unsupported(part.column, "the macro " + std::string(part.name) + " was not simulated");
    return false;
  }
  switch (command->kind) {
    case SinumerikCommandKind::kGCode:
      if (part.kind == PartKind::kName) return AddGCode(command, part, out);
      return Alarm(part.column, 12080, std::string(command->name) + " takes no arguments");
    case SinumerikCommandKind::kAddress:
      return Alarm(part.column, 12080,
                   "the address " + std::string(command->name) + " has no value");
    case SinumerikCommandKind::kCycle:
      // What is not simulated may be there as the user's own text.
      if (command->support == nc::Support::kUnsupported &&
          programs.Find(part.name, *level().text).text != nullptr) {
        return CallSubprogram(part, part.name);
      }
      return AddCommandCall(*command, part, out);
    default:
      return AddCommandCall(*command, part, out);
  }
}

bool SinumerikFlow::State::AddCommandCall(const SinumerikCommand& command, const Part& part,
                                          SinumerikStep* out) {
  if (command.name == "SETAL") return RaiseAlarm(part);
  SinumerikItem item;
  item.kind = SinumerikItemKind::kCall;
  item.column = part.column;
  item.command = &command;
  item.name = part.name;
  item.first_value = out->values.size();
  item.value_count = part.argument_count;
  if (!EvaluateList(part.first_argument, part.argument_count, &out->values)) return false;
  out->items.push_back(item);
  return true;
}

/// SETAL(n[, text]).
bool SinumerikFlow::State::RaiseAlarm(const Part& part) {
  std::vector<Value> values;
  if (!EvaluateList(part.first_argument, part.argument_count, &values)) return false;
  if (values.empty() || values[0].omitted || !values[0].is_number()) {
    return Alarm(part.column, 12080, "SETAL needs the number of an alarm");
  }
  if (IsMessage(values[0].number)) return true;
  std::string message = "alarm " + Short(values[0].number, 0) + " of the program itself (SETAL)";
  if (values.size() > 1 && values[1].type == nc::SinumerikType::kString) {
    message += ": ";
    for (const char c : values[1].text) message += c >= ' ' && c < '\x7f' ? c : '?';
  }
  return Alarm(part.column, std::move(message));
}

/// `X=R1`, `CR=5`, `AX[X1]=IC(2)`, `T="MILL"`: an address whose value is computed.
bool SinumerikFlow::State::AddValuedWord(const Part& part, SinumerikStep* out) {
  if (part.letter != 0 && !CheckRepeated(part)) return false;
  if (part.list != nc::SinumerikList::kNone) {
    return Alarm(part.column, 12580, "SET and REP are for arrays");
  }
  SinumerikItem item;
  item.modifier = part.modifier;
  item.letter = part.letter;
  item.extension = part.extension;
  item.column = part.column;
  item.command = part.letter == 0 ? nc::FindSinumerikCommand(part.name) : nullptr;
  item.name = part.name;
  item.first_value = out->values.size();
  item.value_count = part.index_count;
  Value value;
  if (!EvaluateList(part.first_index, part.index_count, &out->values)) return false;
  if (!EvaluateAt(part.expression, &value)) return false;
  item.is_text = !value.is_number();
  item.value = value.number;
  item.is_integer = value.type == nc::SinumerikType::kInt;
  if (item.is_text) {
    out->values.push_back(std::move(value));
  } else if (std::abs(item.value) > kMaxWord) {
    return Alarm(part.column, 12160,
                 "the value computed for " + std::string(part.name) + " is out of range");
  }
  out->items.push_back(item);
  return true;
}

}  // namespace ncsim::control
