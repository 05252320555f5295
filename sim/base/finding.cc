// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/finding.h"

#include <algorithm>

#include "sim/base/text.h"

namespace ncsim {

std::string_view ToString(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kUnproven:
      return "unproven";
    case Severity::kWarning:
      return "warning";
  }
  return "";
}

std::string_view ToString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kFail:
      return "fail";
    case Verdict::kUnproven:
      return "unproven";
  }
  return "";
}

const std::vector<RuleInfo>& Rules() {
  static const std::vector<RuleInfo> rules = {
#define NCSIM_RULE(name, id, severity, summary) {Rule::name, id, Severity::severity, summary},
#include "sim/base/rules.def"
#undef NCSIM_RULE
  };
  return rules;
}

const RuleInfo& Info(Rule rule) { return Rules().at(static_cast<std::size_t>(rule)); }

std::optional<Rule> RuleFromId(std::string_view id) {
  for (const RuleInfo& info : Rules()) {
    if (info.id == id) return info.rule;
  }
  return std::nullopt;
}

int SourceFiles::Add(std::string name) {
  names_.push_back(std::move(name));
  return static_cast<int>(names_.size()) - 1;
}

std::string ToString(const AxisReadout& axes) {
  std::string text;
  for (const auto& [letter, value] : axes) {
    text.append(text.empty() ? "" : " ").append(1, letter).append(Fixed(value, 3));
  }
  return text;
}

Finding MakeFinding(Rule rule, SourcePosition where, std::string message) {
  Finding finding;
  finding.rule = rule;
  finding.severity = Info(rule).severity;
  finding.where = where;
  finding.message = std::move(message);
  return finding;
}

Verdict Judge(const std::vector<Finding>& findings, const std::vector<Assumption>& assumptions,
              bool strict) {
  const auto has = [&](Severity severity) {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const Finding& finding) { return finding.severity == severity; });
  };
  if (has(Severity::kError)) return Verdict::kFail;
  const bool open = std::any_of(assumptions.begin(), assumptions.end(), [&](const Assumption& a) {
    return !a.accepted && (a.places_metal || strict);
  });
  return open || has(Severity::kUnproven) ? Verdict::kUnproven : Verdict::kPass;
}

}  // namespace ncsim
