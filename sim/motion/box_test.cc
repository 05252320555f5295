// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/motion/test_motions.h"

namespace ncsim::motion {
namespace {

constexpr double kRounding = 1e-9;

struct Case {
  TestMachine machine;
  std::shared_ptr<const TcpFrame> frame;
};

Case RandomCase(Random* random) {
  Case result{RandomMachine(random, {random->Chance(0.4), random->Chance(0.3)}), nullptr};
  result.frame = std::make_shared<TcpFrame>(
      TcpFrame{*kinematics::FiveAxis::Make(result.machine.tree, result.machine.spindle_link,
                                           result.machine.table_link),
               random->Uniform(50.0, 250.0), 0.0});
  return result;
}

/// Smallest box of poses sampled over the span: a grid with its edges.
JointBox Sampled(const Motion& motion, const Span& span, int steps) {
  JointBox box{motion.At(span.s0, span.lag0), motion.At(span.s0, span.lag0)};
  const int lags = span.lag0 == span.lag1 ? 0 : steps;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= lags; ++k) {
      const double s = std::lerp(span.s0, span.s1, static_cast<double>(i) / steps);
      const double lag =
          lags == 0 ? span.lag0 : std::lerp(span.lag0, span.lag1, static_cast<double>(k) / lags);
      const JointVector q = motion.At(s, lag);
      box.lower = box.lower.cwiseMin(q);
      box.upper = box.upper.cwiseMax(q);
    }
  }
  return box;
}

class BoxTest : public testing::TestWithParam<PathKind> {};

TEST_P(BoxTest, HoldsEverySample) {
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    const Case c = RandomCase(&random);
    const double scale = std::pow(10.0, random.Uniform(-3.0, 0.0));
    const Motion motion = RandomMotion(&random, GetParam(), c.machine, c.frame, scale);
    const Span span = RandomSpan(&random, motion);
    const JointBox box = Box(motion, span);
    const JointBox sampled = Sampled(motion, span, 16);
    for (Eigen::Index j = 0; j < box.lower.size(); ++j) {
      EXPECT_LE(box.lower[j], sampled.lower[j] + kRounding) << "case " << i << " joint " << j;
      EXPECT_GE(box.upper[j], sampled.upper[j] - kRounding) << "case " << i << " joint " << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, BoxTest, testing::ValuesIn(kPathKinds),
                         [](const auto& param_info) { return ToString(param_info.param); });

TEST(BoxExactnessTest, DogLegBoxIsTouchedByItsSamples) {
  Random random(12);
  for (int i = 0; i < 40; ++i) {
    const Case c = RandomCase(&random);
    const Motion motion = RandomMotion(&random, PathKind::kDogLeg, c.machine, c.frame, 1.0);
    const Span span = RandomSpan(&random, motion);
    const JointBox box = Box(motion, span);
    const JointBox sampled = Sampled(motion, span, 100);
    const JointVector way = (motion.q1() - motion.q0()).cwiseAbs();
    for (Eigen::Index j = 0; j < box.lower.size(); ++j) {
      // A grid of 100 misses a smooth extreme by its square.
      EXPECT_NEAR(box.lower[j], sampled.lower[j], 2e-3 * way[j] + 1e-12);
      EXPECT_NEAR(box.upper[j], sampled.upper[j], 2e-3 * way[j] + 1e-12);
    }
  }
}

TEST(BoxExactnessTest, PlanarArcBoxIsTheCirclesExtremes) {
  AxisArc arc;
  arc.q0 = arc.q1 = JointVector::Zero(3);
  arc.centre = {10, 20, 30};
  arc.e1 = {1, 0, 0};
  arc.e2 = {0, 1, 0};
  arc.pitch.setZero();
  arc.end_error.setZero();
  arc.radius = 5.0;
  arc.phi0 = -std::numbers::pi / 4.0;
  arc.sweep = std::numbers::pi;  // from 4:30 over 3 and 12 o'clock to 10:30
  arc.linear = {0, 1, 2};
  const JointBox box = Box(MakeMotion(arc), Span{});
  EXPECT_NEAR(box.lower[0], 10.0 - 5.0 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(box.upper[0], 15.0, 1e-12);
  EXPECT_NEAR(box.lower[1], 20.0 - 5.0 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(box.upper[1], 25.0, 1e-12);
  EXPECT_EQ(box.lower[2], 30.0);
  EXPECT_EQ(box.upper[2], 30.0);
}

TEST(BoxExactnessTest, TcpBoxShrinksWithTheSpan) {
  Random random(13);
  for (int i = 0; i < 100; ++i) {
    const Case c = RandomCase(&random);
    const Motion motion = RandomMotion(&random, PathKind::kTcpLine, c.machine, c.frame, 0.1);
    double last = 0.0;
    for (const double width : {1e-3, 1e-2, 1e-1}) {
      const JointBox box = Box(motion, {0.5 - width / 2, 0.5 + width / 2});
      const double size = (box.upper - box.lower).maxCoeff();
      EXPECT_GT(size, 9.9 * last);
      EXPECT_TRUE(last == 0.0 || size < 10.1 * last);
      last = size;
    }
  }
}

}  // namespace
}  // namespace ncsim::motion
