// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/job_reader.h"
#include "sim/machine/tool_library.h"

namespace ncsim::machine {
namespace {

constexpr double kUsualPointAngleDeg = 118.0;
constexpr double kUsualChamferAngleDeg = 45.0;

std::optional<CutterSpec> ReadCutter(double unit, TomlTable table) {
  static const std::vector<std::string> kTypes = {"end",   "ball",  "bull",
                                                  "drill", "taper", "chamfer"};
  CutterSpec cutter;
  std::optional<std::string> type;
  if (table.Require("type") != nullptr) type = table.Word("type", kTypes);
  const auto diameter = table.RequiredNumber("diameter", NumberRule::kPositive);
  const auto flute_length = table.RequiredNumber("flute_length", NumberRule::kPositive);
  if (type) {
    for (std::size_t i = 0; i < kTypes.size(); ++i) {
      if (kTypes[i] == *type) cutter.type = static_cast<CutterType>(i);
    }
  }
  const auto number = [&](const char* key, NumberRule rule, double usual) {
    return table.Number(key, rule).value_or(usual);
  };
  switch (cutter.type) {
    case CutterType::kEnd:
    case CutterType::kBall:
    case CutterType::kBull:
      cutter.corner_radius = number("corner_radius", NumberRule::kNotNegative, 0.0) * unit;
      break;
    case CutterType::kDrill:
      cutter.point_angle =
          Radians(number("point_angle_deg", NumberRule::kPositive, kUsualPointAngleDeg));
      break;
    case CutterType::kTaper:
      cutter.corner_radius = number("corner_radius", NumberRule::kNotNegative, 0.0) * unit;
      cutter.taper_angle =
          Radians(table.RequiredNumber("taper_angle_deg", NumberRule::kPositive).value_or(1.0));
      break;
    case CutterType::kChamfer:
      cutter.taper_angle =
          Radians(number("taper_angle_deg", NumberRule::kPositive, kUsualChamferAngleDeg));
      cutter.tip_diameter = number("tip_diameter", NumberRule::kNotNegative, 0.0) * unit;
      break;
  }
  if (type) table.Finish();
  if (!type || !diameter || !flute_length) return std::nullopt;
  cutter.diameter = *diameter * unit;
  cutter.flute_length = *flute_length * unit;
  if (cutter.type == CutterType::kEnd && cutter.corner_radius > 0.0)
    cutter.type = CutterType::kBull;
  return cutter;
}

/// An array of { lower, upper, height }.
std::vector<Frustum> ReadFrusta(const char* key, double unit, TomlTable* table) {
  std::vector<Frustum> frusta;
  for (TomlTable& element : table->Tables(key)) {
    const auto lower = element.RequiredNumber("lower", NumberRule::kNotNegative);
    const auto upper = element.RequiredNumber("upper", NumberRule::kNotNegative);
    const auto height = element.RequiredNumber("height", NumberRule::kPositive);
    element.Finish();
    if (lower && upper && height) frusta.push_back({*lower * unit, *upper * unit, *height * unit});
  }
  return frusta;
}

/// The holder: a name that ships, or frusta. `assumed` names the one where the job is silent.
std::vector<Frustum> ReadHolder(double unit, TomlTable* table, std::string* assumed) {
  const TomlValue* value = table->Get("holder");
  if (value == nullptr) {
    *assumed = AssumedHolder("");
    return *HolderByName(*assumed);
  }
  if (value->kind != TomlValue::Kind::kString) return ReadFrusta("holder", unit, table);
  if (auto holder = HolderByName(value->text)) return *holder;
  table->ErrorAt(*value, "no holder '" + value->text + "' ships with ncsim" +
                             DidYouMean(value->text, HolderNames()));
  return {};
}

struct Registers {
  std::optional<double> h_geometry, h_wear, d_geometry, d_wear;  // mm
};

Registers ReadRegisters(double unit, TomlTable* table) {
  const auto length = [&](const char* key) -> std::optional<double> {
    const std::optional<double> value = table->Number(key);
    return value ? std::optional<double>(*value * unit) : std::nullopt;
  };
  return {length("h_geometry"), length("h_wear"), length("d_geometry"), length("d_wear")};
}

/// `edges`: what an edge does not state is as `metal` has it.
std::vector<ToolEdge> ReadEdges(double unit, const ToolEdge& metal, TomlTable* table) {
  constexpr int kHighest = 12;  // Edges of a tool, MD18106 at most.
  std::vector<ToolEdge> edges;
  for (TomlTable& element : table->Tables("edges")) {
    ToolEdge edge;
    std::optional<std::int64_t> number;
    if (element.Require("number") != nullptr) number = element.Integer("number", 1, kHighest);
    const auto length = [&](const char* key, double usual) {
      const std::optional<double> value = element.Number(key);
      return value ? *value * unit : usual;
    };
    edge.length = length("length", metal.length);
    edge.length_wear = length("length_wear", 0.0);
    edge.diameter = length("diameter", metal.diameter);
    edge.diameter_wear = length("diameter_wear", 0.0);
    element.Finish();
    if (!number) continue;
    edge.number = static_cast<int>(*number);
    if (std::any_of(edges.begin(), edges.end(),
                    [&](const ToolEdge& other) { return other.number == edge.number; })) {
      element.ErrorAt(element.value(), "edge D" + std::to_string(edge.number) + " is stated twice");
    } else {
      edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const ToolEdge& a, const ToolEdge& b) { return a.number < b.number; });
  return edges;
}

void Append(const std::string& text, std::string* list) {
  *list += (list->empty() ? "" : ", ") + text;
}

}  // namespace

std::optional<Tool> ReadTool(const JobContext& context, TomlTable table) {
  const double unit = context.mm_per_unit;
  const std::size_t before = table.diagnostics()->all().size();
  ToolSpec spec;
  std::optional<std::int64_t> number;
  if (table.Require("number") != nullptr) number = table.Integer("number", 1, 9999);
  spec.number = static_cast<int>(number.value_or(0));
  spec.name = table.String("name").value_or("");
  const auto length = table.RequiredNumber("length", NumberRule::kPositive);
  spec.length = length.value_or(0.0) * unit;
  std::optional<CutterSpec> cutter;
  if (table.Require("cutter") != nullptr) {
    if (auto inner = table.Table("cutter")) cutter = ReadCutter(unit, std::move(*inner));
  }
  spec.shank = ReadFrusta("shank", unit, &table);
  std::string assumed_holder;
  spec.holder = ReadHolder(unit, &table, &assumed_holder);
  const Registers registers = ReadRegisters(unit, &table);
  const ToolEdge metal{1, spec.length, 0.0, cutter ? cutter->diameter : 0.0, 0.0};
  std::vector<ToolEdge> edges = ReadEdges(unit, metal, &table);
  if (!edges.empty() &&
      (registers.h_geometry || registers.h_wear || registers.d_geometry || registers.d_wear)) {
    table.ErrorAt(table.value(), "'edges' are the registers of D1 and on: state one or the other");
  }
  table.Finish();
  const auto& all = table.diagnostics()->all();
  for (std::size_t i = before; i < all.size(); ++i) {
    if (all[i].level == Diagnostic::Level::kError) return std::nullopt;
  }
  if (!cutter || !length || !number) return std::nullopt;
  spec.cutter = *cutter;
  Tool tool;
  std::string wrong = MakeTool(spec, &tool);
  if (!wrong.empty() && !assumed_holder.empty()) {
    wrong += "; the job states no holder, and one like " + assumed_holder + " is assumed";
  }
  if (!wrong.empty()) {
    table.ErrorAt(table.value(), "T" + std::to_string(spec.number) + ": " + wrong);
    return std::nullopt;
  }
  if (!assumed_holder.empty()) Append("holder " + assumed_holder, &tool.assumed);
  tool.assumed_holder = assumed_holder;
  if (table.value().Find("shank") == nullptr && !tool.shank.empty()) {
    Append("shank as wide as the flutes' end, up to the holder", &tool.assumed);
  }
  tool.h_geometry = registers.h_geometry.value_or(tool.h_geometry);
  tool.h_wear = registers.h_wear.value_or(0.0);
  tool.d_geometry = registers.d_geometry.value_or(tool.d_geometry);
  tool.d_wear = registers.d_wear.value_or(0.0);
  tool.edges = std::move(edges);
  return tool;
}

}  // namespace ncsim::machine
