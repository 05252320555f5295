// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/units.h"
#include "sim/motion/path.h"
#include "sim/motion/test_motions.h"

namespace ncsim::motion {
namespace {

using kinematics::Extent;
using kinematics::FiveAxis;

constexpr double kRounding = 1e-9;

/// Something to be smoothed on a machine.
struct Case {
  TestMachine machine;
  FiveAxis metal;
  std::shared_ptr<TcpFrame> frame;
  double length = 0.0;  // of the metal
  Motion motion;
};

Case RandomCase(Random* random, bool oblique = true) {
  const TestMachine machine =
      RandomMachine(random, {oblique && random->Chance(0.4), random->Chance(0.3)});
  const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  const double length = random->Uniform(50.0, 250.0);
  const auto frame = std::make_shared<TcpFrame>(
      TcpFrame{*metal, length + (random->Chance(0.3) ? random->Uniform(-9.0, 9.0) : 0.0), 0.0});
  const double scale = std::pow(10.0, random->Uniform(-3.0, 0.0));
  constexpr PathKind kKinds[] = {PathKind::kTcpLine, PathKind::kTcpArc, PathKind::kTcpCircle};
  Motion motion = RandomMotion(random, kKinds[random->Below(3)], machine, frame, scale);
  motion.facts.corner_rounding = random->Chance(0.3) ? 0.0 : random->Uniform(0.0, 0.5);
  motion.facts.orientation_tolerance = std::pow(10.0, random->Uniform(-3.0, 0.0));
  return {machine, *metal, frame, length, motion};
}

/// A pose that the smoothing control may take at `s`: tip and rotary axes within their tolerances,
/// and the tool axis too, where that is asked for. The greatest deviations come up often.
JointVector OffTheWay(Random* random, const Case& c, double s, bool axis_too) {
  const auto& curve = std::get<TcpCurve>(c.motion.path);
  const FiveAxis& control = c.frame->control;
  const JointVector q = c.motion.At(s);
  const double tolerance = c.motion.facts.orientation_tolerance;
  const auto share = [&] {
    return random->Chance(0.5) ? (random->Chance(0.5) ? 1.0 : -1.0) : random->Uniform(-1.0, 1.0);
  };
  Eigen::Vector3d tip, axis, turned;
  control.TipInTable(q, c.frame->length, &tip, &axis);
  JointVector off = q;
  double part = 1.0;
  do {
    for (const int joint : control.rotary()) off[joint] = q[joint] + part * tolerance * share();
    control.TipInTable(off, c.frame->length, &tip, &turned);
    part *= 0.9;
  } while (axis_too && std::atan2(axis.cross(turned).norm(), axis.dot(turned)) > tolerance + 1e-12);
  tip = TipPoint(curve, s) + c.motion.facts.corner_rounding * share() * random->Direction();
  control.SolveLinear(tip, c.frame->length, &off);
  return off;
}

TEST(SmoothingTest, IsNeverLessThanWhatIsSampled) {
  Random random(61);
  int tool_to_table = 0;
  for (int i = 0; i < 1500; ++i) {
    const Case c = RandomCase(&random);
    const int count = static_cast<int>(c.machine.tree.links().size());
    const bool tool = random.Chance(0.4);
    const int link_a = tool ? c.machine.spindle_link : random.Below(count);
    const int link_b = tool && random.Chance(0.5) ? c.machine.table_link : random.Below(count);
    const PairPath pair(c.machine.tree, {link_a, random.InBox(150.0), random.Uniform(0.0, 100.0)},
                        link_b, &c.metal);
    tool_to_table += pair.tool_to_table;
    const Smoothing smoothing(c.machine.tree, &c.metal, pair, std::nullopt);
    const Travel run(c.machine.tree, &c.metal, c.length, {&c.motion});
    const double bound = std::min(smoothing.Of(c.motion, c.length), smoothing.Greatest(run));
    for (int k = 0; k < 40; ++k) {
      const double s = random.Uniform(0.0, 1.0);
      const Eigen::Isometry3d X_BA = pair.path.Pose(c.motion.At(s));
      const Eigen::Isometry3d X_off = pair.path.Pose(OffTheWay(&random, c, s, false));
      const Eigen::Vector3d p = pair.a.p_LC + pair.a.radius * random.Direction();
      ASSERT_LE((X_off * p - X_BA * p).norm(), bound + kRounding) << "case " << i;
    }
  }
  EXPECT_GT(tool_to_table, 150);
}

// Led along a great circle the tool axis keeps its tolerance, and the second joint goes where that
// takes it: far, beside the pole.
TEST(SmoothingTest, BesideThePoleTheSecondJointGoesFurther) {
  Random random(64);
  double most = 0.0;  // turn of the second joint, in tolerances
  for (int i = 0; i < 2000; ++i) {
    Case c = RandomCase(&random, false);
    const auto& curve = std::get<TcpCurve>(c.motion.path);
    if (curve.great_circle == nullptr) continue;
    const int count = static_cast<int>(c.machine.tree.links().size());
    const PairPath pair(c.machine.tree,
                        {random.Below(count), random.InBox(150.0), random.Uniform(0.0, 100.0)},
                        random.Below(count), &c.metal);
    const Smoothing smoothing(c.machine.tree, &c.metal, pair, std::nullopt);
    const Travel run(c.machine.tree, &c.metal, c.length, {&c.motion});
    const double bound = std::min(smoothing.Of(c.motion, c.length), smoothing.Greatest(run));
    const double tolerance = c.motion.facts.orientation_tolerance;
    for (int k = 0; k < 20; ++k) {
      const double s = random.Uniform(0.0, 1.0);
      const JointVector q = c.motion.At(s);
      Eigen::Vector3d tip, u;
      c.metal.TipInTable(q, c.frame->length, &tip, &u);
      const Eigen::Vector3d about = u.cross(random.Direction()).normalized();
      const std::vector<kinematics::RotarySolution> solutions =
          c.metal.SolveRotary(Eigen::AngleAxisd(tolerance * random.Uniform(0.5, 1.0), about) * u);
      // Of the two ways to get there, the one on this side of the pole.
      const std::vector<int>& rotary = c.metal.rotary();
      JointVector off = q;
      double nearest = kPi;
      for (const kinematics::RotarySolution& solution : solutions) {
        const double turn = std::remainder(solution.angles[0] - q[rotary[0]], 2.0 * kPi);
        if (solution.at_pole || std::abs(turn) >= nearest) continue;
        nearest = std::abs(turn);
        off[rotary[0]] = q[rotary[0]] + turn;
        off[rotary[1]] = solution.angles[1];
      }
      if (nearest > tolerance + kRounding) continue;
      most = std::max(
          most, std::abs(std::remainder(off[rotary[1]] - q[rotary[1]], 2.0 * kPi)) / tolerance);
      c.metal.SolveLinear(TipPoint(curve, s), c.frame->length, &off);
      const Eigen::Vector3d p = pair.a.p_LC + pair.a.radius * random.Direction();
      ASSERT_LE((pair.path.Pose(off) * p - pair.path.Pose(q) * p).norm(), bound + kRounding)
          << "case " << i;
    }
  }
  EXPECT_GT(most, 20.0);
}

// The same from the other body: a small one on the table does not get further, as seen from the
// spindle, than its own distance from the tip lets it.
TEST(SmoothingTest, TheNearerBodyBoundsIt) {
  Random random(63);
  int tighter = 0;
  for (int i = 0; i < 600; ++i) {
    const Case c = RandomCase(&random);
    const PairPath pair(c.machine.tree, {c.machine.spindle_link, random.InBox(300.0), 200.0},
                        c.machine.table_link, &c.metal);
    const Extent b{c.machine.table_link, random.InBox(200.0), random.Uniform(0.0, 50.0)};
    const Smoothing smoothing(c.machine.tree, &c.metal, pair, std::nullopt, b);
    const Travel run(c.machine.tree, &c.metal, c.length, {&c.motion});
    const double bound = std::min(smoothing.Of(c.motion, c.length), smoothing.Greatest(run));
    const double of_a =
        Smoothing(c.machine.tree, &c.metal, pair, std::nullopt).Of(c.motion, c.length);
    EXPECT_LE(bound, of_a);
    if (bound >= of_a) continue;
    ++tighter;
    for (int k = 0; k < 40; ++k) {
      const double s = random.Uniform(0.0, 1.0);
      const Eigen::Isometry3d X_AB = pair.path.Pose(c.motion.At(s)).inverse();
      const Eigen::Isometry3d X_off = pair.path.Pose(OffTheWay(&random, c, s, false)).inverse();
      const Eigen::Vector3d p = b.p_LC + b.radius * random.Direction();
      ASSERT_LE((X_off * p - X_AB * p).norm(), bound + kRounding) << "case " << i;
    }
  }
  EXPECT_GT(tighter, 100);
}

// A cylinder about the spindle's axis against the table: held against the solid, as its turn about
// its own axis moves nothing, while the tool axis keeps its tolerance.
TEST(SmoothingTest, ASolidOfRevolutionTurnsWithItsAxis) {
  Random random(62);
  double used = 0.0;  // of the bound, at most
  for (int i = 0; i < 600; ++i) {
    const Case c = RandomCase(&random);
    const double half = random.Uniform(1.0, 60.0);
    const double radius = random.Uniform(1.0, 60.0);
    const double middle = random.Uniform(-50.0, c.length);
    PairPath pair(c.machine.tree,
                  {c.machine.spindle_link, {0.0, 0.0, middle}, std::hypot(half, radius)},
                  c.machine.table_link, &c.metal);
    pair.revolved = true;
    const double reach = std::hypot(
        std::max(std::abs(middle + half - c.length), std::abs(middle - half - c.length)), radius);
    const double bound = Smoothing(c.machine.tree, &c.metal, pair, reach).Of(c.motion, c.length);
    for (int k = 0; k < 40; ++k) {
      const double s = random.Uniform(0.0, 1.0);
      const Eigen::Isometry3d X = pair.path.Pose(c.motion.At(s));
      const Eigen::Isometry3d X_off = pair.path.Pose(OffTheWay(&random, c, s, true));
      const double angle = random.Uniform(0.0, 2.0 * kPi);
      const Eigen::Vector3d p(radius * std::cos(angle), radius * std::sin(angle),
                              middle + (random.Chance(0.5) ? half : -half));
      const Eigen::Vector3d seen = X.inverse() * (X_off * p);
      const double above = std::max(0.0, std::abs(seen.z() - middle) - half);
      const double beside = std::max(0.0, std::hypot(seen.x(), seen.y()) - radius);
      ASSERT_LE(std::hypot(above, beside), bound + kRounding) << "case " << i;
      used = std::max(used, std::hypot(above, beside) / bound);
    }
  }
  EXPECT_GT(used, 0.8);
}

// The issue's own number: a degree is 3.1 mm at 180 mm from the tip.
TEST(SmoothingTest, ADegreeAtItsDistanceFromTheTip) {
  const TestMachine machine = kinematics::TrunnionBC({0, 0, 0}, {0, 0, 0});
  const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  const double length = 180.0;
  const auto frame = std::make_shared<TcpFrame>(TcpFrame{*metal, length, 0.0});
  TcpCurve curve;
  curve.frame = frame;
  curve.q0 = curve.q1 = JointVector::Zero(5);
  curve.p0_B = {0, 0, 50};
  curve.p1_B = {0.1, 0, 50};
  metal->SolveLinear(curve.p0_B, length, &curve.q0);
  metal->SolveLinear(curve.p1_B, length, &curve.q1);
  Motion motion = MakeMotion(curve);
  motion.facts.corner_rounding = 0.01;
  motion.facts.orientation_tolerance = Radians(1.0);

  PairPath pair(machine.tree, {machine.spindle_link, {0, 0, 30}, 30.0}, machine.table_link,
                &*metal);
  pair.revolved = true;
  const Smoothing to_table(machine.tree, &*metal, pair, 180.0);
  EXPECT_NEAR(to_table.Of(motion, length), 0.01 + 180.0 * std::tan(Radians(1.0)), 1e-12);
  EXPECT_NEAR(to_table.Of(motion, length), 3.15, 0.005);

  // Against the base, the tool moves as the linear axes must: B has the tip 50 from its axis, C
  // next to nothing.
  const PairPath base(machine.tree, {machine.spindle_link, {0, 0, 30}, 30.0}, 0, &*metal);
  const double bound = Smoothing(machine.tree, &*metal, base, 180.0).Of(motion, length);
  EXPECT_GE(bound, 0.01 + 50.0 * std::tan(Radians(1.0)));
  EXPECT_LT(bound, 0.01 + 50.5 * std::tan(Radians(1.0)));

  // A body on the table against the base goes with the axes and turns with both: a point 100 from
  // each of them.
  const PairPath table(machine.tree, {machine.table_link, {100, 0, 0}, 0.0}, 0, &*metal);
  EXPECT_NEAR(Smoothing(machine.tree, &*metal, table, std::nullopt).Of(motion, length),
              200.0 * std::tan(Radians(1.0)), 1e-6);

  motion.facts.orientation_tolerance = 0.0;
  EXPECT_EQ(to_table.Of(motion, length), 0.01);
}

}  // namespace
}  // namespace ncsim::motion
