// SPDX-License-Identifier: BSD-3-Clause
// From the parameters of CYCLE81 to CYCLE89 and CYCLE840 to what they mean.
#pragma once

#include <optional>
#include <string>

#include "sim/control/command.h"
#include "sim/control/sinumerik_cycle_arguments.h"
#include "sim/control/sinumerik_drilling.h"

namespace ncsim::control {

/// What the program has in force where a cycle is called.
struct SinumerikCycleState {
  Plane plane = Plane::kXY;
  double rpm = 0.0;
  double feed = 0.0;       ///< F, mm/s.
  double feed_unit = 0.0;  ///< mm/s of a feed of 1 as F would be programmed.
};

struct SinumerikDrillCall {
  SinumerikDrilling words;
  /// What the cycle makes of the spindle: its turning while the hole is made, and after; +1 M3, -1
  /// M4, 0 stopped; nullopt: it lets the spindle be.
  std::optional<int> spindle, spindle_after;
  bool reads_percent = false;  ///< DAM or FRF of CYCLE83 are taken as percent.
};

/// nullopt: either `alarm` has a number, or `unsupported` says which parameter changes the geometry
/// in a way that is not simulated ("_AMODE = 11211111").
std::optional<SinumerikDrillCall> ReadDrilling(const SinumerikCycleArguments& arguments,
                                               const SinumerikCycleState& state,
                                               SinumerikCycleAlarm* alarm,
                                               std::string* unsupported);

/// False: `unsupported` says which. `_DMODE`: units the plane (0 as it is), else 0.
bool CheckDisplayMode(const SinumerikCycleArguments& arguments, Plane plane,
                      std::string* unsupported);
/// False where one of the parameters (blanks between) is given and neither 0 nor "".
bool CheckAllZero(const SinumerikCycleArguments& arguments, std::string_view parameters,
                  std::string* unsupported);

}  // namespace ncsim::control
