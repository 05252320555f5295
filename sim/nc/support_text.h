// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "sim/nc/code_table.h"

namespace ncsim::nc {

/// "simulated", "no motion effect" ...: the words of the coverage tables.
std::string_view ToString(Support support);

}  // namespace ncsim::nc
