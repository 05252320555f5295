// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/code_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/nc/support_text.h"

namespace ncsim::nc {
namespace {

std::string CodeName(const CodeSpec& spec) {
  const int whole = spec.number_x10 / 10;
  std::string name(1, spec.address);
  if (whole < 10) name += '0';
  name += std::to_string(whole);
  if (spec.number_x10 % 10 != 0) name += '.' + std::to_string(spec.number_x10 % 10);
  return name;
}

std::string SpacedWords(std::string_view words) {
  std::string text;
  for (const char word : words) {
    if (!text.empty()) text += ' ';
    text += word;
  }
  return text;
}

std::string Row(const CodeSpec& spec) {
  std::string row = "| " + CodeName(spec) + " | ";
  if (spec.address == 'G') {
    const std::string group = std::to_string(spec.group);
    row += (group.size() == 1 ? "0" + group : group) + (spec.is_default ? " *" : "") + " | ";
  }
  row += std::string(spec.meaning) + " | " + SpacedWords(spec.words) + " | ";
  row += std::string(ToString(spec.support)) + " | " + std::string(spec.note) + " |\n";
  return row;
}

}  // namespace

std::string_view ToString(Support support) {
  switch (support) {
    case Support::kSimulated:
      return "simulated";
    case Support::kNoMotionEffect:
      return "no motion effect";
    case Support::kUnsupported:
      return "unsupported";
    case Support::kRejected:
      return "alarm";
  }
  return "";
}

const CodeSpec* Dialect::Find(char address, double number) const {
  constexpr double kHighest = 9999.0;
  if (!(number >= 0.0 && number <= kHighest)) return nullptr;
  const double scaled = number * 10.0;
  const int number_x10 = static_cast<int>(std::lround(scaled));
  if (std::abs(scaled - number_x10) > 1e-6) return nullptr;
  const auto before = [](const CodeSpec& spec, const std::pair<char, int>& key) {
    return std::pair(spec.address, spec.number_x10) < key;
  };
  const auto found =
      std::lower_bound(codes.begin(), codes.end(), std::pair(address, number_x10), before);
  const bool hit =
      found != codes.end() && found->address == address && found->number_x10 == number_x10;
  return hit ? &*found : nullptr;
}

const Dialect* FindDialect(std::string_view id) {
  return id == HaasNgc().id ? &HaasNgc() : nullptr;
}

std::string CoverageTable(const Dialect& dialect) {
  std::string text = "# " + std::string(dialect.name) + "\n\n";
  text +=
      "Every G and M code of the control's manual, and what ncsim does with it. This page is "
      "printed from the table that\n"
      "drives the interpreter (`sim/nc/`), and a test holds the two together.\n\n"
      "- **simulated**: motion and state are computed as the manual describes them.\n"
      "- **no motion effect**: understood; moves nothing that is checked.\n"
      "- **unsupported**: reported as `unsupported-code`; the verdict is at best `unproven`.\n"
      "- **alarm**: every software version of the control stops here; reported as "
      "`control-alarm`.\n\n"
      "A code that is not listed is reported as well: nothing is ignored in silence. `*` marks "
      "what is active at power-up.\n"
      "\"Words\" are those that belong to the code, beside axis words, F, S and T.\n\n"
      "## G codes\n\n"
      "| code | group | meaning | words | ncsim | note |\n"
      "|---|---|---|---|---|---|\n";
  for (const CodeSpec& spec : dialect.codes) {
    if (spec.address == 'G') text += Row(spec);
  }
  text += "\n## M codes\n\n| code | meaning | words | ncsim | note |\n|---|---|---|---|---|\n";
  for (const CodeSpec& spec : dialect.codes) {
    if (spec.address == 'M') text += Row(spec);
  }
  if (!dialect.notes.empty()) text += "\n" + std::string(dialect.notes);
  return text;
}

}  // namespace ncsim::nc
