// SPDX-License-Identifier: BSD-3-Clause
#include "sim/checks/test_machine.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "sim/base/units.h"

namespace ncsim::checks {
namespace {

using kinematics::Joint;
using kinematics::JointType;

Joint MakeJoint(const char* name, JointType type, int parent, int child,
                const Eigen::Vector3d& axis, double lower, double upper) {
  Joint joint;
  joint.name = name;
  joint.type = type;
  joint.parent_link = parent;
  joint.child_link = child;
  joint.axis = axis;
  joint.lower = lower;
  joint.upper = upper;
  return joint;
}

}  // namespace

machine::Machine TestMachine() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  std::vector<kinematics::Link> links = {
      {"base_link", -1},     {"x", 0}, {"y", 1}, {"z", 2}, {"spindle_gauge", 3}, {"b", 4},
      {"workpiece_mount", 5}};
  std::vector<Joint> joints = {
      MakeJoint("X", JointType::kPrismatic, 0, 1, x, -762.0, 0.0),
      MakeJoint("Y", JointType::kPrismatic, 1, 2, y, -508.0, 0.0),
      MakeJoint("Z", JointType::kPrismatic, 2, 3, z, -444.5, 63.5),
      MakeJoint("nose", JointType::kFixed, 3, 4, x, 0.0, 0.0),
      MakeJoint("B", JointType::kRevolute, 0, 5, -y, Radians(-35.0), Radians(120.0)),
      MakeJoint("C", JointType::kRevolute, 5, 6, -z, -74.0 * kPi, 74.0 * kPi)};
  joints[3].X_PJ.linear() = Eigen::AngleAxisd(kPi, x).toRotationMatrix();
  joints[4].X_PJ.translation() = Eigen::Vector3d(-381.0, -254.0, -500.0);
  machine::Machine machine;
  machine.name = "test";
  machine.tree = kinematics::KinematicTree(std::move(links), std::move(joints));
  machine.spindle_link = machine.tree.FindLink("spindle_gauge");
  machine.table_link = machine.tree.FindLink("workpiece_mount");
  machine.five_axis =
      kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  for (const char letter : {'X', 'Y', 'Z', 'B', 'C'}) {
    const int found = machine.tree.FindJoint(std::string(1, letter));
    const Joint& joint = machine.tree.joints().at(static_cast<std::size_t>(found));
    machine::Axis axis;
    axis.letter = letter;
    axis.joint = joint.index;
    axis.rotary = joint.type == JointType::kRevolute;
    axis.lower = joint.lower;
    axis.upper = joint.upper;
    axis.rapid = axis.rotary ? Radians(50.0) : 22896.0 / 60.0;
    machine.axes.push_back(axis);
  }
  return machine;
}

motion::JointVector Axes(double x, double y, double z, double b_deg, double c_deg) {
  motion::JointVector q(5);
  q << x, y, z, Radians(b_deg), Radians(c_deg);
  return q;
}

motion::Motion Feed(int line, const motion::JointVector& q0, const motion::JointVector& q1) {
  motion::Motion motion;
  motion.kind = motion::MotionKind::kFeed;
  motion.where = {0, line, 1};
  motion.path = motion::AxisLinear{q0, q1};
  motion.duration = 1.0;
  motion.facts.feed = 10.0;
  motion.facts.spindle_on = true;
  motion.facts.tool = 1;
  return motion;
}

motion::Motion Rapid(int line, const motion::JointVector& q0, const motion::JointVector& q1,
                     const motion::JointVector& duration) {
  motion::Motion motion = Feed(line, q0, q1);
  motion.kind = motion::MotionKind::kRapid;
  motion.facts.feed = 0.0;
  motion.path = motion::DogLeg{q0, q1, duration, motion::JointVector::Zero(q0.size())};
  motion.duration = duration.maxCoeff();
  return motion;
}

motion::Motion TcpFeed(const machine::Machine& machine, int line, const Eigen::Vector3d& p0_B,
                       const Eigen::Vector3d& p1_B, double b0_deg, double c0_deg, double b1_deg,
                       double c1_deg) {
  motion::TcpCurve curve;
  auto frame = std::make_shared<motion::TcpFrame>(motion::TcpFrame{*machine.five_axis, 250.0, 0.0});
  curve.frame = frame;
  curve.q0 = Axes(0.0, 0.0, 0.0, b0_deg, c0_deg);
  curve.q1 = Axes(0.0, 0.0, 0.0, b1_deg, c1_deg);
  frame->control.SolveLinear(p0_B, frame->length, &curve.q0);
  frame->control.SolveLinear(p1_B, frame->length, &curve.q1);
  curve.p0_B = p0_B;
  curve.p1_B = p1_B;
  curve.centre = curve.e1 = curve.e2 = curve.pitch = curve.end_error = Eigen::Vector3d::Zero();
  motion::Motion motion = Feed(line, curve.q0, curve.q1);
  motion.path = curve;
  motion.facts.tcp = true;
  return motion;
}

motion::Motion VectorFeed(const machine::Machine& machine, int line, const Eigen::Vector3d& p0_B,
                          const Eigen::Vector3d& p1_B, double b0_deg, double c0_deg, double b1_deg,
                          double c1_deg) {
  motion::Motion motion = TcpFeed(machine, line, p0_B, p1_B, b0_deg, c0_deg, b1_deg, c1_deg);
  auto& curve = std::get<motion::TcpCurve>(motion.path);
  auto circle = std::make_shared<kinematics::GreatCircle>();
  const auto fault =
      kinematics::GreatCircle::Make(curve.frame->control, {Radians(b0_deg), Radians(c0_deg)},
                                    {Radians(b1_deg), Radians(c1_deg)}, circle.get());
  if (fault != kinematics::GreatCircle::Fault::kNone) throw std::invalid_argument("no circle");
  curve.great_circle = std::move(circle);
  return motion;
}

std::vector<Finding> RunCheck(std::unique_ptr<Check> check,
                              const std::vector<motion::Motion>& motions) {
  std::vector<Finding> findings;
  for (const motion::Motion& motion : motions) check->OnMotion(motion, &findings);
  check->Finish(&findings);
  return findings;
}

}  // namespace ncsim::checks
