// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/base/units.h"
#include "sim/checks/excursion.h"
#include "sim/checks/test_machine.h"

namespace ncsim::checks {
namespace {

using ::testing::EndsWith;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

class TravelLimitTest : public ::testing::Test {
 protected:
  std::vector<Finding> Check(const std::vector<motion::Motion>& motions) const {
    return RunCheck(TravelLimit(machine_), motions);
  }
  static double AxisOf(const Finding& finding, char letter) {
    for (const auto& [name, value] : finding.axes) {
      if (name == letter) return value;
    }
    return std::nan("");
  }
  machine::Machine machine_ = TestMachine();
  motion::JointVector middle_ = Axes(-381.0, -254.0, -200.0, 0.0, 0.0);
};

TEST_F(TravelLimitTest, PositionOnTheLimitIsFine) {
  EXPECT_THAT(Check({Feed(1, middle_, Axes(0.0, 0.0, 63.5, 120.0, 37.0 * 360.0)),
                     Feed(2, middle_, Axes(-762.0, -508.0, -444.5, -35.0, -37.0 * 360.0))}),
              IsEmpty());
}

TEST_F(TravelLimitTest, BeyondToleranceIsAnErrorWithinItIsNot) {
  EXPECT_THAT(Check({Feed(1, middle_, Axes(0.9e-6, -254.0, -200.0, 0.0, 0.0))}), IsEmpty());
  const auto findings = Check({Feed(1, middle_, Axes(2e-6, -254.0, -200.0, 0.0, 0.0))});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].rule, Rule::kTravelLimit);
  EXPECT_EQ(
      findings[0].message,
      "axis X reaches 0.000002 mm, limit 0 mm; it leaves at X0.000 Y-254.000 Z-200.000 B0.000 "
      "C0.000");
}

TEST_F(TravelLimitTest, FirstPointWorstAndTimeOfALine) {
  // X from -30 to +10 in 1 s crosses 0 at s = 0.75.
  motion::Motion motion =
      Feed(7, Axes(-30.0, 0.0, 0.0, 0.0, 0.0), Axes(10.0, -100.0, 0.0, 0.0, 0.0));
  motion.start_time = 100.0;
  const auto findings = Check({motion});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message,
              StartsWith("axis X reaches 10.000 mm, limit 0 mm; it leaves at X"));
  EXPECT_EQ(findings[0].where.line, 7);
  EXPECT_NEAR(AxisOf(findings[0], 'X'), 0.0, 1e-5);
  EXPECT_NEAR(AxisOf(findings[0], 'Y'), -75.0, 1e-5);
  EXPECT_NEAR(*findings[0].time_s, 100.75, 1e-6);
}

TEST_F(TravelLimitTest, DogLegIsJudgedWhereItsOwnAxisCrosses) {
  // Y alone takes 1 s, X 4 s: Y = -10 + 20 t crosses 0 at t = 0.5 s, when X has gone an eighth of
  // its way.
  motion::JointVector duration(5);
  duration << 4.0, 1.0, 0.0, 0.0, 0.0;
  const auto findings = Check(
      {Rapid(3, Axes(-500.0, -10.0, 0.0, 0.0, 0.0), Axes(-100.0, 10.0, 0.0, 0.0, 0.0), duration)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message,
              StartsWith("axis Y reaches 10.000 mm, limit 0 mm; it leaves at X"));
  EXPECT_NEAR(AxisOf(findings[0], 'X'), -450.0, 1e-3);
  EXPECT_NEAR(*findings[0].time_s, 0.5, 1e-6);
}

TEST_F(TravelLimitTest, ARunOfBlocksIsOneFindingWithItsWorst) {
  const auto at = [&](double b) { return Axes(-381.0, -254.0, -200.0, b, 0.0); };
  const auto findings = Check({Feed(1, at(0.0), at(121.0)), Feed(2, at(121.0), at(125.5)),
                               Feed(3, at(125.5), at(110.0)), Feed(4, at(110.0), at(100.0)),
                               Feed(5, at(100.0), at(-36.0)), Feed(6, at(-36.0), at(0.0))});
  ASSERT_THAT(findings, SizeIs(2));
  EXPECT_EQ(findings[0].message,
            "axis B reaches 125.500 deg, limit 120 deg; it leaves at X-381.000 Y-254.000 Z-200.000 "
            "B120.000 C0.000 (3 blocks, the last is line 3)");
  EXPECT_EQ(findings[0].where.line, 1);
  EXPECT_THAT(findings[1].message, StartsWith("axis B reaches -36.000 deg, limit -35 deg; "));
  EXPECT_THAT(findings[1].message, EndsWith(" (2 blocks, the last is line 6)"));
}

TEST_F(TravelLimitTest, AnEndlessAxisHasNoLimit) {
  machine_.axes.back().lower = -std::numeric_limits<double>::infinity();
  machine_.axes.back().upper = std::numeric_limits<double>::infinity();
  EXPECT_THAT(Check({Feed(1, middle_, Axes(-381.0, -254.0, -200.0, 0.0, 1e7))}), IsEmpty());
}

// The tip rests `x` mm beside the B axis at its height while B swings from -20 to 20: machine X is
// -381 + x cos(B), greatest at B0 in the middle of the block.
TEST_F(TravelLimitTest, TcpBulgeBetweenEndsThatAreInside) {
  const Eigen::Vector3d p_B(386.0, 0.0, 0.0);
  motion::Motion motion = TcpFeed(machine_, 6, p_B, p_B, -20.0, 0.0, 20.0, 0.0);
  ASSERT_LT(motion.q0()[0], -10.0);
  ASSERT_LT(motion.q1()[0], -10.0);
  const auto findings = Check({motion});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message,
              StartsWith("axis X reaches 5.000 mm, limit 0 mm; it leaves at X"));
  // Leaves where cos(B) = 381 / 386.
  EXPECT_NEAR(AxisOf(findings[0], 'B'), -Degrees(std::acos(381.0 / 386.0)), 1e-5);
  EXPECT_NEAR(AxisOf(findings[0], 'X'), 0.0, 1e-5);
}

// From B115 C0 to B115 C100 the tool axis goes along a great circle by B = atan2(sin 115 cos 50,
// cos 115) = 125.959; B ends at 120.
TEST_F(TravelLimitTest, GreatCircleLeadsARotaryAxisBeyondItsLimit) {
  const Eigen::Vector3d p_B(0.0, 0.0, 0.0);
  const auto findings = Check({VectorFeed(machine_, 6, p_B, p_B, 115.0, 0.0, 115.0, 100.0)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message, StartsWith("axis B reaches 125.959 deg, limit 120 deg"));
  EXPECT_NEAR(AxisOf(findings[0], 'B'), 120.0, 1e-5);
  EXPECT_THAT(Check({VectorFeed(machine_, 6, p_B, p_B, 115.0, 0.0, 115.0, 40.0)}), IsEmpty());
}

// A SINUMERIK stops before a block that ends behind the limit (10720), and in one that only leads
// there (10620).
TEST_F(TravelLimitTest, TheControlsAlarmIsNamed) {
  machine_.control.dialect = "sinumerik-840d";
  auto findings = Check({Feed(1, middle_, Axes(-381.0, -254.0, -200.0, 125.0, 0.0))});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message,
              StartsWith("axis B reaches 125.000 deg, limit 120 deg (alarm 10720); it leaves at "));
  const Eigen::Vector3d p_B(386.0, 0.0, 0.0);
  findings = Check({TcpFeed(machine_, 6, p_B, p_B, -20.0, 0.0, 20.0, 0.0)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message,
              StartsWith("axis X reaches 5.000 mm, limit 0 mm (alarm 10620); it leaves at "));
}

TEST_F(TravelLimitTest, TcpBulgeThatJustTouchesTheLimitIsFine) {
  const Eigen::Vector3d p_B(381.0, 0.0, 0.0);
  EXPECT_THAT(Check({TcpFeed(machine_, 6, p_B, p_B, -20.0, 0.0, 20.0, 0.0)}), IsEmpty());
  const Eigen::Vector3d further(381.0 + 5e-6, 0.0, 0.0);
  EXPECT_THAT(Check({TcpFeed(machine_, 6, further, further, -20.0, 0.0, 20.0, 0.0)}), SizeIs(1));
}

TEST_F(TravelLimitTest, StraightTcpFeedAlongTheLimitIsFine) {
  // Without turning the linear axes run straight: X stays at 0 for 200 mm.
  EXPECT_THAT(
      Check({TcpFeed(machine_, 1, {381.0, -100.0, 0.0}, {381.0, 100.0, 0.0}, 0.0, 0.0, 0.0, 0.0)}),
      IsEmpty());
}

motion::Motion FullCircle(double centre_x, double radius) {
  motion::AxisArc arc;
  arc.q0 = arc.q1 = Axes(centre_x - radius, -254.0, -200.0, 0.0, 0.0);
  arc.centre = Eigen::Vector3d(centre_x, -254.0, -200.0);
  arc.e1 = Eigen::Vector3d::UnitX();
  arc.e2 = Eigen::Vector3d::UnitY();
  arc.pitch = arc.end_error = Eigen::Vector3d::Zero();
  arc.radius = radius;
  arc.phi0 = kPi;
  arc.sweep = 2.0 * kPi;
  arc.linear = {0, 1, 2};
  motion::Motion motion = Feed(9, arc.q0, arc.q1);
  motion.kind = motion::MotionKind::kArc;
  motion.path = arc;
  return motion;
}

TEST_F(TravelLimitTest, FullCircleBeyondTheLimitOnItsFarSide) {
  EXPECT_THAT(Check({FullCircle(-50.0, 50.0)}), IsEmpty());
  const auto findings = Check({FullCircle(-50.0, 60.0)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message,
              StartsWith("axis X reaches 10.000 mm, limit 0 mm; it leaves at X"));
  // From phi = pi anticlockwise: X = -50 + 60 cos(phi) reaches 0 at phi = 2 pi - acos(5/6), where Y
  // is below the centre.
  EXPECT_NEAR(AxisOf(findings[0], 'Y'), -254.0 - 60.0 * std::sin(std::acos(5.0 / 6.0)), 1e-4);
}

TEST_F(TravelLimitTest, AnAxisThatIsNotANumberIsNotInside) {
  const auto findings = Check({Feed(1, middle_, Axes(std::nan(""), -254.0, -200.0, 0.0, 0.0))});
  EXPECT_FALSE(findings.empty());
}

}  // namespace
}  // namespace ncsim::checks
