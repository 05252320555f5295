// SPDX-License-Identifier: BSD-3-Clause
// Expected values: distances of a point to cylinder, sphere and cone in closed form.
#include "sim/collision/profile_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/collision/test_shapes.h"

namespace ncsim::collision {
namespace {

TEST(ProfileShapeTest, CylinderDistances) {
  const ProfileShape shape(CylinderProfile(0, 40, 6));
  const ProfileChain& c = shape.exact();
  EXPECT_TRUE(shape.convex());
  EXPECT_NEAR(c.Distance(20, 10), 4.0, 1e-12);
  EXPECT_NEAR(c.Distance(20, 0), -6.0, 1e-12);
  EXPECT_NEAR(c.Distance(1, 0), -1.0, 1e-12);
  EXPECT_NEAR(c.Distance(-3, 10), 5.0, 1e-12);  // 3-4-5 to the rim
  EXPECT_NEAR(c.Distance(-3, 2), 3.0, 1e-12);
  EXPECT_NEAR(c.Distance(20, 5.5), -0.5, 1e-12);
  EXPECT_NEAR(shape.inradius(), 6.0, 2e-3);
  EXPECT_NEAR(shape.LeastOnAxis(0, 1), -1.0, 5e-3);
}

TEST(ProfileShapeTest, BallNoseDistances) {
  const ProfileShape shape(BallProfile(3, 20));
  EXPECT_TRUE(shape.convex());
  // Below z = 3 it is a sphere about (3, 0).
  EXPECT_NEAR(shape.exact().Distance(-1, 0), 1.0, 1e-12);
  EXPECT_NEAR(shape.exact().Distance(0, 4), std::hypot(3, 4) - 3.0, 1e-12);
  EXPECT_NEAR(shape.exact().Distance(1, 0), -1.0, 1e-12);
  EXPECT_NEAR(shape.exact().Distance(3, 0), -3.0, 1e-12);
}

TEST(ProfileShapeTest, SteppedProfileIsDeeperThanItsSlabs) {
  // Two cylinders of the same radius: their common face is no surface.
  const ProfileShape shape(PolyProfile({{0, 0}, {0, 6}, {20, 6}, {40, 6}, {40, 0}}));
  EXPECT_TRUE(shape.convex());
  EXPECT_NEAR(shape.exact().Distance(20, 0), -6.0, 1e-12);
  const ProfileShape stepped(PolyProfile({{0, 0}, {0, 5}, {10, 5}, {10, 20}, {30, 20}, {30, 0}}));
  EXPECT_FALSE(stepped.convex());
  EXPECT_EQ(stepped.parts().size(), 2u);
  // 30 - z = |(z - 10, 5)|: the top face and the inner corner are equally far.
  EXPECT_NEAR(stepped.inradius(), 10.625, 2e-3);
  EXPECT_NEAR(stepped.inradius_z(), 19.375, 5e-3);
}

// Brute force over a fine polyline of the profile, random points.
TEST(ProfileShapeTest, AgreesWithDenseSampling) {
  const machine::Profile holder = PolyProfile(
      {{80, 0}, {80, 20}, {110, 25}, {110, 31.5}, {120, 31.5}, {120, 22}, {180, 34.9}, {180, 0}});
  const ProfileShape shape(holder);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> z(60, 200);
  std::uniform_real_distribution<double> r(0, 60);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p(z(random), r(random));
    double best = 1e9;
    for (const auto& e : holder.elements) {
      for (int k = 0; k <= 2000; ++k) {
        best = std::min(best, (p - (e.start + k / 2000.0 * (e.end - e.start))).norm());
      }
    }
    const double distance = shape.exact().Distance(p.x(), p.y());
    EXPECT_NEAR(std::abs(distance), best, 0.02);
    // The hull encloses: never a greater distance. The parts: outside the least is the distance.
    EXPECT_LE(shape.hull().At(p.x(), p.y()).distance, distance + 1e-9);
    double parts = 1e9;
    for (const ConvexProfile& part : shape.parts()) {
      const ConvexProfile::Support support = part.At(p.x(), p.y());
      parts = std::min(parts, support.distance);
      EXPECT_NEAR(support.normal.norm(), 1.0, 1e-9);
    }
    if (distance > 0.0) {
      EXPECT_NEAR(parts, distance, 1e-9);
    } else {
      EXPECT_GE(parts, distance - 1e-9);
    }
  }
}

}  // namespace
}  // namespace ncsim::collision
