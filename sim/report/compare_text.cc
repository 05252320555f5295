// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/report/compare_result.h"
#include "sim/report/printable.h"

namespace ncsim::report {
namespace {

/// Of additions the first so many are printed.
constexpr std::size_t kMaxAdded = 20;

std::string PlaceText(const SourcePosition& where, const SourceFiles& files) {
  return files.name(where.file) + (where.line > 0 ? ":" + std::to_string(where.line) : "");
}

/// A proven bound is rounded up.
std::string RoundedUpText(double value) { return Fixed(std::ceil(value * 1e4 - 1e-6) * 1e-4, 4); }

void WriteLargest(const std::string& what, const std::string& value,
                  const compare::Largest& largest, const SourceFiles& files, std::ostream& out) {
  out << Printable("largest deviation of the " + what + ": " + value);
  if (largest.tested.line > 0) {
    out << Printable(", at " + PlaceText(largest.tested, files) + " and " +
                     PlaceText(largest.reference, files));
  }
  out << "\n";
}

}  // namespace

std::string Summary(const CompareResult& result) {
  return Printable(std::string(ToString(result.verdict)) + ": " + CountFindings(result.findings) +
                   "; " + Count(result.comparison.runs, "run") + " of feeds, " +
                   Fixed(result.comparison.feed_length, 0) + " mm of " + result.reference.program +
                   ", held against " + result.tested.program);
}

std::string Nearness(const CompareResult& result) {
  const compare::Comparison& comparison = result.comparison;
  return Printable(result.tested.program + ": the motion of " + result.reference.program +
                   ": tip within " + RoundedUpText(comparison.position.value) +
                   " mm, tool axis within " + RoundedUpText(Degrees(comparison.angle.value)) +
                   " deg, over " + Fixed(comparison.feed_length, 0) + " mm of feeds");
}

void WriteText(const CompareResult& result, const SourceFiles& files, const LineText& line_text,
               std::ostream& out) {
  WriteFindings(result.findings, files, line_text, out);
  const compare::Comparison& comparison = result.comparison;
  if (!comparison.added.empty()) out << "added, which is no error:\n";
  for (std::size_t i = 0; i < std::min(kMaxAdded, comparison.added.size()); ++i) {
    const compare::Added& added = comparison.added[i];
    out << Printable("  " + PlaceText(added.where, files) + ": " + added.text) << "\n";
  }
  if (comparison.added.size() > kMaxAdded) {
    out << "  ... and " << comparison.added.size() - kMaxAdded
        << " more; --format json lists them all\n";
  }
  WriteLargest("tip", RoundedUpText(comparison.position.value) + " mm", comparison.position, files,
               out);
  WriteLargest("tool axis", RoundedUpText(Degrees(comparison.angle.value)) + " deg",
               comparison.angle, files, out);
  std::vector<Assumption> placing;  // The others move nothing that is held together.
  for (const ComparedProgram* program : {&result.reference, &result.tested}) {
    for (const Assumption& assumption : program->assumptions) {
      const bool known = std::any_of(placing.begin(), placing.end(), [&](const Assumption& other) {
        return other.name == assumption.name && other.text == assumption.text;
      });
      if (assumption.places_metal && !known) placing.push_back(assumption);
    }
  }
  WriteAssumptions(placing, out);
  out << Summary(result) << "\n";
}

}  // namespace ncsim::report
