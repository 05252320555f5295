// SPDX-License-Identifier: BSD-3-Clause
// What a run over one or more programs found, in the formats of the services that collect it. Equal
// runs write equal bytes: no clock, no host, no paths but those that were given.
#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "sim/report/result.h"

namespace ncsim::report {

struct ProgramReport {
  std::string program;                  ///< As given on the command line.
  const CheckResult* result = nullptr;  ///< Null: it could not be checked, and `messages` says why.
  const SourceFiles* files = nullptr;   ///< Of `result`.
  LineText line_text;                   ///< Of `files`.
  std::string messages;                 ///< Lines for people about the inputs; may be empty.
};

/// SARIF 2.1.0 (OASIS standard, 27 March 2020), one run. Errors and what is unproven have the level
/// error: a gate on that level lets nothing through that `ncsim check` does not pass. Of more than
/// kMaxSarifResults findings each rule of each program keeps its first ones and says how many
/// follow (GitHub reads 5,000 of a run, docs "SARIF results exceed one or more limits"). A
/// fingerprint does not change with the line's number, but with its text.
inline constexpr std::size_t kMaxSarifResults = 5'000;
void WriteSarif(const std::vector<ProgramReport>& programs, std::string_view version,
                std::ostream& out);

/// JUnit XML as Jenkins reads it: a test case a program; a failure a rule that found errors, an
/// error a rule that left something unproven, or an input that cannot be read.
void WriteJunit(const std::vector<ProgramReport>& programs, std::ostream& out);

/// Workflow commands of GitHub Actions: the service shows 10 errors and 10 warnings of a step, so
/// each rule's first finding comes before any rule's second. The rest is counted, and each program
/// has its summary line.
void WriteGithub(const std::vector<ProgramReport>& programs, std::ostream& out);

/// "holder of T1 hits jaw (from vise.cls:40)"
std::string Message(const Finding& finding, const SourceFiles& files);
/// "vise.nc:12:1: holder of T1 hits jaw", without the rule.
std::string InALine(const Finding& finding, const SourceFiles& files);
/// The severity as these formats gate on it: what is unproven stops as an error does.
bool Stops(const Finding& finding);

}  // namespace ncsim::report
