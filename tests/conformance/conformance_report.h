// SPDX-License-Identifier: BSD-3-Clause
// What the comparison with LinuxCNC found, sorted, and as docs/conformance.md.
#pragma once

#include <string>
#include <vector>

#include "tests/conformance/canon_reader.h"
#include "tests/conformance/haas_run.h"

namespace ncsim::conformance {

enum class Outcome {
  kAgree,
  kAgreeButCompEnds,  ///< All but where cutter compensation is turned on and off.
  kDialect,           ///< Both ran it; the two controls' rules differ.
  kNotHaas,           ///< A Haas does not take the program, or a word of it.
  kNoMotion,          ///< Nothing to compare.
  kUnexplained,       ///< A difference without a reason: a test failure.
};

struct Result {
  std::string name;
  Outcome outcome = Outcome::kUnexplained;
  int steps = 0, agreed = 0;
  std::string reason;      ///< The group of the table.
  std::string difference;  ///< The first one, or the finding; for whoever has to explain it.
};

Result Judge(const std::string& name, const HaasRun& run, const Canon& canon);

/// The text of docs/conformance.md.
std::string ToMarkdown(const std::vector<Result>& results);

}  // namespace ncsim::conformance
