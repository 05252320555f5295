// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "sim/report/batch.h"
#include "sim/report/printable.h"

namespace ncsim::report {
namespace {

/// Text of an element or attribute: Printable() leaves nothing that XML forbids.
std::string Xml(std::string_view text) {
  std::string escaped;
  for (const char c : Printable(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string XmlLines(std::string_view text) {
  std::string escaped;
  for (const std::string& line : PrintableLines(text)) escaped += Xml(line) + "\n";
  return escaped;
}

/// Findings of one rule that stop a program, in its order.
struct Group {
  bool failure = false;  ///< Some of them are errors, and not only unproven.
  std::vector<const Finding*> findings;
};

class Writer {
 public:
  Writer(const std::vector<ProgramReport>& programs, std::ostream& out)
      : programs_(programs), out_(out) {}

  void Write() {
    std::size_t failures = 0, errors = 0;
    for (const ProgramReport& program : programs_) {
      const bool fails = program.result != nullptr && program.result->verdict == Verdict::kFail;
      const bool passes = program.result != nullptr && program.result->verdict == Verdict::kPass;
      failures += fails ? 1 : 0;
      errors += fails || passes ? 0 : 1;
    }
    const std::string counts = "\" tests=\"" + std::to_string(programs_.size()) + "\" failures=\"" +
                               std::to_string(failures) + "\" errors=\"" + std::to_string(errors) +
                               "\">\n";
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"ncsim" << counts
         << " <testsuite name=\"ncsim check" << counts;
    for (const ProgramReport& program : programs_) WriteCase(program);
    out_ << " </testsuite>\n</testsuites>\n";
  }

 private:
  void WriteCase(const ProgramReport& program) {
    const CheckResult* result = program.result;
    out_ << "  <testcase classname=\"" << Xml(result != nullptr ? result->model : "ncsim")
         << "\" name=\"" << Xml(program.program) << "\">\n";
    if (result == nullptr) {
      out_ << "   <error type=\"not-checked\" message=\"the program could not be checked\">"
           << XmlLines(program.messages) << "</error>\n";
    } else {
      WriteGroups(program);
      out_ << "   <system-out>" << Xml(Summary(*result)) << "</system-out>\n";
    }
    out_ << "  </testcase>\n";
  }

  void WriteGroups(const ProgramReport& program) {
    std::map<Rule, Group> groups;
    for (const Finding& finding : program.result->findings) {
      if (!Stops(finding)) continue;
      Group& group = groups[finding.rule];
      group.failure = group.failure || finding.severity == Severity::kError;
      group.findings.push_back(&finding);
    }
    for (const auto& [rule, group] : groups) {
      const std::string_view element = group.failure ? "failure" : "error";
      out_ << "   <" << element << " type=\"" << Info(rule).id << "\" message=\""
           << Xml(InALine(*group.findings.front(), *program.files)) << "\">";
      for (std::size_t i = 0; i < group.findings.size(); ++i) {
        if (i == kMaxFindingsOfRule) {
          out_ << "... and " << group.findings.size() - i << " more\n";
          break;
        }
        out_ << Xml(InALine(*group.findings[i], *program.files)) << "\n";
      }
      out_ << "</" << element << ">\n";
    }
    // A verdict never hangs on the findings alone.
    if (groups.empty() && program.result->verdict != Verdict::kPass) {
      out_ << "   <error type=\"" << ToString(program.result->verdict) << "\" message=\""
           << Xml(Summary(*program.result)) << "\"/>\n";
    }
  }

  const std::vector<ProgramReport>& programs_;
  std::ostream& out_;
};

}  // namespace

std::string InALine(const Finding& finding, const SourceFiles& files) {
  std::string text = files.name(finding.where.file);
  if (finding.where.line > 0) text += ":" + std::to_string(finding.where.line);
  if (finding.where.line > 0 && finding.where.column > 0) {
    text += ":" + std::to_string(finding.where.column);
  }
  return text + ": " + finding.message;
}

bool Stops(const Finding& finding) { return finding.severity != Severity::kWarning; }

void WriteJunit(const std::vector<ProgramReport>& programs, std::ostream& out) {
  Writer(programs, out).Write();
}

}  // namespace ncsim::report
