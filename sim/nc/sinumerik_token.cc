// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_token.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

namespace ncsim::nc {
namespace {

constexpr double kMaxReal = 1e300;  // NC programming 12/2019, p. 61: REAL, 10^-300 to 10^+300.

int HexDigit(char c) {
  if (IsDigit(c)) return c - '0';
  const char upper = Upper(c);
  return upper >= 'A' && upper <= 'F' ? upper - 'A' + 10 : -1;
}

/// `EX-3` behind the mantissa, which began at `mantissa`.
std::string ReadExponent(Scanner* scanner, const char* mantissa, SinumerikNumber* number) {
  constexpr std::size_t kMaxDigits = 64;
  constexpr std::size_t kMaxExponentDigits = 4;
  std::string text(mantissa, static_cast<std::size_t>(scanner->position() - mantissa));
  scanner->Advance(2);
  text += 'e';
  if (scanner->Peek() == '-' || scanner->Peek() == '+') {
    if (scanner->Peek() == '-') text += '-';
    scanner->Advance();
  }
  std::size_t digits = 0;
  for (; IsDigit(scanner->Peek()); scanner->Advance()) {
    if (digits++ < kMaxExponentDigits) text += scanner->Peek();
  }
  if (digits == 0) return AlarmText(12080, "EX has no digits behind it");
  if (text.size() > kMaxDigits || digits > kMaxExponentDigits) {
    return AlarmText(12160, "the number has more digits than the control reads");
  }
  number->is_integer = false;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number->value);
  // A value below the range counts as 0, as the nearest one that there is.
  if (result.ec == std::errc::result_out_of_range && text.find('-') != std::string::npos) {
    number->value = 0.0;
    return "";
  }
  if (result.ec != std::errc() || number->value > kMaxReal) {
    return AlarmText(12160, "the number is beyond the range of REAL");
  }
  return "";
}

}  // namespace

bool SameName(std::string_view name, std::string_view upper) {
  if (name.size() != upper.size()) return false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (Upper(name[i]) != upper[i]) return false;
  }
  return true;
}

std::string UpperName(std::string_view name) {
  std::string upper(name);
  for (char& c : upper) c = Upper(c);
  return upper;
}

std::string AlarmText(int alarm, std::string text) {
  return std::move(text) + " (alarm " + std::to_string(alarm) + ")";
}

std::string_view PeekName(const Scanner& scanner) {
  std::size_t size = 0;
  while (scanner.PeekAfter(size) == '$' && size < 2) ++size;
  const std::size_t prefix = size;
  if (!IsNameStart(scanner.PeekAfter(size))) return {};
  while (IsNamePart(scanner.PeekAfter(size))) ++size;
  // `X1` is an address with its number, `$R1` a name.
  if (prefix == 0 && (size < 2 || !IsNameStart(scanner.PeekAfter(1)))) return {};
  return {scanner.position(), size};
}

std::string ReadSinumerikNumber(Scanner* scanner, SinumerikNumber* number) {
  const char* mantissa = scanner->position();
  Number read;
  switch (scanner->ReadNumber(&read, kMaxReal)) {
    case NumberStatus::kOk:
      break;
    case NumberStatus::kNoDigits:
      return AlarmText(12080, "a '.' without digits");
    case NumberStatus::kTooLarge:
      return AlarmText(12160, "the number is beyond the range of REAL");
  }
  number->value = read.value;
  number->is_integer = !read.has_point;
  if (Upper(scanner->Peek()) == 'E' && Upper(scanner->PeekAfter(1)) == 'X') {
    return ReadExponent(scanner, mantissa, number);
  }
  if (number->is_integer && number->value > kMaxInteger) {
    return AlarmText(12160, "the number is beyond the range of INT");
  }
  return "";
}

std::string ReadSinumerikBits(Scanner* scanner, SinumerikNumber* number) {
  constexpr std::size_t kMaxBits = 32;
  scanner->Advance();
  const char base = Upper(scanner->Peek());
  if (base != 'H' && base != 'B') {
    return AlarmText(12080, "a constant in ' ' must begin with H or B");
  }
  scanner->Advance();
  const int highest = base == 'H' ? 15 : 1;
  const std::size_t bits_a_digit = base == 'H' ? 4 : 1;
  std::uint64_t value = 0;
  std::size_t bits = 0;
  std::size_t digits = 0;
  std::string error;
  for (; !scanner->AtEnd() && scanner->Peek() != '\''; scanner->Advance()) {
    const int digit = HexDigit(scanner->Peek());
    ++digits;
    if (digit < 0 || digit > highest) {
      if (error.empty()) {
        error = AlarmText(
            12080, Quoted(scanner->Peek()) + " is no digit of a constant in '" + base + "...'");
      }
      continue;
    }
    if (bits > 0 || digit != 0) bits += bits_a_digit;
    value = value << bits_a_digit | static_cast<unsigned>(digit);
  }
  if (scanner->AtEnd()) return AlarmText(12080, "the constant is never closed: ' is missing");
  scanner->Advance();
  if (!error.empty()) return error;
  if (digits == 0) return AlarmText(12080, "a constant without digits");
  if (bits > kMaxBits) {
    return AlarmText(base == 'H' ? 12230 : 12220, "the constant has more than 32 bits");
  }
  // INT has 32 bits and a sign: 'HFFFFFFFF' is -1.
  number->value = static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
  number->is_integer = true;
  return "";
}

std::string ReadSinumerikString(Scanner* scanner, std::string_view* text) {
  scanner->Advance();
  const char* begin = scanner->position();
  while (!scanner->AtEnd() && scanner->Peek() != '"') scanner->Advance();
  *text = {begin, static_cast<std::size_t>(scanner->position() - begin)};
  if (scanner->AtEnd()) return AlarmText(12080, "the string is never closed: \" is missing");
  scanner->Advance();
  if (text->size() > kMaxString) {
    return AlarmText(12210, "the string has more than 200 characters");
  }
  return "";
}

}  // namespace ncsim::nc
