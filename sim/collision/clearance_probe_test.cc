// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/clearance_probe.h"

#include <gtest/gtest.h>

#include "sim/machine/primitives.h"

namespace ncsim::collision {
namespace {

using machine::BodyKind;

/// A carriage on X with a block of 20 mm; 100 mm away a wall, on the other side a wall 300 mm away
/// and a blank in between.
struct Carriage {
  Carriage() {
    kinematics::Joint joint;
    joint.name = "X";
    joint.type = kinematics::JointType::kPrismatic;
    joint.parent_link = 0;
    joint.child_link = 1;
    machine.tree = kinematics::KinematicTree({{"base", -1}, {"carriage", 0}}, {joint});
    machine.spindle_link = 1;
    Add("block", BodyKind::kMachine, 1, 0.0);
    Add("wall", BodyKind::kFixture, 0, 120.0);
    Add("far", BodyKind::kFixture, 0, -320.0);
    Add("blank", BodyKind::kStock, 0, -60.0);
  }

  void Add(const std::string& name, BodyKind kind, int link, double x) {
    machine::SceneBody body;
    body.name = name;
    body.kind = kind;
    body.link = link;
    body.mesh = machine::MakeBox({20.0, 20.0, 20.0});
    body.mesh.watertight = true;
    machine::Translate({x, 0.0, 0.0}, &body.mesh);
    scene.bodies.push_back(std::move(body));
  }

  std::optional<SeenClearance> At(double x, ClearanceProbe* probe) const {
    return probe->At(kinematics::JointVector::Constant(1, x), 0);
  }

  machine::Machine machine;
  machine::Scene scene;
};

TEST(ClearanceProbeTest, IsTheGapToWhatIsNearest) {
  const Carriage rig;
  ClearanceProbe probe(rig.machine, rig.scene, {});
  for (const double x : {0.0, 50.0, 99.0, -80.0, -299.5}) {
    const auto seen = rig.At(x, &probe);
    ASSERT_TRUE(seen);
    const double gap = std::min(100.0 - x, 300.0 + x);  // The blank is to be cut.
    EXPECT_NEAR(seen->clearance_mm, gap, std::max(0.05, 0.02 * gap)) << x;
    EXPECT_NE(std::find(seen->bodies->begin(), seen->bodies->end(),
                        100.0 - x < 300.0 + x ? "wall" : "far"),
              seen->bodies->end())
        << x;
  }
  const auto inside = rig.At(110.0, &probe);
  ASSERT_TRUE(inside);
  EXPECT_LE(inside->clearance_mm, 0.0);
}

TEST(ClearanceProbeTest, NothingToSeeIsSaid) {
  Carriage rig;
  rig.scene.bodies.resize(1);
  ClearanceProbe probe(rig.machine, rig.scene, {});
  EXPECT_FALSE(rig.At(0.0, &probe));
}

}  // namespace
}  // namespace ncsim::collision
