// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "sim/base/digest.h"
#include "sim/report/json_values.h"

namespace ncsim::nightly {
namespace {

using report::Array;
using report::Json;

constexpr std::array<std::string_view, 4> kKinds = {"content", "place", "listing", "variable"};

Json StoredJson(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

std::optional<double> NumberOf(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

Json StoredJson(const ReportFinding& f) {
  return {{"rule", f.rule},       {"severity", f.severity}, {"file", f.file},    {"line", f.line},
          {"message", f.message}, {"bodies", f.bodies},     {"source", f.source}};
}

ReportFinding FindingOf(const Json& json) {
  ReportFinding finding;
  finding.rule = json.at("rule");
  finding.severity = json.at("severity");
  finding.file = json.at("file");
  finding.line = json.at("line");
  finding.message = json.at("message");
  if (json.contains("bodies")) finding.bodies = json.at("bodies").get<std::vector<std::string>>();
  finding.source = json.value("source", "");
  return finding;
}

Json StoredJson(const ReportClearance& c) {
  return {{"bodies", c.bodies},
          {"proven_mm", StoredJson(c.proven)},
          {"seen_mm", StoredJson(c.seen)},
          {"line", c.line},
          {"file", c.file}};
}

ReportClearance ClearanceOf(const Json& json) {
  ReportClearance clearance;
  clearance.bodies = json.at("bodies").get<std::vector<std::string>>();
  clearance.proven = NumberOf(json.at("proven_mm"));
  clearance.seen = NumberOf(json.at("seen_mm"));
  clearance.line = json.at("line");
  clearance.file = json.at("file");
  return clearance;
}

Json StoredJson(const Report& r) {
  return {{"schema", 1},
          {"program", r.program},
          {"verdict", r.verdict},
          {"model", r.model},
          {"blocks", r.blocks},
          {"motion_time_s", r.time},
          {"findings", Array(r.findings, [](const auto& f) { return StoredJson(f); })},
          {"clearances", Array(r.clearances, [](const auto& c) { return StoredJson(c); })},
          {"not_checked", r.not_checked}};
}

Report ReportOf(const Json& json) {
  Report report;
  if (json.at("schema").get<int>() != 1) throw std::exception();
  report.verdict = json.at("verdict");
  if (report.verdict != "pass" && report.verdict != "fail" && report.verdict != "unproven") {
    throw std::exception();
  }
  report.program = json.at("program");
  report.model = json.at("model");
  report.blocks = json.at("blocks");
  report.time = NumberOf(json.at("motion_time_s")).value_or(std::nan(""));
  for (const Json& item : json.at("findings")) report.findings.push_back(FindingOf(item));
  for (const Json& item : json.at("clearances")) report.clearances.push_back(ClearanceOf(item));
  report.not_checked = json.at("not_checked").get<std::vector<std::string>>();
  return report;
}

Json StoredJson(const std::vector<Input>& inputs) {
  return Array(inputs, [](const Input& input) {
    return Json::array({kKinds.at(static_cast<std::size_t>(input.kind)), input.name, input.state});
  });
}

std::vector<Input> InputsOf(const Json& json) {
  std::vector<Input> inputs;
  for (const Json& item : json) {
    const auto kind = std::find(kKinds.begin(), kKinds.end(), item.at(0).get<std::string>());
    if (kind == kKinds.end()) throw std::exception();
    inputs.push_back({static_cast<Input::Kind>(kind - kKinds.begin()), item.at(1), item.at(2)});
  }
  return inputs;
}

Json StoredJson(const Result& result) {
  return {{"name", result.name},
          {"report", result.report ? StoredJson(*result.report) : Json(nullptr)},
          {"trouble", result.trouble},
          {"bad_input", result.bad_input},
          {"key", result.key},
          {"inputs", StoredJson(result.inputs)}};
}

Result ResultOf(const Json& json) {
  Result result;
  result.name = json.at("name");
  if (!json.at("report").is_null()) result.report = ReportOf(json.at("report"));
  result.trouble = json.at("trouble");
  result.bad_input = json.at("bad_input");
  result.key = json.at("key");
  result.inputs = InputsOf(json.at("inputs"));
  return result;
}

std::string Text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// What `convert` makes of `text`; nullopt where it is not JSON or not what it should be.
template <typename Value>
std::optional<Value> Read(std::string_view text, Value (*convert)(const Json&)) {
  try {
    return convert(Json::parse(text));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

ShardFile ShardOf(const Json& json) {
  ShardFile shard;
  shard.plan = json.at("plan");
  shard.index = json.at("index");
  shard.count = json.at("count");
  for (const Json& item : json.at("results")) shard.results.push_back(ResultOf(item));
  return shard;
}

}  // namespace

bool Result::StillHolds(const std::string& wanted_key, const std::string& root) const {
  if (key != wanted_key || inputs.empty()) return false;
  return std::all_of(inputs.begin(), inputs.end(), [&](const Input& input) {
    const bool path = input.kind != Input::Kind::kVariable;
    // An absolute path stays what it is.
    const std::string now = path ? (std::filesystem::path(root) / input.name).string() : input.name;
    return StateNow(input.kind, now) == input.state;
  });
}

std::string PageName(const Result& result) {
  std::string name;
  for (const char c : result.name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += plain || c == '.' || c == '-' ? c : '_';
  }
  constexpr std::size_t kLongest = 100;  // Of a file's name 255 bytes are allowed.
  const std::string all = result.name + '\n' + result.key + '\n' + WriteInputs(result.inputs);
  return name.substr(0, kLongest) + "-" + ToString(DigestOf(all)) + ".html";
}

std::optional<Report> ReadReport(std::string_view json) { return Read(json, ReportOf); }

std::string WriteInputs(const std::vector<Input>& inputs) { return Text(StoredJson(inputs)); }

std::optional<std::vector<Input>> ReadInputs(std::string_view json) { return Read(json, InputsOf); }

std::string WriteResult(const Result& result) { return Text(StoredJson(result)); }

std::optional<Result> ReadResult(std::string_view json) { return Read(json, ResultOf); }

std::string WriteShard(const ShardFile& shard) {
  return Text({{"schema", 1},
               {"plan", shard.plan},
               {"index", shard.index},
               {"count", shard.count},
               {"results", Array(shard.results, [](const auto& r) { return StoredJson(r); })}});
}

std::optional<ShardFile> ReadShard(std::string_view json) { return Read(json, ShardOf); }

}  // namespace ncsim::nightly
