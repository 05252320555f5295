// SPDX-License-Identifier: BSD-3-Clause
// Calls of cycles in programs (NC programming 12/2019, "Programming cycles externally"). Machine
// values from G54 X10 Y20 Z-250 and T1 of 100 mm.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sim/control/sinumerik_test_machine.h"

namespace ncsim::control {
namespace {

constexpr const char* kHead = "G54 G90 D1 M3 S1200 F300\nG0 X0 Y0 Z50\n";

TestRun Simulate(const std::string& rest) { return SinumerikTest().Run(kHead + rest); }

/// Program X, Y and Z at the end of the motions of a line, "0,0,50 0,0,2".
std::string Ways(const TestRun& run, int line) {
  std::string text;
  for (const motion::Motion& motion : run.motions) {
    if (motion.where.line != line) continue;
    const motion::JointVector& q = motion.q1();
    if (!text.empty()) text += " ";
    text +=
        Short(q[kJointX] - 10.0) + "," + Short(q[kJointY] - 20.0) + "," + Short(q[kJointZ] + 150.0);
  }
  return text;
}

std::string Message(const TestRun& run, Rule rule) {
  return run.Has(rule) ? run.Find(rule)->message : "";
}

TEST(SinumerikCycles, ACallDrillsWhereTheToolStands) {
  const TestRun run = Simulate("X5\nCYCLE81(10,0,2,-8)\nX6\n");
  EXPECT_EQ(Ways(run, 4), "5,0,2 5,0,-8 5,0,10") << run.Text();
  // The cycle leaves G0 in force as it was.
  EXPECT_EQ(Ways(run, 5), "6,0,10");
  EXPECT_TRUE(run.findings.empty()) << run.Text();
}

TEST(SinumerikCycles, AModalCallDrillsBehindEachMotion) {
  const TestRun run = Simulate("MCALL CYCLE82(10,0,2,,8,1)\nX5\nM8\nY5 F100\nMCALL\nX0\n");
  EXPECT_EQ(Ways(run, 3), "");
  EXPECT_EQ(Ways(run, 4), "5,0,50 5,0,2 5,0,-8 5,0,-8 5,0,10") << run.Text();
  EXPECT_EQ(Ways(run, 6), "5,5,10 5,5,2 5,5,-8 5,5,-8 5,5,10");
  EXPECT_EQ(Ways(run, 8), "0,5,10");
}

TEST(SinumerikCycles, FactsOfTheMotions) {
  const TestRun run =
      Simulate("CYCLE82(10,0,2,-8,,0.5)\nCYCLE84(10,0,2,-8,,,3,,1.25,0,600,1200)\n");
  std::vector<double> times;
  for (const motion::Motion& motion : run.motions) {
    if (motion.where.line < 3) continue;
    EXPECT_EQ(motion.facts.cycle, motion.where.line - 2);
    times.push_back(motion.duration);
  }
  ASSERT_EQ(times.size(), 8U) << run.Text();
  EXPECT_NEAR(times[1], 10.0 / 5.0, 1e-9);  // 10 mm at 300 mm/min
  EXPECT_NEAR(times[2], 0.5, 1e-12);
  EXPECT_NEAR(times[5], 10.0 / 12.5, 1e-9);  // 1.25 mm x 600 / min
  EXPECT_NEAR(times[6], 10.0 / 25.0, 1e-9);
}

TEST(SinumerikCycles, SpindleOfTappingAndBoring) {
  // A feed of a stopped spindle is what tells: M5 by SDAC, the stop of CYCLE86, M3 by its SDIR.
  const TestRun run = Simulate(
      "CYCLE84(10,0,2,-8,,,5,8,,0,600,600)\nG1 Z9\nCYCLE86(10,0,2,-8,,,3,1,0,0,0)\nG1 Z9\n");
  const auto on = [&](int line) { return run.Last(line).facts.spindle_on; };
  EXPECT_FALSE(on(4)) << run.Text();
  EXPECT_FALSE(on(6));
  bool turned = false;
  for (const motion::Motion& motion : run.motions) {
    turned = turned || (motion.where.line == 5 && motion.facts.spindle_on);
  }
  EXPECT_TRUE(turned);
}

TEST(SinumerikCycles, InchesAndOtherLevels) {
  const TestRun run = Simulate("G70\nCYCLE81(1,0,.1,-.5)\n");
  EXPECT_EQ(Ways(run, 4), "0,0,2.54 0,0,-12.7 0,0,25.4") << run.Text();
}

TEST(SinumerikCycles, Cycle83WithItsLongList) {
  // As a post writes it, and as the dialog does with the depths taken from DP and FDPR.
  const TestRun run = Simulate("CYCLE83(3,3,,-33.004,,,5,0,,,1,1)\n");
  EXPECT_EQ(Ways(run, 3).substr(0, 40), "0,0,3 0,0,-2 0,0,3 0,0,-1.4 0,0,-7 0,0,3") << run.Text();
  const TestRun chips = Simulate(
      "CYCLE83(10,0,2,-20,,,12,0,0,0,1,0,3,0,2,0,0,0,1,1110)\nCYCLE83(10,0,2,,9,,12,,,,,0)\n");
  EXPECT_EQ(Ways(chips, 3), "0,0,2 0,0,-12 0,0,-10 0,0,-20 0,0,10") << chips.Text();
  EXPECT_EQ(Ways(chips, 4), "0,0,2 0,0,-9 0,0,10");
  EXPECT_TRUE(chips.findings.empty()) << chips.Text();
}

TEST(SinumerikCycles, Cycle83AsTheDialogWritesIt) {
  // Strokes of 5, then nine tenths of the one before, down to 1.2; the first at nine tenths of F.
  const TestRun run =
      Simulate("CYCLE83(10,0,1,,20,,5,90,0.6,0.6,90,0,0,1.2,1.4,0.6,1.6,0,1,11211111)\n");
  std::string depths;
  double first = 0.0;
  for (const motion::Motion& motion : run.motions) {
    if (motion.where.line != 3 || motion.kind != motion::MotionKind::kFeed) continue;
    if (depths.empty()) first = motion.duration;
    depths += Short(motion.q1()[kJointZ] + 150.0) + " ";
  }
  EXPECT_EQ(depths, "-5 -9.5 -13.55 -17.195 -20 ") << run.Text();
  EXPECT_NEAR(first, 6.0 / (0.9 * 5.0), 1e-9);
  EXPECT_TRUE(run.Assumed("CYCLE83 _AMODE"));
}

TEST(SinumerikCycles, HolesOnACircleAndInARow) {
  // Closed form: centre + r (cos, sin).
  const TestRun run = Simulate("MCALL CYCLE81(5,0,1,-3)\nHOLES2(3,4,50,45,90,4)\nMCALL\nX0\n");
  const double r = 50.0 * std::numbers::sqrt2 / 2.0;
  const std::vector<std::pair<double, double>> holes = {
      {3 + r, 4 + r}, {3 - r, 4 + r}, {3 - r, 4 - r}, {3 + r, 4 - r}};
  std::string expected;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const std::string at = Short(holes[i].first) + "," + Short(holes[i].second) + ",";
    expected += (i == 0 ? "" : " ") + at + (i == 0 ? "50 " : "5 ");
    expected += at + "1 " + at + "-3 " + at + "5";
  }
  EXPECT_EQ(Ways(run, 4), expected) << run.Text();
  EXPECT_EQ(Ways(run, 6), "0," + Short(4 - r) + ",5");
  // Without INDA a full circle; without a modal call positions only.
  EXPECT_EQ(Ways(Simulate("HOLES2(0,0,10,0,0,4)\n"), 3), "10,0,50 0,10,50 -10,0,50 0,-10,50");
  // From the end that is nearer to zero.
  EXPECT_EQ(Ways(Simulate("HOLES1(0,0,90,10,20,3)\n"), 3), "0,10,50 0,30,50 0,50,50");
  EXPECT_EQ(Ways(Simulate("HOLES1(0,-60,90,10,20,3)\n"), 3), "0,-10,50 0,-30,50 0,-50,50");
  // To and fro along the smaller distance.
  EXPECT_EQ(Ways(Simulate("CYCLE801(1,2,0,10,20,2,2)\n"), 3), "1,2,50 11,2,50 11,22,50 1,22,50");
}

TEST(SinumerikCycles, ASubprogramMayBeCalledAtEachHole) {
  const TestRun run = Simulate(
      "MCALL HOLE(3)\nHOLES1(0,0,0,10,20,2)\nMCALL\nX0\nM30\n%_N_HOLE_SPF\n"
      "PROC HOLE(REAL DEPTH)\nG1 Z=-DEPTH\nG0 Z5\nM17\n");
  EXPECT_EQ(Ways(run, 4), "10,0,50 30,0,5") << run.Text();
  EXPECT_EQ(Ways(run, 10), "10,0,-3 30,0,-3");
  EXPECT_EQ(Ways(run, 11), "10,0,5 30,0,5");
  EXPECT_EQ(Ways(run, 6), "0,0,5");
  EXPECT_TRUE(run.findings.empty()) << run.Text();
}

TEST(SinumerikCycles, AlarmsOfTheCycles) {
  const auto alarm = [](const std::string& call) {
    const std::string text = Message(Simulate(call + "\n"), Rule::kControlAlarm);
    const std::size_t at = text.rfind("(alarm ");
    return at == std::string::npos ? text : text.substr(at + 7, 5);
  };
  EXPECT_EQ(alarm("CYCLE81(0,0,2,,8)"), "61101");
  EXPECT_EQ(alarm("CYCLE81(10,0,2,8)"), "61101");
  EXPECT_EQ(alarm("CYCLE81(10,0,2)"), "61101");
  EXPECT_EQ(alarm("CYCLE83(10,0,2,-20)"), "61107");
  EXPECT_EQ(alarm("CYCLE83(10,0,2,-20,,5,0,0,0,0,1,1)"), "61107");
  EXPECT_EQ(alarm("CYCLE84(10,0,2,-8,,,3,,,0,600,600)"), "61001");
  EXPECT_EQ(alarm("CYCLE84(10,0,2,-8,,,3,8,1,0,600,600)"), "61001");
  EXPECT_EQ(alarm("CYCLE86(10,0,2,-8)"), "61102");
  EXPECT_EQ(alarm("CYCLE87(10,0,2,-8,,5)"), "61102");
  EXPECT_EQ(alarm("CYCLE840(10,0,2,-8,,,0,3,1)"), "61102");
  EXPECT_EQ(alarm("HOLES1(0,0,0,0,10,0)"), "61103");
  EXPECT_EQ(alarm("HOLES2(0,0,10,0,90,5)"), "61106");
  EXPECT_EQ(alarm("CYCLE81(10,0,2,-8,0,0,0,0,0,0)"), "12340");
  EXPECT_EQ(alarm("CYCLE81(\"10\",0,2,-8)"), "12150");
}

TEST(SinumerikCycles, WhatChangesTheGeometryAndIsNotSimulatedIsNamed) {
  const auto unsupported = [](const std::string& text) {
    return Message(Simulate(text + "\n"), Rule::kUnsupportedCode);
  };
  EXPECT_EQ(unsupported("CYCLE83(10,0,2,,20,,5,90,0.6,0.6,90,0,0,1.2,1.4,0.6,1.6,0,1,31211111)"),
            "CYCLE83 with _AMODE = 31211111 was not simulated");
  EXPECT_EQ(unsupported("CYCLE82(10,0,2,-8,,0,0,1,11)"),
            "CYCLE82 with _AMODE = 11 was not simulated");
  EXPECT_EQ(unsupported("CYCLE81(10,0,2,-8,,,1,1,0)"), "CYCLE81 with _GMODE = 1 was not simulated");
  EXPECT_EQ(unsupported("CYCLE82(10,0,2,-8,,0,0,2,12)"),
            "CYCLE82 with _DMODE = 2 was not simulated");
  EXPECT_EQ(unsupported("CYCLE84(10,0,2,-8,,,3,,1,0,600,600,1)"),
            "CYCLE84 with _AXN = 1 was not simulated");
  EXPECT_EQ(unsupported("HOLES2(0,0,10,0,0,4,1000,0,\"\",,1)"),
            "HOLES2 with _VARI = 1000 was not simulated");
  EXPECT_EQ(unsupported("SCALE Z2\nCYCLE81(10,0,2,-8)"),
            "CYCLE81 with SCALE of the drilling axis was not simulated");
  EXPECT_EQ(unsupported("CYCLE82(10,0,2,-8,,0,0,1,12)\nCYCLE82(10,0,2,,8,0.1,0,0,11)"), "");
}

TEST(SinumerikCycles, CompensatingChuckFeedsByPitchOrByF) {
  const TestRun run = Simulate("CYCLE840(10,0,2,-8,,,0,3,0,,1.25)\nCYCLE840(10,0,2,-8,,,4,3,1)\n");
  std::vector<double> times;
  for (const motion::Motion& motion : run.motions) {
    if (motion.where.line >= 3) times.push_back(motion.duration);
  }
  ASSERT_EQ(times.size(), 8U) << run.Text();
  EXPECT_NEAR(times[1], 10.0 / 25.0, 1e-9);  // 1.25 mm x 1200 / min
  EXPECT_NEAR(times[5], 10.0 / 5.0, 1e-9);   // F300
}

TEST(SinumerikCycles, ModalCallUnderTraoriAndInTurnedFrames) {
  const TestRun run = Simulate("TRAORI\nG54\nG0 X0 Y0 Z20 B0\nMCALL CYCLE81(5,0,1,-3)\nX5\n");
  EXPECT_EQ(Ways(run, 7), "5,0,20 5,0,1 5,0,-3 5,0,5") << run.Text();
  const TestRun turned = Simulate("ROT X90\nG0 X0 Y0 Z-40\nCYCLE81(-39,-41,1,-45)\n");
  EXPECT_EQ(Ways(turned, 5), "0,45,0 0,39,0") << turned.Text();
}

}  // namespace
}  // namespace ncsim::control
