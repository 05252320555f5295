// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/top_speed.h"

#include <gtest/gtest.h>

#include "sim/motion/test_motions.h"

namespace ncsim::motion {
namespace {

using kinematics::FiveAxis;

constexpr int kSteps = 2000;

struct Dense {
  JointVector speed, acceleration;  ///< Greatest, by sampling; per unit of s.
};
Dense Sample(const Motion& motion) {
  Dense dense{JointVector::Zero(motion.q0().size()), JointVector::Zero(motion.q0().size())};
  JointVector before = JointVector::Zero(motion.q0().size());
  for (int i = 0; i < kSteps; ++i) {
    const JointVector from = motion.At(static_cast<double>(i) / kSteps);
    const JointVector to = motion.At(static_cast<double>(i + 1) / kSteps);
    const JointVector speed = (to - from) * kSteps;
    dense.speed = dense.speed.cwiseMax(speed.cwiseAbs());
    if (i > 0) {
      dense.acceleration = dense.acceleration.cwiseMax((speed - before).cwiseAbs() * kSteps);
    }
    before = speed;
  }
  return dense;
}

// The mean over a piece hides no more of the speed than it changes in half of it.
TEST(TopSpeedTest, IsThatOfDenseSampling) {
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const TestMachine machine = kinematics::TrunnionBC({0, 0, -50}, {0, 0, 0});
    const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(metal.has_value());
    const auto frame = std::make_shared<TcpFrame>(TcpFrame{*metal, 120.0, 0.0});
    const PathKind kind = i % 2 == 0 ? PathKind::kTcpLine : PathKind::kAxisLinear;
    const Motion motion = RandomMotion(&random, kind, machine, frame, random.Uniform(0.001, 0.6));
    const Dense dense = Sample(motion);
    const JointVector said = TravelAtTopSpeed(motion);
    double turn = 0.0;
    for (const int joint : metal->rotary()) {
      turn = std::max(turn, std::abs(motion.q1()[joint] - motion.q0()[joint]));
    }
    const double piece = std::min(1.0, (5.0 * std::numbers::pi / 180.0) / turn);
    for (Eigen::Index k = 0; k < said.size(); ++k) {
      EXPECT_LE(said[k], dense.speed[k] + 1e-6) << "case " << i << " joint " << k;
      EXPECT_GE(said[k], dense.speed[k] - 0.5 * piece * dense.acceleration[k] - 1e-4)
          << "case " << i << " joint " << k;
    }
  }
}

// C by 90 degrees with the tip at rest, 100 mm from its axis: X and Y go along a circle, at their
// fastest where they cross the axis: 100 * pi / 2.
TEST(TopSpeedTest, OfACircle) {
  const TestMachine machine = kinematics::TrunnionBC({0, 0, 0}, {0, 0, 0});
  const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  TcpCurve curve;
  curve.frame = std::make_shared<TcpFrame>(TcpFrame{*metal, 120.0, 0.0});
  curve.q0 = curve.q1 = JointVector::Zero(5);
  curve.q1[4] = std::numbers::pi / 2;
  curve.p0_B = curve.p1_B = {100.0, 0.0, 0.0};
  curve.centre = curve.e1 = curve.e2 = curve.pitch = curve.end_error = Eigen::Vector3d::Zero();
  metal->SolveLinear(curve.p0_B, 120.0, &curve.q0);
  metal->SolveLinear(curve.p1_B, 120.0, &curve.q1);
  const JointVector said = TravelAtTopSpeed(MakeMotion(curve));
  EXPECT_NEAR(said[0], 100.0 * std::numbers::pi / 2, 0.4);
  EXPECT_NEAR(said[1], 100.0 * std::numbers::pi / 2, 0.4);
  EXPECT_NEAR(said[4], std::numbers::pi / 2, 1e-12);
}

}  // namespace
}  // namespace ncsim::motion
