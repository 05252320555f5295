// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/reachable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinematics/test_machines.h"

namespace ncsim::kinematics {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
using Angles = std::array<double, 2>;

FiveAxis BcTable() {
  const TestMachine machine = TrunnionBC({1, 2, 3}, {4, 5, 6});
  return *FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
}

// A3=1 B3=1 C3=1 on a BC table: B = atan2(hypot(ux, uy), uz) = 54.73561, C = atan2(uy, ux) = 45;
// the other solution is -B, C - 180.
TEST(ReachableRotaryTest, VectorWordsOnABcTable) {
  const FiveAxis five_axis = BcTable();
  const Eigen::Vector3d u = Eigen::Vector3d::Ones().normalized();
  const auto both = ReachableRotary(five_axis, u, {0.0, 0.0}, {});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[0].angles[0] / kDeg, 54.735610317, 1e-8);
  EXPECT_NEAR(both[0].angles[1] / kDeg, 45.0, 1e-12);
  EXPECT_NEAR(both[1].angles[0] / kDeg, -54.735610317, 1e-8);
  EXPECT_NEAR(both[1].angles[1] / kDeg, -135.0, 1e-12);
  RotaryLimits limits;
  limits.lower[0] = -11.0 * kDeg;
  limits.upper[0] = 100.0 * kDeg;
  const auto one = ReachableRotary(five_axis, u, {0.0, -2.0}, limits);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].angles[1] / kDeg, 45.0, 1e-12);
  // Standing at B-54 C-130 the other solution is the nearer one.
  EXPECT_LT(ReachableRotary(five_axis, u, {-54.0 * kDeg, -130.0 * kDeg}, {})[0].angles[0], 0.0);
}

TEST(ReachableRotaryTest, WholeTurnsGoWithTheAxis) {
  const FiveAxis five_axis = BcTable();
  const double b = 60.0 * kDeg;
  const Eigen::Vector3d u(std::sin(b), 0.0, std::cos(b));
  const auto at = [&](double c_deg, RotaryLimits limits = {}) {
    limits.lower[0] = 0.0;
    limits.upper[0] = 120.0 * kDeg;
    const auto found = ReachableRotary(five_axis, u, {b, c_deg * kDeg}, limits);
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? NAN : found[0].angles[1] / kDeg;
  };
  EXPECT_NEAR(at(350.0), 360.0, 1e-9);
  EXPECT_NEAR(at(3500.0), 3600.0, 1e-9);
  EXPECT_NEAR(at(-190.0), -360.0, 1e-9);
  RotaryLimits turn;  // Limits go before nearness, and hold at their very ends.
  turn.lower[1] = 0.0;
  turn.upper[1] = 359.0 * kDeg;
  EXPECT_NEAR(at(350.0, turn), 0.0, 1e-9);
  turn.lower[1] = 10.0 * kDeg;
  turn.lower[0] = 0.0;
  turn.upper[0] = 120.0 * kDeg;
  EXPECT_TRUE(ReachableRotary(five_axis, u, {b, 350.0 * kDeg}, turn).empty());
}

TEST(ReachableRotaryTest, AtThePoleTheFreeJointStays) {
  const FiveAxis five_axis = BcTable();
  const auto found = ReachableRotary(five_axis, Eigen::Vector3d::UnitZ(), {0.5, 400.0 * kDeg}, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].at_pole);
  EXPECT_NEAR(found[0].angles[0], 0.0, 1e-12);
  EXPECT_EQ(found[0].angles[1], 400.0 * kDeg);
}

TEST(ReachableRotaryTest, NothingWhereTheToolCannotPoint) {
  RotaryLimits limits;
  limits.upper[0] = 50.0 * kDeg;
  limits.lower[0] = -50.0 * kDeg;
  EXPECT_TRUE(
      ReachableRotary(BcTable(), Eigen::Vector3d::Ones().normalized(), {0.0, 0.0}, limits).empty());
}

// On random machines: every position found points the tool to u, holds the limits, and no whole
// turn of a joint is nearer; of two branches the nearer comes first.
TEST(ReachableRotaryTest, HoldsOnRandomMachines) {
  Random random(31);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.5), false});
    const auto five_axis = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(five_axis.has_value());
    JointVector q = RandomPosition(&random, machine.tree);
    Eigen::Vector3d tip, u, reached;
    five_axis->TipInTable(q, 0.0, &tip, &u);
    const Angles from{random.Uniform(-9.0, 9.0), random.Uniform(-9.0, 9.0)};
    RotaryLimits limits;
    for (std::size_t k = 0; k < 2; ++k) {
      limits.lower[k] = random.Uniform(-9.0, 2.0);
      limits.upper[k] = limits.lower[k] + random.Uniform(1.0, 12.0);
    }
    double before = 0.0;
    for (const RotarySolution& solution : ReachableRotary(*five_axis, u, from, limits)) {
      ++found;
      double squares = 0.0;
      for (std::size_t k = 0; k < 2; ++k) {
        const double angle = solution.angles[k];
        q[five_axis->rotary()[k]] = angle;
        EXPECT_GE(angle, limits.lower[k] - 1e-8);
        EXPECT_LE(angle, limits.upper[k] + 1e-8);
        squares += (angle - from[k]) * (angle - from[k]);
        for (const double turn : {-2.0 * std::numbers::pi, 2.0 * std::numbers::pi}) {
          const bool allowed = angle + turn >= limits.lower[k] && angle + turn <= limits.upper[k];
          EXPECT_FALSE(allowed && std::abs(angle + turn - from[k]) < std::abs(angle - from[k]));
        }
      }
      five_axis->TipInTable(q, 0.0, &tip, &reached);
      EXPECT_LT((reached - u).norm(), 1e-8);
      EXPECT_GE(squares, before);
      before = squares;
    }
  }
  EXPECT_GT(found, 1000);
}

}  // namespace
}  // namespace ncsim::kinematics
