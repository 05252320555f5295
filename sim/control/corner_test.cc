// SPDX-License-Identifier: BSD-3-Clause
// Haas NGC Mill Operator's Manual 2017, G01 "Corner Rounding and Chamfering".
#include "sim/control/corner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/units.h"
#include "sim/control/command_test_util.h"

namespace ncsim::control {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CornerTest : public ::testing::Test {
 protected:
  void Push(Command command, double r = 0.0, double c = 0.0) {
    command.corner_radius = r;
    command.corner_chamfer = c;
    stage_.Push(command);
  }

  std::vector<Command> out_;
  std::vector<Finding> findings_;
  CornerStage stage_{[this](const Command& c) { out_.push_back(c); },
                     [this](Finding f) { findings_.push_back(std::move(f)); }};
};

TEST_F(CornerTest, ManualExample) {
  // The manual's program, from X0 Y0: Y-5. ,C1. / X-5. ,R1. / Y0.
  Push(FeedTo(0, -5), 0, 1);
  Push(FeedTo(-5, -5), 1);
  Push(FeedTo(-5, 0));
  EXPECT_THAT(ToText(out_),
              ElementsAre("feed X0 Y-4 Z0 F10", "feed X-1 Y-5 Z0 F10", "feed X-4 Y-5 Z0 F10",
                          "cw X-5 Y-4 Z0 about X-4 Y-4 Z0", "feed X-5 Y0 Z0 F10"));
  EXPECT_THAT(findings_, IsEmpty());
}

TEST_F(CornerTest, RoundingIsTangentAtAnyAngle) {
  for (double degrees = 5; degrees < 175; degrees += 10) {
    for (const double side : {1.0, -1.0}) {
      out_.clear();
      stage_.SetPosition(At(-50, 0, 0));
      Push(FeedTo(0, 0), 2);
      const double a = side * Radians(degrees);
      Push(FeedTo(100 * std::cos(a), 100 * std::sin(a)));
      ASSERT_EQ(out_.size(), 3U);
      const Command& arc = out_[1];
      const Eigen::Vector2d centre(arc.centre.x(), arc.centre.y());
      const Eigen::Vector2d from(out_[0].end[kX], out_[0].end[kY]);
      const Eigen::Vector2d to(arc.end[kX], arc.end[kY]);
      EXPECT_NEAR((from - centre).norm(), 2.0, 1e-9);
      EXPECT_NEAR((to - centre).norm(), 2.0, 1e-9);
      EXPECT_NEAR((from - centre).dot(Eigen::Vector2d(1, 0)), 0.0, 1e-9);
      EXPECT_NEAR((to - centre).dot(Eigen::Vector2d(std::cos(a), std::sin(a))), 0.0, 1e-9);
      EXPECT_NEAR(ArcOf(out_[0].end, arc).sweep, a, 1e-9);
    }
  }
}

TEST_F(CornerTest, OtherPlanesAndDwell) {
  Command first = FeedTo(0, 0, 10), second = FeedTo(10, 0, 10), dwell;
  first.plane = second.plane = Plane::kZX;
  dwell.kind = CommandKind::kDwell;
  dwell.dwell = 0.5;
  Push(first, 2);
  Push(dwell);
  EXPECT_THAT(out_, IsEmpty());
  Push(second);
  EXPECT_THAT(ToText(out_), ElementsAre("feed X0 Y0 Z8 F10", "dwell 0.5",
                                        "ccw X2 Y0 Z10 about X2 Y0 Z8", "feed X10 Y0 Z10 F10"));
}

TEST_F(CornerTest, InverseTimeKeepsTheSpeed) {
  Command first = FeedTo(10, 0), second = FeedTo(10, 10);
  first.feed_mode = second.feed_mode = Command::FeedMode::kInverseTime;
  first.feed = 2.0;   // 20 mm/s.
  second.feed = 1.0;  // 10 mm/s.
  Push(first, 0, 2);
  Push(second);
  ASSERT_EQ(out_.size(), 3U);
  EXPECT_NEAR(out_[0].feed * 8.0, 20.0, 1e-9);
  EXPECT_NEAR(out_[1].feed * std::sqrt(8.0), 20.0, 1e-9);
  EXPECT_NEAR(out_[2].feed * 8.0, 10.0, 1e-9);
}

TEST_F(CornerTest, ACornerThatJustFits) {
  Push(FeedTo(10, 0), 10);
  Push(FeedTo(10, 10));
  EXPECT_THAT(findings_, IsEmpty());
  EXPECT_THAT(ToText(out_), ElementsAre("feed X0 Y0 Z0 F10", "ccw X10 Y10 Z0 about X0 Y10 Z0",
                                        "feed X10 Y10 Z0 F10"));
}

TEST_F(CornerTest, ACornerThatDoesNotFitIsAnAlarmAndStaysSharp) {
  Push(FeedTo(10, 0), 10.001);
  Push(FeedTo(10, 10));
  ASSERT_EQ(findings_.size(), 1U);
  EXPECT_EQ(findings_[0].rule, Rule::kControlAlarm);
  EXPECT_EQ(findings_[0].message,
            "corner rounding ,R10.001 mm needs 10.001 mm of moves that are 10 and 10 mm long");
  EXPECT_THAT(ToText(out_), ElementsAre("feed X10 Y0 Z0 F10", "feed X10 Y10 Z0 F10"));
}

TEST_F(CornerTest, AnythingButALinearMoveAfterItIsAnAlarm) {
  Push(FeedTo(10, 0), 1);
  Push(RapidTo(10, 10));
  Push(FeedTo(0, 10), 0, 1);
  stage_.Flush();
  Push(RapidTo(0, 0), 1);
  Push(FeedTo(0, -10), 1);
  Push(FeedTo(0, 0));
  ASSERT_EQ(findings_.size(), 4U);
  EXPECT_THAT(findings_[0].message, HasSubstr("not followed by a linear move"));
  EXPECT_THAT(findings_[1].message, HasSubstr("not followed by a linear move"));
  EXPECT_THAT(findings_[2].message, HasSubstr("not in a linear move"));
  EXPECT_THAT(findings_[3].message, HasSubstr("reversal"));
  EXPECT_EQ(out_.size(), 6U);
}

TEST_F(CornerTest, MovesOutOfThePlaneAreNotSimulated) {
  Push(FeedTo(10, 0, -1), 1);
  Push(FeedTo(10, 10, -1));
  ASSERT_EQ(findings_.size(), 1U);
  EXPECT_EQ(findings_[0].rule, Rule::kUnsupportedCode);
  findings_.clear();
  Push(FeedTo(10, 20, -2), 1);  // Straight on in the plane: nothing to round.
  Push(FeedTo(10, 30, -2));
  EXPECT_THAT(findings_, IsEmpty());
}

}  // namespace
}  // namespace ncsim::control
