// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/baseline.h"

#include <charconv>
#include <chrono>
#include <utility>

#include "sim/base/file.h"
#include "sim/base/finding.h"
#include "sim/base/text.h"
#include "sim/base/toml_reader.h"

namespace ncsim::nightly {
namespace {

constexpr std::uint64_t kMaxBaselineBytes = 1 << 24;

std::string Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

void CheckRule(const TomlTable& table, const std::string& rule) {
  if (rule.empty() || RuleFromId(rule)) return;
  std::vector<std::string> known;
  for (const RuleInfo& info : Rules()) known.emplace_back(info.id);
  table.ErrorAt(*table.value().Find("rule"),
                "there is no rule '" + rule + "'" + DidYouMean(rule, known));
}

Acceptance ReadAcceptance(TomlTable* table) {
  Acceptance accepted;
  accepted.program = table->RequiredString("program").value_or("");
  accepted.rule = table->RequiredString("rule").value_or("");
  accepted.source = Trimmed(table->String("line_text").value_or(""));
  accepted.message = table->String("message").value_or("");
  accepted.reason = Trimmed(table->RequiredString("reason").value_or(""));
  accepted.expires = table->RequiredString("expires").value_or("");
  table->Finish();
  CheckRule(*table, accepted.rule);
  const auto fault = [&](const char* what) { table->ErrorAt(table->value(), what); };
  if (accepted.source.empty() && accepted.message.empty()) {
    fault("'line_text' or 'message' must say which findings of the rule are meant");
  }
  if (table->value().Find("reason") != nullptr && accepted.reason.empty()) {
    fault("'reason' must not be empty");
  }
  if (!accepted.expires.empty() && !IsDay(accepted.expires)) {
    table->ErrorAt(*table->value().Find("expires"), "'expires' must be a day like \"2027-03-01\"");
  }
  return accepted;
}

}  // namespace

bool Acceptance::Matches(const std::string& of_program, const ReportFinding& finding) const {
  return of_program == program && finding.rule == rule &&
         (source.empty() || finding.source == source) &&
         (message.empty() || finding.message.find(message) != std::string::npos);
}

bool IsDay(const std::string& text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  const auto number = [&](std::size_t begin, std::size_t size) {
    int value = -1;
    const char* first = text.data() + begin;
    const auto read = std::from_chars(first, first + size, value);
    return read.ec == std::errc() && read.ptr == first + size ? value : -1;
  };
  const int year = number(0, 4), month = number(5, 2), day = number(8, 2);
  if (year < 0 || month < 0 || day < 0) return false;
  return std::chrono::year_month_day(std::chrono::year(year),
                                     std::chrono::month(static_cast<unsigned>(month)),
                                     std::chrono::day(static_cast<unsigned>(day)))
      .ok();
}

std::optional<Baseline> ReadBaseline(const std::string& path, Diagnostics* diagnostics) {
  std::string reason;
  const std::optional<std::string> text = ReadFile(path, kMaxBaselineBytes, &reason);
  if (!text) {
    diagnostics->Error(path, 0, 0, "cannot be read: " + reason);
    return std::nullopt;
  }
  const std::optional<TomlValue> toml = ParseToml(*text, path, diagnostics);
  if (!toml) return std::nullopt;
  TomlTable file(*toml, path, diagnostics);
  Baseline baseline;
  if (file.Require("schema") != nullptr) file.Integer("schema", 1, 1);
  for (TomlTable& table : file.Tables("accept")) {
    baseline.accepted.push_back(ReadAcceptance(&table));
  }
  file.Finish();
  if (diagnostics->has_errors()) return std::nullopt;
  return baseline;
}

}  // namespace ncsim::nightly
