// SPDX-License-Identifier: BSD-3-Clause
// The certificate against dense sampling: random motions of every kind on random machines past
// random bodies. No contact that a sample finds may be missed, a proven clearance may not be above
// any sample, and a contact that no sample confirms must be a near one.
#include "sim/collision/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "sim/base/units.h"
#include "sim/collision/test_shapes.h"
#include "sim/motion/test_motions.h"

namespace ncsim::collision {
namespace {

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

// Anywhere; or along Z, now and then beside it by what a post's rounding makes of it.
motion::Motion StraightWay(motion::Random* random, const motion::TestMachine& machine,
                           bool along_axis) {
  motion::JointVector q0(5);
  q0 << random->Uniform(-50, 50), random->Uniform(-50, 50), random->Uniform(-50, 50),
      random->Uniform(-1, 2), random->Uniform(-3, 3);
  motion::JointVector q1 = q0;
  if (!along_axis) {
    q1.head<3>() += random->Uniform(0, 150) * random->Direction();
    motion::Motion motion = motion::MakeMotion(motion::AxisLinear{q0, q1});
    motion.kind = motion::MotionKind::kRapid;
    return motion;
  }
  q1[2] += random->Uniform(-90, 90);
  if (random->Chance(0.5)) q1[random->Below(2)] += random->Uniform(-0.009, 0.009);
  if (random->Chance(0.4)) return motion::MakeMotion(motion::AxisLinear{q0, q1});
  motion::Motion motion = motion::MakeMotion(motion::RandomDogLeg(random, machine.tree, q0, q1));
  motion.kind = motion::MotionKind::kRapid;
  return motion;
}

// A look at the whole way settles those that are clear.
TEST(SweepPropertyTest, OnStraightWaysNothingIsMissed) {
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
  for (int i = 0; i < 800; ++i) {
    const auto& a = bodies[i % 2];
    const motion::Motion motion = StraightWay(&random, machine, i % 4 < 2);
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
  EXPECT_GT(tally.contacts, 160);
  EXPECT_GT(tally.clear, 240);
  EXPECT_GE(at_once, tally.clear - 10);
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

/// A ball on a way past a needle's point, and what becomes of that way when its ends are looked at.
class BallAndNeedle {
 public:
  BallAndNeedle(const motion::TestMachine& machine, const motion::Motion& motion, int link)
      : tree_(&machine.tree),
        five_axis_(*kinematics::FiveAxis::Make(*tree_, machine.spindle_link, machine.table_link)),
        spindle_(machine.spindle_link),
        link_(link),
        motion_(&motion),
        travel_(*tree_, &five_axis_, 120.0, {&motion}) {
    machine::Tool tool;
    tool.length = 120.0;
    tool.flutes = BallProfile(4, 8);
    ball_ = std::make_shared<const ToolBody>(tool, machine::BodyKind::kFlutes, spindle_);
    path_.emplace(*tree_, ball_->extent, link, &five_axis_);
    path_->revolved = true;
    bound_.emplace(*path_, travel_);
  }
  BallAndNeedle(const BallAndNeedle&) = delete;
  BallAndNeedle& operator=(const BallAndNeedle&) = delete;

  /// Of the ball, in the needle's link.
  Eigen::Vector3d Centre(double s) const {
    const motion::JointVector q = motion_->At(s);
    return tree_->Pose(link_, q).inverse() * tree_->Pose(spindle_, q) *
           Eigen::Vector3d(0, 0, 116.0);
  }
  void SetNeedle(const Eigen::Vector3d& p) {
    machine::SceneBody body;
    body.name = "needle";
    body.link = link_;
    body.mesh = BoxMesh(p - Eigen::Vector3d::Constant(0.05), p + Eigen::Vector3d::Constant(0.05));
    engine_ = MakeEngine(ball_, std::make_shared<const MeshBody>(body));
  }
  PairSweep MakeSweep() { return {*path_, engine_.get()}; }
  PairSweep::Crossing Cross(PairSweep* sweep) const {
    return sweep->Cross(travel_, *bound_, 0, Watch());
  }
  PairSweep::Crossing Cross() {
    PairSweep sweep = MakeSweep();
    return Cross(&sweep);
  }
  SweepResult Check(PairSweep* sweep) { return sweep->Check(*motion_, Watch(), {&*bound_, 0}); }
  double Least() { return Sample(*motion_, MakeSweep(), engine_.get()).least; }
  /// Does its end cover the motion by itself?
  bool EndCovers() {
    return MakeSweep().At(*motion_, {1.0, 0.0}, kInfinity)->upper > bound_->Between(0, 1);
  }

 private:
  const kinematics::KinematicTree* tree_;
  kinematics::FiveAxis five_axis_;
  int spindle_, link_;
  const motion::Motion* motion_;
  motion::Travel travel_;
  std::shared_ptr<const ToolBody> ball_;
  std::optional<motion::PairPath> path_;
  std::optional<motion::PairTravel> bound_;
  std::unique_ptr<PairEngine> engine_;
};

// One motion, which neither of its ends covers: what both together, or the middle of its box, say
// of it.
TEST(SweepPropertyTest, WhatStandsBetweenTwoLooksIsClear) {
  motion::Random random(78);
  int together = 0, in_box = 0, hit = 0;
  for (int i = 0; i < 3000; ++i) {
    const motion::TestMachine machine = kinematics::RandomMachine(&random);
    const auto frame = std::make_shared<motion::TcpFrame>(motion::TcpFrame{
        *kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link), 120.0,
        0.0});
    const motion::Motion motion = motion::RandomMotion(&random, motion::kPathKinds[i % 6], machine,
                                                       frame, random.Uniform(0.01, 0.2));
    BallAndNeedle scene(machine, motion, random.Chance(0.7) ? machine.table_link : 0);
    const double off = random.Uniform(3.9, random.Chance(0.5) ? 8.0 : 60.0);
    scene.SetNeedle(scene.Centre(random.Uniform(0.1, 0.9)) + off * random.Direction());
    const double least = scene.Least();
    hit += least <= 0.0;
    const PairSweep::Crossing crossing = scene.Cross();
    if (crossing.end == 1) {
      ASSERT_GT(crossing.least, 0.0);
      ASSERT_GE(least, crossing.least - 1e-6) << "case " << i;
      together += !scene.EndCovers();
    }
    PairSweep sweep = scene.MakeSweep();
    if (!sweep.StartsClear(motion)) continue;
    const std::uint64_t looks = sweep.queries();
    const SweepResult result = scene.Check(&sweep);
    if (result.contact) continue;
    ASSERT_GT(least, 0.0) << "case " << i;
    ASSERT_GE(least, result.least.lower - 1e-6) << "case " << i;
    in_box += std::holds_alternative<motion::DogLeg>(motion.path) && sweep.queries() == looks + 1;
  }
  EXPECT_GT(together, 50);
  EXPECT_GT(in_box, 30);
  EXPECT_GT(hit, 50);
}

// A straight way of 40 mm past a needle that is 32 mm from the ball at both ends. And ways that
// bulge toward one that is as far from their ends, and touch it.
TEST(SweepPropertyTest, EndsCoverNoBulgeBetweenThem) {
  const motion::TestMachine machine = kinematics::TrunnionBC({0, 0, 0}, {0, 0, 0});
  const motion::JointVector q0 = motion::JointVector::Zero(5);
  motion::JointVector q1 = q0;
  q1[0] = 40.0;
  const motion::Motion straight = motion::MakeMotion(motion::AxisLinear{q0, q1});
  BallAndNeedle beside(machine, straight, machine.table_link);
  beside.SetNeedle(beside.Centre(0.5) + Eigen::Vector3d(0, 30, 0));
  EXPECT_FALSE(beside.EndCovers());
  const PairSweep::Crossing crossing = beside.Cross();
  EXPECT_EQ(crossing.end, 1U);
  EXPECT_LE(crossing.least, 26.0);  // 30 - 4
  EXPECT_GT(crossing.least, 0.0);

  motion::AxisArc arc{q0, q1, {20, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {}, {}, 20.0, 0.0, kPi, {0, 1, 2}};
  arc.pitch = arc.end_error = Eigen::Vector3d::Zero();
  motion::DogLeg corner{q0, q1, motion::JointVector::Zero(5), motion::JointVector::Zero(5)};
  corner.q1[1] = 40.0;
  corner.duration[0] = 0.1;
  corner.duration[1] = 1.0;
  const std::pair<motion::Motion, double> bulges[] = {{motion::MakeMotion(arc), 0.5},
                                                      {motion::MakeMotion(corner), 0.1}};
  for (const auto& [motion, s] : bulges) {
    BallAndNeedle scene(machine, motion, machine.table_link);
    const Eigen::Vector3d chord_middle = 0.5 * (scene.Centre(0.0) + scene.Centre(1.0));
    const Eigen::Vector3d out = (scene.Centre(s) - chord_middle).normalized();
    scene.SetNeedle(scene.Centre(s) + 3.9 * out);
    EXPECT_LT(scene.Least(), 0.0) << "it must be able to touch";
    EXPECT_FALSE(scene.EndCovers());
    EXPECT_EQ(scene.Cross().end, 0U);
  }
}

// Along X past a needle that it touches half way; and along Y, to the needle. What was seen at the
// end of the one way is nothing to the other.
TEST(SweepPropertyTest, WhatWasSeenOfOneRunIsNotTheNextOnes) {
  const motion::TestMachine machine = kinematics::TrunnionBC({0, 0, 0}, {0, 0, 0});
  const auto along = [](double x0, double y0, double x1, double y1) {
    motion::AxisLinear way{motion::JointVector::Zero(5), motion::JointVector::Zero(5)};
    way.q0.head<2>() << x0, y0;
    way.q1.head<2>() << x1, y1;
    return motion::MakeMotion(way);
  };
  const motion::Motion past = along(-30, 0, 30, 0), at = along(0, -9, 0, 0);
  BallAndNeedle first(machine, past, machine.table_link), next(machine, at, machine.table_link);
  first.SetNeedle(next.Centre(1.0) + 3.9 * (next.Centre(1.0) - next.Centre(0.0)).normalized());
  PairSweep sweep = first.MakeSweep();
  EXPECT_EQ(first.Cross(&sweep).end, 0U);
  EXPECT_EQ(next.Cross(&sweep).end, 0U);
}

}  // namespace
}  // namespace ncsim::collision
