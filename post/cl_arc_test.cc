// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_arc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/base/units.h"

namespace ncsim::post {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

struct Made {
  std::optional<ClArc> arc;
  std::string error;
};

Made Make(const Vector3d& start, const std::vector<Vector3d>& points, const Vector3d& centre,
          const Vector3d& normal, std::optional<double> radius = {},
          std::optional<int> times = {}) {
  Made made;
  ClArcBuilder builder(start, centre, normal.normalized(), radius, times);
  for (const Vector3d& point : points) {
    if (!builder.Add(point, &made.error)) return made;
  }
  made.arc = builder.Finish(&made.error);
  return made;
}

const Vector3d kZ = Vector3d::UnitZ();

// A corner arc of a NX part in inch, whose commercial post printed G03: counter-clockwise, a small
// angle.
TEST(ClArcTest, CornerArcOfAPart) {
  const Vector3d centre(2.7423, 2.7199, 0), start(2.7950, 2.7950, 0), end(2.7364, 2.8115, 0);
  const Made made = Make(start * 25.4, {end * 25.4}, centre * 25.4, kZ);
  ASSERT_TRUE(made.arc) << made.error;
  EXPECT_NEAR(Degrees(made.arc->sweep), 38.74, 0.01);
  const Made other = Make(start * 25.4, {end * 25.4}, centre * 25.4, -kZ);
  EXPECT_NEAR(Degrees(other.arc->sweep), 321.26, 0.01);
}

TEST(ClArcTest, QuarterHalfAndWholeTurn) {
  const Vector3d start(10, 0, 5);
  EXPECT_NEAR(Make(start, {{0, 10, 5}}, {0, 0, 5}, kZ).arc->sweep, kPi / 2, 1e-12);
  EXPECT_NEAR(Make(start, {{0, 10, 5}}, {0, 0, 5}, -kZ).arc->sweep, 3 * kPi / 2, 1e-12);
  EXPECT_NEAR(Make(start, {{-10, 0, 5}}, {0, 0, 5}, kZ).arc->sweep, kPi, 1e-12);
  EXPECT_EQ(Make(start, {start}, {0, 0, 5}, kZ).arc->sweep, 2 * kPi);
  EXPECT_EQ(Make(start, {start}, {0, 0, 5}, kZ, 10.0, 3).arc->sweep, 6 * kPi);
}

// In a plane of any tilt: turned by the rotation that takes Z to the normal, it is the same arc.
TEST(ClArcTest, AnyPlane) {
  const Vector3d normal = Vector3d(1, 2, -2) / 3;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(kZ, normal);
  const Vector3d shift(100, -50, 7);
  const double angle = 2.0, rise = -4.0, radius = 8.0;
  const Vector3d start = shift + turn * Vector3d(radius, 0, 0);
  const Vector3d end =
      shift + turn * Vector3d(radius * std::cos(angle), radius * std::sin(angle), rise);
  const Made made = Make(start, {end}, shift + 33.0 * normal, normal);
  ASSERT_TRUE(made.arc) << made.error;
  EXPECT_NEAR(made.arc->sweep, angle, 1e-12);
  EXPECT_NEAR(made.arc->rise, rise, 1e-12);
  EXPECT_NEAR(made.arc->radius, radius, 1e-12);
  EXPECT_LT((made.arc->centre_M - shift).norm(), 1e-10) << "in the plane of the start";
}

// TIMES,n: n turns are begun, the last one not to its end.
TEST(ClArcTest, TurnsOfAHelix) {
  const Vector3d start(25, 0, 3), end(0, -25, 0);
  EXPECT_NEAR(Make(start, {end}, Vector3d::Zero(), kZ, 25.0, 3).arc->sweep, 2 * 2 * kPi + 1.5 * kPi,
              1e-12);
  EXPECT_NEAR(Make(start, {end}, Vector3d::Zero(), kZ, 25.0, 1).arc->sweep, 1.5 * kPi, 1e-12);
}

// Creo: the points between say how often it goes round.
TEST(ClArcTest, PointsBetween) {
  std::vector<Vector3d> points;
  for (int i = 1; i <= 27; ++i) {
    const double angle = i * 30.0 * kPi / 180.0;
    points.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), -0.1 * i);
  }
  const Made helix = Make({10, 0, 0}, points, Vector3d::Zero(), kZ);
  ASSERT_TRUE(helix.arc) << helix.error;
  EXPECT_NEAR(helix.arc->sweep, 27 * kPi / 6, 1e-9);
  EXPECT_NEAR(helix.arc->rise, -2.7, 1e-12);
  EXPECT_NEAR(
      Make({10, 0, 0}, {{0, 10, 0}, {-10, 0, 0}, {0, -10, 0}, {10, 0, 0}}, Vector3d::Zero(), kZ)
          .arc->sweep,
      2 * kPi, 1e-12);
  // The other sense: each step would go round the long way.
  EXPECT_THAT(Make({10, 0, 0}, {{0, 10, 0}, {-10, 0, 0}}, Vector3d::Zero(), -kZ).error,
              HasSubstr("do not follow each other in its sense"));
  EXPECT_THAT(Make({10, 0, 0}, {{0, 10, -4}, {-10, 0, -5}}, Vector3d::Zero(), kZ).error,
              HasSubstr("do not rise with the angle"));
}

TEST(ClArcTest, WhatIsNoCircle) {
  EXPECT_EQ(Make({10, 0, 0}, {{0, 10.01, 0}}, Vector3d::Zero(), kZ).error,
            "the circle does not meet its end: its radius is 10 mm, the point is 10.01 mm from its "
            "centre");
  EXPECT_TRUE(Make({10, 0, 0}, {{0, 10.004, 0}}, Vector3d::Zero(), kZ).arc);
  EXPECT_EQ(
      Make({10, 0, 0}, {{0, 10, 0}}, Vector3d::Zero(), kZ, 10.5).error,
      "the circle does not meet its start: its radius is 10.5 mm, the start is 10 mm from its "
      "centre");
  EXPECT_EQ(Make({0, 0, 3}, {{0, 0, 3}}, Vector3d::Zero(), kZ).error,
            "a circle about the point where the tool stands");
  // A whole turn whose end is printed with another last digit would be a turn or nothing.
  EXPECT_THAT(Make({10, 0, 0}, {{10, 0.0001, 0}}, Vector3d::Zero(), kZ).error,
              HasSubstr("0.000100 mm apart"));
  EXPECT_NEAR(Make({10, 0, 0}, {{10, 0.0003, 0}}, Vector3d::Zero(), kZ).arc->sweep, 0.00003, 1e-9);
}

}  // namespace
}  // namespace ncsim::post
