// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "sim/base/file.h"
#include "sim/base/text.h"
#include "sim/base/toml_reader.h"
#include "sim/base/units.h"
#include "sim/machine/job_reader.h"
#include "sim/machine/load.h"
#include "sim/machine/model_toml.h"
#include "sim/machine/offset_name.h"
#include "sim/machine/settings.h"

namespace ncsim::machine {
namespace {

constexpr std::uint64_t kMaxJobBytes = std::uint64_t{1} << 26;

/// Axis letters of `table` in mm and rad.
std::map<char, double> ReadAxisValues(double unit, TomlTable* table) {
  std::map<char, double> values;
  for (const char letter : kAxisLetters) {
    if (const auto value = table->Number(std::string(1, letter))) {
      values[letter] = IsRotaryLetter(letter) ? Radians(*value) : *value * unit;
    }
  }
  return values;
}

void ReadStart(double unit, TomlTable table, Job* job) {
  job->start = ReadAxisValues(unit, &table);
  job->start_tool = static_cast<int>(table.Integer("tool", 0, 9999).value_or(0));
  table.Finish();
}

void ReadOffset(const JobContext& context, const TomlValue& entry, TomlTable table, Job* job) {
  WorkOffset offset;
  const std::optional<std::string> name = OffsetName(entry.key);
  if (table.value().Find("on") != nullptr) {
    offset.placement = ReadPlacement(context, false, &table);
    for (const char letter : {'A', 'B', 'C'}) {
      if (const auto value = table.Number(std::string(1, letter))) {
        offset.values[letter] = Radians(*value);
      }
    }
  } else {
    offset.values = ReadAxisValues(context.mm_per_unit, &table);
  }
  for (const char* letter : {"X", "Y", "Z"}) {
    const TomlValue* value = table.value().Find(letter);
    if (!offset.placement || value == nullptr) continue;
    table.Get(letter);
    table.ErrorAt(*value, std::string("an offset that is placed on something has no ") + letter +
                              ": ncsim works it out");
  }
  table.Finish();
  if (!name) return;
  offset.name = *name;
  if (!job->offsets.emplace(*name, std::move(offset)).second ||
      job->offsets.contains(TwinOffset(*name))) {
    table.ErrorAt(entry, "work offset " + *name + " is stated twice");
  }
}

void ReadOffsets(const JobContext& context, TomlTable table, Job* job) {
  for (const TomlValue& entry : table.value().children) {
    table.Get(entry.key);
    if (!OffsetName(entry.key)) {
      table.diagnostics()->Error(table.file(), entry.key_line, entry.key_column,
                                 "'" + entry.key +
                                     "' is no work offset: G54-G59, G110-G129, "
                                     "\"G154 P1\"-\"G154 P99\", G500 and G505-G599 are");
    }
    if (auto inner = table.AsTable(entry, entry.key)) {
      ReadOffset(context, entry, std::move(*inner), job);
    }
  }
}

void ReadTools(const JobContext& context, TomlTable* root, Job* job) {
  std::set<int> numbers;
  for (TomlTable& table : root->Tables("tool")) {
    job->has_tools = true;
    const TomlValue& where = table.value();
    std::optional<Tool> tool = ReadTool(context, std::move(table));
    if (!tool) continue;
    if (numbers.insert(tool->number).second) {
      job->tools.push_back(std::move(*tool));
    } else {
      root->ErrorAt(where, "T" + std::to_string(tool->number) + " is stated twice");
    }
  }
  std::sort(job->tools.begin(), job->tools.end(),
            [](const Tool& a, const Tool& b) { return a.number < b.number; });
}

void ReadBodies(const JobContext& context, TomlTable* root, Job* job) {
  std::set<std::string> names = {"part", "stock"};
  for (TomlTable& table : root->Tables("fixture")) {
    const TomlValue& where = table.value();
    std::optional<PlacedBody> body = ReadBody(context, BodyKind::kFixture, std::move(table));
    if (!body) continue;
    if (OffsetName(body->name)) {
      root->ErrorAt(where, "'" + body->name + "' is the name of a work offset, not of a fixture");
    } else if (!names.insert(body->name).second) {
      root->ErrorAt(where, "a second body '" + body->name + "'");
    } else {
      job->bodies.push_back(std::move(*body));
    }
  }
  const auto single = [&](const char* key, BodyKind kind) {
    std::optional<TomlTable> table = root->Table(key);
    if (!table) return;
    if (auto body = ReadBody(context, kind, std::move(*table))) {
      job->bodies.push_back(std::move(*body));
    }
  };
  single("part", BodyKind::kPart);
  single("stock", BodyKind::kStock);
}

void ReadMargin(double unit, TomlTable table, CheckSettings* check) {
  PairMargin margin;
  std::size_t named = 0;
  if (const TomlValue* bodies = table.Require("bodies")) {
    const bool two = bodies->kind == TomlValue::Kind::kArray && bodies->children.size() == 2;
    if (!two) table.ErrorAt(*bodies, "'bodies' must be an array of two names");
    const std::vector<std::string> names =
        two ? table.Strings("bodies") : std::vector<std::string>();
    for (const std::string& name : names) {
      const TomlValue& where = bodies->children[named];
      margin.bodies[named++] = {name, where.line, where.column};
    }
  }
  const auto clearance = table.RequiredNumber("clearance", NumberRule::kNotNegative);
  table.Finish();
  if (named < 2 || !clearance) return;
  margin.clearance = *clearance * unit;
  const std::string& a = margin.bodies[0].name;
  const std::string& b = margin.bodies[1].name;
  const auto same = [&](const PairMargin& other) {
    const std::string& c = other.bodies[0].name;
    const std::string& d = other.bodies[1].name;
    return (a == c && b == d) || (a == d && b == c);
  };
  if (margin.clearance > kGreatestMargin) {
    table.ErrorAt(*table.Get("clearance"), "a clearance of " + Short(margin.clearance) +
                                               " mm is absurd: the greatest is " +
                                               Short(kGreatestMargin) + " mm");
  } else if (a == b) {
    table.ErrorAt(table.value(), "'" + a + "' is no pair with itself");
  } else if (std::any_of(check->margins.begin(), check->margins.end(), same)) {
    table.ErrorAt(table.value(), "a second margin of '" + a + "' and '" + b + "'");
  } else {
    check->margins.push_back(std::move(margin));
  }
}

void ReadCheck(double unit, TomlTable table, CheckSettings* check) {
  const auto length = [&](const char* key, double* target) {
    if (const auto value = table.Number(key, NumberRule::kNotNegative)) *target = *value * unit;
  };
  length("clearance", &check->clearance);
  length("part_tolerance", &check->part_tolerance);
  length("gouge_tolerance", &check->gouge_tolerance);
  const std::vector<std::string> words = {"error", "warning", "off"};
  if (const auto word = table.Word("gouge", words)) {
    const auto at = std::find(words.begin(), words.end(), *word) - words.begin();
    check->gouge = static_cast<GougeMode>(at);
  }
  for (TomlTable& margin : table.Tables("margin")) ReadMargin(unit, std::move(margin), check);
  table.Finish();
}

void ReadControl(const JobContext& context, TomlTable table, Job* job) {
  const auto paths = [&](const char* key, std::vector<std::string>* target) {
    for (const std::string& path : table.Strings(key)) {
      target->push_back((std::filesystem::path(context.folder) / path).lexically_normal().string());
    }
  };
  paths("subprogram_folders", &job->subprogram_folders);
  paths("data_files", &job->data_files);
  job->m_codes_without_motion = table.Integers("m_codes_without_motion", 0, 9999);
  // The job does not know the machine's dialect: a setting of any control that ncsim knows is
  // taken. BuildScene() holds it against the machine.
  for (const std::string& dialect : Dialects()) {
    ReadSettings(dialect, context.mm_per_unit, &table, &job->control);
  }
  table.Finish();
}

}  // namespace

std::optional<Job> LoadJob(const std::string& path, Diagnostics* diagnostics) {
  Job job;
  job.path = path;
  if (path.empty()) return job;
  std::string reason;
  const std::optional<std::string> text = ReadFile(path, kMaxJobBytes, &reason);
  if (!text) {
    diagnostics->Error(path, 0, 0, reason);
    return std::nullopt;
  }
  const std::optional<TomlValue> value = ParseToml(*text, path, diagnostics);
  if (!value) return std::nullopt;
  TomlTable root(*value, path, diagnostics);
  JobContext context;
  context.mm_per_unit = ReadSchemaAndUnits(&root);
  context.folder = std::filesystem::path(path).parent_path().string();
  job.model = root.String("model").value_or("");
  if (auto start = root.Table("start")) ReadStart(context.mm_per_unit, std::move(*start), &job);
  if (auto offsets = root.Table("offsets")) ReadOffsets(context, std::move(*offsets), &job);
  ReadTools(context, &root, &job);
  ReadBodies(context, &root, &job);
  if (auto check = root.Table("check")) {
    ReadCheck(context.mm_per_unit, std::move(*check), &job.check);
  }
  if (auto control = root.Table("control")) ReadControl(context, std::move(*control), &job);
  root.Finish();
  return job;
}

}  // namespace ncsim::machine
