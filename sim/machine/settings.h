// SPDX-License-Identifier: BSD-3-Clause
// The settings of a control, by the control's own names: which there are, and what values they
// take.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/toml_reader.h"
#include "sim/machine/machine.h"

namespace ncsim::machine {

enum class SettingKind { kWord, kSwitch, kLength, kAngle, kNumber, kWhole, kText };

struct Setting {
  std::string name;  ///< "setting 335", "MD20150[7]": as the control's people write it.
  SettingKind kind = SettingKind::kNumber;
  std::vector<std::string> words = {};   ///< kWord: all that it takes.
  std::int64_t lowest = 0, highest = 0;  ///< kWhole.
};

/// Dialects whose settings are known: "haas-ngc", "sinumerik-840d".
std::vector<std::string> Dialects();

/// All settings of a dialect, and the switches of the operator's panel; empty for an unknown
/// dialect.
const std::vector<Setting>& SettingsOf(std::string_view dialect);

/// The numbers of a control's alarms at a software limit: of a block that ends behind it, and of
/// one that reaches it on its way; "" where the control has none.
struct LimitAlarms {
  std::string_view end, way;
};
LimitAlarms LimitAlarmsOf(std::string_view dialect);

/// The value of one setting as text: words and switches ("on", "off") as the table spells them,
/// whatever their case; lengths in mm, angles in degrees, numbers with at most six decimals.
/// nullopt (reported) when the value makes no sense. `mm_per_unit` scales lengths.
std::optional<std::string> NormaliseSetting(const Setting& setting, const TomlTable& table,
                                            const TomlValue& value, double mm_per_unit);

/// Reads every key of `table` that is a setting of `dialect` into `settings` (and asks for it).
void ReadSettings(std::string_view dialect, double mm_per_unit, TomlTable* table,
                  std::map<std::string, std::string>* settings);

/// Puts `settings` over those of `control`: text, numbers (mm, rad), tcp_rapid and the rotary
/// centre.
void ApplySettings(const std::map<std::string, std::string>& settings, ControlData* control);

}  // namespace ncsim::machine
