// SPDX-License-Identifier: BSD-3-Clause
// Numbers and words in messages. Locale-free.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ncsim {

// Of ASCII, whatever the locale.
constexpr bool IsDigit(char c) { return c >= '0' && c <= '9'; }
constexpr char Upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
constexpr bool IsLetter(char c) { return Upper(c) >= 'A' && Upper(c) <= 'Z'; }
std::string Upper(std::string_view text);

/// Fixed notation with `decimals` places; never "-0.000".
std::string Fixed(double value, int decimals);

/// Fixed notation without trailing zeros: 50.8, 120, 0.05.
std::string Short(double value, int max_decimals = 4);

/// The candidate within edit distance max(2, length / 3) of `word`, and below its length; "" where
/// none is near.
std::string Nearest(std::string_view word, const std::vector<std::string>& candidates);

/// " (did you mean 'x'?)", or "".
std::string DidYouMean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace ncsim
