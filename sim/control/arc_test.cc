// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/arc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/base/units.h"

namespace ncsim::control {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

ArcWords Ijk(std::optional<double> i, std::optional<double> j, std::optional<double> k,
             bool clockwise) {
  return {{i, j, k}, std::nullopt, clockwise};
}
ArcWords Radius(double r, bool clockwise) { return {{}, r, clockwise}; }

std::string ErrorOf(Plane plane, const Vector3d& start, const Vector3d& end,
                    const ArcWords& words) {
  std::string error;
  EXPECT_FALSE(ResolveArc(plane, start, end, words, kHaasArcTolerance, &error).has_value());
  return error;
}

TEST(ArcTest, QuarterFromCentreInEachPlane) {
  // ISO 841: counter-clockwise seen from the positive end of the normal axis: X to Y, Z to X, Y to
  // Z.
  std::string error;
  const struct {
    Plane plane;
    Vector3d start, end;
  } cases[] = {{Plane::kXY, {10, 0, 0}, {0, 10, 0}},
               {Plane::kZX, {0, 0, 10}, {10, 0, 0}},
               {Plane::kYZ, {0, 10, 0}, {0, 0, 10}}};
  for (const auto& c : cases) {
    ArcWords words;
    const PlaneAxes axes = AxesOf(c.plane);
    words.ijk[static_cast<std::size_t>(axes.first)] = -10.0;
    const auto arc = ResolveArc(c.plane, c.start, c.end, words, kHaasArcTolerance, &error);
    ASSERT_TRUE(arc.has_value()) << error;
    EXPECT_NEAR(arc->sweep, 0.5 * kPi, 1e-12);
    EXPECT_NEAR(arc->centre.norm(), 0.0, 1e-12);
    words.clockwise = true;
    EXPECT_NEAR(ResolveArc(c.plane, c.start, c.end, words, 0.01, &error)->sweep, -1.5 * kPi, 1e-12);
  }
}

TEST(ArcTest, RadiusSignPicksTheMinorOrTheMajorArc) {
  std::string error;
  // Chord of 10 on a circle of radius 10: 60 degrees, or 300.
  const auto minor = ResolveArc(Plane::kXY, {0, 0, 0}, {10, 0, 0}, Radius(10, true), 0.01, &error);
  ASSERT_TRUE(minor) << error;
  EXPECT_NEAR(minor->sweep, -kPi / 3.0, 1e-12);
  EXPECT_NEAR(minor->centre.y(), -std::sqrt(75.0), 1e-12);
  const auto major = ResolveArc(Plane::kXY, {0, 0, 0}, {10, 0, 0}, Radius(-10, true), 0.01, &error);
  ASSERT_TRUE(major) << error;
  EXPECT_NEAR(major->sweep, -5.0 * kPi / 3.0, 1e-12);
  EXPECT_NEAR(major->centre.y(), std::sqrt(75.0), 1e-12);
}

TEST(ArcTest, RadiusAndCentreFormsAgree) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(0.05, 2.0 * kPi - 0.05);
  for (int n = 0; n < 500; ++n) {
    const double a0 = angle(random), sweep = angle(random), radius = 1.0 + 20.0 * angle(random);
    const bool clockwise = n % 2 == 0;
    const double a1 = clockwise ? a0 - sweep : a0 + sweep;
    const Vector3d centre(3, -4, 1);
    const Vector3d start = centre + radius * Vector3d(std::cos(a0), std::sin(a0), 0);
    const Vector3d end = centre + radius * Vector3d(std::cos(a1), std::sin(a1), 0);
    std::string error;
    const auto by_r = ResolveArc(Plane::kXY, start, end,
                                 Radius(sweep > kPi ? -radius : radius, clockwise), 0.01, &error);
    ASSERT_TRUE(by_r) << error;
    EXPECT_NEAR((by_r->centre - centre).norm(), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(by_r->sweep), sweep, 1e-6);
  }
}

TEST(ArcTest, NoEndPointIsAFullCircleWithCentreOnly) {
  std::string error;
  const Vector3d start(3, 4, 0);
  const auto arc = ResolveArc(Plane::kXY, start, start, Ijk(3, 4, {}, true), 0.01, &error);
  ASSERT_TRUE(arc) << error;
  EXPECT_TRUE(arc->full_circle);
  EXPECT_DOUBLE_EQ(arc->sweep, -2.0 * kPi);
  EXPECT_NEAR(arc->start_radius, 5.0, 1e-12);
  EXPECT_THAT(ErrorOf(Plane::kXY, start, start, Radius(5, true)), HasSubstr("full circle"));
}

TEST(ArcTest, EndRadiusWithinTheToleranceOnly) {
  std::string error;
  // Haas alarm 304: 0.01 mm.
  EXPECT_TRUE(
      ResolveArc(Plane::kXY, {10, 0, 0}, {0, 10.0099, 0}, Ijk(-10, 0, {}, false), 0.01, &error));
  EXPECT_EQ(ErrorOf(Plane::kXY, {10, 0, 0}, {0, 10.0101, 0}, Ijk(-10, 0, {}, false)),
            "the end point is not on the arc: radius 10 mm at the start, 10.0101 mm at the end "
            "(limit 0.01 mm apart)");
}

TEST(ArcTest, RadiusMustReachTheEnd) {
  std::string error;
  EXPECT_TRUE(ResolveArc(Plane::kXY, {0, 0, 0}, {20, 0, 0}, Radius(9.996, true), 0.01, &error));
  EXPECT_THAT(ErrorOf(Plane::kXY, {0, 0, 0}, {20, 0, 0}, Radius(9.99, true)),
              HasSubstr("does not reach"));
}

TEST(ArcTest, LettersOfThePlaneOnly) {
  // Manual, G02/G03: "Only the I, J, or K specific to the selected plane are allowed".
  EXPECT_EQ(ErrorOf(Plane::kXY, {10, 0, 0}, {0, 10, 0}, Ijk(-10, {}, 1, false)),
            "K is not a letter of an arc in G17");
  EXPECT_THAT(ErrorOf(Plane::kZX, {10, 0, 0}, {0, 10, 0}, Ijk(-10, 1, {}, false)),
              HasSubstr("J is not"));
  EXPECT_EQ(ErrorOf(Plane::kYZ, {0, 0, 0}, {0, 10, 0}, Ijk({}, {}, {}, false)),
            "an arc needs R, or J and K");
  EXPECT_THAT(ErrorOf(Plane::kXY, {0, 0, 0}, {0, 10, 0}, Ijk(0, 0, {}, false)),
              HasSubstr("radius of the arc is 0"));
  ArcWords both = Ijk(1, 0, {}, false);
  both.r = 1;
  EXPECT_THAT(ErrorOf(Plane::kXY, {0, 0, 0}, {0, 10, 0}, both), HasSubstr("R as well as"));
}

TEST(ArcTest, HostileNumbersAreErrors) {
  const double nan = std::nan(""), huge = 1e308;
  EXPECT_FALSE(ErrorOf(Plane::kXY, {0, 0, 0}, {nan, 10, 0}, Ijk(1, 0, {}, false)).empty());
  EXPECT_FALSE(ErrorOf(Plane::kXY, {0, 0, 0}, {1, 10, 0}, Ijk(nan, 0, {}, false)).empty());
  EXPECT_FALSE(
      ErrorOf(Plane::kXY, {0, 0, 0}, {huge, huge, 0}, Ijk(huge, -huge, {}, false)).empty());
  EXPECT_FALSE(ErrorOf(Plane::kXY, {0, 0, 0}, {1, 10, 0}, Radius(nan, false)).empty());
}

TEST(ArcTest, CommandKeepsTheArc) {
  Command command;
  command.end = {0, 10, 5, 0, 0, 0};
  std::string error;
  ASSERT_TRUE(MakeArc({10, 0, 0, 0, 0, 0}, Ijk(-10, {}, {}, false), 0.01, &command, &error));
  EXPECT_EQ(command.kind, CommandKind::kArc);
  EXPECT_NEAR(ArcOf({10, 0, 0, 0, 0, 0}, command).sweep, 0.5 * kPi, 1e-12);
}

}  // namespace
}  // namespace ncsim::control
