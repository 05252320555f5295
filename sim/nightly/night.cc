// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/night.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "sim/base/text.h"
#include "sim/report/printable.h"

namespace ncsim::nightly {
namespace {

/// What stays the same of a finding while its place moves: rule, file, bodies and the line's text,
/// or the message without its numbers; and how often all that came before.
std::vector<std::string> Fingerprints(const std::vector<ReportFinding>& findings) {
  std::map<std::string, int> count;
  std::vector<std::string> fingerprints;
  for (const ReportFinding& finding : findings) {
    std::string text = finding.rule + '\n' + finding.file + '\n' + finding.source + '\n';
    for (const std::string& body : finding.bodies) text += body + '\n';
    if (finding.source.empty()) {
      for (const char c : finding.message) {
        if (c < '0' || c > '9') text += c;
      }
    }
    const int before = count[text]++;
    fingerprints.push_back(text + std::to_string(before));
  }
  return fingerprints;
}

std::string VerdictOf(const std::vector<JudgedFinding>& findings, bool with_accepted) {
  std::string verdict = "pass";
  for (const JudgedFinding& judged : findings) {
    if (!with_accepted && !judged.counts()) continue;
    if (judged.finding.severity == "error") return "fail";
    if (judged.finding.severity == "unproven") verdict = "unproven";
  }
  return verdict;
}

std::vector<Fall> Falls(const Report& before, const Report& now) {
  std::map<std::vector<std::string>, double> proven;
  for (const ReportClearance& clearance : before.clearances) {
    if (clearance.proven) proven.emplace(clearance.bodies, *clearance.proven);
  }
  std::vector<Fall> falls;
  for (const ReportClearance& clearance : now.clearances) {
    const auto old = proven.find(clearance.bodies);
    // It was never less than `proven`, and now is seen below: no matter how tight either is.
    if (old == proven.end() || !clearance.seen || *clearance.seen >= old->second) continue;
    falls.push_back(
        {clearance.bodies, old->second, *clearance.seen, clearance.file, clearance.line});
  }
  std::stable_sort(falls.begin(), falls.end(),
                   [](const Fall& a, const Fall& b) { return a.to < b.to; });
  return falls;
}

class Judge {
 public:
  Judge(Night* night, const Baseline& baseline, History* history)
      : night_(night), history_(history) {
    for (const Acceptance& acceptance : baseline.accepted) {
      night_->baseline.push_back({acceptance, 0, ""});
    }
    accepted_ = &baseline.accepted;
  }

  Row Make(const Result& result) {
    Row row;
    row.name = result.name;
    row.trouble = result.trouble;
    row.verdict = result.bad_input ? "bad-input" : "error";
    const auto past = history_->LastChecked(result.name, night_->day);
    if (past) row.before = past->verdict;
    if (!result.report) return row;
    row.report = result.report;
    for (const ReportFinding& finding : result.report->findings) {
      row.findings.push_back({finding, Accept(result.name, finding), false});
    }
    row.report->findings.clear();  // They are the row's now.
    row.verdict = result.report->verdict;
    // A verdict that its findings do not explain is left as it is.
    if (VerdictOf(row.findings, true) == row.verdict) row.verdict = VerdictOf(row.findings, false);
    if (past) Compare(*past->report, *result.report, &row);
    return row;
  }

  /// What is wrong with the baseline, once all programs have been seen.
  void Close() {
    std::map<std::string, const Row*> rows;
    for (const Row& row : night_->rows) rows[row.name] = &row;
    for (AcceptanceState& state : night_->baseline) {
      const Acceptance& acceptance = state.acceptance;
      const auto row = rows.find(acceptance.program);
      if (acceptance.expires < night_->day) {
        state.fault = "expired, no longer counts";
      } else if (row == rows.end()) {
        state.fault = "there is no such program";
      } else if (!row->second->report) {
        state.fault = "its program could not be checked";
      } else if (state.matches == 0) {
        state.fault = "matches nothing any more: remove it";
      }
    }
  }

 private:
  const Acceptance* Accept(const std::string& program, const ReportFinding& finding) {
    const Acceptance* found = nullptr;
    for (std::size_t i = 0; i < accepted_->size(); ++i) {
      const Acceptance& acceptance = (*accepted_)[i];
      if (!acceptance.Matches(program, finding)) continue;
      ++night_->baseline[i].matches;
      if (found == nullptr && acceptance.expires >= night_->day) found = &acceptance;
    }
    return found;
  }

  static void Compare(const Report& before, const Report& now, Row* row) {
    const std::vector<std::string> old = Fingerprints(before.findings);
    const std::vector<std::string> present = Fingerprints(now.findings);
    const std::set<std::string> old_set(old.begin(), old.end());
    const std::set<std::string> present_set(present.begin(), present.end());
    for (std::size_t i = 0; i < present.size(); ++i) {
      row->findings[i].is_new = old_set.count(present[i]) == 0;
    }
    for (std::size_t i = 0; i < old.size(); ++i) {
      if (present_set.count(old[i]) == 0) row->fixed.push_back(before.findings[i]);
    }
    row->falls = Falls(before, now);
  }

  Night* night_;
  History* history_;
  const std::vector<Acceptance>* accepted_;
};

std::string Bodies(const std::vector<std::string>& bodies) {
  std::string text;
  for (const std::string& body : bodies) text += (text.empty() ? "" : " and ") + body;
  return text;
}

}  // namespace

int JudgedFinding::rank() const {
  return finding.severity == "error" ? 0 : finding.severity == "unproven" ? 1 : 2;
}

int Row::exit_code() const {
  return verdict == "pass"        ? 0
         : verdict == "fail"      ? 1
         : verdict == "unproven"  ? 2
         : verdict == "bad-input" ? 3
                                  : 4;
}

const ReportClearance* Row::least() const {
  if (!report || report->clearances.empty()) return nullptr;
  // Neither number: out of reach. One that is seen and not proven comes first.
  const auto key = [](const ReportClearance& c) {
    return c.proven.value_or(c.seen ? -HUGE_VAL : HUGE_VAL);
  };
  return &*std::min_element(report->clearances.begin(), report->clearances.end(),
                            [&](const auto& a, const auto& b) { return key(a) < key(b); });
}

Night JudgeNight(const std::string& day, const Manifest& manifest,
                 const std::vector<Result>& results, const Baseline& baseline, History* history) {
  Night night;
  night.day = day;
  night.before = history->NightBefore(day);
  night.notes = manifest.notes;
  const std::vector<std::string> last = history->NamesOf(night.before);
  const std::set<std::string> known(last.begin(), last.end());
  std::set<std::string> present;
  Judge judge(&night, baseline, history);
  for (const Result& result : results) {
    Row row = judge.Make(result);
    row.is_new = !night.before.empty() && known.count(row.name) == 0 && row.before.empty();
    present.insert(row.name);
    night.rows.push_back(std::move(row));
  }
  judge.Close();
  for (const std::string& name : last) {
    if (present.count(name) == 0) night.gone.push_back(name);
  }
  return night;
}

std::vector<PastRow> PastRows(const Night& night) {
  std::vector<PastRow> rows;
  for (const Row& row : night.rows) {
    PastRow past{row.name, row.verdict, row.trouble, row.report};
    for (const JudgedFinding& judged : row.findings) {
      past.report->findings.push_back(judged.finding);
    }
    rows.push_back(std::move(past));
  }
  return rows;
}

std::string InALine(const ReportFinding& finding) {
  std::string text = finding.file;
  if (finding.line > 0) text += ":" + std::to_string(finding.line);
  return report::Printable(text + ": " + finding.message + " [" + finding.rule + "]");
}

std::string InALine(const Fall& fall) {
  std::string text = Bodies(fall.bodies) + " fell from " + Fixed(fall.from, 2) + " to " +
                     Fixed(fall.to, 2) + " mm";
  if (fall.line > 0) text += " (" + fall.file + ":" + std::to_string(fall.line) + ")";
  return report::Printable(text);
}

std::string InALine(const AcceptanceState& state) {
  const Acceptance& acceptance = state.acceptance;
  return report::Printable(
      acceptance.rule + " of " + acceptance.program + " (" +
      (acceptance.source.empty() ? acceptance.message : acceptance.source) + ") accepted until " +
      acceptance.expires + ": " + acceptance.reason + "; " +
      (state.fault.empty() ? std::to_string(state.matches) + " found" : state.fault));
}

std::string CountVerdicts(const Night& night) {
  std::string text =
      std::to_string(night.rows.size()) + (night.rows.size() == 1 ? " program: " : " programs: ");
  bool first = true;
  for (const char* verdict : {"pass", "fail", "unproven", "bad-input", "error"}) {
    const auto count = std::count_if(night.rows.begin(), night.rows.end(),
                                     [&](const Row& row) { return row.verdict == verdict; });
    if (count == 0) continue;
    text += (first ? "" : ", ") + std::to_string(count) + " " + verdict;
    first = false;
  }
  return text;
}

std::string News(const Row& row) {
  std::vector<std::string> news;
  const auto fresh = std::count_if(row.findings.begin(), row.findings.end(),
                                   [](const JudgedFinding& f) { return f.is_new; });
  if (row.is_new) news.emplace_back("new program");
  if (!row.before.empty() && row.before != row.verdict) news.push_back("was " + row.before);
  if (fresh > 0) news.push_back(std::to_string(fresh) + " new");
  if (!row.fixed.empty()) news.push_back(std::to_string(row.fixed.size()) + " fixed");
  if (!row.falls.empty()) news.push_back(std::to_string(row.falls.size()) + " closer");
  std::string text;
  for (const std::string& part : news) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string LeastClearance(const Row& row) {
  const ReportClearance* least = row.least();
  if (least == nullptr) return "";
  if (!least->proven && !least->seen) return "out of reach";
  std::string text =
      (least->proven ? Fixed(*least->proven, 2) + " mm " : "not proven: ") + Bodies(least->bodies);
  if (least->line > 0) text += ", line " + std::to_string(least->line);
  return report::Printable(text);
}

}  // namespace ncsim::nightly
