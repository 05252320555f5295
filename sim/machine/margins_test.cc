// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/margins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/machine/load.h"
#include "sim/machine/test_files.h"

namespace ncsim::machine {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* kScene = R"(schema = 1
units = "mm"
[[tool]]
number = 3
length = 120.0
cutter = { type = "end", diameter = 6.0, flute_length = 20.0 }
shank = [ { lower = 6.0, upper = 6.0, height = 30.0 } ]
holder = [ { lower = 40.0, upper = 50.0, height = 60.0 } ]
[[fixture]]
name = "jaw"
box = [100.0, 80.0, 50.0]
at = { on = "workpiece_mount" }
[part]
box = [50.0, 50.0, 25.0]
at = { on = "jaw", xyz = [0.0, 0.0, 50.0] }
[check]
clearance = 2.0
)";

/// tests/reject/machines/complete.*, whose SRDF has z_head and b_trunnion keep 5 mm.
class MarginsTest : public ::testing::Test {
 protected:
  MarginsTest() {
    machine_ = *LoadMachine(RejectFile("machines/complete.urdf"), &diagnostics_);
    EXPECT_THAT(Reported(diagnostics_), IsEmpty());
  }

  /// `margins` begins at line 18 of the job.
  Job Read(const std::string& margins) {
    return *LoadJob(folder_.Write("job.toml", kScene + margins), &diagnostics_);
  }
  std::vector<std::string> Check(const std::string& margins) {
    const Job job = Read(margins);
    const Scene scene = BuildScene(machine_, job, &diagnostics_);
    CheckMargins(machine_, job, scene, {job.tools}, &diagnostics_);
    return Reported(diagnostics_);
  }
  MarginBody Link(const std::string& name, std::string_view shape) const {
    return {shape, BodyKind::kMachine, machine_.tree.FindLink(name)};
  }
  double Clearance(const Job& job, const MarginBody& a, const MarginBody& b) const {
    const double clearance = NearMissClearance(machine_, job.check, a, b);
    EXPECT_EQ(NearMissClearance(machine_, job.check, b, a), clearance);
    return clearance;
  }

  TempFolder folder_;
  Diagnostics diagnostics_;
  Machine machine_;
  const MarginBody holder_{"T3.holder", BodyKind::kHolder, 4};
  const MarginBody other_holder_{"T33.holder", BodyKind::kHolder, 4};
  const MarginBody shank_{"T3.shank", BodyKind::kShank, 4};
  const MarginBody jaw_{"jaw", BodyKind::kFixture, 7};
};

std::string Margin(const std::string& a, const std::string& b, double clearance) {
  return "[[check.margin]]\nbodies = [\"" + a + "\", \"" + b +
         "\"]\nclearance = " + std::to_string(clearance) + "\n";
}

TEST_F(MarginsTest, APairHasItsOwnAndOthersTheGeneralOne) {
  const Job job = Read(Margin("jaw", "T3.holder", 5.0));
  EXPECT_EQ(Clearance(job, holder_, jaw_), 5.0);
  EXPECT_EQ(Clearance(job, other_holder_, jaw_), 2.0);
  EXPECT_EQ(Clearance(job, shank_, jaw_), 2.0);
  EXPECT_EQ(Clearance(job, holder_, Link("z_head", "z_head")), 2.0);
}

TEST_F(MarginsTest, AWordForEveryToolGivesWayToANameOfOne) {
  const Job job = Read(Margin("T3.holder", "jaw", 0.0) + Margin("holder", "jaw", 5.0));
  EXPECT_EQ(Clearance(job, holder_, jaw_), 0.0);
  EXPECT_EQ(Clearance(job, other_holder_, jaw_), 5.0);
  EXPECT_EQ(Clearance(job, shank_, jaw_), 2.0);
}

// (T3.holder, b_trunnion) and (holder, b_trunnion/2) both name one of the two in full.
TEST_F(MarginsTest, OfEqualsTheGreaterHolds) {
  const Job job =
      Read(Margin("T3.holder", "b_trunnion", 3.0) + Margin("holder", "b_trunnion/2", 4.0));
  EXPECT_EQ(Clearance(job, holder_, Link("b_trunnion", "b_trunnion/2")), 4.0);
  EXPECT_EQ(Clearance(job, holder_, Link("b_trunnion", "b_trunnion")), 3.0);
  EXPECT_EQ(Clearance(job, other_holder_, Link("b_trunnion", "b_trunnion/3")), 2.0);
}

TEST_F(MarginsTest, TheModelSpeaksForEveryShapeOfItsLinksUntilTheJobDoes) {
  const Job silent = Read("");
  EXPECT_EQ(Clearance(silent, Link("z_head", "z_head"), Link("b_trunnion", "b_trunnion/2")), 5.0);
  EXPECT_EQ(Clearance(silent, Link("z_head", "z_head"), Link("c_platter", "c_platter")), 2.0);
  const MarginBody on_link{"jaw", BodyKind::kFixture, machine_.tree.FindLink("b_trunnion")};
  EXPECT_EQ(Clearance(silent, Link("z_head", "z_head"), on_link), 2.0);
  const Job job = Read(Margin("z_head", "b_trunnion", 1.0));
  EXPECT_EQ(Clearance(job, Link("z_head", "z_head"), Link("b_trunnion", "b_trunnion/2")), 1.0);
}

TEST_F(MarginsTest, WhatJudgesSomethingIsSilent) {
  EXPECT_THAT(Check(Margin("T3.holder", "jaw", 5.0) + Margin("flutes", "jaw", 5.0) +
                    Margin("shank", "part", 5.0) + Margin("b_trunnion", "holder", 5.0) +
                    Margin("z_head", "part", 5.0)),
              IsEmpty());
}

TEST_F(MarginsTest, ANameOfNothingIsAnError) {
  EXPECT_THAT(
      Check(Margin("T4.holder", "jew", 5.0) + Margin("holder", "spindle_gauge", 5.0)),
      ElementsAre("job.toml:19:11: error: there is no body 'T4.holder' in the scene or among the "
                  "tools (did you mean 'T3.holder'?)",
                  "job.toml:19:24: error: there is no body 'jew' in the scene or among the tools "
                  "(did you mean 'jaw'?)",
                  "job.toml:22:21: error: link 'spindle_gauge' has no shape"));
}

TEST_F(MarginsTest, TwoBodiesOfToolsAreAnError) {
  EXPECT_THAT(Check(Margin("T3.holder", "shank", 5.0)),
              ElementsAre("job.toml:19:24: error: bodies of tools are not checked against each "
                          "other"));
}

TEST_F(MarginsTest, WhatJudgesNothingIsToldSo) {
  EXPECT_THAT(
      Check(Margin("jaw", "part", 5.0) + Margin("z_head", "x_slide", 5.0) +
            Margin("part", "flutes", 5.0) + Margin("z_head", "holder", 5.0)),
      ElementsAre("job.toml:19:11: warning: 'jaw' and 'part' do not move against each other: this "
                  "margin judges nothing",
                  "job.toml:22:11: warning: the model says that 'z_head' and 'x_slide' need no "
                  "check: this margin judges nothing",
                  "job.toml:25:11: warning: 'T3.flutes' and 'part' are judged by depth, not by "
                  "clearance: this margin judges nothing",
                  "job.toml:28:11: warning: 'T3.holder' and 'z_head' do not move against each "
                  "other: this margin judges nothing"));
}

}  // namespace
}  // namespace ncsim::machine
