// SPDX-License-Identifier: BSD-3-Clause
// Motion and frames of the SINUMERIK. Places: NC programming 12/2019 ("manual"); machine data by
// number. Machine values are worked out by hand from G54 X10 Y20 Z-250 and T1 of 100 mm.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

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
  EXPECT_EQ(ways("RND=11"),
            "10,0 10,10 RND, RNDM, CHR or CHF was not simulated here: corner rounding RND=11 mm "
            "needs 11 mm "
            "of moves that are 10 and 10 mm long");
  EXPECT_EQ(ways("CHF=1", "G2 Y10 CR=6"),
            "10,0 10,10 RND, RNDM, CHR or CHF was not simulated here: chamfer CHF=1 mm is not "
            "followed by a "
            "linear move (G01)");
}

TEST(SinumerikMotion, RndmRoundsUntilItIs0) {
  // The same manual: in the block that leads to the corner, as RND in each such block.
  const auto points = [](const std::string& text) {
    std::string ends;
    const TestRun run = SinumerikTest().Run(Head("G1 F500 Z10\n" + text));
    for (const motion::Motion& motion : run.motions) {
      ends += Short(motion.q1()[kJointX]) + "," + Short(motion.q1()[kJointY]) + " ";
    }
    return ends + run.Text();
  };
  EXPECT_EQ(points("RNDM=2 X10\nY10\nX0 RNDM=0\nY0\n"), points("X10 RND=2\nY10 RND=2\nX0\nY0\n"));
  EXPECT_EQ(points("RNDM=2\nX10\nG4 F1\nY10\nRNDM=0 X0\nG0 Z20\n"),
            points("X10 RND=2\nG4 F1\nY10 RND=2\nX0\nG0 Z20\n"));
  for (const char* what : {"RNDM=2 X10\nY10 RND=1\nX0 RNDM=0\n", "RNDM=2 X10\nG0 Y10\n",
                           "RNDM=2 X10\nZ9\nX0 RNDM=0\n", "RNDM=2 X10\nG2 X0 CR=9\n"}) {
    EXPECT_TRUE(
        SinumerikTest().Run(Head(std::string("G1 F500\n") + what)).Has(Rule::kUnsupportedCode))
        << what;
  }
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

// NC programming 12/2019, p. 315: X15 Y15 Z10, X25 Y15 Z10, X30 Y20 Z10.
TEST(SinumerikFrames, G58AndG59ReplaceOneShiftEach) {
  const std::string head = "TRANS X10 Y10 Z10\nATRANS X5 Y5\n";
  const std::string text = head + "G0 X0 Y0 Z0\nG58 X20\nX0 Y0\nG59 X10 Y10\nX0 Y0\n";
  SinumerikTest control;
  const TestRun run = control.Run(Head(text));
  EXPECT_EQ(EndOf(run, 5), "X25 Y35 Z-140 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 7), "X35 Y35 Z-140 B0 C0");
  EXPECT_EQ(EndOf(run, 9), "X40 Y40 Z-140 B0 C0");
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_TRUE(run.Assumed("MD24000"));
  control.job.control["MD24000"] = "1";
  EXPECT_FALSE(control.Run(Head(text)).Assumed("MD24000"));
  const std::string parts = "R1=$P_PFRAME[X,TR]*100+$P_PFRAME[X,FI]\nTRANS\nG0 X=R1/100\n";
  EXPECT_EQ(EndOf(control.Run(Head(head + parts)), 7), "X20.05 Y20 Z-100 B0 C0");
  // Shifts lie before the turn: a fine one that ATRANS has made in turned axes, too.
  const TestRun turned = control.Run(Head("ROT Z90\nATRANS X5\nG58 X1\nG0 X0 Y0\nG59 Y2\nX0 Y0\n"));
  EXPECT_EQ(EndOf(turned, 6), "X11 Y25 Z-100 B0 C0") << turned.Text();
  EXPECT_EQ(EndOf(turned, 8), "X11 Y22 Z-100 B0 C0");
  // What TRANS leaves of ATRANS is not clear, where they are kept apart; TRANS alone deletes all.
  const std::string twice = head + "TRANS X1\nG0 X0\n", deleted = head + "TRANS\nG58 X1\nG0 X0\n";
  EXPECT_TRUE(control.Run(Head(twice)).Has(Rule::kUnsupportedCode));
  EXPECT_EQ(EndOf(control.Run(Head(deleted)), 7).substr(0, 7), "X11 Y20");
  control.job.control.clear();
  EXPECT_TRUE(control.Run(Head(twice)).findings.empty());
  EXPECT_TRUE(control.Run(Head(twice + "G58 X2\n")).Has(Rule::kUnsupportedCode));
  control.job.control["MD24000"] = "0";
  EXPECT_TRUE(control.Run(Head(text)).Has(Rule::kUnsupportedCode));
  EXPECT_TRUE(control.Run(Head(twice)).findings.empty());
}

// K2 08/2005, p. 2-101: X and Y turn Y and X into the plane's traces; the new X is in the old ZX
// plane. Z and X, Y and Z: the same with the axes in a circle.
TEST(SinumerikFrames, SolidAnglesAreThoseOfThePlanesTraces) {
  const double a = Radians(10.0), b = Radians(20.0);
  const Eigen::Vector3d x(std::cos(b), 0.0, -std::sin(b));
  const Eigen::Vector3d z = Eigen::Vector3d(std::tan(b), -std::tan(a), 1.0).normalized();
  const auto way = [](const std::string& turn, const std::string& words) {
    const TestRun run = SinumerikTest().Run(Head(turn + "\nG0 X0 Y0 Z0\n" + words + "\n"));
    EXPECT_TRUE(run.findings.empty()) << run.Text();
    const int line = 5 + static_cast<int>(std::count(turn.begin(), turn.end(), '\n'));
    const motion::JointVector q = run.Last(line).q1() - run.Last(line).q0();
    return Eigen::Vector3d(q[kJointX], q[kJointY], q[kJointZ]);
  };
  const auto circle = [](const Eigen::Vector3d& v, int by) {
    Eigen::Vector3d turned;
    for (int i = 0; i < 3; ++i) turned[(i + by) % 3] = v[i];
    return turned;
  };
  EXPECT_LT((way("ROTS X10 Y20", "X1") - x).norm(), 1e-9);
  EXPECT_LT((way("ROTS X10 Y20", "Y1") - z.cross(x)).norm(), 1e-9);
  EXPECT_LT((way("ROTS X10 Y20", "Z1") - z).norm(), 1e-9);
  EXPECT_LT((way("ROTS Y10 Z20", "Y1") - circle(x, 1)).norm(), 1e-9);
  EXPECT_LT((way("ROTS Y10 Z20", "X1") - circle(z, 1)).norm(), 1e-9);
  EXPECT_LT((way("ROTS Z10 X20", "Z1") - circle(x, 2)).norm(), 1e-9);
  EXPECT_LT((way("ROTS Y20", "X1") - x).norm(), 1e-9);
  // AROTS adds: behind a turn of Z by 90 degrees, which takes x y z to y -x z.
  const Eigen::Vector3d added = way("ROT Z90\nAROTS X10 Y20", "X1");
  EXPECT_LT((added - Eigen::Vector3d(-x.y(), x.x(), x.z())).norm(), 1e-9);
  for (const std::string turn : {"ROTS X1 Y1 Z1", "ROTS X90 Y1"}) {
    EXPECT_TRUE(SinumerikTest().Run(Head(turn + "\n")).Has(Rule::kUnsupportedCode)) << turn;
  }
}

TEST(SinumerikFrames, AnIncrementalMoveBehindATurnIsSaid) {
  // SD42440 = 1 speaks of offsets only. Not where the axis stands in the zero, nor behind TRANS.
  EXPECT_TRUE(SinumerikTest().Run(Head("X10\nAROT Z30\nG91 X5\n")).Has(Rule::kUnsupportedCode));
  EXPECT_FALSE(SinumerikTest().Run(Head("AROT Z30\nG91 X5\n")).Has(Rule::kUnsupportedCode));
  EXPECT_FALSE(
      SinumerikTest().Run(Head("X10\nAROT Z30\nX0 Y0\nG91 X5\n")).Has(Rule::kUnsupportedCode));
  EXPECT_FALSE(SinumerikTest().Run(Head("X10\nATRANS X3\nG91 X5\n")).Has(Rule::kUnsupportedCode));
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

TEST(SinumerikMotion, SaveBringsBackGCodesAndFrame) {
  // Manual, "Subprograms with SAVE"; M30 in a subprogram returns as M17 does and stops no spindle,
  // nor does M0.
  const std::string sub = "M30\n%_N_SUB_SPF\nPROC SUB SAVE\nG91 G0 TRANS X100\nG55 G70\nM30\n";
  const TestRun run = SinumerikTest().Run(Head("S100 M3\nG1 F100\nSUB\nX5\nM0\nX6\n") + sub);
  EXPECT_FALSE(run.Has(Rule::kControlAlarm)) << run.Text();
  EXPECT_EQ(EndOf(run, 6), "X15 Y20 Z-100 B0 C0");
  EXPECT_EQ(run.Last(6).kind, motion::MotionKind::kFeed);
  EXPECT_TRUE(run.Last(6).facts.spindle_on);
  EXPECT_TRUE(run.Last(8).facts.spindle_on);
  // Without SAVE all of it stays: G0, G91, inches, the frame.
  std::string plain = sub;
  plain.erase(plain.find(" SAVE"), 5);
  const TestRun kept = SinumerikTest().Run(Head("S100 M3\nG1 F100\nSUB\nX1\n") + plain);
  EXPECT_EQ(kept.Last(6).kind, motion::MotionKind::kRapid) << kept.Text();
}

TEST(SinumerikMotion, CompensationNeedsAnEdge) {
  // Alarm 10750.
  const TestRun run = SinumerikTest().Run(Head("D0 G1 F100 G41 X5 Y5\nX20\nG40 X30\n"));
  EXPECT_NE(run.Text().find("10750"), std::string::npos) << run.Text();
}

TEST(SinumerikMotion, NormGoesStraightBesideTheContourHoweverNearItStarts) {
  // W1 09/2011, 18.5.3: NORM goes on a line to where the normal of the contour's start has the
  // centre, from behind the contour too, and from its end likewise. Radius 5, left of Y is -X.
  const TestRun run = SinumerikTest().Run(Head("G1 F100 G41 X2\nY20\nG40 X3\nX4\n"));
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_EQ(EndOf(run, 3), "X7 Y20 Z-100 B0 C0");
  EXPECT_EQ(EndOf(run, 4), "X7 Y40 Z-100 B0 C0");
  EXPECT_EQ(EndOf(run, 5), "X13 Y40 Z-100 B0 C0");
}

TEST(SinumerikMotion, BottlenecksAreLookedForUnderCdonOnly) {
  // NC programming 12/2019, p. 286: CDOF looks at the corner with the next block only. A pocket
  // whose third side ends 6 from its first, for a tool of 10; each corner has room enough.
  const std::string pocket = " G1 F100 Y10\nG41 Y0\nY-20\nX30\nX6 Y0\nY1\nG40 Y20\n";
  const TestRun off = SinumerikTest().Run(Head("CDOF" + pocket));
  EXPECT_TRUE(off.findings.empty()) << off.Text();
  EXPECT_EQ(EndOf(off, 5).substr(0, 7), "X15 Y5 ");
  EXPECT_TRUE(SinumerikTest().Run(Head("CDON" + pocket)).Has(Rule::kUnsupportedCode));
}

TEST(SinumerikMotion, CirclesAboutThePole) {
  // Manual, "Circular interpolation with polar coordinates": the pole is the centre.
  const TestRun run = SinumerikTest().Run(Head("G111 X10 Y0\nG3 F100 RP=10 AP=270\n"));
  ASSERT_EQ(run.motions.size(), 2u) << run.Text();
  const auto& arc = std::get<motion::AxisArc>(run.motions[1].path);
  EXPECT_NEAR(arc.sweep, kPi / 2.0, 1e-9);
  EXPECT_NEAR(arc.q1[kJointX], 20.0, 1e-9);
  EXPECT_NEAR(arc.q1[kJointY], 10.0, 1e-9);
}

TEST(SinumerikMotion, ThreadsFeedByPitchAndSpeed) {
  // Manual, "Rigid tapping": 600 / min of 1.5 mm are 15 mm/s.
  const TestRun run = SinumerikTest().Run(Head("S600 SPOS=0\nG331 Z20 K1.5\nG332 Z50 K1.5\n"));
  ASSERT_EQ(run.motions.size(), 3u) << run.Text();
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_NEAR(run.motions[1].duration, 2.0, 1e-9);
  EXPECT_TRUE(run.motions[1].facts.spindle_on);
  EXPECT_EQ(EndOf(run, 5), "X10 Y20 Z-100 B0 C0");
  EXPECT_TRUE(SinumerikTest().Run(Head("G331 Z20 K1.5\n")).Has(Rule::kFeedMissing));
  EXPECT_TRUE(SinumerikTest().Run(Head("S600\nG331 Z20\n")).Has(Rule::kFeedMissing));
}

TEST(SinumerikMotion, PositionsOneAxisInABlock) {
  // Manual, "Positioning axes": with FA a feed of its own, under any G code of motion.
  const TestRun run = SinumerikTest().Run(Head("G3\nPOS[X]=5 FA[X]=600\nPOS[C]=DC(350)\n"));
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_EQ(run.Last(4).kind, motion::MotionKind::kFeed);
  EXPECT_NEAR(run.Last(4).duration, 0.5, 1e-9);
  EXPECT_EQ(EndOf(run, 5), "X15 Y20 Z-100 B0 C-10");
  // It is no path motion: a modal call (here of a cycle that is not simulated) does not follow it.
  EXPECT_FALSE(
      SinumerikTest().Run(Head("MCALL CYCLE61(1)\nPOS[X]=5\nMCALL\n")).Has(Rule::kUnsupportedCode));
  for (const char* block : {"POS[X]=5 POS[Y]=1", "POS[X]=1 Y2"}) {
    EXPECT_TRUE(SinumerikTest().Run(Head(std::string(block) + "\n")).Has(Rule::kUnsupportedCode));
  }
}

TEST(SinumerikMotion, PosaIsPosWhereWaitpFollows) {
  // Manual, "Positioning axes": the axis may go on beyond its block, and WAITP waits for it.
  TestRun run =
      SinumerikTest().Run(Head("POSA[X]=5 FA[X]=600\nR1=2\nWAITP(X)\nX7\nPOSA[C]=90\nM30\n"));
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_EQ(EndOf(run, 3), "X15 Y20 Z-100 B0 C0");
  EXPECT_NEAR(run.Last(3).duration, 0.5, 1e-9);
  EXPECT_EQ(EndOf(run, 7), "X17 Y20 Z-100 B0 C90");
  for (const char* rest : {"Y2", "WAITP(Y)\nY2", "POSA[Y]=2", "T2 M6", "SUPA G0 Z0 D0"}) {
    run = SinumerikTest().Run(Head("POSA[X]=5\n" + std::string(rest) + "\n"));
    const Finding* found = run.Find(Rule::kUnsupportedCode);
    ASSERT_NE(found, nullptr) << rest;
    EXPECT_EQ(found->message.substr(0, 4), "POSA");
  }
}

TEST(SinumerikMotion, FIsProgrammedAnewWhereItsKindChanges) {
  // Manual, "Feedrate": G94, G971 and G961 count minutes, G95 to G97 revolutions.
  const std::string head = Head("S1000 M3 G95 G1 X1 F.1\n");
  EXPECT_FALSE(SinumerikTest().Run(head + "G97 X2\n").Has(Rule::kFeedMissing));
  EXPECT_TRUE(SinumerikTest().Run(head + "G94 X2\n").Has(Rule::kFeedMissing));
}

TEST(SinumerikMotion, MachineDataSayHowItStarts) {
  // MD20730 = 0: G0 of each axis for itself until RTLION; what is not simulated is an assumption
  // that keeps the verdict from pass (MD20150, MD30330).
  SinumerikTest control;
  control.job.control = {{"MD20730", "0"}, {"MD20150[14]", "G96"}, {"MD30330[C]", "720"}};
  const TestRun run = control.Run("G54 D0 G0 X50 Y10\nRTLION X0 Y0\n");
  const auto middle = [&run](int line) {
    const motion::JointVector at = run.Last(line).At(0.5);
    return std::pair(at[kJointX], at[kJointY]);
  };
  EXPECT_NEAR(middle(1).second, 30.0, 1e-9) << run.Text();  // Y is there already.
  EXPECT_NEAR(middle(2).first - 10.0, 5.0 * (middle(2).second - 20.0), 1e-9);
  for (const char* name : {"MD20150[14]", "MD30330[C]"}) {
    EXPECT_TRUE(std::any_of(run.summary.assumptions.begin(), run.summary.assumptions.end(),
                            [&](const Assumption& a) { return a.name == name && a.places_metal; }))
        << name;
  }
}

TEST(SinumerikMotion, SmoothingLeavesRapidsToo) {
  // Manual, "Continuous-path mode": G641 takes ADISPOS for G0.
  const TestRun run =
      SinumerikTest().Run(Head("G641 ADIS=.5 ADISPOS=2\nX5\nG1 F100 X6\nG60 G0 X7\n"));
  EXPECT_NEAR(run.Last(4).facts.corner_rounding, 2.0, 1e-12) << run.Text();
  EXPECT_NEAR(run.Last(5).facts.corner_rounding, 0.5, 1e-12);
  EXPECT_EQ(run.Last(6).facts.corner_rounding, 0.0);
}

TEST(SinumerikFrames, VariablesOfActiveFrames) {
  // Manual, "Frame variables": $P_PFRAME and $P_IFRAME act at once, a chain from the left;
  // $P_UIFR when it is selected.
  SinumerikTest control;
  TestRun run =
      control.Run(Head("$P_PFRAME=CTRANS(X,100):CROT(Z,90)\nG0 X10 Y0\n"
                       "$P_PFRAME=$P_PFRAME:CTRANS(X,5)\nX10\n$P_PFRAME[X,TR]=7\nX0 Y0\n"
                       "R1=$P_ACTFRAME[X,TR]+$P_PFRAME[Z,RT]\nTRANS\nX=R1\n"));
  EXPECT_EQ(EndOf(run, 4), "X110 Y30 Z-100 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 6), "X110 Y35 Z-100 B0 C0");
  // The chain comes to a shift of 100, 5 and a turn of 90: then X is 7.
  EXPECT_EQ(EndOf(run, 8), "X17 Y25 Z-100 B0 C0");
  EXPECT_EQ(EndOf(run, 11), "X" + Short(10.0 + 17.0 + 90.0) + " Y25 Z-100 B0 C0");
  run =
      control.Run(Head("$P_IFRAME=CTRANS(X,1,Y,2,Z,-250)\nG0 X0 Y0\nG54 X0\n"
                       "$P_UIFR[2]=CTRANS(X,1):CTRANS(X,2,Z,-250):CROT(Z,90)\nG55 X5 Y0\n"));
  EXPECT_EQ(EndOf(run, 4), "X1 Y2 Z-100 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 5), "X10 Y2 Z-100 B0 C0");
  EXPECT_EQ(EndOf(run, 7), "X3 Y5 Z-100 B0 C0");
  run = control.Run(Head("$P_UIFR[2]=CROT(Z,30):CSCALE(X,2):CROT(Z,30)\n"));
  EXPECT_TRUE(run.Has(Rule::kUnsupportedCode)) << run.Text();
  run = control.Run(Head("$P_UIFR[2,X,SC]=0\n"));
  EXPECT_TRUE(run.Has(Rule::kControlAlarm)) << run.Text();
}

TEST(SinumerikFrames, BasicFramesAreNone) {
  // As control data write them out; a shift of one is not simulated.
  const TestRun run = SinumerikTest().Run(
      Head("$P_CHBFR[0]=CTRANS(X,0,Y,0):CROT(Z,0):CSCALE(X,1)\n$P_UBFR[X,TR]=0\n"
           "$P_BFRAME=CTRANS()\nR1=3+$P_CHBFR[0,X,TR]+$P_ACTBFRAME[Z,RT]\nG0 X=R1\n"));
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_EQ(EndOf(run, 7), "X13 Y20 Z-100 B0 C0");
  EXPECT_TRUE(run.Assumed("basic frame"));
  for (const char* block : {"$P_UBFR=CTRANS(X,1)", "$P_CHBFR[0,X,TR]=1", "$P_UBFR=CSCALE(X,2)"}) {
    EXPECT_TRUE(SinumerikTest().Run(Head(block)).Has(Rule::kUnsupportedCode)) << block;
  }
}

TEST(SinumerikMotion, AnAddressMayBeNamedByAnAxis) {
  // Manual, "Addresses": AX[X]=10 is X=10.
  const TestRun run =
      SinumerikTest().Run(Head("DEF AXIS _AX\n_AX=Y\nG0 AX[X]=3 AX[_AX]=IC(2) AX[$P_AXN3]=60\n"));
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_EQ(EndOf(run, 5), "X13 Y22 Z-90 B0 C0");
  EXPECT_NE(SinumerikTest().Run(Head("AX[X]=3 X2\n")).Text().find("16420"), std::string::npos);
  EXPECT_FALSE(SinumerikTest().Run(Head("AX[A]=3\n")).findings.empty());
}

TEST(SinumerikFrames, SystemVariablesAreInInchesUnderG700) {
  // Manual, "G70, G71, G700, G710".
  const TestRun run = SinumerikTest().Run(Head(
      "G700\n$P_UIFR[1,X,TR]=1\n$TC_DP3[1,1]=1\nR1=$P_UIFR[1,X,TR]\nG710 G54 D1 G0 X=R1 Z0\n"));
  EXPECT_EQ(EndOf(run, 7), "X26.4 Y20 Z-224.6 B0 C0") << run.Text();
}

TEST(SinumerikTools, TheEdgeInTheBlockOfM6IsOneOfTheNewTool) {
  // Manual, "Tool change with M6": T2 has D1 (150 mm) and here D2 (140 mm), T1 has D1 only.
  SinumerikTest control;
  const TestRun run =
      control.Run("$TC_DP3[2,2]=140 $TC_DP6[2,2]=3\nT2 D2 M6\nG54 G0 Z0\nT1 M6 D0\nZ0\n");
  EXPECT_FALSE(run.Has(Rule::kControlAlarm)) << run.Text();
  EXPECT_EQ(EndOf(run, 3), "X0 Y0 Z-110 B0 C0");
  EXPECT_EQ(EndOf(run, 5), "X0 Y0 Z-250 B0 C0");
}

TEST(SinumerikTools, AToolThatNobodyStatesHasAnyEdge) {
  SinumerikTest control;
  const std::string text = "G54 G0 Z50 D3\n";
  EXPECT_NE(control.Run(text).Text().find("17180"), std::string::npos);
  control.tools.tools[0].assumed = "length 100 mm";
  const TestRun run = control.Run(text);
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_EQ(EndOf(run, 1), "X0 Y0 Z-100 B0 C0");
}

TEST(SinumerikTools, LengthGoesByThePlane) {
  // SD42940: 0, length 1 counts along the normal of the plane; 17, always along Z.
  SinumerikTest control;
  const std::string text = Head("G18 Z50\nY0\n");
  TestRun run = control.Run(text);
  EXPECT_EQ(EndOf(run, 3), "X10 Y20 Z-200 B0 C0") << run.Text();
  EXPECT_EQ(EndOf(run, 4), "X10 Y120 Z-200 B0 C0");
  ASSERT_TRUE(run.Has(Rule::kToolLength));
  EXPECT_NE(run.Find(Rule::kToolLength)->message.find("SD42940 = 17"), std::string::npos);
  EXPECT_EQ(run.Find(Rule::kToolLength)->where.line, 3);
  control.job.control["SD42940"] = "17";
  run = control.Run(text);
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  EXPECT_EQ(EndOf(run, 4), "X10 Y20 Z-100 B0 C0");
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
