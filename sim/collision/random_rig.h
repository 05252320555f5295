// SPDX-License-Identifier: BSD-3-Clause
// Random programs about a post, a part, a blank and a column, that come near and hit.
#pragma once

#include "sim/collision/test_rig.h"

namespace ncsim::collision {

/// `machine`: as Rig's own, or one that was moved as a whole by `X`.
inline Rig RandomRig(kinematics::Random* random, int motions,
                     const Eigen::Isometry3d& X = Eigen::Isometry3d::Identity()) {
  kinematics::TestMachine machine = kinematics::TrunnionBC({0, 0, 0}, {0, 0, 0});
  std::vector<kinematics::Joint> joints = machine.tree.joints();
  for (kinematics::Joint& joint : joints) {
    if (joint.parent_link == 0) joint.X_PJ = X * joint.X_PJ;
  }
  machine.tree = kinematics::KinematicTree(machine.tree.links(), joints);
  Rig rig(machine);
  rig.check().clearance = 2.0;
  rig.AddTool(4, CylinderProfile(0, 30, 8), {}, CylinderProfile(60, 150, 25));
  rig.AddBox("post", machine::BodyKind::kFixture, {60, -20, -50}, {90, 20, 60});
  rig.AddBox("part", machine::BodyKind::kPart, {-60, -30, -50}, {0, 30, 0});
  rig.AddBox("blank", machine::BodyKind::kStock, {-62, -32, -50}, {2, 32, 3});
  machine::TriangleMesh column = BoxMesh({200, -100, -50}, {260, 100, 400});
  for (Eigen::Vector3d& vertex : column.vertices) vertex = X * vertex;
  rig.AddBody("column", machine::BodyKind::kMachine, column, 0);
  rig.AddBody("head", machine::BodyKind::kMachine, BoxMesh({-50, -50, 0}, {50, 50, 200}),
              machine.spindle_link);
  rig.Start(-30, 0, 40);
  for (int i = 0; i < motions; ++i) {
    if (i == motions / 2) rig.facts().tool = 4;
    const double x = random->Uniform(-70, 100);
    const double y = random->Uniform(-50, 50);
    const double z = random->Uniform(-3, 60);
    const double c = random->Uniform(-40, 40);
    switch (random->Below(10)) {
      case 0:
      case 1:
        rig.Rapid(x, y, z + 10, 0, c);
        break;
      case 2:
        rig.DogLeg(x, y, z + 10);
        break;
      default:
        rig.Feed(x, y, z, 0, c);
    }
  }
  return rig;
}

}  // namespace ncsim::collision
