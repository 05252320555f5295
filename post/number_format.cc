// SPDX-License-Identifier: BSD-3-Clause
#include "post/number_format.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/base/text.h"

namespace ncsim::post {

double NumberFormat::increment() const { return std::pow(10.0, -decimals); }

PrintedNumber Print(const NumberFormat& format, double value) {
  if (format.highest) value = std::min(value, *format.highest);
  std::string text = Fixed(value, format.decimals);
  PrintedNumber printed;
  std::from_chars(text.data(), text.data() + text.size(), printed.value);

  const bool negative = text.front() == '-';
  if (negative) text.erase(0, 1);
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string whole = text.substr(0, point);
  std::string fraction = point < text.size() ? text.substr(point + 1) : "";
  while (fraction.size() > static_cast<std::size_t>(format.trailing) && fraction.back() == '0') {
    fraction.pop_back();
  }
  if (whole == "0" && format.digits == 0 && !fraction.empty() && printed.value != 0.0) whole = "";
  while (whole.size() < static_cast<std::size_t>(format.digits)) whole.insert(0, 1, '0');

  if (negative) {
    printed.text = "-";
  } else if (format.plus) {
    printed.text = "+";
  }
  printed.text += whole;
  if (!fraction.empty() || format.point) printed.text += '.';
  printed.text += fraction;
  return printed;
}

}  // namespace ncsim::post
