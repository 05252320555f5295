// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/great_circle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinematics/reachable.h"
#include "kinematics/test_machines.h"

namespace ncsim::kinematics {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
using Angles = std::array<double, 2>;
using Fault = GreatCircle::Fault;

FiveAxis MakeFiveAxis(const TestMachine& machine) {
  return *FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
}

Eigen::Vector3d ToolAxis(const FiveAxis& five_axis, const Angles& angles, int joints) {
  JointVector q = JointVector::Zero(joints);
  for (std::size_t k = 0; k < 2; ++k) q[five_axis.rotary()[k]] = angles[k];
  Eigen::Vector3d tip, u;
  five_axis.TipInTable(q, 0.0, &tip, &u);
  return u;
}

class BcTable : public ::testing::Test {
 protected:
  Fault Make(double b0, double c0, double b1, double c1) {
    return GreatCircle::Make(five_axis_, {b0 * kDeg, c0 * kDeg}, {b1 * kDeg, c1 * kDeg}, &circle_);
  }
  Angles At(double s) const {
    const Angles angles = circle_.RotaryAt(s);
    return {angles[0] / kDeg, angles[1] / kDeg};
  }

  FiveAxis five_axis_ = MakeFiveAxis(TrunnionBC({1, 2, 3}, {4, 5, 6}));
  GreatCircle circle_;
};

// The middle of u0 = (sin 60, 0, cos 60) and u1 = (0, sin 60, cos 60) is (u0 + u1) / |u0 + u1|:
// B = atan2(sin 60 / sqrt 2, cos 60) = 50.7685, C45. (Axis interpolation: B60 C45.)
TEST_F(BcTable, MiddleOfB60C0ToB60C90) {
  ASSERT_EQ(Make(60, 0, 60, 90), Fault::kNone);
  EXPECT_NEAR(At(0.5)[0], std::atan2(std::sin(60 * kDeg) / std::sqrt(2.0), 0.5) / kDeg, 1e-12);
  EXPECT_NEAR(At(0.5)[0], 50.7685, 5e-5);
  EXPECT_NEAR(At(0.5)[1], 45.0, 1e-12);
  EXPECT_EQ(circle_.RotaryAt(0.0), (Angles{60 * kDeg, 0.0}));
  EXPECT_EQ(circle_.RotaryAt(1.0), (Angles{60 * kDeg, 90 * kDeg}));
  const auto ranges = circle_.RotaryOver(0.0, 1.0);  // B dips
  EXPECT_NEAR(ranges[0].lower / kDeg, At(0.5)[0], 1e-9);
  EXPECT_NEAR(ranges[0].upper / kDeg, 60.0, 1e-9);
}

TEST_F(BcTable, CGoesOnPast360) {
  ASSERT_EQ(Make(54, 359.99503, 54, 0.00926), Fault::kNone);
  EXPECT_NEAR(circle_.end()[1] / kDeg, 360.00926, 1e-9);
  ASSERT_EQ(Make(54, 0.19051, 54, 359.92337), Fault::kNone);
  EXPECT_NEAR(circle_.end()[1] / kDeg, -0.07663, 1e-9);
}

TEST_F(BcTable, FromAndToThePoleTheSecondJointStays) {
  ASSERT_EQ(Make(30, 70, 0, 0), Fault::kNone);
  EXPECT_NEAR(At(0.5)[0], 15.0, 1e-12);
  for (const double s : {0.0, 0.3, 0.999999999, 1.0}) EXPECT_NEAR(At(s)[1], 70.0, 1e-9) << s;
  // From the pole it must stand where the circle leads.
  ASSERT_EQ(Make(0, 100, 30, 70), Fault::kNone);
  EXPECT_NEAR(circle_.start()[1] / kDeg, 70.0, 1e-9);
  for (const double s : {0.0, 1e-9, 0.5, 1.0}) EXPECT_NEAR(At(s)[1], 70.0, 1e-9) << s;
  ASSERT_EQ(Make(0, 400, 30, 70), Fault::kNone);
  EXPECT_NEAR(circle_.start()[1] / kDeg, 430.0, 1e-9);
  ASSERT_EQ(Make(0, 0, -30, 70), Fault::kNone);
  EXPECT_NEAR(At(0.5)[0], -15.0, 1e-12);
}

TEST_F(BcTable, WhatCannotBeLedIsRefused) {
  EXPECT_EQ(Make(30, 0, 30, 0), Fault::kNoTurn);
  EXPECT_EQ(Make(0, 0, 0, 90), Fault::kNoTurn);
  EXPECT_EQ(Make(90, 0, 90, 180), Fault::kOpposite);
  EXPECT_EQ(Make(30, 0, -20, 0), Fault::kThroughPole);
  EXPECT_EQ(Make(30, 0, 20, 180), Fault::kThroughPole);
  EXPECT_EQ(Make(30, 0, -40, 100), Fault::kOtherBranch);
  const TestMachine machine = TrunnionBC({0, 0, 0}, {0, 0, 0});
  const auto four =
      FiveAxis::Make(machine.tree, machine.spindle_link, machine.tree.FindLink("B_link"));
  ASSERT_TRUE(four.has_value());
  EXPECT_EQ(GreatCircle::Make(*four, {0, 0}, {1, 0}, &circle_), Fault::kNotTwoAxes);
}

// A millionth of a degree beside the pole C swings by 180 degrees, and the tool axis stays on its
// circle.
TEST_F(BcTable, BesideThePoleTheSecondJointSwings) {
  const double beside = 1e-6;
  const double b = 20.0;
  const double c = std::asin(std::sin(beside * kDeg) / std::sin(b * kDeg)) / kDeg;
  ASSERT_EQ(Make(b, c, b, 180.0 - c), Fault::kNone);
  double least = 90.0;
  for (int i = 0; i <= 1000; ++i) {
    const double s = 0.5 + 1e-6 * (i - 500) / 500.0;
    const Angles angles = circle_.RotaryAt(s);
    least = std::min(least, angles[0] / kDeg);
    EXPECT_LT((ToolAxis(five_axis_, angles, 5) - circle_.AxisAt(s)).norm(), 1e-14);
  }
  EXPECT_GT(least, 0.9 * beside);
  EXPECT_LT(least, 1.1 * beside);
  const auto ranges = circle_.RotaryOver(0.499999, 0.500001);
  EXPECT_GT((ranges[1].upper - ranges[1].lower) / kDeg, 170.0);
}

// From B b C0 to B b C2g the circle's middle is nearest to the pole: tan alpha0 = tan b cos g. From
// B30 C0 to B50 C0 the end at B30 is.
TEST_F(BcTable, AngleFromPole) {
  const auto angle = [&](double b0, double c0, double b1, double c1) {
    return AngleFromPole(five_axis_, {b0 * kDeg, c0 * kDeg}, {b1 * kDeg, c1 * kDeg}) / kDeg;
  };
  for (const double g : {10.0, 45.0, 80.0, 89.9}) {
    EXPECT_NEAR(angle(20, 0, 20, 2 * g), std::atan(std::tan(20 * kDeg) * std::cos(g * kDeg)) / kDeg,
                1e-9);
  }
  EXPECT_NEAR(angle(30, 0, 50, 0), 30.0, 1e-9);
  EXPECT_NEAR(angle(30, 7, -20, 7), 0.0, 1e-6);
  EXPECT_NEAR(angle(0, 0, 20, 7), 0.0, 1e-6);
  EXPECT_NEAR(angle(0, 0, 0, 90), 0.0, 1e-6);
  EXPECT_NEAR(angle(175, 0, 170, 0), 5.0, 1e-9);
}

// The least over ten thousand places of the arc.
TEST_F(BcTable, AngleFromPoleAgainstSamples) {
  Random random(52);
  for (int i = 0; i < 200; ++i) {
    const Angles from{random.Uniform(-1.5, 1.5), random.Uniform(-7.0, 7.0)};
    const Angles to{random.Uniform(-1.5, 1.5), random.Uniform(-7.0, 7.0)};
    const Eigen::Vector3d u0 = ToolAxis(five_axis_, from, 5);
    const Eigen::Vector3d u1 = ToolAxis(five_axis_, to, 5);
    double least = 2.0;
    for (int j = 0; j <= 10'000; ++j) {
      // Not at constant speed, and over the same arc.
      const Eigen::Vector3d u = (std::lerp(1.0, 0.0, j * 1e-4) * u0 + j * 1e-4 * u1).normalized();
      least = std::min(least, std::atan2(std::hypot(u.x(), u.y()), std::abs(u.z())));
    }
    EXPECT_NEAR(AngleFromPole(five_axis_, from, to), least, 2e-3);
    EXPECT_LT(AngleFromPole(five_axis_, from, to), least + 1e-9);
  }
}

/// The tool axis is on the great circle (closed form: sin((1 - s) a) u0 + sin(s a) u1 over sin a),
/// and the joints stay within RotaryOver of a random stretch.
void ExpectFollows(const FiveAxis& five_axis, const GreatCircle& circle, const Angles& from,
                   const Angles& to, Random* random) {
  const Eigen::Vector3d u0 = ToolAxis(five_axis, from, 5);
  const Eigen::Vector3d u1 = ToolAxis(five_axis, to, 5);
  const double angle = std::atan2(u0.cross(u1).norm(), u0.dot(u1));
  EXPECT_NEAR(circle.angle(), angle, 1e-12);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::remainder(circle.end()[k] - to[k], 2.0 * std::numbers::pi), 0.0, 1e-9);
  }
  const double s0 = random->Uniform(0.0, 1.0);
  const double s1 = std::min(1.0, s0 + std::pow(10.0, random->Uniform(-6.0, 0.0)));
  const auto ranges = circle.RotaryOver(s0, s1);
  for (int j = 0; j <= 40; ++j) {
    const double s = std::lerp(s0, s1, j / 40.0);
    const Eigen::Vector3d u =
        (std::sin((1.0 - s) * angle) * u0 + std::sin(s * angle) * u1) / std::sin(angle);
    const Angles angles = circle.RotaryAt(s);
    EXPECT_LT((ToolAxis(five_axis, angles, 5) - u).norm(), 2e-9) << s;
    EXPECT_LT((circle.AxisAt(s) - u).norm(), 1e-9);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_GE(angles[k], ranges[k].lower) << s;
      EXPECT_LE(angles[k], ranges[k].upper) << s;
    }
  }
}

struct Layout {
  int axes;
  int on_table;
  bool nutating;
};

class EveryLayout : public ::testing::TestWithParam<Layout> {};

// Over random machines of the layout and random ends. The ranges shrink with the stretch: so the
// joints are continuous.
TEST_P(EveryLayout, FollowsTheCircleAndStaysInItsRanges) {
  Random random(41);
  int made = 0;
  double widest = 0.0;
  for (int i = 0; i < 300; ++i) {
    MachineOptions options;
    options.axes = GetParam().axes;
    options.on_table = GetParam().on_table;
    options.nutating = GetParam().nutating;
    const TestMachine machine = RandomMachine(&random, options);
    const FiveAxis five_axis = MakeFiveAxis(machine);
    const Angles from{random.Uniform(-7.0, 7.0), random.Uniform(-7.0, 7.0)};
    const double size = std::pow(10.0, random.Uniform(-4.0, 0.3));
    const Angles to{from[0] + random.Uniform(-size, size), from[1] + random.Uniform(-size, size)};
    GreatCircle circle;
    const Fault fault = GreatCircle::Make(five_axis, from, to, &circle);
    if (fault != Fault::kNone) continue;
    ++made;
    EXPECT_EQ(circle.start(), from);
    ExpectFollows(five_axis, circle, from, to, &random);
    // Away from the pole a millionth of the way turns no joint by much.
    const double s0 = random.Uniform(0.0, 1.0);
    const auto little = circle.RotaryOver(s0, std::min(1.0, s0 + 1e-6));
    widest = std::max(widest, little[1].upper - little[1].lower);
  }
  EXPECT_GT(made, 150);
  EXPECT_LT(widest, 0.01);
}

std::vector<Layout> Layouts() {
  std::vector<Layout> layouts;
  for (int axes = 0; axes < 3; ++axes) {
    for (int on_table = 0; on_table < 3; ++on_table) {
      layouts.push_back({axes, on_table, false});
      layouts.push_back({axes, on_table, true});
    }
  }
  return layouts;
}

// Rotary axes and tool in any directions to each other: tools that reach all round the pole, that
// stay away from it, and that cannot get to the far side.
TEST(GreatCircleTest, AnyAxes) {
  Random random(42);
  int made = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    MachineBuilder builder;
    const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    int link = builder.Add(0, "X", JointType::kPrismatic, Eigen::Vector3d::UnitX(), X);
    link = builder.Add(link, "Y", JointType::kPrismatic, Eigen::Vector3d::UnitY(), X);
    link = builder.Add(link, "Z", JointType::kPrismatic, Eigen::Vector3d::UnitZ(), X);
    link = builder.Add(link, "other", JointType::kRevolute, random.Direction(), X);
    link = builder.Add(link, "tilt", JointType::kRevolute, random.Direction(), X);
    link = builder.Add(link, "S", JointType::kFixed, Eigen::Vector3d::UnitX(), Downward({0, 0, 0}));
    const auto five_axis = FiveAxis::Make(builder.Build(), link, 0);
    ASSERT_TRUE(five_axis.has_value());
    const Angles from{random.Uniform(-7.0, 7.0), random.Uniform(-7.0, 7.0)};
    const Angles to{from[0] + random.Uniform(-2.0, 2.0), from[1] + random.Uniform(-2.0, 2.0)};
    GreatCircle circle;
    const Fault fault = GreatCircle::Make(*five_axis, from, to, &circle);
    if (fault == Fault::kNone) {
      ++made;
      ExpectFollows(*five_axis, circle, from, to, &random);
    }
    refused += fault == Fault::kUnreachable;
  }
  EXPECT_GT(made, 1000);
  EXPECT_GT(refused, 100);
}

std::string LayoutName(const ::testing::TestParamInfo<Layout>& test) {
  constexpr std::array<const char*, 3> kAxes = {"AB", "AC", "BC"};
  constexpr std::array<const char*, 3> kKinds = {"HeadHead", "HeadTable", "TableTable"};
  return std::string(kKinds.at(static_cast<std::size_t>(test.param.on_table))) +
         kAxes.at(static_cast<std::size_t>(test.param.axes)) +
         (test.param.nutating ? "Nutating" : "");
}

INSTANTIATE_TEST_SUITE_P(Machines, EveryLayout, ::testing::ValuesIn(Layouts()), LayoutName);

}  // namespace
}  // namespace ncsim::kinematics
