// SPDX-License-Identifier: BSD-3-Clause
#include "sim/report/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "sim/machine/primitives.h"
#include "sim/motion/test_motions.h"

namespace ncsim::report {
namespace {

using motion::JointVector;
using motion::Motion;
using motion::PathKind;

/// A random five-axis machine with a cube on each link.
struct Rig {
  explicit Rig(motion::Random* random) : test(kinematics::RandomMachine(random)) {
    machine.tree = test.tree;
    machine.spindle_link = test.spindle_link;
    machine.table_link = test.table_link;
    for (int link = 0; link < static_cast<int>(test.tree.links().size()); ++link) {
      machine::SceneBody body;
      body.link = link;
      body.mesh = machine::MakeBox(Eigen::Vector3d::Constant(random->Uniform(50.0, 400.0)));
      scene.bodies.push_back(std::move(body));
    }
  }

  /// mm: how far apart a corner of any body lies in the two poses.
  double Apart(const JointVector& a, const JointVector& b) const {
    double apart = 0.0;
    for (const machine::SceneBody& body : scene.bodies) {
      const Eigen::Isometry3d X_a = machine.tree.Pose(body.link, a);
      const Eigen::Isometry3d X_b = machine.tree.Pose(body.link, b);
      for (const Eigen::Vector3d& v : body.mesh.vertices) {
        apart = std::max(apart, (X_a * v - X_b * v).norm());
      }
    }
    return apart;
  }

  kinematics::TestMachine test;
  machine::Machine machine;
  machine::Scene scene;
};

std::shared_ptr<const motion::TcpFrame> FrameOf(const Rig& rig, double length) {
  return std::make_shared<motion::TcpFrame>(motion::TcpFrame{
      *kinematics::FiveAxis::Make(rig.machine.tree, rig.test.spindle_link, rig.test.table_link),
      length, 0.0});
}

/// Motions of every kind, from wherever the last one ended.
std::vector<Motion> Program(motion::Random* random, const Rig& rig) {
  std::vector<Motion> program;
  double time = 0.0;
  for (int i = 0; i < 24; ++i) {
    const PathKind kind = motion::kPathKinds[i % 6];
    Motion motion = motion::RandomMotion(random, kind, rig.test, FrameOf(rig, 120.0), 0.5);
    motion.where = {0, i + 1, 1};
    motion.start_time = time;
    const auto* dog_leg = std::get_if<motion::DogLeg>(&motion.path);
    motion.duration = dog_leg ? motion::Duration(*dog_leg) : random->Uniform(0.5, 5.0);
    time += motion.duration;
    program.push_back(std::move(motion));
  }
  return program;
}

TEST(RecordingTest, NoBodyIsShownFartherOffThanTheTolerance) {
  double worst = 0.0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    motion::Random random(seed);
    const Rig rig(&random);
    const std::vector<Motion> program = Program(&random, rig);
    Recorder recorder(rig.machine, rig.scene, {});
    for (const Motion& motion : program) recorder.OnMotion(motion);
    const Recording recording = recorder.Finish();
    for (const Motion& motion : program) {
      const double lag = std::holds_alternative<motion::DogLeg>(motion.path) ? 1.0 : 0.0;
      for (int i = 1; i <= 300; ++i) {
        const double s = i / 300.0;
        const double time = motion.start_time + motion.ElapsedTime(s, lag);
        if (time < motion.start_time + 1e-3 || time > motion.start_time + motion.duration - 1e-3) {
          continue;  // There the axes jump, to where the next random motion begins.
        }
        double off = 1e9;
        for (double late = -1.0; late <= 1.0; late += 0.1) {  // A tick.
          const JointVector shown = recording.PoseAt(time * kTicksPerSecond + late);
          off = std::min(off, rig.Apart(motion.At(s, lag), shown));
        }
        EXPECT_LE(off, kShownTolerance) << seed << " " << motion.where.line << " " << s;
        worst = std::max(worst, off);
      }
    }
  }
  EXPECT_GT(worst, 0.2 * kShownTolerance);  // Else there are more keys than it takes.
}

TEST(RecordingTest, StraightMotionsOfOneRateAreOneKey) {
  motion::Random random(3);
  const Rig rig(&random);
  const JointVector q = JointVector::Zero(rig.machine.tree.num_moving());
  JointVector step = q;
  step[0] = 0.5;
  Recorder recorder(rig.machine, rig.scene, {});
  for (int i = 0; i < 1000; ++i) {
    Motion motion = motion::MakeMotion(motion::AxisLinear{q + i * step, q + (i + 1) * step});
    motion.where = {0, i + 1, 1};
    motion.start_time = 0.1 * i;
    motion.duration = 0.1;
    recorder.OnMotion(motion);
  }
  const Recording recording = recorder.Finish();
  EXPECT_EQ(recording.ticks, (std::vector<std::uint32_t>{0, 1000000}));
  EXPECT_EQ(recording.steps.size(), 1000U);
  EXPECT_EQ(recording.steps[700].where.line, 701);
  EXPECT_EQ(recording.steps[700].begin, 700000U);
  EXPECT_NEAR(recording.PoseAt(500000)[0], 250.0, 1e-9);
}

TEST(RecordingTest, ADwellWithoutAxesAndAJumpInNoTime) {
  motion::Random random(4);
  const Rig rig(&random);
  const JointVector zero = JointVector::Zero(rig.machine.tree.num_moving());
  JointVector there = zero;
  there[1] = 30.0;
  Recorder recorder(rig.machine, rig.scene, {});
  Motion rest = motion::MakeMotion(motion::AxisLinear{zero, zero});
  rest.duration = 1.0;
  recorder.OnMotion(rest);
  Motion dwell;
  dwell.kind = motion::MotionKind::kDwell;
  dwell.start_time = 1.0;
  dwell.duration = 2.0;
  recorder.OnMotion(dwell);
  rest.path = motion::AxisLinear{there, there};
  rest.start_time = 3.0;
  recorder.OnMotion(rest);
  const Recording recording = recorder.Finish();
  EXPECT_TRUE(std::is_sorted(recording.ticks.begin(), recording.ticks.end()));
  EXPECT_EQ(recording.PoseAt(29999)[1], 0.0);
  EXPECT_EQ(recording.PoseAt(recording.end)[1], 30.0);
  EXPECT_EQ(recording.end, 40000U);
}

}  // namespace
}  // namespace ncsim::report
