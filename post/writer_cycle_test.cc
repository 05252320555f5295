// SPDX-License-Identifier: BSD-3-Clause
// Hole cycles, in the forms of Haas' manual (2017, canned cycles) and of the 840D's drilling
// cycles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "post/test_plan.h"

namespace ncsim::post {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

PlanPose Pose(double x, double y, double z) { return TestPlan::Pose(x, y, z); }

std::shared_ptr<ClHoleCycle> Drill() {
  auto cycle = std::make_shared<ClHoleCycle>();
  cycle->clearance = 2.0;
  cycle->bottom = -10.0;
  cycle->feed.value = 3.0;
  return cycle;
}

/// `retract` above the point; the clearance where it is 0.
PlanHole Hole(const std::shared_ptr<ClHoleCycle>& cycle, const PlanPose& point,
              double retract = 0.0) {
  PlanHole hole;
  hole.hole.cycle = cycle;
  hole.point = point;
  hole.hole.retract = retract > 0.0 ? retract : cycle->clearance;
  hole.hole.level = retract > 0.0 ? ClHole::Level::kInitial : ClHole::Level::kClearance;
  return hole;
}

TEST(WriterCycleTest, HolesOfOneCyclePrintWhatDiffers) {
  TestPlan plan;
  const auto drill = Drill();
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 2));
  plan.Add(Hole(drill, Pose(5, 0, 0))).Add(Hole(drill, Pose(6, 0, 0)));
  plan.Add(Hole(drill, Pose(6, 1, -3))).Add(ClCycleOff{}).Rapid(Pose(6, 1, 20));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z2."),
              ElementsAre("G99 G81 X5. Y0. Z-10. R2. F180.", "X6. Y0.", "X6. Y1. Z-13. R-1.", "G80",
                          "G00 X6. Y1. Z20."));
  EXPECT_EQ(AllOf(plan.diagnostics), "");
}

TEST(WriterCycleTest, AHigherHoleIsReachedFromAbove) {
  // G99 would go across at the R plane of the hole before: 7 mm below this one's surface.
  TestPlan plan;
  const auto drill = Drill();
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 2));
  plan.Add(Hole(drill, Pose(5, 0, 0))).Add(Hole(drill, Pose(9, 0, 7)));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z2."),
              ElementsAre("G99 G81 X5. Y0. Z-10. R2. F180.", "G80", "G00 X5. Y0. Z9.",
                          "G81 X9. Y0. Z-3. R9. F180."));
}

TEST(WriterCycleTest, TheInitialLevelIsThatOfTheFile) {
  TestPlan plan;
  const auto drill = Drill();
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 50));
  PlanHole near = Hole(drill, Pose(5, 0, 0), 20.0);
  near.hole.level = ClHole::Level::kDistance;
  plan.Add(near).Add(ClCycleOff{}).Add(Hole(drill, Pose(8, 0, 0), 30.0));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z50."),
              ElementsAre("X5.", "Z20.", "G98 G81 X5. Y0. Z-10. R2. F180.", "G80",
                          "G00 X5. Y0. Z30.", "G81 X8. Y0. Z-10. R2. F180."));
}

TEST(WriterCycleTest, EveryKindOfHaas) {
  using Kind = ClCycleKind;
  struct Case {
    Kind kind;
    double dwell, step;
    const char* words;
  };
  for (const Case& one : {Case{Kind::kDrill, 0, 0, "G81 X5. Y0. Z-10. R2. F180."},
                          Case{Kind::kDrill, 0.5, 0, "G82 X5. Y0. Z-10. R2. P0.5 F180."},
                          Case{Kind::kFace, 1, 0, "G82 X5. Y0. Z-10. R2. P1. F180."},
                          Case{Kind::kCounterSink, 0, 0, "G81 X5. Y0. Z-10. R2. F180."},
                          Case{Kind::kDeep, 0, 2.5, "G83 X5. Y0. Z-10. R2. Q2.5 F180."},
                          Case{Kind::kDeep, 0.2, 2.5, "G83 X5. Y0. Z-10. R2. Q2.5 P0.2 F180."},
                          Case{Kind::kDeep, 0, -2.5, "G83 X5. Y0. Z-10. R2. I4. J1.5 K2.5 F180."},
                          Case{Kind::kBreakChip, 0, 2.5, "G73 X5. Y0. Z-10. R2. Q2.5 F180."},
                          Case{Kind::kTap, 0, 0, "G84 X5. Y0. Z-10. R2. F180."},
                          Case{Kind::kReam, 0, 0, "G85 X5. Y0. Z-10. R2. F180."},
                          Case{Kind::kBore, 0.1, 0, "G89 X5. Y0. Z-10. R2. P0.1 F180."},
                          Case{Kind::kBoreDrag, 0, 0, "G86 X5. Y0. Z-10. R2. F180."}}) {
    const auto cycle = Drill();
    cycle->kind = one.kind;
    cycle->dwell = one.dwell;
    if (one.step > 0.0) cycle->steps = {one.step};
    if (one.step < 0.0) cycle->steps = {4.0, -one.step};  // the first is longer
    TestPlan plan;
    plan.Begin(PlanMode::kIndexed, Pose(0, 0, 2)).Add(Hole(cycle, Pose(5, 0, 0)));
    EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z2."),
                ElementsAre(std::string("G99 ") + one.words));
    EXPECT_EQ(AllOf(plan.diagnostics), "");
  }
}

TEST(WriterCycleTest, APostMayTakeTheShorterPeckForAll) {
  const auto deep = Drill();
  deep->kind = ClCycleKind::kDeep;
  deep->steps = {4.0, 2.5};
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 2)).Add(Hole(deep, Pose(5, 0, 0)));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kFanuc)), "G43 H03 Z2."),
              ElementsAre("G99 G83 X5. Y0. Z-10. R2. Q2.5 F180."));
}

TEST(WriterCycleTest, ALeftHandTapIsAnotherCode) {
  const auto tap = Drill();
  tap->kind = ClCycleKind::kTap;
  TestPlan plan;
  plan.modal().spindle.clockwise = false;
  plan.Share().Begin(PlanMode::kIndexed, Pose(0, 0, 2)).Add(Hole(tap, Pose(5, 0, 0)));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z2."),
              ElementsAre("G99 G74 X5. Y0. Z-10. R2. F180."));
}

TEST(WriterCycleTest, WhatACycleCannotSayIsReported) {
  const auto dwell = Drill();
  dwell->kind = ClCycleKind::kTap;
  dwell->dwell = 1.0;
  const auto pecks = Drill();
  pecks->kind = ClCycleKind::kDeep;
  pecks->steps = {3.0, 5.0};
  const auto whole = Drill();
  whole->kind = ClCycleKind::kDeep;
  const auto back = Drill();
  back->kind = ClCycleKind::kBoreBack;
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 2)).Add(Hole(dwell, Pose(5, 0, 0)));
  plan.Add(Hole(pecks, Pose(5, 0, 0))).Add(Hole(back, Pose(5, 0, 0)));
  plan.Add(Hole(whole, Pose(5, 0, 0)));
  plan.Index(PlanMode::kTcp, Pose(0, 0, 2)).Add(Hole(Drill(), Pose(5, 0, 0)));
  plan.Write(ShippedPost(kUmc750));
  EXPECT_EQ(AllOf(plan.diagnostics),
            "part.cls:3: error: cycles.tap of the post prints no {hole.dwell}, and the cycle has a "
            "dwell\n"
            "part.cls:4: error: pecks have words where they are alike, or the first one is longer\n"
            "part.cls:5: error: the post has no cycles.bore_back\n"
            "part.cls:6: error: the cycle has no depth of its pecks\n"
            "part.cls:8: error: mode 'tcp' has no cycles\n");
}

TEST(WriterCycleTest, AModalCallAndItsPositions) {
  // CYCLE81(RTP, RFP, SDIS, DP): as the corpus' program of the same control has it.
  TestPlan plan;
  const auto drill = Drill();
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 10));
  plan.Add(Hole(drill, Pose(5, 0, 0), 10.0)).Add(Hole(drill, Pose(6, 0, 0), 10.0));
  plan.Add(Hole(drill, Pose(6, 1, -3), 13.0)).Add(ClCycleOff{}).Rapid(Pose(6, 1, 20));
  const auto lines = plan.Write(ShippedPost(kBcTable), {}, "three");
  EXPECT_THAT(
      Behind(lines, "Z10."),
      ElementsAre("F180.", "MCALL CYCLE81(10.,0.,2.,-10.)", "X5. Y0.", "X6. Y0.", "MCALL", "F180.",
                  "MCALL CYCLE81(10.,-3.,2.,-13.)", "G0 X6. Y1.", "MCALL", "G0 X6. Y1. Z20."));
  EXPECT_EQ(AllOf(plan.diagnostics), "");
}

TEST(WriterCycleTest, AHoleThatEndsAtItsPointBeginsAtTheClearance) {
  // A control has nothing to drill between RFP and an equal depth.
  TestPlan plan;
  const auto touch = Drill();
  touch->bottom = 0.0;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 10)).Add(Hole(touch, Pose(5, 0, 0), 10.0));
  EXPECT_THAT(plan.Write(ShippedPost(kBcTable), {}, "three"),
              ::testing::Contains("MCALL CYCLE81(10.,2.,0.,0.)"));
}

TEST(WriterCycleTest, DeepHolesAndTapsOfThe840D) {
  const auto deep = Drill();
  deep->kind = ClCycleKind::kDeep;
  deep->steps = {4.0};
  const auto tap = Drill();
  tap->kind = ClCycleKind::kTap;
  tap->feed = {1.25, true};
  TestPlan plan;
  plan.modal().spindle.speed = 500.0;
  plan.Share().Begin(PlanMode::kIndexed, Pose(0, 0, 10));
  const auto pecks = std::make_shared<ClHoleCycle>(*deep);
  pecks->steps = {4.0, 3.0};  // each three quarters of the one before, 3 at least
  plan.Add(Hole(deep, Pose(5, 0, 0), 10.0)).Add(Hole(pecks, Pose(5, 0, 0), 10.0));
  plan.Add(Hole(tap, Pose(5, 0, 0), 10.0));
  const auto lines = plan.Write(ShippedPost(kBcTable), {}, "three");
  EXPECT_THAT(
      Behind(lines, "Z10."),
      ElementsAre("F180.", "MCALL CYCLE83(10.,0.,2.,-10.,,,4.,,,0,1,1,,)", "X5. Y0.", "MCALL",
                  "F180.", "MCALL CYCLE83(10.,0.,2.,-10.,,,4.,-.75,,0,1,1,,3.)", "G0 X5. Y0.",
                  "MCALL", "MCALL CYCLE84(10.,0.,2.,-10.,,0,3,,1.25,0,500,500)", "G0 X5. Y0."));
  EXPECT_EQ(AllOf(plan.diagnostics), "");
}

}  // namespace
}  // namespace ncsim::post
