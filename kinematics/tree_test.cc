// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/tree.h"

#include <gtest/gtest.h>

#include <numbers>

#include "kinematics/chain.h"
#include "kinematics/test_machines.h"

namespace ncsim::kinematics {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

Joint MakeJoint(const char* name, JointType type, int parent, int child,
                const Eigen::Vector3d& axis, const Eigen::Vector3d& origin) {
  Joint joint;
  joint.name = name;
  joint.type = type;
  joint.parent_link = parent;
  joint.child_link = child;
  joint.axis = axis;
  joint.X_PJ = At(origin);
  return joint;
}

TEST(KinematicTreeTest, SortsLinksAndNumbersMovingJointsInOrderOfAppearance) {
  // Leaf first: tool(0) <- ram(1) <- base(3) -> table(2).
  const KinematicTree tree(
      {{"tool", -1}, {"ram", -1}, {"table", -1}, {"base", -1}},
      {MakeJoint("mount", JointType::kFixed, 1, 0, Eigen::Vector3d::UnitX(), {0, 0, -100}),
       MakeJoint("z", JointType::kPrismatic, 3, 1, Eigen::Vector3d::UnitZ(), {0, 0, 500}),
       MakeJoint("c", JointType::kRevolute, 3, 2, Eigen::Vector3d::UnitZ(), {10, 0, 0})});

  EXPECT_EQ(tree.links()[0].name, "base");
  for (const Joint& joint : tree.joints()) {
    EXPECT_LT(joint.parent_link, joint.child_link);
    EXPECT_EQ(&tree.joints()[tree.links()[joint.child_link].parent_joint], &joint);
  }
  EXPECT_EQ(tree.moving_joints(), (std::vector<int>{1, 2}));
  EXPECT_EQ(tree.joints()[0].index, -1);
  EXPECT_EQ(tree.joints()[1].index, 0);
  EXPECT_EQ(tree.joints()[2].index, 1);
  EXPECT_EQ(tree.MovingJointsTo(tree.FindLink("tool")), std::vector<int>{1});
  EXPECT_EQ(tree.FindJoint("c"), 2);
  EXPECT_EQ(tree.FindLink("QQQ"), -1);
  EXPECT_EQ(tree.FindJoint("QQQ"), -1);

  JointVector q(2);
  q << -50.0, 90.0 * kDeg;
  EXPECT_TRUE(tree.Pose(tree.FindLink("tool"), q)
                  .translation()
                  .isApprox(Eigen::Vector3d(0, 0, 350), 1e-12));
  EXPECT_TRUE((tree.Pose(tree.FindLink("table"), q) * Eigen::Vector3d(1, 0, 0))
                  .isApprox(Eigen::Vector3d(10, 1, 0), 1e-12));
}

// A table-fixed point moves by Ry(-B) Rz(-C) about the pivots (docs/notation.md).
TEST(KinematicTreeTest, TablePointOfBcTrunnionTurnsByMinusBAndMinusC) {
  const Eigen::Vector3d pivot_b(-381.0, -254.0, -495.7);
  const Eigen::Vector3d pivot_c(-380.0, -253.0, -545.0);
  const TestMachine machine = TrunnionBC(pivot_b, pivot_c);
  JointVector q = JointVector::Zero(5);
  q[3] = 47.137 * kDeg;
  q[4] = 116.354 * kDeg;
  const Eigen::Matrix3d Ry = Eigen::AngleAxisd(-q[3], Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Matrix3d Rz = Eigen::AngleAxisd(-q[4], Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d p_M(-300.0, -200.0, -400.0);  // at B0 C0
  const Eigen::Vector3d expected = pivot_b + Ry * (pivot_c - pivot_b + Rz * (p_M - pivot_c));
  EXPECT_LT((machine.tree.Pose(machine.table_link, q) * p_M - expected).norm(), 1e-10);
}

TEST(KinematicTreeTest, PosesAgreeWithPoseAndReuseTheVector) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const TestMachine machine = RandomMachine(&random);
    std::vector<Eigen::Isometry3d> X_ML;
    X_ML.reserve(machine.tree.links().size());
    const Eigen::Isometry3d* data = X_ML.data();
    const JointVector q = RandomPosition(&random, machine.tree);
    machine.tree.Poses(q, &X_ML);
    EXPECT_EQ(X_ML.data(), data);
    ASSERT_EQ(X_ML.size(), machine.tree.links().size());
    for (int link = 0; link < static_cast<int>(X_ML.size()); ++link) {
      EXPECT_TRUE(X_ML[link].isApprox(machine.tree.Pose(link, q), 1e-12));
      EXPECT_TRUE(X_ML[link].linear().isUnitary(1e-12));
    }
  }
}

TEST(ChainTest, PoseIsTheRelativePoseOfAnyTwoLinks) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const TestMachine machine = RandomMachine(&random);
    const JointVector q = RandomPosition(&random, machine.tree);
    const int count = static_cast<int>(machine.tree.links().size());
    for (int b = 0; b < count; ++b) {
      for (int a = 0; a < count; ++a) {
        const Eigen::Isometry3d X_BA = machine.tree.Pose(b, q).inverse() * machine.tree.Pose(a, q);
        EXPECT_TRUE(Chain(machine.tree, b, a).Pose(q).isApprox(X_BA, 1e-9)) << b << " " << a;
      }
    }
  }
}

TEST(ChainTest, LeavesOutWhatBothLinksHangOn) {
  const TestMachine machine = TrunnionBC({0, 0, 0}, {0, 0, -50});
  const int b = machine.tree.FindLink("B_link");
  const Chain chain(machine.tree, machine.table_link, b);
  ASSERT_EQ(chain.steps().size(), 1u);  // C alone: B carries both
  EXPECT_EQ(chain.steps()[0].index, 4);
  EXPECT_TRUE(Chain(machine.tree, b, b).steps().empty());
}

}  // namespace
}  // namespace ncsim::kinematics
