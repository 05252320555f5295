// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/model_toml.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "sim/base/file.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/settings.h"

namespace ncsim::machine {
namespace {

constexpr std::uint64_t kMaxTomlBytes = std::uint64_t{1} << 24;

void ReadAxis(char letter, double unit, TomlTable table, ModelToml* model) {
  ModelToml::AxisData axis;
  axis.line = table.value().line;
  axis.column = table.value().column;
  axis.joint = table.String("joint").value_or(std::string(1, letter));
  if (IsRotaryLetter(letter)) {
    if (const auto v = table.Number("rapid_deg_per_s", NumberRule::kPositive)) {
      axis.rapid = Radians(*v);
    }
    if (const auto v = table.Number("acceleration_deg_per_s2", NumberRule::kPositive)) {
      axis.acceleration = Radians(*v);
    }
    axis.home = Radians(table.Number("home").value_or(0.0));
  } else {
    if (const auto v = table.Number("rapid_m_per_min", NumberRule::kPositive)) {
      axis.rapid = *v * kMmPerMetre / 60.0;
    }
    axis.acceleration = table.Number("acceleration_mm_per_s2", NumberRule::kPositive);
    axis.home = table.Number("home").value_or(0.0) * unit;
  }
  table.Finish();
  model->axes[letter] = std::move(axis);
}

void ReadFrames(TomlTable frames, ModelToml* model) {
  const auto read = [&](const char* key, ModelToml::Frame* frame) {
    std::optional<std::string> link = frames.String(key);
    if (!link) return;
    const TomlValue& value = *frames.Get(key);
    *frame = {std::move(*link), value.line, value.column};
  };
  read("spindle", &model->spindle);
  read("table", &model->table);
  frames.Finish();
}

void ReadSpindle(TomlTable spindle, ControlData* control) {
  control->max_spindle_rpm = spindle.Number("max_rpm", NumberRule::kPositive).value_or(0.0);
  control->spindle_interface = spindle.String("interface").value_or("");
  spindle.Finish();
}

/// The steps of a tool change's approach: letters, each once.
std::vector<std::string> ReadOrder(TomlTable* table) {
  std::vector<std::string> order = table->Strings("order");
  std::string seen;
  for (const std::string& step : order) {
    for (const char letter : step) {
      if (kAxisLetters.find(letter) == kAxisLetters.npos || seen.find(letter) != seen.npos) {
        table->ErrorAt(*table->Get("order"), "'order' must name axes, each once: \"" + step + "\"");
        return {"Z", "XY"};
      }
      seen += letter;
    }
  }
  return order.empty() ? std::vector<std::string>{"Z", "XY"} : order;
}

void ReadToolChange(double unit, TomlTable table, ControlData* control) {
  for (const char letter : kAxisLetters) {
    if (const auto v = table.Number(std::string(1, letter))) {
      control->tool_change_pose[letter] = IsRotaryLetter(letter) ? Radians(*v) : *v * unit;
    }
  }
  control->tool_change_order = ReadOrder(&table);
  control->tool_change_nominal =
      table.Word("pose", {"nominal", "measured"}).value_or("nominal") == "nominal";
  control->tool_pockets = static_cast<int>(table.Integer("pockets", 1, 9999).value_or(0));
  control->max_tool_length =
      unit * table.Number("max_tool_length", NumberRule::kPositive).value_or(0.0);
  control->max_tool_diameter =
      unit * table.Number("max_tool_diameter", NumberRule::kPositive).value_or(0.0);
  table.Finish();
}

void ReadControl(double unit, TomlTable table, ModelToml* model) {
  ControlData& control = model->control;
  const std::vector<std::string> dialects = Dialects();
  if (table.Require("dialect") != nullptr) {
    control.dialect = table.Word("dialect", dialects).value_or("");
  }
  const std::filesystem::path folder = std::filesystem::path(model->file).parent_path();
  for (const std::string& subprograms : table.Strings("subprogram_folders")) {
    control.subprogram_folders.push_back((folder / subprograms).lexically_normal().string());
  }
  control.m_codes_without_motion = table.Integers("m_codes_without_motion", 0, 9999);
  control.nominal_settings = table.Strings("nominal_settings");
  if (std::optional<TomlTable> settings = table.Table("settings")) {
    if (!control.dialect.empty()) {
      ReadSettings(control.dialect, unit, &*settings, &model->settings);
      settings->Finish();
    }
  }
  for (const std::string& name : control.nominal_settings) {
    if (model->settings.contains(name)) continue;
    std::vector<std::string> stated;
    for (const auto& [known, value] : model->settings) stated.push_back(known);
    table.ErrorAt(*table.Get("nominal_settings"),
                  "'" + name + "' is not stated in [control.settings]" + DidYouMean(name, stated));
  }
  table.Finish();
}

}  // namespace

double ReadSchemaAndUnits(TomlTable* table) {
  if (const TomlValue* schema = table->Require("schema")) {
    const bool known = schema->kind == TomlValue::Kind::kInteger && schema->integer == 1;
    if (!known) table->ErrorAt(*schema, "this ncsim reads schema 1 of this file");
  }
  std::optional<std::string> units;
  if (table->Require("units") != nullptr) units = table->Word("units", {"mm", "inch"});
  return units == "inch" ? kMmPerInch : 1.0;
}

std::optional<ModelToml> ReadModelToml(const std::string& path, Diagnostics* diagnostics) {
  std::string reason;
  const std::optional<std::string> text = ReadFile(path, kMaxTomlBytes, &reason);
  if (!text) {
    diagnostics->Error(path, 0, 0, reason);
    return std::nullopt;
  }
  const std::optional<TomlValue> value = ParseToml(*text, path, diagnostics);
  if (!value) return std::nullopt;
  TomlTable root(*value, path, diagnostics);
  ModelToml model;
  model.file = path;
  const double unit = ReadSchemaAndUnits(&root);
  model.name = root.String("name").value_or("");
  model.nominal_shapes =
      root.Word("shapes", {"nominal", "measured"}).value_or("nominal") == "nominal";
  if (auto frames = root.Table("frames")) ReadFrames(std::move(*frames), &model);
  if (auto axes = root.Table("axes")) {
    for (const char letter : kAxisLetters) {
      if (auto axis = axes->Table(std::string(1, letter))) {
        ReadAxis(letter, unit, std::move(*axis), &model);
      }
    }
    axes->Finish();
  }
  if (auto spindle = root.Table("spindle")) ReadSpindle(std::move(*spindle), &model.control);
  if (auto change = root.Table("tool_change")) {
    model.tool_change_line = change->value().line;
    model.tool_change_column = change->value().column;
    ReadToolChange(unit, std::move(*change), &model.control);
  }
  if (auto control = root.Table("control")) {
    ReadControl(unit, std::move(*control), &model);
  } else {
    diagnostics->Warning(path, 0, 0, "no [control]: the model does not say which control it has");
  }
  root.Finish();
  return model;
}

}  // namespace ncsim::machine
