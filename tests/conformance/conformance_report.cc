// SPDX-License-Identifier: BSD-3-Clause
#include "tests/conformance/conformance_report.h"

#include <algorithm>
#include <map>

namespace ncsim::conformance {
namespace {

struct Group {
  std::string_view part;  // Of a finding's message, or of a program's name.
  std::string_view reason;
};

constexpr std::string_view kOWords =
    "LinuxCNC's O-words: subroutines with names or arguments, loops, conditions";

// Findings on what a Haas does not take.
constexpr Group kFindings[] = {
    {"'SUB'", kOWords},
    {"'CALL'", kOWords},
    {"O needs a whole number", kOWords},
    {"WHILE [ ]", kOWords},
    {"number of a DO or END", kOWords},
    {"IF [ ] must", kOWords},
    {"a condition without IF", kOWords},
    {"'#' needs the number", "named parameters (`#<name>`)"},
    {"not in the code list", "a G or M code that the manual does not list"},
    {"has no meaning",
     "a word that this control does not know there (`P` turns of an arc, `R` of G10 L2)"},
    {"a second M code", "two M codes in one block"},
    {"is not on the arc",
     "an arc whose end is off the circle by more than 0.01 mm (LinuxCNC takes more on a large "
     "one)"},
    {"while setting 9", "G20 and G21 in one program"},
    {"F: value out of range", "an F beyond the control's range"},
    {"starts in an arc", "cutter compensation that starts in an arc"},
    {"works in G17 only", "cutter compensation in G18 (a lathe)"},
    {"digits; at most 5", "an O number of more than five digits"},
    {"number of repetitions", "M98 with L0"},
    {"P7: a whole number", "G10 L1, L10 and L11 as LinuxCNC means them"},
    {"without an address", "text that is no block"},
};

constexpr std::string_view kAboveTool =
    "canned cycle with R above the tool: LinuxCNC goes up to R before it moves sideways and comes "
    "back to the higher of R "
    "and the initial level; here the tool goes sideways first and comes back to the initial level "
    "(manual, G98)";

// Differences of rule, by program: the Haas manual holds.
constexpr Group kDialect[] = {
    {"easy-gcode-plot/cnc programs/PROGRAM2.NC",
     "S0 M03: LinuxCNC counts a spindle at 0 rpm as turning"},
    {"easy-gcode-plot/cnc programs/TEST_G91.NC",
     "M06 leaves Z at machine zero (manual, M06), and the next move is incremental"},
    {"4axis_test_only.cnc", kAboveTool},
    {"interp/g81/", kAboveTool},
    {"interp/g84/g17/g98",
     "G84 feeds out to R and rapids on (manual, F7.31); LinuxCNC feeds to the initial level; and R "
     "above the tool, as in G81"},
    {"interp/g84/g17/g99", kAboveTool},
    {"interp/g84/g18",
     "LinuxCNC's expected file feeds G84 along X in G18; and R above the tool, as in G81"},
    {"spindle-tilt-manual_TWP/demos/square.ngc",
     "cutter compensation that starts on an outside corner: a Haas goes straight to beside the "
     "next "
     "move (manual, 5.7.2, type A), LinuxCNC to beside the entry and around the corner"},
    {"ccomp/lathe-comp", "cutter compensation in G18 (a lathe)"},
};

std::string GroupOf(const std::string& message) {
  for (const Group& group : kFindings) {
    if (message.find(group.part) != std::string::npos) return std::string(group.reason);
  }
  return "";
}

// The error at which the control stopped, else what was not simulated before the first difference.
const Finding* Cause(const HaasRun& run, int line) {
  const Finding* cause = nullptr;
  for (const Finding& finding : run.findings) {
    const bool stops =
        !run.finished && finding.severity == Severity::kError && finding.rule != Rule::kToolMissing;
    if (stops) cause = &finding;
  }
  if (cause != nullptr) return cause;
  for (const Finding& finding : run.findings) {
    if (finding.rule == Rule::kUnsupportedCode && (line == 0 || finding.where.line <= line)) {
      return &finding;
    }
  }
  return nullptr;
}

std::string Row(const Result& result, bool with_steps) {
  std::string row = "| `" + result.name + "` | " + std::to_string(result.agreed);
  if (with_steps) row += " of " + std::to_string(result.steps);
  return row + " |\n";
}

int Count(const std::vector<Result>& results, Outcome outcome) {
  return static_cast<int>(std::count_if(results.begin(), results.end(),
                                        [&](const Result& r) { return r.outcome == outcome; }));
}

std::string Grouped(const std::vector<Result>& results, Outcome outcome) {
  std::map<std::string, std::vector<const Result*>> groups;
  for (const Result& result : results) {
    if (result.outcome == outcome) groups[result.reason].push_back(&result);
  }
  std::string text;
  for (const auto& [reason, members] : groups) {
    text += "\n**" + reason + "** (" + std::to_string(members.size()) +
            ")\n\n| program | motions that agree |\n|---|---|\n";
    for (const Result* result : members) text += Row(*result, true);
  }
  return text;
}

constexpr std::string_view kIntroduction =
    R"(# Conformance with LinuxCNC's interpreter

Written by `tests/conformance` (`NCSIM_UPDATE_DOCS=1`); the test fails when this page is not what it finds, and when a
program that agreed no longer does.

Programs that nobody here wrote go through the Haas interpreter of ncsim, and through LinuxCNC's (`rs274 -g`, canonical
machining calls). Motions and dwells are held together in order, in machine coordinates, to 1e-4 of the program's unit:
kind, end of all six axes, centre, plane and sweep of arcs, feed, spindle and tool. Offsets, rotation, tool length, plane and
units of the calls are applied. Both get the same text but for spelling: `;` comments, capitals, blanks inside words, block
numbers with a fraction, the decimal point of a dwell's P, and the D of the tool for a G41 or G42 without one. The control is
set so that a setting and not a rule is no difference: 9 as LinuxCNC starts (mm), 15 off, 22 at .010 in, 58 YASNAC, 162 on.

)";

}  // namespace

Result Judge(const std::string& name, const HaasRun& run, const Canon& canon) {
  Result result;
  result.name = name;
  const Comparison comparison = Compare(run.steps, canon.steps);
  result.steps = comparison.steps;
  result.agreed = comparison.agreed;
  result.difference = comparison.difference + " (line " + std::to_string(comparison.line) + ")";
  if (comparison.agree) {
    result.outcome = comparison.steps == 0  ? Outcome::kNoMotion
                     : comparison.loose > 0 ? Outcome::kAgreeButCompEnds
                                            : Outcome::kAgree;
    return result;
  }
  if (const Finding* cause = Cause(run, comparison.line)) {
    result.outcome = Outcome::kNotHaas;
    result.reason = GroupOf(cause->message);
    result.difference += "; " + cause->message;
  } else if (!canon.unknown_call.empty()) {
    result.outcome = Outcome::kNotHaas;
    result.reason = "LinuxCNC goes on with `" + canon.unknown_call + "`";
  }
  if (!result.reason.empty()) return result;
  result.outcome = Outcome::kUnexplained;
  for (const Group& group : kDialect) {
    if (name.find(group.part) == std::string::npos) continue;
    result.outcome = Outcome::kDialect;
    result.reason = std::string(group.reason);
  }
  return result;
}

std::string ToMarkdown(const std::vector<Result>& results) {
  std::string text(kIntroduction);
  long motions = 0;
  for (const Result& result : results) motions += result.agreed;
  const int with_motion = static_cast<int>(results.size()) - Count(results, Outcome::kNoMotion);
  text += "| outcome | programs |\n|---|---|\n";
  text += "| with motions, compared | " + std::to_string(with_motion) + " |\n";
  text += "| agree | " + std::to_string(Count(results, Outcome::kAgree)) + " |\n";
  text += "| agree, but for where cutter compensation is turned on and off | " +
          std::to_string(Count(results, Outcome::kAgreeButCompEnds)) + " |\n";
  text += "| differ, the rules of the two controls being different | " +
          std::to_string(Count(results, Outcome::kDialect)) + " |\n";
  text += "| not a Haas program | " + std::to_string(Count(results, Outcome::kNotHaas)) + " |\n";
  text += "| motions that agree | " + std::to_string(motions) + " |\n";

  text += "\n## Agree\n\n| program | motions |\n|---|---|\n";
  for (const Result& result : results) {
    if (result.outcome == Outcome::kAgree) text += Row(result, false);
  }
  text +=
      "\n## Agree, but for where compensation is turned on and off\n\n"
      "A Haas goes to the point beside the start of the next move (manual, 5.7.2, type A), "
      "LinuxCNC to one beside the entry "
      "itself.\n\n| program | motions |\n|---|---|\n";
  for (const Result& result : results) {
    if (result.outcome == Outcome::kAgreeButCompEnds) text += Row(result, false);
  }
  text += "\n## Differ\n" + Grouped(results, Outcome::kDialect);
  text += "\n## Not a Haas program\n\nThe run reports it: an alarm or `unsupported-code`.\n" +
          Grouped(results, Outcome::kNotHaas);
  return text;
}

}  // namespace ncsim::conformance
