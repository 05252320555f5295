// SPDX-License-Identifier: BSD-3-Clause
// Internal to sim/nc: a position in one line of NC text, and the numbers that can be read there.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

#include "sim/base/text.h"

namespace ncsim::nc {

constexpr bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
constexpr bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }

/// Larger numbers are no value of any axis, offset or variable, and are refused, so that what reads
/// them may count on a number that fits an int.
inline constexpr double kMaxNumber = 1e9;

enum class NumberStatus { kOk, kNoDigits, kTooLarge };

struct Number {
  double value = 0.0;
  bool has_point = false;
  std::uint16_t digits = 0;  ///< Saturates.
};

/// One line: ends at LF, CR or the end of the text, whichever comes first.
class Scanner {
 public:
  Scanner(std::string_view text, std::size_t offset)
      : begin_(text.data() + offset), p_(begin_), end_(text.data() + text.size()) {}

  bool AtEnd() const { return p_ == end_ || IsLineEnd(*p_); }
  /// The character here; a line feed at the line's end.
  char Peek() const { return p_ == end_ ? '\n' : *p_; }
  char PeekAfter(std::size_t n) const {
    return static_cast<std::size_t>(end_ - p_) > n ? p_[n] : '\n';
  }
  void Advance() { ++p_; }
  void Advance(std::size_t n) { p_ += n; }
  void SkipSpaces() {
    while (p_ != end_ && IsSpace(*p_)) ++p_;
  }
  void SkipToLineEnd() {
    while (!AtEnd()) ++p_;
  }
  /// Past CR LF, LF or CR; call at the line's end.
  void SkipLineEnd() {
    if (p_ == end_) return;
    const bool carriage_return = *p_ == '\r';
    ++p_;
    if (carriage_return && p_ != end_ && *p_ == '\n') ++p_;
  }

  const char* position() const { return p_; }
  int column() const { return static_cast<int>(p_ - begin_) + 1; }
  std::size_t consumed() const { return static_cast<std::size_t>(p_ - begin_); }

  /// True, and past it, if the text here is `upper` in any case.
  bool Take(std::string_view upper) {
    if (static_cast<std::size_t>(end_ - p_) < upper.size()) return false;
    for (std::size_t i = 0; i < upper.size(); ++i) {
      if (Upper(p_[i]) != upper[i]) return false;
    }
    p_ += upper.size();
    return true;
  }

  /// A block number: up to nine digits; -1 for none or more. Stands behind all of them.
  long ReadDigits() {
    long value = 0;
    int digits = 0;
    for (; IsDigit(Peek()); Advance()) {
      if (++digits <= 9) value = value * 10 + (Peek() - '0');
    }
    return digits == 0 || digits > 9 ? -1 : value;
  }

  /// "12", "12.", ".5", "1.25": no sign, no exponent. Stands after the last digit or point,
  /// whatever the status. A value above `limit` is kTooLarge.
  NumberStatus ReadNumber(Number* number, double limit = kMaxNumber) {
    constexpr std::array<double, 16> kPower = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    const char* start = p_;
    std::uint64_t mantissa = 0;
    while (p_ != end_ && IsDigit(*p_))
      mantissa = mantissa * 10 + static_cast<unsigned>(*p_++ - '0');
    std::size_t digits = static_cast<std::size_t>(p_ - start);
    std::size_t decimals = 0;
    number->has_point = p_ != end_ && *p_ == '.';
    if (number->has_point) {
      const char* fraction = ++p_;
      while (p_ != end_ && IsDigit(*p_)) {
        mantissa = mantissa * 10 + static_cast<unsigned>(*p_++ - '0');
      }
      decimals = static_cast<std::size_t>(p_ - fraction);
      digits += decimals;
    }
    if (digits == 0) return NumberStatus::kNoDigits;
    number->digits = static_cast<std::uint16_t>(digits < 0xffff ? digits : 0xffff);
    if (digits <= 15) {
      // Mantissa and power are exact doubles: one division rounds once, as from_chars does.
      number->value = static_cast<double>(mantissa);
      if (decimals != 0) number->value /= kPower[decimals];
      return number->value > limit ? NumberStatus::kTooLarge : NumberStatus::kOk;
    }
    const auto result = std::from_chars(start, p_, number->value, std::chars_format::fixed);
    if (result.ec != std::errc() || number->value > limit) return NumberStatus::kTooLarge;
    return NumberStatus::kOk;
  }

 private:
  const char* begin_;
  const char* p_;
  const char* end_;
};

/// What a message may print of a character of the text: itself in quotes, or its code.
inline std::string Quoted(char c) {
  if (c > ' ' && c < '\x7f') return std::string("'") + c + "'";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("byte 0x") + kHex[byte >> 4] + kHex[byte & 15];
}

}  // namespace ncsim::nc
