// SPDX-License-Identifier: BSD-3-Clause
// A small machine in code, for this module's tests: X, Y, Z carry the spindle, B and C the table;
// frame B coincides with the machine frame at B0 C0, and the gauge line stands at (X, Y, Z).
// Programs are given by the tool tip.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "kinematics/test_machines.h"
#include "sim/base/units.h"
#include "sim/collision/checker.h"
#include "sim/collision/test_shapes.h"

namespace ncsim::collision {

class Rig {
 public:
  static constexpr double kToolLength = 150.0;
  static constexpr double kRapidRate = 400.0;  // mm/s
  static constexpr double kRamp = 0.2;         // s

  Rig() : Rig(kinematics::TrunnionBC({0, 0, 0}, {0, 0, 0})) {}
  explicit Rig(const kinematics::TestMachine& m) {
    machine_.tree = m.tree;
    machine_.spindle_link = m.spindle_link;
    machine_.table_link = m.table_link;
    machine_.five_axis = kinematics::FiveAxis::Make(machine_.tree, m.spindle_link, m.table_link);
    const char letters[] = {'X', 'Y', 'Z', 'B', 'C'};
    for (int i = 0; i < 5; ++i) {
      machine::Axis axis;
      axis.letter = letters[i];
      axis.joint = i;
      axis.rotary = i > 2;
      machine_.axes.push_back(axis);
    }
    q_ = motion::JointVector::Zero(5);
    q_[2] = 1000.0;
    AddTool(3, CylinderProfile(0, 30, 5), CylinderProfile(30, 90, 5), CylinderProfile(90, 150, 20));
  }

  machine::Machine& machine() { return machine_; }
  const machine::Machine& machine() const { return machine_; }
  machine::CheckSettings& check() { return check_; }

  machine::Tool& AddTool(int number, machine::Profile flutes, machine::Profile shank,
                         machine::Profile holder) {
    machine::Tool tool;
    tool.number = number;
    tool.length = kToolLength;
    tool.flutes = std::move(flutes);
    tool.shank = std::move(shank);
    tool.holder = std::move(holder);
    tools_.tools.push_back(std::move(tool));
    return tools_.tools.back();
  }

  machine::SceneBody& AddBody(std::string name, machine::BodyKind kind, machine::TriangleMesh mesh,
                              int link = -1) {
    machine::SceneBody body;
    body.name = std::move(name);
    body.kind = kind;
    body.link = link < 0 ? machine_.table_link : link;
    body.mesh = std::move(mesh);
    scene_.bodies.push_back(std::move(body));
    return scene_.bodies.back();
  }
  machine::SceneBody& AddBox(std::string name, machine::BodyKind kind, const Eigen::Vector3d& lower,
                             const Eigen::Vector3d& upper) {
    return AddBody(std::move(name), kind, BoxMesh(lower, upper));
  }

  /// Where the program begins; the present tip position.
  void Start(double x, double y, double z, double b_deg = 0.0, double c_deg = 0.0) {
    q_ = Joints(x, y, z, b_deg, c_deg);
  }
  motion::Facts& facts() { return facts_; }

  motion::Motion& Linear(motion::MotionKind kind, double x, double y, double z, double b_deg = 0.0,
                         double c_deg = 0.0) {
    const motion::JointVector q1 = Joints(x, y, z, b_deg, c_deg);
    return Add(kind, motion::AxisLinear{q_, q1}, q1);
  }
  motion::Motion& Feed(double x, double y, double z, double b_deg = 0.0, double c_deg = 0.0) {
    return Linear(motion::MotionKind::kFeed, x, y, z, b_deg, c_deg);
  }
  motion::Motion& Rapid(double x, double y, double z, double b_deg = 0.0, double c_deg = 0.0) {
    return Linear(motion::MotionKind::kRapid, x, y, z, b_deg, c_deg);
  }
  motion::Motion& DogLeg(double x, double y, double z, double ramp = kRamp) {
    const motion::JointVector q1 = Joints(x, y, z, 0, 0);
    motion::DogLeg path;
    path.q0 = q_;
    path.q1 = q1;
    path.duration = (q1 - q_).cwiseAbs() / kRapidRate;
    path.ramp = motion::JointVector::Constant(5, ramp);
    return Add(motion::MotionKind::kRapid, path, q1);
  }
  /// The tip goes straight in the table frame while B and C turn.
  motion::Motion& Tcp(const Eigen::Vector3d& p0_B, const Eigen::Vector3d& p1_B, double b0_deg,
                      double c0_deg, double b1_deg, double c1_deg) {
    motion::TcpCurve path;
    path.frame =
        std::make_shared<motion::TcpFrame>(motion::TcpFrame{*machine_.five_axis, kToolLength, 0.0});
    path.q0 = Joints(0, 0, 0, b0_deg, c0_deg);
    path.q1 = Joints(0, 0, 0, b1_deg, c1_deg);
    machine_.five_axis->SolveLinear(p0_B, kToolLength, &path.q0);
    machine_.five_axis->SolveLinear(p1_B, kToolLength, &path.q1);
    path.p0_B = p0_B;
    path.p1_B = p1_B;
    path.centre = path.e1 = path.e2 = path.pitch = path.end_error = Eigen::Vector3d::Zero();
    q_ = path.q0;
    const motion::JointVector q1 = path.q1;
    return Add(motion::MotionKind::kFeed, std::move(path), q1);
  }

  motion::JointVector Joints(double x, double y, double z, double b_deg, double c_deg) const {
    motion::JointVector q(5);
    q << x, y, z + kToolLength, Radians(b_deg), Radians(c_deg);
    return q;
  }

  /// `window`: motions of each window.
  CollisionResult Run(std::size_t window = motion::kWindowSize,
                      const OutcomeCache* cache = nullptr) const {
    CollisionChecker checker(machine_, scene_, tools_, check_, cache);
    for (std::size_t i = 0; i < motions_.size(); i += window) {
      const auto end = std::min(motions_.size(), i + window);
      checker.Check({{motions_.begin() + static_cast<std::ptrdiff_t>(i),
                      motions_.begin() + static_cast<std::ptrdiff_t>(end)}});
    }
    return checker.Finish();
  }
  /// The same program with each straight motion in two parts, of one block, somewhere.
  Rig Split(kinematics::Random* random) const {
    Rig rig = *this;
    rig.motions_.clear();
    for (const motion::Motion& whole : motions_) {
      const auto* line = std::get_if<motion::AxisLinear>(&whole.path);
      rig.motions_.push_back(whole);
      if (line == nullptr) continue;
      const double s = random->Uniform(0.05, 0.95);
      const motion::JointVector middle = whole.At(s);
      rig.motions_.back().path = motion::AxisLinear{line->q0, middle};
      rig.motions_.back().duration = s * whole.duration;
      rig.motions_.push_back(whole);
      rig.motions_.back().path = motion::AxisLinear{middle, line->q1};
      rig.motions_.back().start_time += s * whole.duration;
      rig.motions_.back().duration = (1.0 - s) * whole.duration;
    }
    return rig;
  }
  const std::vector<motion::Motion>& motions() const { return motions_; }
  std::vector<motion::Motion>& motions() { return motions_; }
  const machine::Scene& scene() const { return scene_; }
  machine::Scene& scene() { return scene_; }
  const machine::ToolTable& tools() const { return tools_; }
  machine::ToolTable& tools() { return tools_; }

 private:
  motion::Motion& Add(motion::MotionKind kind, motion::Path path, const motion::JointVector& q1) {
    motion::Motion m;
    m.kind = kind;
    m.where = {0, static_cast<int>(motions_.size()) + 1, 1};
    m.path = std::move(path);
    m.start_time = static_cast<double>(motions_.size());
    m.duration = 1.0;
    m.facts = facts_;
    motions_.push_back(std::move(m));
    q_ = q1;
    return motions_.back();
  }

  machine::Machine machine_;
  machine::Scene scene_;
  machine::ToolTable tools_;
  machine::CheckSettings check_;
  motion::Facts facts_ = [] {
    motion::Facts facts;
    facts.tool = 3;
    facts.spindle_on = true;
    return facts;
  }();
  std::vector<motion::Motion> motions_;
  motion::JointVector q_;
};

inline std::vector<Finding> Of(const CollisionResult& result, Rule rule) {
  std::vector<Finding> found;
  std::copy_if(result.findings.begin(), result.findings.end(), std::back_inserter(found),
               [rule](const Finding& f) { return f.rule == rule; });
  return found;
}

/// All that a report tells, each number to its last bit.
inline std::string Everything(const CollisionResult& result) {
  std::ostringstream text;
  text << std::hexfloat;
  for (const Finding& f : result.findings) {
    text << f.where.line << ' ' << static_cast<int>(f.severity) << ' ' << f.message << ' '
         << f.clearance_mm.value_or(0.0) << ' ' << f.time_s.value_or(0.0);
    for (const auto& [letter, value] : f.axes) text << ' ' << letter << value;
    for (const auto& point : f.points)
      text << ' ' << point[0] << ',' << point[1] << ',' << point[2];
    text << '\n';
  }
  for (const PairClearance& c : result.clearances) {
    text << c.bodies.front() << ' ' << c.bodies.back() << ' ' << c.proven_mm << ' ' << c.seen_mm
         << ' ' << c.where.line << '\n';
  }
  for (const DeepestCut& c : result.cuts) text << c.tool << ' ' << c.depth_mm << '\n';
  text << result.queries;
  return text.str();
}

inline std::string Words(const CollisionResult& result) {
  std::string text;
  for (const Finding& f : result.findings) {
    text += std::to_string(f.where.line) + ": " + std::string(ToString(f.severity)) + ": " +
            f.message + " [" + std::string(Info(f.rule).id) + "]\n";
  }
  return text;
}

}  // namespace ncsim::collision
