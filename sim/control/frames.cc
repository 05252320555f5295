// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/frames.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "sim/control/arc.h"

namespace ncsim::control {
namespace {

void SetLinear(const Eigen::Vector3d& point, AxisValues* values) {
  for (std::size_t i = 0; i < 3; ++i) (*values)[i] = point[static_cast<int>(i)];
}

}  // namespace

AxisMap::AxisMap(const machine::Machine& machine) : num_joints_(machine.tree.num_moving()) {
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    data_[i] = machine.FindAxis(kLetters[i]);
    joints_[i] = data_[i] == nullptr ? -1 : data_[i]->joint;
  }
}

JointVector AxisMap::Joints(const AxisValues& values) const {
  JointVector q = JointVector::Zero(num_joints_);
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    if (joints_[i] >= 0) q[joints_[i]] = values[i];
  }
  return q;
}

AxisValues AxisMap::Values(const JointVector& q) const {
  AxisValues values{};
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    if (joints_[i] >= 0) values[i] = q[joints_[i]];
  }
  return values;
}

AxisValues ApplyProgramFrame(const ProgramFrame& frame, AxisValues point) {
  if (frame.active) SetLinear(frame.to + frame.linear * (Linear(point) - frame.from), &point);
  return point;
}

AxisValues RemoveProgramFrame(const ProgramFrame& frame, AxisValues point) {
  if (!frame.active) return point;
  SetLinear(frame.from + frame.linear.inverse() * (Linear(point) - frame.to), &point);
  return point;
}

Frames::Frames(const machine::Machine& machine, ControlKinematics kinematics)
    : kinematics_(std::move(kinematics)), axes_(machine) {}

// Work offsets are measured with the rotary axes at 0 (a rotary offset beside DWO or TCP is refused
// before it comes here), so program zero in the table follows from the offset's X, Y, Z alone.
void Frames::Use(const std::shared_ptr<const Frame>& frame) {
  if (frame_ == frame) return;
  frame_ = frame;
  dwo_valid_ = false;
  tcp_.reset();
  if (frame->rotation == Frame::Rotation::kNone || !can_rotate()) return;
  const auto tip = [&](const Eigen::Vector3d& q, const ProgramFrame& program) {
    AxisValues machine{};
    SetLinear(q, &machine);
    machine = ApplyProgramFrame(program, machine);
    for (std::size_t i = 0; i < 3; ++i) machine[i] += frame->offset[i];
    machine[kZ] += frame->tool_length;
    Eigen::Vector3d p_BT_B, u_B;
    kinematics_.five_axis->TipInTable(axes_.Joints(machine), frame->tool_length, &p_BT_B, &u_B);
    return p_BT_B;
  };
  origin_B_ = tip(Eigen::Vector3d::Zero(), {});
  if (frame->rotation != Frame::Rotation::kTcp) return;
  const ProgramFrame& program = frame->program;
  in_table_.origin = tip(Eigen::Vector3d::Zero(), program);
  for (int i = 0; i < 3; ++i) {
    in_table_.linear.col(i) = tip(Eigen::Vector3d::Unit(i), program) - in_table_.origin;
  }
  in_table_.inverse = in_table_.linear.inverse();
  tcp_ = std::make_shared<const motion::TcpFrame>(
      motion::TcpFrame{*kinematics_.five_axis, frame->tool_length, kinematics_.centre_error});
}

const std::shared_ptr<const motion::TcpFrame>& Frames::Tcp(
    const std::shared_ptr<const Frame>& frame) {
  Use(frame);
  return tcp_;
}

const ProgramInTable& Frames::InTable(const std::shared_ptr<const Frame>& frame) {
  Use(frame);
  return in_table_;
}

const Eigen::Vector3d& Frames::DwoOrigin(const AxisValues& machine) {
  const std::array<double, 3> at = {machine[kA], machine[kB], machine[kC]};
  if (!dwo_valid_ || at != dwo_at_) {
    JointVector q = axes_.Joints(machine);
    kinematics_.five_axis->SolveLinear(origin_B_, frame_->tool_length, &q);
    dwo_origin_ = Linear(axes_.Values(q));
    dwo_at_ = at;
    dwo_valid_ = true;
  }
  return dwo_origin_;
}

AxisValues Frames::ToMachine(const std::shared_ptr<const Frame>& frame, const AxisValues& program) {
  const AxisValues turned = ApplyProgramFrame(frame->program, program);
  AxisValues machine{};
  for (std::size_t i = 0; i < kNumAxes; ++i) machine[i] = frame->offset[i] + turned[i];
  machine[kZ] += frame->tool_length;
  if (frame->rotation == Frame::Rotation::kNone || !can_rotate()) return machine;
  Use(frame);
  if (frame->rotation == Frame::Rotation::kDwo) {
    const Eigen::Vector3d& origin = DwoOrigin(machine);
    for (std::size_t i = 0; i < 3; ++i) machine[i] = origin[static_cast<int>(i)] + turned[i];
    return machine;
  }
  JointVector q = axes_.Joints(machine);
  kinematics_.five_axis->SolveLinear(in_table_.Point(Linear(program)), frame->tool_length, &q);
  const AxisValues solved = axes_.Values(q);
  for (std::size_t i = 0; i < 3; ++i) machine[i] = solved[i];
  return machine;
}

AxisValues Frames::ToProgram(const std::shared_ptr<const Frame>& frame, const AxisValues& machine) {
  AxisValues program{};
  for (std::size_t i = 0; i < kNumAxes; ++i) program[i] = machine[i] - frame->offset[i];
  program[kZ] -= frame->tool_length;
  if (frame->rotation != Frame::Rotation::kNone && can_rotate()) {
    Use(frame);
    Eigen::Vector3d q;
    if (frame->rotation == Frame::Rotation::kDwo) {
      q = Linear(machine) - DwoOrigin(machine);
    } else {
      Eigen::Vector3d p_BT_B, u_B;
      kinematics_.five_axis->TipInTable(axes_.Joints(machine), frame->tool_length, &p_BT_B, &u_B);
      q = in_table_.Program(p_BT_B);
    }
    SetLinear(q, &program);
    if (frame->rotation == Frame::Rotation::kTcp) return program;
  }
  return RemoveProgramFrame(frame->program, program);
}

ProgramFrame Frames::OnTable(const AxisValues& offset, const AxisValues& machine) const {
  const auto turned = [&](const Eigen::Vector3d& q) {
    AxisValues at{};
    SetLinear(Linear(offset) + q, &at);
    Eigen::Vector3d p_BT_B, u_B;
    kinematics_.five_axis->TipInTable(axes_.Joints(at), 0.0, &p_BT_B, &u_B);
    JointVector joints = axes_.Joints(machine);
    kinematics_.five_axis->SolveLinear(p_BT_B, 0.0, &joints);
    return Linear(axes_.Values(joints));
  };
  ProgramFrame frame;
  const Eigen::Vector3d origin = turned(Eigen::Vector3d::Zero());
  frame.active = true;
  frame.to = origin - Linear(offset);
  for (int i = 0; i < 3; ++i) frame.linear.col(i) = turned(Eigen::Vector3d::Unit(i)) - origin;
  // Differences of places far out: a rotation is made one to the last digit, so that arcs stay
  // such.
  constexpr double kRounding = 1e-10;
  const Eigen::Matrix3d square = frame.linear.transpose() * frame.linear;
  if ((square - Eigen::Matrix3d::Identity()).norm() <= kRounding) {
    frame.linear = Eigen::Quaterniond(frame.linear).normalized().toRotationMatrix();
  }
  return frame;
}

Eigen::Vector3d Frames::DirectionInTable(const Eigen::Vector3d& direction) const {
  AxisValues at{};
  Eigen::Vector3d from, to, u_B;
  kinematics_.five_axis->TipInTable(axes_.Joints(at), 0.0, &from, &u_B);
  SetLinear(direction, &at);
  kinematics_.five_axis->TipInTable(axes_.Joints(at), 0.0, &to, &u_B);
  return to - from;
}

bool Frames::tool_is_upright() const {
  constexpr double kTurn = 0.5, kNear = 1e-9;  // rad; of any size but a half turn
  const AxisValues turned = {0.0, 0.0, 0.0, kTurn, kTurn, kTurn};
  JointVector joints = axes_.Joints(turned);
  Eigen::Vector3d p_BT_B, u_B;
  kinematics_.five_axis->TipInTable(joints, 0.0, &p_BT_B, &u_B);
  kinematics_.five_axis->SolveLinear(p_BT_B + u_B, 0.0, &joints);
  return (Linear(axes_.Values(joints)) - Eigen::Vector3d::UnitZ()).norm() <= kNear;
}

Eigen::Vector3d Frames::VectorToMachine(const Frame& frame, const Eigen::Vector3d& v) {
  return frame.program.active ? Eigen::Vector3d(frame.program.linear * v) : v;
}

}  // namespace ncsim::control
