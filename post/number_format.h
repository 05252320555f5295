// SPDX-License-Identifier: BSD-3-Clause
// How a number becomes text, and what a control reads in that text.
#pragma once

#include <optional>
#include <string>

namespace ncsim::post {

/// Numbers are in the program's unit: mm or inch, degrees, 1/min.
struct NumberFormat {
  std::string name;               ///< In [formats].
  int decimals = 3;               ///< The increment is 10^-decimals.
  int digits = 1;                 ///< Least number before the point: 2 prints 07, 0 prints .5
  int trailing = 0;               ///< Decimals that stay where they are zero: 1 prints 2.0
  bool point = true;              ///< A whole number keeps its point: 2.
  bool plus = false;              ///< +2.
  std::optional<double> highest;  ///< Greater numbers print as this one.

  double increment() const;
};

struct PrintedNumber {
  std::string text;
  double value = 0.0;  ///< Of the text.
};
/// Rounds to the format's increment. Zero has no sign.
PrintedNumber Print(const NumberFormat& format, double value);

}  // namespace ncsim::post
