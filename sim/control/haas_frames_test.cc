// SPDX-License-Identifier: BSD-3-Clause
// Frames of the Haas control. Places: Haas NGC Mill Operator's Manual 2017 ("manual").
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/control/frames.h"
#include "sim/control/test_machine.h"

namespace ncsim::control {
namespace {

using motion::DogLeg;
using motion::TcpCurve;

// Tip in the part frame of a motion's end, by the metal.
Eigen::Vector3d TipInPart(const TestControl& control, const TestRun& run,
                          const motion::Motion& motion, double s = 1.0) {
  Eigen::Vector3d p_BT_B, u_B;
  const double length = control.tools.Find(motion.facts.tool)->length;
  control.machine.five_axis->TipInTable(motion.At(s), length, &p_BT_B, &u_B);
  return run.part_frames.at(static_cast<std::size_t>(motion.facts.offset)).X_BP.inverse() * p_BT_B;
}

Eigen::Vector3d ToolAxis(const TestControl& control, const motion::Motion& motion) {
  Eigen::Vector3d p_BT_B, u_B;
  control.machine.five_axis->TipInTable(motion.q1(), 0.0, &p_BT_B, &u_B);
  return u_B;
}

void ExpectNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double tolerance) {
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), tolerance)
      << a.transpose() << " against " << b.transpose();
}

TEST(HaasFrames, TcpcSampleApproachesAlongTheToolAxis) {
  // Manual, G234, program O00003: at B47.137 C116.354 the tool goes from X-.9762 Y1.9704 Z1.0907 to
  // X-.5688 Y1.1481 Z.2391; that way is the tool axis.
  TestControl control;
  control.job.control["setting 9"] = "inch";
  control.SetOffset("G54", {{'X', -381.0}, {'Y', -254.0}, {'Z', -480.0}});
  const TestRun run = control.Run(
      "G00 G17 G90 G40 G80\nG54\nG00 B47.137 C116.354\nG00 X-.9762 Y1.9704 S5000 M03\n"
      "G234 H01 Z1.0907\nG01 X-.5688 Y1.1481 Z.2391 F40.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_TRUE(run.findings.empty()) << run.Text();
  const motion::Motion& approach = run.motions[3];
  ASSERT_TRUE(std::holds_alternative<TcpCurve>(approach.path));
  const Eigen::Vector3d from = TipInPart(control, run, approach, 0.0);
  const Eigen::Vector3d to = TipInPart(control, run, approach, 1.0);
  // The block with G234 names Z alone; X and Y keep their numbers.
  ExpectNear(from, Eigen::Vector3d(-.9762, 1.9704, 1.0907) * 25.4, 1e-6);
  ExpectNear(to, Eigen::Vector3d(-.5688, 1.1481, .2391) * 25.4, 1e-6);
  const double cosine = (from - to).normalized().dot(ToolAxis(control, approach));
  EXPECT_LT(Degrees(std::acos(std::min(1.0, cosine))), 0.0035);
}

TEST(HaasFrames, DwoSampleDrillsTheRightSide) {
  // Manual, G254, program O00004: at B90. C0. the hole at X1. Y0. with face Z1. is the part's point
  // (1, 0, -1): on its +X face, 1 in below the top.
  TestControl control;
  control.job.control["setting 9"] = "inch";
  const TestRun run =
      control.Run("G00 G90 G17 G40 G80\nG54\nG53 Z0.\nG00 B90. C0.\nG254\nX1. Y0.\nG43 H01 Z1.\n");
  ASSERT_EQ(run.motions.size(), 3u) << run.Text();
  ExpectNear(TipInPart(control, run, run.motions[2]), Eigen::Vector3d(25.4, 0.0, -25.4), 1e-6);
  ExpectNear(ToolAxis(control, run.motions[2]), Eigen::Vector3d::UnitX(), 1e-12);
}

TEST(HaasFrames, DwoFollowsTheTableInEveryBlock) {
  // Manual, G254, O00004: `B90. C-90.` is commanded with G254 active, and honoured.
  TestControl control;
  const TestRun run = control.Run(
      "G54 G43 H1 G0 Z350.\nG254\nG53 Z0.\nB90. C-90.\nX10. Y20.\nZ60.\nG1 X11. F100.\n");
  const motion::Motion& last = run.motions.back();
  const Eigen::Vector3d q(11.0, 20.0, 60.0);
  const Eigen::Vector3d wanted = Eigen::AngleAxisd(Radians(-90.0), Eigen::Vector3d::UnitZ()) *
                                 (Eigen::AngleAxisd(Radians(90.0), Eigen::Vector3d::UnitY()) * q);
  ExpectNear(TipInPart(control, run, last), wanted, 1e-6);
  EXPECT_TRUE(run.findings.empty()) << run.Text();
}

TEST(HaasFrames, CommandingDwoMovesNothingAndZAloneKeepsTheOldXY) {
  // Manual, G254: "Invoking or canceling G254 does not cause motion".
  const TestRun run =
      TestControl().Run("G54 G43 H1 G0 X10. Y10. Z350.\nB30.\nG254\nZ340.\nG255\nZ345.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_EQ(run.motions[2].q1()[kJointX], -290.0);
  EXPECT_EQ(run.motions[2].q1()[kJointY], -190.0);
  EXPECT_NE(run.motions[2].q1()[kJointZ], -400.0 + 340.0 + 100.0);
  EXPECT_EQ(run.motions[3].q1()[kJointZ], -400.0 + 345.0 + 100.0);
}

TEST(HaasFrames, TcpTurnsAboutTheTip) {
  // Manual, G234: the tip follows the programmed line while B and C turn; here it rests.
  TestControl control;
  const TestRun run =
      control.Run("G54 G0 X10. Y20.\nG234 H1 Z150.\nG93 G1 B40. C70. F2.\nX15. B0. F2.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  for (const double s : {0.0, 0.3, 0.7, 1.0}) {
    ExpectNear(TipInPart(control, run, run.motions[2], s), {10.0, 20.0, 150.0}, 1e-6);
    ExpectNear(TipInPart(control, run, run.motions[3], s), {10.0 + 5.0 * s, 20.0, 150.0}, 1e-6);
  }
  EXPECT_TRUE(run.motions[2].facts.tcp);
  EXPECT_FALSE(run.motions[2].facts.names_linear);
}

TEST(HaasFrames, RapidsUnderTcpAreHeld) {
  // A rapid moves the axes that it names; with X, Y or Z all linear axes go to where the tip is on
  // the point at the end, by dog-leg.
  TestControl control;
  const TestRun run =
      control.Run("G54 G0 X10. Y20.\nG234 H1\nX10. Y20. Z150.\nB20.\nX12. B30. C15.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();  // G234 H1 alone moves nothing.
  const motion::Motion& turn = run.motions[2];
  EXPECT_EQ(turn.q0().head<3>(), turn.q1().head<3>());
  EXPECT_TRUE(turn.facts.tcp);
  const motion::Motion& move = run.motions[3];
  EXPECT_TRUE(std::holds_alternative<DogLeg>(move.path));
  ExpectNear(TipInPart(control, run, move), {12.0, 20.0, 150.0}, 1e-6);
  EXPECT_GT((TipInPart(control, run, move, 0.5) - Eigen::Vector3d(11.0, 20.0, 150.0)).norm(), 1.0);
}

TEST(HaasFrames, TrackedRapidsKeepTheTipOnItsLine) {
  TestControl control;
  control.job.control["tcp_rapid"] = "track";
  const TestRun run = control.Run("G54 G0 X10. Y20.\nG234 H1 X10. Y20. Z150.\nX12. B30. C15.\n");
  ASSERT_EQ(run.motions.size(), 3u) << run.Text();
  ExpectNear(TipInPart(control, run, run.motions[2], 0.5), {11.0, 20.0, 150.0}, 1e-6);
  EXPECT_EQ(run.motions[2].kind, motion::MotionKind::kRapid);
}

TEST(HaasFrames, ArcUnderTcpIsACircleInThePart) {
  TestControl control;
  const TestRun run = control.Run(
      "G54 G0 X10. Y0.\nB30. C40.\nG234 H1 Z150.\nG3 X0. Y10. I-10. J0. B20. C60. F300.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  for (const double s : {0.25, 0.5, 1.0}) {
    const double angle = s * kPi / 2.0;
    ExpectNear(TipInPart(control, run, run.motions[3], s),
               {10.0 * std::cos(angle), 10.0 * std::sin(angle), 150.0}, 1e-6);
  }
}

TEST(HaasFrames, TcpBlockTakesTheLongerOfTipAndAxisTime) {
  // B at 50 deg/s: 40 degrees take 0.8 s, whatever the tip's feed.
  TestControl control;
  const TestRun run =
      control.Run("G54 G0 X0. Y0.\nG234 H1 Z150.\nG1 X1. B40. F6000.\nX61. F600.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_GE(run.motions[2].duration, 0.8 - 1e-12);
  EXPECT_DOUBLE_EQ(run.motions[2].facts.feed, 100.0);
  EXPECT_NEAR(run.motions[3].duration, 6.0, 1e-9);
  EXPECT_FALSE(run.Has(Rule::kControlAlarm));
}

TEST(HaasFrames, AWrongRotaryCentreMovesTheMetal) {
  // Settings 255-257. With the centre stated 1 mm too far in X, at B90: M = P + R (w + q - P) + L
  // changes by d - R d, d = (1, 0, 0), R = Ry(-90): (1, 0, -1).
  const char* program = "G54 G0 X0. Y0.\nB90.\nG234 H1 Z150.\n";
  TestControl control;
  const motion::JointVector right = control.Run(program).End();
  control.job.control["setting 255"] = "-380";
  const TestRun run = control.Run(program);
  ExpectNear((run.End() - right).head<3>(), {1.0, 0.0, -1.0}, 1e-9);
  // At B0 C0 there is no difference.
  const char* upright = "G54 G0 X0. Y0.\nG234 H1 Z150.\n";
  TestControl exact;
  ExpectNear((control.Run(upright).End() - exact.Run(upright).End()).head<3>(), {0.0, 0.0, 0.0},
             1e-9);
}

TEST(HaasFrames, LengthAddsSubtractsAndCancels) {
  // Manual, G43, G44, G49, H00.
  const TestRun run = TestControl().Run(
      "G54 G0 Z300.\nG43 H1 Z210.\nG49 Z200.\nG44 H1 Z200.\nG43 H1 Z100.\nG43 H0 Z100.\n");
  ASSERT_EQ(run.motions.size(), 6u) << run.Text();
  EXPECT_EQ(run.motions[1].q1()[kJointZ], -90.0);
  EXPECT_EQ(run.motions[2].q1()[kJointZ], -200.0);
  EXPECT_EQ(run.motions[3].q1()[kJointZ], -300.0);
  EXPECT_EQ(run.motions[4].q1()[kJointZ], -200.0);
  EXPECT_EQ(run.motions[5].q1()[kJointZ], -300.0);
}

TEST(HaasFrames, OffsetsAndTheirShifts) {
  // Manual, G52 (added to every offset), G92 (position gets the value; ends G52), G154 P1 = G110.
  TestControl control;
  control.SetOffset("G110", {{'X', -100.0}, {'Y', 0.0}, {'Z', 0.0}});
  const TestRun run =
      control.Run("G54 G0 X10.\nG52 X5.\nX10.\nG154 P1 X0.\nG54 X10.\nG92 X0.\nX1.\nG110 X0.\n");
  ASSERT_EQ(run.motions.size(), 6u) << run.Text();
  EXPECT_EQ(run.motions[0].q1()[kJointX], -290.0);
  EXPECT_EQ(run.motions[1].q1()[kJointX], -285.0);
  EXPECT_EQ(run.motions[2].q1()[kJointX], -95.0);
  EXPECT_EQ(run.motions[4].q1()[kJointX], -284.0);  // -285 was named X0.
  EXPECT_EQ(run.motions[5].q1()[kJointX], -100.0 + 15.0);
  EXPECT_TRUE(run.findings.empty()) << run.Text();
}

TEST(HaasFrames, G10SetsOffsetsAndTools) {
  // Manual, G10: L2 work offsets, L20 G154, L10 length; G90 sets, G91 adds.
  const TestRun run = TestControl().Run(
      "G10 L2 P2 X-50. Y-60. Z-70.\nG55 G0 X0.\nG91 G10 L2 P2 X1.\nG90 X0.\n"
      "G10 L20 P7 X-5. Y0. Z0.\nG154 P7 X0.\nG10 L10 P1 R120.\nG43 H1 Z-200.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_EQ(run.motions[0].q1()[kJointX], -50.0);
  EXPECT_EQ(run.motions[1].q1()[kJointX], -49.0);
  EXPECT_EQ(run.motions[2].q1()[kJointX], -5.0);
  EXPECT_EQ(run.motions[3].q1()[kJointZ], -80.0);
  EXPECT_FALSE(run.Assumed("offset G55"));
  EXPECT_TRUE(run.Has(Rule::kToolLength));  // 120 in the register, 100 in the spindle.
  EXPECT_EQ(run.Find(Rule::kToolLength)->severity, Severity::kWarning);
}

TEST(HaasFrames, AnOffsetThatNobodyStatesIsAssumed) {
  const TestRun run = TestControl().Run("G54 G0 X1.\nG55 X1. Y1. Z600.\n");
  ASSERT_TRUE(run.Assumed("offset G55"));
  EXPECT_FALSE(run.Assumed("offset G54"));
  EXPECT_TRUE(run.summary.assumptions.back().places_metal);
  // The mount is 50.8 mm below the rotary centre.
  EXPECT_NEAR(run.End()[kJointX], -380.0, 1e-9);
  EXPECT_NEAR(run.End()[kJointZ], 600.0 - 495.7 - 50.8, 1e-9);
}

TEST(HaasFrames, G68TurnsThePlaneAboutItsCentre) {
  // Manual, G68: +R counter-clockwise; the block's own values are not rotated; G69 ends it.
  const TestRun run = TestControl().Run(
      "G54 G0 X0. Y0.\nG68 X10. Y0. R90.\nX20. Y0.\nG3 X10. Y10. I-10. J0. F600.\nG69\n"
      "G0 X5. Y0.\n");
  ASSERT_EQ(run.motions.size(), 4u) << run.Text();
  EXPECT_NEAR(run.motions[1].q1()[kJointX], -290.0, 1e-9);
  EXPECT_NEAR(run.motions[1].q1()[kJointY], -190.0, 1e-9);
  EXPECT_NEAR(run.motions[2].q1()[kJointX], -300.0, 1e-9);
  EXPECT_NEAR(run.motions[2].q1()[kJointY], -200.0, 1e-9);
  EXPECT_NEAR(run.motions[2].At(0.5)[kJointX], -290.0 - 10.0 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(run.motions[2].At(0.5)[kJointY], -200.0 + 10.0 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(run.motions[3].q1()[kJointX], -295.0, 1e-9);
}

TEST(HaasFrames, ProgramAndMachineCoordinatesAreInverse) {
  // Property: random machines of every layout, frames with DWO and TCP.
  kinematics::Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const kinematics::TestMachine test = kinematics::RandomMachine(&random);
    machine::Machine machine;
    machine.tree = test.tree;
    machine.spindle_link = test.spindle_link;
    machine.table_link = test.table_link;
    machine.five_axis = kinematics::FiveAxis::Make(test.tree, test.spindle_link, test.table_link);
    ASSERT_TRUE(machine.five_axis.has_value());
    const auto& joints = test.tree.joints();
    for (const auto& [letter, name] :
         {std::pair{'X', "X"}, {'Y', "Y"}, {'Z', "Z"}, {'B', "R1"}, {'C', "R2"}}) {
      machine::Axis axis;
      axis.letter = letter;
      axis.joint = joints[static_cast<std::size_t>(test.tree.FindJoint(name))].index;
      axis.rotary = letter < 'X';
      machine.axes.push_back(axis);
    }
    Frames frames(machine, MakeControlKinematics(machine, std::nullopt));
    Frame frame;
    for (const int axis : {kX, kY, kZ}) frame.offset[axis] = random.Uniform(-300.0, 300.0);
    frame.tool_length = random.Uniform(0.0, 200.0);
    for (const auto rotation :
         {Frame::Rotation::kNone, Frame::Rotation::kDwo, Frame::Rotation::kTcp}) {
      frame.rotation = rotation;
      const auto shared = std::make_shared<const Frame>(frame);
      AxisValues program{};
      for (const int axis : {kX, kY, kZ}) program[axis] = random.Uniform(-100.0, 100.0);
      for (const int axis : {kB, kC}) program[axis] = random.Uniform(-3.0, 3.0);
      const AxisValues back = frames.ToProgram(shared, frames.ToMachine(shared, program));
      for (std::size_t i = 0; i < kNumAxes; ++i) EXPECT_NEAR(back[i], program[i], 1e-9);
    }
  }
}

}  // namespace
}  // namespace ncsim::control
