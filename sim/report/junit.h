// SPDX-License-Identifier: BSD-3-Clause
// JUnit XML as Jenkins reads it.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace ncsim::report {

/// Why a case did not pass.
struct JunitProblem {
  bool failure = false;  ///< Else an error: it could not be shown to be right.
  std::string type, message;
  std::vector<std::string> lines;
};

struct JunitCase {
  std::string classname, name;
  std::vector<JunitProblem> problems;
  std::vector<std::string> output;  ///< In words, for system-out.
};

/// A case with a failure counts as one, any other with a problem as an error.
void WriteJunitCases(const std::string& suite, const std::vector<JunitCase>& cases,
                     std::ostream& out);

}  // namespace ncsim::report
