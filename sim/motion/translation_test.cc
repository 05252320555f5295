// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/translation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/motion/test_motions.h"

namespace ncsim::motion {
namespace {

using kinematics::Extent;
using kinematics::FiveAxis;

double FromSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& way) {
  const double t = std::clamp(p.dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
  return (p - t * way).norm();
}

/// Every pose of the motion, whatever its lag, against what was said of it.
void Hold(const Motion& motion, const PairPath& pair, const Translation& said) {
  const Eigen::Isometry3d start = pair.path.Pose(motion.q0());
  const Span whole = Whole(motion);
  for (int i = 0; i <= 40; ++i) {
    for (int k = 0; k <= 4; ++k) {
      const JointVector q = motion.At(i / 40.0, whole.lag1 * k / 4.0);
      const Eigen::Isometry3d X = pair.path.Pose(q);
      ASSERT_LE((X.linear() - start.linear()).norm(), 1e-12);
      ASSERT_LE(FromSegment(X.translation() - start.translation(), said.way), said.astray + 1e-8);
    }
  }
}

// Random motions on random machines, most of them with the rotary axes at rest.
TEST(TranslationTest, EveryPoseIsNearTheWay) {
  Random random(41);
  int translations = 0;
  int astray = 0;
  int turns = 0;
  for (int i = 0; i < 2000; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.4), random.Chance(0.3)});
    const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(metal.has_value());
    const auto frame = std::make_shared<TcpFrame>(TcpFrame{*metal, 120.0, 0.0});
    const PathKind kind = kPathKinds[i % 5];
    Motion motion = RandomMotion(&random, kind, machine, frame, random.Uniform(0.001, 1.0));
    const bool rests = random.Chance(0.7);
    std::visit(
        [&](auto& path) {
          for (const int joint : metal->rotary()) {
            if (rests) path.q1[joint] = path.q0[joint];
          }
        },
        motion.path);
    if (auto* curve = std::get_if<TcpCurve>(&motion.path)) {
      const JointVector begin = motion.At(0.0);
      curve->q1 = motion.At(1.0);
      curve->q0 = begin;
    }
    if (auto* dog_leg = std::get_if<DogLeg>(&motion.path)) {
      for (Eigen::Index k = 0; k < dog_leg->q0.size(); ++k) {
        if (dog_leg->q0[k] == dog_leg->q1[k]) dog_leg->duration[k] = 0.0;
      }
    }
    const PairPath pair(machine.tree, Extent{machine.spindle_link, {0, 0, 60}, 10.0},
                        machine.table_link, &*metal);
    const auto said = TranslationOf(motion, pair);
    if (!said.has_value()) {
      ++turns;
      // A line with nothing that turns is one.
      const bool curved = kind == PathKind::kAxisArc || kind == PathKind::kTcpArc;
      EXPECT_TRUE(!rests || curved) << i << " " << ToString(kind);
      continue;
    }
    ++translations;
    if (said->astray > 1.0) ++astray;
    Hold(motion, pair, *said);
    if (HasFatalFailure()) FAIL() << "case " << i << " " << ToString(kind);
  }
  EXPECT_GT(translations, 700);
  EXPECT_GT(astray, 100);
  EXPECT_GT(turns, 500);
}

// Rapids with X slower than Z: the way is Z's, and X leads off it by all that X goes.
TEST(TranslationTest, ADogLegGoesAstrayByItsShorterWay) {
  const TestMachine machine = kinematics::TrunnionBC({0, 0, 0}, {0, 0, 0});
  const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  DogLeg path;
  path.q0 = path.q1 = path.duration = path.ramp = JointVector::Zero(5);
  path.q1[0] = 0.25;
  path.q1[2] = -40.0;
  path.duration << 1.0, 0.0, 0.1, 0.0, 0.0;
  const PairPath pair(machine.tree, Extent{machine.spindle_link, {0, 0, 0}, 1.0},
                      machine.table_link, &*metal);
  const auto said = TranslationOf(MakeMotion(path), pair);
  ASSERT_TRUE(said.has_value());
  EXPECT_NEAR(said->way.norm(), 40.0, 1e-12);
  EXPECT_NEAR(said->astray, 0.25, 1e-12);
  path.q1[3] = 0.001;
  EXPECT_FALSE(TranslationOf(MakeMotion(path), pair).has_value());
}

}  // namespace
}  // namespace ncsim::motion
