// SPDX-License-Identifier: BSD-3-Clause
// Inside ncsim: mm, rad, s. These factors are used at a boundary only (URDF metres, NC degrees and
// inches).
#pragma once

#include <limits>
#include <numbers>

namespace ncsim {

inline constexpr double kMmPerInch = 25.4;
inline constexpr double kMmPerMetre = 1000.0;
inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTurn = 2.0 * kPi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr double Radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double Degrees(double radians) { return radians * (180.0 / kPi); }

}  // namespace ncsim
