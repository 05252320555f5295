// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/relative_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinematics/test_machines.h"

namespace ncsim::kinematics {
namespace {

constexpr double kRounding = 1e-9;

TEST(ChordTest, IsTheChordUpToHalfATurnAndTheDiameterBeyond) {
  EXPECT_DOUBLE_EQ(Chord(0.0), 0.0);
  EXPECT_NEAR(Chord(std::numbers::pi / 3.0), 1.0, 1e-15);
  EXPECT_NEAR(Chord(std::numbers::pi), 2.0, 1e-15);
  EXPECT_NEAR(Chord(100.0), 2.0, 1e-15);
}

TEST(RelativePathTest, SquareLinearJointsAddAsVectors) {
  const TestMachine machine = TrunnionBC({0, 0, 0}, {0, 0, 0});
  const RelativePath path(machine.tree, 0, machine.spindle_link);
  JointVector deviation = JointVector::Zero(5);
  deviation << 3.0, 4.0, 12.0, 1.0, 1.0;  // B and C are not on the path
  const Extent tool{machine.spindle_link, {0, 0, 100}, 20.0};
  EXPECT_NEAR(path.Bound(JointVector::Zero(5), tool, deviation), 13.0, 1e-12);
  EXPECT_NEAR(path.Bound(JointVector::Zero(5), tool, deviation, 11.0), 11.0, 1e-12);
}

// Two slides 60 degrees apart, 1 mm each: together they reach sqrt(3) mm, apart only 1 mm.
TEST(RelativePathTest, ObliqueLinearJointsAddAsTheirWorstDiagonal) {
  MachineBuilder builder;
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  int link = builder.Add(0, "u", JointType::kPrismatic, Eigen::Vector3d::UnitX(), X);
  link = builder.Add(link, "v", JointType::kPrismatic, {0.5, std::sqrt(0.75), 0.0}, X);
  const KinematicTree tree = builder.Build();
  const RelativePath path(tree, 0, link);
  EXPECT_NEAR(path.Bound(JointVector::Zero(2), {link, {0, 0, 0}, 5.0}, JointVector::Ones(2)),
              std::sqrt(3.0), 1e-12);
}

TEST(RelativePathTest, TurningJointReachesAsFarAsTheExtentIsFromItsAxis) {
  const TestMachine machine = TrunnionBC({0, 0, -500}, {0, 0, -500});
  const int b = machine.tree.FindLink("B_link");
  const double angle = 0.1;
  JointVector deviation = JointVector::Zero(5);
  deviation[3] = angle;
  // 300 mm along the axis do not count; 30 and 40 across it make 50, and 7 for the ball.
  const Extent trunnion{b, {30, 300, 40}, 7.0};
  const double chord = 2.0 * std::sin(angle / 2.0);
  EXPECT_NEAR(RelativePath(machine.tree, 0, b).Bound(JointVector::Zero(5), trunnion, deviation),
              57.0 * chord, 1e-12);
  // Seen from the trunnion the base turns the other way: the same distance from the same axis.
  const Extent base{0, {30, 300, -460}, 7.0};
  EXPECT_NEAR(RelativePath(machine.tree, b, 0).Bound(JointVector::Zero(5), base, deviation),
              57.0 * chord, 1e-12);
}

TEST(RelativePathTest, RigidPathDoesNotMove) {
  const TestMachine machine = TrunnionBC({0, 0, 0}, {0, 0, 0});
  const RelativePath path(machine.tree, machine.tree.FindLink("Z_link"), machine.spindle_link);
  EXPECT_TRUE(path.rigid());
  EXPECT_FALSE(path.MovesBetween(JointVector::Zero(5), JointVector::Ones(5)));
  EXPECT_EQ(path.Bound(JointVector::Zero(5), {machine.spindle_link, {1, 2, 3}, 4.0},
                       JointVector::Ones(5)),
            0.0);
}

TEST(RelativePathTest, MovesBetweenLooksAtThePathAlone) {
  const TestMachine machine = TrunnionBC({0, 0, 0}, {0, 0, 0});
  const RelativePath path(machine.tree, 0, machine.table_link);
  JointVector q = JointVector::Zero(5);
  q[0] = 1.0;
  EXPECT_FALSE(path.MovesBetween(JointVector::Zero(5), q));
  q[4] = 1e-12;
  EXPECT_TRUE(path.MovesBetween(JointVector::Zero(5), q));
}

/// Displacement of the point of `extent` that goes farthest from X_BA0 to X_BA1: the map moves the
/// centre, and of the ball the point farthest from the axis of rotation.
double Displacement(const Extent& extent, const Eigen::Isometry3d& X_BA0,
                    const Eigen::Isometry3d& X_BA1, Random* random) {
  double farthest = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = extent.p_LC + extent.radius * random->Direction();
    farthest = std::max(farthest, (X_BA1 * p - X_BA0 * p).norm());
  }
  return farthest;
}

TEST(RelativePathTest, BoundHoldsOverRandomMachinesAndIsTight) {
  Random random(3);
  double ratio_sum = 0.0;
  int ratios = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const MachineOptions options{random.Chance(0.3), random.Chance(0.5)};
    const TestMachine machine = RandomMachine(&random, options);
    const int count = static_cast<int>(machine.tree.links().size());
    const Extent extent{random.Below(count), random.InBox(200.0), random.Uniform(0.0, 100.0)};
    const int b = random.Below(count);
    const RelativePath path(machine.tree, b, extent.link);
    const JointVector q = RandomPosition(&random, machine.tree);
    const double scale = std::pow(10.0, random.Uniform(-3.0, 0.5));
    JointVector deviation(q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const bool revolute =
          machine.tree.joints()[machine.tree.moving_joints()[i]].type == JointType::kRevolute;
      deviation[i] = random.Chance(0.3) ? 0.0 : scale * random.Uniform(0.0, revolute ? 1.0 : 100.0);
    }
    const double bound = path.Bound(q, extent, deviation);
    const Eigen::Isometry3d X_BA0 = path.Pose(q);
    double farthest = 0.0;
    for (int sample = 0; sample < 128; ++sample) {
      JointVector moved = q;
      for (Eigen::Index i = 0; i < q.size(); ++i) {
        // Corners first: the farthest point is mostly there.
        const double part = sample < 96 ? (random.Chance(0.5) ? 1.0 : -1.0) : random.Uniform(-1, 1);
        moved[i] += part * deviation[i];
      }
      farthest = std::max(farthest, Displacement(extent, X_BA0, path.Pose(moved), &random));
    }
    ASSERT_LE(farthest, bound + kRounding) << "trial " << trial;
    if (bound > 0.0) {
      ratio_sum += bound / farthest;
      ++ratios;
    }
  }
  RecordProperty("mean_bound_to_sampled", std::to_string(ratio_sum / ratios));
  EXPECT_LT(ratio_sum / ratios, 1.4);
}

}  // namespace
}  // namespace ncsim::kinematics
