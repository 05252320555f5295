// SPDX-License-Identifier: BSD-3-Clause
// Nothing that a program's length, its windows or the number of threads does to the order of work
// may be seen in what is reported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinematics/test_machines.h"
#include "sim/collision/test_rig.h"
#include "sim/collision/threads.h"

namespace ncsim::collision {

namespace {

using kinematics::Random;
using machine::BodyKind;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// Feeds and rapids about a post, a part, a blank and a column, that come near and hit.
Rig RandomRig(Random* random, int motions) {
  Rig rig;
  rig.check().clearance = 2.0;
  rig.AddTool(4, CylinderProfile(0, 30, 8), {}, CylinderProfile(60, 150, 25));
  rig.AddBox("post", BodyKind::kFixture, {60, -20, -50}, {90, 20, 60});
  rig.AddBox("part", BodyKind::kPart, {-60, -30, -50}, {0, 30, 0});
  rig.AddBox("blank", BodyKind::kStock, {-62, -32, -50}, {2, 32, 3});
  rig.AddBody("column", BodyKind::kMachine, BoxMesh({200, -100, -50}, {260, 100, 400}), 0);
  rig.AddBody("head", BodyKind::kMachine, BoxMesh({-50, -50, 0}, {50, 50, 200}),
              rig.machine().spindle_link);
  rig.Start(-30, 0, 40);
  for (int i = 0; i < motions; ++i) {
    if (i == motions / 2) rig.facts().tool = 4;
    const double x = random->Uniform(-70, 100);
    const double y = random->Uniform(-50, 50);
    const double z = random->Uniform(-3, 60);
    const double c = random->Uniform(-40, 40);
    random->Chance(0.3) ? rig.Rapid(x, y, z + 10, 0, c) : rig.Feed(x, y, z, 0, c);
  }
  return rig;
}

}  // namespace

TEST(BatchTest, AnyNumberOfThreadsSaysTheSame) {
  Random random(71);
  int findings = 0;
  for (int i = 0; i < 5; ++i) {
    const Rig rig = RandomRig(&random, 300);
    std::string alone;
    {
      const ThreadLimit limit(1);
      ASSERT_TRUE(OnlyOneThread());
      alone = Everything(rig.Run(20));
    }
    for (const int threads : {2, 8}) {
      const ThreadLimit limit(threads);
      ASSERT_FALSE(OnlyOneThread());
      EXPECT_EQ(Everything(rig.Run(20)), alone) << "case " << i << ", " << threads << " threads";
    }
    findings += static_cast<int>(rig.Run(20).findings.size());
  }
  EXPECT_GT(findings, 50);  // there was something to say
}

// The flutes scrape along a wall, then stay near it.
TEST(BatchTest, AFaultOverWindowsIsOneFinding) {
  Rig rig;
  rig.check().clearance = 2.0;
  rig.AddBox("wall", BodyKind::kFixture, {-500, 10, -50}, {500, 40, 35});
  rig.Start(-300, 0, 10);
  for (int i = 1; i <= 200; ++i) rig.Feed(-300 + i, i < 100 ? 6.0 : 3.5, 10);
  for (int i = 1; i <= 200; ++i) rig.Feed(-100 + i, i == 77 ? 3.6 : 3.4, 10);
  for (const std::size_t window : {1, 30, 64, 399, 400}) {
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

}  // namespace ncsim::collision
