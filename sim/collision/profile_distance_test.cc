// SPDX-License-Identifier: BSD-3-Clause
// The kernel against closed forms; kernel_conformance_test has the million poses.
#include "sim/collision/profile_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/base/units.h"
#include "sim/collision/test_shapes.h"

namespace ncsim::collision {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 100.0;

// A tool whose tip is at `tip`, axis up.
Eigen::Isometry3d Upright(const Vector3d& tip) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(3.14159265358979323846, Vector3d::UnitX()).toRotationMatrix();
  X.translation() = tip + Vector3d(0, 0, kLength);
  return X;
}

TEST(ProfileDistanceTest, ClosedForms) {
  const machine::TriangleMesh box = BoxMesh({-50, -50, -20}, {50, 50, 0});
  const TriangleTree tree(box);
  const ProfileShape ball(BallProfile(3, 30));
  const ProfileShape end(CylinderProfile(0, 30, 6));
  ProfileDistance ball_kernel(ball, tree);
  ProfileDistance end_kernel(end, tree);
  struct Case {
    Vector3d tip;
    double ball, end;
  };
  // Above the top face; beside the box; off its corner edge (3-4-5 with the rim or the ball's
  // centre).
  const std::vector<Case> cases = {
      {{7.3, -3.1, 0.5}, 0.5, 0.5},
      {{60, 0, -10}, 7.0, 4.0},
      {{7.3, -3.1, -1.25}, -1.25, -1.25},
  };
  for (const Case& c : cases) {
    for (ProfileDistance* kernel : {&ball_kernel, &end_kernel}) {
      const double truth = kernel == &ball_kernel ? c.ball : c.end;
      const Interval d = kernel->Surface(ToolPose(Upright(c.tip), kLength), {});
      EXPECT_LE(d.lower, truth + 1e-9) << c.tip.transpose();
      EXPECT_GE(d.upper, truth - 1e-9) << c.tip.transpose();
      EXPECT_LT(d.upper - d.lower, 0.0021);
    }
  }
  // Ball's centre 3 above the edge x = 50, 4 beyond it: 5 - 3.
  const Interval d = ball_kernel.Surface(ToolPose(Upright({54, 0, 0}), kLength), {});
  EXPECT_NEAR(d.upper, 2.0, 0.0021);
}

TEST(ProfileDistanceTest, SolidDepthCountsTheInside) {
  const TriangleTree tree(BoxMesh({-50, -50, -60}, {50, 50, 0}));
  const ProfileShape ball(BallProfile(3, 30));
  ProfileDistance kernel(ball, tree);
  // The ball's centre is 1 below the face. The surface alone would say 2; the ball must vanish: 3.
  EXPECT_NEAR(kernel.Surface(ToolPose(Upright({0, 0, -4}), kLength), {}).upper, -3.0, 0.003);
  const Interval deep = kernel.Solid(ToolPose(Upright({0, 0, -40}), kLength), {});
  EXPECT_NEAR(deep.upper, -3.0, 0.003);
  EXPECT_LE(deep.lower, -3.0 + 0.003);
  EXPECT_TRUE(kernel.Contained(ToolPose(Upright({0, 0, -40}), kLength)));
  EXPECT_FALSE(kernel.Contained(ToolPose(Upright({0, 0, 1}), kLength)));
  EXPECT_FALSE(kernel.Contained(ToolPose(Upright({60, 0, -40}), kLength)));
}

TEST(ProfileDistanceTest, FlatOnFlatIsCheap) {
  // A flat face on a flat face: every point of the disc is a minimum. A pure Lipschitz search needs
  // 10^7 cells here.
  const TriangleTree tree(BoxMesh({-500, -500, -20}, {500, 500, 0}));
  const ProfileShape shape(PolyProfile({{0, 0}, {0, 25}, {20, 25}, {20, 40}, {60, 40}, {60, 0}}));
  ProfileDistance kernel(shape, tree);
  for (double z : {1.0, 0.05, -0.05, -3.0}) {
    DistanceGoal goal;
    goal.max_evaluations = 3000;
    const Interval d = kernel.Surface(ToolPose(Upright({11, 7, z}), kLength), goal);
    EXPECT_LE(d.lower, z + 1e-9);
    EXPECT_GE(d.upper, z - 1e-9);
    EXPECT_LT(d.upper - d.lower, 0.0021) << z;
  }
}

TEST(ProfileDistanceTest, EarlyStopsAreCertified) {
  const machine::TriangleMesh mesh = SphereMesh({0, 0, 0}, 40, 20);
  const TriangleTree tree(mesh);
  const ProfileShape shape(BallProfile(6, 60));
  ProfileDistance kernel(shape, tree);
  std::mt19937 random(5);
  for (int i = 0; i < 500; ++i) {
    const RevolvedPose pose = ToolPose(RandomPose(random, 150), kLength);
    const Interval fine = kernel.Surface(pose, {});
    DistanceGoal loose;
    loose.relative_gap = 0.2;
    const Interval coarse = kernel.Surface(pose, loose);
    EXPECT_LE(coarse.lower, fine.upper);
    EXPECT_GE(coarse.upper, fine.lower);
    DistanceGoal cut;
    cut.stop_above = 1.0;
    const Interval early = kernel.Surface(pose, cut);
    EXPECT_LE(early.lower, fine.upper);
    if (fine.lower > 1.01) {
      EXPECT_GE(early.lower, 1.0 - 1e-5);
    }
  }
}

TEST(TriangleTreeTest, OverlappingShellsAreOneSolid) {
  machine::TriangleMesh mesh = BoxMesh({0, 0, 0}, {10, 10, 10});
  const machine::TriangleMesh other = BoxMesh({5, 0, 0}, {15, 10, 10});
  for (auto t : other.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  const TriangleTree tree(mesh);
  EXPECT_TRUE(tree.Contains({7, 5, 5}));  // in both: parity would call it outside
  EXPECT_TRUE(tree.Contains({2, 5, 5}));
  EXPECT_FALSE(tree.Contains({7, 5, 11}));
  EXPECT_EQ(tree.representatives().size(), 2u);
}

machine::TriangleMesh OneTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  machine::TriangleMesh mesh;
  mesh.vertices = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

// The search runs onto corners of the profile, where the direction of what is left is rounding:
// a triangle through the axis of a drill point is 5 mm deep at the cylinder's middle.
TEST(ProfileDistanceTest, CornersOfTheProfileAreNoFalsePlanes) {
  const ProfileShape drill(PolyProfile({{0, 0}, {3, 5}, {50, 5}, {50, 0}}));
  const TriangleTree tree(OneTriangle({0, 45, 50}, {0, 196, -166}, {0, -222, -154}));
  const Interval d = ProfileDistance(drill, tree).Surface({{0, 0, 0}, {0, 0, 1}}, {});
  EXPECT_LE(d.lower, -5.0 + 1e-6);
  EXPECT_NEAR(d.upper, -5.0, 3e-3);
}

// A step of the holder flush with a face: inside the union the parts' faces are no surface. In the
// middle of the neck the way out is its radius.
TEST(ProfileDistanceTest, AFaceFlushWithAStep) {
  const ProfileShape step(PolyProfile({{0, 0}, {0, 5}, {40, 5}, {40, 20}, {60, 20}, {60, 0}}));
  const TriangleTree tree(BoxMesh({-100, -100, -300}, {100, 100, 0}));
  const Interval d = ProfileDistance(step, tree).Surface({{0, 0, -40}, {0, 0, 1}}, {});
  EXPECT_LE(d.lower, -5.0 + 1e-6);
  EXPECT_NEAR(d.upper, -5.0, 3e-3);
}

// Nothing nearer than the triangle itself may be looked at, however thin it is.
TEST(ProfileDistanceTest, SliversStayWhereTheyAre) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const ProfileShape disc(CylinderProfile(0, 1.5, 40));
  const auto vector = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 3000; ++i) {
    const double thin = std::pow(10.0, 4.0 * uniform(random) - 8.0);
    const Vector3d a = 300.0 * vector();
    const Vector3d b = a + 500.0 * vector();
    const Vector3d c = a + (0.5 + 0.5 * uniform(random)) * (b - a) + thin * vector();
    const TriangleTree tree(OneTriangle(a, b, c));
    const RevolvedPose pose{30.0 * vector(), vector().normalized()};
    ProfileDistance kernel(disc, tree);
    const Interval d = kernel.Surface(pose, {});
    // Along the long side.
    double least = 1e9;
    for (int k = 0; k <= 2000; ++k) {
      const Vector3d v = a + k / 2000.0 * (b - a) - pose.tip;
      const double z = v.dot(pose.axis);
      least = std::min(least, disc.exact().Distance(z, (v - z * pose.axis).norm()));
    }
    ASSERT_LE(d.lower, least + 1e-6) << i;
    const Vector3d& p = *kernel.witness();
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    ASSERT_LT((p - a - t * (b - a)).norm(), 2.0 * thin + 1e-9) << i;
  }
}

// Over a plate, along it and past its corner edge; the truth is that of the nearest place.
TEST(ProfileDistanceTest, AllTheWayInClosedForm) {
  const TriangleTree tree(BoxMesh({-50, -50, -20}, {50, 50, 0}));
  const ProfileShape ball(BallProfile(3, 30));
  const ProfileShape end(CylinderProfile(0, 30, 6));
  struct Case {
    Vector3d tip, way;
    double ball, end;
  };
  const std::vector<Case> cases = {
      {{-400, 3, 0.5}, {800, 0, 0}, 0.5, 0.5},
      {{60, -300, -10}, {0, 600, 0}, 7.0, 4.0},
      {{54, -300, 0}, {0, 600, 0}, 2.0, 0.0},  // 3-4-5; the rim passes over the edge
      {{120, 20, 30}, {-60, 0, -30}, std::hypot(10, 3) - 3, 4.0},  // to the side of the edge
      {{7, 7, 100}, {0, 0, -99.75}, 0.25, 0.25},                   // down, along the axis
      {{7, 7, 0.25}, {0, 0, 99.75}, 0.25, 0.25},                   // and up
      {{-400, 3, -1.5}, {800, 0, 0}, -1.5, -1.5},                  // through it
  };
  for (const Case& c : cases) {
    for (const bool is_ball : {true, false}) {
      ProfileDistance kernel(is_ball ? ball : end, tree);
      const double truth = is_ball ? c.ball : c.end;
      const Interval d = kernel.AllTheWay(ToolPose(Upright(c.tip), kLength), c.way, {});
      EXPECT_LE(d.lower, truth + 1e-9) << c.tip.transpose();
      EXPECT_GE(d.upper, truth - 1e-9) << c.tip.transpose();
      EXPECT_LT(d.upper - d.lower, 0.0021) << c.tip.transpose();
    }
  }
}

// No pose of a way is nearer than what is said of it, and some is hardly further.
TEST(ProfileDistanceTest, AllTheWayIsTheLeastOfItsPoses) {
  const TriangleTree trees[] = {TriangleTree(SphereMesh({5, -3, 40}, 40, 12)),
                                TriangleTree(BoxMesh({-30, -0.05, 0}, {30, 0.05, 60})),
                                TriangleTree(BoxMesh({0, 0, 0}, {0.1, 0.1, 80}))};
  const ProfileShape shapes[] = {
      ProfileShape(CylinderProfile(0, 40, 6)), ProfileShape(BallProfile(3, 20)),
      ProfileShape(PolyProfile({{0, 0}, {4, 4}, {9, 4}, {20, 1}, {20, 0}})),
      ProfileShape(PolyProfile({{20, 0}, {20, 20}, {50, 25}, {50, 31.5}, {60, 22}, {90, 0}}))};
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(0, 1);
  int clear = 0, touching = 0;
  for (int i = 0; i < 1200; ++i) {
    const TriangleTree& tree = trees[i % 3];
    const ProfileShape& shape = shapes[i % 4];
    ProfileDistance kernel(shape, tree), poses(shape, tree);
    const Eigen::Isometry3d X = RandomPose(random, 60);
    const RevolvedPose begin = {X.translation(), X.linear().col(2)};
    Vector3d way = 120 * unit(random) * X.linear().col(0);
    if (i % 5 == 0) way = 90 * (unit(random) - 0.5) * begin.axis;
    if (i % 7 == 0) way += 30 * begin.axis;
    constexpr int kSteps = 400;
    double least = 1e9;
    for (int k = 0; k <= kSteps; ++k) {
      DistanceGoal goal;
      goal.stop_above = least;
      const double at = static_cast<double>(k) / kSteps;
      least = std::min(least, poses.Surface({begin.tip + at * way, begin.axis}, goal).upper);
    }
    DistanceGoal goal;
    goal.stop_below = 0.0;
    const Interval d = kernel.AllTheWay(begin, way, goal);
    ASSERT_LE(d.lower, least) << i;
    if (least <= 0.0) {
      ++touching;
      ASSERT_LE(d.lower, 0.0) << i;
      continue;
    }
    ++clear;
    // The nearest pose is between two of the steps.
    ASSERT_GE(d.upper, least - 0.003 - 0.5 * way.norm() / kSteps) << i;
    if (d.upper > 0.0) {
      ASSERT_LT(d.upper - d.lower, 0.0021) << i;
    }
  }
  EXPECT_GT(clear, 300);
  EXPECT_GT(touching, 200);
}

TEST(ProfileDistanceTest, WhatIsNoNumberIsNoClearance) {
  const TriangleTree tree(BoxMesh({-50, -50, -20}, {50, 50, 0}));
  const ProfileShape ball(BallProfile(3, 30));
  ProfileDistance kernel(ball, tree);
  DistanceGoal goal;
  goal.max_evaluations = 1000;
  const Vector3d up(0, 0, 1);
  for (const double wrong : {std::nan(""), kInfinity, -kInfinity}) {
    const Vector3d place(3, wrong, 40);
    EXPECT_LE(kernel.Surface({place, up}, goal).lower, 0.0) << wrong;
    EXPECT_LE(kernel.Surface({{3, 3, 40}, {0, wrong, 1}}, goal).lower, 0.0) << wrong;
    EXPECT_LE(kernel.AllTheWay({{3, 3, 40}, up}, place, goal).lower, 0.0) << wrong;
  }
  // Beyond what a float holds: through the box, from far to far.
  for (const double far : {1e30, 1e38, 1e39, 1e200}) {
    EXPECT_LE(kernel.AllTheWay({{-far, 0, -10}, up}, {2 * far, 0, 0}, goal).lower, 0.0) << far;
    EXPECT_LE(kernel.Surface({{-far, 0, -10}, up}, goal).lower, far) << far;
  }
}

}  // namespace
}  // namespace ncsim::collision
