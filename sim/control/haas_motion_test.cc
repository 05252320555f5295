// SPDX-License-Identifier: BSD-3-Clause
// Motion of the Haas control. Places: Haas NGC Mill Operator's Manual 2017 ("manual").
#include <gtest/gtest.h>

#include <cmath>

#include "sim/control/test_machine.h"

namespace ncsim::control {
namespace {

using motion::AxisArc;
using motion::AxisLinear;
using motion::DogLeg;
using motion::MotionKind;

TEST(HaasMotion, RapidIsADogLegOfIndependentAxes) {
  // Manual, G00: "not a straight line"; each axis at its own rate; setting 335 NONE.
  const TestRun run = TestControl().Run("G0 G53 X-100. Y-50. C90.\nM30\n");
  ASSERT_EQ(run.motions.size(), 1u) << run.Text();
  const auto& rapid = std::get<DogLeg>(run.motions[0].path);
  EXPECT_DOUBLE_EQ(rapid.duration[kJointX], 100.0 / (22900.0 / 60.0));
  EXPECT_DOUBLE_EQ(rapid.duration[kJointY], 50.0 / (22900.0 / 60.0));
  EXPECT_DOUBLE_EQ(rapid.duration[kJointC], 90.0 / 50.0);
  EXPECT_EQ(rapid.duration[kJointZ], 0.0);
  // Trapezoid: way / rate + rate / acceleration.
  EXPECT_NEAR(run.motions[0].duration, 1.8 + 0.1, 1e-12);
  EXPECT_TRUE(run.summary.finished);
}

TEST(HaasMotion, Setting335GroupsTheAxesOfARapid) {
  // Manual, setting 335: LINEAR (XYZ), LINEAR + ROTARY.
  TestControl control;
  control.job.control["setting 335"] = "linear";
  TestRun run = control.Run("G0 G53 X-100. Y-50. C90.\n");
  const DogLeg xyz = std::get<DogLeg>(run.motions.at(0).path);
  EXPECT_EQ(xyz.duration[kJointX], xyz.duration[kJointY]);
  EXPECT_EQ(xyz.ramp[kJointX], xyz.ramp[kJointY]);
  EXPECT_NE(xyz.duration[kJointX], xyz.duration[kJointC]);
  control.job.control["setting 335"] = "linear+rotary";
  run = control.Run("G0 G53 X-100. Y-50. C90.\n");
  const DogLeg all = std::get<DogLeg>(run.motions.at(0).path);
  EXPECT_EQ(all.duration[kJointX], all.duration[kJointC]);
  EXPECT_EQ(all.duration[kJointY], all.duration[kJointC]);
}

TEST(HaasMotion, G53IsAbsoluteInMachineCoordinatesEvenUnderG91) {
  // Manual, G53, and the DWO sample O00004: `G53 Z0.` goes to machine zero whatever is active.
  const TestRun run =
      TestControl().Run("G54 G90 G0 X10. Y20.\nG43 H1 Z50.\nG91 G53 Z-5.\nG1 F100. X1.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_EQ(run.motions[0].q1()[kJointX], -290.0);
  EXPECT_EQ(run.motions[1].q1()[kJointZ], -400.0 + 50.0 + 100.0);
  EXPECT_EQ(run.motions[2].q1()[kJointZ], -5.0);
  EXPECT_EQ(run.motions[2].q1()[kJointX], -290.0);
  EXPECT_NEAR(run.motions[3].q1()[kJointX], -289.0, 1e-12);
  EXPECT_EQ(run.motions[3].q1()[kJointZ], -5.0);
}

TEST(HaasMotion, RotaryPositionsAreNotReduced) {
  // Manual, setting 108 (a rotary at +-950 degrees): G90 C350 -> C10 turns back by 340 degrees.
  const TestRun run = TestControl().Run("G0 G90 C350.\nC10.\n");
  ASSERT_EQ(run.motions.size(), 2u);
  EXPECT_NEAR(run.motions[1].q1()[kJointC] - run.motions[1].q0()[kJointC], Radians(-340.0), 1e-12);
}

TEST(HaasMotion, MotionsChainBitForBit) {
  const TestRun run = TestControl().Run(
      "G90 G54 G0 X1.1 Y2.2\nG43 H1 Z3.3\nG1 X.7 Y.9 F500.\nG2 X1.7 Y1.9 I1.\nG0 B10. C33.3\n"
      "G49\nG234 H1\nX1. Y2. Z30.\nG1 X2. B12. C35. F300.\nG49\nG53 G0 Z0.\nG28\nM30\n");
  ASSERT_GT(run.motions.size(), 8u) << run.Text();
  for (std::size_t i = 1; i < run.motions.size(); ++i) {
    EXPECT_EQ(run.motions[i].q0(), run.motions[i - 1].q1()) << i;
  }
}

TEST(HaasMotion, AxesThatAreNotNamedRestWhenTheFrameChanges) {
  // Manual, G43: H takes effect with the next Z; G254: "G254 does not cause motion".
  const TestRun run = TestControl().Run("G54 G0 X5. Y5. Z300.\nG43 H1\nX6.\nZ210.\n");
  ASSERT_EQ(run.motions.size(), 3u) << run.Text();
  EXPECT_EQ(run.motions[1].q1()[kJointZ], -100.0);
  EXPECT_EQ(run.motions[2].q1()[kJointZ], -400.0 + 210.0 + 100.0);
}

TEST(HaasMotion, ArcAndHelixAreExact) {
  // Quarter circle about (0, 0) from (10, 0) to (0, 10), 5 mm down: closed form at the middle.
  const TestRun run =
      TestControl().Run("G54 G0 X10. Y0. Z200.\nG3 X0. Y10. Z195. I-10. J0. F600.\n");
  ASSERT_EQ(run.motions.size(), 2u) << run.Text();
  const motion::Motion& arc = run.motions[1];
  EXPECT_EQ(arc.kind, MotionKind::kArc);
  const motion::JointVector middle = arc.At(0.5);
  EXPECT_NEAR(middle[kJointX], -300.0 + 10.0 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(middle[kJointY], -200.0 + 10.0 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(middle[kJointZ], -400.0 + 197.5, 1e-9);
  // Manual, G02/G03: the feed is along the helix.
  EXPECT_NEAR(arc.duration, std::hypot(5.0 * kPi, 5.0) / 10.0, 1e-12);
}

TEST(HaasMotion, FullCircleByIJAndClockwiseInG18) {
  const TestRun run =
      TestControl().Run("G54 G0 X10. Y0. Z200.\nG2 I-10. F600.\nG18 G2 X0. Z210. I-10. K0.\n");
  ASSERT_EQ(run.motions.size(), 3u) << run.Text();
  EXPECT_NEAR(run.motions[1].duration, 2.0 * kPi, 1e-12);
  // Manual, G17/G18/G19: G18 is seen from the rear, i.e. from Y+, with Z first: clockwise there
  // goes from X+ to Z+.
  const motion::JointVector middle = run.motions[2].At(0.5);
  EXPECT_NEAR(middle[kJointX], -300.0 + 10.0 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(middle[kJointZ], -200.0 + 10.0 * std::sqrt(0.5), 1e-9);
}

TEST(HaasMotion, ArcWithTwoRadiiStopsTheControl) {
  const TestRun run = TestControl().Run("G54 G0 X10. Y0.\nG3 X0. Y10.5 I-10. J0. F600.\nG0 X0.\n");
  EXPECT_EQ(run.LineOf(Rule::kArcError), 2);
  EXPECT_FALSE(run.summary.finished);
  EXPECT_EQ(run.motions.size(), 1u);
}

TEST(HaasMotion, LRepeatsAMotionBlock) {
  // Manual, G02/G03, thread milling sample O60023: `I-0.5 J0 Z0.125 L5` under G91.
  const TestRun run = TestControl().Run("G54 G0 X10. Y0. Z0.\nG91 G3 I-10. J0. Z2. L5 F600.\n");
  ASSERT_EQ(run.motions.size(), 6u) << run.Text();
  EXPECT_NEAR(run.End()[kJointZ], -390.0, 1e-12);
}

TEST(HaasMotion, G28WithoutAxesSendsAllHomeAtOnce) {
  // Manual, G28.
  const TestRun run = TestControl().Run("G53 G0 X-100. Y-100. B20. C30.\nG28\n");
  ASSERT_EQ(run.motions.size(), 2u);
  EXPECT_TRUE(run.End().isZero());
  EXPECT_TRUE(std::holds_alternative<DogLeg>(run.motions[1].path));
}

TEST(HaasMotion, G28GoesByTheIntermediatePointAndMovesNamedAxesOnly) {
  // Manual, G28: G90 by the point in work coordinates; G91 X0 Y0 direct.
  const TestRun run = TestControl().Run(
      "G53 G0 X-100. Y-100. Z-10.\nG90 G28 X0. Y0.\nG53 X-50. Y-60.\nG91 G28 X0. Y0.\n");
  ASSERT_EQ(run.motions.size(), 5u) << run.Text();
  EXPECT_EQ(run.motions[1].q1()[kJointX], -300.0);
  EXPECT_EQ(run.motions[1].q1()[kJointY], -200.0);
  EXPECT_EQ(run.motions[2].q1()[kJointX], 0.0);
  EXPECT_EQ(run.motions[2].q1()[kJointZ], -10.0);
  EXPECT_EQ(run.motions[4].q0()[kJointX], -50.0);
  EXPECT_EQ(run.motions[4].q1()[kJointX], 0.0);
}

TEST(HaasMotion, Setting108TurnsLessThanOneTurnHome) {
  // Manual, setting 108: at 950 degrees ON moves 230 degrees, OFF unwinds them all.
  TestControl control;
  TestRun run = control.Run("G0 C950.\nG91 G28 C0.\nG90 C10.\n");
  EXPECT_NEAR(run.motions.at(1).q1()[kJointC], 0.0, 1e-12);
  control.job.control["setting 108"] = "on";
  run = control.Run("G0 C950.\nG91 G28 C0.\nG90 C10.\n");
  EXPECT_NEAR(run.motions.at(1).q1()[kJointC], Radians(720.0), 1e-9);
  // The axis now reads 0 where it stands: C10 turns by 10 degrees.
  EXPECT_NEAR(run.motions.at(2).q1()[kJointC], Radians(730.0), 1e-9);
}

TEST(HaasMotion, G29GoesByTheSavedPoint) {
  // Manual, G29.
  const TestRun run = TestControl().Run("G90 G28 X50. Y60.\nG29 X10. Y20.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_EQ(run.motions[2].q1()[kJointX], -250.0);
  EXPECT_EQ(run.motions[3].q1()[kJointX], -290.0);
  EXPECT_EQ(TestControl().Run("G29 X1.\n").LineOf(Rule::kControlAlarm), 1);
}

TEST(HaasMotion, DwellIsSecondsWithAPointAndMillisecondsWithout) {
  // Manual, G04: P10. is 10 s, P10 is 10 ms.
  const TestRun run = TestControl().Run("G4 P10.\nG4 P10\n");
  ASSERT_EQ(run.motions.size(), 2u) << run.Text();
  EXPECT_DOUBLE_EQ(run.motions[0].duration, 10.0);
  EXPECT_DOUBLE_EQ(run.motions[1].duration, 0.01);
  EXPECT_FALSE(run.Has(Rule::kNumberScale));
}

TEST(HaasMotion, FeedModesSetTheTime) {
  // Manual, G93 (60 / F seconds), G94, G95.
  const TestRun run = TestControl().Run(
      "G54 G0 X0. Y0.\nG94 G1 X10. F600.\nG93 X20. F30.\nG95 S1000 M3 F.1\nG95 X30. F.1\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_DOUBLE_EQ(run.motions[1].duration, 1.0);
  EXPECT_DOUBLE_EQ(run.motions[2].duration, 2.0);
  EXPECT_NEAR(run.motions[3].duration, 6.0, 1e-9);
}

TEST(HaasMotion, FeedMissing) {
  EXPECT_EQ(TestControl().Run("G54 G1 X10.\n").LineOf(Rule::kFeedMissing), 1);
  // Manual, G93: F in every block.
  EXPECT_EQ(TestControl().Run("G54 G93 G1 X10. F5.\nX20.\n").LineOf(Rule::kFeedMissing), 2);
  EXPECT_FALSE(TestControl().Run("G54 G1 X10. F5.\nX20.\n").Has(Rule::kFeedMissing));
}

TEST(HaasMotion, FeedBeyondAnAxisRateIsAnAlarmWithoutTcp) {
  // Manual, G01: "max feedrate exceeded"; the control does not slow down.
  EXPECT_EQ(TestControl().Run("G54 G1 X-100. F22901.\n").LineOf(Rule::kControlAlarm), 1);
  const TestRun near_miss = TestControl().Run("G54 G1 X-100. F22900.\n");
  EXPECT_FALSE(near_miss.Has(Rule::kControlAlarm)) << near_miss.Text();
}

TEST(HaasMotion, CornersAreRoundedBySetting85AndG187UnlessStopped) {
  TestControl control;
  control.job.control["setting 85"] = "0.635";
  const TestRun run =
      control.Run("G54 G1 X1. F100.\nG187 E0.1\nX2.\nG9 X3.\nG61 X4.\nG64 X5.\nG187\nX6.\n");
  ASSERT_EQ(run.motions.size(), 6u) << run.Text();
  const double expected[] = {0.635, 0.1, 0.0, 0.0, 0.1, 0.635};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(run.motions[i].facts.corner_rounding, expected[i]) << i;
  }
  EXPECT_TRUE(run.motions[2].facts.exact_stop);
  EXPECT_FALSE(run.motions[1].facts.exact_stop);
}

TEST(HaasMotion, CannedCycleDrillsEachHoleUntilCancelled) {
  // Manual, G81, G98/G99.
  const TestRun run = TestControl().Run(
      "G54 G90 G0 X0. Y0. Z300.\nG99 G81 X10. Z200. R250. F600.\nX20.\nG80\nX30.\n");
  ASSERT_EQ(run.motions.size(), 9u) << run.Text();
  EXPECT_EQ(run.motions[2].q1()[kJointZ], -150.0);
  EXPECT_EQ(run.motions[3].q1()[kJointZ], -200.0);
  EXPECT_EQ(run.motions[3].kind, MotionKind::kFeed);
  EXPECT_EQ(run.motions[4].q1()[kJointZ], -150.0);
  EXPECT_EQ(run.motions[4].facts.cycle, 1);
  EXPECT_EQ(run.motions[7].facts.cycle, 2);
  EXPECT_EQ(run.motions[8].facts.cycle, 0);
  EXPECT_EQ(run.End()[kJointZ], -150.0);
}

TEST(HaasMotion, CycleUnderG91RepeatsByL) {
  // Manual, "Canned Cycles": L steps X and Y in G91; L0 never drills.
  const TestRun run =
      TestControl().Run("G54 G90 G0 X0. Y0. Z300.\nG91 G81 X10. Z-20. R-50. L3 F600.\nG80\n");
  EXPECT_NEAR(run.End()[kJointX], -270.0, 1e-9) << run.Text();
  EXPECT_NEAR(run.End()[kJointZ], -100.0, 1e-9);  // G98: back to the level before the cycle.
  double lowest = 0.0;
  for (const motion::Motion& motion : run.motions) lowest = std::min(lowest, motion.q1()[kJointZ]);
  EXPECT_NEAR(lowest, -400.0 + 300.0 - 50.0 - 20.0, 1e-9);
  EXPECT_EQ(TestControl().Run("G54 G90 G81 X10. Z1. R5. L0 F60.\n").motions.size(), 0u);
}

TEST(HaasMotion, BoltCircleDrillsWithTheActiveCycle) {
  // Manual, G70: L holes on radius I from J, the cycle defined before with L0.
  const TestRun run = TestControl().Run(
      "G54 G90 G0 X0. Y0. Z300.\nG99 G81 Z200. R250. L0 F600.\nG70 I20. J90. L4\nG80\n");
  int holes = 0;
  for (const motion::Motion& motion : run.motions) holes += motion.kind == MotionKind::kFeed;
  EXPECT_EQ(holes, 4) << run.Text();
  EXPECT_NEAR(run.motions[1].q1()[kJointX], -300.0, 1e-9);
  EXPECT_NEAR(run.motions[1].q1()[kJointY], -180.0, 1e-9);
  EXPECT_EQ(TestControl().Run("G70 I20. J0. L4\n").LineOf(Rule::kControlAlarm), 1);
}

}  // namespace
}  // namespace ncsim::control
