// SPDX-License-Identifier: BSD-3-Clause
// Codes as data: one row a code of the control's manual. Drives interpretation, documentation and
// findings.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ncsim::nc {

enum class Support {
  kSimulated,       ///< Fully: motion and state.
  kNoMotionEffect,  ///< Understood; moves nothing that is checked (coolant, chip conveyor ...).
  kUnsupported,     ///< `unsupported-code`; verdict `unproven`.
  kRejected,        ///< Every software version of the control rejects it: `control-alarm`.
};

struct CodeSpec {
  char address;     ///< 'G' or 'M'.
  int number_x10;   ///< G43.4 = 434, G01 = 10.
  int group;        ///< Modal group; 0 = non-modal. For M codes 0.
  bool is_default;  ///< Power-up state of its group.
  Support support;
  std::string_view words;  ///< Addresses that the code itself may take in its block, besides axes:
                           ///< "PL", "XYRIJK".
  std::string_view meaning;  ///< The manual's words, short.
  std::string_view
      note;  ///< What the simulator does with it, for docs/dialects; "" for kSimulated as stated.
};

/// A control's language.
struct Dialect {
  std::string_view id;    ///< "haas-ngc".
  std::string_view name;  ///< "Haas NGC mill (2017)".
  std::span<const CodeSpec> codes;
  std::string_view notes;  ///< Markdown: how the text is read where the manual leaves it open.
  const CodeSpec* Find(char address, double number) const;
};

const Dialect& HaasNgc();
/// Null for an unknown id.
const Dialect* FindDialect(std::string_view id);
/// The coverage table of docs/dialects, in Markdown.
std::string CoverageTable(const Dialect& dialect);

}  // namespace ncsim::nc
