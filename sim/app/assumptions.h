// SPDX-License-Identifier: BSD-3-Clause
// What a run assumed, and what the user accepts of it.
#pragma once

#include <string>
#include <vector>

#include "sim/base/finding.h"

namespace ncsim::app {

/// Adds `assumption`, or, where one of its name is there, keeps the graver of the two.
void Assume(Assumption assumption, std::vector<Assumption>* assumptions);

/// Marks what `names` accept ("all", or names of assumptions in any case of letters). Returns the
/// names that nothing in the run goes by.
std::vector<std::string> Accept(const std::vector<std::string>& names,
                                std::vector<Assumption>* assumptions);

/// An `assumed` finding, on the whole program, for each assumption that keeps the verdict from
/// being `pass`.
std::vector<Finding> OpenAssumptions(const std::vector<Assumption>& assumptions, bool strict);

}  // namespace ncsim::app
