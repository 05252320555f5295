// SPDX-License-Identifier: BSD-3-Clause
#include "post/number_format.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ncsim::post {
namespace {

NumberFormat Format(int decimals, int digits, bool point) {
  NumberFormat format;
  format.decimals = decimals;
  format.digits = digits;
  format.point = point;
  return format;
}

TEST(NumberFormatTest, PointAndLeadingZero) {
  // As the UMC-750 program of the corpus prints: X.8154, I-.0067, X2.
  const NumberFormat haas = Format(4, 0, true);
  EXPECT_EQ(Print(haas, 0.81542).text, ".8154");
  EXPECT_EQ(Print(haas, -0.0067).text, "-.0067");
  EXPECT_EQ(Print(haas, 2.0).text, "2.");
  EXPECT_EQ(Print(haas, 10.0).text, "10.");
  EXPECT_EQ(Print(haas, 0.0).text, "0.");
  EXPECT_EQ(Print(Format(3, 1, false), 100.0).text, "100");
  EXPECT_EQ(Print(Format(0, 2, false), 7.0).text, "07");
  EXPECT_EQ(Print(Format(0, 1, false), 1200.4).text, "1200");
}

TEST(NumberFormatTest, TrailingZerosAndSigns) {
  NumberFormat format = Format(3, 1, true);
  format.trailing = 1;
  EXPECT_EQ(Print(format, 0.0).text, "0.0");
  EXPECT_EQ(Print(format, 1.25).text, "1.25");
  format.plus = true;
  EXPECT_EQ(Print(format, 1.0).text, "+1.0");
}

TEST(NumberFormatTest, WhatRoundsToZeroHasNoSign) {
  EXPECT_EQ(Print(Format(3, 0, true), -0.0004).text, "0.");
  EXPECT_FALSE(std::signbit(Print(Format(3, 0, true), -0.0004).value));
}

TEST(NumberFormatTest, TheValueIsThatOfTheText) {
  const NumberFormat format = Format(3, 0, true);
  for (int k = -2000; k < 2000; ++k) {
    const PrintedNumber printed = Print(format, k * 0.01237);
    EXPECT_EQ(printed.value, std::strtod(printed.text.c_str(), nullptr)) << printed.text;
    EXPECT_LE(std::abs(printed.value - k * 0.01237), 0.5 * format.increment() + 1e-12);
  }
}

TEST(NumberFormatTest, NotAboveTheHighest) {
  NumberFormat format = Format(1, 1, true);
  format.highest = 45000.0;
  EXPECT_EQ(Print(format, 1e7).text, "45000.");
}

}  // namespace
}  // namespace ncsim::post
