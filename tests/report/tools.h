// SPDX-License-Identifier: BSD-3-Clause
// Programs of others that a test calls. What is not installed is said, and .ci/run installs it.
#pragma once

#include <string>

namespace ncsim::report {

struct Said {
  int exit_code = -1;
  std::string text;  ///< Standard output and error.
};

/// Runs a command line of the shell.
Said RunShell(const std::string& command);
/// Quoted for RunShell().
std::string Quoted(const std::string& word);

/// "" where the npm packages of tests/report/package.json are there, else what is missing.
std::string WhyNoPackages();
/// Runs tests/report/SCRIPT with node; `arguments` as the shell reads them.
Said RunNode(const std::string& script, const std::string& arguments);

/// "" where xmllint is there, else what is missing.
std::string WhyNoXmllint();

}  // namespace ncsim::report
