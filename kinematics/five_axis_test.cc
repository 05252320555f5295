// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/five_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinematics/test_machines.h"

namespace ncsim::kinematics {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

Eigen::Matrix3d Ry(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
}
Eigen::Matrix3d Rz(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

FiveAxis MakeFiveAxis(const TestMachine& machine) {
  const auto five_axis = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  EXPECT_TRUE(five_axis.has_value());
  return *five_axis;
}

Eigen::Vector3d ToolAxis(const FiveAxis& five_axis, const JointVector& q) {
  Eigen::Vector3d p_BT_B;
  Eigen::Vector3d u_B;
  five_axis.TipInTable(q, 0.0, &p_BT_B, &u_B);
  return u_B;
}

// u = (sin B cos C, sin B sin C, cos B), the equations of a BC table machine in docs/notation.md.
TEST(FiveAxisTest, ToolAxisOfBcTrunnionIsTheClosedForm) {
  const FiveAxis five_axis = MakeFiveAxis(TrunnionBC({1, 2, 3}, {4, 5, -60}));
  EXPECT_EQ(five_axis.linear(), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(five_axis.rotary(), (std::vector<int>{3, 4}));
  for (double b = -120.0; b <= 120.0; b += 7.5) {
    for (double c = -720.0; c <= 720.0; c += 37.0) {
      JointVector q = JointVector::Zero(5);
      q[3] = b * kDeg;
      q[4] = c * kDeg;
      const Eigen::Vector3d u(std::sin(q[3]) * std::cos(q[4]), std::sin(q[3]) * std::sin(q[4]),
                              std::cos(q[3]));
      EXPECT_LT((ToolAxis(five_axis, q) - u).norm(), 1e-13);
    }
  }
}

// Haas NGC Mill Operator's Manual 2017, G234, sample program O00003: at B47.137 C116.354 the tool
// goes in along its own axis from X-.9762 Y1.9704 Z1.0907 to X-.5688 Y1.1481 Z.2391 (to the words'
// four decimals).
TEST(FiveAxisTest, ToolAxisAgreesWithTheTcpcSampleOfHaas) {
  const FiveAxis five_axis = MakeFiveAxis(TrunnionBC({0, 0, 0}, {0, 0, 0}));
  JointVector q = JointVector::Zero(5);
  q[3] = 47.137 * kDeg;
  q[4] = 116.354 * kDeg;
  const Eigen::Vector3d approach =
      Eigen::Vector3d(-0.9762 + 0.5688, 1.9704 - 1.1481, 1.0907 - 0.2391).normalized();
  EXPECT_LT(std::acos(approach.dot(ToolAxis(five_axis, q))) / kDeg, 0.003);

  const auto solutions = five_axis.SolveRotary(approach);
  ASSERT_EQ(solutions.size(), 2u);
  EXPECT_NEAR(solutions[0].angles[0] / kDeg, 47.137, 0.004);
  EXPECT_NEAR(solutions[0].angles[1] / kDeg, 116.354, 0.004);
  EXPECT_NEAR(solutions[1].angles[0] / kDeg, -47.137, 0.004);
  EXPECT_NEAR(solutions[1].angles[1] / kDeg, 116.354 - 180.0, 0.004);
}

// Haas NGC Mill Operator's Manual 2017, G254, sample program O00004: `B90. C0.` and a hole at X1 Y0
// from the face Z1, work zero at the top centre of the part: it is drilled into the part's +X face,
// 1 in below the top.
TEST(FiveAxisTest, PointOfTheDwoSampleOfHaasIsOnThePlusXFace) {
  const Eigen::Vector3d pivot(-15.0, -10.0,
                              -19.5);  // any: the offset of the tip from the part's zero is rigid
  const FiveAxis five_axis = MakeFiveAxis(TrunnionBC(pivot, pivot));
  const Eigen::Vector3d zero(-14.0, -9.5, -10.0);
  JointVector q = JointVector::Zero(5);
  q[3] = 90.0 * kDeg;
  const Eigen::Vector3d gauge = pivot + Ry(-q[3]) * (zero - pivot) + Eigen::Vector3d(1.0, 0.0, 1.0);
  q.head<3>() = gauge;
  Eigen::Vector3d p_BT_B;
  Eigen::Vector3d u_B;
  five_axis.TipInTable(q, 0.0, &p_BT_B, &u_B);
  EXPECT_LT((p_BT_B - zero - Eigen::Vector3d(1.0, 0.0, -1.0)).norm(), 1e-12);
  EXPECT_LT((u_B - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

// TCPC for a table machine: M = P + R (w + q - P) + (0, 0, L), R = Ry(-B) Rz(-C), P the rotary
// centre (settings 255-257), w the work offset, q the program's point, L the tool length
// (docs/notation.md).
TEST(FiveAxisTest, SolveLinearIsTheHaasEquation) {
  const Eigen::Vector3d P(-381.0, -254.0, -495.7);
  const FiveAxis five_axis = MakeFiveAxis(TrunnionBC(P, P));
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d point = P + random.InBox(250.0);  // w + q
    const double length = random.Uniform(0.0, 300.0);
    JointVector q = JointVector::Zero(5);
    q[3] = random.Uniform(-35.0, 120.0) * kDeg;
    q[4] = random.Uniform(-13320.0, 13320.0) * kDeg;
    five_axis.SolveLinear(point, length, &q);
    const Eigen::Vector3d M =
        P + Ry(-q[3]) * Rz(-q[4]) * (point - P) + Eigen::Vector3d(0.0, 0.0, length);
    EXPECT_LT((q.head<3>() - M).norm(), 1e-10);
  }
}

TEST(FiveAxisTest, SpindleInTableIsTheTreesPose) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.5), random.Chance(0.5)});
    const FiveAxis five_axis = MakeFiveAxis(machine);
    const JointVector q = RandomPosition(&random, machine.tree);
    const Eigen::Isometry3d X_BS = machine.tree.Pose(machine.table_link, q).inverse() *
                                   machine.tree.Pose(machine.spindle_link, q);
    EXPECT_TRUE(five_axis.SpindleInTable(q).isApprox(X_BS, 1e-9));
    Eigen::Vector3d p_BT_B;
    Eigen::Vector3d u_B;
    five_axis.TipInTable(q, 123.0, &p_BT_B, &u_B);
    EXPECT_LT((p_BT_B - X_BS * Eigen::Vector3d(0, 0, 123.0)).norm(), 1e-9);
    EXPECT_LT((u_B + X_BS.linear().col(2)).norm(), 1e-12);
  }
}

/// Checks that every solution reaches `u_B`, and with SolveLinear `p_BT_B`.
void ExpectReached(const FiveAxis& five_axis, const Eigen::Vector3d& p_BT_B,
                   const Eigen::Vector3d& u_B, const std::vector<RotarySolution>& solutions,
                   JointVector q) {
  for (const RotarySolution& solution : solutions) {
    for (std::size_t k = 0; k < five_axis.rotary().size(); ++k) {
      EXPECT_GT(solution.angles[k], -std::numbers::pi);
      EXPECT_LE(solution.angles[k], std::numbers::pi);
      q[five_axis.rotary()[k]] = solution.angles[k];
    }
    five_axis.SolveLinear(p_BT_B, 150.0, &q);
    Eigen::Vector3d p;
    Eigen::Vector3d u;
    five_axis.TipInTable(q, 150.0, &p, &u);
    EXPECT_LT((p - p_BT_B).norm(), 1e-9);
    EXPECT_LT((u - u_B).norm(), 1e-9);
  }
}

TEST(FiveAxisTest, ForwardOfInverseIsIdentityOverRandomMachines) {
  Random random(6);
  for (int i = 0; i < 4000; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.5), random.Chance(0.5)});
    const FiveAxis five_axis = MakeFiveAxis(machine);
    JointVector q = RandomPosition(&random, machine.tree);
    if (random.Chance(0.3)) {  // near and at the edges: 0, and quarters of a turn
      for (const int k : five_axis.rotary()) {
        const double offset = random.Chance(0.3) ? 0.0 : std::pow(10.0, random.Uniform(-14, -2));
        q[k] = random.Below(4) * 90.0 * kDeg + offset;
      }
    }
    Eigen::Vector3d p_BT_B;
    Eigen::Vector3d u_B;
    five_axis.TipInTable(q, 150.0, &p_BT_B, &u_B);
    const auto solutions = five_axis.SolveRotary(u_B.normalized());
    ASSERT_FALSE(solutions.empty()) << "machine " << i;
    ASSERT_LE(solutions.size(), 2u);
    ExpectReached(five_axis, p_BT_B, u_B, solutions, q);
    // The pose that we came from is one of them, but for whole turns and a free joint.
    bool found = false;
    for (const RotarySolution& solution : solutions) {
      bool same = true;
      for (std::size_t k = 0; k < 2; ++k) {
        if (k == 1 && solution.at_pole) continue;
        const double difference = solution.angles[k] - q[five_axis.rotary()[k]];
        // Close to a double root the tilt is known to the root of the rounding, beside the pole the
        // other joint.
        same = same && std::abs(std::remainder(difference, 2.0 * std::numbers::pi)) < 1e-2;
      }
      found = found || same;
    }
    EXPECT_TRUE(found) << "machine " << i;
  }
}

struct Layout {
  int axes;      // AB, AC, BC
  int on_table;  // rotary axes that carry the table
  bool nutating;
};

class FiveAxisLayoutTest : public testing::TestWithParam<Layout> {};

// FK(IK(x)) = x for tip and tool axis, on every layout by itself.
TEST_P(FiveAxisLayoutTest, ForwardOfInverseIsIdentity) {
  Random random(10);
  for (int i = 0; i < 300; ++i) {
    MachineOptions options;
    options.nutating = GetParam().nutating;
    options.skewed = random.Chance(0.3);
    options.axes = GetParam().axes;
    options.on_table = GetParam().on_table;
    const TestMachine machine = RandomMachine(&random, options);
    const FiveAxis five_axis = MakeFiveAxis(machine);
    int on_table = 0;
    for (const int j : machine.tree.MovingJointsTo(machine.table_link)) {
      on_table += machine.tree.joints()[j].type == JointType::kRevolute;
    }
    ASSERT_EQ(on_table, GetParam().on_table);
    const JointVector q = RandomPosition(&random, machine.tree);
    Eigen::Vector3d p_BT_B;
    Eigen::Vector3d u_B;
    five_axis.TipInTable(q, 150.0, &p_BT_B, &u_B);
    const auto solutions = five_axis.SolveRotary(u_B.normalized());
    ASSERT_FALSE(solutions.empty()) << "machine " << i;
    ExpectReached(five_axis, p_BT_B, u_B, solutions, q);
  }
}

std::vector<Layout> Layouts() {
  std::vector<Layout> layouts;
  for (int i = 0; i < 18; ++i) layouts.push_back({i % 3, i / 3 % 3, i >= 9});
  return layouts;
}

INSTANTIATE_TEST_SUITE_P(Machines, FiveAxisLayoutTest, testing::ValuesIn(Layouts()));

TEST(FiveAxisTest, PoleLeavesTheTableJointFree) {
  const FiveAxis five_axis = MakeFiveAxis(TrunnionBC({0, 0, 0}, {0, 0, 0}));
  const auto at_pole = five_axis.SolveRotary(Eigen::Vector3d::UnitZ());
  ASSERT_EQ(at_pole.size(), 1u);
  EXPECT_TRUE(at_pole[0].at_pole);
  EXPECT_NEAR(at_pole[0].angles[0], 0.0, 1e-15);
  EXPECT_EQ(at_pole[0].angles[1], 0.0);
  // A millionth of a degree beside it C is defined, and exact.
  const double b = 1e-6 * kDeg;
  const auto beside = five_axis.SolveRotary({0.0, std::sin(b), std::cos(b)});
  ASSERT_EQ(beside.size(), 2u);
  EXPECT_FALSE(beside[0].at_pole);
  EXPECT_NEAR(beside[0].angles[0], b, 1e-15);
  EXPECT_NEAR(beside[0].angles[1], 90.0 * kDeg, 1e-7);  // 1e-16 of rounding over sin b
}

// A nutating head at 45 degrees reaches the horizontal at half a turn of its oblique axis and
// nothing below: the tool's angle from the vertical is at most twice the axis's.
TEST(FiveAxisTest, NutatingAxisReachesTheHorizontalAndNoFarther) {
  MachineBuilder builder;
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  int link = builder.Add(0, "X", JointType::kPrismatic, Eigen::Vector3d::UnitX(), X);
  link = builder.Add(link, "Y", JointType::kPrismatic, Eigen::Vector3d::UnitY(), X);
  link = builder.Add(link, "Z", JointType::kPrismatic, Eigen::Vector3d::UnitZ(), X);
  link = builder.Add(link, "C", JointType::kRevolute, Eigen::Vector3d::UnitZ(), X);
  link = builder.Add(link, "B", JointType::kRevolute, {0, 1, 1}, At({0, 50, 0}));
  link =
      builder.Add(link, "S", JointType::kFixed, Eigen::Vector3d::UnitX(), Downward({0, 80, -200}));
  const auto five_axis = FiveAxis::Make(builder.Build(), link, 0);
  ASSERT_TRUE(five_axis.has_value());
  EXPECT_EQ(five_axis->rotary(), (std::vector<int>{4, 3}));
  const auto horizontal = five_axis->SolveRotary(Eigen::Vector3d::UnitX());
  ASSERT_FALSE(horizontal.empty());
  EXPECT_NEAR(std::abs(horizontal[0].angles[0]), std::numbers::pi, 1e-7);
  EXPECT_TRUE(five_axis->SolveRotary(Eigen::Vector3d(1.0, 0.0, -1e-6).normalized()).empty());
  EXPECT_EQ(five_axis->SolveRotary(Eigen::Vector3d(1.0, 0.0, 1e-6).normalized()).size(), 2u);
}

TEST(FiveAxisTest, OneRotaryAndNone) {
  MachineBuilder builder;
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  int link = builder.Add(0, "X", JointType::kPrismatic, Eigen::Vector3d::UnitX(), X);
  link = builder.Add(link, "Y", JointType::kPrismatic, Eigen::Vector3d::UnitY(), X);
  link = builder.Add(link, "Z", JointType::kPrismatic, Eigen::Vector3d::UnitZ(), X);
  builder.Add(link, "S", JointType::kFixed, Eigen::Vector3d::UnitX(), Downward({0, 0, 0}));
  builder.Add(0, "A", JointType::kRevolute, -Eigen::Vector3d::UnitX(), At({1, 2, 3}));
  builder.Add(0, "C", JointType::kRevolute, -Eigen::Vector3d::UnitZ(), At({4, 5, 6}));
  const KinematicTree tree = builder.Build();
  const int spindle = tree.FindLink("S_link");
  const int a = tree.FindLink("A_link");
  const int c = tree.FindLink("C_link");

  const auto three = FiveAxis::Make(tree, spindle, 0);
  ASSERT_TRUE(three.has_value());
  EXPECT_TRUE(three->rotary().empty());
  EXPECT_EQ(three->SolveRotary(Eigen::Vector3d::UnitZ()).size(), 1u);
  EXPECT_TRUE(three->SolveRotary(Eigen::Vector3d(1e-6, 0, 1).normalized()).empty());

  const auto four = FiveAxis::Make(tree, spindle, a);
  ASSERT_TRUE(four.has_value());
  JointVector q = JointVector::Zero(5);
  q[3] = 0.7;
  const Eigen::Vector3d u = ToolAxis(*four, q);
  const auto tilted = four->SolveRotary(u);
  ASSERT_EQ(tilted.size(), 1u);
  EXPECT_NEAR(tilted[0].angles[0], 0.7, 1e-14);
  EXPECT_FALSE(tilted[0].at_pole);
  ExpectReached(*four, {10, 20, 30}, u, tilted, q);
  EXPECT_TRUE(four->SolveRotary(Eigen::Vector3d(0.1, 0, 1).normalized()).empty());

  const auto turntable = FiveAxis::Make(tree, spindle, c);
  ASSERT_TRUE(turntable.has_value());
  const auto free = turntable->SolveRotary(Eigen::Vector3d::UnitZ());
  ASSERT_EQ(free.size(), 1u);
  EXPECT_TRUE(free[0].at_pole);
  EXPECT_TRUE(turntable->SolveRotary(Eigen::Vector3d::UnitX()).empty());
}

/// X and Z move the ram of a head that B swivels; the ram's `ram_axis` is at B0. Table fixed.
std::optional<FiveAxis> SwivelledRam(const Eigen::Vector3d& ram_axis) {
  MachineBuilder builder;
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  int link = builder.Add(0, "X", JointType::kPrismatic, Eigen::Vector3d::UnitX(), X);
  link = builder.Add(link, "Z", JointType::kPrismatic, Eigen::Vector3d::UnitZ(), X);
  link = builder.Add(link, "B", JointType::kRevolute, Eigen::Vector3d::UnitY(), X);
  link = builder.Add(link, "ram", JointType::kPrismatic, ram_axis, X);
  link = builder.Add(link, "S", JointType::kFixed, Eigen::Vector3d::UnitX(), Downward({0, 0, 0}));
  return FiveAxis::Make(builder.Build(), link, 0);
}

TEST(FiveAxisTest, MakeRefusesWhatItCannotSolve) {
  EXPECT_TRUE(SwivelledRam(Eigen::Vector3d::UnitY()).has_value());  // a quill along the swivel axis
  EXPECT_FALSE(SwivelledRam(Eigen::Vector3d::UnitX()).has_value());  // dependent
  EXPECT_FALSE(SwivelledRam({0, 1, 1}).has_value());                 // turned by B against X and Z
  const TestMachine machine = TrunnionBC({0, 0, 0}, {0, 0, 0});
  EXPECT_FALSE(FiveAxis::Make(machine.tree, 0, machine.table_link).has_value());  // no linear joint
}

TEST(FiveAxisTest, QuillAlongTheSwivelAxisIsSolved) {
  const auto five_axis = SwivelledRam(Eigen::Vector3d::UnitY());
  ASSERT_TRUE(five_axis.has_value());
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    JointVector q(4);
    q << random.Uniform(-9, 9), random.Uniform(-9, 9), random.Uniform(-3, 3), random.Uniform(-9, 9);
    Eigen::Vector3d p_BT_B;
    Eigen::Vector3d u_B;
    five_axis->TipInTable(q, 50.0, &p_BT_B, &u_B);
    JointVector solved = q;
    solved[0] = solved[1] = solved[3] = 0.0;
    five_axis->SolveLinear(p_BT_B, 50.0, &solved);
    EXPECT_LT((solved - q).norm(), 1e-10);
  }
}

/// Distance of a point fixed in S from the axis of moving joint `index`, by the tree alone.
double DistanceFromJoint(const TestMachine& machine, const JointVector& q, int index,
                         const Eigen::Vector3d& p_S, Eigen::Vector3d* axis_M) {
  const Joint& joint = machine.tree.joints()[machine.tree.moving_joints()[index]];
  const Eigen::Isometry3d X_MJ = machine.tree.Pose(joint.parent_link, q) * joint.X_PJ;
  *axis_M = X_MJ.linear() * joint.axis;
  const Eigen::Vector3d p_M = machine.tree.Pose(machine.spindle_link, q) * p_S;
  return axis_M->cross(p_M - X_MJ.translation()).norm();
}

TEST(FiveAxisTest, RadiiAreTheDistancesInTheTree) {
  Random random(8);
  for (int i = 0; i < 1000; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.5), random.Chance(0.5)});
    const FiveAxis five_axis = MakeFiveAxis(machine);
    const JointVector q = RandomPosition(&random, machine.tree);
    const double length = random.Uniform(0.0, 300.0);
    const Eigen::Vector3d v_S = random.InBox(200.0);
    Eigen::Vector3d p_BT_B;
    Eigen::Vector3d u_B;
    five_axis.TipInTable(q, length, &p_BT_B, &u_B);
    const auto tip_radii = five_axis.TipRadii(p_BT_B, length, q);
    const auto radii = five_axis.RadiiAboutTip(v_S, q);
    const FiveAxis::ToolPose pose = five_axis.ToolInTable(q, length);
    const auto about_tip = five_axis.RadiiAboutTip(Eigen::Vector3d::UnitZ(), q);
    const Eigen::Isometry3d X_BS = five_axis.SpindleInTable(q);
    EXPECT_LE((pose.tip - X_BS * Eigen::Vector3d(0.0, 0.0, length)).norm(), 1e-9);
    EXPECT_LE((pose.axis + X_BS.linear().col(2)).norm(), 1e-12);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(pose.radii[k], about_tip[k], 1e-12);
    const Eigen::Matrix3d R_MS = machine.tree.Pose(machine.spindle_link, q).linear();
    for (std::size_t k = 0; k < 2; ++k) {
      Eigen::Vector3d axis_M;
      EXPECT_NEAR(tip_radii[k],
                  DistanceFromJoint(machine, q, five_axis.rotary()[k], {0, 0, length}, &axis_M),
                  1e-9);
      EXPECT_NEAR(radii[k], axis_M.cross(R_MS * v_S).norm(), 1e-9);
    }
  }
}

TEST(FiveAxisTest, LinearGainIsOneForSquareAxes) {
  Random random(9);
  const FiveAxis square = MakeFiveAxis(RandomMachine(&random));
  EXPECT_TRUE(square.linear_square());
  EXPECT_LT((square.linear_gain() - Eigen::Vector3d::Ones()).norm(), 1e-12);
  const FiveAxis skewed = MakeFiveAxis(RandomMachine(&random, {false, true}));
  EXPECT_FALSE(skewed.linear_square());
  EXPECT_GT(skewed.linear_gain().maxCoeff(), 1.0);
}

}  // namespace
}  // namespace ncsim::kinematics
