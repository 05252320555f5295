// SPDX-License-Identifier: BSD-3-Clause
// The table of each dialect's settings. Private to this folder.
#pragma once

#include <vector>

#include "sim/machine/settings.h"

namespace ncsim::machine {

/// NGC Mill Operator's Manual 2017, "Settings".
std::vector<Setting> HaasSettings();
/// Machine and setting data by their numbers (List Manual, machine data).
std::vector<Setting> SinumerikSettings();

}  // namespace ncsim::machine
