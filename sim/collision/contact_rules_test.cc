// SPDX-License-Identifier: BSD-3-Clause
// Each rule with a planted fault and an honest twin beside it. Tool T3: flutes of radius 5 up to 30
// above the tip, shank of radius 5 up to 90, holder of radius 20. The part is a block with its top
// at z = 0, tolerance 0.1 in rapids and 0.25 in feeds.
#include "sim/collision/contact_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/collision/test_rig.h"

namespace ncsim::collision {
namespace {

using machine::BodyKind;
using motion::MotionKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Rig PartRig() {
  Rig rig;
  rig.AddBox("part", BodyKind::kPart, {-100, -100, -80}, {100, 100, 0});
  rig.Start(0, 0, 50);
  return rig;
}

TEST(RapidContactTest, RapidOntoThePart) {
  for (double depth : {0.08, 0.12}) {
    Rig rig = PartRig();
    rig.Rapid(0, 0, -depth);
    const CollisionResult result = rig.Run();
    if (depth < 0.1) {
      EXPECT_THAT(result.findings, IsEmpty()) << Words(result);
      continue;
    }
    ASSERT_THAT(result.findings, SizeIs(1)) << Words(result);
    EXPECT_EQ(result.findings[0].rule, Rule::kRapidContact);
    EXPECT_NEAR(*result.findings[0].clearance_mm, -0.12, 0.01);
    EXPECT_THAT(result.findings[0].message,
                HasSubstr("rapid takes flutes of T3 0.12 mm into part (tolerance 0.1 mm) at X0"));
  }
}

// The end of a feed 0.2 deep: a rapid may start there, but not go 0.1 deeper.
TEST(RapidContactTest, RapidFromTheEndOfAFeed) {
  for (double to : {-0.28, -0.32}) {
    Rig rig = PartRig();
    rig.Feed(0, 0, -0.2);
    rig.Feed(30, 0, -0.2);
    rig.Rapid(60, 0, to);
    rig.Rapid(60, 0, 50);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(to > -0.3 ? 0 : 1)) << Words(result);
    if (to < -0.3) {
      EXPECT_EQ(result.findings[0].rule, Rule::kRapidContact);
    }
  }
}

// How deep a plunge went is known though its whole way is within what a feed may.
TEST(RapidContactTest, BackToWhereThePlungeWas) {
  for (double to : {-0.27, -0.33}) {
    Rig rig = PartRig();
    for (int i = 0; i < 2; ++i) {
      rig.Rapid(0, 0, 10);
      rig.Feed(0, 0, -0.2);
    }
    rig.Feed(0, 0, -0.02);
    rig.Rapid(0, 0, to);
    const CollisionResult result = rig.Run();
    EXPECT_THAT(result.findings, SizeIs(to > -0.3 ? 0 : 1)) << Words(result);
  }
}

// Feeds that are less deep than the deepest of the program: what a rapid may keep is worked out
// when it matters, and does not depend on where the windows are cut.
TEST(RapidContactTest, BackToWhereAShallowerFeedWas) {
  for (const std::size_t window : {std::size_t{1}, motion::kWindowSize}) {
    for (const bool in_two : {false, true}) {
      Rig rig = PartRig();
      rig.Feed(0, 0, -0.24);
      rig.Rapid(0, 0, 0.02);
      if (in_two) rig.Feed(0, 0, -0.1);
      rig.Feed(0, 0, -0.2);
      rig.Feed(0, 0, -0.05);
      rig.Rapid(0, 0, -0.25);
      const CollisionResult result = rig.Run(window);
      EXPECT_THAT(result.findings, IsEmpty()) << window << " " << in_two << Words(result);
    }
  }
}

// A rapid back into a deep hole may take the whole tool into the part; what feeds do there is a
// gouge still.
TEST(GougeTest, FeedsOfAToolThatIsWhollyInside) {
  for (const std::size_t window : {std::size_t{1}, motion::kWindowSize}) {
    Rig rig;
    rig.AddBox("part", BodyKind::kPart, {-60, -30, -200}, {0, 30, 0});
    rig.AddTool(7, CylinderProfile(0, 30, 5), {}, {});
    rig.facts().tool = 7;
    rig.Start(-30, 0, 10);
    rig.facts().cycle = 1;
    rig.Feed(-30, 0, -60);
    rig.Rapid(-30, 0, 10);
    rig.Rapid(-30, 0, -59);
    rig.Feed(-30, 0, -70);
    rig.Feed(-30, 10, -70);
    const std::vector<Finding> gouges = Of(rig.Run(window), Rule::kGouge);
    ASSERT_THAT(gouges, SizeIs(2)) << window;
    EXPECT_EQ(gouges[1].where.line, 4);
  }
}

// Once out, the depth of the feed is no excuse.
TEST(RapidContactTest, ReferenceEndsWhenTheToolLeavesThePart) {
  Rig rig = PartRig();
  rig.Feed(0, 0, -0.2);
  rig.Rapid(0, 0, 10);
  rig.Rapid(40, 0, 10);
  rig.Rapid(40, 0, -0.2);
  const CollisionResult result = rig.Run();
  ASSERT_THAT(Of(result, Rule::kRapidContact), SizeIs(1)) << Words(result);
  EXPECT_EQ(result.findings[0].where.line, 4);
}

// A hole that the part's mesh does not have. Feeds of the cycle make it (no gouge asked for); its
// rapids come and go in it.
TEST(RapidContactTest, CycleRetractsAndEntersAgain) {
  for (int fault = 0; fault < 2; ++fault) {
    Rig rig = PartRig();
    rig.check().gouge = machine::GougeMode::kOff;
    rig.Rapid(0, 0, 2);
    rig.facts().cycle = 4;
    rig.Feed(0, 0, -3);
    rig.Rapid(0, 0, 2);
    rig.Rapid(0, 0, fault == 0 ? -2.9 : -3.2);
    rig.Feed(0, 0, -4);
    rig.Rapid(0, 0, 2);
    rig.facts().cycle = 5;
    if (fault == 1) rig.Rapid(30, 0, 2);
    const CollisionResult result = rig.Run();
    EXPECT_THAT(Of(result, Rule::kRapidContact), SizeIs(fault)) << Words(result);
    EXPECT_EQ(result.findings.size(), static_cast<std::size_t>(fault));
  }
  // Another hole has its own depth.
  Rig rig = PartRig();
  rig.check().gouge = machine::GougeMode::kOff;
  rig.facts().cycle = 4;
  rig.Feed(0, 0, -3);
  rig.Rapid(0, 0, 2);
  rig.facts().cycle = 5;
  rig.Rapid(30, 0, 2);
  rig.Rapid(30, 0, -1);
  EXPECT_THAT(Of(rig.Run(), Rule::kRapidContact), SizeIs(1));
}

// A slot that the part's mesh does not have, with no gouge asked for: a rapid may leave it the way
// that the feeds made, and no deeper.
TEST(RapidContactTest, LeavesAsDeepAsTheFeedsWent) {
  for (const double depth : {-2.95, -3.2}) {
    Rig rig = PartRig();
    rig.check().gouge = machine::GougeMode::kOff;
    rig.Feed(0, 0, -1);
    rig.Feed(10, 0, -3);
    rig.Feed(20, 0, -1);
    rig.Rapid(10, 0, depth);
    rig.Rapid(0, 0, -1);
    rig.Rapid(0, 0, 10);
    const CollisionResult result = rig.Run();
    EXPECT_THAT(result.findings, SizeIs(depth > -3.1 ? 0 : 1)) << Words(result);
  }
}

TEST(GougeTest, DepthAgainstTolerance) {
  for (double depth : {0.23, 0.27}) {
    Rig rig = PartRig();
    rig.Feed(0, 0, -0.05);
    rig.Feed(20, 0, -depth);
    rig.Feed(40, 0, -0.05);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(depth < 0.25 ? 0 : 1)) << Words(result);
    ASSERT_THAT(result.cuts, SizeIs(1));
    EXPECT_EQ(result.cuts[0].tool, 3);
    EXPECT_NEAR(result.cuts[0].depth_mm, depth, 0.025);
    if (depth < 0.25) continue;
    EXPECT_EQ(result.findings[0].rule, Rule::kGouge);
    EXPECT_EQ(result.findings[0].severity, Severity::kError);
    EXPECT_NEAR(*result.findings[0].clearance_mm, -0.27, 0.01);
    EXPECT_THAT(result.findings[0].message, HasSubstr("flutes of T3 cut 0.27 mm into part"));
  }
}

TEST(GougeTest, Modes) {
  for (machine::GougeMode mode :
       {machine::GougeMode::kError, machine::GougeMode::kWarning, machine::GougeMode::kOff}) {
    Rig rig = PartRig();
    rig.check().gouge = mode;
    rig.Feed(0, 0, -2);
    rig.Feed(40, 0, -2);
    const CollisionResult result = rig.Run();
    const bool off = mode == machine::GougeMode::kOff;
    ASSERT_THAT(result.findings, SizeIs(off ? 0 : 1));
    ASSERT_THAT(result.cuts, SizeIs(off ? 0 : 1));
    if (off) continue;
    EXPECT_NEAR(result.cuts[0].depth_mm, 2.0, 0.025);
    if (mode == machine::GougeMode::kWarning) {
      EXPECT_EQ(result.findings[0].severity, Severity::kWarning);
    }
  }
}

// A cutter thinner than twice the tolerance cannot be "0.25 deep": half its radius counts.
TEST(GougeTest, TinyToolsAreNotExempt) {
  for (double depth : {0.06, 0.2}) {
    Rig rig = PartRig();
    rig.AddTool(8, CylinderProfile(0, 20, 0.15), {}, CylinderProfile(40, 150, 10));
    rig.facts().tool = 8;
    rig.Feed(0, 0, -depth);
    EXPECT_THAT(Of(rig.Run(), Rule::kGouge), SizeIs(depth > 0.1 ? 1 : 0));
  }
}

TEST(ThinShankTest, CountsAsFlutesWithinTheTolerance) {
  // A wall beside the shank only: from z = 35 above the tip on.
  for (double into : {0.2, 0.3}) {
    Rig rig;
    rig.AddBox("part", BodyKind::kPart, {5 - into, -30, 40}, {40, 30, 60});
    rig.Start(0, 0, 0);
    rig.Feed(0, 1, 0);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(into < 0.25 ? 0 : 1)) << Words(result);
    if (into > 0.25) {
      EXPECT_EQ(result.findings[0].rule, Rule::kCollision);
      EXPECT_THAT(result.findings[0].bodies, ElementsAre("T3.shank", "part"));
    }
  }
}

TEST(ThinShankTest, AWiderShankMustNotTouch) {
  for (double gap : {0.05, -0.05}) {
    Rig rig;
    rig.AddTool(4, CylinderProfile(0, 30, 5), CylinderProfile(30, 90, 5.5),
                CylinderProfile(90, 150, 20));
    rig.facts().tool = 4;
    rig.AddBox("part", BodyKind::kPart, {5.5 + gap, -30, 40}, {40, 30, 60});
    rig.Start(0, 0, 0);
    rig.Feed(0, 1, 0);
    EXPECT_THAT(Of(rig.Run(), Rule::kCollision), SizeIs(gap < 0 ? 1 : 0));
  }
}

TEST(FixtureTest, FlutesMustNotTouchAFixture) {
  for (double z : {0.03, -0.03}) {
    Rig rig;
    rig.AddBox("clamp", BodyKind::kFixture, {-20, -20, -30}, {20, 20, 0});
    rig.Start(0, 0, 20);
    rig.Feed(0, 0, z);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(z < 0 ? 1 : 0));
    if (z < 0) {
      EXPECT_EQ(result.findings[0].rule, Rule::kCollision);
    }
  }
}

Rig BlankRig() {
  Rig rig;
  rig.AddBox("stock", BodyKind::kStock, {-50, -50, -80}, {50, 50, 0});
  rig.Start(-100, 0, 50);
  return rig;
}

TEST(StockContactTest, RapidIntoTheUncutBlank) {
  for (double z : {0.03, -0.03}) {
    Rig rig = BlankRig();
    rig.Rapid(-100, 0, z);
    rig.Rapid(100, 0, z);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(z < 0 ? 1 : 0)) << Words(result);
    if (z > 0) continue;
    EXPECT_EQ(result.findings[0].rule, Rule::kStockContact);
    EXPECT_EQ(result.findings[0].severity, Severity::kError);
    EXPECT_EQ(result.findings[0].where.line, 2);
    EXPECT_THAT(result.findings[0].message, HasSubstr("flutes of T3 hit the uncut blank stock"));
  }
}

TEST(StockContactTest, TheFirstFeedMakesTheBlankInexact) {
  Rig rig = BlankRig();
  rig.Rapid(-60, 0, -5);
  rig.Feed(60, 0, -5);  // the first cut
  rig.Rapid(60, 0, 10);
  rig.Rapid(0, 0, 10);
  rig.Rapid(0, 0, -5);  // into what was cut: not known
  EXPECT_THAT(rig.Run().findings, IsEmpty()) << Words(rig.Run());
}

TEST(StockContactTest, HolderBeforeAndAfterTheFirstCut) {
  // Before: a rapid takes the holder (from z = 90 above the tip) into the blank's side.
  Rig before = BlankRig();
  before.Rapid(-60, 0, -100);
  const CollisionResult hit = before.Run();
  ASSERT_THAT(Of(hit, Rule::kStockContact), SizeIs(1)) << Words(hit);
  EXPECT_EQ(hit.findings[0].severity, Severity::kError);
  EXPECT_THAT(hit.findings[0].bodies, ElementsAre("T3.holder", "stock"));
  // After: a warning, once a tool.
  Rig after = BlankRig();
  after.Rapid(-60, 0, -5);
  after.Feed(-50, 0, -5);
  after.Rapid(-60, 0, -5);
  for (int i = 0; i < 2; ++i) {
    after.Rapid(-60, 0, -100);
    after.Rapid(-60, 0, 20);
  }
  const CollisionResult warned = after.Run();
  ASSERT_THAT(warned.findings, SizeIs(1)) << Words(warned);
  EXPECT_EQ(warned.findings[0].rule, Rule::kStockContact);
  EXPECT_EQ(warned.findings[0].severity, Severity::kWarning);
}

// On the block of the first cut itself, what touches the blank after the flutes is no error.
TEST(StockContactTest, ShankFollowsTheFlutesOnTheFirstCut) {
  Rig rig = BlankRig();
  rig.Rapid(0, 0, 5);
  rig.Feed(0, 0, -70);  // flutes, then 40 mm of shank
  EXPECT_THAT(rig.Run().findings, IsEmpty()) << Words(rig.Run());
  // But a shank wider than the cutter is a warning, and one that is there before the flutes an
  // error.
  Rig wide = BlankRig();
  wide.AddTool(4, CylinderProfile(0, 30, 5), CylinderProfile(30, 90, 8),
               CylinderProfile(90, 150, 20));
  wide.facts().tool = 4;
  wide.Rapid(0, 0, 5);
  wide.Feed(0, 0, -70);
  const CollisionResult result = wide.Run();
  ASSERT_THAT(result.findings, SizeIs(1)) << Words(result);
  EXPECT_EQ(result.findings[0].severity, Severity::kWarning);
  Rig side = BlankRig();
  side.AddTool(4, CylinderProfile(0, 30, 5), CylinderProfile(30, 90, 8),
               CylinderProfile(90, 150, 20));
  side.facts().tool = 4;
  side.Rapid(-100, 0, -40);
  side.Feed(-51, 0, -40);  // the shank reaches 3 further than the flutes
  const CollisionResult error = side.Run();
  ASSERT_THAT(error.findings, SizeIs(1)) << Words(error);
  EXPECT_EQ(error.findings[0].severity, Severity::kError);
  EXPECT_THAT(error.findings[0].bodies, ElementsAre("T4.shank", "stock"));
}

TEST(SpindleStoppedTest, FeedWithTheSpindleStopped) {
  for (double z : {0.05, -0.05}) {
    Rig rig = BlankRig();
    rig.facts().spindle_on = false;
    rig.Rapid(-60, 0, z);
    rig.Feed(-40, 0, z);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(z < 0 ? 1 : 0)) << Words(result);
    if (z < 0) {
      EXPECT_EQ(result.findings[0].rule, Rule::kSpindleStopped);
      EXPECT_EQ(result.findings[0].severity, Severity::kError);
    }
  }
  for (bool on : {true, false}) {
    Rig rig = PartRig();
    rig.facts().spindle_on = on;
    rig.Feed(0, 0, -0.05);
    EXPECT_THAT(Of(rig.Run(), Rule::kSpindleStopped), SizeIs(on ? 0 : 1));
  }
}

// Between feeds that turn, on which with no gouge asked for there is nothing else to look at.
TEST(SpindleStoppedTest, OneFeedAmongMany) {
  for (machine::GougeMode mode : {machine::GougeMode::kError, machine::GougeMode::kOff}) {
    for (bool on : {true, false}) {
      Rig rig = PartRig();
      rig.check().gouge = mode;
      rig.Feed(-20, 0, -0.05);
      rig.Feed(-10, 0, -0.05);
      rig.facts().spindle_on = on;
      rig.Feed(0, 0, -0.05);
      const int line = rig.motions().back().where.line;
      rig.facts().spindle_on = true;
      rig.Feed(10, 0, -0.05);
      const std::vector<Finding> stopped = Of(rig.Run(), Rule::kSpindleStopped);
      ASSERT_THAT(stopped, SizeIs(on ? 0 : 1));
      if (!on) {
        EXPECT_EQ(stopped[0].where.line, line);
      }
    }
  }
}

TEST(RapidReferenceTest, KeepsWhatTheFeedsReached) {
  RapidReference reference;
  EXPECT_DOUBLE_EQ(reference.OnRapid(0, 0.0), 0.0);
  reference.OnFeed(0.3);
  reference.OnFeed(0.1);
  EXPECT_DOUBLE_EQ(reference.OnRapid(0, 0.1), 0.3);
  EXPECT_DOUBLE_EQ(reference.OnRapid(0, 0.2), 0.3);  // still in contact
  EXPECT_DOUBLE_EQ(reference.OnRapid(0, 0.0), 0.0);  // out
  EXPECT_DOUBLE_EQ(reference.OnRapid(0, 0.2), 0.0);
  reference.OnFeed(2.0);
  EXPECT_DOUBLE_EQ(reference.OnRapid(7, 2.0), 2.0);
  EXPECT_DOUBLE_EQ(reference.OnRapid(7, 0.0), 2.0);  // the cycle's own
  EXPECT_DOUBLE_EQ(reference.OnRapid(8, 0.0), 0.0);
}

}  // namespace
}  // namespace ncsim::collision
