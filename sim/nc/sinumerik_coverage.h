// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ncsim::nc {

/// The coverage table of the SINUMERIK in docs/dialects, in Markdown.
std::string SinumerikCoverageTable();

}  // namespace ncsim::nc
