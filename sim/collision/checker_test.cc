// SPDX-License-Identifier: BSD-3-Clause
// Contacts and clearances of whole motions against closed forms. Each fault has an honest twin
// beside it. Tool T3: flutes and shank of radius 5 up to 90 above the tip, holder of radius 20 from
// there.
#include "sim/collision/checker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/collision/test_rig.h"

namespace ncsim::collision {
namespace {

using machine::BodyKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

// A pin (the shank and flutes) along a slot of two jaws, `gap` on either side.
CollisionResult ThroughSlot(double gap) {
  Rig rig;
  rig.AddBox("left", BodyKind::kFixture, {-50, -20, 0}, {50, -5 - gap, 40});
  rig.AddBox("right", BodyKind::kFixture, {-50, 5 + gap, 0}, {50, 20, 40});
  rig.Start(-100, 0, 10);
  rig.Rapid(100, 0, 10);
  return rig.Run();
}

TEST(CheckerTest, PinThroughSlot) {
  EXPECT_THAT(ThroughSlot(0.03).findings, IsEmpty());
  const CollisionResult hit = ThroughSlot(-0.03);
  ASSERT_THAT(Of(hit, Rule::kCollision), SizeIs(4)) << Words(hit);  // flutes and shank, each jaw
  EXPECT_NEAR(*hit.findings[0].clearance_mm, -0.03, 0.01);
}

// A wall 0.05 mm thick, crossed by one rapid of 200 mm.
TEST(CheckerTest, ThinWallIsNotSteppedOver) {
  Rig rig;
  rig.AddBox("foil", BodyKind::kFixture, {7.3, -50, 0}, {7.35, 50, 40});
  rig.Start(-100, 0, 10);
  rig.Rapid(100, 0, 10);
  const CollisionResult result = rig.Run();
  const std::vector<Finding> hits = Of(result, Rule::kCollision);
  ASSERT_THAT(hits, SizeIs(2)) << Words(result);
  EXPECT_THAT(hits[0].bodies, ElementsAre("T3.flutes", "foil"));
  // First contact: axis 5 mm short of the wall, to 1e-3 of the move.
  EXPECT_EQ(hits[0].axes[0].first, 'X');
  EXPECT_NEAR(hits[0].axes[0].second, 2.3, 0.2);
  EXPECT_NEAR(*hits[0].time_s, 0.5115, 0.002);
  // The deepest pose has the wall on the axis.
  EXPECT_NEAR(*hits[0].clearance_mm, -5.0, 0.01);
  EXPECT_THAT(hits[0].message, HasSubstr("flutes of T3 hit foil 5 mm deep at X2."));
}

TEST(CheckerTest, ThinWallHonestTwin) {
  Rig rig;
  rig.AddBox("foil", BodyKind::kFixture, {7.3, -50, 0}, {7.35, 50, 9.97});
  rig.Start(-100, 0, 10);
  rig.Rapid(100, 0, 10);
  EXPECT_THAT(rig.Run().findings, IsEmpty());
}

TEST(CheckerTest, HolderDepthAndWords) {
  Rig rig;
  // The jaw's top is 1.4 above the holder's underside at the end of the plunge; tip at z = 20.
  rig.AddBox("vise_jaw", BodyKind::kFixture, {12, -30, 0}, {60, 30, 111.4});
  rig.Start(0, 0, 200);
  rig.Rapid(0, 0, 20);
  const CollisionResult result = rig.Run();
  ASSERT_THAT(result.findings, SizeIs(1)) << Words(result);
  const Finding& f = result.findings[0];
  EXPECT_EQ(f.rule, Rule::kCollision);
  EXPECT_EQ(f.severity, Severity::kError);
  EXPECT_NEAR(*f.clearance_mm, -1.4, 0.01);
  EXPECT_THAT(f.message,
              HasSubstr("holder of T3 hits vise_jaw 1.4 mm deep at X0.000 Y0.000 Z171."));
}

// Closed form of the clearance in the clearances table, and of its two numbers.
TEST(CheckerTest, LeastClearance) {
  for (double clearance : {0.0, 2.0}) {
    Rig rig;
    rig.check().clearance = clearance;
    rig.AddBox("post", BodyKind::kFixture, {8.6, -3, 0}, {20, 3, 60});
    rig.Start(-40, -80, 10);
    rig.Rapid(0, -80, 10);
    rig.Rapid(0, 80, 10);
    rig.Rapid(-40, 80, 10);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.clearances, SizeIs(3));
    const PairClearance& flutes = result.clearances[0];
    EXPECT_THAT(flutes.bodies, ElementsAre("T3.flutes", "post"));
    const double truth = 3.6;
    EXPECT_LE(flutes.proven_mm, truth);
    EXPECT_GE(flutes.seen_mm, truth - 1e-6);
    EXPECT_LE(flutes.seen_mm - flutes.proven_mm, clearance > 0 ? 0.025 : 0.25 * flutes.seen_mm);
    EXPECT_EQ(flutes.where.line, 2);
    EXPECT_THAT(result.findings, IsEmpty()) << Words(result);
  }
}

TEST(CheckerTest, NearMissIsOneFindingARun) {
  Rig rig;
  rig.check().clearance = 4.0;
  rig.AddBox("post", BodyKind::kFixture, {8.6, -3, 0}, {20, 3, 60});
  rig.Start(0, -80, 10);
  for (double y : {-40.0, -2.0, 0.0, 2.0, 40.0, 80.0}) rig.Feed(0, y, 10);
  const CollisionResult result = rig.Run();
  const std::vector<Finding> near = Of(result, Rule::kNearMiss);
  ASSERT_THAT(near, SizeIs(2)) << Words(result);  // flutes, shank
  EXPECT_EQ(result.findings.size(), 2u);
  EXPECT_EQ(near[0].severity, Severity::kWarning);
  EXPECT_NEAR(*near[0].clearance_mm, 3.6, 0.02);
  EXPECT_THAT(near[0].message, HasSubstr("flutes of T3 come within 3.6"));
  rig.check().clearance = 3.57;
  EXPECT_THAT(rig.Run().findings, IsEmpty());
  rig.check().clearance = 0.0;
  EXPECT_THAT(rig.Run().findings, IsEmpty());
}

// Nearest at the start of a motion, where nothing was known before: of the program, or of a window.
TEST(CheckerTest, NearMissWhereAMotionBegins) {
  for (const std::size_t window : {std::size_t{1}, std::size_t{2}, motion::kWindowSize}) {
    Rig rig;
    rig.check().clearance = 2.0;
    rig.AddBox("wall", BodyKind::kFixture, {-50, -50, -50}, {50, 50, 0});
    rig.Start(0, 0, 1);
    rig.Rapid(0, 0, 80);
    const std::vector<Finding> near = Of(rig.Run(window), Rule::kNearMiss);
    ASSERT_THAT(near, SizeIs(1)) << window;
    EXPECT_NEAR(*near[0].clearance_mm, 1.0, 0.02);
  }
}

// An axis value that is no number proves nothing.
TEST(CheckerTest, WhatIsNoNumberIsNotClear) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double z : {std::nan(""), kInfinity, -kInfinity}) {
    Rig rig;
    rig.AddBox("wall", BodyKind::kFixture, {-50, -50, -50}, {50, 50, 0});
    rig.Start(0, 0, 10);
    rig.Rapid(0, 0, 12);
    rig.Rapid(0, 0, z);
    EXPECT_FALSE(rig.Run().findings.empty()) << z;
  }
}

// The pin (flutes and shank) passes two posts, `gap` from each.
CollisionResult BetweenPosts(double gap, double general, std::vector<machine::PairMargin> margins) {
  Rig rig;
  rig.check().clearance = general;
  rig.check().margins = std::move(margins);
  rig.AddBox("left", BodyKind::kFixture, {-3, -20, 0}, {3, -5 - gap, 60});
  rig.AddBox("right", BodyKind::kFixture, {-3, 5 + gap, 0}, {3, 20, 60});
  rig.Start(-100, 0, 10);
  rig.Rapid(100, 0, 10);
  return rig.Run();
}

machine::PairMargin MarginOf(std::string a, std::string b, double clearance) {
  return {{{{std::move(a)}, {std::move(b)}}}, clearance};
}

TEST(CheckerTest, AMarginIsThatOfItsPairAlone) {
  const auto margin = MarginOf("T3.flutes", "left", 3.0);
  EXPECT_THAT(BetweenPosts(3.05, 0.0, {margin}).findings, IsEmpty());
  const CollisionResult near = BetweenPosts(2.95, 0.0, {margin});
  ASSERT_THAT(near.findings, SizeIs(1)) << Words(near);
  EXPECT_EQ(near.findings[0].rule, Rule::kNearMiss);
  EXPECT_THAT(near.findings[0].bodies, ElementsAre("T3.flutes", "left"));
  EXPECT_THAT(near.findings[0].message, HasSubstr("(clearance 3 mm)"));
  EXPECT_NEAR(*near.findings[0].clearance_mm, 2.95, 0.02);
}

// Four pairs are near in general; a margin takes its own out, or lets it alone be nearer.
TEST(CheckerTest, AMarginMayBeLessThanTheGeneralClearance) {
  const auto near = [](double gap, double margin) {
    return Of(BetweenPosts(gap, 5.0, {MarginOf("left", "shank", margin)}), Rule::kNearMiss).size();
  };
  EXPECT_EQ(near(2.95, 3.0), 4u);
  EXPECT_EQ(near(3.05, 3.0), 3u);
  EXPECT_EQ(near(0.05, 0.0), 3u);
}

TEST(CheckerTest, AMarginOfTwoLinksComesFromTheModel) {
  for (const auto& [gauge_line, findings] : {std::pair(2.95, 1u), {3.05, 0u}}) {
    Rig rig;
    rig.facts().tool = 0;
    rig.AddBody("head", BodyKind::kMachine, BoxMesh({-50, -50, -100}, {50, 50, 0}),
                rig.machine().spindle_link);
    rig.AddBox("platter", BodyKind::kMachine, {-100, -100, -40}, {100, 100, 0});
    rig.AddBox("vise", BodyKind::kFixture, {-100, -100, -40}, {100, 100, 0});
    const auto [low, high] = std::minmax(rig.machine().table_link, rig.machine().spindle_link);
    rig.machine().margins.push_back({low, high, 3.0, 0});
    rig.Start(0, 0, 300);
    rig.Rapid(0, 0, gauge_line - Rig::kToolLength);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(findings)) << Words(result);
    if (findings == 0) continue;
    EXPECT_EQ(result.findings[0].rule, Rule::kNearMiss);
    EXPECT_THAT(result.findings[0].bodies, ElementsAre("head", "platter"));
  }
}

TEST(CheckerTest, ContainedFromTheStart) {
  for (bool inside : {true, false}) {
    Rig rig;
    const double x = inside ? 0.0 : 500.0;
    rig.AddBox("block", BodyKind::kFixture, {-200, -200, -200}, {200, 200, 400});
    rig.Start(x, 0, 10);
    rig.Rapid(x + 3, 0, 10);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(Of(result, Rule::kCollision), SizeIs(inside ? 3 : 0)) << Words(result);
    if (inside) {
      EXPECT_NEAR(*result.findings[0].clearance_mm, -5.0, 0.01);
    }
  }
}

// Two small machine bodies, one in the other: surfaces never meet, and FCL's meshes are hollow.
TEST(CheckerTest, ContainedMeshInMesh) {
  for (bool inside : {true, false}) {
    Rig rig;
    rig.facts().tool = 0;
    rig.AddBody("nose", BodyKind::kMachine, BoxMesh({-5, -5, -5}, {5, 5, 5}),
                rig.machine().spindle_link);
    rig.AddBox("tank", BodyKind::kMachine, {-200, -200, -200}, {200, 200, 400});
    rig.Start(inside ? 0.0 : 400.0, 0, 10);
    rig.Rapid(inside ? 1.0 : 401.0, 0, 10);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(Of(result, Rule::kCollision), SizeIs(inside ? 1 : 0)) << Words(result);
    if (inside) {
      EXPECT_FALSE(result.findings[0].clearance_mm.has_value());
    }
  }
}

TEST(CheckerTest, MachineLinksAndDisabledPairs) {
  for (bool disabled : {false, true}) {
    Rig rig;
    rig.facts().tool = 0;
    rig.AddBody("head", BodyKind::kMachine, BoxMesh({-50, -50, -100}, {50, 50, 0}),
                rig.machine().spindle_link);
    rig.AddBox("platter", BodyKind::kMachine, {-100, -100, -40}, {100, 100, 0});
    if (disabled) {
      rig.machine().disabled_pairs.push_back(
          {rig.machine().table_link, rig.machine().spindle_link, "User"});
    }
    rig.Start(0, 0, 300);
    rig.Rapid(0, 0, -160);  // gauge line at -10: the head, above it, is 10 into the platter
    rig.Rapid(0, 0, 300);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(disabled ? 0 : 1)) << Words(result);
    if (disabled) continue;
    EXPECT_THAT(result.findings[0].bodies, ElementsAre("head", "platter"));
    EXPECT_FALSE(result.findings[0].clearance_mm.has_value());
    EXPECT_THAT(result.findings[0].message, HasSubstr("head hits platter at X0.000"));
    EXPECT_THAT(result.clearances, IsEmpty());
  }
}

TEST(CheckerTest, DogLegHitsWhereTheLineDoesNot) {
  // From (0, 0) to (200, 60): X and Y both run until Y is there, at (60, 60); then X alone.
  const auto run = [](bool dog_leg, double y_top) {
    Rig rig;
    rig.AddBox("post", BodyKind::kFixture, {90, 52, 0}, {110, y_top, 40});
    rig.Start(0, 0, 10);
    if (dog_leg) {
      rig.DogLeg(200, 60, 10, 0.0);
    } else {
      rig.Rapid(200, 60, 10);
    }
    return rig.Run();
  };
  EXPECT_THAT(Of(run(true, 56), Rule::kCollision), SizeIs(2));
  EXPECT_THAT(run(false, 56).findings, IsEmpty());
  EXPECT_THAT(run(true, 54.95).findings, IsEmpty());  // 0.05 below the flutes at y = 60
}

TEST(CheckerTest, ContactThatOnlyAccelerationMakes) {
  // From (0, 0) to (300, 60) with ramps, Y brakes while X still runs: the corner is cut inside, by
  // the stated acceleration.
  const auto run = [](double ramp) {
    Rig rig;
    rig.AddBox("post", BodyKind::kFixture, {60, 47, 0}, {64, 49.5, 40});
    rig.Start(0, 0, 10);
    rig.DogLeg(300, 60, 10, ramp);
    return rig.Run();
  };
  EXPECT_THAT(run(0.0).findings, IsEmpty()) << Words(run(0.0));
  const CollisionResult result = run(0.3);
  const std::vector<Finding> hits = Of(result, Rule::kCollision);
  ASSERT_THAT(hits, SizeIs(2)) << Words(result);
  EXPECT_THAT(hits[0].message, HasSubstr("with the machine's acceleration"));
}

// The table turns C by 90 degrees; a post 400 mm from the centre passes the tool.
TEST(CheckerTest, LongRotationAboutAFarCentre) {
  for (double gap : {0.03, -0.03}) {
    Rig rig;
    // The post's outermost corners pass at hypot(400, 5).
    const double reach = std::hypot(400.0, 5.0);
    rig.AddBox("post", BodyKind::kFixture, {390, -5, 0}, {400, 5, 40});
    rig.Start(0, reach + 5 + gap, 10, 0, 0);
    rig.Rapid(0, reach + 5 + gap, 10, 0, -180);
    rig.Rapid(0, reach + 5 + gap, 10, 0, 180);
    const CollisionResult result = rig.Run();
    EXPECT_THAT(Of(result, Rule::kCollision), SizeIs(gap < 0 ? 2 : 0)) << Words(result);
  }
}

TEST(CheckerTest, JumpsAndToolChangesForgetBudgets) {
  Rig rig;
  rig.AddBox("block", BodyKind::kFixture, {-10, -10, 0}, {10, 10, 40});
  rig.AddTool(7, CylinderProfile(0, 30, 5), {}, CylinderProfile(30, 150, 50));
  rig.Start(100, 0, 10);
  rig.Rapid(40, 0, 10);
  rig.facts().tool = 7;  // its holder reaches x = -10
  rig.Rapid(41, 0, 10);
  rig.facts().tool = 3;
  rig.Rapid(40, 0, 10);
  rig.Start(0, 0, 10);  // a jump
  rig.Rapid(0, 0, 9);
  const CollisionResult result = rig.Run();
  const std::vector<Finding> hits = Of(result, Rule::kCollision);
  ASSERT_THAT(hits, SizeIs(3)) << Words(result);
  EXPECT_THAT(hits[0].bodies, ElementsAre("T7.holder", "block"));
  EXPECT_EQ(hits[0].where.line, 2);
  EXPECT_EQ(hits[1].where.line, 4);
}

TEST(CheckerTest, OneFindingForARunOfBlocks) {
  Rig rig;
  rig.AddBox("block", BodyKind::kFixture, {-10, -40, 0}, {10, 40, 40});
  rig.Start(-50, 0, 36);
  for (double x : {-30.0, -14.0, 0.0, 14.0, 30.0, 50.0, 12.0}) rig.Feed(x, 0, 36);
  const CollisionResult result = rig.Run();
  const std::vector<Finding> hits = Of(result, Rule::kCollision);
  ASSERT_THAT(hits, SizeIs(2)) << Words(result);
  EXPECT_EQ(hits[0].where.line, 2);
  EXPECT_NEAR(*hits[0].clearance_mm, -4.0, 0.01);  // from below: 4 deep
  EXPECT_THAT(hits[0].message, HasSubstr("(4 blocks, the last is line 5)"));
  EXPECT_EQ(hits[1].where.line, 7);
}

TEST(CheckerTest, BodiesThatCannotBeTrusted) {
  Rig rig;
  rig.AddBox("good", BodyKind::kFixture, {300, 0, 0}, {310, 10, 10});
  rig.AddBox("broken", BodyKind::kFixture, {400, 0, 0}, {410, 10, 10}).defect =
      "broken.stl is truncated";
  rig.AddBox("open", BodyKind::kFixture, {500, 0, 0}, {510, 10, 10}).mesh.watertight = false;
  rig.Start(0, 0, 10);
  for (int i = 1; i < 5; ++i) rig.Feed(i, 0, 10);
  const CollisionResult result = rig.Run();
  ASSERT_THAT(Of(result, Rule::kUncertified), SizeIs(2)) << Words(result);  // a body each, once
  EXPECT_EQ(result.findings.size(), 2u);
  EXPECT_EQ(result.findings[0].message,
            "nothing was checked against broken: broken.stl is truncated");
  EXPECT_THAT(result.findings[0].bodies, ElementsAre("broken"));
  EXPECT_EQ(result.findings[0].where.line, 1);
  EXPECT_THAT(result.clearances, SizeIs(3));
}

// A body of the base, with the table turned away: where the tool is over the table says nothing.
TEST(CheckerTest, ToolAgainstTheBaseWithTheTableTurned) {
  for (const double reach : {-0.05, 0.05}) {
    Rig rig;
    rig.AddBody("column", BodyKind::kMachine, BoxMesh({200, -50, 0}, {260, 50, 300}), 0);
    rig.Start(0, 0, 10, 0, 90);
    for (int i = 1; i <= 100; ++i) rig.Feed(0.3 * i, 0.1 * (i % 7), 10, 0, 90);
    rig.Feed(195 + reach, 0, 10, 0, 90);
    for (int i = 1; i <= 100; ++i) rig.Feed(30 + 0.1 * i, 0, 10, 0, 90);
    const std::vector<Finding> hits = Of(rig.Run(), Rule::kCollision);
    // The holder, of radius 20, is there long before the flutes.
    ASSERT_THAT(hits, Not(IsEmpty()));
    EXPECT_EQ(hits[0].where.line, 101);
    EXPECT_THAT(hits, SizeIs(reach > 0.0 ? 3 : 1));
  }
}

TEST(CheckerTest, AToolWithoutShapeIsSaid) {
  Rig rig;
  rig.facts().tool = 9;
  rig.Feed(0, 0, 10);
  rig.Feed(1, 0, 10);
  const CollisionResult result = rig.Run();
  ASSERT_THAT(result.findings, SizeIs(1));
  EXPECT_EQ(result.findings[0].rule, Rule::kUncertified);
}

TEST(CheckerTest, CornerRoundingWidens) {
  for (double rounding : {0.0, 1.0, 1.3}) {
    Rig rig;
    rig.AddBox("jaw", BodyKind::kFixture, {-50, 6.2, 0}, {50, 20, 40});
    rig.Start(-100, 0, 10);
    rig.facts().corner_rounding = rounding;
    rig.Feed(100, 0, 10);  // 1.2 beside it
    const CollisionResult result = rig.Run();
    if (rounding < 1.2) {
      EXPECT_THAT(result.findings, IsEmpty()) << Words(result);
      continue;
    }
    ASSERT_THAT(Of(result, Rule::kUncertified), SizeIs(2)) << Words(result);
    EXPECT_THAT(result.findings[0].message, HasSubstr("may round the corner by 1.3 mm"));
  }
}

// A flat jaw beside the holder (radius 20, 90 to 150 above the tip), which a tool axis off by a
// degree takes up to hypot(150, 20) tan(1 deg) nearer: 2.64 mm.
TEST(CheckerTest, OrientationToleranceWidensByTheDistanceFromTheTip) {
  const double widened = 0.1 + std::hypot(150.0, 20.0) * std::tan(Radians(1.0));
  for (const double spare : {-0.05, 0.05}) {
    for (const bool after_a_rapid : {false, true}) {
      Rig rig;
      const double y = 20.0 + widened + spare;
      rig.AddBox("jaw", BodyKind::kFixture, {-50, y, 100}, {50, y + 20, 130});
      rig.Start(-100, 0, 10);
      if (after_a_rapid) rig.Rapid(-90, 0, 10);  // exact
      rig.facts().corner_rounding = 0.1;
      rig.facts().orientation_tolerance = Radians(1.0);
      rig.Tcp({-90, 0, 10}, {90, 0, 10}, 0, 0, 0, 0);
      const CollisionResult result = rig.Run();
      EXPECT_EQ(result.orientation_tolerance, Radians(1.0));
      const auto jaw =
          std::find_if(result.clearances.begin(), result.clearances.end(),
                       [](const PairClearance& c) { return c.bodies.front() == "T3.holder"; });
      ASSERT_NE(jaw, result.clearances.end());
      EXPECT_NEAR(jaw->widened_mm, widened, 1e-9);
      if (spare > 0.0) {
        EXPECT_THAT(result.findings, IsEmpty()) << Words(result);
        continue;
      }
      ASSERT_THAT(result.findings, SizeIs(1)) << Words(result);
      EXPECT_EQ(result.findings[0].rule, Rule::kUncertified);
      EXPECT_THAT(result.findings[0].message,
                  HasSubstr("smoothing, which may turn the tool by 1 deg, may take it 2.741 mm "
                            "off its way"));
    }
  }
}

// Near misses may be wanted of nothing (clearance 0): what is crossed at a time is held against
// the rounding of all of it, not of its first motion.
TEST(CheckerTest, RoundingOfMotionsThatAreCrossedAtATime) {
  Rig rig;
  rig.AddBox("jaw", BodyKind::kFixture, {-50, 6.2, 0}, {50, 20, 40});
  rig.Start(-300, 0, 10);
  for (int i = 0; i < 50; ++i) rig.Rapid(-250 + i, 0, 10);
  rig.facts().corner_rounding = 1.3;
  for (int i = 0; i < 200; ++i) rig.Feed(-200 + i, 0, 10);  // 1.2 beside it
  const CollisionResult result = rig.Run();
  EXPECT_THAT(Of(result, Rule::kUncertified), SizeIs(2)) << Words(result);
}

TEST(CheckerTest, TcpMotionIsTracked) {
  // The tip stays on one point while B turns from -20 to 20: the holder, from 90 above the tip,
  // swings past a post that stands on the table.
  for (double gap : {0.05, -0.05}) {
    Rig rig;
    // At B = 20 the tool leans toward +X by sin 20 in the part: the holder's lower rim on that
    // side.
    const double b = Radians(20.0);
    const double rim_x = 90 * std::sin(b) + 20 * std::cos(b);
    const double rim_z = 90 * std::cos(b) - 20 * std::sin(b);
    rig.AddBox("post", BodyKind::kFixture, {rim_x - 4, -40, 10}, {rim_x + 60, 40, rim_z - 3});
    // Below the rim by 3 at the end of the turn, but the rim is lower at no other time: shift so
    // that the gap is at the end.
    const double reach = std::hypot(90.0, 20.0);
    const double at_end = std::atan2(rim_z, rim_x);
    rig.AddBox("bar", BodyKind::kFixture, {rim_x - 1, -1, rim_z - 2}, {rim_x + 1, 1, rim_z - gap});
    rig.Tcp({0, 0, 0}, {0, 0, 0}, -20, 0, 20, 0);
    const CollisionResult result = rig.Run();
    EXPECT_NEAR(reach * std::sin(at_end), rim_z, 1e-9);
    const std::vector<Finding> hits = Of(result, Rule::kCollision);
    EXPECT_THAT(hits, SizeIs(gap < 0 ? 1 : 0)) << Words(result);
  }
}

}  // namespace
}  // namespace ncsim::collision
