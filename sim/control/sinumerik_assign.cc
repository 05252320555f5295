// SPDX-License-Identifier: BSD-3-Clause
// Assignments and DEF (NC programming 12/2019, "User variables", "Arrays").
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/control/sinumerik_flow_state.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using nc::SinumerikList;
using nc::SinumerikType;

constexpr double kMaxElementsOfOne = 65535.0;

}  // namespace

/// Appends the values of arguments, indices or list elements; omitted ones are marked.
bool SinumerikFlow::State::EvaluateList(std::uint32_t first, std::uint32_t count,
                                        std::vector<Value>* values) {
  for (std::uint32_t i = 0; i < count; ++i) {
    Value value;
    if (!EvaluateAt(block.arguments[first + i], &value)) return false;
    values->push_back(std::move(value));
  }
  return true;
}

bool SinumerikFlow::State::Assign(const Part& part, SinumerikStep* out) {
  if (part.letter == 'R' || RParameterNumber(part.name) >= 0) return AssignParameter(part);
  if (part.letter == 'G' && part.index_count == 0) {
    Value value;
    if (!EvaluateAt(part.expression, &value)) return false;
    const nc::SinumerikCommand* command =
        value.is_number() ? nc::FindSinumerikG(value.number) : nullptr;
    if (command != nullptr) return AddGCode(command, part, out);
    return Alarm(part.column, 12475, "the value of G is no G code of the control");
  }
  if (part.letter != 0) return AddValuedWord(part, out);
  if (part.name[0] == '$' || IsGlobalRParameter(part.name)) return AssignSystem(part);
  if (const auto variable = variables.Find(part.name)) return AssignVariable(part, variable);
  const nc::SinumerikCommand* command = nc::FindSinumerikCommand(part.name);
  const bool address = command != nullptr && command->kind == nc::SinumerikCommandKind::kAddress;
  if (address || nc::SameName(part.name, "AX") || system->IsAxis(nc::UpperName(part.name))) {
    return AddValuedWord(part, out);
  }
  if (macros.IsNamedOnly(part.name)) {
    Unsupported(part.column, "the macro " + std::string(part.name) + " was not simulated");
    return false;
  }
  return Alarm(part.column, 12550, "the name " + std::string(part.name) + " is not defined");
}

bool SinumerikFlow::State::AssignVariable(const Part& part,
                                          const std::shared_ptr<SinumerikVariable>& variable) {
  if (part.modifier != nc::SinumerikModifier::kNone) {
    return Alarm(part.column, 12080, "AC, IC, DC ... are for axes");
  }
  std::vector<Value> indices;
  if (!EvaluateList(part.first_index, part.index_count, &indices)) return false;
  if (part.list == SinumerikList::kNone) {
    Value value;
    if (!EvaluateAt(part.expression, &value)) return false;
    return AssignElement(part, variable.get(), std::move(indices), value);
  }
  // `NAME[1] = SET(...)` begins at an element, `NAME = REP(0)` at the first.
  std::size_t offset = 0;
  if (!indices.empty()) {
    const std::string error = variable->OffsetOf(indices, &offset);
    if (!error.empty()) return Alarm(part.column, error);
  }
  return AssignList(part, variable, offset);
}

bool SinumerikFlow::State::AssignElement(const Part& part, SinumerikVariable* variable,
                                         std::vector<Value> indices, const Value& value) {
  const bool component =
      variable->type() == SinumerikType::kFrame && indices.size() == variable->sizes().size() + 2;
  std::string component_name;
  std::string axis;
  if (component) {
    component_name = indices.back().text;
    axis = indices[indices.size() - 2].text;
    indices.resize(indices.size() - 2);
  }
  std::size_t offset = 0;
  std::string error = variable->OffsetOf(indices, &offset);
  if (error.empty() && component) {
    Value frame = variable->value(offset);
    error = WriteFrameComponent(&frame, axis, component_name, value);
    if (error.empty()) error = variable->Set(offset, frame);
  } else if (error.empty()) {
    error = variable->Set(offset, value);
  }
  return error.empty() || Alarm(part.column, std::move(error));
}

bool SinumerikFlow::State::AssignList(const Part& part,
                                      const std::shared_ptr<SinumerikVariable>& variable,
                                      std::size_t offset) {
  std::vector<Value> values;
  if (!EvaluateList(part.first_argument, part.argument_count, &values)) return false;
  std::size_t count = values.size();
  const bool repeat = part.list == SinumerikList::kRepeat;
  if (repeat) {
    count = variable->size() - offset;
    if (values.size() > 2 || values[0].omitted) {
      return Alarm(part.column, 12080, "REP takes a value and a count");
    }
    if (values.size() == 2 && values[1].is_number() && values[1].number >= 0.0) {
      count = std::min(count, static_cast<std::size_t>(std::min(values[1].number, 1e9)));
    }
  } else if (count > variable->size() - offset) {
    return Alarm(part.column, 12260, "SET has more values than the array");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Value& value = values[repeat ? 0 : i];
    if (value.omitted) continue;
    std::string error = variable->Set(offset + i, value);
    if (!error.empty()) return Alarm(part.column, std::move(error));
  }
  return true;
}

/// `R1=`, `R[R2]=`.
bool SinumerikFlow::State::AssignParameter(const Part& part) {
  std::vector<Value> indices;
  if (!EvaluateList(part.first_index, part.index_count, &indices)) return false;
  const long number = RParameterNumber(part.name);
  if (number >= 0) indices.insert(indices.begin(), Value::Int(static_cast<double>(number)));
  if (part.modifier != nc::SinumerikModifier::kNone) {
    return Alarm(part.column, 12080, "AC, IC, DC ... are for axes");
  }
  std::size_t offset = 0;
  const std::shared_ptr<SinumerikVariable>& r = variables.r_parameters();
  const std::string error = r->OffsetOf(indices, &offset);
  if (!error.empty()) return Alarm(part.column, error);
  if (part.list != SinumerikList::kNone) {
    for (std::size_t i = offset; i < r->size(); ++i) variables.MarkSet(i);
    return AssignList(part, r, offset);
  }
  Value value;
  if (!EvaluateAt(part.expression, &value)) return false;
  variables.MarkSet(offset);
  return AssignElement(part, r.get(), indices, value);
}

bool SinumerikFlow::State::AssignSystem(const Part& part) {
  std::vector<Value> indices;
  Value value;
  if (!EvaluateList(part.first_index, part.index_count, &indices)) return false;
  if (part.list != SinumerikList::kNone || part.modifier != nc::SinumerikModifier::kNone) {
    Unsupported(part.column, "a list for the system variable " + nc::UpperName(part.name) +
                                 " was not simulated");
    return true;
  }
  if (!EvaluateAt(part.expression, &value)) return false;
  const std::string name = nc::UpperName(part.name);
  std::string message;
  switch (system->Write(name, indices, value, &message)) {
    case SinumerikSystem::Access::kDone:
      return true;
    case SinumerikSystem::Access::kUnknown:
      Unsupported(part.column, message.empty()
                                   ? "setting the system variable " + name + " was not simulated"
                                   : std::move(message));
      return true;
    case SinumerikSystem::Access::kAlarm:
      break;
  }
  return Alarm(part.column, std::move(message));
}

/// The variable of FOR, by its name or as an R parameter.
bool SinumerikFlow::State::SetLoopVariable(const Part& part, const Value& value) {
  std::vector<Value> indices;
  if (!EvaluateList(part.first_index, part.index_count, &indices)) return false;
  std::shared_ptr<SinumerikVariable> variable = variables.Find(part.name);
  const long number = RParameterNumber(part.name);
  if (number >= 0 || nc::SameName(part.name, "R")) {
    variable = variables.r_parameters();
    if (number >= 0) indices.insert(indices.begin(), Value::Int(static_cast<double>(number)));
    if (indices.size() == 1 && indices[0].number >= 0.0 &&
        indices[0].number < static_cast<double>(variable->size())) {
      variables.MarkSet(static_cast<std::size_t>(std::round(indices[0].number)));
    }
  }
  if (variable == nullptr) {
    return Alarm(part.column, 12550, "the name " + std::string(part.name) + " is not defined");
  }
  return AssignElement(part, variable.get(), std::move(indices), value);
}

bool SinumerikFlow::State::LoopVariable(const Part& part, Value* value) {
  std::vector<Value> indices;
  nc::SinumerikFault fault;
  if (!EvaluateList(part.first_index, part.index_count, &indices)) return false;
  fault.column = part.column;
  return ReadName(part.name, indices, value, &fault) || Fail(fault);
}

void SinumerikFlow::State::Define() {
  const Part& definition = block.parts.front();
  double length = nc::kMaxString;
  if (!definition.second.empty()) {
    Value value;
    if (!EvaluateAt(definition.second, &value)) return;
    if (!value.is_number() || !(value.number >= 1.0 && value.number <= nc::kMaxString)) {
      Alarm(definition.column, 12160, "a STRING has 1 to 200 characters");
      return;
    }
    length = value.number;
  }
  for (std::size_t i = 1; i < block.parts.size(); ++i) {
    if (!DefineOne(definition, block.parts[i], static_cast<std::size_t>(length))) return;
  }
}

bool SinumerikFlow::State::DefineOne(const Part& definition, const Part& name,
                                     std::size_t text_length) {
  std::vector<Value> indices;
  std::vector<std::size_t> sizes;
  if (!EvaluateList(name.first_index, name.index_count, &indices)) return false;
  double count = 1.0;
  for (const Value& index : indices) {
    const double size = index.is_number() && !index.omitted ? std::round(index.number) : 0.0;
    count *= std::max(size, 0.0);
    if (!(size >= 1.0 && count <= kMaxElementsOfOne)) {
      return Alarm(name.column, 12430, "the size of an array is not 1 to 65535");
    }
    sizes.push_back(static_cast<std::size_t>(size));
  }
  const nc::SinumerikCommand* command = nc::FindSinumerikCommand(name.name);
  if (command != nullptr && command->kind != nc::SinumerikCommandKind::kCycle) {
    return Alarm(name.column, 12170,
                 "the name " + std::string(name.name) + " is the control's own");
  }
  const auto variable =
      std::make_shared<SinumerikVariable>(definition.type, std::move(sizes), text_length);
  std::string error = variables.Define(name.name, variable, definition.is_global);
  if (!error.empty()) return Alarm(name.column, std::move(error));
  if (name.list != SinumerikList::kNone) return AssignList(name, variable, 0);
  if (name.expression.empty()) return true;
  if (name.index_count > 0) {
    Unsupported(name.column, "a single start value of an array was not simulated");
    return true;
  }
  Value value;
  if (!EvaluateAt(name.expression, &value)) return false;
  return AssignElement(name, variable.get(), {}, value);
}

}  // namespace ncsim::control
