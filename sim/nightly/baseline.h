// SPDX-License-Identifier: BSD-3-Clause
// Findings that are known and accepted, each with a reason and until a day.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/base/diagnostics.h"
#include "sim/nightly/result.h"

namespace ncsim::nightly {

struct Acceptance {
  std::string program;  ///< Entry::name.
  std::string rule;
  std::string source;   ///< Text of the line; "" for any.
  std::string message;  ///< Part of the message; "" for any.
  std::string reason;
  std::string expires;  ///< "2027-03-01": the last day on which it counts.

  bool Matches(const std::string& of_program, const ReportFinding& finding) const;
};

struct Baseline {
  std::vector<Acceptance> accepted;
};

/// "2026-11-22" and a day of the calendar.
bool IsDay(const std::string& text);

/// docs/nightly.md. nullopt and diagnostics where something is wrong.
std::optional<Baseline> ReadBaseline(const std::string& path, Diagnostics* diagnostics);

}  // namespace ncsim::nightly
