// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/haas_variables.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "sim/base/units.h"
#include "sim/machine/rotary_centre.h"

namespace ncsim::control {
namespace {

struct Range {
  long first, last;
  bool Has(long number) const { return number >= first && number <= last; }
};

// In this order: H geometry, H wear, D geometry, D wear, 200 each.
constexpr Range kToolRegisters = {2001, 2800};
// The control has them; what they hold is outside a simulation: flutes, actual diameters, clocks,
// counters, probe positions, tool management, inputs, outputs, parameters.
constexpr std::array<Range, 14> kOutside = {{{1601, 1800},
                                             {3002, 3002},
                                             {3011, 3012},
                                             {3020, 3025},
                                             {3201, 3400},
                                             {3901, 3902},
                                             {5061, 5069},
                                             {5401, 6000},
                                             {8500, 8567},
                                             {11000, 11255},
                                             {12000, 12255},
                                             {13000, 13063},
                                             {20000, 20999},
                                             {30000, 39999}}};

// Settings whose value is a length.
constexpr std::array<Range, 9> kLengthSettings = {{{22, 22},
                                                   {34, 35},
                                                   {52, 52},
                                                   {79, 79},
                                                   {85, 85},
                                                   {254, 257},
                                                   {268, 270},
                                                   {293, 295},
                                                   {300, 305}}};

// Numbers of #4101-#4126: as the local variables of G65 arguments.
constexpr std::string_view kLocalLetters = "ABCIJKDEF.H.M...QRSTUVWXYZ";

template <std::size_t N>
bool InAny(const std::array<Range, N>& ranges, long number) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [number](const Range& range) { return range.Has(number); });
}

struct OffsetPlace {
  int index = 0;  ///< -1: G52.
  int axis = 0;
};

// #5201-#5206 G52, #5221.. G54 to #5326 G59, #7001.. G154 P1-P20, #14001.. G154 P1-P99; 20 apart.
std::optional<OffsetPlace> FindOffset(long number) {
  const auto in = [number](long first, int count, int first_index) -> std::optional<OffsetPlace> {
    const long at = number - first;
    if (at < 0 || at / 20 >= count || at % 20 >= kNumAxes) return std::nullopt;
    return OffsetPlace{first_index + static_cast<int>(at / 20), static_cast<int>(at % 20)};
  };
  if (const auto place = in(5201, 7, -1)) return place;
  if (const auto place = in(7001, 20, kFirstG154 + 1)) return place;
  return in(14001, 99, kFirstG154 + 1);
}

}  // namespace

double HaasVariables::Out(int axis, double inside) const {
  return axis <= kZ ? inside / settings_->mm_per_unit() : Degrees(inside);
}

double HaasVariables::In(int axis, double outside) const {
  return axis <= kZ ? outside * settings_->mm_per_unit() : Radians(outside);
}

void HaasVariables::Unknown(long number) {
  const std::string name = "#" + std::to_string(number);
  log_->ReportOnce(name, Rule::kUnsupportedCode, where_,
                   name + ", used after this block, holds what a simulation does not know; read 0");
}

bool HaasVariables::ReadToolRegister(long number, nc::MacroValue* value) const {
  if (!kToolRegisters.Has(number)) return false;
  const long at = number - kToolRegisters.first;
  *value = Out(kZ, registers_->Tool(static_cast<ToolRegister>(at / kMaxToolOffset),
                                    static_cast<int>(at % kMaxToolOffset) + 1));
  return true;
}

bool HaasVariables::ReadOffset(long number, nc::MacroValue* value) const {
  const auto place = FindOffset(number);
  if (!place) return false;
  const AxisValues values =
      place->index < 0 ? registers_->g52 : registers_->WorkOffset(place->index);
  *value = Out(place->axis, values[static_cast<std::size_t>(place->axis)]);
  return true;
}

bool HaasVariables::ReadPosition(long number, nc::MacroValue* value) {
  const int axis = static_cast<int>(number % 20) - 1;
  if (number < 5001 || number > 5086 || axis < 0 || axis >= kNumAxes) return false;
  const std::size_t i = static_cast<std::size_t>(axis);
  switch (number / 20) {
    case 250:  // #5001: last target
    case 252:  // #5041: in work coordinates
      *value = Out(axis, interpreter_->program_position()[i]);
      return true;
    case 251:  // #5021: in machine coordinates
      // The manual says that tool length is applied to #5023; not in which sense.
      if (axis == kZ && interpreter_->active_length() != 0.0) Unknown(number);
      *value = Out(axis, interpreter_->MachinePosition(true)[i]);
      return true;
    case 254:  // #5081: tool offset
      *value = axis == kZ ? Out(kZ, interpreter_->active_length()) : 0.0;
      return true;
    default:
      return false;
  }
}

bool HaasVariables::ReadModal(long number, nc::MacroValue* value) const {
  if (number > 4000 && number <= 4021) {
    *value = interpreter_->group_code(static_cast<int>(number - 4000)) / 10.0;
    return true;
  }
  if (number <= 4100 || number > 4126) return false;
  const char letter = kLocalLetters[static_cast<std::size_t>(number - 4101)];
  *value = letter == '.' ? std::nullopt : interpreter_->last_word(letter);
  return true;
}

bool HaasVariables::ReadSetting(long number, nc::MacroValue* value) {
  if (number < 20000 || number > 20999) return false;
  const long setting = number - 20000;
  const std::string name = "setting " + std::to_string(setting);
  if (setting >= 255 && setting <= 257) {
    const auto centre =
        settings_->rotary_centre ? settings_->rotary_centre : machine::RotaryCentre(*machine_);
    if (!centre) return false;
    *value = (*centre)[static_cast<int>(setting - 255)] / settings_->mm_per_unit();
    return true;
  }
  if (setting == 9) {
    *value = settings_->inch ? 0.0 : 1.0;
    return true;
  }
  if (const auto stated = source_->Number(name)) {
    const bool length = InAny(kLengthSettings, setting);
    *value = length ? *stated / settings_->mm_per_unit() : *stated;
    return true;
  }
  if (source_->Text(name) == "on" || source_->Text(name) == "off") {
    *value = *source_->Switch(name) ? 1.0 : 0.0;
    return true;
  }
  return false;
}

bool HaasVariables::Read(long number, nc::MacroValue* value) {
  if (ReadToolRegister(number, value) || ReadOffset(number, value) || ReadPosition(number, value) ||
      ReadModal(number, value) || ReadSetting(number, value)) {
    return true;
  }
  switch (number) {
    case 3001:  // ms
      *value = interpreter_->time() * 1e3;
      return true;
    case 3026:
      *value = interpreter_->tool();
      return true;
    case 3027:
      *value = interpreter_->spindle_rpm();
      return true;
    case 6198:  // Tells this control from its predecessors.
      *value = 1000000.0;
      return true;
    default:
      break;
  }
  if (!InAny(kOutside, number)) return false;
  Unknown(number);
  *value = 0.0;
  return true;
}

bool HaasVariables::Write(long number, nc::MacroValue value) {
  const double given = value.value_or(0.0);
  if (kToolRegisters.Has(number)) {
    const long at = number - kToolRegisters.first;
    registers_->SetTool(static_cast<ToolRegister>(at / kMaxToolOffset),
                        static_cast<int>(at % kMaxToolOffset) + 1, In(kZ, given));
  } else if (const auto place = FindOffset(number)) {
    const double inside = In(place->axis, given);
    if (place->index < 0) {
      registers_->g52[static_cast<std::size_t>(place->axis)] = inside;
    } else {
      registers_->SetWorkOffset(place->index, place->axis, inside);
    }
  } else if (number == 3001 || InAny(kOutside, number)) {
    Unknown(number);
    return true;
  } else {
    return false;
  }
  interpreter_->RegistersChanged();
  return true;
}

void HaasVariables::AssumeUndefined(long number) {
  const std::string name = "variable #" + std::to_string(number);
  log_->Assume(name, "read before the program sets it; taken as undefined", true);
}

}  // namespace ncsim::control
