// SPDX-License-Identifier: BSD-3-Clause
// Nothing that a program's length, its windows or the number of threads does to the order of work
// may be seen in what is reported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/collision/random_rig.h"
#include "sim/collision/threads.h"

namespace ncsim::collision {

namespace {

using machine::BodyKind;
using ::testing::HasSubstr;
using ::testing::SizeIs;

}  // namespace

TEST(BatchTest, AnyNumberOfThreadsSaysTheSame) {
  kinematics::Random random(71);
  int findings = 0;
  for (int i = 0; i < 3; ++i) {
    const Rig rig = RandomRig(&random, 60);
    std::string alone;
    {
      const ThreadLimit limit(1);
      ASSERT_TRUE(OnlyOneThread());
      alone = Everything(rig.Run(7));
    }
    for (const int threads : {2, 8}) {
      const ThreadLimit limit(threads);
      ASSERT_FALSE(OnlyOneThread());
      EXPECT_EQ(Everything(rig.Run(7)), alone) << "case " << i << ", " << threads << " threads";
    }
    findings += static_cast<int>(rig.Run(7).findings.size());
  }
  EXPECT_GT(findings, 30);  // there was something to say
}

// The flutes scrape along a wall, then stay near it.
TEST(BatchTest, AFaultOverWindowsIsOneFinding) {
  Rig rig;
  rig.check().clearance = 2.0;
  rig.AddBox("wall", BodyKind::kFixture, {-500, 10, -50}, {500, 40, 35});
  rig.Start(-300, 0, 10);
  for (int i = 1; i <= 200; ++i) rig.Feed(-300 + i, i < 100 ? 6.0 : 3.5, 10);
  for (int i = 1; i <= 200; ++i) rig.Feed(-100 + i, i == 77 ? 3.6 : 3.4, 10);
  for (const std::size_t window : {1, 64, 399, 400}) {
    const CollisionResult result = rig.Run(window);
    ASSERT_THAT(result.findings, SizeIs(2)) << Words(result);
    EXPECT_EQ(result.findings[0].where.line, 1);
    EXPECT_THAT(result.findings[0].message, HasSubstr("1 mm deep"));
    EXPECT_THAT(result.findings[0].message, HasSubstr("100 blocks, the last is line 100"));
    // The nearest of the run is followed to a tenth.
    EXPECT_NEAR(*result.findings[1].clearance_mm, 1.4, 0.14);
    EXPECT_NEAR(result.findings[1].where.line, 277, 1);
    EXPECT_THAT(result.findings[1].message, HasSubstr("300 blocks, the last is line 400"));
  }
}

// What cuts goes through the windows in their order: the first cut and what rapids may keep are
// known from the windows before.
TEST(BatchTest, WhatCutsKnowsTheWindowsBefore) {
  Rig rig;
  rig.AddBox("part", BodyKind::kPart, {-60, -30, -50}, {60, 30, 0});
  rig.AddBox("blank", BodyKind::kStock, {-62, -32, -50}, {62, 32, 3});
  rig.Start(-80, 0, -0.2);
  rig.Feed(-40, 0, -0.2);    // 1: the first cut; as deep as no rapid may be by itself
  rig.Rapid(-40, 10, -0.2);  // 2: stays as deep as the feed left it
  rig.Rapid(-40, 10, 20);    // 3
  rig.Rapid(40, 0, 20);      // 4
  rig.Rapid(40, 0, 1);       // 5: the blank is cut, so not known here
  rig.Rapid(40, 0, -0.2);    // 6: into the part
  for (const std::size_t window : {1, 2, 3, 6}) {
    const CollisionResult result = rig.Run(window);
    ASSERT_THAT(Of(result, Rule::kRapidContact), SizeIs(1)) << Words(result);
    EXPECT_EQ(Of(result, Rule::kRapidContact)[0].where.line, 6);
    for (const Finding& finding : Of(result, Rule::kStockContact)) {
      EXPECT_EQ(finding.severity, Severity::kWarning) << Words(result);
    }
  }
}

// The flutes go through a window before holder and shank do: what these hit before the first cut
// was the whole blank all the same.
TEST(BatchTest, TheBlankIsWholeUntilItIsCut) {
  for (const std::size_t window : {1, 2, 4096}) {
    Rig holder;
    holder.AddBox("blank", BodyKind::kStock, {-62, -32, -50}, {2, 32, 3});
    holder.Start(-30, 45, 20);
    holder.Rapid(-30, 45, -100);  // the holder goes 7 mm into it
    holder.Rapid(-30, 45, 20);
    holder.Rapid(-30, 0, 20);
    holder.Feed(-30, 0, 1);  // the first cut
    const CollisionResult result = holder.Run(window);
    ASSERT_FALSE(result.findings.empty()) << window;
    EXPECT_EQ(result.findings[0].where.line, 1);
    EXPECT_EQ(result.findings[0].severity, Severity::kError) << Words(result);

    Rig shank;
    shank.AddBox("blank", BodyKind::kStock, {0, -30, 40}, {50, 30, 60});
    shank.Start(-30, 0, 0);
    shank.Rapid(20, 0, 0);  // no wider than the cutter, and through the blank
    shank.Rapid(-30, 0, 0);
    shank.Rapid(-30, 0, 40);
    shank.Feed(10, 0, 40);  // the first cut
    EXPECT_THAT(Of(shank.Run(window), Rule::kStockContact), SizeIs(1)) << window;
  }
}

// As deep as the feeds went that took the flutes in, on any later rapid, and wherever the windows
// end.
TEST(BatchTest, RapidsMayBeAsDeepAsTheFeedsBefore) {
  for (const std::size_t window : {1, 2, 3, 4096}) {
    for (int way = 0; way < 4; ++way) {
      Rig rig;
      rig.check().gouge = machine::GougeMode::kOff;
      rig.AddBox("part", BodyKind::kPart, {-60, -30, -50}, {0, 30, 0});
      rig.Start(-30, 0, 20);
      rig.Feed(-30, 0, 1);
      rig.Feed(-30, 0, -3);
      rig.Feed(-30, 0, -1);
      if (way == 1) rig.Rapid(-20, 0, -1);
      if (way == 2) rig.Rapid(-30, 0, -0.5);
      rig.Rapid(way == 1 ? -20 : -30, 0, way == 3 ? -3.3 : -2.5);
      rig.Rapid(-30, 0, 50);
      const CollisionResult result = rig.Run(window);
      EXPECT_THAT(result.findings, SizeIs(way == 3 ? 1 : 0))
          << "way " << way << ", window " << window << "\n"
          << Words(result);
    }
  }
}

// A run of contact under one rule goes on under another: that one is told of where it begins.
TEST(BatchTest, AnotherRuleBeginsWhereItBegins) {
  for (const std::size_t window : {1, 4096}) {
    Rig rig;
    rig.AddBox("part", BodyKind::kPart, {-60, -30, -50}, {0, 30, 0});
    rig.Start(-200, 0, -5);
    rig.Feed(-80, 0, -5);
    rig.Feed(-80, 60, -5);
    rig.Feed(20, -60, -5);   // a gouge across the corner
    rig.Rapid(-80, 60, -5);  // and back
    const CollisionResult result = rig.Run(window);
    const std::vector<Finding> rapids = Of(result, Rule::kRapidContact);
    ASSERT_THAT(rapids, SizeIs(1)) << Words(result);
    // The way is x = 20 - 100 s, y = -60 + 120 s; it meets the face y = -30 left of the corner. The
    // flutes (radius 5) are 0.1 mm in it at y = -34.9.
    EXPECT_NEAR(rapids[0].axes[0].second, -0.917, 1e-3) << window;
    EXPECT_NEAR(rapids[0].axes[1].second, -34.9, 1e-3) << window;
  }
}

}  // namespace ncsim::collision
