// SPDX-License-Identifier: BSD-3-Clause
// A night for other programs: JSON and JUnit.
#include <algorithm>
#include <cmath>
#include <map>

#include "sim/nightly/night.h"
#include "sim/report/json_values.h"
#include "sim/report/junit.h"
#include "sim/report/printable.h"
#include "sim/report/result.h"

namespace ncsim::nightly {
namespace {

using report::Array;
using report::Json;

Json ToJson(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

Json ToJson(const ReportFinding& finding) {
  return {{"rule", finding.rule},       {"severity", finding.severity}, {"file", finding.file},
          {"line", finding.line},       {"message", finding.message},   {"bodies", finding.bodies},
          {"line_text", finding.source}};
}

Json ToJson(const JudgedFinding& judged) {
  Json json = ToJson(judged.finding);
  json["new"] = judged.is_new;
  json["accepted"] = nullptr;
  if (judged.accepted != nullptr) {
    json["accepted"] = {{"reason", judged.accepted->reason}, {"expires", judged.accepted->expires}};
  }
  return json;
}

Json ToJson(const Fall& fall) {
  return {{"bodies", fall.bodies},
          {"from_mm", fall.from},
          {"to_mm", fall.to},
          {"file", fall.file},
          {"line", fall.line}};
}

Json ToJson(const ReportClearance* clearance) {
  if (clearance == nullptr) return nullptr;
  return {{"bodies", clearance->bodies},
          {"proven_mm", ToJson(clearance->proven)},
          {"seen_mm", ToJson(clearance->seen)},
          {"file", clearance->file},
          {"line", clearance->line}};
}

Json ToJson(const Row& row) {
  Json json;
  json["name"] = row.name;
  json["verdict"] = row.verdict;
  json["before"] = row.before.empty() ? Json(nullptr) : Json(row.before);
  json["new"] = row.is_new;
  json["page"] = row.page.empty() ? Json(nullptr) : Json(row.page);
  json["trouble"] = row.trouble.empty() ? Json(nullptr) : Json(row.trouble);
  json["model"] = row.report ? Json(row.report->model) : Json(nullptr);
  json["blocks"] = row.report ? Json(row.report->blocks) : Json(nullptr);
  json["motion_time_s"] =
      row.report && std::isfinite(row.report->time) ? Json(row.report->time) : Json(nullptr);
  json["not_checked"] = row.report ? Json(row.report->not_checked) : Json::array();
  json["least_clearance"] = ToJson(row.least());
  const auto convert = [](const auto& item) { return ToJson(item); };
  json["findings"] = Array(row.findings, convert);
  json["fixed"] = Array(row.fixed, convert);
  json["closer"] = Array(row.falls, convert);
  return json;
}

Json ToJson(const AcceptanceState& state) {
  const Acceptance& acceptance = state.acceptance;
  return {{"program", acceptance.program},
          {"rule", acceptance.rule},
          {"line_text", acceptance.source},
          {"message", acceptance.message},
          {"reason", acceptance.reason},
          {"expires", acceptance.expires},
          {"matches", state.matches},
          {"fault", state.fault.empty() ? Json(nullptr) : Json(state.fault)}};
}

/// The findings that stop a program, a problem a rule, in order of the rules' first ones.
std::vector<report::JunitProblem> Problems(const Row& row) {
  std::vector<report::JunitProblem> problems;
  std::map<std::string, std::size_t> place, count;
  for (const JudgedFinding& judged : row.findings) {
    const ReportFinding& finding = judged.finding;
    if (!judged.counts() || finding.severity == "warning") continue;
    const auto [at, is_new] = place.emplace(finding.rule, problems.size());
    if (is_new) problems.push_back({false, finding.rule, InALine(finding), {}});
    report::JunitProblem& problem = problems[at->second];
    problem.failure = problem.failure || finding.severity == "error";
    if (count[finding.rule]++ < static_cast<std::size_t>(report::kMaxFindingsOfRule)) {
      problem.lines.push_back(InALine(finding));
    }
  }
  for (report::JunitProblem& problem : problems) {
    const std::size_t more = count[problem.type] - problem.lines.size();
    if (more > 0) problem.lines.push_back("... and " + std::to_string(more) + " more");
  }
  if (!row.report) {
    const std::vector<std::string> lines = report::PrintableLines(row.trouble);
    problems.push_back({false, row.verdict, lines.empty() ? "" : lines.front(), lines});
  } else if (problems.empty() && row.verdict != "pass") {
    problems.push_back({false, row.verdict, row.verdict, {}});
  }
  return problems;
}

}  // namespace

void WriteNightJson(const Night& night, std::ostream& out) {
  const auto convert = [](const auto& item) { return ToJson(item); };
  Json json;
  json["schema"] = 1;
  json["night"] = night.day;
  json["before"] = night.before.empty() ? Json(nullptr) : Json(night.before);
  json["programs"] = Array(night.rows, convert);
  json["gone"] = night.gone;
  json["baseline"] = Array(night.baseline, convert);
  json["notes"] = night.notes;
  out << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

void WriteNightJunit(const Night& night, std::ostream& out) {
  std::vector<report::JunitCase> cases;
  for (const Row& row : night.rows) {
    report::JunitCase test{row.report ? row.report->model : "ncsim", row.name, Problems(row), {}};
    test.output.push_back(row.verdict + (News(row).empty() ? "" : ": " + News(row)));
    for (const Fall& fall : row.falls) test.output.push_back(InALine(fall));
    for (const AcceptanceState& state : night.baseline) {
      if (state.acceptance.program == row.name) test.output.push_back(InALine(state));
    }
    cases.push_back(std::move(test));
  }
  report::WriteJunitCases("ncsim nightly", cases, out);
}

}  // namespace ncsim::nightly
