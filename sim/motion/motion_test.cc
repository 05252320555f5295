// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <type_traits>

#include "sim/motion/test_motions.h"

namespace ncsim::motion {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

JointVector Vector(std::initializer_list<double> values) {
  JointVector v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.data());
  return v;
}

std::shared_ptr<const TcpFrame> MakeFrame(const TestMachine& machine, double length) {
  return std::make_shared<TcpFrame>(
      TcpFrame{*kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link),
               length, 0.0});
}

/// X 100 mm at 50 mm/s and Y 30 mm at 50 mm/s, both with 100 mm/s^2.
DogLeg TwoAxes() {
  return {Vector({0, 0}), Vector({100, -30}), Vector({2.0, 0.6}), Vector({0.5, 0.5})};
}

/// s of `path` at `time` and `lag`, by bisection of ElapsedTime.
double AtTime(const Motion& motion, double time, double lag) {
  double below = 0.0;
  double above = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double s = 0.5 * (below + above);
    (motion.ElapsedTime(s, lag) < time ? below : above) = s;
  }
  return 0.5 * (below + above);
}

TEST(MotionTest, KindsHaveTheWordsOfTheTrace) {
  EXPECT_EQ(motion::ToString(MotionKind::kRapid), "rapid");
  EXPECT_EQ(motion::ToString(MotionKind::kFeed), "feed");
  EXPECT_EQ(motion::ToString(MotionKind::kArc), "arc");
  EXPECT_EQ(motion::ToString(MotionKind::kDwell), "dwell");
  EXPECT_EQ(motion::ToString(MotionKind::kToolChange), "toolchange");
}

TEST(MotionTest, AxisLinearKeepsProportionAndHitsItsEnds) {
  Motion motion = MakeMotion(AxisLinear{Vector({0.1, 2.0}), Vector({0.3, 2.0})});
  motion.duration = 8.0;
  EXPECT_EQ(motion.At(0.0), motion.q0());
  EXPECT_EQ(motion.At(1.0), motion.q1());
  EXPECT_NEAR(motion.At(0.25)[0], 0.15, 1e-15);
  EXPECT_EQ(motion.At(0.25)[1], 2.0);
  EXPECT_EQ(motion.ElapsedTime(0.25), 2.0);
  EXPECT_EQ(Whole(motion).lag1, 0.0);
}

// Trapezoid: v^2 / 2a = 12.5 mm in the ramp of 0.5 s, 75 mm at 50 mm/s, 12.5 mm: 2.5 s.
TEST(DogLegTest, TrapezoidOfTheTextbook) {
  const Motion motion = MakeMotion(TwoAxes());
  EXPECT_DOUBLE_EQ(Duration(TwoAxes()), 2.5);
  EXPECT_DOUBLE_EQ(Duration(TwoAxes(), 0.0), 2.0);
  const double expected[][3] = {
      // t, X, Y: Y ramps to 50 mm/s (12.5 mm), 5 mm at it, 12.5 mm; it arrives at 1.1 s
      {0.0, 0.0, 0.0},    {0.25, 3.125, -3.125}, {0.5, 12.5, -12.5},
      {0.6, 17.5, -17.5}, {0.85, 30.0, -26.875}, {1.1, 42.5, -30.0},
      {2.0, 87.5, -30.0}, {2.25, 96.875, -30.0}, {2.5, 100.0, -30.0},
  };
  for (const auto& row : expected) {
    const JointVector q = motion.At(AtTime(motion, row[0], 1.0), 1.0);
    EXPECT_NEAR(q[0], row[1], 1e-9) << row[0];
    EXPECT_NEAR(q[1], row[2], 1e-9) << row[0];
  }
}

// 8 mm at 100 mm/s^2 never reaches 50 mm/s: 4 mm up, 4 mm down, sqrt(2 * 4 / 100) s each.
TEST(DogLegTest, ShortWayIsATriangle) {
  const DogLeg path{Vector({0}), Vector({8}), Vector({0.16}), Vector({0.5})};
  const double half = std::sqrt(0.08);
  EXPECT_DOUBLE_EQ(Duration(path), 2.0 * half);
  const Motion motion = MakeMotion(path);
  EXPECT_NEAR(motion.At(AtTime(motion, half, 1.0), 1.0)[0], 4.0, 1e-9);
  EXPECT_NEAR(motion.At(AtTime(motion, 0.5 * half, 1.0), 1.0)[0], 1.0, 1e-9);
  EXPECT_NEAR(motion.At(AtTime(motion, 1.5 * half, 1.0), 1.0)[0], 7.0, 1e-9);
}

TEST(DogLegTest, NoLagIsThePolyline) {
  const Motion motion = MakeMotion(TwoAxes());
  for (double s = 0.0; s <= 1.0; s += 0.01) {
    const JointVector q = motion.At(s, 0.0);
    EXPECT_NEAR(q[1], -std::min(30.0, q[0]), 1e-12);
  }
}

TEST(DogLegTest, EndsAreExactAtEveryLag) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const TestMachine machine = RandomMachine(&random);
    const JointVector q0 = RandomPosition(&random, machine.tree);
    const double scale = std::pow(10.0, random.Uniform(-4.0, 0.0));
    const Motion motion = MakeMotion(
        RandomDogLeg(&random, machine.tree, q0, Nudge(&random, machine.tree, q0, scale)));
    const double lag = random.Chance(0.3) ? random.Below(2) : random.Uniform(0.0, 1.0);
    EXPECT_EQ(motion.At(0.0, lag), motion.q0());
    EXPECT_EQ(motion.At(1.0, lag), motion.q1());
    EXPECT_EQ(motion.ElapsedTime(0.0, lag), 0.0);
    EXPECT_NEAR(motion.ElapsedTime(1.0, lag), Duration(std::get<DogLeg>(motion.path), lag), 1e-12);
  }
}

// Rate and acceleration are never exceeded, and time-optimal: each axis is at the bang-bang
// profile's place.
TEST(DogLegTest, ProfileIsThatOfAnAxisDrivenStepByStep) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const double way = random.Uniform(0.5, 100.0);
    const double rate = random.Uniform(20.0, 200.0);
    const double ramp = random.Uniform(0.05, 0.6);
    const double lag = random.Uniform(0.05, 1.0);
    const double acceleration = rate / (ramp * lag);
    const Motion motion =
        MakeMotion(DogLeg{Vector({0}), Vector({way}), Vector({way / rate}), Vector({ramp})});
    const double total = Duration(std::get<DogLeg>(motion.path), lag);
    const double time = random.Uniform(0.0, total);
    double x = 0.0;
    double v = 0.0;
    constexpr int kSteps = 5000;
    for (int k = 0; k < kSteps; ++k) {
      const double dt = time / kSteps;
      const double braking = std::sqrt(2.0 * acceleration * std::max(0.0, way - x));
      v = std::min({v + acceleration * dt, rate, braking});
      x += v * dt;
    }
    EXPECT_NEAR(motion.At(AtTime(motion, time, lag), lag)[0], x, 2e-3 * way);
  }
}

TEST(DogLegTest, LagIsNeededOnlyWhereItChangesThePath) {
  DogLeg path = TwoAxes();
  EXPECT_EQ(Whole(MakeMotion(path)).lag1, 1.0);
  path.q1[1] = path.q0[1];  // one axis alone
  path.duration[1] = 0.0;
  EXPECT_EQ(Whole(MakeMotion(path)).lag1, 0.0);
  path = TwoAxes();  // a group of setting 335 LINEAR
  path.duration[1] = path.duration[0];
  EXPECT_EQ(Whole(MakeMotion(path)).lag1, 0.0);
  for (double s = 0.0; s <= 1.0; s += 0.05) {
    for (double lag = 0.0; lag <= 1.0; lag += 0.25) {
      const JointVector q = MakeMotion(path).At(s, lag);
      EXPECT_NEAR(q[1], -0.3 * q[0], 1e-12);
    }
  }
  path.ramp[1] = 0.6;
  EXPECT_EQ(Whole(MakeMotion(path)).lag1, 1.0);
}

// Axes of one rate and acceleration part only near the corner, where the shorter way ends: along
// the long legs poses of the same s lie together whatever the lag.
TEST(DogLegTest, PosesOfTheSameSLieTogether) {
  const Motion motion = MakeMotion(TwoAxes());
  const double middle = AtTime(motion, 1.5, 1.0);
  EXPECT_LT((motion.At(middle, 0.0) - motion.At(middle, 1.0)).norm(), 1e-9);
}

TEST(AxisArcTest, HelixGoesThroughItsQuarters) {
  AxisArc arc;
  arc.q0 = Vector({20, 0, 5, 0});
  arc.q1 = Vector({20, 0, -3, 1});
  arc.centre = {10, 0, 5};
  arc.e1 = {1, 0, 0};
  arc.e2 = {0, 1, 0};
  arc.pitch = {0, 0, -8};
  arc.end_error.setZero();
  arc.radius = 10.0;
  arc.sweep = -2.0 * std::numbers::pi;  // G02, a full turn
  arc.linear = {0, 1, 2};
  const Motion motion = MakeMotion(arc);
  EXPECT_LT((motion.At(0.0) - motion.q0()).norm(), 1e-12);
  EXPECT_LT((motion.At(0.25) - Vector({10, -10, 3, 0.25})).norm(), 1e-12);
  EXPECT_LT((motion.At(0.5) - Vector({0, 0, 1, 0.5})).norm(), 1e-12);
  EXPECT_LT((motion.At(1.0) - motion.q1()).norm(), 1e-12);
}

TEST(TcpCurveTest, TipStaysOnTheLineAndTheRotaryJointsKeepProportion) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.5), random.Chance(0.3)});
    const auto frame = MakeFrame(machine, random.Uniform(50.0, 250.0));
    const Motion motion = RandomMotion(&random, PathKind::kTcpLine, machine, frame, 1.0);
    const auto& curve = std::get<TcpCurve>(motion.path);
    for (double s = 0.0; s <= 1.0; s += 0.125) {
      const JointVector q = motion.At(s);
      Eigen::Vector3d p_BT_B;
      Eigen::Vector3d u_B;
      frame->control.TipInTable(q, frame->length, &p_BT_B, &u_B);
      EXPECT_LT((p_BT_B - (curve.p0_B + s * (curve.p1_B - curve.p0_B))).norm(), 1e-9);
      for (const int k : frame->control.rotary()) {
        EXPECT_NEAR(q[k], curve.q0[k] + s * (curve.q1[k] - curve.q0[k]), 1e-12);
      }
    }
  }
}

// Tilting the tool about its tip from B-20 to B20: X of the machine bulges to L sin(B) while the
// tip rests (head of a BC table: the pivot 200 mm below the tip). M = P + R (w + q - P) + (0, 0,
// L), docs/notation.md.
TEST(TcpCurveTest, LinearJointsBulgeBetweenTheEnds) {
  const TestMachine machine = kinematics::TrunnionBC({0, 0, -200}, {0, 0, -200});
  TcpCurve curve;
  curve.frame = MakeFrame(machine, 100.0);
  curve.p0_B = curve.p1_B = Eigen::Vector3d(0, 0, 0);
  curve.q0 = curve.q1 = JointVector::Zero(5);
  curve.q0[3] = -20.0 * kDeg;
  curve.q1[3] = 20.0 * kDeg;
  const Motion motion = MakeMotion(curve);
  for (double s = 0.0; s <= 1.0; s += 0.1) {
    const double b = (-20.0 + 40.0 * s) * kDeg;
    const JointVector q = motion.At(s);
    EXPECT_NEAR(q[0], -200.0 * std::sin(b), 1e-10);
    EXPECT_NEAR(q[1], 0.0, 1e-10);
    EXPECT_NEAR(q[2], -200.0 + 200.0 * std::cos(b) + 100.0, 1e-10);
  }
}

}  // namespace
}  // namespace ncsim::motion
