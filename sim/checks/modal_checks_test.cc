// SPDX-License-Identifier: BSD-3-Clause
// singularity, axis-speed, clamp, spindle-stopped, rotary-under-tcp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/checks/test_machine.h"

namespace ncsim::checks {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class ModalChecksTest : public ::testing::Test {
 protected:
  motion::Motion Tcp(double length, double b0, double c0, double b1, double c1) const {
    return TcpFeed(machine_, 1, {20.0, 0.0, 50.0}, {20.0 + length, 0.0, 50.0}, b0, c0, b1, c1);
  }
  machine::Machine machine_ = TestMachine();
  motion::JointVector here_ = Axes(-381.0, -254.0, -200.0, 0.0, 0.0);
  motion::JointVector there_ = Axes(-300.0, -254.0, -200.0, 0.0, 0.0);
};

TEST_F(ModalChecksTest, SingularityNeedsBothTheConeAndTheSwing) {
  const auto check = [&](const motion::Motion& motion) {
    return RunCheck(Singularity(machine_), {motion});
  };
  const auto findings = check(Tcp(5.0, 0.5, 0.0, 0.5, 100.0));
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
  EXPECT_EQ(findings[0].message,
            "axis C turns 100.000 deg in a feed under TCP with the tool 0.500 deg from that axis");
  EXPECT_THAT(check(Tcp(5.0, 1.01, 0.0, 1.01, 100.0)), IsEmpty());
  EXPECT_THAT(check(Tcp(5.0, 0.5, 0.0, 0.5, 90.0)), IsEmpty());
}

TEST_F(ModalChecksTest, SingularityIsFoundInTheMiddleOfABlock) {
  // B passes 0 on the way, and both ends are far from the pole.
  EXPECT_THAT(RunCheck(Singularity(machine_), {Tcp(5.0, -20.0, 0.0, 20.0, 120.0)}), SizeIs(1));
  EXPECT_THAT(RunCheck(Singularity(machine_), {Tcp(5.0, 2.0, 0.0, 20.0, 120.0)}), IsEmpty());
}

TEST_F(ModalChecksTest, SingularityIsFoundWhereAGreatCircleDips) {
  // B is 20 at both ends; in the middle atan2(sin 20 cos(C / 2), cos 20): 0.87 and 1.09 deg.
  const Eigen::Vector3d a(0.0, 0.0, 0.0), b(5.0, 0.0, 0.0);
  const auto feed = [&](double c_deg) {
    return VectorFeed(machine_, 5, a, b, 20.0, 0.0, 20.0, c_deg);
  };
  EXPECT_THAT(RunCheck(Singularity(machine_), {feed(175.2)}), SizeIs(1));
  EXPECT_THAT(RunCheck(Singularity(machine_), {feed(174.0)}), IsEmpty());
}

TEST_F(ModalChecksTest, SingularityOnlyInFeedsUnderTcp) {
  motion::Motion motion = Tcp(5.0, 0.0, 0.0, 0.0, 100.0);
  motion.facts.tcp = false;
  EXPECT_THAT(RunCheck(Singularity(machine_), {motion}), IsEmpty());
  motion.facts.tcp = true;
  motion.kind = motion::MotionKind::kRapid;
  EXPECT_THAT(RunCheck(Singularity(machine_), {motion}), IsEmpty());
}

TEST_F(ModalChecksTest, AxisSpeedComparesTheFeedsTimeWithTheAxes) {
  // 10 mm at 10 mm/s take 1 s; C turns at 50 deg/s at most.
  EXPECT_THAT(RunCheck(AxisSpeed(machine_), {Tcp(10.0, 0.0, 0.0, 0.0, 50.0)}), IsEmpty());
  motion::Motion motion = Tcp(10.0, 0.0, 0.0, 0.0, 51.0);
  motion.duration = 51.0 / 50.0;
  const auto findings = RunCheck(AxisSpeed(machine_), {motion});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(
      findings[0].message,
      "axis C would have to run at 51.0 deg/s to hold a tip feed of 600.0 mm/min, its rate is "
      "50.0 deg/s: the block takes 1.020 s instead of 1.000 s");
}

TEST_F(ModalChecksTest, AxisSpeedSeesLinearAxesThatSwing) {
  // The tip rests nearly, 380 mm beside the C axis at B0: Y has to follow at 380 mm * 40 deg/s =
  // 265 mm/s, and a machine whose Y makes 200 mm/s cannot.
  const motion::Motion motion =
      TcpFeed(machine_, 1, {380.0, 0.0, 0.0}, {370.0, 0.0, 0.0}, 0.0, -20.0, 0.0, 20.0);
  EXPECT_THAT(RunCheck(AxisSpeed(machine_), {motion}), IsEmpty());
  machine_.axes[1].rapid = 200.0;
  const auto findings = RunCheck(AxisSpeed(machine_), {motion});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message, HasSubstr("axis Y would have to run at"));
}

TEST_F(ModalChecksTest, AxisSpeedOfATipThatRests) {
  const auto findings = RunCheck(AxisSpeed(machine_), {Tcp(0.0, 0.0, 0.0, 0.0, 30.0)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message, HasSubstr("axis C moves while the tip rests"));
}

TEST_F(ModalChecksTest, AxisSpeedOfARunNamesItsWorst) {
  motion::Motion second = Tcp(10.0, 0.0, 60.0, 0.0, 160.0);
  second.where.line = 2;
  const auto findings = RunCheck(AxisSpeed(machine_),
                                 {Tcp(10.0, 0.0, 0.0, 0.0, 60.0), second, Feed(3, here_, there_)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].where.line, 1);
  EXPECT_THAT(findings[0].message,
              AllOf(HasSubstr("100.0 deg/s"), HasSubstr("(2 blocks, the last is line 2)")));
}

TEST_F(ModalChecksTest, ClampIsOneFindingARun) {
  motion::Motion braked = Feed(1, here_, Axes(-381.0, -254.0, -200.0, 10.0, 0.0));
  braked.facts.brake_conflict = true;
  motion::Motion next = braked;
  next.where.line = 2;
  motion::Motion rapid = braked;
  rapid.kind = motion::MotionKind::kRapid;
  const auto findings =
      RunCheck(Clamp(machine_), {braked, rapid, next, Feed(3, here_, there_), braked});
  ASSERT_THAT(findings, SizeIs(2));
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
  EXPECT_THAT(findings[0].message, HasSubstr("(2 blocks, the last is line 2)"));
  EXPECT_THAT(RunCheck(Clamp(machine_), {rapid, Feed(3, here_, there_)}), IsEmpty());
}

TEST_F(ModalChecksTest, SpindleStoppedInFeedsOnly) {
  motion::Motion still = Feed(1, here_, there_);
  still.facts.spindle_on = false;
  motion::Motion again = still;
  again.where.line = 3;
  motion::Motion rapid = still;
  rapid.kind = motion::MotionKind::kRapid;
  const auto findings =
      RunCheck(SpindleStopped(machine_), {still, rapid, again, Feed(4, here_, there_)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].message, "feed with the spindle stopped (2 blocks, the last is line 3)");
  EXPECT_THAT(RunCheck(SpindleStopped(machine_), {rapid, Feed(1, here_, there_)}), IsEmpty());
}

TEST_F(ModalChecksTest, RotaryUnderTcpIsOneFindingAProgram) {
  motion::JointVector duration(5);
  duration << 0.0, 0.0, 0.0, 0.0, 2.0;
  motion::Motion turn = Rapid(5, here_, Axes(-381.0, -254.0, -200.0, 0.0, 90.0), duration);
  motion::Motion plain = turn;
  turn.facts.tcp = true;
  motion::Motion later = turn;
  later.where.line = 50;
  motion::Motion linear = Rapid(6, here_, there_, duration);
  linear.facts.tcp = true;
  const auto findings =
      RunCheck(RotaryUnderTcp(machine_), {linear, turn, Feed(6, here_, there_), later});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].where.line, 5);
  EXPECT_THAT(findings[0].message, AllOf(HasSubstr("turns axis C by 90.000 deg"),
                                         HasSubstr("(2 blocks, the last is line 50)")));
  EXPECT_THAT(RunCheck(RotaryUnderTcp(machine_), {plain, linear}), IsEmpty());
}

TEST_F(ModalChecksTest, ReadoutIsInMillimetresAndDegrees) {
  const auto readout = machine_.Readout(Axes(-1.0, -2.0, -3.0, 4.0, 5.0));
  ASSERT_THAT(readout, SizeIs(5));
  EXPECT_EQ(readout[0].first, 'X');
  EXPECT_DOUBLE_EQ(readout[0].second, -1.0);
  EXPECT_EQ(readout[3].first, 'B');
  EXPECT_NEAR(readout[3].second, 4.0, 1e-12);
}

}  // namespace
}  // namespace ncsim::checks
