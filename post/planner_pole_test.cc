// SPDX-License-Identifier: BSD-3-Clause
// Tool axes that come to the pole, go through it and leave it; what a mode cannot carry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "post/test_planner.h"

namespace ncsim::post {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kUmc = "haas_umc750/umc750.urdf";          // B -35 to 120
constexpr const char* kBc = "bc_table_840d/bc_table_840d.urdf";  // B -11 to 100

PlanAbilities& Of(Plan* plan, PlanMode mode) {
  return plan->options.abilities[static_cast<std::size_t>(mode)];
}

// On a machine that can tilt the tool both ways it goes on through the pole.
TEST(PlannerPole, ThroughItOnTheOtherSide) {
  Plan plan(kUmc);
  const auto moves =
      plan.Make("RAPID\n" + Goto({0, 0, 50}, AxisOf(20, 40)) + Goto({10, 0, 50}, AxisOf(20, 220)))
          .All<PlanMove>();
  ASSERT_EQ(plan.FirstError(), "");
  ASSERT_GE(moves.size(), 2u);
  const double c = moves.front().end.rotary[1];
  for (const PlanMove& move : moves) EXPECT_NEAR(move.end.rotary[1], c, 0.05 * kDeg);
  EXPECT_NEAR(std::abs(moves.back().end.rotary[0] - moves.front().end.rotary[0]), 40 * kDeg, 1e-9);
}

// Where the other side is out of reach the second axis turns at the pole, the tip standing still.
TEST(PlannerPole, ThroughItOnTheSameSide) {
  for (const PlanMode mode : {PlanMode::kTcp, PlanMode::kAxes}) {
    Plan plan(kBc);
    plan.options.mode = mode;
    const auto moves =
        plan.Make("RAPID\n" + Goto({0, 0, 50}, AxisOf(60, 40)) + Goto({10, 0, 50}, AxisOf(60, 220)))
            .All<PlanMove>();
    ASSERT_EQ(plan.FirstError(), "");
    double turned = 0.0;
    for (std::size_t i = 1; i < moves.size(); ++i) {
      const PlanPose &a = moves[i - 1].end, &b = moves[i].end;
      const double turn = std::abs(b.rotary[1] - a.rotary[1]);
      EXPECT_LE(turn, 90.001 * kDeg);  // A control that goes the shorter way knows which it is.
      if (turn < 0.1 * kDeg) continue;
      turned += turn;
      EXPECT_NEAR(a.rotary[0], 0.0, 0.005 * kDeg);
      EXPECT_NEAR(b.rotary[0], 0.0, 0.005 * kDeg);
      EXPECT_NEAR((plan.TipAt(mode, b) - plan.TipAt(mode, a)).norm(), 0.0, 1e-9);
      EXPECT_FALSE(moves[i].of_file);
      EXPECT_NEAR(moves[i].time, turn / plan.options.turn_rate, 1e-4);  // the grid
    }
    EXPECT_NEAR(turned, 180 * kDeg, 1e-6);
  }
}

// An axis of seven decimals beside the pole: which way it leans there is no reason to turn.
TEST(PlannerPole, WhatIsWithinTheToleranceIsThePole) {
  Plan plan(kBc);
  plan.options.mode = PlanMode::kTcp;
  const auto moves =
      plan.Make("RAPID\n" + Goto({0, 0, 50}, AxisOf(30, 10)) +
                Goto({10, 0, 50}, AxisOf(0.002, 130)) + Goto({20, 0, 50}, AxisOf(0.001, -90)) +
                Goto({30, 0, 50}, AxisOf(30, 10)))
          .All<PlanMove>();
  ASSERT_EQ(plan.FirstError(), "");
  for (const PlanMove& move : moves) EXPECT_NEAR(move.end.rotary[1], 10 * kDeg, 1e-9);
}

// A control that is told vectors leads them by the rotary axes near the pole, and by its own rule.
TEST(PlannerPole, ATurnThatAVectorDoesNotTell) {
  Plan plan(kBc);
  plan.options.mode = PlanMode::kTcp;
  Of(&plan, PlanMode::kTcp).great_circle = true;
  Of(&plan, PlanMode::kTcp).pole_limit = 2.0 * kDeg;
  plan.Make("RAPID\n" + Goto({0, 0, 50}, AxisOf(60, 40)) + Goto({10, 0, 50}, AxisOf(60, 220)));
  EXPECT_THAT(plan.FirstError(),
              HasSubstr("x.cls:8:1: error: the second rotary axis turns by 180 deg at the pole"));
}

TEST(PlannerPole, VectorsAreDividedNearThePoleOnly) {
  for (const double tilt : {5.0, 1.0}) {
    Plan plan(kBc);
    plan.options.mode = PlanMode::kTcp;
    Of(&plan, PlanMode::kTcp).great_circle = true;
    Of(&plan, PlanMode::kTcp).pole_limit = 2.0 * kDeg;
    const auto moves = plan.Make("RAPID\n" + Goto({0, 0, 50}, AxisOf(tilt, 0)) +
                                 Goto({10, 0, 50}, AxisOf(tilt, 60)))
                           .All<PlanMove>();
    ASSERT_EQ(plan.FirstError(), "");
    if (tilt > 2.5) {
      EXPECT_EQ(moves.size(), 2u);
    } else {
      EXPECT_GT(moves.size(), 3u);
    }
  }
}

// 80 turns of C, which has 74, a rapid before each feed: where C is wound back the tool has come in
// rapid, and comes back so.
TEST(PlannerRewind, BeforeAFeedItComesBackInRapid) {
  Plan plan(kUmc);
  plan.options.mode = PlanMode::kTcp;
  std::string path;
  for (int i = 0; i < 240; ++i) {
    path += "RAPID\n" + Goto({0, 0, 50}, AxisOf(30, 120 * i));
    path += Goto({10, 0, 50}, AxisOf(30, 120 * (i + 1)));
  }
  const Steps& steps = plan.Make(path);
  ASSERT_EQ(plan.FirstError(), "");
  int rewinds = 0;
  for (std::size_t i = 0; i + 1 < steps.steps.size(); ++i) {
    const auto* index = std::get_if<PlanIndex>(&steps.steps[i].what);
    if (index == nullptr || index->why != PlanIndex::Why::kRewind) continue;
    ++rewinds;
    const auto* back = std::get_if<PlanMove>(&steps.steps[i + 1].what);
    ASSERT_NE(back, nullptr);
    EXPECT_TRUE(back->rapid);
  }
  EXPECT_GT(rewinds, 0);
}

TEST(PlannerRates, WhatAnAxisIsTooSlowForIsRefusedAtItsLine) {
  // 100 mm/min over 1 mm: 40 degrees in 0.6 s; B has 50 degrees a second.
  const std::string path = "RAPID\n" + Goto({0, 0, 50}, AxisOf(10, 0)) + "FEDRAT/MMPM,100\n" +
                           Goto({1, 0, 50}, AxisOf(50, 0));
  Plan plan(kUmc);
  plan.options.mode = PlanMode::kAxes;
  plan.Make(path);
  EXPECT_EQ(plan.FirstError(), "");
  Of(&plan, PlanMode::kAxes).rate_alarm = true;
  plan.Make(path);
  EXPECT_THAT(plan.FirstError(), HasSubstr("x.cls:9:1: error: a feed of 100 mm/min is more than "
                                           "axis B can do here"));
}

TEST(PlannerRates, ATurnOnTheSpotHasItsTime) {
  Plan plan(kUmc);
  plan.options.mode = PlanMode::kAxes;
  const auto moves =
      plan.Make("RAPID\n" + Goto({0, 0, 50}, AxisOf(10, 0)) + Goto({0, 0, 50}, AxisOf(50, 0)))
          .All<PlanMove>();
  double time = 0.0;
  for (const PlanMove& move : moves) time += move.time;
  EXPECT_NEAR(time, 40 * kDeg / plan.options.turn_rate, 1e-6);
}

TEST(PlannerAbilities, CutterCompensationThatAModeDoesNotHave) {
  Plan plan(kUmc);
  const std::string path = "RAPID\n" + Goto({0, 0, 50}, AxisOf(0, 0)) + "CUTCOM/LEFT\n" +
                           Goto({9, 0, 50}, AxisOf(0, 0)) + "CUTCOM/OFF\n" +
                           Goto({20, 0, 50}, AxisOf(0, 0));
  plan.Make(path);
  EXPECT_EQ(plan.FirstError(), "");
  Of(&plan, PlanMode::kIndexed).compensation = false;
  plan.Make(path);
  EXPECT_THAT(plan.FirstError(), HasSubstr("x.cls:8:1: error: the mode has no cutter "
                                           "compensation (CUTCOM)"));
}

}  // namespace
}  // namespace ncsim::post
