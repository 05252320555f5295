// SPDX-License-Identifier: BSD-3-Clause
// The certificate against dense sampling: random motions of every kind on random machines past
// random bodies. No contact that a sample finds may be missed, a proven clearance may not be above
// any sample, and a contact that no sample confirms must be a near one.
#include "sim/collision/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "sim/collision/test_shapes.h"
#include "sim/motion/test_motions.h"

namespace ncsim::collision {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Sampled {
  double least = kInfinity;
  double least_at_no_lag = kInfinity;
};

// What sampling must be afraid of: the least clearance between samples, here at steps that make it
// small.
Sampled Sample(const motion::Motion& motion, const PairSweep& sweep, PairEngine* engine) {
  Sampled sampled;
  const int lags = motion::Whole(motion).lag1 > 0.0 ? 4 : 1;
  constexpr int kSteps = 200;
  for (int l = 0; l < lags; ++l) {
    for (int i = 0; i <= kSteps; ++i) {
      const PathPoint at{static_cast<double>(i) / kSteps, lags == 1 ? 0.0 : l / (lags - 1.0)};
      DistanceGoal goal;
      goal.stop_above = sampled.least;
      goal.max_evaluations = 300;  // the upper bound is a witness however soon it stops
      const auto clearance = engine->Solid(sweep.Pose(motion, at), goal);
      if (!clearance.has_value()) continue;
      sampled.least = std::min(sampled.least, clearance->upper);
      if (l == 0) sampled.least_at_no_lag = std::min(sampled.least_at_no_lag, clearance->upper);
    }
  }
  return sampled;
}

struct Tally {
  int motions = 0;
  int contacts = 0;
  int clear = 0;
};

void Hold(const motion::Motion& motion, const motion::PairPath& path, PairEngine* engine,
          double level, Tally* tally) {
  PairSweep sweep(path, engine);
  Watch watch;
  watch.contact = level;
  watch.track = true;
  const SweepResult result = sweep.Check(motion, watch);
  const Sampled sampled = Sample(motion, sweep, engine);
  ++tally->motions;
  ASSERT_FALSE(result.uncertified);
  if (!result.contact) {
    ++tally->clear;
    ASSERT_GT(sampled.least, level) << "missed contact";
    ASSERT_LE(result.least.lower, sampled.least + 1e-6) << "proven above a sample";
    if (level == 0.0) {
      EXPECT_GE(result.least.lower, 0.49 * std::min(sampled.least, result.least.upper) - 0.01);
    }
    return;
  }
  ++tally->contacts;
  // The pose of the contact is one, up to the resolution.
  DistanceGoal fine;
  const auto there = engine->Solid(sweep.Pose(motion, result.first), fine);
  ASSERT_TRUE(there.has_value());
  EXPECT_LT(there->upper, level + 0.02);
  if (result.first.lag > 0.0) {
    EXPECT_GT(sampled.least_at_no_lag, level - 0.01);
  }
  // Nothing before it is deeper in contact.
  fine.stop_above = level - 0.02;
  for (int i = 0; i < 100 && result.first.s > 1e-3; ++i) {
    const PathPoint before{(result.first.s - 1e-3) * i / 100.0, result.first.lag};
    const auto clearance = engine->Solid(sweep.Pose(motion, before), fine);
    ASSERT_TRUE(clearance.has_value());
    if (result.first.lag == 0.0) {
      EXPECT_GT(clearance->lower, level - 0.021);
    }
  }
  PathPoint at;
  int budget = 1000;
  const Interval deepest =
      sweep.Deepest(motion, result.first, result.first.lag > 0.0, kInfinity, &budget, &at);
  if (engine->has_depth()) {
    // No depth is more than the greatest ball's, which is known to 0.001 mm.
    EXPECT_LE(deepest.lower, std::max(sampled.least, engine->floor()) + 1e-6)
        << "proven above a sample";
    EXPECT_LT(deepest.upper,
              0.011 + (result.first.lag > 0.0 ? sampled.least : sampled.least_at_no_lag));
  }
}

std::shared_ptr<const MeshBody> RandomBody(motion::Random* random, int link,
                                           const Eigen::Vector3d& near) {
  machine::SceneBody body;
  body.name = "body";
  body.link = link;
  const Eigen::Isometry3d X = random->Pose(20.0);
  const Eigen::Vector3d half(random->Uniform(0.05, 60), random->Uniform(2, 60),
                             random->Uniform(2, 60));
  body.mesh = BoxMesh(-half, half);
  for (Eigen::Vector3d& v : body.mesh.vertices) v = near + X.linear() * v;
  return std::make_shared<const MeshBody>(body);
}

TEST(SweepPropertyTest, NothingIsMissed) {
  motion::Random random(20240607);
  Tally tool_tally;
  Tally mesh_tally;
  for (int i = 0; i < 240; ++i) {
    const motion::TestMachine machine = kinematics::RandomMachine(&random);
    const auto five_axis =
        kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(five_axis.has_value());
    const motion::PathKind kind = motion::kPathKinds[i % 6];
    const auto frame = std::make_shared<motion::TcpFrame>(motion::TcpFrame{*five_axis, 120.0, 0.0});
    const motion::Motion motion =
        motion::RandomMotion(&random, kind, machine, frame, random.Uniform(0.02, 0.5));
    machine::Tool tool;
    tool.number = 1;
    tool.length = 120.0;
    tool.holder = PolyProfile({{0, 0}, {0, 6}, {40, 6}, {60, 20}, {120, 20}, {120, 0}});
    const auto a =
        std::make_shared<const ToolBody>(tool, machine::BodyKind::kHolder, machine.spindle_link);
    // Somewhere about the middle of the way, as seen from the table.
    const motion::JointVector q = motion.At(random.Uniform(0.0, 1.0));
    const Eigen::Isometry3d X_BS = machine.tree.Pose(machine.table_link, q).inverse() *
                                   machine.tree.Pose(machine.spindle_link, q);
    const auto b =
        RandomBody(&random, machine.table_link,
                   X_BS * Eigen::Vector3d(random.Uniform(-90, 90), random.Uniform(-90, 90), 110.0));
    const double level = random.Chance(0.3) ? -0.2 : 0.0;
    {
      const auto engine = MakeEngine(a, b);
      const motion::PairPath path(machine.tree, a->extent, machine.table_link, &*five_axis);
      Hold(motion, path, engine.get(), level, &tool_tally);
    }
    if (HasFatalFailure()) FAIL() << "tool, round " << i << " " << motion::ToString(kind);
    if (i % 4 == 0) {
      machine::SceneBody head;
      head.name = "head";
      head.link = machine.spindle_link;
      head.mesh = BoxMesh({-30, -20, 0}, {30, 20, 110});
      const auto mesh = std::make_shared<const MeshBody>(head);
      const auto engine = MakeEngine(mesh, b);
      const motion::PairPath path(machine.tree, mesh->extent, machine.table_link, &*five_axis);
      Hold(motion, path, engine.get(), 0.0, &mesh_tally);
    }
    if (HasFatalFailure()) FAIL() << "mesh, round " << i << " " << motion::ToString(kind);
  }
  EXPECT_GT(tool_tally.contacts, 40);
  EXPECT_GT(tool_tally.clear, 40);
  EXPECT_GT(mesh_tally.contacts, 8);
  EXPECT_GT(mesh_tally.clear, 8);
}

// Along Z, now and then beside it by what a post's rounding makes of it.
motion::Motion AlongTheAxis(motion::Random* random, const motion::TestMachine& machine) {
  motion::JointVector q0(5);
  q0 << random->Uniform(-50, 50), random->Uniform(-50, 50), random->Uniform(-50, 50),
      random->Uniform(-1, 2), random->Uniform(-3, 3);
  motion::JointVector q1 = q0;
  q1[2] += random->Uniform(-90, 90);
  if (random->Chance(0.5)) q1[random->Below(2)] += random->Uniform(-0.009, 0.009);
  if (random->Chance(0.4)) return motion::MakeMotion(motion::AxisLinear{q0, q1});
  motion::Motion motion = motion::MakeMotion(motion::RandomDogLeg(random, machine.tree, q0, q1));
  motion.kind = motion::MotionKind::kRapid;
  return motion;
}

// A look at the whole way settles those that are clear.
TEST(SweepPropertyTest, AlongTheAxisNothingIsMissed) {
  motion::Random random(9);
  const motion::TestMachine machine = kinematics::TrunnionBC({10, 0, -40}, {10, 5, 0});
  const auto five_axis =
      kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  ASSERT_TRUE(five_axis.has_value());
  machine::Tool tool;
  tool.length = 120.0;
  tool.flutes = BallProfile(4, 30);
  tool.holder = PolyProfile({{60, 0}, {60, 10}, {80, 10}, {80, 24}, {120, 20}, {120, 0}});
  const std::shared_ptr<const ToolBody> bodies[] = {
      std::make_shared<const ToolBody>(tool, machine::BodyKind::kFlutes, machine.spindle_link),
      std::make_shared<const ToolBody>(tool, machine::BodyKind::kHolder, machine.spindle_link)};
  Tally tally;
  int at_once = 0;
  for (int i = 0; i < 400; ++i) {
    const auto& a = bodies[i % 2];
    const motion::Motion motion = AlongTheAxis(&random, machine);
    const motion::JointVector q = motion.At(random.Uniform(0.0, 1.0));
    const Eigen::Isometry3d X_BS = machine.tree.Pose(machine.table_link, q).inverse() *
                                   machine.tree.Pose(machine.spindle_link, q);
    const auto b =
        RandomBody(&random, machine.table_link,
                   X_BS * Eigen::Vector3d(random.Uniform(-60, 60), random.Uniform(-60, 60), 110.0));
    const auto engine = MakeEngine(a, b);
    motion::PairPath path(machine.tree, a->extent, machine.table_link, &*five_axis);
    path.revolved = true;
    const double level = a->shape.convex() && random.Chance(0.5) ? -0.2 : 0.0;
    Hold(motion, path, engine.get(), level, &tally);
    if (HasFatalFailure()) FAIL() << "case " << i;
    PairSweep alone(path, engine.get());
    Watch watch;
    watch.contact = level;
    if (!alone.Check(motion, watch).contact && alone.queries() <= 2) ++at_once;
  }
  EXPECT_GT(tally.contacts, 80);
  EXPECT_GT(tally.clear, 120);
  EXPECT_GE(at_once, tally.clear - 5);
}

// Runs of motions: what Cross passes over is as clear as it says, at every sample.
TEST(SweepPropertyTest, WhatIsCrossedIsClear) {
  motion::Random random(77);
  std::size_t crossed = 0;
  std::uint64_t queries = 0;
  int stopped = 0;
  for (int i = 0; i < 200; ++i) {
    const motion::TestMachine machine = kinematics::RandomMachine(&random);
    const auto five_axis =
        kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(five_axis.has_value());
    const auto frame = std::make_shared<motion::TcpFrame>(motion::TcpFrame{*five_axis, 120.0, 0.0});
    machine::Tool tool;
    tool.length = 120.0;
    tool.holder = PolyProfile({{0, 0}, {0, 6}, {40, 6}, {60, 20}, {120, 20}, {120, 0}});
    const auto a =
        std::make_shared<const ToolBody>(tool, machine::BodyKind::kHolder, machine.spindle_link);
    std::vector<motion::Motion> motions;
    for (int k = 0; k < 6; ++k) {
      motion::Motion next = motion::RandomMotion(&random, motion::kPathKinds[random.Below(6)],
                                                 machine, frame, random.Uniform(0.005, 0.1));
      if (!motions.empty()) {
        motions.push_back(motion::MakeMotion(motion::AxisLinear{motions.back().q1(), next.q0()}));
      }
      motions.push_back(std::move(next));
    }
    std::vector<const motion::Motion*> run;
    for (const motion::Motion& motion : motions) run.push_back(&motion);
    const motion::Travel travel(machine.tree, &*five_axis, 120.0, run);
    const motion::JointVector q = motions[2].At(0.5);
    // Half of the bodies are no part of the table.
    const int link = random.Chance(0.5)
                         ? machine.table_link
                         : random.Below(static_cast<int>(machine.tree.links().size()));
    const Eigen::Isometry3d X_BS =
        machine.tree.Pose(link, q).inverse() * machine.tree.Pose(machine.spindle_link, q);
    const auto b =
        RandomBody(&random, link, X_BS * Eigen::Vector3d(random.Uniform(-300, 300), 150.0, 110.0));
    const auto engine = MakeEngine(a, b);
    motion::PairPath path(machine.tree, a->extent, link, &*five_axis);
    if (path.path.rigid()) continue;
    path.revolved = true;
    PairSweep sweep(path, engine.get());
    Watch watch;
    watch.track = true;
    watch.clearance = random.Chance(0.5) ? 2.0 : 0.0;
    const motion::PairTravel bound(sweep.path(), travel);
    for (std::size_t at = 0; at < travel.size();) {
      const PairSweep::Crossing crossing = sweep.Cross(travel, bound, at, watch);
      for (std::size_t k = at; k < crossing.end; ++k) {
        ASSERT_GE(Sample(motions[k], sweep, engine.get()).least, crossing.least - 1e-6)
            << "case " << i << " motion " << k;
      }
      if (crossing.end > at) {
        EXPECT_GT(crossing.least, watch.clearance);
      }
      crossed += crossing.end - at;
      stopped += crossing.end < travel.size();
      at = std::max(crossing.end, at + 1);
    }
    queries += sweep.queries();
  }
  EXPECT_GT(crossed, 300U);
  EXPECT_GT(stopped, 50);
  EXPECT_LT(queries, 2000U);
}

}  // namespace
}  // namespace ncsim::collision
