// SPDX-License-Identifier: BSD-3-Clause
// HOLES1 (row), HOLES2 (circle) and CYCLE801 (grid): positions in the plane (NC programming
// 12/2019, "Programming cycles externally").
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/control/command.h"
#include "sim/control/sinumerik_cycle_arguments.h"
#include "sim/control/sinumerik_drilling.h"

namespace ncsim::control {

bool IsHolePattern(std::string_view cycle);

/// The positions in the cycle's own order, at the level of `position`. nullopt: `alarm` or
/// `unsupported` says why.
std::optional<std::vector<AxisValues>> SinumerikHoles(const SinumerikCycleArguments& arguments,
                                                      Plane plane, const AxisValues& position,
                                                      SinumerikCycleAlarm* alarm,
                                                      std::string* unsupported);

}  // namespace ncsim::control
