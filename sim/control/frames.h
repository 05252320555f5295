// SPDX-License-Identifier: BSD-3-Clause
// Program coordinates <-> machine values, through a Frame and the kinematics that the control
// believes in. Neutral of dialect, generic for any tree with three linear and up to two rotary
// axes.
//
// With w the offset, q the program coordinates, L the tool length along Z and P the rotary centre,
// on a BC table machine (R = Ry(-B) Rz(-C)); settled by Haas' own samples, NGC Mill Operator's
// Manual 2017, G234 and G254:
//   none: M = w + q + L      DWO: M = P + R (w - P) + q + L      TCP: M = P + R (w + q - P) + L
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>

#include "sim/control/command.h"
#include "sim/control/control_kinematics.h"
#include "sim/machine/machine.h"
#include "sim/motion/motion.h"

namespace ncsim::control {

using motion::JointVector;

/// Where the program axes are among the joints.
class AxisMap {
 public:
  explicit AxisMap(const machine::Machine& machine);
  /// JointVector index; -1 for an axis that the machine lacks.
  int joint(int axis) const { return joints_[static_cast<std::size_t>(axis)]; }
  bool has(int axis) const { return joint(axis) >= 0; }
  const machine::Axis& data(int axis) const { return *data_[static_cast<std::size_t>(axis)]; }
  int num_joints() const { return num_joints_; }
  JointVector Joints(const AxisValues& values) const;
  AxisValues Values(const JointVector& q) const;

 private:
  std::array<int, kNumAxes> joints_{};
  std::array<const machine::Axis*, kNumAxes> data_{};
  int num_joints_ = 0;
};

/// X, Y, Z of a point in program coordinates <-> table frame B, as the control sees it under TCP.
struct ProgramInTable {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d Point(const Eigen::Vector3d& q) const { return linear * q + origin; }
  Eigen::Vector3d Vector(const Eigen::Vector3d& v) const { return linear * v; }
  Eigen::Vector3d Program(const Eigen::Vector3d& p_B) const { return inverse * (p_B - origin); }
};

class Frames {
 public:
  /// `machine` outlives this.
  Frames(const machine::Machine& machine, ControlKinematics kinematics);

  const AxisMap& axes() const { return axes_; }
  /// False: the machine has no three linear axes, so DWO and TCP cannot be computed.
  bool can_rotate() const { return kinematics_.five_axis.has_value(); }

  /// Machine values (the control's readout) of program coordinates. Axes that the machine lacks
  /// pass through.
  AxisValues ToMachine(const std::shared_ptr<const Frame>& frame, const AxisValues& program);
  AxisValues ToProgram(const std::shared_ptr<const Frame>& frame, const AxisValues& machine);
  /// How the coordinates of a work offset (measured with the rotary axes at 0) lie in machine
  /// directions, from the offset's machine values on, while the rotary axes stand as in `machine`:
  /// the part has gone with its table. Needs can_rotate().
  ProgramFrame OnTable(const AxisValues& offset, const AxisValues& machine) const;
  /// A direction in machine axes, rotary axes at 0, as one in the table; unit where it is.
  Eigen::Vector3d DirectionInTable(const Eigen::Vector3d& direction) const;
  /// No rotary axis turns the tool: only tables. Needs can_rotate().
  bool tool_is_upright() const;
  /// A direction or a position relative to another, X, Y, Z, from program to machine directions.
  /// Not for TCP.
  static Eigen::Vector3d VectorToMachine(const Frame& frame, const Eigen::Vector3d& v);

  /// For a frame with Rotation::kTcp: shared by the motions until the frame changes.
  const std::shared_ptr<const motion::TcpFrame>& Tcp(const std::shared_ptr<const Frame>& frame);
  const ProgramInTable& InTable(const std::shared_ptr<const Frame>& frame);
  /// As the control believes them to be; needs can_rotate().
  const kinematics::FiveAxis& five_axis() const { return *kinematics_.five_axis; }

 private:
  void Use(const std::shared_ptr<const Frame>& frame);
  const Eigen::Vector3d& DwoOrigin(const AxisValues& machine_rotaries);

  ControlKinematics kinematics_;
  AxisMap axes_;
  // What is worked out once a frame.
  std::shared_ptr<const Frame> frame_;
  Eigen::Vector3d origin_B_ = Eigen::Vector3d::Zero();  ///< Program zero in the table.
  ProgramInTable in_table_;
  std::shared_ptr<const motion::TcpFrame> tcp_;
  std::array<double, 3> dwo_at_{};  ///< A, B, C for which dwo_origin_ holds.
  bool dwo_valid_ = false;
  Eigen::Vector3d dwo_origin_ = Eigen::Vector3d::Zero();  ///< Machine values of program zero.
};

/// Coordinates of the work offset <-> program coordinates of the programmable frame.
AxisValues ApplyProgramFrame(const ProgramFrame& frame, AxisValues point);
AxisValues RemoveProgramFrame(const ProgramFrame& frame, AxisValues point);

}  // namespace ncsim::control
