// SPDX-License-Identifier: BSD-3-Clause
#include "post/writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "post/test_plan.h"

namespace ncsim::post {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

PlanPose Pose(double x, double y, double z, double b = 0.0, double c = 0.0) {
  return TestPlan::Pose(x, y, z, b, c);
}
PostSettings Inch() {
  PostSettings settings;
  settings.unit = ClUnit::kInch;
  return settings;
}
PlanPose InchPose(double x, double y, double z) {
  return Pose(x * kMmPerInch, y * kMmPerInch, z * kMmPerInch);
}

TEST(WriterTest, AHaasProgramFromStartToEnd) {
  // Order of blocks: Haas' DWO sample (2017 manual, "G254") and the UMC-750 programs of NX.
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(10, 20, 30, 45, -90));
  plan.modal().coolant.mode = cl::Coolant::Mode::kFlood;
  plan.Share();
  plan.Feed(Pose(10, 20, -1.5, 45, -90)).Add(PlanEnd{});
  EXPECT_THAT(plan.Write(ShippedPost(kUmc750)),
              ElementsAre("%", "O00001 (PART)", "(POSTED FROM PART.CLS)", "", "(FINISH)",
                          "G21 G17 G40 G49 G80 G90 G94", "G53 G00 Z0.", "(TOOL 3 BALL_MILL)",
                          "T3 M06", "S8000 M03", "G54", "M11", "M13", "G00 B45. C-90.", "M10",
                          "M12", "G254", "G00 X10. Y20.", "G43 H03 Z30.", "M08", "G01 Z-1.5 F600.",
                          "G53 G00 Z0.", "G255", "G49", "", "M09", "M05", "G53 G00 Z0.", "M11",
                          "M13", "G00 B0. C0.", "M10", "M12", "M30", "%"));
  EXPECT_EQ(AllOf(plan.diagnostics), "");
}

TEST(WriterTest, WordsPrintOnlyWhenChanged) {
  TestPlan plan;
  plan.Begin(PlanMode::kTcp, Pose(0, 0, 50, 10, 0));
  plan.Rapid(Pose(0, 0, 50, 10, 0));  // where the index has brought it
  plan.Feed(Pose(1, 0, 50, 10, 0)).Feed(Pose(1, 2, 50, 10, 0)).Feed(Pose(1, 2, 50, 10, 0));
  plan.Feed(Pose(1, 2, 49, 11, 0), 300.0).Feed(Pose(1, 2, 49.0004, 11, 0));
  const auto lines = plan.Write(ShippedPost(kUmc750));
  EXPECT_THAT(Behind(lines, "G00 G234 H03 X0. Y0. Z50."),
              ElementsAre("G01 X1. F600.", "Y2.", "Z49. B11. F300."));
  EXPECT_EQ(AllOf(plan.diagnostics), "");
}

TEST(WriterTest, ArcsOfFigure17OfPaper000) {
  // The commercial post's blocks of the part's corner, from its circle rebuilt in inches.
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, InchPose(.799, .8754, 3.0));
  plan.Arc(InchPose(.8154, .8153, 3.0), Eigen::Vector3d(.8922, .8687, 3.0) * kMmPerInch, false);
  plan.Arc(InchPose(.8729, .799, 3.0), Eigen::Vector3d(.8671, .8878, 3.0) * kMmPerInch, false);
  const auto lines = plan.Write(ShippedPost(kUmc750), Inch());
  EXPECT_THAT(Behind(lines, "G43 H03 Z3."),
              ElementsAre("G03 X.8154 Y.8153 I.0932 J-.0067 F23.62", "X.8729 Y.799 I.0517 J.0725"));
}

TEST(WriterTest, TheCentreIsFromTheStartAsItIsPrinted) {
  // What a control computes from the printed words meets the centre, though no word of the start is
  // on the grid; centres of the exact starts would be off by up to half an increment more.
  TestPlan plan;
  const Eigen::Vector3d centre(3.21738, -1.19261, 5.0);
  const double radius = 7.77777;
  const auto at = [&](double angle) {
    return Pose(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle), 5.0);
  };
  plan.Begin(PlanMode::kIndexed, at(0.0));
  for (int k = 1; k < 40; ++k) plan.Arc(at(0.37 * k), centre, false);
  const auto lines = plan.Write(ShippedPost(kUmc750));
  Eigen::Vector2d here = Eigen::Vector2d::Zero();
  int arcs = 0;
  for (const std::string& line : lines) {
    if (!line.empty() && line.front() == '(') continue;
    std::map<char, double> words;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      if (std::string("XYIJ").find(line[i]) != std::string::npos) {
        words[line[i]] = std::strtod(line.c_str() + i + 1, nullptr);
      }
    }
    if (words.count('I') > 0) {
      ++arcs;
      EXPECT_NEAR(here.x() + words['I'], centre.x(), 0.00051) << line;
      EXPECT_NEAR(here.y() + words['J'], centre.y(), 0.00051) << line;
    }
    if (words.count('X') > 0) here.x() = words['X'];
    if (words.count('Y') > 0) here.y() = words['Y'];
  }
  EXPECT_EQ(arcs, 39);
}

TEST(WriterTest, CirclesAndWhatIsSmallerThanAnIncrement) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(5, 0, 0));
  plan.Arc(Pose(5, 0, 0), {0, 0, 0}, true);
  // Computed again, on the other side of where 5.0005 rounds: still a circle.
  plan.Feed(Pose(5.0005 - 1e-9, 0, 0)).Arc(Pose(5.0005 + 1e-9, 0, 0), {0, 0, 0}, true);
  // 0.0002 mm of an arc is no circle, and no motion.
  plan.Arc(Pose(5.0005, 0.0002, 0), {0, 0, 0}, false);
  const auto lines = plan.Write(ShippedPost(kUmc750));
  EXPECT_THAT(Behind(lines, "G43 H03 Z0."), ElementsAre("G02 I-5. J0. F600.", "I-5. J0."));
  EXPECT_EQ(AllOf(plan.diagnostics), "");
}

TEST(WriterTest, AnArcThatRoundingTurnsRoundIsALine) {
  // 0.00005 mm counter-clockwise, with X on both sides of where it rounds and Y below the centre as
  // it is printed: from X10.001 Y0. to X10. Y0. about Y.0003 would be all but a turn.
  const Eigen::Vector3d centre(0.0005 + 7.8125e-10, 0.0003, 0.0);
  const auto at = [&](double sine) {
    return Pose(centre.x() + 10.0 * std::sqrt(1.0 - sine * sine), centre.y() + 10.0 * sine, 0.0);
  };
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, at(1e-5)).Arc(at(1.5e-5), centre, false);
  const auto lines = plan.Write(ShippedPost(kUmc750));
  EXPECT_THAT(lines, Contains("G00 X10.001 Y0."));
  EXPECT_THAT(Behind(lines, "G43 H03 Z0."), ElementsAre("G01 X10. F600."));
}

TEST(WriterTest, AHelixIsABlockATurnOrTurn) {
  // 2.5 turns down from Z0 to Z-5, clockwise about 0,0 with radius 4.
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(4, 0, 0));
  plan.Arc(Pose(-4, 0, -5), {0, 0, 0}, true, 2);
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z0."),
              ElementsAre("G02 Z-2. I-4. J0. F600.", "Z-4. I-4. J0.", "X-4. Z-5. I-4. J0."));
  const auto lines = plan.Write(ShippedPost(kBcTable), {}, "three");
  EXPECT_THAT(Behind(lines, "Z0."), ElementsAre("G2 X-4. Y0. Z-5. I-4. J0. TURN=2 F600."));
  EXPECT_EQ(AllOf(plan.diagnostics), "");
}

TEST(WriterTest, InverseTimeWhereARotaryAxisTurns) {
  // F is 1/min: 60 / 0.75 s.
  TestPlan plan;
  plan.Begin(PlanMode::kAxes, Pose(0, 0, 50, 10, 0));
  plan.Feed(Pose(1, 0, 50, 12, 0), 600, 0.75).Feed(Pose(1, 1, 50, 12, 0), 600, 0.1);
  plan.Feed(Pose(1, 1, 50, 13, 5), 600, 1e-6);
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z50."),
              ElementsAre("G93 G01 X1. B12. F80.", "G94 Y1. F600.", "G93 B13. C5. F45000."));
}

TEST(WriterTest, ARewindTurnsAboveThePart) {
  // The planner has left the part along the tool, and comes back: the block turns up there.
  TestPlan plan;
  PlanPose at = Pose(35, 0, 0, 90, 350);
  at.axis_P = Eigen::Vector3d::UnitX();
  plan.Begin(PlanMode::kTcp, at);
  PlanIndex rewind;
  rewind.why = PlanIndex::Why::kRewind;
  rewind.mode = PlanMode::kTcp;
  rewind.rotary = {Radians(90.0), Radians(-10.0)};
  rewind.approach = at;
  // The plane that faces the tool at B90 C-10: Rz(C) Ry(B).
  rewind.plane_P = (Eigen::AngleAxisd(Radians(-10.0), Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(Radians(90.0), Eigen::Vector3d::UnitY()))
                       .toRotationMatrix();
  plan.Add(rewind).Feed(Pose(10, 0, 0, 90, -10), 500.0);
  const auto lines = plan.Write(ShippedPost(kUmc750));
  // At (35, 0, 0) with C-10, Y of the machine is 35 sin 10.
  EXPECT_THAT(Behind(lines, "(REWIND)"),
              ElementsAre("G53 G00 Z0.", "G49", "G00 B90. C-10.", "G254", "G00 X0. Y6.078", "G255",
                          "G00 G234 H03 X35. Y0. Z0.", "G01 X10. F500."));
}

TEST(WriterTest, AnOperationMayGoOnWhereTheLastOneEnds) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 5)).Feed(Pose(1, 0, 5));
  PlanOperation same;
  plan.Add(same).Feed(Pose(2, 0, 5));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z5."),
              ElementsAre("G01 X1. F600.", "", "(FINISH)", "X2."));
}

TEST(WriterTest, CompensationBeginsAndEndsWithALine) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 5));
  plan.modal().comp.side = cl::CutterComp::Side::kLeft;
  plan.Share().Add(cl::CutterComp{});
  plan.Feed(Pose(5, 0, 5)).Feed(Pose(5, 5, 5));
  plan.modal().comp.side = cl::CutterComp::Side::kOff;
  plan.Share().Feed(Pose(0, 5, 5));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z5."),
              ElementsAre("G01 G41 X5. D03 F600.", "Y5.", "G40 X0."));
  plan.modal().comp.side = cl::CutterComp::Side::kRight;
  plan.Share().Arc(Pose(5, 5, 5), {2.5, 5, 5}, true);
  plan.Write(ShippedPost(kUmc750));
  EXPECT_THAT(AllOf(plan.diagnostics),
              HasSubstr("part.cls:7: error: cutter compensation begins or ends on an arc"));
}

TEST(WriterTest, RapidsGoUpAcrossAndDown) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 5));
  plan.Rapid(Pose(10, 0, 20)).Rapid(Pose(20, 5, 1));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z5."),
              ElementsAre("Z20.", "X10.", "X20. Y5.", "Z1."));
}

TEST(WriterTest, ATableThatFoldsGoesTheShortestWay) {
  TestPlan plan;
  plan.Begin(PlanMode::kTcp, Pose(0, 0, 50, 10, 359.9));
  plan.Feed(Pose(0, 1, 50, 10, 359.999999)).Feed(Pose(0, 2, 50, 10, 360.4));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kBcTable)), "G0 X0. Y0. Z50."),
              ElementsAre("G1 Y1. C=DC(0.) F600.", "Y2. C=DC(.4)"));
  EXPECT_EQ(AllOf(plan.diagnostics), "");
  plan.Feed(Pose(0, 3, 50, 10, 540.4));
  plan.Write(ShippedPost(kBcTable));
  EXPECT_THAT(AllOf(plan.diagnostics), HasSubstr("C turns by 180 degrees or more in a block"));
}

TEST(WriterTest, VectorWordsPrintTogether) {
  // A component of a vector that is not stated would be 0.
  TestPlan plan;
  PlanPose at = Pose(0, 0, 50, 90, 0);
  at.axis_P = {0.6, 0.0, 0.8};
  plan.Begin(PlanMode::kTcp, at);
  plan.Feed(at);  // where B and C have brought it
  at.xyz.x() = 1.0;
  plan.Feed(at);
  at.axis_P = {0.6, 0.8, 0.0};
  plan.Feed(at);
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kBcTable), {}, "vectors"), "G0 X0. Y0. Z50."),
              ElementsAre("G1 X1. F600.", "A3=.6 B3=.8 C3=0."));
}

TEST(WriterTest, PlaneAnglesOfCycle800AndRot) {
  // The corpus' NX program for another machine: CYCLE800 angles 28.5492 -25.5438 90 for the tool
  // axis (-.431, -.431, .793).
  const auto turn = [](double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(Radians(degrees), axis);
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d plane =
      (turn(28.5492, x) * turn(-25.5438, y) * turn(90, z)).toRotationMatrix();
  EXPECT_NEAR(plane(0, 2), -.431, 0.0005);
  EXPECT_NEAR(plane(2, 2), .793, 0.0005);
  TestPlan plan;
  PlanOperation operation;
  plan.Add(operation).Index(PlanMode::kIndexed, Pose(0, 0, 50, -37.57, 45), plane);
  EXPECT_THAT(plan.Write(ShippedPost(kBcTable)),
              Contains("CYCLE800(1,\"TABLE\",0,57,0,0,0,28.5492,-25.5438,90.,0,0,0,-1)"));
  // ROT takes Z first: the same plane by other angles, also where the tool lies.
  for (const auto& angles :
       {std::array{10.0, 20.0, 30.0}, std::array{40.0, 90.0, 0.0}, std::array{-50.0, -90.0, 0.0}}) {
    TestPlan rot;
    rot.Add(operation);
    rot.Index(PlanMode::kIndexed, Pose(0, 0, 50, 1, 1),
              (turn(angles[2], z) * turn(angles[1], y) * turn(angles[0], x)).toRotationMatrix());
    const auto lines = rot.Write(ShippedPost(kBcTable), {}, "rot");
    std::string wanted = "ROT X" + std::to_string(static_cast<int>(angles[0])) + ". Y" +
                         std::to_string(static_cast<int>(angles[1])) + ". Z" +
                         std::to_string(static_cast<int>(angles[2])) + ".";
    EXPECT_THAT(lines, Contains(wanted));
  }
}

TEST(WriterTest, SpindleAndCoolantAreOnBeforeTheNextMotion) {
  TestPlan plan;
  plan.modal().coolant.mode = cl::Coolant::Mode::kFlood;
  plan.Share().Begin(PlanMode::kIndexed, Pose(0, 0, 5));
  plan.Feed(Pose(5, 0, 5)).Add(cl::Stop{}).Feed(Pose(6, 0, 5));
  plan.modal().spindle.clockwise = false;
  plan.Share().Add(cl::Spindle{}).Feed(Pose(7, 0, 5));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z5."),
              ElementsAre("M08", "G01 X5. F600.", "M00", "S8000 M03", "M08", "X6.", "M04", "X7."));
}

TEST(WriterTest, WhatTheFileSaysToThePost) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 5));
  plan.Add(cl::Text{cl::Text::Kind::kPrint,
                    "check (the) \xc3\xa9"
                    "dge"});
  plan.Add(cl::Text{cl::Text::Kind::kInsert, "G01 X7. F99."});
  plan.Add(cl::Text{cl::Text::Kind::kInsert, "STOCK SIZE X85. Y38."});
  plan.Feed(Pose(5, 0, 5));
  plan.Add(cl::Code{'M', 51.0, false}).Add(cl::Code{'M', 61.0, true});
  plan.Feed(Pose(6, 0, 5));
  plan.Add(ClDwell{16.0, true});
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kUmc750)), "G43 H03 Z5."),
              // 16 revolutions at 8000 a minute: 0.12 s.
              ElementsAre("(CHECK -THE- -DGE)", "G01 X7. F99.", "(STOCK SIZE X85. Y38.)",
                          "X5. F600.", "M51", "M61 X6.", "G04 P0.12"));
  EXPECT_EQ(AllOf(plan.diagnostics),
            "part.cls:5: warning: 'STOCK SIZE X85. Y38.' is no NC words: it is printed as a "
            "comment\n");
}

TEST(WriterTest, WhatHasNoWordsIsReportedWithItsLine) {
  TestPlan plan;
  plan.Begin(PlanMode::kTcp, Pose(0, 0, 5));
  plan.Add(cl::PostWord{"CLEARP", {"XYPLAN", "50"}});
  plan.modal().coolant.mode = cl::Coolant::Mode::kThrough;
  plan.Share().Feed(Pose(5, 0, 5)).Arc(Pose(0, 5, 5), {0, 0, 5}, false);
  plan.modal().spindle.mode = cl::Spindle::Mode::kSurface;
  plan.Share().Feed(Pose(0, 6, 5));
  PlanMove slow;
  slow.end = Pose(0, 7, 5);
  slow.feed.value = 0.0001;
  plan.Add(slow);
  plan.Write(ShippedPost(kUmc750));
  EXPECT_EQ(AllOf(plan.diagnostics),
            "part.cls:3: error: CLEARP has no words in the post (functions)\n"
            "part.cls:4: error: the post has no code for coolant through (codes.coolant)\n"
            "part.cls:6: error: a constant surface speed has no words in the post\n"
            "part.cls:7: error: the feed is 0 as it is printed\n");
}

TEST(WriterTest, AnAddressWithoutItsValueIsReported) {
  std::string post = ShippedPost(kFanuc);
  const std::string from = "T{tool.number} M06";
  post.replace(post.find(from), from.size(), from + "\nG65 P1 A{tool.diameter} {?B{tool.length}}");
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 5));
  plan.tool().length = 80.0;
  plan.Share().Begin(PlanMode::kIndexed, Pose(0, 0, 5));
  plan.Write(post);
  EXPECT_EQ(AllOf(plan.diagnostics),
            "part.cls:3: error: 'tool.diameter' has no value here, in the line 'G65 P1 A B80.' (in "
            "{? } it could vanish)\n");
}

TEST(WriterTest, TheControlTurnsTheTablesOfCycle800) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 5, 30, 20)).Rapid(Pose(1, 0, 5, 30, 20));
  EXPECT_THAT(Behind(plan.Write(ShippedPost(kBcTable)), "Z5."), ElementsAre("X1."));
}

TEST(WriterTest, WhatAModeCannotTurnIsReported) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 5, 45, 0));
  plan.Write(ShippedPost(kFanuc));
  EXPECT_EQ(AllOf(plan.diagnostics),
            "part.cls:2: error: mode 'three' turns no rotary axis, and the tool axis needs it\n");
}

TEST(WriterTest, OperationsInFilesOfTheirOwn) {
  TestPlan plan;
  plan.Begin(PlanMode::kTcp, Pose(0, 0, 5)).Feed(Pose(1, 0, 5)).Add(PlanEnd{});
  Diagnostics diagnostics;
  const auto post = LoadPost(ShippedPost(kBcTable), "p", {}, &diagnostics);
  ASSERT_TRUE(post);
  ProgramInfo info;
  info.name = "PART";
  std::ostringstream main;
  std::map<std::string, std::ostringstream> files;
  NcWriter writer(*post, info, &diagnostics, &main,
                  [&](const std::string& name) { return &files[name]; });
  plan.ForEach([&](const PlanStep& step) { writer.OnStep(step); });
  EXPECT_THAT(TestPlan::Lines(main.str()), Contains("EXTCALL(\"PART_1\")"));
  EXPECT_THAT(TestPlan::Lines(main.str()), Not(Contains("TRAORI")));
  ASSERT_EQ(files.size(), 1U);
  const auto lines = TestPlan::Lines(files.at("PART_1.mpf").str());
  EXPECT_THAT(lines, Contains("TRAORI"));
  EXPECT_EQ(lines.back(), "M17");
  EXPECT_EQ(AllOf(diagnostics), "");
}

TEST(WriterTest, LineNumbersBeginAnew) {
  std::string text = ShippedPost(kFanuc);
  text.replace(text.find("highest = 9990"), 14, "highest = 50");
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, Pose(0, 0, 5));
  Diagnostics diagnostics;
  const auto post = LoadPost(text, "p", {}, &diagnostics);
  ASSERT_TRUE(post);
  std::ostringstream out;
  NcWriter writer(*post, {}, &diagnostics, &out);
  plan.ForEach([&](const PlanStep& step) { writer.OnStep(step); });
  EXPECT_THAT(out.str(), HasSubstr("N50 S8000 M03\nN10 G54\nN20 G00 X0. Y0.\n"));
}

}  // namespace
}  // namespace ncsim::post
