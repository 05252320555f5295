// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/text.h"

#include <gtest/gtest.h>

#include <clocale>

namespace ncsim {
namespace {

TEST(TextTest, FixedRoundsAndNeverPrintsMinusZero) {
  EXPECT_EQ(Fixed(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(Fixed(-0.0004, 3), "0.000");
  EXPECT_EQ(Fixed(-0.0006, 3), "-0.001");
  EXPECT_EQ(Fixed(1e300, 0).size(), 301u);
}

TEST(TextTest, ShortDropsTrailingZeros) {
  EXPECT_EQ(Short(50.8), "50.8");
  EXPECT_EQ(Short(120.0), "120");
  EXPECT_EQ(Short(0.05), "0.05");
  EXPECT_EQ(Short(-0.00001), "0");
  EXPECT_EQ(Short(100.0, 0), "100");
}

TEST(TextTest, NumbersDoNotFollowTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(Short(0.5), "0.5");
  std::setlocale(LC_ALL, before.c_str());
}

TEST(TextTest, SuggestsOnlyWhatIsNear) {
  const std::vector<std::string> words = {"length", "diameter", "holder"};
  EXPECT_EQ(Nearest("lenght", words), "length");
  EXPECT_EQ(Nearest("diametre", words), "diameter");
  EXPECT_EQ(Nearest("corner_radius", words), "");
  EXPECT_EQ(DidYouMean("holdr", words), " (did you mean 'holder'?)");
  EXPECT_EQ(DidYouMean("xyz", words), "");
  EXPECT_EQ(Nearest("U", {"X", "Y"}), "");  // one letter is as near to any other
  EXPECT_EQ(Nearest("cm", {"mm", "inch"}), "mm");
}

}  // namespace
}  // namespace ncsim
