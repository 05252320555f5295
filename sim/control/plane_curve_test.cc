// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/plane_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/base/units.h"

namespace ncsim::control {
namespace {

Curve RandomCurve(std::mt19937* random) {
  std::uniform_real_distribution<double> u(-10.0, 10.0);
  const Point a(u(*random), u(*random)), b(u(*random), u(*random));
  if ((*random)() % 2 == 0) return Curve::Line(a, b);
  const double sweep = 0.6 * u(*random);  // Up to 6 rad either way.
  const Point r = a - b;
  const Point end = b + Point(std::cos(sweep) * r.x() - std::sin(sweep) * r.y(),
                              std::sin(sweep) * r.x() + std::cos(sweep) * r.y());
  return Curve::Arc(a, end, b, sweep);
}

std::vector<Point> Sample(const Curve& curve, int count) {
  std::vector<Point> points;
  for (int n = 0; n <= count; ++n) {
    const double s = static_cast<double>(n) / count;
    const Point r = curve.start - curve.centre;
    const double a = s * curve.sweep;
    points.push_back(curve.arc
                         ? Point(curve.centre + Point(std::cos(a) * r.x() - std::sin(a) * r.y(),
                                                      std::sin(a) * r.x() + std::cos(a) * r.y()))
                         : Point(curve.start + s * (curve.end - curve.start)));
  }
  return points;
}

TEST(PlaneCurveTest, DistanceIsThatOfTheSamples) {
  std::mt19937 random(11);
  constexpr int kCount = 400;
  for (int n = 0; n < 200; ++n) {
    const Curve a = RandomCurve(&random), b = RandomCurve(&random);
    double sampled = 1e9;
    const std::vector<Point> on_b = Sample(b, kCount);
    for (const Point& p : Sample(a, kCount)) {
      for (const Point& q : on_b) sampled = std::min(sampled, (p - q).norm());
    }
    const double distance = Distance(a, b);
    EXPECT_LE(distance, sampled + 1e-9) << n;
    EXPECT_GE(distance, sampled - (a.length() + b.length()) / kCount) << n;
  }
}

TEST(PlaneCurveTest, AlongRunsFromBeforeTheStartToBeyondTheEnd) {
  const Curve line = Curve::Line({0, 0}, {4, 0});
  EXPECT_DOUBLE_EQ(line.Along({-1, 5}), -1.0);
  EXPECT_DOUBLE_EQ(line.Along({6, 5}), 6.0);
  const Curve arc = Curve::Arc({1, 0}, {0, -1}, {0, 0}, 1.5 * kPi);  // 270 degrees to the left.
  EXPECT_NEAR(arc.Along({0, 1}), 0.5 * kPi, 1e-12);
  EXPECT_NEAR(arc.Along({std::cos(-0.1), std::sin(-0.1)}), -0.1, 1e-12);
  EXPECT_NEAR(arc.Along({std::sin(0.1), -std::cos(0.1)}), 1.5 * kPi + 0.1, 1e-12);
}

TEST(PlaneCurveTest, OffsetsArcsByTheirSense) {
  const Curve left = Curve::Arc({5, 0}, {0, 5}, {0, 0}, 0.5 * kPi);
  EXPECT_NEAR(OffsetLeft(left, 2).radius, 3.0, 1e-12);
  EXPECT_NEAR(OffsetLeft(left, -2).radius, 7.0, 1e-12);
  EXPECT_TRUE(CanOffset(left, 4.999));
  EXPECT_FALSE(CanOffset(left, 5.0));
  EXPECT_TRUE(CanOffset(left, -500.0));
  const Curve right = Curve::Arc({5, 0}, {0, 5}, {0, 0}, -1.5 * kPi);
  EXPECT_NEAR(OffsetLeft(right, 2).radius, 7.0, 1e-12);
}

}  // namespace
}  // namespace ncsim::control
