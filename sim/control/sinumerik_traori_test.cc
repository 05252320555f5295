// SPDX-License-Identifier: BSD-3-Clause
// TRAORI (NC programming 12/2019, "5-axis transformation"; machine data by number).
#include <gtest/gtest.h>

#include <cmath>

#include "sim/control/sinumerik_test_machine.h"

namespace ncsim::control {
namespace {

constexpr const char* kStart = "G54 G0 G90 X0 Y0 Z20 D1\nTRAORI\nG54\n";

/// Tip and axis in the part frame G54 at the end of a line.
void ExpectTip(const SinumerikTest& control, const TestRun& run, int line, const Eigen::Vector3d& p,
               const Eigen::Vector3d& u) {
  Eigen::Vector3d p_B, u_B;
  control.machine.five_axis->TipInTable(run.Last(line).q1(), 100.0, &p_B, &u_B);
  // G54 is the gauge line's place for a tool of no length: the table's frame lies in 0 0 -300.
  const Eigen::Vector3d zero(10.0, 20.0, 50.0);
  EXPECT_LT((p_B - zero - p).norm(), 1e-9) << run.Text();
  EXPECT_LT((u_B - u).norm(), 1e-9);
}

Eigen::Vector3d Axis(double b_deg, double c_deg) {
  const double b = Radians(b_deg), c = Radians(c_deg);
  return {std::sin(b) * std::cos(c), std::sin(b) * std::sin(c), std::cos(b)};
}

TEST(SinumerikTraori, LeadsTheTipInThePart) {
  const SinumerikTest control;
  const TestRun run =
      control.Run(std::string(kStart) + "ORIAXES G1 F500 X5 Y6 Z7 B30 C40\nB10\nX1\n");
  ExpectTip(control, run, 4, {5, 6, 7}, Axis(30, 40));
  ExpectTip(control, run, 5, {5, 6, 7}, Axis(10, 40));
  ExpectTip(control, run, 6, {1, 6, 7}, Axis(10, 40));
  EXPECT_TRUE(run.Last(4).facts.tcp);
}

TEST(SinumerikTraori, OriaxesAgainstOrivectAtTheMiddle) {
  // From B60 C0 to B60 C90 the middle is B60 along the axes, B50.7685 along the great circle.
  SinumerikTest control;
  const auto middle = [&](const std::string& codes) {
    const TestRun run = control.Run(std::string(kStart) + codes + "\nG1 F500 B60 C0\nB60 C90 X1\n");
    const motion::JointVector q = run.Last(6).At(0.5);
    EXPECT_NEAR(Degrees(q[kJointC]), 45.0, 1e-4) << run.Text();
    return Degrees(q[kJointB]);
  };
  EXPECT_NEAR(middle("ORIAXES"), 60.0, 1e-9);
  EXPECT_NEAR(middle("ORIVECT"), 50.7685, 1e-4);
  EXPECT_NEAR(middle("ORIMKS"), 50.7685, 1e-4);
  control.job.control["MD21104"] = "0";
  EXPECT_NEAR(middle("ORIWKS ORIAXES"), 50.7685, 1e-4);
  EXPECT_NEAR(middle("ORIMKS ORIVECT"), 60.0, 1e-9);
}

TEST(SinumerikTraori, MachineDataDecideHowCPasses360) {
  const std::string text =
      "G54 G0 G90 X0 Y0 Z20 D1\nB54 C=DC(359.99503)\nTRAORI\nG54 ORIWKS ORIAXES\n"
      "G1 F500 X.1 C.00926\nX.2 C.1\n";
  SinumerikTest control;
  const auto turn = [&](int line) {
    const motion::Motion motion = control.Run(text).Last(line);
    return Degrees((motion.q1() - motion.q0())[kJointC]);
  };
  control.job.control["MD30455[C]"] = "4";
  EXPECT_NEAR(turn(2), -0.00497, 1e-9);
  EXPECT_NEAR(turn(5), 0.01423, 1e-9);
  EXPECT_TRUE(control.Run(text).Last(5).facts.wrap_note.empty());
  control.job.control = {{"MD21104", "0"}};
  EXPECT_NEAR(turn(5), 0.01423, 1e-9);
  EXPECT_NEAR(turn(6), 0.09074, 1e-9);
  EXPECT_TRUE(control.Run(text).Last(5).facts.wrap_note.empty());
}

TEST(SinumerikTraori, OriaxesWithinTheTurnGoesAllTheWayBack) {
  // C359.99503 -> C.00926 with MD21104 = 1, MD30310 = 1, MD30455 bit 2 = 0.
  const TestRun run = SinumerikTest().Run(
      "G54 G0 G90 X0 Y0 Z20 D1\nB54 C359.99503\nTRAORI\nG54 ORIWKS ORIAXES\nG1 F500 X.1 C.00926\n");
  const motion::Motion& motion = run.Last(5);
  EXPECT_NEAR(Degrees((motion.q1() - motion.q0())[kJointC]), -359.98577, 1e-9) << run.Text();
  EXPECT_FALSE(motion.facts.wrap_note.empty());
}

TEST(SinumerikTraori, VectorsAndAngles) {
  // The 5-axis manual, p. 11: A3=1 B3=1 C3=1 is B54.7356 C45.
  SinumerikTest control;
  TestRun run = control.Run(std::string(kStart) + "ORIAXES G1 F500 A3=1 B3=1 C3=1\n");
  ExpectTip(control, run, 4, {0, 0, 20}, Eigen::Vector3d(1, 1, 1).normalized());
  EXPECT_NEAR(Degrees(run.Last(4).q1()[kJointB]), 54.7356, 1e-4);
  // Euler (MD21100 = 1): A2 about Z, then B2 about the new X. RPY: B2 about Y, then C2 about Z.
  run = control.Run(std::string(kStart) + "ORIAXES G1 F500 A2=120 B2=30\n");
  ExpectTip(control, run, 4, {0, 0, 20}, Axis(30, 30));
  control.job.control["MD21100"] = "0";
  run = control.Run(std::string(kStart) + "ORIAXES G1 F500 B2=30 C2=40\n");
  ExpectTip(control, run, 4, {0, 0, 20}, Axis(30, 40));
}

TEST(SinumerikTraori, FrameThatIsNotSelectedAgainIsOneFinding) {
  const std::string text = "G54 G0 X0 Y0 Z20 D1\nTRAORI\nG1 F500 X1\nX2\nX3\n";
  SinumerikTest control;
  const TestRun run = control.Run(text);
  ASSERT_EQ(run.findings.size(), 1u) << run.Text();
  EXPECT_EQ(run.findings[0].rule, Rule::kFrameCancelled);
  EXPECT_EQ(run.findings[0].where.line, 3);
  control.job.control["MD10602"] = "1";
  const TestRun kept = control.Run(text);
  EXPECT_TRUE(kept.findings.empty()) << kept.Text();
  ExpectTip(control, kept, 5, {3, 0, 20}, Axis(0, 0));
}

TEST(SinumerikTraori, RapidsAreStraightInThePart) {
  const TestRun run = SinumerikTest().Run(std::string(kStart) + "G0 X5 B30\n");
  EXPECT_TRUE(std::holds_alternative<motion::TcpCurve>(run.Last(4).path)) << run.Text();
  EXPECT_EQ(run.Last(4).kind, motion::MotionKind::kRapid);
}

TEST(SinumerikTraori, Cycle832SetsTolerancesUntilItIsSwitchedOff) {
  const TestRun run = SinumerikTest().Run(
      std::string(kStart) + "CYCLE832(0.01,_ORI_ROUGH,1)\nG1 F500 X1\nCYCLE832()\nX2\n");
  EXPECT_NEAR(run.Last(5).facts.corner_rounding, 0.01, 1e-12) << run.Text();
  EXPECT_NEAR(run.Last(5).facts.orientation_tolerance, Radians(1.0), 1e-12);
  // What may lean and is not widened by it is doubt.
  EXPECT_TRUE(std::any_of(
      run.summary.assumptions.begin(), run.summary.assumptions.end(),
      [](const Assumption& a) { return a.name == "orientation tolerance" && a.places_metal; }));
  EXPECT_EQ(run.Last(7).facts.corner_rounding, 0.0);
}

TEST(SinumerikTraori, WhatIsNotSimulatedIsNamed) {
  for (const std::string block : {"CYCLE61(1,2)", "G33 Z1 K1", "LEAD=5", "M77", "POS[X]=1",
                                  "G58 X1", "TRACYL(40)", "RNDM=2 X1", "H5", "TOROT"}) {
    const TestRun run = SinumerikTest().Run(std::string(kStart) + "G1 F500 X1\n" + block + "\n");
    EXPECT_TRUE(run.Has(Rule::kUnsupportedCode)) << block << run.Text();
  }
}

TEST(SinumerikTraori, ACycleThatIsCalledModallyIsNamedAtItsCall) {
  const TestRun run = SinumerikTest().Run("G54 G0 Z20 D1\nMCALL CYCLE61(1)\nX1\nX2\nMCALL\nX3\n");
  ASSERT_EQ(run.findings.size(), 1u) << run.Text();
  EXPECT_EQ(run.findings[0].where.line, 2);
}

}  // namespace
}  // namespace ncsim::control
