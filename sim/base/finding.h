// SPDX-License-Identifier: BSD-3-Clause
// Findings: the verdict on the machining, as distinct from Diagnostics (trouble reading an input).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ncsim {

enum class Severity { kError, kUnproven, kWarning };
std::string_view ToString(Severity severity);

enum class Rule {
#define NCSIM_RULE(name, id, severity, summary) name,
#include "sim/base/rules.def"
#undef NCSIM_RULE
};

struct RuleInfo {
  Rule rule;
  std::string_view id;       ///< "travel-limit": what people read, and what JSON carries.
  Severity severity;         ///< Default; a check may raise or lower it where the contract says so.
  std::string_view summary;  ///< One line.
};
/// Every rule, in the order of rules.def.
const std::vector<RuleInfo>& Rules();
const RuleInfo& Info(Rule rule);
std::optional<Rule> RuleFromId(std::string_view id);

/// A place in a source text. Line and column count from 1; 0 means "the whole file".
struct SourcePosition {
  int file = 0;  ///< Index into SourceFiles.
  int line = 0;
  int column = 0;
};

/// Names of the texts of a run: the program, and the subprograms that it calls. Grows only.
class SourceFiles {
 public:
  int Add(std::string name);
  int size() const { return static_cast<int>(names_.size()); }
  const std::string& name(int file) const { return names_.at(static_cast<std::size_t>(file)); }

 private:
  std::vector<std::string> names_;
};

/// Axis letters and NC values (mm, deg), in the machine's order.
using AxisReadout = std::vector<std::pair<char, double>>;
/// "X-81.280 Y0.000 B-20.000"
std::string ToString(const AxisReadout& axes);

struct Finding {
  Rule rule = Rule::kSyntax;
  Severity severity = Severity::kError;
  SourcePosition where;
  std::optional<SourcePosition> other;  ///< `compare`: the place in the program it is held against.
  std::string message;                  ///< Lower case, no full stop, value and limit with units.
  std::vector<std::string> bodies;      ///< The pair, for contacts and near misses.
  std::optional<double> clearance_mm;   ///< Minus the depth for a contact.
  AxisReadout axes;                     ///< At the first contact.
  /// Of a contact: where it begins, a point on the surface of each of `bodies` in machine
  /// coordinates, mm (Machine::Coordinates); or empty.
  std::vector<std::array<double, 3>> points;
  std::optional<double> time_s;
  std::optional<SourcePosition> posted_from;  ///< In the cutter-location file, where it is known.
};

/// Makes a finding with the rule's default severity.
Finding MakeFinding(Rule rule, SourcePosition where, std::string message);

/// Something that neither the command line nor the job says, and that the run therefore assumed.
struct Assumption {
  std::string name;  ///< "offset G54", "tool T3", "setting 335": what --assume takes.
  std::string text;  ///< What was assumed, in words.
  bool places_metal =
      false;  ///< True: the best verdict is `unproven` until accepted. False: only under --strict.
  bool accepted = false;
};

enum class Verdict { kPass, kFail, kUnproven };
std::string_view ToString(Verdict verdict);

/// Any error makes `fail`; else any unproven (finding or assumption) makes `unproven`; else `pass`.
Verdict Judge(const std::vector<Finding>& findings, const std::vector<Assumption>& assumptions,
              bool strict);

}  // namespace ncsim
