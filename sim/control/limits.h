// SPDX-License-Identifier: BSD-3-Clause
// Internal to sim/control: how far any control goes along with a program.
#pragma once

namespace ncsim::control {

/// Honest programs have tens of part frames; a macro that makes more must not eat memory.
inline constexpr int kMaxPartFrames = 100'000;
/// Findings of one text after its first syntax error, and how far they are looked for.
inline constexpr int kMaxSyntaxFindings = 20;
inline constexpr int kMaxSyntaxLines = 200'000;
/// Of a computed word: what the parsers allow for a written one.
inline constexpr double kMaxWord = 1e9;
/// mm: a length register that differs more from the metal is said.
inline constexpr double kLengthTolerance = 0.5;
/// Beyond this a count of holes or repeats is a mistake, and must not run for hours.
inline constexpr int kMaxHoleRepeats = 10'000;
/// SINUMERIK MD18105, MD18106: standard values.
inline constexpr int kMaxEdge = 12;

}  // namespace ncsim::control
