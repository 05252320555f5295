// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/settings.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::machine {
namespace {

/// The settings of Haas NGC that the simulator knows (NGC Mill Operator's Manual 2017, "Settings").
std::vector<Setting> MakeHaasSettings() {
  std::vector<Setting> settings;
  const auto add = [&](SettingKind kind, const std::vector<int>& numbers) {
    for (const int number : numbers) {
      settings.push_back({"setting " + std::to_string(number), kind, {}});
    }
  };
  const auto words = [&](int number, std::vector<std::string> values) {
    settings.push_back(
        {"setting " + std::to_string(number), SettingKind::kWord, std::move(values)});
  };
  add(SettingKind::kSwitch,
      {15, 28, 29, 36, 42, 45, 46, 47, 48, 56, 57, 73, 80, 108, 118, 133, 162, 247, 250});
  add(SettingKind::kLength, {22,  34,  35,  52,  79,  85,  254, 255, 256, 257, 268,
                             269, 270, 293, 294, 295, 300, 301, 302, 303, 304, 305});
  add(SettingKind::kAngle, {72, 271, 272, 273, 296, 297, 298});
  add(SettingKind::kNumber, {44, 71, 130, 188, 189, 190});
  add(SettingKind::kText, {251, 252});
  words(9, {"inch", "mm"});
  words(27, {"x+", "x-", "y+", "y-"});
  words(33, {"fanuc", "haas"});
  words(40, {"radius", "diameter"});
  words(43, {"a", "b"});
  words(58, {"fanuc", "yasnac"});
  words(77, {"default", "integer"});
  words(191, {"rough", "medium", "finish"});
  words(335, {"none", "linear", "linear+rotary"});
  settings.push_back({"block_skip", SettingKind::kSwitch, {}});
  settings.push_back({"optional_stop", SettingKind::kSwitch, {}});
  settings.push_back({"software_version", SettingKind::kText, {}});
  settings.push_back({"tcp_rapid", SettingKind::kWord, {"hold", "track"}});
  return settings;
}

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

std::vector<std::string> Dialects() { return {"haas-ngc"}; }

const std::vector<Setting>& SettingsOf(std::string_view dialect) {
  static const std::vector<Setting> haas = MakeHaasSettings();
  static const std::vector<Setting> none;
  return dialect == "haas-ngc" ? haas : none;
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
      const std::string word = is_text ? Lower(value.text) : "";
      if (std::find(words.begin(), words.end(), word) != words.end()) return word;
      std::string list;
      for (const std::string& choice : words) list += (list.empty() ? "" : ", ") + choice;
      table.ErrorAt(value, "'" + setting.name + "' must be one of: " + list);
      return std::nullopt;
    }
    case SettingKind::kText:
      if (is_text) return value.text;
      table.ErrorAt(value, "'" + setting.name + "' must be a string");
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
                         it->kind == SettingKind::kNumber;
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
