// SPDX-License-Identifier: BSD-3-Clause
// A night: every program's result, held against what is accepted and what was before.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "sim/nightly/baseline.h"
#include "sim/nightly/history.h"
#include "sim/nightly/manifest.h"
#include "sim/nightly/result.h"

namespace ncsim::nightly {

struct JudgedFinding {
  ReportFinding finding;
  const Acceptance* accepted = nullptr;  ///< Of the night's baseline; null: it counts.
  bool is_new = false;                   ///< Was not there before.

  bool counts() const { return accepted == nullptr; }
  /// 0 for an error, 1 for what is unproven, 2 for a warning.
  int rank() const;
};

/// A pair that is closer than it was shown to stay before.
struct Fall {
  std::vector<std::string> bodies;
  double from = 0.0, to = 0.0;  ///< mm: proven before, seen now.
  std::string file;
  int line = 0;
};

struct Row {
  std::string name;
  std::string verdict;  ///< "pass", "fail", "unproven", "bad-input" or "error".
  std::string before;   ///< When it was last checked; "" where it is not known.
  std::optional<Report> report;
  std::string trouble;  ///< Where there is no report.
  std::vector<JudgedFinding> findings;
  std::vector<ReportFinding> fixed;
  std::vector<Fall> falls;  ///< Closest first.
  std::string page;         ///< Path of its report, seen from the night's page; "" for none.
  bool is_new = false;      ///< Not a program of any earlier night, where there is one.

  /// As of `ncsim check`.
  int exit_code() const;
  /// The pair that is proven least; null where there is none.
  const ReportClearance* least() const;
};

struct AcceptanceState {
  Acceptance acceptance;
  std::size_t matches = 0;
  std::string fault;  ///< Why it does not count or should go; "" where all is well.
};

struct Night {
  std::string day, before;  ///< "2026-11-22"; before: "" where there is none.
  std::vector<Row> rows;
  std::vector<std::string> gone;  ///< Programs of `before` that are not there any more.
  std::vector<AcceptanceState> baseline;
  std::vector<std::string> notes;
};

/// `results` are those of `manifest`'s entries, in their order. `baseline` must outlive the night.
Night JudgeNight(const std::string& day, const Manifest& manifest,
                 const std::vector<Result>& results, const Baseline& baseline, History* history);

/// What the history keeps of it.
std::vector<PastRow> PastRows(const Night& night);

/// "a.nc:12: holder of T1 hits jaw [collision]"
std::string InALine(const ReportFinding& finding);
/// "holder and vise fell from 3.10 to 0.40 mm (a.nc:12)"
std::string InALine(const Fall& fall);
/// "near-miss of a.nc accepted until 2027-03-01: reason", with its fault.
std::string InALine(const AcceptanceState& state);
/// "2 pass, 1 fail, ..."
std::string CountVerdicts(const Night& night);
/// "1 new, was pass"; "" where nothing is new.
std::string News(const Row& row);
/// "2.15 mm holder of T1 and jaw, line 12"; "" where no pair was checked.
std::string LeastClearance(const Row& row);

/// For people at a terminal.
void WriteTable(const Night& night, std::ostream& out);
/// docs/nightly.md
void WriteNightJson(const Night& night, std::ostream& out);
/// A test case a program.
void WriteNightJunit(const Night& night, std::ostream& out);
/// One HTML file that needs nothing else.
void WriteNightPage(const Night& night, std::ostream& out);

}  // namespace ncsim::nightly
