// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/settings.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/settings_tables.h"

namespace ncsim::machine {
namespace {

std::string Lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::optional<double> ToNumber(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::vector<std::string> Dialects() { return {"haas-ngc", "sinumerik-840d"}; }

const std::vector<Setting>& SettingsOf(std::string_view dialect) {
  static const std::vector<Setting> haas = HaasSettings();
  static const std::vector<Setting> sinumerik = SinumerikSettings();
  static const std::vector<Setting> none;
  if (dialect == "haas-ngc") return haas;
  return dialect == "sinumerik-840d" ? sinumerik : none;
}

LimitAlarms LimitAlarmsOf(std::string_view dialect) {
  if (dialect == "sinumerik-840d") return {"10720", "10620"};
  return {};
}

std::optional<std::string> NormaliseSetting(const Setting& setting, const TomlTable& table,
                                            const TomlValue& value, double mm_per_unit) {
  const bool is_text = value.kind == TomlValue::Kind::kString;
  switch (setting.kind) {
    case SettingKind::kSwitch:
    case SettingKind::kWord: {
      const bool is_switch = setting.kind == SettingKind::kSwitch;
      const std::vector<std::string> on_off = {"on", "off"};
      const std::vector<std::string>& words = is_switch ? on_off : setting.words;
      if (is_switch && value.kind == TomlValue::Kind::kBoolean) return value.boolean ? "on" : "off";
      const auto same = [&](const std::string& word) {
        return is_text && Lower(word) == Lower(value.text);
      };
      const auto found = std::find_if(words.begin(), words.end(), same);
      if (found != words.end()) return *found;
      std::string list;
      for (const std::string& choice : words) list += (list.empty() ? "" : ", ") + choice;
      table.ErrorAt(value, "'" + setting.name + "' must be one of: " + list);
      return std::nullopt;
    }
    case SettingKind::kText:
      if (is_text) return value.text;
      table.ErrorAt(value, "'" + setting.name + "' must be a string");
      return std::nullopt;
    case SettingKind::kWhole:
      if (value.kind == TomlValue::Kind::kInteger && value.integer >= setting.lowest &&
          value.integer <= setting.highest) {
        return std::to_string(value.integer);
      }
      table.ErrorAt(value, "'" + setting.name + "' must be a whole number from " +
                               std::to_string(setting.lowest) + " to " +
                               std::to_string(setting.highest));
      return std::nullopt;
    case SettingKind::kLength:
    case SettingKind::kAngle:
    case SettingKind::kNumber: {
      const std::optional<double> number = table.AsNumber(value, setting.name);
      if (!number) return std::nullopt;
      return Short(setting.kind == SettingKind::kLength ? *number * mm_per_unit : *number, 6);
    }
  }
  return std::nullopt;
}

void ReadSettings(std::string_view dialect, double mm_per_unit, TomlTable* table,
                  std::map<std::string, std::string>* settings) {
  for (const Setting& setting : SettingsOf(dialect)) {
    const TomlValue* value = table->Get(setting.name);
    if (value == nullptr) continue;
    if (auto text = NormaliseSetting(setting, *table, *value, mm_per_unit)) {
      (*settings)[setting.name] = std::move(*text);
    }
  }
}

void ApplySettings(const std::map<std::string, std::string>& settings, ControlData* control) {
  for (const auto& [name, text] : settings) {
    control->settings[name] = text;
    if (name == "tcp_rapid") control->tcp_rapid = text;
    const std::vector<Setting>& known = SettingsOf(control->dialect);
    auto it = known.begin();
    while (it != known.end() && it->name != name) ++it;
    if (it == known.end()) continue;
    const bool numeric = it->kind == SettingKind::kLength || it->kind == SettingKind::kAngle ||
                         it->kind == SettingKind::kNumber || it->kind == SettingKind::kWhole;
    const std::optional<double> number = numeric ? ToNumber(text) : std::nullopt;
    if (!number) continue;
    control->numbers[name] = it->kind == SettingKind::kAngle ? Radians(*number) : *number;
  }
  const std::array<std::string, 3> centre = {"setting 255", "setting 256", "setting 257"};
  for (int i = 0; i < 3; ++i) {
    const auto it = settings.find(centre[static_cast<std::size_t>(i)]);
    if (it == settings.end()) continue;
    if (!control->rotary_centre) control->rotary_centre = Eigen::Vector3d::Zero();
    (*control->rotary_centre)[i] = ToNumber(it->second).value_or(0.0);
  }
}

}  // namespace ncsim::machine
