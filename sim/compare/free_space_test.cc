// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/free_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kinematics/test_machines.h"
#include "sim/compare/magnitude.h"

namespace ncsim::compare {
namespace {

using kinematics::Random;

constexpr Radii kRadii{0.006, 1.7e-4};

Run RunOf(const std::vector<Eigen::Vector3d>& points) {
  Run run;
  for (const Eigen::Vector3d& p : points) run.vertices.push_back({p, Eigen::Vector3d::UnitZ()});
  for (std::uint32_t i = 0; i + 1 < points.size(); ++i) run.pieces.push_back(i);
  return run;
}

/// A circle of radius 10 in `chords` chords.
Run Circle(int chords) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= chords; ++i) {
    const double angle = 2.0 * 3.14159265358979323846 * i / chords;
    points.emplace_back(10.0 * std::cos(angle), 10.0 * std::sin(angle), 0.0);
  }
  return RunOf(points);
}

bool Same(const Run& a, const Run& b, const Radii& radii = kRadii) {
  return WalkTogether(a, b, radii).complete;
}

// A point 3 above a line, radius 5: 4 to both sides of its foot at 6.
TEST(FreeSpace, TheNearPartOfAChordIsThatOfPythagoras) {
  const Pose at{{6.0, 3.0, 0.0}, Eigen::Vector3d::UnitZ()};
  const Pose from{{0.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ()};
  const Pose to{{20.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ()};
  const Interval near = Near(at, from, to, {5.0, 0.1});
  EXPECT_NEAR(near.lower, 0.1, 1e-12);
  EXPECT_NEAR(near.upper, 0.5, 1e-12);
  EXPECT_TRUE(Near(at, from, to, {2.9, 0.1}).empty());
}

TEST(FreeSpace, OneLineIsFiveBlocks) {
  const auto one = RunOf({{0, 0, 0}, {10, 0, 0}});
  const auto five =
      RunOf({{0, 0, 0}, {1, 0, 0}, {1.5, 0, 0}, {7, 0, 0}, {9.999, 0, 0}, {10, 0, 0}});
  const Walk walk = WalkTogether(one, five, kRadii);
  ASSERT_TRUE(walk.complete);
  for (const Step& step : walk.steps) {
    EXPECT_LT(Between(At(one, step.a), At(five, step.b)).position, 1e-12);
  }
}

TEST(FreeSpace, ParallelLinesAreTheSameWithinTheRadius) {
  const auto a = RunOf({{0, 0, 0}, {10, 0, 0}});
  EXPECT_TRUE(Same(a, RunOf({{0, 0.0059, 0}, {4, 0.0059, 0}, {10, 0.0059, 0}})));
  EXPECT_FALSE(Same(a, RunOf({{0, 0.0061, 0}, {4, 0.0061, 0}, {10, 0.0061, 0}})));
}

// The sagitta of n chords of a circle of radius r: r (1 - cos(pi / n)), 0.0054 for 96 of radius 10.
TEST(FreeSpace, AnArcIsItsChordsWithinTheSagitta) {
  EXPECT_TRUE(Same(Circle(4096), Circle(96)));
  EXPECT_FALSE(Same(Circle(4096), Circle(88)));  // 0.0064
}

// Points and places are the same, the order is not.
TEST(FreeSpace, AWayBackAndForthIsNotTheStraightOne) {
  const auto straight = RunOf({{0, 0, 0}, {10, 0, 0}});
  EXPECT_FALSE(Same(straight, RunOf({{0, 0, 0}, {6, 0, 0}, {5, 0, 0}, {10, 0, 0}})));
  // Half the way back is what a walker has to bridge: 0.005 of 0.01.
  EXPECT_TRUE(Same(straight, RunOf({{0, 0, 0}, {6, 0, 0}, {5.99, 0, 0}, {10, 0, 0}})));
  auto circle = Circle(1000), other = circle;
  std::reverse(other.vertices.begin(), other.vertices.end());
  EXPECT_FALSE(Same(circle, other));
}

TEST(FreeSpace, TheAxisCountsBetweenThePointsToo) {
  auto a = RunOf({{0, 0, 0}, {10, 0, 0}}), b = RunOf({{0, 0, 0}, {5, 0, 0}, {10, 0, 0}});
  b.vertices[1].u = Eigen::Vector3d(std::sin(0.001), 0.0, std::cos(0.001));
  EXPECT_FALSE(Same(a, b));
  EXPECT_TRUE(Same(a, b, {0.006, 0.0011}));
}

// Where they part, the walk ends: 0.006 / sin 45 behind the corner on one, and as far on the other.
TEST(FreeSpace, TheWalkEndsWhereTheyPart) {
  const Walk walk = WalkTogether(RunOf({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}),
                                 RunOf({{0, 0, 0}, {10, 0, 0}, {20, 10, 0}}), kRadii);
  EXPECT_FALSE(walk.complete);
  ASSERT_FALSE(walk.steps.empty());
  EXPECT_NEAR(walk.steps.back().a, 1.0, 0.002);
  EXPECT_NEAR(walk.steps.back().b, 1.0, 0.002);
}

TEST(Magnitude, OfATriangleIsItsHeight) {
  const Distance apart =
      Apart(RunOf({{0, 0, 0}, {10, 0, 0}}), RunOf({{0, 0, 0}, {5, 2.5, 0}, {10, 0, 0}}), kRadii);
  EXPECT_NEAR(apart.position, 2.5, 2.5e-3);
  EXPECT_LT(apart.axis, kRadii.axis);
}

// The angle between both walkers goes from 0 to two turns, so it passes half a turn.
TEST(Magnitude, OfACircleTheOtherWayRoundIsTheDiameter) {
  auto other = Circle(1999);
  std::reverse(other.vertices.begin(), other.vertices.end());
  EXPECT_NEAR(Apart(Circle(2000), other, kRadii).position, 20.0, 0.04);
}

/// The discrete Frechet distance (Eiter and Mannila, 1994) of points `step` apart: no less than the
/// true one, and at most by `step` more.
double Discrete(const Run& a, const Run& b, double step) {
  const auto points = [&](const Run& run) {
    std::vector<Eigen::Vector3d> dense;
    for (std::size_t i = 0; i < run.chords(); ++i) {
      const Eigen::Vector3d way = run.vertices[i + 1].p - run.vertices[i].p;
      const int count = std::max(1, static_cast<int>(std::ceil(way.norm() / step)));
      for (int k = 0; k < count; ++k) dense.push_back(run.vertices[i].p + way * k / count);
    }
    dense.push_back(run.vertices.back().p);
    return dense;
  };
  const auto p = points(a), q = points(b);
  std::vector<double> row(q.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    double diagonal = 0.0;
    for (std::size_t j = 0; j < q.size(); ++j) {
      const double up = row[j];
      double reach = i == 0 && j == 0 ? 0.0 : HUGE_VAL;
      if (i > 0) reach = std::min(reach, up);
      if (j > 0) reach = std::min(reach, row[j - 1]);
      if (i > 0 && j > 0) reach = std::min(reach, diagonal);
      row[j] = std::max(reach, (p[i] - q[j]).norm());
      diagonal = up;
    }
  }
  return row.back();
}

TEST(Magnitude, IsThatOfBruteForceOnRandomPaths) {
  Random random(17);
  for (int run = 0; run < 60; ++run) {
    std::vector<Eigen::Vector3d> a = {{0, 0, 0}}, b;
    for (int i = random.Below(6) + 2; i > 0; --i) a.push_back(a.back() + random.InBox(1.0));
    b = a;
    for (Eigen::Vector3d& point : b) point += random.InBox(0.4);
    if (random.Chance(0.5)) b.erase(b.begin() + random.Below(static_cast<int>(b.size()) - 2) + 1);
    const double step = 0.01;
    const double truth = Discrete(RunOf(a), RunOf(b), step);
    const double found = Apart(RunOf(a), RunOf(b), kRadii).position;
    EXPECT_LE(found, truth * 1.001) << run;
    EXPECT_GE(found, truth - step) << run;
  }
}

TEST(Magnitude, ThinningKeepsTheShape) {
  const auto thin = Thin(Circle(4096), kRadii, 1.0);
  EXPECT_LT(thin.chords(), 200U);
  EXPECT_TRUE(Same(Circle(4096), thin, {0.0065, 1.7e-4}));
}

}  // namespace
}  // namespace ncsim::compare
