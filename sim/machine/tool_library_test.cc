// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/tool_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/units.h"

namespace ncsim::machine {
namespace {

ToolSpec Spec(CutterType type, double diameter, double corner, double flutes) {
  ToolSpec spec;
  spec.number = 1;
  spec.length = 150.0;
  spec.cutter.type = type;
  spec.cutter.diameter = diameter;
  spec.cutter.corner_radius = corner;
  spec.cutter.flute_length = flutes;
  spec.cutter.point_angle = Radians(118.0);
  spec.cutter.taper_angle = Radians(10.0);
  spec.holder = {{40.0, 50.0, 60.0}};
  return spec;
}

Tool Make(const ToolSpec& spec) {
  Tool tool;
  EXPECT_EQ(MakeTool(spec, &tool), "");
  return tool;
}

/// Radius of a profile at z, from the elements alone.
double RadiusAt(const Profile& profile, double z) {
  double radius = 0.0;
  for (const ProfileElement& e : profile.elements) {
    if (z < e.start.x() || z > e.end.x() || e.start.x() == e.end.x()) continue;
    if (e.arc) {
      const double dz = z - e.centre.x();
      const double r = (e.start - e.centre).norm();
      radius = e.centre.y() + std::sqrt(std::max(0.0, r * r - dz * dz));
    } else {
      const double t = (z - e.start.x()) / (e.end.x() - e.start.x());
      radius = e.start.y() + t * (e.end.y() - e.start.y());
    }
  }
  return radius;
}

/// What every Profile promises: from axis to axis, end to end, z never decreasing, arcs round their
/// centre.
void ExpectClosed(const Profile& profile) {
  ASSERT_FALSE(profile.empty());
  EXPECT_EQ(profile.elements.front().start.y(), 0.0);
  EXPECT_EQ(profile.elements.back().end.y(), 0.0);
  for (std::size_t i = 0; i < profile.elements.size(); ++i) {
    const ProfileElement& e = profile.elements[i];
    EXPECT_GE(e.end.x(), e.start.x());
    EXPECT_GE(e.end.y(), 0.0);
    if (i > 0) {
      EXPECT_EQ(e.start, profile.elements[i - 1].end);
    }
    if (e.arc) {
      EXPECT_NEAR((e.start - e.centre).norm(), (e.end - e.centre).norm(), 1e-9);
    }
  }
}

TEST(MakeToolTest, EveryCutterIsAClosedProfileOfTheRightShape) {
  const Tool end = Make(Spec(CutterType::kEnd, 12.0, 0.0, 30.0));
  EXPECT_NEAR(RadiusAt(end.flutes, 0.1), 6.0, 1e-12);
  const Tool ball = Make(Spec(CutterType::kBall, 6.0, 3.0, 20.0));
  EXPECT_NEAR(RadiusAt(ball.flutes, 1.0), std::sqrt(9.0 - 4.0), 1e-12);
  EXPECT_NEAR(RadiusAt(ball.flutes, 10.0), 3.0, 1e-12);
  const Tool bull = Make(Spec(CutterType::kBull, 12.0, 2.0, 30.0));
  EXPECT_NEAR(RadiusAt(bull.flutes, 2.0 - std::sqrt(2.0)), 4.0 + std::sqrt(2.0), 1e-9);
  const Tool drill = Make(Spec(CutterType::kDrill, 10.0, 0.0, 50.0));
  EXPECT_NEAR(RadiusAt(drill.flutes, 1.0), std::tan(Radians(59.0)), 1e-9);
  EXPECT_NEAR(RadiusAt(drill.flutes, 20.0), 5.0, 1e-12);
  for (const Tool& tool : {end, ball, bull, drill}) {
    ExpectClosed(tool.flutes);
    ExpectClosed(tool.shank);
    ExpectClosed(tool.holder);
    EXPECT_EQ(tool.flutes.z_min(), 0.0);
    EXPECT_EQ(tool.shank.z_min(), tool.flutes.z_max());
    EXPECT_EQ(tool.holder.z_min(), tool.shank.z_max());
    EXPECT_EQ(tool.holder.z_max(), 150.0);
  }
}

// A ball of radius c under a cone of half angle t touches it at z = c (1 - sin t), r = c cos t:
// closed form.
TEST(MakeToolTest, TaperedBallIsTangentToItsCone) {
  const double angle = Radians(10.0);
  const Tool taper = Make(Spec(CutterType::kTaper, 6.0, 3.0, 30.0));
  ExpectClosed(taper.flutes);
  const double z = 3.0 * (1.0 - std::sin(angle));
  EXPECT_NEAR(RadiusAt(taper.flutes, z), 3.0 * std::cos(angle), 1e-9);
  EXPECT_NEAR(RadiusAt(taper.flutes, 30.0), 3.0 * std::cos(angle) + (30.0 - z) * std::tan(angle),
              1e-9);
  EXPECT_NEAR(RadiusAt(taper.shank, 31.0), RadiusAt(taper.flutes, 30.0), 1e-9);
  const Tool sharp = Make(Spec(CutterType::kTaper, 6.0, 0.0, 30.0));
  EXPECT_NEAR(RadiusAt(sharp.flutes, 10.0), 3.0 + 10.0 * std::tan(angle), 1e-9);
}

TEST(MakeToolTest, ChamferMillIsAConeUnderACylinder) {
  ToolSpec spec = Spec(CutterType::kChamfer, 12.0, 0.0, 20.0);
  spec.cutter.taper_angle = Radians(45.0);
  spec.cutter.tip_diameter = 2.0;
  const Tool tool = Make(spec);
  ExpectClosed(tool.flutes);
  EXPECT_NEAR(RadiusAt(tool.flutes, 3.0), 4.0, 1e-9);
  EXPECT_NEAR(RadiusAt(tool.flutes, 10.0), 6.0, 1e-9);
}

TEST(MakeToolTest, TheLastShankElementGoesOnToTheHolder) {
  ToolSpec spec = Spec(CutterType::kEnd, 6.0, 0.0, 20.0);
  spec.shank = {{6.0, 10.0, 5.0}, {10.0, 12.0, 5.0}};
  const Tool tool = Make(spec);
  EXPECT_NEAR(RadiusAt(tool.shank, 22.5), 4.0, 1e-12);
  EXPECT_NEAR(RadiusAt(tool.shank, 60.0), 6.0, 1e-12);
  EXPECT_EQ(tool.shank.z_max(), 90.0);
}

TEST(MakeToolTest, FlutesUpToTheHolderNeedNoShank) {
  const Tool tool = Make(Spec(CutterType::kEnd, 6.0, 0.0, 90.0));
  EXPECT_TRUE(tool.shank.empty());
  EXPECT_EQ(tool.holder.z_min(), 90.0);
}

TEST(MakeToolTest, NonsenseIsRefusedInWordsAndLeavesTheToolAlone) {
  Tool tool;
  tool.number = 99;
  EXPECT_EQ(MakeTool(Spec(CutterType::kEnd, 0.0, 0.0, 30.0), &tool), "the cutter has no diameter");
  EXPECT_EQ(MakeTool(Spec(CutterType::kEnd, 6.0, 0.5, 30.0), &tool),
            "an end mill with a corner radius is a bull mill");
  EXPECT_EQ(MakeTool(Spec(CutterType::kEnd, 6.0, 0.0, 90.1), &tool),
            "flutes (90.1 mm) and holder (60 mm) are longer than the tool (150 mm)");
  ToolSpec drill = Spec(CutterType::kDrill, 10.0, 0.0, 30.0);
  drill.cutter.point_angle = Radians(181.0);
  EXPECT_EQ(MakeTool(drill, &tool), "the point angle must be above 0 and at most 180 degrees");
  drill.cutter.point_angle = Radians(1.0);
  EXPECT_EQ(MakeTool(drill, &tool), "the flutes are shorter than the drill's point");
  EXPECT_EQ(tool.number, 99);
}

// ANSI/ASME B5.50 no. 40: gauge diameter 1.750 in, flange 2.500 in from .125 to .750 in below the
// gauge line.
TEST(HolderTest, Cat40FlangeStandsWhereTheStandardPutsIt) {
  ToolSpec spec = Spec(CutterType::kEnd, 6.0, 0.0, 20.0);
  spec.holder = *HolderByName("CAT40-ER32-100");
  const Tool tool = Make(spec);
  ExpectClosed(tool.holder);
  EXPECT_NEAR(tool.holder.z_min(), 50.0, 1e-9);
  const double gauge = tool.length;
  EXPECT_NEAR(RadiusAt(tool.holder, gauge - 3.0), 0.5 * 1.750 * kMmPerInch, 1e-9);
  EXPECT_NEAR(RadiusAt(tool.holder, gauge - 3.2), 0.5 * 2.500 * kMmPerInch, 1e-9);
  EXPECT_NEAR(RadiusAt(tool.holder, gauge - 19.0), 0.5 * 2.500 * kMmPerInch, 1e-9);
  EXPECT_NEAR(RadiusAt(tool.holder, gauge - 19.1), 25.0, 1e-9);
}

// MAS 403 no. 40: gauge diameter 44.45, flange 63 in diameter and 25 thick, 2 below the gauge line.
TEST(HolderTest, Bt40FlangeStandsWhereTheStandardPutsIt) {
  ToolSpec spec = Spec(CutterType::kEnd, 6.0, 0.0, 20.0);
  spec.holder = *HolderByName("BT40-ER16-100");
  const Tool tool = Make(spec);
  const double gauge = tool.length;
  EXPECT_NEAR(RadiusAt(tool.holder, gauge - 1.9), 0.5 * 44.45, 1e-9);
  EXPECT_NEAR(RadiusAt(tool.holder, gauge - 2.1), 31.5, 1e-9);
  EXPECT_NEAR(RadiusAt(tool.holder, gauge - 26.9), 31.5, 1e-9);
  EXPECT_NEAR(RadiusAt(tool.holder, gauge - 27.1), 16.0, 1e-9);
}

TEST(HolderTest, EveryNameGivesAHolderOfItsGaugeLength) {
  for (const std::string& name : HolderNames()) {
    const auto holder = HolderByName(name);
    ASSERT_TRUE(holder.has_value()) << name;
    double height = 0.0;
    for (const Frustum& frustum : *holder) {
      EXPECT_GT(frustum.height, 0.0) << name;
      height += frustum.height;
    }
    EXPECT_NEAR(height, std::stod(name.substr(name.rfind('-') + 1)), 1e-9) << name;
  }
  EXPECT_EQ(HolderByName("CAT40-ER32-101"), std::nullopt);
}

TEST(AssumeToolTest, SaysEverythingThatWasTaken) {
  const Tool ball = AssumeTool(3, "BALL_MILL", 5.9944, 2.9972, 180.0, "CAT40");
  EXPECT_EQ(ball.number, 3);
  EXPECT_EQ(ball.type, CutterType::kBall);
  EXPECT_EQ(ball.length, 180.0);
  EXPECT_EQ(ball.holder.z_min(), 80.0);
  EXPECT_EQ(
      ball.assumed,
      "length 180 mm, ball diameter 5.994 mm, corner radius 2.997 mm, flutes 17.983 mm, holder "
      "CAT40-ER32-100");
  EXPECT_EQ(AssumeTool(4, "", 12.0, 1.0, 180.0, "CAT40").type, CutterType::kBull);
  EXPECT_EQ(AssumeTool(4, "", 12.0, 0.0, 180.0, "BT40").type, CutterType::kEnd);
}

TEST(AssumeToolTest, MakesATooLWhateverItIsGiven) {
  for (const double diameter : {0.0, -1.0, 0.1, 12.0, 200.0}) {
    for (const double length : {0.0, 1.0, 50.0, 180.0}) {
      for (const double corner : {-1.0, 0.0, 3.0, 500.0}) {
        const Tool tool = AssumeTool(7, "", diameter, corner, length, "QQQ");
        ExpectClosed(tool.flutes);
        EXPECT_EQ(tool.number, 7);
        EXPECT_NE(tool.assumed, "");
      }
    }
  }
  EXPECT_THAT(AssumeTool(7, "", 12.0, 0.0, 70.0, "CAT40").assumed,
              ::testing::EndsWith("holder CAT40-ER32-60"));
}

// What an unnamed holder is follows from the spindle; a job is read before the model is.
TEST(AssumeToolTest, TakesTheHolderOfTheSpindle) {
  EXPECT_EQ(AssumedHolder("HSK-A63"), "HSK-A63-ER32-100");
  EXPECT_EQ(AssumedHolder("Capto C6"), "CAT40-ER32-100");
  EXPECT_THAT(AssumeTool(7, "", 12.0, 0.0, 180.0, "BT40").assumed,
              ::testing::EndsWith("holder BT40-ER32-100"));
  EXPECT_THAT(AssumeTool(7, "", 12.0, 0.0, 100.0, "BT40").assumed,
              ::testing::EndsWith("holder BT40-ER32-70"));

  ToolSpec spec = Spec(CutterType::kEnd, 6.0, 0.0, 20.0);
  spec.holder = *HolderByName("CAT40-ER32-100");
  Tool tool = Make(spec);
  tool.assumed_holder = "CAT40-ER32-100";
  tool.assumed = "holder CAT40-ER32-100, and more";
  ChangeAssumedHolder("BT40", &tool);
  EXPECT_EQ(tool.assumed, "holder BT40-ER32-100, and more");
  spec.holder = *HolderByName("BT40-ER32-100");
  const Tool wanted = Make(spec);
  for (const double depth : {1.0, 2.5, 26.5, 27.5, 99.0}) {
    const double z = tool.length - depth;
    EXPECT_EQ(RadiusAt(tool.holder, z), RadiusAt(wanted.holder, z)) << depth;
  }
  EXPECT_EQ(tool.holder.z_min(), wanted.holder.z_min());
}

}  // namespace
}  // namespace ncsim::machine
