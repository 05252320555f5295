// SPDX-License-Identifier: BSD-3-Clause
// Corners and alarms of G41/G42 against closed forms (Haas NGC Mill Operator's Manual 2017, 5.7).
#include "sim/control/cutter_comp.h"

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

class CutterCompTest : public ::testing::Test {
 protected:
  CutterCompTest() { Reset({}); }
  void Reset(const ContourOptions& options) {
    out_.clear();
    findings_.clear();
    contour_ = std::make_unique<Contour>(
        options, [this](const Command& c) { out_.push_back(c); },
        [this](Finding f) { findings_.push_back(std::move(f)); });
    line_ = 0;
  }
  // G41 with a radius of 2 unless `side` says otherwise.
  void On(Command command, Command::Comp side = Command::Comp::kLeft, double radius = 2.0) {
    command.comp = side;
    command.comp_radius = radius;
    Off(command);
  }
  void Off(Command command) {
    command.where.line = ++line_;
    contour_->Push(command);
  }
  // Onto the X axis at X0, then to X10 Y0: the corner under test is there. Both ends are forgotten.
  void ToCorner(double radius = 2.0) {
    contour_->SetPosition(At(-20, 0, 0));
    On(FeedTo(0, 0), Command::Comp::kLeft, radius);
    On(FeedTo(10, 0), Command::Comp::kLeft, radius);
  }
  std::vector<std::string> Rules() const {
    std::vector<std::string> text;
    for (const Finding& f : findings_) text.emplace_back(Info(f.rule).id);
    return text;
  }

  std::vector<Command> out_;
  std::vector<Finding> findings_;
  std::unique_ptr<Contour> contour_;
  int line_ = 0;
};

TEST_F(CutterCompTest, OffPassesOnAtOnce) {
  Off(RapidTo(1, 2, 3));
  EXPECT_THAT(ToText(out_), ElementsAre("rapid X1 Y2 Z3"));
}

TEST_F(CutterCompTest, ManualProgramO40006) {
  // G41 G01 onto X0 Y0, Y1.125, R.375 right turn, X1.6562, R.3437 ... with a .250 end mill: the
  // first four moves (inch).
  const double r = 0.125;
  contour_->SetPosition(At(-25.4, -25.4, 0));
  const auto in = [](Command c) {
    for (const std::size_t i : {0U, 1U}) {
      c.end[i] *= 25.4;
      c.centre[static_cast<int>(i)] *= 25.4;
    }
    return c;
  };
  On(in(FeedTo(0, 0)), Command::Comp::kLeft, r * 25.4);
  On(in(FeedTo(0, 1.125)), Command::Comp::kLeft, r * 25.4);
  On(in(ArcTo(0.375, 1.5, 0.375, 1.125, true)), Command::Comp::kLeft, r * 25.4);
  On(in(FeedTo(1.6562, 1.5)), Command::Comp::kLeft, r * 25.4);
  contour_->Flush();
  ASSERT_EQ(out_.size(), 4U);
  EXPECT_NEAR(out_[0].end[kX] / 25.4, -r, 1e-9);
  EXPECT_NEAR(out_[0].end[kY] / 25.4, 0, 1e-9);
  EXPECT_NEAR(out_[1].end[kX] / 25.4, -r, 1e-9);
  EXPECT_NEAR(out_[1].end[kY] / 25.4, 1.125, 1e-9);
  EXPECT_NEAR(out_[2].end[kX] / 25.4, 0.375, 1e-9);
  EXPECT_NEAR(out_[2].end[kY] / 25.4, 1.5 + r, 1e-9);
  EXPECT_NEAR(out_[3].end[kX] / 25.4, 1.6562, 1e-9);
  EXPECT_THAT(findings_, IsEmpty());
}

TEST_F(CutterCompTest, InsideCornerIsTheIntersection) {
  ToCorner();
  On(FeedTo(10, 10));
  Off(FeedTo(10, 30));
  EXPECT_THAT(ToText(out_), ElementsAre("feed X0 Y2 Z0 F10", "feed X8 Y2 Z0 F10",
                                        "feed X8 Y10 Z0 F10", "feed X10 Y30 Z0 F10"));
  EXPECT_THAT(findings_, IsEmpty());
}

TEST_F(CutterCompTest, OutsideCornerUpTo270DegreesIsSharpInFanuc) {
  ToCorner();
  On(FeedTo(10, -10));
  Off(FeedTo(10, -30));
  EXPECT_THAT(ToText(out_), ElementsAre("feed X0 Y2 Z0 F10", "feed X12 Y2 Z0 F10",
                                        "feed X12 Y-10 Z0 F10", "feed X10 Y-30 Z0 F10"));
}

TEST_F(CutterCompTest, OutsideCornerBeyond270DegreesHasAnExtraLineInFanuc) {
  ToCorner();
  On(FeedTo(0, -10));  // Turns right by 135 degrees.
  Off(FeedTo(-20, -30));
  const double h = std::sqrt(0.5);
  ASSERT_EQ(out_.size(), 5U);
  EXPECT_EQ(ToText(out_[1]), "feed X12 Y2 Z0 F10");  // Past the corner by the radius.
  // From beside the start of the next move, back by the radius.
  EXPECT_NEAR(out_[2].end[kX], 10 + 2 * h + 2 * h, 1e-9);
  EXPECT_NEAR(out_[2].end[kY], -2 * h + 2 * h, 1e-9);
  EXPECT_NEAR(out_[3].end[kX], 0 + 2 * h, 1e-9);
  EXPECT_NEAR(out_[3].end[kY], -10 - 2 * h, 1e-9);
}

TEST_F(CutterCompTest, OutsideCornerIsAnArcInYasnac) {
  ContourOptions options;
  options.fanuc_corners = false;
  Reset(options);
  ToCorner();
  On(FeedTo(10, -10));
  Off(FeedTo(10, -30));
  EXPECT_THAT(ToText(out_),
              ElementsAre("feed X0 Y2 Z0 F10", "feed X10 Y2 Z0 F10", "cw X12 Y0 Z0 about X10 Y0 Z0",
                          "feed X12 Y-10 Z0 F10", "feed X10 Y-30 Z0 F10"));
}

TEST_F(CutterCompTest, RightSideAndNegativeRegisterMirror) {
  // Manual: "a negative value entered for a G41 will behave as if a positive value was entered for
  // G42".
  std::vector<std::vector<std::string>> paths;
  for (const auto& [side, radius] :
       {std::pair{Command::Comp::kRight, 2.0}, std::pair{Command::Comp::kLeft, -2.0}}) {
    Reset({});
    contour_->SetPosition(At(-20, 0, 0));
    On(FeedTo(0, 0), side, radius);
    On(FeedTo(10, 0), side, radius);
    On(FeedTo(10, 10), side, radius);
    Off(FeedTo(10, 30));
    paths.push_back(ToText(out_));
  }
  EXPECT_THAT(paths[0], ElementsAre("feed X0 Y-2 Z0 F10", "feed X12 Y-2 Z0 F10",
                                    "feed X12 Y10 Z0 F10", "feed X10 Y30 Z0 F10"));
  EXPECT_EQ(paths[0], paths[1]);
}

TEST_F(CutterCompTest, InsideCornerOfLineAndArc) {
  ToCorner(1.0);
  // From X10 Y0 upward: counter-clockwise about X5 Y0; offset radius 4, offset line Y1.
  On(ArcTo(5, 5, 5, 0, false), Command::Comp::kLeft, 1.0);
  contour_->Flush();
  ASSERT_EQ(out_.size(), 3U);
  EXPECT_NEAR(out_[1].end[kX], 5 + std::sqrt(15.0), 1e-9);
  EXPECT_NEAR(out_[1].end[kY], 1.0, 1e-9);
  EXPECT_EQ(ToText(out_[2]), "ccw X5 Y4 Z0 about X5 Y0 Z0");
}

TEST_F(CutterCompTest, OutsideCornerOfArcsRunsOnTheTangents) {
  ToCorner();
  On(ArcTo(20, -10, 20, 0,
           false));  // Leaves X10 Y0 downward: 90 degrees right, then left around X20 Y0.
  contour_->Flush();
  EXPECT_THAT(ToText(out_), ElementsAre("feed X0 Y2 Z0 F10", "feed X12 Y2 Z0 F10",
                                        "feed X12 Y0 Z0 F10", "ccw X20 Y-8 Z0 about X20 Y0 Z0"));
}

TEST_F(CutterCompTest, AFullCircleStaysOne) {
  contour_->SetPosition(At(-20, 10, 0));
  On(FeedTo(0, 10));
  On(ArcTo(0, 10, 0, 0, true, true));  // Tangent to the entry, outside: radius 12.
  Off(FeedTo(20, 10));
  EXPECT_THAT(ToText(out_), ElementsAre("feed X0 Y12 Z0 F10", "cw full X0 Y12 Z0 about X0 Y0 Z0",
                                        "feed X20 Y10 Z0 F10"));
}

TEST_F(CutterCompTest, AFullCircleBetweenInsideCornersIsAnArc) {
  // In a pocket of radius 10: out to the wall at X10, around, and back; radius 2 on the left.
  On(FeedTo(5, 0));
  On(FeedTo(10, 0));
  On(ArcTo(10, 0, 0, 0, false, true));
  On(FeedTo(5, 0));
  Off(FeedTo(0, 0));
  EXPECT_THAT(findings_, IsEmpty());
  ASSERT_EQ(out_.size(), 5U);
  EXPECT_EQ(out_[2].kind, CommandKind::kArc);
  EXPECT_FALSE(out_[2].full_circle);
  const double x = std::sqrt(64.0 - 4.0);
  EXPECT_NEAR(out_[1].end[kX], x, 1e-9);
  EXPECT_NEAR(out_[1].end[kY], 2, 1e-9);
  EXPECT_NEAR(out_[2].end[kX], x, 1e-9);
  EXPECT_NEAR(out_[2].end[kY], -2, 1e-9);
}

TEST_F(CutterCompTest, EntryTypesDifferOnSharpOutsideTurns) {
  for (const bool type_b : {false, true}) {
    ContourOptions options;
    options.type_b = type_b;
    Reset(options);
    contour_->SetPosition(At(-20, 0, 0));
    On(FeedTo(0, 0));
    On(FeedTo(-10, -10));  // 135 degrees to the right.
    contour_->Flush();
    const double h = std::sqrt(2.0);
    ASSERT_EQ(out_.size(), type_b ? 4U : 2U);
    EXPECT_NEAR(out_[out_.size() - 2].end[kX], type_b ? 2 * h : h, 1e-9);
    if (!type_b) continue;
    EXPECT_EQ(ToText(out_[0]), "feed X0 Y2 Z0 F10");
    EXPECT_EQ(ToText(out_[1]), "feed X2 Y2 Z0 F10");
  }
  // At 90 degrees and less the two are one.
  for (const bool type_b : {false, true}) {
    ContourOptions options;
    options.type_b = type_b;
    Reset(options);
    contour_->SetPosition(At(-20, 0, 0));
    On(FeedTo(0, 0));
    On(FeedTo(0, -10));
    contour_->Flush();
    EXPECT_THAT(ToText(out_), ElementsAre("feed X2 Y0 Z0 F10", "feed X2 Y-10 Z0 F10"));
  }
}

TEST_F(CutterCompTest, ExitTypeBGoesAroundTheCorner) {
  ContourOptions options;
  options.type_b = true;
  Reset(options);
  ToCorner();
  Off(FeedTo(0, -10));
  const double h = std::sqrt(2.0);
  ASSERT_EQ(out_.size(), 5U);
  EXPECT_EQ(ToText(out_[1]), "feed X12 Y2 Z0 F10");
  EXPECT_NEAR(out_[3].end[kX], 10 + h, 1e-9);
  EXPECT_NEAR(out_[3].end[kY], -h, 1e-9);
  EXPECT_EQ(ToText(out_[4]), "feed X0 Y-10 Z0 F10");
}

TEST_F(CutterCompTest, MovesOutsideXYWaitForTheCorner) {
  contour_->SetPosition(At(-20, 0, 5));
  On(RapidTo(0, 0, 5));
  On(FeedTo(0, 0, -1));
  On(FeedTo(10, 0, -1));
  On(FeedTo(10, 0, 5));
  On(FeedTo(10, 10, 5));
  Off(FeedTo(10, 10, 9));  // G40 without X or Y: nothing changes until the next XY move.
  Off(FeedTo(10, 30, 9));
  EXPECT_THAT(
      ToText(out_),
      ElementsAre("rapid X0 Y2 Z5", "feed X0 Y2 Z-1 F10", "feed X8 Y2 Z-1 F10", "feed X8 Y2 Z5 F10",
                  "feed X8 Y10 Z5 F10", "feed X8 Y10 Z9 F10", "feed X10 Y30 Z9 F10"));
}

TEST_F(CutterCompTest, CompensatedMovesNameXAndY) {
  // "G40 X-20." goes to the programmed Y, from beside it.
  contour_->SetPosition(At(-20, 0, 0));
  const auto x_only = [](double x) {
    Command command = FeedTo(x, 0);
    command.named = 1U << kX;
    return command;
  };
  On(x_only(0));
  On(x_only(10));
  Off(x_only(30));
  EXPECT_THAT(ToText(out_),
              ElementsAre("feed X0 Y2 Z0 F10", "feed X10 Y2 Z0 F10", "feed X30 Y0 Z0 F10"));
  for (const Command& command : out_) EXPECT_EQ(command.named, 1U << kX | 1U << kY);
}

TEST_F(CutterCompTest, SmallStepFitsInFanucOnly) {
  // Manual: "a small cut of less than the tool radius and at a right angle to the previous motion
  // will work only with the Fanuc setting".
  for (const bool fanuc : {true, false}) {
    ContourOptions options;
    options.fanuc_corners = fanuc;
    Reset(options);
    ToCorner();
    On(FeedTo(10, 1));
    On(FeedTo(20, 1));
    Off(FeedTo(40, 1));
    if (fanuc) {
      EXPECT_THAT(findings_, IsEmpty());
      EXPECT_THAT(ToText(out_),
                  ElementsAre("feed X0 Y2 Z0 F10", "feed X8 Y2 Z0 F10", "feed X8 Y3 Z0 F10",
                              "feed X20 Y3 Z0 F10", "feed X40 Y1 Z0 F10"));
    } else {
      ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
      EXPECT_EQ(findings_[0].where.line, 3);
    }
  }
}

TEST_F(CutterCompTest, ASlotNarrowerThanTheToolIsAnAlarm) {
  for (const double width : {4.1, 3.9}) {
    Reset({});
    ToCorner();
    On(FeedTo(10, width));
    On(FeedTo(0, width));
    Off(FeedTo(-20, width));
    if (width > 4.0) {
      EXPECT_THAT(findings_, IsEmpty());
    } else {
      EXPECT_THAT(Rules(), ElementsAre("control-alarm"));
    }
  }
}

TEST_F(CutterCompTest, TwoMovesAheadAreLookedAt) {
  // A triangle with base 10 and height 8, cut from inside with its apex left out above `t` of the
  // sides. The radius of 2 fits up to 3.77 mm below the apex, t = 0.66: above it the tool beside
  // one side overcuts the other.
  for (const double t : {0.6, 0.75}) {
    Reset({});
    const auto side = [](double x, double along) { return FeedTo(x * (1 - along), 8 * along); };
    contour_->SetPosition(At(2, 3, 0));
    On(side(-5, t));
    On(side(-5, t - 0.05));
    On(side(-5, 0));
    On(side(5, 0));
    On(side(5, t));
    Off(FeedTo(0, 2));
    if (t < 0.66) {
      EXPECT_THAT(findings_, IsEmpty());
    } else {
      ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
      EXPECT_THAT(findings_[0].message, HasSubstr("overcut by"));
      EXPECT_EQ(findings_[0].where.line, 3);
    }
  }
}

TEST_F(CutterCompTest, InsideArcMustHoldTheTool) {
  for (const double radius : {2.001, 2.0, 1.5}) {
    Reset({});
    ToCorner();
    On(ArcTo(10, 2 * radius, 10, radius, false));
    On(FeedTo(0, 2 * radius));
    contour_->Flush();
    if (radius > 2.0) {
      EXPECT_THAT(findings_, IsEmpty());
    } else {
      ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
      EXPECT_THAT(findings_[0].message, HasSubstr("too small"));
    }
  }
}

TEST_F(CutterCompTest, StartOrEndInAnArcIsAnAlarm) {
  On(ArcTo(10, 10, 10, 0, true));
  ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
  EXPECT_THAT(findings_[0].message, HasSubstr("starts in an arc"));
  Reset({});
  ToCorner();
  Off(ArcTo(20, 10, 10, 10, false));
  ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
  EXPECT_THAT(findings_[0].message, HasSubstr("ends in an arc"));
}

TEST_F(CutterCompTest, SideChangesOnALineOnly) {
  ToCorner();
  On(FeedTo(20, 0), Command::Comp::kRight);
  On(FeedTo(30, 0), Command::Comp::kRight);
  contour_->Flush();
  EXPECT_THAT(findings_, IsEmpty());
  EXPECT_THAT(ToText(out_), ElementsAre("feed X0 Y2 Z0 F10", "feed X10 Y2 Z0 F10",
                                        "feed X20 Y-2 Z0 F10", "feed X30 Y-2 Z0 F10"));
  Reset({});
  ToCorner();
  On(ArcTo(20, 10, 10, 10, false), Command::Comp::kRight);
  ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
}

TEST_F(CutterCompTest, G17Only) {
  contour_->SetPosition(At(-20, 0, 0));
  Command entry = FeedTo(0, 0);
  entry.plane = Plane::kZX;
  On(entry);
  ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
  Reset({});
  ToCorner();
  Command arc = ArcTo(20, 0, 15, 0, true);
  arc.plane = Plane::kZX;
  On(arc);
  ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
}

TEST_F(CutterCompTest, StoppingWhileOnIsAnAlarm) {
  ToCorner();
  contour_->Stop({0, 9, 1}, true);
  ASSERT_THAT(Rules(), ElementsAre("control-alarm"));
  EXPECT_EQ(findings_[0].where.line, 9);
  Reset({});
  ToCorner();
  Off(FeedTo(10, 0, 5));  // G40 Z: never an XY move again, but cancelled.
  contour_->Stop({0, 9, 1}, false);
  EXPECT_THAT(findings_, IsEmpty());
  EXPECT_THAT(ToText(out_),
              ElementsAre("feed X0 Y2 Z0 F10", "feed X10 Y2 Z0 F10", "feed X10 Y2 Z5 F10"));
}

TEST_F(CutterCompTest, AShortEntryIsNotSettled) {
  contour_->SetPosition(At(-1.5, 0, 0));
  On(FeedTo(0, 0));
  EXPECT_THAT(Rules(), ElementsAre("unsupported-code"));
}

TEST_F(CutterCompTest, AFlushBetweenTangentMovesChangesNothing) {
  ToCorner();
  contour_->Flush();
  EXPECT_EQ(contour_->position(), At(10, 2, 0));
  On(FeedTo(20, 0));
  contour_->Flush();
  EXPECT_THAT(findings_, IsEmpty());
  On(FeedTo(20, 10));
  EXPECT_THAT(Rules(), ElementsAre("unsupported-code"));
}

TEST_F(CutterCompTest, MachineCoordinatesWhileOnAreNotSimulated) {
  ToCorner();
  Command home = RapidTo(0, 0, 0);
  home.kind = CommandKind::kMachineRapid;
  home.named = 1U << kZ;
  On(home);
  EXPECT_THAT(Rules(), ElementsAre("unsupported-code"));
}

TEST_F(CutterCompTest, InsideArcsSlowDownToSetting44) {
  for (const double least : {1.0, 0.7, 0.1}) {
    ContourOptions options;
    options.least_arc_feed = least;
    Reset(options);
    ToCorner();
    On(ArcTo(14, 4, 10, 4, false));
    contour_->Flush();
    EXPECT_NEAR(out_.back().feed, 10 * std::max(least, 0.5), 1e-9);
  }
}

TEST_F(CutterCompTest, ZeroRegisterFollowsTheProgram) {
  ToCorner(0.0);
  On(FeedTo(10, 10), Command::Comp::kLeft, 0.0);
  On(ArcTo(12, 12, 10, 12, false), Command::Comp::kLeft, 0.0);
  Off(FeedTo(0, 0));
  EXPECT_THAT(findings_, IsEmpty());
  EXPECT_THAT(ToText(out_),
              ElementsAre("feed X0 Y0 Z0 F10", "feed X10 Y0 Z0 F10", "feed X10 Y10 Z0 F10",
                          "ccw X12 Y12 Z0 about X10 Y12 Z0", "feed X0 Y0 Z0 F10"));
}

}  // namespace
}  // namespace ncsim::control
