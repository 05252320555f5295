// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "sim/nightly/night.h"
#include "sim/report/printable.h"
#include "sim/report/result.h"

namespace ncsim::nightly {
namespace {

/// Findings of one row that are listed.
constexpr std::size_t kMaxFindings = 200;

constexpr std::string_view kStyle = R"css(
:root{color-scheme:light dark;--back:#fff;--text:#1c2024;--dim:#60666d;--line:#dfe3e8;--card:#f6f7f9;
--pass:#1a7f37;--fail:#c9252d;--unproven:#8a5d00;--bad-input:#8a3ffc;--error:#8a3ffc}
@media(prefers-color-scheme:dark){:root{--back:#14171a;--text:#e6e8ea;--dim:#9aa2aa;--line:#30363d;--card:#1d2126;
--pass:#4cc36a;--fail:#ff7b72;--unproven:#e3b341;--bad-input:#c297ff;--error:#c297ff}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1240px;padding:16px;background:var(--back);color:var(--text);font:15px/1.45 system-ui,sans-serif}
h1{font-size:22px;margin:4px 0}h2{font-size:17px;margin:28px 0 8px}
p{margin:4px 0;color:var(--dim)}
.counts{display:flex;flex-wrap:wrap;gap:8px;margin:14px 0;padding:0;list-style:none}
.counts li{background:var(--card);border-left:4px solid;border-radius:4px;padding:6px 14px}
.counts b{font-size:22px;margin-right:6px}
table{border-collapse:collapse;width:100%}
th{text-align:left;color:var(--dim);font-weight:500;font-size:13px}
th,td{padding:7px 10px 7px 0;border-top:1px solid var(--line);vertical-align:top}
.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
td{overflow-wrap:anywhere}td a{color:inherit;text-decoration-color:var(--dim);text-underline-offset:3px}
.verdict{font-weight:600;white-space:nowrap}
.pass{color:var(--pass)}.fail{color:var(--fail)}.unproven{color:var(--unproven)}.bad-input,.error{color:var(--error)}
.details td{border-top:0;padding-top:0}
summary{cursor:pointer;color:var(--dim);font-size:13px}
ul.list{margin:4px 0 8px;padding-left:18px;font:13px/1.5 ui-monospace,monospace}
.tag{font:600 11px system-ui,sans-serif;border:1px solid;border-radius:3px;padding:0 4px;margin-right:4px}
@media(max-width:700px){thead{display:none}table,tbody,tr,td{display:block}
tr{border-top:1px solid var(--line);padding:8px 0}tr.details{border-top:0;padding-top:0}
td{border:0;padding:1px 0}.number{display:inline-block;text-align:left;margin-right:14px}
td[data-name]:not(:empty)::before{content:attr(data-name) " ";color:var(--dim);font-size:13px}}
)css";

std::string Tag(std::string_view colour, std::string_view text) {
  return "<span class=\"tag " + std::string(colour) + "\">" + std::string(text) + "</span>";
}

void WriteList(const std::vector<std::string>& items, std::ostream& out) {
  if (items.empty()) return;
  out << "<ul class=\"list\">\n";
  for (const std::string& item : items) out << "<li>" << item << "</li>\n";
  out << "</ul>\n";
}

std::vector<std::string> Details(const Row& row) {
  std::vector<std::string> items;
  for (const std::string& line : report::PrintableLines(row.trouble))
    items.push_back(report::Markup(line));
  for (const Fall& fall : row.falls) {
    items.push_back(Tag("unproven", "closer") + report::Markup(InALine(fall)));
  }
  std::vector<const JudgedFinding*> order;
  for (const JudgedFinding& judged : row.findings) order.push_back(&judged);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return std::pair(!a->is_new, a->rank()) < std::pair(!b->is_new, b->rank());
  });
  for (std::size_t i = 0; i < std::min(order.size(), kMaxFindings); ++i) {
    const ReportFinding& finding = order[i]->finding;
    const char* colour = std::array{"fail", "unproven", ""}.at(order[i]->rank());
    std::string item = order[i]->is_new ? Tag("fail", "new") : "";
    if (!order[i]->counts()) item += Tag("pass", "accepted");
    item += Tag(colour, report::Markup(finding.severity)) + report::Markup(InALine(finding));
    if (!order[i]->counts()) item += " (" + report::Markup(order[i]->accepted->reason) + ")";
    items.push_back(std::move(item));
  }
  if (order.size() > kMaxFindings) {
    items.push_back("... and " + std::to_string(order.size() - kMaxFindings) + " more");
  }
  for (const ReportFinding& finding : row.fixed) {
    items.push_back(Tag("pass", "fixed") + report::Markup(InALine(finding)));
  }
  return items;
}

/// What the details are about: "collision, near-miss".
std::string Subject(const Row& row) {
  if (!row.report) return "why";
  std::vector<std::string> rules;
  const auto add = [&](const std::string& rule) {
    if (std::find(rules.begin(), rules.end(), rule) == rules.end()) rules.push_back(rule);
  };
  for (const JudgedFinding& judged : row.findings) add(judged.finding.rule);
  for (const ReportFinding& finding : row.fixed) add(finding.rule);
  if (!row.falls.empty()) add("clearance");
  std::string text;
  for (const std::string& rule : rules) text += (text.empty() ? "" : ", ") + rule;
  return report::Markup(text);
}

/// The name, which leads to the report.
std::string Linked(const Row& row) {
  const std::string name = report::Markup(row.name);
  if (row.page.empty()) return name;
  return "<a href=\"" + report::Markup(row.page) + "\">" + name + "</a>";
}

void WriteRow(const Row& row, std::ostream& out) {
  const std::string blocks = row.report ? std::to_string(row.report->blocks) : "";
  const std::string time = row.report ? report::Duration(row.report->time) : "";
  const std::string news = News(row);
  out << "<tr><td class=\"verdict " << row.verdict << "\">" << row.verdict << "</td><td><b>"
      << Linked(row) << "</b></td><td data-name=\"machine\">"
      << (row.report ? report::Markup(row.report->model) : "")
      << "</td><td class=\"number\" data-name=\"blocks\">" << blocks
      << "</td><td class=\"number\" data-name=\"time\">" << time
      << "</td><td data-name=\"least clearance\">" << report::Markup(LeastClearance(row))
      << "</td><td data-name=\"news\">" << news << "</td></tr>\n";
  const std::vector<std::string> details = Details(row);
  if (details.empty()) return;
  const bool open = !news.empty() || !row.trouble.empty();
  out << "<tr class=\"details\"><td></td><td colspan=\"6\"><details" << (open ? " open" : "")
      << "><summary>" << Subject(row) << "</summary>\n";
  WriteList(details, out);
  out << "</details></td></tr>\n";
}

void WriteCounts(const Night& night, std::ostream& out) {
  out << "<ul class=\"counts\">\n";
  for (const char* verdict : {"fail", "error", "bad-input", "unproven", "pass"}) {
    const auto count = std::count_if(night.rows.begin(), night.rows.end(),
                                     [&](const Row& row) { return row.verdict == verdict; });
    if (count > 0) {
      out << "<li class=\"" << verdict << "\"><b>" << count << "</b>" << verdict << "</li>\n";
    }
  }
  out << "</ul>\n";
}

void WriteSection(const char* title, const std::vector<std::string>& items, std::ostream& out) {
  if (items.empty()) return;
  out << "<h2>" << title << "</h2>\n";
  WriteList(items, out);
}

}  // namespace

void WriteNightPage(const Night& night, std::ostream& out) {
  out << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>"
      << night.day << ": " << CountVerdicts(night) << "</title>\n<style>" << kStyle
      << "</style></head><body>\n<h1>Night of " << night.day << "</h1>\n<p>"
      << (night.before.empty() ? "No night before to compare with"
                               : "Compared with the night of " + night.before)
      << ". " << CountVerdicts(night) << ".</p>\n";
  WriteCounts(night, out);
  out << "<table><thead><tr><th>verdict</th><th>program</th><th>machine</th><th class=\"number\">"
         "blocks</th><th class=\"number\">machine time</th><th>least clearance</th><th>news</th>"
         "</tr></thead><tbody>\n";
  for (const Row& row : night.rows) WriteRow(row, out);
  out << "</tbody></table>\n";
  std::vector<std::string> gone, baseline, notes;
  for (const std::string& name : night.gone) gone.push_back(report::Markup(name));
  for (const AcceptanceState& state : night.baseline) {
    baseline.push_back((state.fault.empty() ? "" : Tag("unproven", "look")) +
                       report::Markup(InALine(state)));
  }
  for (const std::string& note : night.notes) notes.push_back(report::Markup(note));
  WriteSection("Programs that are gone", gone, out);
  WriteSection("Accepted findings", baseline, out);
  WriteSection("Notes", notes, out);
  out << "</body></html>\n";
}

}  // namespace ncsim::nightly
