// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_coverage.h"

#include "sim/nc/sinumerik_commands.h"
#include "sim/nc/support_text.h"

namespace ncsim::nc {
namespace {

using Kind = SinumerikCommandKind;

/// "G505", "G505 to G599".
std::string NameOf(const SinumerikCommand& command) {
  std::string name(command.name);
  if (command.last == 0) return name;
  const std::string letters = name.substr(0, name.find_last_not_of("0123456789") + 1);
  return name + " to " + letters + std::to_string(command.last);
}

std::string Row(const SinumerikCommand& command) {
  std::string row = "| " + NameOf(command) + " | ";
  if (command.kind == Kind::kGCode) {
    row += std::to_string(command.group) + (command.is_default ? " *" : "") + " | ";
  }
  if (command.kind == Kind::kCycle) row += std::string(command.parameters) + " | ";
  return row + std::string(command.meaning) + " | " + std::string(ToString(command.support)) +
         " | " + std::string(command.note) + " |\n";
}

std::string Section(std::string_view title, Kind kind, std::string_view header) {
  std::string text = "\n## " + std::string(title) + "\n\n" + std::string(header);
  for (const SinumerikCommand& command : Sinumerik840dNames()) {
    if (command.kind == kind) text += Row(command);
  }
  return text;
}

}  // namespace

std::string SinumerikCoverageTable() {
  std::string text =
      "# SINUMERIK 840D sl\n\n"
      "Every G code, M function, address, predefined subprogram and cycle that ncsim knows by "
      "name, "
      "and what it does with\n"
      "it. This page is printed from the table that drives the interpreter (`sim/nc/`), and a test "
      "holds the two together.\n\n"
      "- **simulated**: motion and state are computed as the manual describes them.\n"
      "- **no motion effect**: understood; moves nothing that is checked.\n"
      "- **unsupported**: reported as `unsupported-code`; the verdict is at best `unproven`.\n\n"
      "What is not listed is reported as well: nothing is ignored in silence. `*` marks the "
      "standard "
      "start state of a group\n(MD20150).\n\n"
      "## G codes\n\n"
      "| code | group | meaning | ncsim | note |\n|---|---|---|---|---|\n";
  for (const SinumerikCommand& command : Sinumerik840dGCodes()) text += Row(command);
  constexpr std::string_view kPlain = "| name | meaning | ncsim | note |\n|---|---|---|---|\n";
  text += Section("M functions", Kind::kMCode, kPlain);
  text += Section("Addresses", Kind::kAddress, kPlain);
  text += Section("Predefined subprograms", Kind::kProcedure, kPlain);
  text += Section("Cycles", Kind::kCycle,
                  "| name | parameters | meaning | ncsim | note |\n|---|---|---|---|---|\n");
  return text;
}

}  // namespace ncsim::nc
