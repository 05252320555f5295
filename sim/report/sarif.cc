// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "sim/base/digest.h"
#include "sim/report/batch.h"
#include "sim/report/json_values.h"
#include "sim/report/printable.h"

namespace ncsim::report {
namespace {

/// Of a program that no rule has looked at.
constexpr std::string_view kNotChecked = "not-checked";

/// A path as a URI reference (RFC 3986): what is no path character is escaped.
std::string Uri(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/!$&'()*+,;=@";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte < 128 && (std::isalnum(byte) != 0 || kPlain.find(c) != kPlain.npos);
    if (plain) {
      uri += c;
    } else {
      uri += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return uri;
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == text.npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// Columns count bytes here, and UTF-16 code units in the log.
int Utf16Column(std::string_view line, int column) {
  int units = 1;
  for (const char c : line.substr(0, static_cast<std::size_t>(column - 1))) {
    const auto byte = static_cast<unsigned char>(c);
    units += byte >= 0xF0 ? 2 : byte < 0x80 || byte >= 0xC0 ? 1 : 0;
  }
  return units;
}

Json Location(const SourcePosition& where, const ProgramReport& program) {
  const SourceFiles& files = *program.files;
  Json physical = {{"artifactLocation", {{"uri", Uri(files.name(where.file))}}}};
  if (where.line > 0) {
    Json& region = physical["region"] = {{"startLine", where.line}};
    if (where.column > 0 && program.line_text) {
      region["startColumn"] = Utf16Column(program.line_text(where.file, where.line), where.column);
    }
  }
  return {{"physicalLocation", physical}};
}

Json Properties(const Finding& finding) {
  Json properties = {{"severity", ToString(finding.severity)}};
  AddDetails(finding, &properties);
  return properties;
}

/// Of a program that could not be checked.
std::string Why(const ProgramReport& program) {
  std::string text;
  for (const std::string& line : PrintableLines(program.messages)) {
    text += (text.empty() ? "" : "\n") + line;
  }
  return text.empty() ? "the program could not be checked" : text;
}

/// A run's results, within the limit.
class Results {
 public:
  explicit Results(const std::vector<ProgramReport>& programs) {
    std::map<std::pair<std::size_t, Rule>, std::size_t> counts;
    for (std::size_t i = 0; i < programs.size(); ++i) {
      if (programs[i].result == nullptr) continue;
      for (const Finding& finding : programs[i].result->findings) ++counts[{i, finding.rule}];
    }
    SetShare(counts);
    for (std::size_t i = 0; i < programs.size(); ++i) Add(i, programs[i]);
    for (const auto& [group, number] : left_out_) AddRest(programs, group, number);
  }
  Json Take() { return std::move(results_); }

 private:
  /// Program (kAll where there are too many groups) and rule.
  using Group = std::pair<std::size_t, Rule>;
  static constexpr std::size_t kAll = static_cast<std::size_t>(-1);

  Group GroupOf(std::size_t program, Rule rule) const {
    return {by_rule_alone_ ? kAll : program, rule};
  }

  /// The most that each group may have, so that all together, and a last one of each, are within
  /// the limit.
  void SetShare(const std::map<Group, std::size_t>& counts) {
    by_rule_alone_ = 2 * counts.size() > kMaxSarifResults;
    std::map<Group, std::size_t> sizes;
    for (const auto& [group, count] : counts) sizes[GroupOf(group.first, group.second)] += count;
    std::size_t low = 1, high = kMaxSarifResults;
    while (low < high) {
      const std::size_t share = (low + high + 1) / 2;
      std::size_t sum = 0;
      for (const auto& [group, size] : sizes) sum += size > share ? share + 1 : size;
      (sum <= kMaxSarifResults ? low : high) = sum <= kMaxSarifResults ? share : share - 1;
    }
    share_ = low;
  }

  void Add(std::size_t index, const ProgramReport& program) {
    if (program.result == nullptr) {
      results_.push_back(
          {{"ruleId", kNotChecked},
           {"level", "error"},
           {"message", {{"text", Why(program)}}},
           {"locations",
            {{{"physicalLocation", {{"artifactLocation", {{"uri", Uri(program.program)}}}}}}}}});
      return;
    }
    std::map<std::string, int> seen;  // Of one text in one program.
    for (const Finding& finding : program.result->findings) {
      const Group group = GroupOf(index, finding.rule);
      if (++taken_[group] > share_) {
        ++left_out_[group];
        continue;
      }
      results_.push_back(ToJson(finding, program, &seen));
    }
  }

  static Json ToJson(const Finding& finding, const ProgramReport& program,
                     std::map<std::string, int>* seen) {
    const SourceFiles& files = *program.files;
    Json json = {{"ruleId", Info(finding.rule).id},
                 {"level", Stops(finding) ? "error" : "warning"},
                 {"message", {{"text", Printable(finding.message)}}},
                 {"locations", {Location(finding.where, program)}}};
    if (finding.posted_from) {
      Json from = Location(*finding.posted_from, program);
      from["message"] = {{"text", "posted from here"}};
      json["relatedLocations"] = Json::array({std::move(from)});
    }
    std::string key = std::string(Info(finding.rule).id) + '\n' + files.name(finding.where.file);
    if (program.line_text && finding.where.line > 0) {
      key += '\n';
      key += Trimmed(program.line_text(finding.where.file, finding.where.line));
    }
    for (const std::string& body : finding.bodies) key += '\n' + body;
    key += '\n' + std::to_string((*seen)[key]++);
    json["partialFingerprints"] = {{"ncsimFinding/v1", ToString(DigestOf(key))}};
    json["properties"] = Properties(finding);
    return json;
  }

  void AddRest(const std::vector<ProgramReport>& programs, const Group& group, std::size_t number) {
    const RuleInfo& info = Info(group.second);
    Json json = {{"ruleId", info.id},
                 {"level", info.severity == Severity::kWarning ? "warning" : "error"},
                 {"message",
                  {{"text", Count(number, "more finding") + " of " + std::string(info.id) +
                                ": ncsim check lists them"}}}};
    if (group.first != kAll) {
      json["locations"] = {
          {{"physicalLocation",
            {{"artifactLocation", {{"uri", Uri(programs[group.first].program)}}}}}}};
    }
    results_.push_back(std::move(json));
  }

  bool by_rule_alone_ = false;
  std::size_t share_ = kMaxSarifResults;
  std::map<Group, std::size_t> taken_, left_out_;
  Json results_ = Json::array();
};

Json RuleList() {
  Json rules = Json::array();
  for (const RuleInfo& info : Rules()) {
    rules.push_back({{"id", info.id},
                     {"shortDescription", {{"text", info.summary}}},
                     {"help", {{"text", "ncsim explain " + std::string(info.id)}}},
                     {"defaultConfiguration",
                      {{"level", info.severity == Severity::kWarning ? "warning" : "error"}}}});
  }
  rules.push_back({{"id", kNotChecked},
                   {"shortDescription", {{"text", "the program could not be checked"}}},
                   {"defaultConfiguration", {{"level", "error"}}}});
  return rules;
}

}  // namespace

void WriteSarif(const std::vector<ProgramReport>& programs, std::string_view version,
                std::ostream& out) {
  const bool all = std::all_of(programs.begin(), programs.end(),
                               [](const ProgramReport& p) { return p.result != nullptr; });
  Json run = {
      {"tool",
       {{"driver", {{"name", "ncsim"}, {"semanticVersion", version}, {"rules", RuleList()}}}}},
      {"invocations", {{{"executionSuccessful", all}}}},
      {"columnKind", "utf16CodeUnits"},
      {"results", Results(programs).Take()}};
  const Json log = {{"version", "2.1.0"}, {"runs", {run}}};
  out << log.dump(1, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace ncsim::report
