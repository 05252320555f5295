// SPDX-License-Identifier: BSD-3-Clause
// The TOML beside a URDF: what the control knows of the machine. docs/model-format.md lists every
// key.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "sim/base/diagnostics.h"
#include "sim/base/toml_reader.h"
#include "sim/machine/machine.h"

namespace ncsim::machine {

struct ModelToml {
  /// An axis as stated; what is not stated is left to the URDF.
  struct AxisData {
    std::string joint;
    std::optional<double> rapid;         ///< mm/s or rad/s.
    std::optional<double> acceleration;  ///< mm/s^2 or rad/s^2.
    double home = 0.0;                   ///< mm or rad.
    int line = 0, column = 0;
  };
  std::string file;
  std::string name;
  bool nominal_shapes = true;
  struct Frame {
    std::string link;
    int line = 0, column = 0;  ///< 0 where the file is silent.
  };
  Frame spindle{"spindle_gauge"};
  Frame table{"workpiece_mount"};
  std::map<char, AxisData> axes;  ///< Empty where the file has no [axes].
  ControlData control;            ///< rotary_centre is left out; settings are not applied yet.
  std::map<std::string, std::string> settings;
  int tool_change_line = 0, tool_change_column = 0;
};

/// Reads the file; nullopt (reported) when it is not TOML. Errors inside are reported and the rest
/// is read.
std::optional<ModelToml> ReadModelToml(const std::string& path, Diagnostics* diagnostics);

/// The axis letters of ncsim, in their order.
inline constexpr std::string_view kAxisLetters = "XYZABC";
inline bool IsRotaryLetter(char letter) { return letter >= 'A' && letter <= 'C'; }

/// Reads the keys `schema` (1) and `units` that every file of ours states; mm per unit, 1 where it
/// is wrong (reported).
double ReadSchemaAndUnits(TomlTable* table);

}  // namespace ncsim::machine
