// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/hole_patterns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/units.h"
#include "sim/control/command_test_util.h"

namespace ncsim::control {
namespace {

using ::testing::HasSubstr;

PatternWords Words(int code, double i, double j_deg, double count) {
  PatternWords words;
  words.code = code;
  words.distance = i;
  words.angle = Radians(j_deg);
  words.count = count;
  return words;
}

TEST(HolePatternsTest, BoltCircle) {
  // Manual O60701: G70 I5. J15. L12: twelve holes, the first 15 degrees from 3 o'clock,
  // counter-clockwise.
  std::string error;
  const auto holes = HolePattern(Words(70, 5, 15, 12), Plane::kXY, At(1, 2, 3), &error);
  ASSERT_TRUE(holes) << error;
  ASSERT_EQ(holes->size(), 12U);
  for (std::size_t n = 0; n < 12; ++n) {
    const double angle = Radians(15.0 + 30.0 * static_cast<double>(n));
    EXPECT_NEAR((*holes)[n][kX], 1 + 5 * std::cos(angle), 1e-12);
    EXPECT_NEAR((*holes)[n][kY], 2 + 5 * std::sin(angle), 1e-12);
    EXPECT_EQ((*holes)[n][kZ], 3);
  }
}

TEST(HolePatternsTest, ArcIsSpacedByK) {
  std::string error;
  PatternWords words = Words(71, 5, 90, 3);
  EXPECT_FALSE(HolePattern(words, Plane::kXY, At(0, 0, 0), &error));
  EXPECT_EQ(error, "G71 needs K, the angle between holes");
  words.spacing = Radians(-90.0);
  const auto holes = HolePattern(words, Plane::kXY, At(0, 0, 0), &error);
  ASSERT_TRUE(holes);
  EXPECT_NEAR((*holes)[0][kY], 5, 1e-12);
  EXPECT_NEAR((*holes)[1][kX], 5, 1e-12);
  EXPECT_NEAR((*holes)[2][kY], -5, 1e-12);
}

TEST(HolePatternsTest, LineStartsWhereTheToolIs) {
  std::string error;
  const auto holes = HolePattern(Words(72, 2, 90, 3), Plane::kZX, At(1, 7, 3), &error);
  ASSERT_TRUE(holes);
  EXPECT_EQ((*holes)[0], At(1, 7, 3));
  EXPECT_NEAR((*holes)[2][kX], 5, 1e-12);  // G18: 90 degrees from Z is X.
  EXPECT_NEAR((*holes)[2][kZ], 3, 1e-12);
}

TEST(HolePatternsTest, WrongWordsAreAlarms) {
  std::string error;
  for (const double count : {0.0, -1.0, 2.5, 1e9, std::nan("")}) {
    EXPECT_FALSE(HolePattern(Words(70, 5, 0, count), Plane::kXY, At(0, 0, 0), &error)) << count;
    EXPECT_THAT(error, HasSubstr("needs L"));
  }
  EXPECT_FALSE(HolePattern(Words(70, 0, 0, 3), Plane::kXY, At(0, 0, 0), &error));
  EXPECT_EQ(error, "G70 needs I greater than 0");
}

}  // namespace
}  // namespace ncsim::control
