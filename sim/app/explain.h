// SPDX-License-Identifier: BSD-3-Clause
// `ncsim explain`: the entries of docs/findings.md, which is built into the program.
#pragma once

#include <ostream>
#include <string>
#include <string_view>

namespace ncsim::app {

/// docs/findings.md.
std::string_view FindingsText();

/// The entry of a rule, heading included; "" where there is none.
std::string_view FindingsEntry(std::string_view rule);

/// Prints the entry of `rule`, or with "" a line for each rule. Returns an ExitCode.
int Explain(const std::string& rule, std::ostream& out, std::ostream& err);

}  // namespace ncsim::app
