// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/frames.h"

#include <cmath>
#include <utility>

#include "sim/control/arc.h"

namespace ncsim::control {
namespace {

Eigen::Vector3d Linear(const AxisValues& values) { return {values[kX], values[kY], values[kZ]}; }

// Turns two coordinates of `point` by `angle` about the frame's G68 centre.
AxisValues TurnInPlane(const Frame& frame, AxisValues point, double angle) {
  const PlaneAxes plane = AxesOf(frame.g68_plane);
  double& first = point[static_cast<std::size_t>(plane.first)];
  double& second = point[static_cast<std::size_t>(plane.second)];
  const double u = first - frame.g68_centre[0];
  const double v = second - frame.g68_centre[1];
  first = frame.g68_centre[0] + std::cos(angle) * u - std::sin(angle) * v;
  second = frame.g68_centre[1] + std::sin(angle) * u + std::cos(angle) * v;
  return point;
}

}  // namespace

AxisMap::AxisMap(const machine::Machine& machine) : num_joints_(machine.tree.num_moving()) {
  constexpr std::array<char, kNumAxes> kLetters = {'X', 'Y', 'Z', 'A', 'B', 'C'};
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

AxisValues ApplyG68(const Frame& frame, const AxisValues& point) {
  return frame.g68 ? TurnInPlane(frame, point, frame.g68_angle) : point;
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
  const auto tip = [&](const Eigen::Vector3d& q) {
    AxisValues machine{};
    for (std::size_t i = 0; i < 3; ++i) machine[i] = frame->offset[i] + q[static_cast<int>(i)];
    machine[kZ] += frame->tool_length;
    Eigen::Vector3d p_BT_B, u_B;
    kinematics_.five_axis->TipInTable(axes_.Joints(machine), frame->tool_length, &p_BT_B, &u_B);
    return p_BT_B;
  };
  origin_B_ = tip(Eigen::Vector3d::Zero());
  if (frame->rotation != Frame::Rotation::kTcp) return;
  in_table_.origin = origin_B_;
  for (int i = 0; i < 3; ++i) in_table_.rotation.col(i) = tip(Eigen::Vector3d::Unit(i)) - origin_B_;
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
  const AxisValues turned = ApplyG68(*frame, program);
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
  kinematics_.five_axis->SolveLinear(in_table_.Point(Linear(turned)), frame->tool_length, &q);
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
    for (std::size_t i = 0; i < 3; ++i) program[i] = q[static_cast<int>(i)];
  }
  return frame->g68 ? TurnInPlane(*frame, program, -frame->g68_angle) : program;
}

Eigen::Vector3d Frames::VectorToMachine(const Frame& frame, const Eigen::Vector3d& v) {
  if (!frame.g68) return v;
  Frame about_zero = frame;
  about_zero.g68_centre[0] = about_zero.g68_centre[1] = 0.0;
  const AxisValues turned =
      TurnInPlane(about_zero, {v.x(), v.y(), v.z(), 0.0, 0.0, 0.0}, frame.g68_angle);
  return Linear(turned);
}

}  // namespace ncsim::control
