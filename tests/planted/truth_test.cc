// SPDX-License-Identifier: BSD-3-Clause
// The benchmark's own truth: closed forms against points of the bodies, searches against functions
// whose answer is known.
#include "tests/planted/truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/planted/planted_case.h"

namespace ncsim::planted {
namespace {

using Eigen::Vector3d;

/// The least of Cutter::Signed over random points of the body's box, and then ever closer about the
/// best one: never below the truth, and in the end near it.
double LeastOverPoints(const Cutter& cutter, const ToolPose& tool, const Vector3d& half,
                       Random* random) {
  const auto value = [&](const Vector3d& p) {
    const double z = (p - tool.tip).dot(tool.axis);
    return cutter.Signed((p - tool.tip - z * tool.axis).norm(), z);
  };
  Vector3d best = Vector3d::Zero();
  double least = value(best);
  for (int i = 0; i < 4000; ++i) {
    const double scale = std::pow(10.0, random->Uniform(-5.0, 0.5));
    Vector3d p = best + random->InBox(1.0).cwiseProduct(half) * scale;
    p = p.cwiseMax(-half).cwiseMin(half);
    if (value(p) >= least) continue;
    least = value(p);
    best = p;
  }
  return least;
}

TEST(PlantedTruthTest, ClosedFormsAgainstPointsOfTheBody) {
  Random random(2024);
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    Cutter cutter = RandomCutter(&random, 1.0, 8.0);
    ToolPose tool{random.InBox(18.0), Vector3d::UnitZ()};
    tool.tip.z() -= 20.0;
    if (i % 2 == 1) {
      cutter.corner = cutter.radius;
      cutter.round_top = true;
      tool.axis = random.Direction();
    }
    const Vector3d half(random.Uniform(0.1, 15), random.Uniform(0.1, 15), random.Uniform(0.1, 15));
    const double truth = Clearance(cutter, tool, Block(-half, half).parts.front());
    const double seen = LeastOverPoints(cutter, tool, half, &random);
    ASSERT_GE(seen, truth - 1e-9) << i;
    ASSERT_LE(seen, truth + 0.01) << i;
    apart += truth > 0.0 ? 1 : 0;
  }
  EXPECT_GT(apart, 80);
  EXPECT_LT(apart, 220);
}

TEST(PlantedTruthTest, RimOverAPlane) {
  const Cutter holder{10.0, 50.0, 20.0, 0.0, false};
  // Tilted by 30 degrees: the lower rim is 10 cos 30 - 20 sin 30 above the tip.
  const ToolPose tilted{{0, 0, 5.0}, {0.5, 0, std::sqrt(0.75)}};
  EXPECT_NEAR(Clearance(holder, tilted, HalfSpace{}), 5.0 + 10 * std::sqrt(0.75) - 10.0, 1e-12);
  // Upright and 3 below: it must shrink by 3.
  EXPECT_NEAR(Clearance(holder, {{0, 0, -13.0}, Vector3d::UnitZ()}, HalfSpace{}), -3.0, 1e-12);
}

TEST(PlantedTruthTest, FacetsOfASphere) {
  // The polar cap of 4 rings is a pyramid; a ball beside the equator's edge, and one over the pole.
  const Solid solid = FacetedSphere(10.0, 4);
  const Cutter ball{0.0, 4.0, 2.0, 2.0, true};
  EXPECT_NEAR(Clearance(ball, {{0, 0, 11.0}, Vector3d::UnitZ()}, solid.parts.front()), 1.0, 1e-12);
  EXPECT_NEAR(Clearance(ball, {{15.0, 0, -2.0}, Vector3d::UnitZ()}, solid.parts.front()), 3.0,
              1e-12);
}

TEST(PlantedTruthTest, Searches) {
  const Function wave = [](double s) { return std::sin(40.0 * s) + 2.0 * (s - 0.4) * (s - 0.4); };
  double least = 1e300;
  for (int i = 0; i <= 1000000; ++i) least = std::min(least, wave(i * 1e-6));
  const Bounds found = Least(wave, 42.0, -10.0, 1e-4);
  EXPECT_LE(found.lower, least);
  EXPECT_GE(found.upper, least - 1e-9);
  EXPECT_LE(found.upper - found.lower, 1e-4);
  const Bounds convex = LeastOfConvex([](double s) { return std::abs(s - 0.3) - 1.0; }, 1.0);
  EXPECT_NEAR(convex.upper, -1.0, 1e-10);
  EXPECT_LE(convex.lower, -1.0);
  // The second dip is the first that reaches -0.4.
  const Function dips = [](double s) { return std::cos(20.0 * s) * s; };
  const std::optional<Bounds> first = FirstAtOrBelow(dips, 25.0, -0.4);
  ASSERT_TRUE(first.has_value());
  double by_steps = 0.0;
  while (dips(by_steps) > -0.4) by_steps += 1e-6;
  EXPECT_NEAR(first->upper, by_steps, 2e-6);
  EXPECT_LE(first->lower, by_steps);
  EXPECT_GT(first->lower, by_steps - 4e-6);
  EXPECT_FALSE(FirstAtOrBelow(dips, 25.0, -1.2).has_value());
}

}  // namespace
}  // namespace ncsim::planted
