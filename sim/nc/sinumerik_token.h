// SPDX-License-Identifier: BSD-3-Clause
// Internal to sim/nc: names, numbers and strings of the SINUMERIK language.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/nc/scanner.h"

namespace ncsim::nc {

/// Of INT: 32 bits and a sign.
inline constexpr double kMaxInteger = 2147483647.0;
/// Characters of a STRING without a length of its own.
inline constexpr std::size_t kMaxString = 200;

constexpr bool IsNameStart(char c) { return IsLetter(c) || c == '_'; }
constexpr bool IsNamePart(char c) { return IsNameStart(c) || IsDigit(c); }

/// `upper` has no lower case letters.
bool SameName(std::string_view name, std::string_view upper);
std::string UpperName(std::string_view name);

/// Characters of a block before its comment (NC programming 12/2019, p. 43).
inline constexpr std::size_t kMaxSinumerikBlock = 512;
/// NC programming 12/2019, p. 46: names have at most 31 characters.
inline constexpr std::size_t kMaxSinumerikName = 31;

/// A message as the control's user looks it up: "text (alarm 12080)".
std::string AlarmText(int alarm, std::string text);

/// The name at the scanner: two letters or underscores (`$` before them for system variables), then
/// also digits; "" where none stands here. Does not advance.
std::string_view PeekName(const Scanner& scanner);

struct SinumerikNumber {
  double value = 0.0;
  bool is_integer = false;  ///< Without point and exponent: an INT.
};

/// `12`, `12.5`, `.5`, `1.5EX-3`: no sign. Returns "" or what is wrong, with the alarm; stands
/// behind what was read.
std::string ReadSinumerikNumber(Scanner* scanner, SinumerikNumber* number);
/// At a quote: `'H1F'`, `'B1010'`.
std::string ReadSinumerikBits(Scanner* scanner, SinumerikNumber* number);
/// At a double quote: the text between two of them.
std::string ReadSinumerikString(Scanner* scanner, std::string_view* text);

}  // namespace ncsim::nc
