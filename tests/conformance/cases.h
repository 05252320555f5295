// SPDX-License-Identifier: BSD-3-Clause
// The programs of the corpus for which LinuxCNC's canonical calls are known.
#pragma once

#include <string>
#include <vector>

namespace ncsim::conformance {

struct Case {
  std::string name;       ///< Path in the corpus.
  std::string program;    ///< The file to run; for a program that LinuxCNC needed normalised, the
                          ///< normalised one.
  std::string reference;  ///< The canonical calls.
};

/// By name. `corpus` is the folder; files that are not there are left out.
std::vector<Case> FindCases(const std::string& corpus);

}  // namespace ncsim::conformance
