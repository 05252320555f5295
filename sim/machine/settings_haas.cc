// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "sim/machine/settings_tables.h"

namespace ncsim::machine {

std::vector<Setting> HaasSettings() {
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

}  // namespace ncsim::machine
