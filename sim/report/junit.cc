// SPDX-License-Identifier: BSD-3-Clause
#include "sim/report/junit.h"

#include <algorithm>
#include <map>

#include "sim/report/batch.h"
#include "sim/report/printable.h"

namespace ncsim::report {
namespace {

bool Fails(const JunitCase& test) {
  return std::any_of(test.problems.begin(), test.problems.end(),
                     [](const JunitProblem& problem) { return problem.failure; });
}

void WriteProblem(const JunitProblem& problem, std::ostream& out) {
  const std::string_view element = problem.failure ? "failure" : "error";
  out << "   <" << element << " type=\"" << Markup(problem.type) << "\" message=\""
      << Markup(problem.message) << "\"";
  if (problem.lines.empty()) {
    out << "/>\n";
    return;
  }
  out << ">";
  for (const std::string& line : problem.lines) out << Markup(line) << "\n";
  out << "</" << element << ">\n";
}

void WriteCase(const JunitCase& test, std::ostream& out) {
  out << "  <testcase classname=\"" << Markup(test.classname) << "\" name=\"" << Markup(test.name)
      << "\">\n";
  // Jenkins' schema has errors before failures.
  for (const bool failure : {false, true}) {
    for (const JunitProblem& problem : test.problems) {
      if (problem.failure == failure) WriteProblem(problem, out);
    }
  }
  if (!test.output.empty()) {
    out << "   <system-out>";
    for (std::size_t i = 0; i < test.output.size(); ++i) {
      out << (i > 0 ? "\n" : "") << Markup(test.output[i]);
    }
    out << "</system-out>\n";
  }
  out << "  </testcase>\n";
}

/// Findings of one rule that stop a program, in its order.
struct Group {
  bool failure = false;  ///< Some of them are errors, and not only unproven.
  std::vector<const Finding*> findings;
};

std::vector<JunitProblem> Problems(const ProgramReport& program) {
  std::map<Rule, Group> groups;
  for (const Finding& finding : program.result->findings) {
    if (!Stops(finding)) continue;
    Group& group = groups[finding.rule];
    group.failure = group.failure || finding.severity == Severity::kError;
    group.findings.push_back(&finding);
  }
  std::vector<JunitProblem> problems;
  for (const auto& [rule, group] : groups) {
    JunitProblem problem{group.failure,
                         std::string(Info(rule).id),
                         InALine(*group.findings.front(), *program.files),
                         {}};
    for (const Finding* finding : group.findings) {
      if (problem.lines.size() == static_cast<std::size_t>(kMaxFindingsOfRule)) {
        problem.lines.push_back(
            "... and " + std::to_string(group.findings.size() - problem.lines.size()) + " more");
        break;
      }
      problem.lines.push_back(InALine(*finding, *program.files));
    }
    problems.push_back(std::move(problem));
  }
  // A verdict never hangs on the findings alone.
  if (problems.empty() && program.result->verdict != Verdict::kPass) {
    problems.push_back(
        {false, std::string(ToString(program.result->verdict)), Summary(*program.result), {}});
  }
  return problems;
}

}  // namespace

void WriteJunitCases(const std::string& suite, const std::vector<JunitCase>& cases,
                     std::ostream& out) {
  std::size_t failures = 0, errors = 0;
  for (const JunitCase& test : cases) {
    failures += Fails(test) ? 1 : 0;
    errors += !Fails(test) && !test.problems.empty() ? 1 : 0;
  }
  const std::string counts = "\" tests=\"" + std::to_string(cases.size()) + "\" failures=\"" +
                             std::to_string(failures) + "\" errors=\"" + std::to_string(errors) +
                             "\">\n";
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"ncsim" << counts
      << " <testsuite name=\"" << Markup(suite) << counts;
  for (const JunitCase& test : cases) WriteCase(test, out);
  out << " </testsuite>\n</testsuites>\n";
}

std::string Message(const Finding& finding, const SourceFiles& files) {
  if (!finding.posted_from) return finding.message;
  return finding.message + " (from " + files.name(finding.posted_from->file) + ":" +
         std::to_string(finding.posted_from->line) + ")";
}

std::string InALine(const Finding& finding, const SourceFiles& files) {
  std::string text = files.name(finding.where.file);
  if (finding.where.line > 0) text += ":" + std::to_string(finding.where.line);
  if (finding.where.line > 0 && finding.where.column > 0) {
    text += ":" + std::to_string(finding.where.column);
  }
  return text + ": " + Message(finding, files);
}

bool Stops(const Finding& finding) { return finding.severity != Severity::kWarning; }

void WriteJunit(const std::vector<ProgramReport>& programs, std::ostream& out) {
  std::vector<JunitCase> cases;
  for (const ProgramReport& program : programs) {
    const CheckResult* result = program.result;
    JunitCase test{result != nullptr ? result->model : "ncsim", program.program, {}, {}};
    if (result == nullptr) {
      test.problems.push_back({false, "not-checked", "the program could not be checked",
                               PrintableLines(program.messages)});
    } else {
      test.problems = Problems(program);
      test.output = {Summary(*result)};
    }
    cases.push_back(std::move(test));
  }
  WriteJunitCases("ncsim check", cases, out);
}

}  // namespace ncsim::report
