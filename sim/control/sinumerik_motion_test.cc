// SPDX-License-Identifier: BSD-3-Clause
// Motion and frames of the SINUMERIK. Places: NC programming 12/2019 ("manual"); machine data by
// number. Machine values are worked out by hand from G54 X10 Y20 Z-250 and T1 of 100 mm.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/control/sinumerik_test_machine.h"

namespace ncsim::control {
namespace {

constexpr const char* kHead = "G54 G90 D1\nG0 X0 Y0 Z50 B0 C0\n";

std::string Head(const std::string& rest) { return kHead + rest; }

TEST(SinumerikMotion, StartsInG1WithoutAnOffset) {
  // MD20150: G1, G500. A G1 without F is alarm 10860.
  const TestRun run = SinumerikTest().Run("X10\n");
  ASSERT_TRUE(run.Has(Rule::kFeedMissing)) << run.Text();
  const TestRun rapid = SinumerikTest().Run("G0 X10 D0\n");
  EXPECT_EQ(EndOf(rapid, 1), "X10 Y0 Z0 B0 C0");
}

TEST(SinumerikMotion, ToolLengthGoesWithTheNextMoveOfItsAxis) {
  // Manual, "Tool offsets": D moves nothing.
  const TestRun run = SinumerikTest().Run("G54 G0 X0 Y0 D0\nZ50\nX1 D1\nZ50\n");
  EXPECT_EQ(EndOf(run, 2), "X10 Y20 Z-200 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 3), "X11 Y20 Z-200 B0 C0");
  EXPECT_EQ(EndOf(run, 4), "X11 Y20 Z-100 B0 C0");
}

TEST(SinumerikMotion, SupaSuppressesFramesButNotTheLength) {
  // MD10760 = 0: the length stays, so that posts write D0.
  SinumerikTest control;
  const std::string text = Head("SUPA G0 Z-150\nSUPA Z0 D0\nX1\n");
  EXPECT_EQ(EndOf(control.Run(text), 3), "X10 Y20 Z-50 B0 C0");
  EXPECT_EQ(EndOf(control.Run(text), 4), "X10 Y20 Z0 B0 C0");
  EXPECT_EQ(EndOf(control.Run(text), 5), "X11 Y20 Z0 B0 C0");
  control.job.control["MD10760"] = "1";
  EXPECT_EQ(EndOf(control.Run(text), 3), "X10 Y20 Z-150 B0 C0");
}

TEST(SinumerikMotion, IncrementalMovesGoTheShiftToo) {
  // SD42440, SD42442 = 1.
  SinumerikTest control;
  const std::string text = "G0 G90 D0 X5\nG91 G54 X1\nX1\nZ-1 D1\n";
  EXPECT_EQ(EndOf(control.Run(text), 2), "X16 Y0 Z0 B0 C0");
  EXPECT_EQ(EndOf(control.Run(text), 3), "X17 Y0 Z0 B0 C0");
  control.job.control["SD42440"] = "0";
  EXPECT_EQ(EndOf(control.Run(text), 2), "X6 Y0 Z0 B0 C0");
}

TEST(SinumerikMotion, AcAndIcOverrideTheModalDimension) {
  const TestRun run = SinumerikTest().Run(Head("G91 X5 Y=AC(7)\nG90 X=IC(2) Y=IC(-1)\n"));
  EXPECT_EQ(EndOf(run, 3), "X15 Y27 Z-100 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 4), "X17 Y26 Z-100 B0 C0");
}

TEST(SinumerikMotion, CornersAreRoundedAndChamfered) {
  // NC programming 12/2019, "Chamfer, rounding": CHR is the way on each line, CHF the chamfer
  // itself.
  const auto ways = [](const std::string& corner, const std::string& to = "Y10") {
    const TestRun run =
        SinumerikTest().Run(Head("G1 F500 X10 " + corner + "\n" + to + "\nX0\nG0 Z100\n"));
    std::string text;
    for (const motion::Motion& motion : run.motions) {
      if (motion.where.line < 3 || motion.where.line > 4) continue;
      text += Short(motion.q1()[kJointX] - 10.0) + "," + Short(motion.q1()[kJointY] - 20.0) + " ";
    }
    const Finding* finding = run.Find(Rule::kUnsupportedCode);
    return text + (finding == nullptr ? "" : finding->message);
  };
  EXPECT_EQ(ways("RND=2"), "8,0 10,2 10,10 ");
  EXPECT_EQ(ways("CHR=2"), "8,0 10,2 10,10 ");
  EXPECT_EQ(ways("CHF=SQRT(8)"), "8,0 10,2 10,10 ");
  // At 60 deg of turn a chamfer of 3 sqrt(3) lies 3 from the corner.
  EXPECT_EQ(ways("CHF=3*SQRT(3)", "X=10+10*COS(60) Y=10*SIN(60)"), "7,0 11.5,2.5981 15,8.6603 ");
  EXPECT_EQ(ways("RND=0"), "10,0 10,10 ");
  EXPECT_EQ(
      ways("RND=11"),
      "10,0 10,10 RND, CHR or CHF was not simulated here: corner rounding RND=11 mm needs 11 mm "
      "of moves that are 10 and 10 mm long");
  EXPECT_EQ(
      ways("CHF=1", "G2 Y10 CR=6"),
      "10,0 10,10 RND, CHR or CHF was not simulated here: chamfer CHF=1 mm is not followed by a "
      "linear move (G01)");
  EXPECT_EQ(ways("RNDM=1").substr(0, 30), "10,0 10,10 RNDM was not simula");
}

TEST(SinumerikMotion, FixedPointsAreMachineData) {
  SinumerikTest control;
  control.job.control["MD30600[0,Z]"] = "-5";
  control.job.control["MD30600[1,Z]"] = "-7";
  control.job.control["MD30600[1,B]"] = "30";
  EXPECT_EQ(EndOf(control.Run(Head("G75 Z1=0\n")), 3), "X10 Y20 Z-5 B0 C0");
  EXPECT_EQ(EndOf(control.Run(Head("G75 FP=2 Z=0 B=0\n")), 3), "X10 Y20 Z-7 B30 C0");
  const TestRun run = control.Run(Head("G75 X=0\n"));
  ASSERT_TRUE(run.Has(Rule::kUnsupportedCode));
  EXPECT_EQ(run.Find(Rule::kUnsupportedCode)->message,
            "G75 without MD30600 of X was not simulated");
  EXPECT_TRUE(control.Run(Head("G75 FP=5 Z=0\n")).Has(Rule::kControlAlarm));
}

TEST(SinumerikMotion, ModuloAxisStaysWithinItsTurnOrGoesTheShortestWay) {
  // MD30455 bit 2; manual, "Absolute dimensions for rotary axes (DC, ACP, ACN)".
  SinumerikTest control;
  const std::string text =
      Head("C350\nC10\nC=DC(350)\nC=ACP(10)\nC=ACN(20)\nC=IC(-30)\nC=ACP(351)\n");
  TestRun run = control.Run(text);
  const char* plain[] = {"350", "10", "-10", "10", "-340", "-370", "-369"};
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(EndOf(run, 3 + i), "X10 Y20 Z-100 B0 C" + std::string(plain[i])) << run.Text();
  }
  control.job.control["MD30455[C]"] = "4";
  run = control.Run(text);
  EXPECT_EQ(EndOf(run, 3), "X10 Y20 Z-100 B0 C-10") << run.Text();
  EXPECT_EQ(EndOf(run, 4), "X10 Y20 Z-100 B0 C10");
  // Bit 0 = 0: beyond 0 to 360 is alarm 16830.
  run = control.Run(Head("C=-10\n"));
  ASSERT_TRUE(run.Has(Rule::kControlAlarm));
  EXPECT_NE(run.Find(Rule::kControlAlarm)->message.find("16830"), std::string::npos);
}

TEST(SinumerikMotion, CirclesByCentreRadiusAndAngle) {
  // A quarter about X10 Y0 from X0 Y0, four ways (manual, "Circular interpolation").
  for (const std::string words : {"X10 Y10 I10 J0", "X10 Y10 I=AC(10) J=AC(0)", "X10 Y10 CR=10",
                                  "X10 Y10 AR=90", "I10 J0 AR=90"}) {
    const TestRun run = SinumerikTest().Run(Head("G2 F100 " + words + "\n"));
    ASSERT_EQ(run.motions.size(), 2u) << words << run.Text();
    const auto& arc = std::get<motion::AxisArc>(run.motions[1].path);
    EXPECT_NEAR(arc.radius, 10.0, 1e-9) << words;
    EXPECT_NEAR(arc.sweep, -kPi / 2.0, 1e-9) << words;
    EXPECT_NEAR(arc.q1[kJointX], 20.0, 1e-9) << words;
    EXPECT_NEAR(arc.q1[kJointY], 30.0, 1e-9) << words;
  }
  const TestRun long_way = SinumerikTest().Run(Head("G2 F100 X10 Y10 CR=-10\n"));
  EXPECT_NEAR(std::get<motion::AxisArc>(long_way.motions.at(1).path).sweep, -1.5 * kPi, 1e-9);
}

TEST(SinumerikMotion, CircleEndWithinTheToleranceMovesTheCentre) {
  // MD21000 = 0.01, MD21010 = 0.001: the greater of 0.01 mm and a thousandth of the radius.
  SinumerikTest control;
  TestRun run = control.Run(Head("G2 F100 X20.008 Y0 I10 J0\n"));
  ASSERT_EQ(run.motions.size(), 2u) << run.Text();
  const auto& arc = std::get<motion::AxisArc>(run.motions[1].path);
  EXPECT_NEAR(arc.centre.x(), 10.0 + 10.004, 1e-9);
  EXPECT_NEAR(arc.end_error.norm(), 0.0, 1e-9);
  run = control.Run(Head("G2 F100 X20.012 Y0 I10 J0\n"));
  ASSERT_TRUE(run.Has(Rule::kArcError));
  EXPECT_NE(run.Find(Rule::kArcError)->message.find("14040"), std::string::npos);
  EXPECT_FALSE(control.Run(Head("G2 F100 X40.018 Y0 I20 J0\n")).Has(Rule::kArcError));
}

TEST(SinumerikMotion, TurnMakesFullCirclesBefore) {
  // Two more circles than the half: 5 half turns, Z 10 down in proportion (manual, p. 205).
  const TestRun run = SinumerikTest().Run(Head("G3 F100 X20 Y0 Z40 I10 J0 TURN=2\n"));
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_NEAR(run.motions[1].q1()[kJointZ], -100.0 - 4.0, 1e-9);
  EXPECT_NEAR(run.motions[2].q1()[kJointZ], -100.0 - 8.0, 1e-9);
  EXPECT_NEAR(run.motions[3].q1()[kJointZ], -110.0, 1e-9);
  EXPECT_NEAR(std::get<motion::AxisArc>(run.motions[2].path).sweep, 2.0 * kPi, 1e-9);
}

TEST(SinumerikMotion, ThreePointsAndTangentMakeCircles) {
  // CIP in a plane that no G17 to G19 names: the half circle about (10, 0, 0) over (10, 0, 10).
  TestRun run = SinumerikTest().Run(Head("G1 F100 Z0\nCIP X20 Y0 Z0 I1=10 J1=6 K1=8\n"));
  ASSERT_EQ(run.motions.size(), 3u) << run.Text();
  const auto& arc = std::get<motion::AxisArc>(run.motions[2].path);
  EXPECT_NEAR(arc.radius, 10.0, 1e-9);
  EXPECT_NEAR((run.motions[2].At(0.5) - run.motions[2].q0())[kJointY], 6.0, 1e-9);
  EXPECT_NEAR((run.motions[2].At(0.5) - run.motions[2].q0())[kJointZ], 8.0, 1e-9);
  run = SinumerikTest().Run(Head("G1 F100 Z0\nCIP X20 I1=10 J1=0 K1=0\n"));
  EXPECT_NE(run.Text().find("14920"), std::string::npos) << run.Text();
  // CT after X+: a quarter up to X20 Y10 about X10 Y10.
  run = SinumerikTest().Run(Head("G1 F100 X10\nCT X20 Y10\n"));
  ASSERT_EQ(run.motions.size(), 3u) << run.Text();
  EXPECT_NEAR(std::get<motion::AxisArc>(run.motions[2].path).sweep, kPi / 2.0, 1e-9);
}

TEST(SinumerikFrames, TransAndRotMoveTheAxesTogether) {
  // Manual, "Frame instructions": TRANS deletes, AROT adds; RPY turns about Z, then Y', then X''.
  SinumerikTest control;
  TestRun run = control.Run(Head("TRANS X100 Y0\nAROT Z90\nG0 X10 Y0\nTRANS\nX0 Y0\n"));
  EXPECT_EQ(EndOf(run, 5), "X110 Y30 Z-100 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 7), "X10 Y20 Z-100 B0 C0");
  run = control.Run(Head("ROT RPL=90\nATRANS X5\nG0 X0 Y0\n"));
  EXPECT_EQ(EndOf(run, 5), "X10 Y25 Z-100 B0 C0");
  run = control.Run(Head("ROT X90 Z90\nG0 X1 Y2 Z3 D0\n"));
  // Rz(90) Rx(90): x to Y, y to Z, z to X.
  EXPECT_EQ(EndOf(run, 4), "X13 Y21 Z-248 B0 C0");
}

TEST(SinumerikFrames, MirrorAndScaleChangeArcs) {
  const TestRun run =
      SinumerikTest().Run(Head("MIRROR X0\nASCALE X2 Y2 Z2\nG2 F100 X10 Y10 I10 J0\n"));
  ASSERT_EQ(run.motions.size(), 2u) << run.Text();
  const auto& arc = std::get<motion::AxisArc>(run.motions[1].path);
  EXPECT_NEAR(arc.radius, 20.0, 1e-9);
  EXPECT_NEAR(arc.q1[kJointX], 10.0 - 20.0, 1e-9);
  const motion::JointVector middle = run.motions[1].At(0.5);
  EXPECT_NEAR(middle[kJointX], 10.0 - 20.0 * (1.0 - std::sqrt(0.5)), 1e-9);
  EXPECT_NEAR(middle[kJointY], 20.0 + 20.0 * std::sqrt(0.5), 1e-9);
  EXPECT_TRUE(
      SinumerikTest().Run(Head("SCALE X2\nG2 F100 X10 Y10 I10 J0\n")).Has(Rule::kUnsupportedCode));
}

TEST(SinumerikFrames, AnArcTurnsWithItsFrame) {
  // ROT X90 leads the XY plane to XZ: the middle of the quarter is 7.07 mm up.
  const TestRun run = SinumerikTest().Run(Head("G1 F100 Z0\nROT X90\nG2 X10 Y10 I10 J0\n"));
  ASSERT_EQ(run.motions.size(), 3u) << run.Text();
  const motion::JointVector way = run.motions[2].At(0.5) - run.motions[2].q0();
  EXPECT_NEAR(way[kJointX], 10.0 * (1.0 - std::sqrt(0.5)), 1e-9);
  EXPECT_NEAR(way[kJointY], 0.0, 1e-9);
  EXPECT_NEAR(way[kJointZ], 10.0 * std::sqrt(0.5), 1e-9);
}

TEST(SinumerikFrames, SystemVariablesHoldOffsetsAndEdges) {
  const std::string text =
      "$P_UIFR[1,X,TR]=$P_UIFR[1,X,TR]+5\n$P_UIFR[2]=CTRANS(X,1,Y,2,Z,-200)\n"
      "$TC_DP3[1,2]=110 $TC_DP6[1,2]=4\nG54 G0 X0\nG55 X0 Y0 Z0 D2\n"
      "R1=$AA_IM[X]+$P_TOOLNO\nX=R1\n";
  const TestRun run = SinumerikTest().Run(text);
  EXPECT_EQ(EndOf(run, 4), "X15 Y0 Z0 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 5), "X1 Y2 Z-90 B0 C0");
  EXPECT_EQ(EndOf(run, 7), "X3 Y2 Z-90 B0 C0");
}

TEST(SinumerikFrames, PolarCoordinates) {
  const TestRun run =
      SinumerikTest().Run(Head("G111 X10 Y0\nG0 AP=90 RP=5\nAP=180\nG110 X1\nRP=2 AP=0\n"));
  EXPECT_EQ(EndOf(run, 4), "X20 Y25 Z-100 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 5), "X15 Y20 Z-100 B0 C0");
  EXPECT_EQ(EndOf(run, 7), "X18 Y20 Z-100 B0 C0");
}

TEST(SinumerikTools, ByNameAndByNumber) {
  SinumerikTest control;
  TestRun run = control.Run("T=\"BALL_6\"\nM6\nG54 G0 Z0\n");
  EXPECT_EQ(EndOf(run, 3), "X0 Y0 Z-100 B0 C0") << run.Text();
  EXPECT_EQ(run.Last(3).facts.tool, 2);
  run = control.Run("T=\"ball_6\"\nM6\n");
  ASSERT_TRUE(run.Has(Rule::kToolMissing));
  EXPECT_NE(run.Find(Rule::kToolMissing)->message.find("17190"), std::string::npos);
  control.job.control["MD20270"] = "0";
  EXPECT_EQ(EndOf(control.Run("T2\nM6\nG54 G0 Z0\n"), 3), "X0 Y0 Z-250 B0 C0");
}

}  // namespace
}  // namespace ncsim::control
