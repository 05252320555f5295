// SPDX-License-Identifier: BSD-3-Clause
// TRAORI (NC programming 12/2019, "5-axis transformation"; machine data by number).
#include <gmock/gmock.h>
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

TEST(SinumerikTraori, Group50SaysWhatTheAnglesMeanIfMachineDataLetIt) {
  // MD21102 or MD21103 = 1.
  SinumerikTest control;
  const std::string text = std::string(kStart) + "ORIRPY ORIAXES G1 F500 A2=30 B2=30 C2=40\n";
  const auto tilt = [&] { return Degrees(control.Run(text).Last(4).q1()[kJointB]); };
  EXPECT_NEAR(tilt(), 30.0, 1e-9);  // Euler: B2 alone.
  // RPY: cos 30 cos 30.
  control.job.control["MD21103"] = "1";
  EXPECT_NEAR(tilt(), Degrees(std::acos(0.75)), 1e-9);
  const TestRun run = control.Run(std::string(kStart) + "ORIRPY2 ORIAXES G1 F500 A2=30\n");
  EXPECT_TRUE(run.Has(Rule::kUnsupportedCode)) << run.Text();
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
  EXPECT_EQ(run.Last(7).facts.corner_rounding, 0.0);
}

TEST(SinumerikTraori, Cycle832MakesTheOrientationToleranceByAFactor) {
  // Manual p. 1108: no tens digit in the type; SD55441 (roughing), standard value 10 deg a mm. Also
  // where TRAORI comes behind it.
  const std::string text =
      "CYCLE832(0.01,_ROUGH,1)\n" + std::string(kStart) + "G1 F500 X1\nX2 CYCLE832(0.02,_FINISH)\n";
  SinumerikTest control;
  TestRun run = control.Run(text);
  EXPECT_NEAR(run.Last(5).facts.orientation_tolerance, Radians(0.1), 1e-12) << run.Text();
  EXPECT_NEAR(run.Last(6).facts.orientation_tolerance, Radians(0.2), 1e-12);
  const auto assumed = [&run](const char* name) {
    return std::any_of(run.summary.assumptions.begin(), run.summary.assumptions.end(),
                       [&](const Assumption& a) { return a.name == name; });
  };
  EXPECT_TRUE(assumed("SD55441"));
  EXPECT_TRUE(assumed("SD55443"));
  control.job.control = {{"SD55441", "20"}, {"SD55443", "0"}};
  run = control.Run(text);
  EXPECT_NEAR(run.Last(5).facts.orientation_tolerance, Radians(0.2), 1e-12);
  EXPECT_FALSE(assumed("SD55441"));
  ASSERT_TRUE(run.Has(Rule::kUnsupportedCode));
  EXPECT_NE(run.Find(Rule::kUnsupportedCode)->message.find("MD33100"), std::string::npos);
}

TEST(SinumerikTraori, TorotTurnsZAlongTheTool) {
  // Manual, "TOFRAME, TOROT": Z is the tool's direction; G91 Z25 retracts it, in the machine Z
  // alone.
  SinumerikTest control;
  const TestRun run = control.Run(
      std::string(kStart) + "ORIAXES G0 X5 Y6 Z7 B30 C40\nTOROT\nG91 Z25\nG90 TOROTOF\nZ50\n");
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  ExpectTip(control, run, 6, Eigen::Vector3d(5, 6, 7) + 25.0 * Axis(30, 40), Axis(30, 40));
  const motion::JointVector way = run.Last(6).q1() - run.Last(6).q0();
  EXPECT_NEAR(way[kJointX], 0.0, 1e-9);
  EXPECT_NEAR(way[kJointY], 0.0, 1e-9);
  EXPECT_NEAR(way[kJointZ], 25.0, 1e-9);
  Eigen::Vector3d end = Eigen::Vector3d(5, 6, 7) + 25.0 * Axis(30, 40);
  end.z() = 50.0;
  ExpectTip(control, run, 8, end, Axis(30, 40));
}

TEST(SinumerikTraori, SmoothingTurnsTheToolWithoutCycle832Too) {
  // OTOL; else MD33100, standard value 0.05 deg.
  const TestRun run = SinumerikTest().Run(
      std::string(kStart) +
      "G642 CTOL=0.01\nG1 F500 X1\nOTOL=0.2\nX2\nOTOL=-1 G60 COMPCAD\nX3\nCOMPOF X4\n");
  EXPECT_NEAR(run.Last(5).facts.orientation_tolerance, Radians(0.05), 1e-12) << run.Text();
  EXPECT_NEAR(run.Last(7).facts.orientation_tolerance, Radians(0.2), 1e-12);
  EXPECT_NEAR(run.Last(9).facts.orientation_tolerance, Radians(0.05), 1e-12);
  EXPECT_EQ(run.Last(10).facts.orientation_tolerance, 0.0);
}

/// The tool axis of a motion at s.
Eigen::Vector3d AxisAt(const SinumerikTest& control, const motion::Motion& motion, double s) {
  Eigen::Vector3d p_B, u_B;
  control.machine.five_axis->TipInTable(motion.At(s), 100.0, &p_B, &u_B);
  return u_B;
}

TEST(SinumerikTraori, FromThePoleTheAxesGoInProportionOrCTurnsFirst) {
  // MD21108: units 0, 1. At the start C is free; the circle to B30 C40 asks for C40.
  SinumerikTest control;
  const std::string text = std::string(kStart) + "ORIVECT G1 F500 X9 A3=" +
                           Fixed(std::sin(Radians(30)) * std::cos(Radians(40)), 12) +
                           " B3=" + Fixed(std::sin(Radians(30)) * std::sin(Radians(40)), 12) +
                           " C3=" + Fixed(std::cos(Radians(30)), 12) + "\n";
  TestRun run = control.Run(text);
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_LT((AxisAt(control, run.Last(4), 0.5) - Axis(15, 20)).norm(), 1e-9);
  ExpectTip(control, run, 4, {9, 0, 20}, Axis(30, 40));
  EXPECT_TRUE(std::any_of(run.summary.assumptions.begin(), run.summary.assumptions.end(),
                          [](const Assumption& a) { return a.name == "MD21108"; }));
  const std::size_t motions = run.motions.size();
  control.job.control["MD21108"] = "1";
  run = control.Run(text);
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  ASSERT_EQ(run.motions.size(), motions + 1);
  const motion::Motion& turn = run.motions[motions - 1];
  EXPECT_NEAR(Degrees((turn.q1() - turn.q0())[kJointC]), 40.0, 1e-9);
  for (int i = 0; i <= 50; ++i) {
    Eigen::Vector3d p_B, u_B;
    control.machine.five_axis->TipInTable(turn.At(i / 50.0), 100.0, &p_B, &u_B);
    EXPECT_LT((p_B - Eigen::Vector3d(10, 20, 70)).norm(), 1e-9);
    EXPECT_LT((u_B - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    // Then along the circle, which is a meridian: B in proportion, C at rest.
    EXPECT_LT((AxisAt(control, run.Last(4), i / 50.0) - Axis(30.0 * i / 50.0, 40)).norm(), 1e-9);
    EXPECT_NEAR(Degrees(run.Last(4).At(i / 50.0)[kJointC]), 40.0, 1e-7);
  }
  ExpectTip(control, run, 4, {9, 0, 20}, Axis(30, 40));
  for (const char* mode : {"2", "100"}) {
    control.job.control["MD21108"] = mode;
    EXPECT_EQ(control.Run(text).Has(Rule::kUnsupportedCode), true) << mode;
  }
}

TEST(SinumerikTraori, ARepeatedVectorTurnsNothing) {
  // As posts write them: in every block. The rotary axes keep their bits, also behind a circle that
  // has led C on past 360 deg with a work offset of C.
  SinumerikTest control;
  control.SetOffset("G54", {{'X', 10.0}, {'Y', 20.0}, {'Z', -250.0}, {'C', 33.3}});
  const std::string vector = " A3=0.3 B3=-0.05 C3=1\n";
  const TestRun run = control.Run(
      std::string(kStart) + "ORIVECT G1 F500 A3=0.3 B3=0.1 C3=1\nX1" + vector + "X2" + vector +
      "X3 A3=0.6 B3=-0.1 C3=2\nA3=0.3 B3=0.2 C3=1\n" + "X5 B21 C10\nX6 B21 C10\nX7" + vector);
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  for (const int line : {6, 7, 10}) {
    const motion::Motion& motion = run.Last(line);
    EXPECT_EQ(motion.q0()[kJointB], motion.q1()[kJointB]) << line;
    EXPECT_EQ(motion.q0()[kJointC], motion.q1()[kJointC]) << line;
  }
}

TEST(SinumerikTraori, ThroughThePoleAndBesideIt) {
  // B10 to 5 degrees on the other side: through the pole, B-5. From B10 C0 to a tilt of 10 at 120:
  // the circle keeps atan(tan 10 cos 60) = 5.04 degrees off, so that C turns all the way.
  SinumerikTest control;
  const std::string head = std::string(kStart) + "ORIVECT G1 F500 B10 C0\n";
  TestRun run = control.Run(head + "A3=" + Fixed(-std::tan(Radians(5)), 12) + " C3=1 X1\n");
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_NEAR(Degrees(run.Last(5).At(0.5)[kJointB]), 2.5, 1e-9);
  EXPECT_NEAR(Degrees(run.Last(5).q1()[kJointB]), -5.0, 1e-9);
  EXPECT_NEAR(Degrees(run.Last(5).q1()[kJointC]), 0.0, 1e-9);
  const double t = std::tan(Radians(10));
  run = control.Run(head + "A3=" + Fixed(-0.5 * t, 12) +
                    " B3=" + Fixed(0.75 * t / std::sqrt(0.75), 12) + " C3=1 X1\n");
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_NEAR(Degrees(run.Last(5).q1()[kJointB]), 10.0, 1e-9);
  EXPECT_NEAR(Degrees(run.Last(5).q1()[kJointC]), 120.0, 1e-7);
  EXPECT_NEAR(Degrees(run.Last(5).At(0.5)[kJointB]), Degrees(std::atan(0.5 * t)), 1e-6);
  // Within MD24540 = 6 degrees the axes go in proportion, B at rest, and to the nearer position.
  control.job.control["MD24540"] = "6";
  run = control.Run(head + "B10 C120 X1\n");
  EXPECT_NEAR(Degrees(run.Last(5).At(0.5)[kJointB]), 10.0, 1e-9);
  EXPECT_NEAR(Degrees(run.Last(5).At(0.5)[kJointC]), 60.0, 1e-9);
}

TEST(SinumerikTraori, BehindTheLimitsMd21180Decides) {
  // From B0 C0 a tilt of 45 degrees towards X- is B-45 C0, which B does not reach, or B45 C180.
  SinumerikTest control;
  const std::string text = std::string(kStart) + "ORIAXES G1 F500 A3=-1 C3=1 X1\n";
  TestRun run = control.Run(text);
  // Nobody has read it off the machine: not known, and simulated at the other position.
  ASSERT_EQ(run.findings.size(), 1u) << run.Text();
  EXPECT_EQ(run.findings[0].rule, Rule::kUnsupportedCode);
  EXPECT_NE(run.findings[0].message.find("10720"), std::string::npos) << run.Text();
  ExpectTip(control, run, 4, {1, 0, 20}, Axis(45, 180));
  control.job.control["MD21180"] = "0";
  run = control.Run(text);
  ASSERT_TRUE(run.Has(Rule::kControlAlarm)) << run.Text();
  const std::string& message = run.Find(Rule::kControlAlarm)->message;
  for (const char* words :
       {"10720", "at B-45.000 C0.000", "B45.000 C-180.000 would do", "MD21180 = 0"}) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
  control.job.control["MD21180"] = "1";
  run = control.Run(text);
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  ExpectTip(control, run, 4, {1, 0, 20}, Axis(45, 180));
}

TEST(SinumerikTraori, VectorsTurnWithTheFrameUnderOriwksOnly) {
  // Manual p. 674: ORIWKS, ORIMKS. ROT Y30 leans Z of the part to B30.
  SinumerikTest control;
  const std::string text = std::string(kStart) + "ROT Y30\nG0 C3=1 X0 Y0 Z20 ";
  TestRun run = control.Run(text + "ORIWKS\n");
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_NEAR(Degrees(run.Last(5).q1()[kJointB]), 30.0, 1e-9);
  run = control.Run(text + "ORIMKS\n");
  EXPECT_NEAR(Degrees(run.Last(5).q1()[kJointB]), 0.0, 1e-9);
}

// OTOL holds for compressors and G642 to G645, not for G641 (programming manual 06/2009, p. 566).
TEST(SinumerikTraori, OtolOrWhatIsAssumedOfIt) {
  const std::string feeds =
      "G642 CTOL=0.02 OTOL=0.5\nG1 F500 X1\nG641 ADIS=0.3\nX2\nG645 OTOL=-1\nX3\nG60\nX4\n";
  const TestRun run = SinumerikTest().Run(std::string(kStart) + feeds);
  EXPECT_NEAR(run.Last(5).facts.corner_rounding, 0.02, 1e-12) << run.Text();
  EXPECT_NEAR(run.Last(5).facts.orientation_tolerance, Radians(0.5), 1e-12);
  EXPECT_EQ(run.Last(7).facts.orientation_tolerance, 0.0);
  EXPECT_NEAR(run.Last(9).facts.orientation_tolerance, Radians(0.05), 1e-12);
  EXPECT_EQ(run.Last(11).facts.orientation_tolerance, 0.0);
  EXPECT_EQ(std::count_if(run.summary.assumptions.begin(), run.summary.assumptions.end(),
                          [](const Assumption& a) { return a.name == "orientation tolerance"; }),
            1);
}

// Programming manual 07/2010 of the 828D, p. 494: G0 has the same tolerances, times a factor that
// is 1 as delivered. SD42466: without TRAORI nothing of the orientation is smoothed.
TEST(SinumerikTraori, RapidsAreSmoothedToo) {
  const std::string smooth =
      "CYCLE832(0.01,_ORI_ROUGH,1)\nG0 X1\nTRAFOOF\nG54\nG0 X2\nG1 F500 X3\n";
  const TestRun run = SinumerikTest().Run(std::string(kStart) + smooth);
  EXPECT_NEAR(run.Last(5).facts.corner_rounding, 0.01, 1e-12) << run.Text();
  EXPECT_NEAR(run.Last(5).facts.orientation_tolerance, Radians(1.0), 1e-12);
  for (const int line : {8, 9}) {
    EXPECT_NEAR(run.Last(line).facts.corner_rounding, 0.01, 1e-12) << line;
    EXPECT_EQ(run.Last(line).facts.orientation_tolerance, 0.0) << line;
  }
}

// The rotations of MD21094 worked out by hand for normal Z and tangent X, LEAD 10, TILT 20.
TEST(SinumerikTraori, LeadAndTiltByMd21094) {
  const double s = std::sin(Radians(10.0)), c = std::cos(Radians(10.0));
  const double st = std::sin(Radians(20.0)), ct = std::cos(Radians(20.0));
  const Eigen::Vector3d expected[] = {{s * ct, s * st, c},
                                      {s, -c * st, c * ct},
                                      {s * ct, -st, c * ct},
                                      {s * ct, -st, c * ct},
                                      {s, -st * c, ct * c}};
  SinumerikTest control;
  for (int order = 0; order < 5; ++order) {
    control.job.control["MD21094"] = std::to_string(10 * order);
    for (const std::string code : {"ORIVECT", "ORIPATH"}) {
      const TestRun run = control.Run(std::string(kStart) + code + " G1 F500 X5 LEAD=10 TILT=20\n");
      ExpectTip(control, run, 4, {5, 0, 20}, expected[order]);
      EXPECT_TRUE(run.findings.empty()) << run.Text();
      EXPECT_TRUE(run.Assumed("LEAD") && run.Assumed("TILT"));
    }
  }
  // Backwards along Y, against a normal that leans to X: across it, so LEAD stays in their plane.
  control.job.control.clear();
  TestRun run = control.Run(std::string(kStart) + "G1 F500 Y-5 A4=1 C4=1 LEAD=10 TILT=0\nY-6\n");
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 0, 1).normalized();
  ExpectTip(control, run, 4, {0, -5, 20}, c * normal - s * Eigen::Vector3d::UnitY());
  ExpectTip(control, run, 5, {0, -6, 20}, c * normal - s * Eigen::Vector3d::UnitY());
  EXPECT_FALSE(run.Assumed("TILT"));
  // The normal of a block's end holds on; both angles 0: along it, whatever their sense.
  run = control.Run(std::string(kStart) + "G1 F500 X5 A5=1 C5=1 A3=0 C3=1\nY5 LEAD=0 TILT=0\n");
  ExpectTip(control, run, 5, {5, 5, 20}, normal);
  EXPECT_FALSE(run.Assumed("LEAD") || run.Assumed("TILT"));
  EXPECT_TRUE(run.findings.empty()) << run.Text();
}

TEST(SinumerikTraori, LeadAtTheEndOfAnArc) {
  // A quarter from X10 to Y10 about the zero, in the sense of G3, ends against X; in that of G2
  // from Y10 to X10 against Y; CIP through the middle as G3.
  const double s = std::sin(Radians(10.0)), c = std::cos(Radians(10.0));
  const SinumerikTest control;
  const std::string to = std::string(kStart) + "G1 F500 X10\n", both = " LEAD=10 TILT=0\n";
  for (const std::string arc : {"G3 X0 Y10 I-10 J0", "G3 X0 Y10 CR=10", "G3 AR=90 I-10 J0",
                                "CIP X0 Y10 I1=10*COS(45) J1=10*SIN(45)"}) {
    const TestRun run = control.Run(to + arc + both);
    EXPECT_TRUE(run.findings.empty()) << arc << run.Text();
    ExpectTip(control, run, 5, {0, 10, 20}, {-s, 0, c});
    EXPECT_EQ(run.Last(5).kind, motion::MotionKind::kArc);
  }
  const TestRun back = control.Run(to + "Y10 X0\nG2 X10 Y0 CR=10" + both);
  ExpectTip(control, back, 6, {10, 0, 20}, {0, -s, c});
}

TEST(SinumerikTraori, LeadAndTiltAreNamedWhereTheyAreNotClear) {
  SinumerikTest control;
  const auto message = [&](const std::string& text) {
    const TestRun run = control.Run(std::string(kStart) + "G1 F500 " + text + "\n");
    const Finding* found = run.Find(Rule::kUnsupportedCode);
    return found == nullptr ? run.Text() : found->message;
  };
  const std::string both = " LEAD=5 TILT=0";
  EXPECT_THAT(message("B10" + both), ::testing::HasSubstr("neither a line nor a flat arc"));
  EXPECT_THAT(message("\nG2 X10 Z18 CR=9" + both), ::testing::HasSubstr("nor a flat arc"));
  EXPECT_THAT(message("ORIPATH\nG2 X10 CR=9"), ::testing::HasSubstr("both angles"));
  EXPECT_THAT(message("ORIMKS X1" + both), ::testing::HasSubstr("ORIMKS"));
  EXPECT_THAT(message("X1" + both + " A3=1"), ::testing::HasSubstr("LEAD"));
  EXPECT_THAT(message("X1 A5=1" + both), ::testing::HasSubstr("normal is along the path"));
  EXPECT_THAT(message("X1 C5=0" + both), ::testing::HasSubstr("normal is along the path"));
  EXPECT_THAT(message("X1" + both + "\nX2 TILT=1"), ::testing::HasSubstr("both angles"));
  EXPECT_THAT(message("ORIPATH X1" + both + "\nX2"), ::testing::HasSubstr("both angles"));
  EXPECT_THAT(message("TRAFOOF\nG54 X1" + both), ::testing::HasSubstr("without TRAORI"));
  control.job.control["MD21094"] = "1";
  EXPECT_THAT(message("ORIPATH X1" + both), ::testing::HasSubstr("MD21094 = 1"));
  EXPECT_EQ(message("ORIVECT X1" + both), "");
}

TEST(SinumerikTraori, WhatIsNotSimulatedIsNamed) {
  for (const std::string block :
       {"CYCLE61(1,2)", "G34 Z1 K1", "LEAD=5 TILT=1", "ORIPATH X2", "M77", "POS[X]=1", "TRACYL(40)",
        "POSA[X]=1", "H5", "TOROTX", "TOROT X1", "CYCLE832(0.01,112101)", "ASCALE X2\nA3=1 C3=1"}) {
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
