// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "sim/base/units.h"
#include "sim/report/compare_result.h"
#include "sim/report/json_values.h"
#include "sim/report/result.h"

namespace ncsim::report {
namespace {

/// A proven clearance is rounded down: it must stay true.
Json RoundedDown(double value_mm) {
  if (!std::isfinite(value_mm)) return nullptr;
  return std::floor(value_mm * 100.0 + 1e-9) / 100.0 + 0.0;
}

Json Place(const SourcePosition& where, const SourceFiles& files) {
  return {{"file", files.name(where.file)}, {"line", where.line}};
}

Json ToJson(const Finding& finding, const SourceFiles& files) {
  Json json;
  json["rule"] = Info(finding.rule).id;
  json["severity"] = ToString(finding.severity);
  json["file"] = files.name(finding.where.file);
  json["line"] = finding.where.line;
  json["column"] = finding.where.column;
  json["message"] = finding.message;
  if (finding.other) json["other"] = Place(*finding.other, files);
  if (finding.posted_from) json["posted_from"] = Place(*finding.posted_from, files);
  AddDetails(finding, &json);
  return json;
}

Json ToJson(const collision::PairClearance& clearance, const SourceFiles& files) {
  return {{"bodies", clearance.bodies},
          {"proven_mm", RoundedDown(clearance.proven_mm)},
          {"seen_mm", Number(clearance.seen_mm, 2)},
          {"line", clearance.where.line},
          {"file", files.name(clearance.where.file)},
          {"widened_mm", Number(clearance.widened_mm, 2)}};
}

Json ToJson(const collision::DeepestCut& cut, const SourceFiles& files) {
  return {{"tool", cut.tool},
          {"depth_mm", Number(cut.depth_mm, 3)},
          {"line", cut.where.line},
          {"file", files.name(cut.where.file)}};
}

Json ToJson(const Assumption& assumption) {
  return {{"name", assumption.name},
          {"text", assumption.text},
          {"places_metal", assumption.places_metal},
          {"accepted", assumption.accepted}};
}

/// A proven bound is rounded up; null for what is not a finite number.
Json RoundedUp(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::ceil(value * 1e4 - 1e-6) / 1e4 + 0.0;
}

Json ToJson(const compare::Largest& largest, double value, const SourceFiles& files) {
  return {{"value", RoundedUp(value)},
          {"tested", Place(largest.tested, files)},
          {"reference", Place(largest.reference, files)}};
}

Json ToJson(const ComparedProgram& program) {
  return {
      {"program", program.program},
      {"model", program.model.empty() ? Json(nullptr) : Json(program.model)},
      {"job", program.job.empty() ? Json(nullptr) : Json(program.job)},
      {"frame", program.frame.empty() ? Json(nullptr) : Json(program.frame)},
      {"blocks", program.blocks},
      {"assumptions", Array(program.assumptions, [](const Assumption& a) { return ToJson(a); })}};
}

void Write(const Json& json, std::ostream& out) {
  // Bytes that are not UTF-8 (names of files, comments in messages) become U+FFFD.
  out << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace

void WriteJson(const CompareResult& result, const SourceFiles& files, std::ostream& out) {
  const compare::Comparison& comparison = result.comparison;
  Json json;
  json["schema"] = 1;
  json["verdict"] = ToString(result.verdict);
  json["reference"] = ToJson(result.reference);
  json["tested"] = ToJson(result.tested);
  json["findings"] =
      Array(result.findings, [&](const Finding& finding) { return ToJson(finding, files); });
  json["tolerance_mm"] = Number(result.tolerances.position, 6);
  json["angle_tolerance_deg"] = Number(Degrees(result.tolerances.angle), 6);
  json["largest_mm"] = ToJson(comparison.position, comparison.position.value, files);
  json["largest_deg"] = ToJson(comparison.angle, Degrees(comparison.angle.value), files);
  json["runs"] = comparison.runs;
  json["feed_length_mm"] = Number(comparison.feed_length, 3);
  json["added"] = Array(comparison.added, [&](const compare::Added& added) {
    Json item = Place(added.where, files);
    item["text"] = added.text;
    return item;
  });
  Write(json, out);
}

void WriteJson(const CheckResult& result, const SourceFiles& files, std::ostream& out) {
  const auto located = [&](const auto& item) { return ToJson(item, files); };
  Json json;
  json["schema"] = 1;
  json["verdict"] = ToString(result.verdict);
  json["program"] = result.program;
  json["model"] = result.model;
  json["blocks"] = result.blocks;
  json["motion_time_s"] = Number(result.motion_time, 1);
  json["findings"] = Array(result.findings, located);
  json["clearances"] = Array(result.clearances, located);
  json["assumptions"] = Array(result.assumptions, [](const Assumption& a) { return ToJson(a); });
  json["not_checked"] = result.not_checked;
  json["cuts"] = Array(result.cuts, located);
  json["job"] = result.job.empty() ? Json(nullptr) : Json(result.job);
  json["motion_time_model"] = MotionTimeModel();
  json["orientation_tolerance_deg"] = Number(Degrees(result.orientation_tolerance), 4);
  Write(json, out);
}

}  // namespace ncsim::report
