// SPDX-License-Identifier: BSD-3-Clause
// What the Haas control refuses, assumes and reports. Places: Haas NGC Mill Operator's Manual 2017
// ("manual"). Each rule with the fault, and with what comes near it and is none.
#include <gtest/gtest.h>

#include "sim/control/test_machine.h"

namespace ncsim::control {
namespace {

using motion::MotionKind;

void ExpectAlarm(const TestControl& control, const std::string& text, int line, int column) {
  const TestRun run = control.Run(text);
  const Finding* alarm = run.Find(Rule::kControlAlarm);
  ASSERT_NE(alarm, nullptr) << text << run.Text();
  EXPECT_EQ(alarm->where.line, line) << text;
  EXPECT_EQ(alarm->where.column, column) << text;
  EXPECT_FALSE(run.summary.finished);
}

void ExpectClean(const TestControl& control, const std::string& text) {
  const TestRun run = control.Run(text);
  EXPECT_TRUE(run.findings.empty()) << text << run.Text();
  EXPECT_TRUE(run.summary.finished) << text;
}

TEST(HaasRules, TwoCodesOfAGroupAndTwoMCodes) {
  // Manual, "Introduction to G-Codes": never two codes of a group; one M code a block.
  const TestControl control;
  ExpectAlarm(control, "G0 G1 X1.\n", 1, 4);
  ExpectAlarm(control, "G54 G55\n", 1, 5);
  ExpectAlarm(control, "G43 H1 G49\n", 1, 8);
  ExpectAlarm(control, "M3 S100 M8\n", 1, 9);
  ExpectAlarm(control, "G28 X0. G53 Z0.\n", 1, 9);
  ExpectClean(control, "G0 G17 G40 G49 G54 G80 G90 G94 G98 G64\nG91 G28 Z0. M5\nG53 G49 Z0.\n");
}

TEST(HaasRules, UnitsAreHeldAgainstSetting9) {
  // Manual, G20/G21: an alarm where they disagree with setting 9.
  TestControl control;
  ExpectAlarm(control, "G20\n", 1, 1);
  ExpectClean(control, "G21\n");
  control.job.control.clear();
  const TestRun run = control.Run("(G21)\nG0 G020 X1.\n");
  EXPECT_TRUE(run.Assumed("setting 9"));
  EXPECT_NEAR(run.End()[kJointX], -300.0 + 25.4, 1e-9) << run.Text();
}

TEST(HaasRules, HMustBeTheToolUnderSetting15) {
  // Manual, setting 15; H00 never alarms.
  TestControl control;
  ExpectAlarm(control, "G43 H2 Z1.\n", 1, 5);
  ExpectClean(control, "G43 H1\nG43 H0\n");
  control.job.control["setting 15"] = "off";
  EXPECT_FALSE(control.Run("G43 H2 Z1.\n").Has(Rule::kControlAlarm));
}

TEST(HaasRules, TcpcAndDwoExcludeEachOther) {
  // Manual, G234: cannot coexist with G254.
  const TestControl control;
  ExpectAlarm(control, "G254\nG234 H1\n", 2, 1);
  ExpectAlarm(control, "G234 H1\nG254\n", 2, 1);
  ExpectAlarm(control, "G234\n", 1, 1);  // H must be on the block.
  ExpectClean(control, "G254\nG255\nG234 H1\nG49\nG254\nG255 G234 H1\nG255\n");
}

TEST(HaasRules, RotaryWorkOffsetsWithTcpcAndDwo) {
  // Manual, G254: "the B axis work offset must be 0".
  TestControl control;
  control.SetOffset("G54", {{'X', -300.0}, {'Y', -200.0}, {'Z', -400.0}, {'B', 0.1}});
  ExpectAlarm(control, "G54\nG254\n", 2, 1);
  ExpectClean(control, "G54 G0 B0. X0.\n");
  EXPECT_EQ(control.Run("G54\nG234 H1\n").LineOf(Rule::kUnsupportedCode), 2);
  control.SetOffset("G54", {{'X', -300.0}, {'Y', -200.0}, {'Z', -400.0}, {'C', 0.1}});
  const TestRun run = control.Run("G54\nG254\n");
  EXPECT_EQ(run.LineOf(Rule::kUnsupportedCode), 2);
  EXPECT_FALSE(run.Has(Rule::kControlAlarm));
}

TEST(HaasRules, TouchedOffLengths) {
  // A negative H is a touch-off: fine for three axes, wrong for G234 and G254.
  TestControl control;
  control.tools.tools[0].h_geometry = -350.0;
  ExpectClean(control, "G43 H1 G0 Z10.\n");
  EXPECT_EQ(control.Run("G234 H1\nG0 Z10.\n").LineOf(Rule::kToolLength), 2);
  EXPECT_EQ(control.Run("G254 G43 H1\nG0 Z10.\n").LineOf(Rule::kToolLength), 2);
}

TEST(HaasRules, LengthRegisterOffTheMetal) {
  TestControl control;
  control.tools.tools[0].h_wear = -0.4;
  ExpectClean(control, "G43 H1 G0 Z10.\n");
  control.tools.tools[0].h_wear = -0.6;
  TestRun run = control.Run("G43 H1 G0 Z10.\n");
  ASSERT_TRUE(run.Has(Rule::kToolLength));
  EXPECT_EQ(run.Find(Rule::kToolLength)->severity, Severity::kWarning);
  control.tools.tools[0] = MakeTestTool(1, 100.0, 10.0);
  control.tools.tools[0].h_geometry = 0.0;  // Never measured.
  run = control.Run("G43 H1 G0 Z10.\n");
  ASSERT_TRUE(run.Has(Rule::kToolLength));
  EXPECT_EQ(run.Find(Rule::kToolLength)->severity, Severity::kError);
}

TEST(HaasRules, ALengthOfAnotherToolMattersWhenZMoves) {
  // T2 M06, X Y, G43 H02 Z: the usual start, with H1 still active on the way in X and Y.
  TestControl control;
  ExpectClean(control, "G43 H1 G0 Z300.\nT2 M6\nX1. Y1.\nG43 H2 Z300.\n");
  EXPECT_EQ(control.Run("G43 H1 G0 Z300.\nT2 M6\nX1. Y1.\nZ300.\n").LineOf(Rule::kToolLength), 4);
}

TEST(HaasRules, ACancelledTcpIsNoticedInASimultaneousFeed) {
  // Manual, G234: cancelled by G43 and G49; G94 feeds of five axes need G234, else G93.
  TestControl control;
  const std::string start = "G54 G0 X0. Y0.\nG234 H1 Z150.\nG1 X1. B1. F100.\n";
  EXPECT_EQ(control.Run(start + "G43 H1 Z150.\nX2. B2.\n").LineOf(Rule::kFrameCancelled), 5);
  ExpectClean(control, start + "G43 H1 Z150.\nX2.\nG0 B0.\n");
  ExpectClean(control, start + "G43 H1 Z150.\nG93 X2. B2. F10.\n");
  ExpectClean(control, start + "G43 H1 Z150.\nG234 H1 X2. B2.\n");
}

TEST(HaasRules, NumbersWithoutADecimalPoint) {
  // Manual, setting 162: OFF reads X-2 as -.002 mm or -.0002 in, B90 as .090 degrees.
  TestControl control;
  TestRun run = control.Run("G54 G0 X-2 Y0 B90\nX-3\n");
  EXPECT_NEAR(run.motions[0].q1()[kJointX], -300.002, 1e-9);
  EXPECT_NEAR(run.motions[0].q1()[kJointB], Radians(0.09), 1e-12);
  EXPECT_EQ(run.findings.size(), 2u) << run.Text();  // Once for lengths, once for angles.
  EXPECT_EQ(run.Find(Rule::kNumberScale)->severity, Severity::kWarning);
  control.job.control["setting 162"] = "on";
  run = control.Run("G54 G0 X-2 Y0 B90\n");
  EXPECT_NEAR(run.motions[0].q1()[kJointX], -302.0, 1e-9);
  EXPECT_TRUE(run.findings.empty());
  // Setting 77 DEFAULT: F10 is .0100 mm/min.
  control.job.control["setting 77"] = "default";
  run = control.Run("G54 G1 X1. F10\n");
  EXPECT_NEAR(run.motions[0].facts.feed, 0.01 / 60.0, 1e-15);
  EXPECT_TRUE(run.Has(Rule::kNumberScale));
  ExpectClean(control, "G54 G1 X1. F10.\n");
}

TEST(HaasRules, ToolChange) {
  // Manual, M06 and setting 247 OFF: Z up first, then X and Y; the spindle stops.
  TestControl control;
  const TestRun run = control.Run("G53 G0 Z-100.\nM3 S500\nT2 M6\nG54 G0 X0.\n");
  ASSERT_EQ(run.motions.size(), 5u) << run.Text();
  EXPECT_EQ(run.motions[1].q1()[kJointX], 0.0);
  EXPECT_EQ(run.motions[1].q1()[kJointZ], 0.0);
  EXPECT_EQ(run.motions[2].q1()[kJointX], -736.6);
  EXPECT_EQ(run.motions[2].q1()[kJointY], -203.2);
  EXPECT_EQ(run.motions[2].facts.tool, 1);
  EXPECT_EQ(run.motions[3].kind, MotionKind::kToolChange);
  EXPECT_EQ(run.motions[3].facts.tool, 2);
  EXPECT_FALSE(run.motions[3].facts.spindle_on);
  EXPECT_EQ(run.motions[4].q0()[kJointY], -203.2);  // They stay there.
  control.job.control["setting 247"] = "on";
  EXPECT_EQ(control.Run("G53 G0 Z-100.\nT2 M6\n").motions.size(), 3u);
}

TEST(HaasRules, ToolsThatAreNotThere) {
  TestControl control;
  EXPECT_EQ(control.Run("T7\nM6\n").LineOf(Rule::kToolMissing), 2);
  ExpectClean(control, "T2 M6\nT1\nM6\n");
  ExpectAlarm(control, "M6\n", 1, 1);
  control.machine.control.tool_pockets = 1;
  EXPECT_TRUE(control.Run("T2 M6\n").Has(Rule::kToolMissing));
  control.job.start_tool = 0;
  EXPECT_EQ(control.Run("G54 G0 X1.\nG1 X2. F10.\n").LineOf(Rule::kToolMissing), 2);
}

TEST(HaasRules, AssumedToolsAreSaid) {
  TestControl control;
  control.tools.tools[1].assumed = "nobody states it";
  EXPECT_FALSE(control.Run("T1 M6\n").Assumed("tool T1"));
  EXPECT_TRUE(control.Run("T2 M6\n").Assumed("tool T2"));
}

TEST(HaasRules, DefaultsAreAssumptionsUnlessStated) {
  TestControl control;
  control.job.start.clear();
  TestRun run = control.Run("G0 X1.\n");
  for (const char* name : {"setting 15", "setting 77", "setting 108", "setting 162", "setting 335",
                           "start position", "rapid rates"}) {
    EXPECT_TRUE(run.Assumed(name)) << name;
  }
  EXPECT_FALSE(run.Assumed("setting 9"));
  control.machine.control.settings["setting 335"] = "none";
  EXPECT_FALSE(control.Run("G0 X1.\n").Assumed("setting 335"));
  EXPECT_TRUE(control.Run("/G0 X1.\n").Assumed("block skip"));
  EXPECT_TRUE(control.Run("M1\n").Assumed("optional stop"));
  EXPECT_FALSE(run.Assumed("block skip"));
}

TEST(HaasRules, WhatIsNotSimulatedIsSaid) {
  const TestControl control;
  const TestRun run =
      control.Run("G54 G0 X1.\nG51 X5. P2.\nG268 X1.\nM55\nM36\nG31 X1.\nX2. U5.\n");
  EXPECT_EQ(run.findings.size(), 5u) << run.Text();
  for (const Finding& finding : run.findings) EXPECT_EQ(finding.rule, Rule::kUnsupportedCode);
  EXPECT_EQ(run.findings.back().where.line, 7);
  EXPECT_EQ(run.findings.back().where.column, 5);
  EXPECT_TRUE(run.summary.finished);
  EXPECT_EQ(run.motions.size(), 2u);  // Axis words of G51, G268 and G31 are not motion.
}

TEST(HaasRules, SettingsThatAreNotSimulatedAreSaid) {
  // Setting 45 mirrors X; 254 is the distance of the centre lines of B and C.
  TestControl control;
  control.job.control["setting 45"] = "on";
  EXPECT_TRUE(control.Run("G0 X1.\n").Has(Rule::kUnsupportedCode));
  control.job.control["setting 45"] = "off";
  control.job.control["setting 254"] = "0";
  ExpectClean(control, "G0 X1.\n");
}

TEST(HaasRules, MCodesOfTheMachineBuilderCanBeDeclared) {
  TestControl control;
  EXPECT_TRUE(control.Run("M120\n").Has(Rule::kUnsupportedCode));
  control.job.m_codes_without_motion = {120};
  ExpectClean(control, "M120 P3\n");
}

TEST(HaasRules, BrakesConflictWithASimultaneousFeedOnly) {
  // Manual, M10-M13: brakes release by themselves; it costs time when they are commanded on.
  TestControl control;
  const std::string start = "G54 G0 X0. Y0.\nG234 H1 Z150.\n";
  EXPECT_TRUE(control.Run(start + "M10\nG1 X1. B1. F100.\n").motions.back().facts.brake_conflict);
  EXPECT_FALSE(control.Run(start + "M12\nG1 X1. B1. F100.\n").motions.back().facts.brake_conflict);
  EXPECT_TRUE(control.Run(start + "M12\nG1 X1. C1. F100.\n").motions.back().facts.brake_conflict);
  EXPECT_FALSE(
      control.Run(start + "M10\nM11\nG1 X1. B1. F100.\n").motions.back().facts.brake_conflict);
  EXPECT_FALSE(control.Run(start + "M10\nG0 B5.\n").motions.back().facts.brake_conflict);
}

TEST(HaasRules, SpindleFollowsItsCodes) {
  // Manual, M03-M05, M88, M89; "M-codes": they act at the block's end.
  const TestRun run =
      TestControl().Run("G54 G1 X1. F100. S100 M3\nX2.\nM88\nX3.\nM4\nX4.\nM5 X5.\nX6.\n");
  ASSERT_EQ(run.motions.size(), 6u) << run.Text();
  const bool expected[] = {false, true, false, true, true, false};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(run.motions[i].facts.spindle_on, expected[i]) << i;
}

TEST(HaasRules, CyclesStartTheSpindle) {
  // Manual, "Canned Cycles": forward if no direction was ever commanded; after M05 it stands.
  const TestControl control;
  const auto feed_with_spindle = [&](const std::string& text) {
    const TestRun run = control.Run(text + "G54 G81 X1. Z200. R250. F100.\n");
    for (const motion::Motion& motion : run.motions) {
      if (motion.kind == MotionKind::kFeed) return motion.facts.spindle_on;
    }
    return false;
  };
  EXPECT_TRUE(feed_with_spindle("S100\n"));
  EXPECT_TRUE(feed_with_spindle("S100 M3\nM0\n"));
  EXPECT_FALSE(feed_with_spindle("S100 M3\nM5\n"));
}

TEST(HaasRules, CompensationEndsInALine) {
  // Manual, "Cutter Compensation": M30 with it active is an alarm; it works in G17.
  const TestControl control;
  EXPECT_TRUE(
      control.Run("G54 G0 X0. Y0.\nG41 D1 G1 X10. F100.\nX20.\nM30\n").Has(Rule::kControlAlarm));
  ExpectAlarm(control, "G18 G41 D1\n", 1, 5);
  EXPECT_TRUE(control.Run("G41 G1 X10. F100.\nG40 X50.\n").Has(Rule::kUnsupportedCode));
  ExpectClean(control, "G54 G0 X0. Y0.\nG41 D1 G1 X10. F100.\nX20.\nY30.\nG40 X40.\nM30\n");
}

TEST(HaasRules, CompensationShiftsThePath) {
  // D1 is a diameter of 10: 5 mm to the left of X+ is Y+5.
  const TestRun run =
      TestControl().Run("G54 G0 X0. Y0.\nG41 D1 G1 X10. F100.\nX50.\nX60.\nG40 X80.\nM30\n");
  EXPECT_NEAR(run.Last(3).q1()[kJointY], -195.0, 1e-9) << run.Text();
  EXPECT_NEAR(run.End()[kJointY], -200.0, 1e-9);
}

TEST(HaasRules, AnotherControlIsNotSimulated) {
  TestControl control;
  control.machine.control.dialect = "no-such-control";
  const TestRun run = control.Run("G0 X1.\n");
  EXPECT_TRUE(run.Has(Rule::kUnsupportedCode));
  EXPECT_FALSE(run.summary.finished);
}

TEST(HaasRules, AnAlarmStopsTheProgram) {
  const TestRun run = TestControl().Run("G54 G0 X1.\nG0 G1\nX2.\n");
  EXPECT_EQ(run.motions.size(), 1u);
  EXPECT_FALSE(run.summary.finished);
}

TEST(HaasRules, PositionsBeyondAllBoundsAreRefused) {
  ExpectAlarm(TestControl(), "G0 X99999999.\n", 1, 4);
}

TEST(HaasVariables, PositionsModesAndRegisters) {
  // Manual, "System Variables": #5001.. last target, #5021.. machine, #4001.. groups, #4111 H,
  // #2001 H1, #5221 G54 X, #14001 G154 P1 X, #3026 tool, #20015 setting 15.
  TestControl control;
  control.job.control["setting 15"] = "on";
  const TestRun run = control.Run(
      "G54 G90 G0 X10. Y20.\nG43 H1 Z50.\n"
      "#501=#5001\n#502=#5021\n#503=#4001\n#504=#4111\n#505=#2001\n#506=#5221\n#507=#3026\n"
      "#508=#20015\n#2001=150.\n#14001=-5.\n#14002=0.\n#14003=0.\n"
      "G53 X-#501\nX[#502+300.] Y#503 Z[#505-50.]\nX#506 Y#507\nX[#508*7.]\nG154 P1 X0.\n");
  EXPECT_FALSE(run.Has(Rule::kControlAlarm)) << run.Text();
  EXPECT_NEAR(run.Last(15).q1()[kJointX], -10.0, 1e-9);
  EXPECT_NEAR(run.Last(16).q1()[kJointX], -290.0, 1e-9);
  EXPECT_NEAR(run.Last(17).q1()[kJointX], -600.0, 1e-9);
  EXPECT_NEAR(run.Last(17).q1()[kJointY], -199.0, 1e-9);
  EXPECT_NEAR(run.Last(18).q1()[kJointX], -293.0, 1e-9);
  EXPECT_NEAR(run.Last(16).q1()[kJointZ], -400.0 + 50.0 + 150.0, 1e-9);
  EXPECT_NEAR(run.Last(19).q1()[kJointX], -5.0, 1e-9);
}

TEST(HaasVariables, WhatASimulationCannotKnow) {
  const TestRun run = TestControl().Run("G0 X1.\n#1=#11005\nX#1\n");
  EXPECT_TRUE(run.Has(Rule::kUnsupportedCode));
  EXPECT_TRUE(run.summary.finished);
  // No variable of this control: an alarm of the flow.
  EXPECT_FALSE(TestControl().Run("G0 X1.\n#1=#9999\n").summary.finished);
}

}  // namespace
}  // namespace ncsim::control
