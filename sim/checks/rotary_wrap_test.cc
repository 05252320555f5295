// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/checks/test_machine.h"

namespace ncsim::checks {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class RotaryWrapTest : public ::testing::Test {
 protected:
  std::vector<Finding> Check(const std::vector<motion::Motion>& motions) const {
    return RunCheck(RotaryWrap(machine_), motions);
  }
  motion::Motion Tcp(double b0, double c0, double b1, double c1) const {
    return TcpFeed(machine_, 1, {20.0, 0.0, 50.0}, {21.0, 0.0, 50.0}, b0, c0, b1, c1);
  }
  static motion::Motion Plain(double x, double c0, double c1) {
    return Feed(1, Axes(-381.0, -254.0, -200.0, 90.0, c0),
                Axes(-381.0 + x, -254.0, -200.0, 90.0, c1));
  }
  machine::Machine machine_ = TestMachine();
};

// Haas NGC Mill Operator's Manual 2017, G90: C350 -> C10 is a plain difference, 340 degrees back.
TEST_F(RotaryWrapTest, From350To10UnderTcpIsAnError) {
  const auto findings = Check({Tcp(30.0, 350.0, 30.0, 10.0)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].severity, Severity::kError);
  EXPECT_EQ(findings[0].message,
            "axis C turns 340.000 deg in a feed, from 350.000 to 10.000; the same tool axis at "
            "B30.000 C370.000 is only 20.000 deg away");
}

TEST_F(RotaryWrapTest, From350To370IsNot) {
  EXPECT_THAT(Check({Tcp(30.0, 350.0, 30.0, 370.0)}), IsEmpty());
}

TEST_F(RotaryWrapTest, HalfATurnIsNot) {
  EXPECT_THAT(Check({Tcp(90.0, 0.0, 90.0, 180.0)}), IsEmpty());
  EXPECT_THAT(Check({Tcp(90.0, 0.0, 90.0, 180.0004)}), IsEmpty());
  EXPECT_THAT(Check({Tcp(90.0, 0.0, 90.0, 180.01)}), SizeIs(1));
}

TEST_F(RotaryWrapTest, NearerEndBeyondTheLimitsDoesNotCount) {
  // At B90 the other branch needs B-90. C is at its upper limit, 13320: 13310 -> 12990 could only
  // go on to 13350.
  EXPECT_THAT(Check({Tcp(90.0, 13310.0, 90.0, 12990.0)}), IsEmpty());
  EXPECT_THAT(Check({Tcp(90.0, 13270.0, 90.0, 12950.0)}), SizeIs(1));
}

TEST_F(RotaryWrapTest, TheOtherBranchCounts) {
  // B10 C0 -> B10 C200: within the limits also B10 C-160, and B-10 C20. The shorter one is named.
  const auto findings = Check({Tcp(10.0, 0.0, 10.0, 200.0)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message, HasSubstr("at B-10.000 C20.000 is only 20.000 deg away"));
}

TEST_F(RotaryWrapTest, AtThePoleCMayStay) {
  const auto findings = Check({Tcp(5.0, 0.0, 0.0, 200.0)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].message, HasSubstr("C0.000 is only 5.000 deg away"));
}

TEST_F(RotaryWrapTest, WithoutTcpItIsAWarning) {
  const auto findings = Check({Plain(10.0, 350.0, 10.0)});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
}

TEST_F(RotaryWrapTest, WithoutTcpIndexingAndWholeRevolutionsAreFine) {
  EXPECT_THAT(Check({Plain(0.0, 350.0, 10.0)}), IsEmpty());
  EXPECT_THAT(Check({Plain(10.0, 0.0, 720.0)}), IsEmpty());
  EXPECT_THAT(Check({Plain(10.0, 0.0, 721.0)}), SizeIs(1));
}

TEST_F(RotaryWrapTest, RapidsAreNeverReported) {
  motion::Motion motion = Tcp(30.0, 350.0, 30.0, 10.0);
  motion.kind = motion::MotionKind::kRapid;
  EXPECT_THAT(Check({motion}), IsEmpty());
}

TEST_F(RotaryWrapTest, WarningAndErrorDoNotShareAFinding) {
  EXPECT_THAT(Check({Plain(10.0, 350.0, 10.0), Tcp(30.0, 350.0, 30.0, 10.0)}), SizeIs(2));
}

}  // namespace
}  // namespace ncsim::checks
