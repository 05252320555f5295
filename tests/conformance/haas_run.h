// SPDX-License-Identifier: BSD-3-Clause
// A program through ncsim's Haas interpreter on a plain machine, as steps.
#pragma once

#include <string>
#include <vector>

#include "sim/base/finding.h"
#include "tests/conformance/canon_step.h"

namespace ncsim::conformance {

struct HaasRun {
  std::vector<Step> steps;
  std::vector<Finding> findings;
  bool finished = false;
};

struct HaasRunOptions {
  std::vector<std::string> subprogram_folders;
  bool yasnac_corners =
      false;  ///< Setting 58; LinuxCNC's compensation goes around outside corners on arcs.
};

/// Spelling only, so that both read the same program: `;` comments, block numbers with a fraction
/// and blanks inside words are dropped, letters are capitals, the P of a dwell gets its decimal
/// point (LinuxCNC counts seconds, a Haas milliseconds without one), and G41 or G42 without a D
/// gets that of the tool, which LinuxCNC means.
std::string Normalise(const std::string& text);

/// X Y Z A B C, no limits, home at 0, no tool-change pose; tools T1 to T99 of (50 + n) in with a
/// diameter of 1 in, as rs274 read its table; settings 15 off and 162 on, and setting 9 as the
/// program says, else millimetres, where LinuxCNC starts.
HaasRun RunHaas(const std::string& name, const std::string& text, const HaasRunOptions& options);

}  // namespace ncsim::conformance
