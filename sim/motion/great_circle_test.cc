// SPDX-License-Identifier: BSD-3-Clause
// TCP curves whose tool axis goes along a great circle. That their boxes, bounds and totals hold is
// tested with those of the other paths (kTcpCircle in test_motions.h).
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "sim/motion/test_motions.h"
#include "sim/motion/top_speed.h"
#include "sim/motion/travel.h"

namespace ncsim::motion {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

class GreatCircleMotion : public testing::Test {
 protected:
  TcpCurve Curve(double b0, double c0, double b1, double c1) const {
    TcpCurve curve;
    curve.frame = frame_;
    curve.q0 = curve.q1 = JointVector::Zero(5);
    curve.q0.tail<2>() << b0 * kDeg, c0 * kDeg;
    curve.q1.tail<2>() << b1 * kDeg, c1 * kDeg;
    curve.p0_B = Eigen::Vector3d(40, 0, 5);
    curve.p1_B = Eigen::Vector3d(0, 30, 25);
    MakeGreatCircle(&curve);
    EXPECT_NE(curve.great_circle, nullptr);
    return curve;
  }

  const TestMachine machine_ = kinematics::TrunnionBC({0, 0, -500}, {0, 0, -550});
  const kinematics::FiveAxis metal_ =
      *kinematics::FiveAxis::Make(machine_.tree, machine_.spindle_link, machine_.table_link);
  const std::shared_ptr<const TcpFrame> frame_ =
      std::make_shared<TcpFrame>(TcpFrame{metal_, 150.0, 0.0});
};

// At the middle of B60 C0 -> B60 C90: B atan2(sin 60 / sqrt 2, cos 60) = 50.7685, C45, the tip half
// way along its line.
TEST_F(GreatCircleMotion, MiddleOfB60C0ToB60C90) {
  const TcpCurve curve = Curve(60, 0, 60, 90);
  const Motion motion = MakeMotion(curve);
  const JointVector q = motion.At(0.5);
  EXPECT_NEAR(q[3] / kDeg, std::atan2(std::sin(60 * kDeg) / std::sqrt(2.0), 0.5) / kDeg, 1e-12);
  EXPECT_NEAR(q[4] / kDeg, 45.0, 1e-12);
  Eigen::Vector3d tip, axis;
  metal_.TipInTable(q, 150.0, &tip, &axis);
  EXPECT_LT((tip - Eigen::Vector3d(20, 15, 15)).norm(), 1e-9);
  TcpCurve linear = curve;
  linear.great_circle = nullptr;
  EXPECT_NEAR(MakeMotion(linear).At(0.5)[3] / kDeg, 60.0, 1e-12);
  const JointBox box = Box(motion, Span{});
  EXPECT_NEAR(box.lower[3] / kDeg, 50.7685, 1e-4);
  EXPECT_NEAR(box.upper[3] / kDeg, 60.0, 1e-9);
}

// A solid of revolution about the spindle turns with its axis alone: 180 degrees of C beside the
// pole cost it the 20 degrees that its axis goes.
TEST_F(GreatCircleMotion, TotalsOfATurnBesideThePole) {
  const Motion motion = MakeMotion(Curve(10, 0.001, 10, 179.999));
  PairPath pair(machine_.tree, {machine_.spindle_link, {0, 0, 75}, 20.0}, machine_.table_link,
                &metal_);
  pair.revolved = true;
  const Travel travel(machine_.tree, &metal_, 150.0, {&motion});
  const double line = Eigen::Vector3d(40, -30, -20).norm();
  const double chord = 2.0 * std::sin(10.0 * kDeg);
  EXPECT_NEAR(PairTravel(pair, travel).Between(0, 1), line + chord * 95.0, 0.01);
  pair.revolved = false;
  EXPECT_GT(PairTravel(pair, travel).Between(0, 1), line + 190.0);
}

// In the two middle ones of 16 pieces C turns by atan2(tan psi, sin alpha0) each, psi a sixteenth
// of the way and alpha0 the least angle from the pole: tan alpha0 = tan 10 cos 89.5.
TEST_F(GreatCircleMotion, TopSpeedIsWhereCSwings) {
  const Motion motion = MakeMotion(Curve(10, 0, 10, 179));
  const double alpha0 = std::atan(std::tan(10 * kDeg) * std::cos(89.5 * kDeg));
  const double psi = std::get<TcpCurve>(motion.path).great_circle->angle() / 16.0;
  const double turn = std::atan2(std::tan(psi), std::sin(alpha0));
  EXPECT_NEAR(TravelAtTopSpeed(motion)[4], 16.0 * turn, 1e-9);
  EXPECT_GT(16.0 * turn, 7.0 * 179 * kDeg);
}

// The property tests of boxes, bounds and totals mean something: most of their curves are led so.
TEST_F(GreatCircleMotion, RandomMotionsAreGreatCircles) {
  Random random(51);
  int led = 0;
  for (int i = 0; i < 500; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.4), random.Chance(0.3)});
    const auto frame = std::make_shared<TcpFrame>(TcpFrame{
        *kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link), 150.0,
        0.0});
    const Motion motion = RandomMotion(&random, PathKind::kTcpCircle, machine, frame,
                                       std::pow(10.0, random.Uniform(-3.0, 0.0)));
    led += std::get<TcpCurve>(motion.path).great_circle != nullptr;
  }
  EXPECT_GT(led, 350);
}

}  // namespace
}  // namespace ncsim::motion
