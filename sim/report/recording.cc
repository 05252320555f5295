// SPDX-License-Identifier: BSD-3-Clause
#include "sim/report/recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/base/units.h"

namespace ncsim::report {
namespace {

using motion::JointVector;

/// Of the tolerance: what may happen between two samples.
constexpr double kBetween = 0.25;
constexpr int kDeepest = 10;              // halvings of a piece of a motion
constexpr double kLeastReach = 100.0;     // mm
constexpr double kEndlessReach = 5000.0;  // mm: of a linear axis without limits
constexpr double kUnitsOfRadian = 180.0 / 3.14159265358979323846 * kValuesPerUnit;

std::uint32_t Tick(double time) {
  const double ticks = std::round(time * kTicksPerSecond);
  return static_cast<std::uint32_t>(
      std::clamp(ticks, 0.0, static_cast<double>(std::numeric_limits<std::uint32_t>::max())));
}

double Farthest(const machine::TriangleMesh& mesh) {
  double farthest = 0.0;
  for (const Eigen::Vector3d& v : mesh.vertices) farthest = std::max(farthest, v.norm());
  return farthest;
}

/// mm: how far from each link's origin anything lies that hangs on the link, in any pose.
std::vector<double> Reaches(const machine::Machine& machine, const machine::Scene& scene,
                            const machine::ToolTable& tools) {
  const auto& links = machine.tree.links();
  std::vector<double> reach(links.size(), kLeastReach);
  const auto widen = [&](int link, double value) {
    double& known = reach[static_cast<std::size_t>(link)];
    known = std::max(known, value);
  };
  for (const machine::SceneBody& body : scene.bodies) widen(body.link, Farthest(body.mesh));
  for (const machine::Tool& tool : tools.tools) {
    widen(machine.spindle_link, tool.length + tool.diameter + kLeastReach);
  }
  for (std::size_t i = links.size(); i-- > 1;) {  // A parent stands before its children.
    const kinematics::Joint& joint =
        machine.tree.joints()[static_cast<std::size_t>(links[i].parent_joint)];
    double way = joint.X_PJ.translation().norm();
    if (joint.type == kinematics::JointType::kPrismatic) {
      const double travel = std::max(std::abs(joint.lower), std::abs(joint.upper));
      way += std::isfinite(travel) ? travel : kEndlessReach;
    }
    widen(joint.parent_link, way + reach[i]);
  }
  return reach;
}

}  // namespace

JointVector Recording::Key(std::size_t i) const {
  JointVector q(num_joints);
  for (int j = 0; j < num_joints; ++j) {
    const auto at = i * static_cast<std::size_t>(num_joints) + static_cast<std::size_t>(j);
    q[j] = values[at] / (rotary[static_cast<std::size_t>(j)] ? kUnitsOfRadian : kValuesPerUnit);
  }
  return q;
}

JointVector Recording::PoseAt(double tick) const {
  const auto after = std::upper_bound(ticks.begin(), ticks.end(), tick);
  if (after == ticks.begin()) return Key(0);
  const auto i = static_cast<std::size_t>(after - ticks.begin()) - 1;
  if (after == ticks.end()) return Key(i);
  const double part = (tick - ticks[i]) / (ticks[i + 1] - ticks[i]);
  return Key(i) + part * (Key(i + 1) - Key(i));
}

Recorder::Recorder(const machine::Machine& machine, const machine::Scene& scene,
                   const machine::ToolTable& tools) {
  const int joints = machine.tree.num_moving();
  recording_.num_joints = joints;
  recording_.rotary.resize(static_cast<std::size_t>(joints));
  tolerance_.resize(joints);
  const std::vector<double> reach = Reaches(machine, scene, tools);
  for (int j = 0; j < joints; ++j) {
    const kinematics::Joint& joint = machine.tree.joints()[static_cast<std::size_t>(
        machine.tree.moving_joints()[static_cast<std::size_t>(j)])];
    const bool rotary = joint.type == kinematics::JointType::kRevolute;
    recording_.rotary[static_cast<std::size_t>(j)] = rotary;
    tolerance_[j] = kShownTolerance / joints /
                    (rotary ? reach[static_cast<std::size_t>(joint.child_link)] : 1.0);
  }
}

void Recorder::AddStep(const motion::Motion& motion) {
  std::vector<Step>& steps = recording_.steps;
  const Step step{Tick(motion.start_time), motion.where, motion.kind, motion.facts.tool,
                  motion.facts.offset};
  if (!steps.empty()) {
    const Step& last = steps.back();
    if (last.where.file == step.where.file && last.where.line == step.where.line &&
        last.kind == step.kind && last.tool == step.tool && last.offset == step.offset) {
      return;
    }
  }
  steps.push_back(step);
}

void Recorder::OnMotion(const motion::Motion& motion) {
  AddStep(motion);
  recording_.end = std::max(recording_.end, Tick(motion.start_time + motion.duration));
  if (motion.q0().size() != recording_.num_joints) return;  // A dwell that states no axes.
  const Sample begin{motion.start_time, motion.q0()};
  const Sample end{motion.start_time + motion.duration, motion.q1()};
  const bool elsewhere = !empty_ && (last_.q - begin.q).cwiseAbs().maxCoeff() > 1e-9;
  if (elsewhere) Add({begin.time, last_.q});  // They rest until they are there.
  if (empty_ || elsewhere || last_.time < begin.time) Add(begin);
  if (std::holds_alternative<motion::AxisLinear>(motion.path)) {
    Add(end);
    return;
  }
  // As the machine goes with the acceleration that is stated.
  const double lag = std::holds_alternative<motion::DogLeg>(motion.path) ? 1.0 : 0.0;
  const int pieces = std::holds_alternative<motion::DogLeg>(motion.path) ? 64 : 16;
  Sample a = begin;
  for (int i = 1; i <= pieces; ++i) {
    const double s = static_cast<double>(i) / pieces;
    const Sample b =
        i == pieces ? end
                    : Sample{motion.start_time + motion.ElapsedTime(s, lag), motion.At(s, lag)};
    Refine(motion, lag, s - 1.0 / pieces, a, s, b, 0);
    a = b;
  }
}

// The curvature hardly changes over a sixteenth of a motion; a dog-leg has kinks.
void Recorder::Refine(const motion::Motion& motion, double lag, double s0, const Sample& a,
                      double s1, const Sample& b, int depth) {
  const double s = 0.5 * (s0 + s1);
  const Sample middle{motion.start_time + motion.ElapsedTime(s, lag), motion.At(s, lag)};
  const double span = b.time - a.time;
  const double part = span > 0.0 ? (middle.time - a.time) / span : 0.5;
  const JointVector off = (middle.q - a.q - part * (b.q - a.q)).cwiseAbs();
  if (depth < kDeepest && (off.array() > kBetween * tolerance_.array()).any()) {
    Refine(motion, lag, s0, a, s, middle, depth + 1);
    Refine(motion, lag, s, middle, s1, b, depth + 1);
    return;
  }
  Add(middle);
  Add(b);
}

bool Recorder::InsideDoor(const Sample& sample) const {
  const double span = sample.time - key_.time;
  if (span <= 0.0) return false;
  const JointVector slope = (sample.q - key_.q) / span;
  return (slope.array() >= lower_.array()).all() && (slope.array() <= upper_.array()).all();
}

void Recorder::NarrowDoor(const Sample& sample) {
  const double span = sample.time - key_.time;
  if (span <= 0.0) return;
  const JointVector off = sample.q - key_.q;
  lower_ = lower_.cwiseMax((off - (1.0 - kBetween) * tolerance_) / span);
  upper_ = upper_.cwiseMin((off + (1.0 - kBetween) * tolerance_) / span);
}

void Recorder::Add(const Sample& sample) {
  if (empty_) {
    empty_ = false;
    Emit(sample);
  } else if (!InsideDoor(sample)) {
    if (last_.time > key_.time) Emit(last_);
    // The axes are elsewhere at once.
    if (sample.time <= key_.time && sample.q != key_.q) Emit(sample);
  }
  NarrowDoor(sample);
  last_ = sample;
}

void Recorder::Emit(const Sample& sample) {
  const auto joints = static_cast<std::size_t>(recording_.num_joints);
  std::uint32_t tick = Tick(sample.time);
  std::vector<std::uint32_t>& ticks = recording_.ticks;
  if (!ticks.empty() && tick <= ticks.back()) tick = ticks.back() + 1;
  ticks.push_back(tick);
  for (std::size_t j = 0; j < joints; ++j) {
    const double unit = recording_.rotary[j] ? kUnitsOfRadian : kValuesPerUnit;
    recording_.values.push_back(
        static_cast<std::int32_t>(std::lround(sample.q[static_cast<Eigen::Index>(j)] * unit)));
  }
  key_ = sample;
  lower_ = JointVector::Constant(recording_.num_joints, -std::numeric_limits<double>::infinity());
  upper_ = -lower_;
}

Recording Recorder::Finish() {
  if (!empty_ && (last_.time > key_.time || last_.q != key_.q)) Emit(last_);
  if (!recording_.ticks.empty()) {
    recording_.end = std::max(recording_.end, recording_.ticks.back());
  }
  return std::move(recording_);
}

}  // namespace ncsim::report
