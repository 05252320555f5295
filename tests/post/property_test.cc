// SPDX-License-Identifier: BSD-3-Clause
// Random tool axes over what a machine reaches and the poles, random paths: what `ncsim post`
// writes is what the file says, on both machines, in each mode for the motion that fits it, in both
// units.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "sim/app/app.h"
#include "tests/post/post_rig.h"
#include "tests/post/random_cl.h"

namespace ncsim::posting {
namespace {

constexpr std::uint64_t kSeeds = 6;

RandomMotion ThreeAxes() {
  RandomMotion motion;
  motion.holes = true;
  return motion;
}
RandomMotion Indexed() {
  RandomMotion motion = ThreeAxes();
  motion.tilts = true;
  return motion;
}
RandomMotion Turning() {
  RandomMotion motion;
  motion.tilts = motion.turns = true;
  return motion;
}
/// Without tool centre point control a table must turn as fast as the tip goes.
RandomMotion Slow() {
  RandomMotion motion = Turning();
  motion.beside_pole = false;
  motion.feed = 10.0;
  return motion;
}
/// A control that is told vectors turns at the pole by a rule of its own.
RandomMotion OffThePoles() {
  RandomMotion motion = Turning();
  motion.poles = motion.beside_pole = false;
  return motion;
}
RandomMotion Winding(double feed) {
  RandomMotion motion;
  motion.tilts = motion.winds = true;
  motion.operations = 1;
  motion.moves = 2;
  motion.feed = feed;
  return motion;
}

class PostProperty : public testing::TestWithParam<const char*> {
 protected:
  PostProperty() : rig_("property") {}

  void Hold(const std::string& model, const std::string& mode, const RandomMotion& motion,
            std::uint64_t seeds = kSeeds) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) HoldOne(model, mode, motion, seed);
  }
  void HoldOne(const std::string& model, const std::string& mode, const RandomMotion& motion,
               std::uint64_t seed) {
    const Way way{model, mode, {"--unit", GetParam()}};
    const bool fine = model == kBcTable || std::string(GetParam()) == "mm";
    SCOPED_TRACE(model + " " + mode + " seed " + std::to_string(seed));
    ASSERT_EQ(rig_.PostText(RandomCl(seed, motion), way), app::kExitPass) << rig_.said();
    ASSERT_EQ(rig_.Compare(rig_.folder() / "part.cls", way), app::kExitPass) << rig_.said();
    EXPECT_LE(rig_.position(), fine ? 0.006 : 0.0076);  // 0.005 and an increment, rounded up
    EXPECT_LE(rig_.angle(), 0.01);
    EXPECT_GE(rig_.position(), 0.0);
  }
  PostRig rig_;
};

TEST_P(PostProperty, ThreeAxes) {
  Hold(kUmc750, "three", ThreeAxes());
  Hold(kBcTable, "three", ThreeAxes());
}

TEST_P(PostProperty, Indexed) {
  Hold(kUmc750, "indexed", Indexed());
  Hold(kBcTable, "indexed", Indexed());
  Hold(kBcTable, "rot", Indexed());
}

TEST_P(PostProperty, ToolCentrePoint) {
  Hold(kUmc750, "tcp", Turning());
  Hold(kBcTable, "tcp", Turning());
}

// Behind a rewind a feed ends in a motion that is smaller than the tolerance: a walk of both may
// end there with one of them a radius ahead.
TEST_P(PostProperty, ARewindBeforeAMotionBelowTheTolerance) {
  HoldOne(kBcTable, "tcp", Turning(), 9036);
}

TEST_P(PostProperty, AsTheOperationsNeed) {
  Hold(kUmc750, "", Turning());
  Hold(kBcTable, "", Turning());
}

TEST_P(PostProperty, AxesInInverseTime) { Hold(kUmc750, "axes", Slow()); }

TEST_P(PostProperty, Vectors) { Hold(kBcTable, "vectors", OffThePoles()); }

TEST_P(PostProperty, RewindsWhereATableIsWoundUp) {
  Hold(kUmc750, "tcp", Winding(400.0), 1);
  EXPECT_NE(rig_.Program().find("(REWIND)"), std::string::npos);
  Hold(kUmc750, "axes", Winding(40.0), 1);
  Hold(kBcTable, "tcp", Winding(400.0), 1);
  Hold(kBcTable, "vectors", Winding(400.0), 1);
}

INSTANTIATE_TEST_SUITE_P(Units, PostProperty, testing::Values("mm", "inch"),
                         [](const auto& unit) { return std::string(unit.param); });

}  // namespace
}  // namespace ncsim::posting
