// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>

#include "sim/report/batch.h"
#include "sim/report/printable.h"

namespace ncsim::report {
namespace {

/// What the service shows of a step, of each kind.
constexpr std::size_t kShown = 10;

std::string Escaped(std::string_view text, bool property) {
  std::string escaped;
  for (const char c : text) {
    if (c == '%') {
      escaped += "%25";
    } else if (c == '\r') {
      escaped += "%0D";
    } else if (c == '\n') {
      escaped += "%0A";
    } else if (property && c == ':') {
      escaped += "%3A";
    } else if (property && c == ',') {
      escaped += "%2C";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

struct Annotation {
  std::size_t turn = 0;  ///< How many of its rule came before it.
  std::string text;
};

std::string Command(std::string_view kind, const std::string& file, int line, int column,
                    std::string_view title, std::string_view message) {
  std::string text = "::" + std::string(kind) + " file=" + Escaped(Printable(file), true);
  if (line > 0) text += ",line=" + std::to_string(line);
  if (line > 0 && column > 0) text += ",col=" + std::to_string(column);
  return text + ",title=" + Escaped(title, true) + "::" + Escaped(Printable(message), false);
}

/// Those of one kind: each rule's first before any rule's second.
void Write(std::vector<Annotation> annotations, std::string_view kind, std::ostream& out) {
  std::stable_sort(annotations.begin(), annotations.end(),
                   [](const Annotation& a, const Annotation& b) { return a.turn < b.turn; });
  for (std::size_t i = 0; i < std::min(kShown, annotations.size()); ++i) {
    out << annotations[i].text << "\n";
  }
  if (annotations.size() > kShown) {
    out << annotations.size() - kShown << " more " << kind << "s are not shown here\n";
  }
}

}  // namespace

void WriteGithub(const std::vector<ProgramReport>& programs, std::ostream& out) {
  std::array<std::vector<Annotation>, 2> annotations;  // Errors, warnings.
  std::map<Rule, std::size_t> turns;
  for (const ProgramReport& program : programs) {
    if (program.result == nullptr) {
      const std::string text = Command("error", program.program, 0, 0, "not-checked",
                                       program.messages.substr(0, program.messages.find('\n')));
      annotations[0].push_back({0, text});
      continue;
    }
    for (const Finding& finding : program.result->findings) {
      const std::size_t kind = Stops(finding) ? 0 : 1;
      const SourcePosition& where = finding.where;
      annotations[kind].push_back(
          {turns[finding.rule]++,
           Command(kind == 0 ? "error" : "warning", program.files->name(where.file), where.line,
                   where.column, Info(finding.rule).id, Message(finding, *program.files))});
    }
  }
  Write(std::move(annotations[0]), "error", out);
  Write(std::move(annotations[1]), "warning", out);
  for (const ProgramReport& program : programs) {
    out << Printable(program.program) << ": "
        << (program.result != nullptr ? Summary(*program.result) : "not checked") << "\n";
  }
}

}  // namespace ncsim::report
