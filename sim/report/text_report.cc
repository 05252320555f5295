// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/report/printable.h"
#include "sim/report/result.h"

namespace ncsim::report {
namespace {

/// Pairs whose clearance is printed, nearest first.
constexpr std::size_t kMaxPairs = 10;

std::string Position(const SourcePosition& where, const SourceFiles& files) {
  std::string text = files.name(where.file);
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text;
}

void WriteFinding(const Finding& finding, const SourceFiles& files, const LineText& line_text,
                  std::ostream& out) {
  out << Printable(Position(finding.where, files) + ": " + std::string(ToString(finding.severity)) +
                   ": " + finding.message)
      << " [" << Info(finding.rule).id << "]\n";
  if (finding.where.line <= 0) return;
  const std::string_view line = line_text(finding.where.file, finding.where.line);
  if (!line.empty()) out << LineWithCaret(line, finding.where.column);
  if (finding.other && finding.other->line > 0) {
    const std::string_view other = line_text(finding.other->file, finding.other->line);
    out << Printable("  against " + Position({finding.other->file, finding.other->line, 0}, files) +
                     ": " + std::string(other))
        << "\n";
  }
  if (finding.posted_from) {
    const SourcePosition& from = *finding.posted_from;
    const std::string_view record = line_text(from.file, from.line);
    out << Printable("  from " + Position(from, files) + (record.empty() ? "" : ": ") +
                     std::string(record))
        << "\n";
  }
  if (finding.points.empty()) return;
  const auto& [x, y, z] = finding.points.back();
  out << "  contact point, machine coordinates: "
      << ToString(AxisReadout{{'X', x}, {'Y', y}, {'Z', z}}) << "\n";
}

std::string PairName(const collision::PairClearance& clearance) {
  std::string text;
  for (const std::string& body : clearance.bodies) text += (text.empty() ? "" : " and ") + body;
  return text;
}

/// "1.83 mm" rounded down, so that "never less than" stays true; "not proven" for what is not a
/// number.
std::string ClearanceText(double value_mm) {
  if (std::isnan(value_mm)) return "not proven";
  if (std::isinf(value_mm)) return "out of reach";
  return Fixed(std::floor(value_mm * 100.0 + 1e-9) / 100.0, 2) + " mm";
}

/// Nearest first; a pair without a number counts as nearest.
std::vector<collision::PairClearance> ByClearance(const CheckResult& result) {
  std::vector<collision::PairClearance> sorted = result.clearances;
  const auto key = [](const collision::PairClearance& c) {
    return std::isnan(c.proven_mm) ? -HUGE_VAL : c.proven_mm;
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return sorted;
}

void WriteClearances(const CheckResult& result, std::ostream& out) {
  if (result.clearances.empty()) return;
  const std::vector<collision::PairClearance> sorted = ByClearance(result);
  out << "least clearance of each pair, nearest first:\n";
  for (std::size_t i = 0; i < std::min(kMaxPairs, sorted.size()); ++i) {
    const collision::PairClearance& clearance = sorted[i];
    out << "  " << Printable(PairName(clearance)) << ": never less than "
        << ClearanceText(clearance.proven_mm);
    if (std::isfinite(clearance.seen_mm)) {
      out << ", seen " << ClearanceText(clearance.seen_mm);
      if (clearance.where.line > 0) out << " at line " << clearance.where.line;
    }
    out << "\n";
  }
  if (sorted.size() > kMaxPairs) {
    out << "  ... and " << sorted.size() - kMaxPairs
        << " pairs that stay further apart; --format json lists them all\n";
  }
}

/// What the pairs were to clear where smoothing turns the tool.
void WriteWidening(const CheckResult& result, std::ostream& out) {
  if (result.orientation_tolerance <= 0.0 || result.clearances.empty()) return;
  const auto widest =
      std::max_element(result.clearances.begin(), result.clearances.end(),
                       [](const auto& a, const auto& b) { return a.widened_mm < b.widened_mm; });
  out << "pairs were widened for smoothing, which may turn the tool by "
      << Short(Degrees(result.orientation_tolerance), 3) << " deg: by up to "
      << Fixed(widest->widened_mm, 2) << " mm (" << Printable(PairName(*widest)) << ")\n";
}

void WriteCuts(const CheckResult& result, std::ostream& out) {
  for (const collision::DeepestCut& cut : result.cuts) {
    out << "deepest cut of T" << cut.tool << " into the finished part: " << Fixed(cut.depth_mm, 3)
        << " mm at line " << cut.where.line << "\n";
  }
}

}  // namespace

std::string_view MotionTimeModel() {
  return "rapids by trapezoid at the axes' rates and accelerations; feeds at the programmed feed, "
         "slowed to the slowest axis, stopping only where the control stops; no time for tool "
         "changes and spindle";
}

std::string Duration(double seconds) {
  if (!std::isfinite(seconds)) return "an unknown time";
  if (seconds < 60.0) return Fixed(seconds, 1) + " s";
  const double whole = std::round(seconds);
  const double hours = std::floor(whole / 3600.0);
  const double minutes = std::floor((whole - 3600.0 * hours) / 60.0);
  std::string text = hours > 0.0 ? Fixed(hours, 0) + " h " : "";
  return text + Fixed(minutes, 0) + " min " + Fixed(whole - 3600.0 * hours - 60.0 * minutes, 0) +
         " s";
}

void SortFindings(std::vector<Finding>* findings) {
  const auto key = [](const Finding& f) {
    return std::tie(f.where.file, f.where.line, f.where.column, f.rule, f.message);
  };
  std::stable_sort(findings->begin(), findings->end(),
                   [&](const Finding& a, const Finding& b) { return key(a) < key(b); });
}

std::string Count(std::size_t number, const std::string& singular) {
  return std::to_string(number) + " " + singular + (number == 1 ? "" : "s");
}

std::string CountFindings(const std::vector<Finding>& findings) {
  std::map<Severity, std::size_t> count;
  for (const Finding& finding : findings) ++count[finding.severity];
  return Count(count[Severity::kError], "error") + ", " +
         std::to_string(count[Severity::kUnproven]) + " unproven, " +
         Count(count[Severity::kWarning], "warning");
}

std::string Summary(const CheckResult& result) {
  std::string text(ToString(result.verdict));
  for (const std::string& what : result.not_checked) {
    text += ", " + what + (what == "stock" ? " not simulated" : " not checked");
  }
  text += ": " + CountFindings(result.findings) + "; " + Count(result.blocks, "block") + ", " +
          Duration(result.motion_time) + " of machine time";
  if (!result.clearances.empty()) {
    const collision::PairClearance nearest = ByClearance(result).front();
    text +=
        ", least clearance " + ClearanceText(nearest.proven_mm) + " (" + PairName(nearest) + ")";
  }
  return Printable(text);
}

void WriteFindings(const std::vector<Finding>& findings, const SourceFiles& files,
                   const LineText& line_text, std::ostream& out) {
  std::map<std::pair<Rule, Severity>, int> count;
  for (const Finding& finding : findings) {
    if (++count[{finding.rule, finding.severity}] <= kMaxFindingsOfRule) {
      WriteFinding(finding, files, line_text, out);
    }
  }
  for (const auto& [key, number] : count) {
    if (number <= kMaxFindingsOfRule) continue;
    out << "... and " << number - kMaxFindingsOfRule << " more of severity " << ToString(key.second)
        << " [" << Info(key.first).id << "]; --format json lists them all\n";
  }
}

void WriteAssumptions(const std::vector<Assumption>& assumptions, std::ostream& out) {
  if (assumptions.empty()) return;
  out << "assumed, because neither the job nor the command line says:\n";
  for (const Assumption& assumption : assumptions) {
    out << "  " << Printable(assumption.name + ": " + assumption.text)
        << (assumption.accepted       ? " (accepted)"
            : assumption.places_metal ? " (keeps the verdict from being pass)"
                                      : "")
        << "\n";
  }
}

void WriteText(const CheckResult& result, const SourceFiles& files, const LineText& line_text,
               std::ostream& out) {
  WriteFindings(result.findings, files, line_text, out);
  WriteCuts(result, out);
  WriteClearances(result, out);
  WriteWidening(result, out);
  WriteAssumptions(result.assumptions, out);
  out << "machine time: " << MotionTimeModel() << "\n";
  out << Summary(result) << "\n";
}

}  // namespace ncsim::report
