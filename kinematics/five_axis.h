// SPDX-License-Identifier: BSD-3-Clause
// Tool against part: what a control's kinematic transformation (TCPC, TRAORI) needs, written once
// for any tree with three linear and up to two rotary axes: table-table, head-table, head-head; AB,
// AC, BC; orthogonal or nutating.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kinematics/tree.h"

namespace ncsim::kinematics {

/// One way to reach a tool axis: the rotary joints' positions in rad, in the order of
/// FiveAxis::rotary().
struct RotarySolution {
  std::array<double, 2> angles{};
  /// True where a rotary joint is free, because its axis is parallel to the tool axis: its angle is
  /// then 0. With two joints it is the second (C of a BC table at B0).
  bool at_pole = false;
};

/// Product of exponentials (Lynch and Park, Modern Robotics, 2017, section 4.1) of the path from B
/// to S. The linear joints move the tool by a fixed matrix in a frame that at most the rotary
/// joints on the table's side turn.
class FiveAxis {
 public:
  /// `spindle_link` carries frame S (gauge line, Z out of the spindle toward the tool: the NC tool
  /// axis is -Z_S); `table_link` carries frame B. The moving joints between them must be three
  /// prismatic ones with independent directions and at most two revolute ones; nullopt otherwise,
  /// and also where a revolute joint turns some of the linear directions against the others (a ram
  /// in a swivelling head), which could make them dependent.
  static std::optional<FiveAxis> Make(const KinematicTree& tree, int spindle_link, int table_link);

  /// JointVector indices, ascending: the order of the file.
  const std::vector<int>& linear() const { return linear_; }
  /// JointVector indices along the path from the spindle to the table: the one that tilts the tool
  /// against the other's axis first (B of BC table-table, of C-B head-head and of a B head over a C
  /// table), then the other.
  const std::vector<int>& rotary() const { return rotary_; }
  /// Direction of each of them (unit) and the tool axis, in frame B with all joints at 0.
  const Eigen::Vector3d& rotary_direction(std::size_t k) const { return axes_[k].direction; }
  Eigen::Vector3d tool_axis() const { return -X_BS0_.linear().col(2); }
  int spindle_link() const { return spindle_link_; }
  int table_link() const { return table_link_; }

  /// X_BS at q.
  Eigen::Isometry3d SpindleInTable(const JointVector& q) const;
  /// Tip (at `length` along the tool from the gauge line) and tool axis (unit, tip -> holder), in
  /// frame B.
  void TipInTable(const JointVector& q, double length, Eigen::Vector3d* p_BT_B,
                  Eigen::Vector3d* u_B) const;

  /// The same, with the distance from each rotary axis, in rotary() order, of a unit vector along
  /// the tool that starts on it: RadiiAboutTip of Z.
  struct ToolPose {
    Eigen::Vector3d tip = Eigen::Vector3d::Zero();
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    std::array<double, 2> radii{};
  };
  ToolPose ToolInTable(const JointVector& q, double length) const;

  /// Writes into the linear joints of `q` what puts the tip on `p_BT_B`, at the rotary positions
  /// that `q` has. Exact: the tip depends on the linear joints affinely.
  void SolveLinear(const Eigen::Vector3d& p_BT_B, double length, JointVector* q) const;

  /// All rotary positions in (-pi, pi] that turn the tool axis to `u_B` (unit); none if it cannot
  /// be reached (by more than 1e-9 rad). Limits are not looked at. Paden-Kahan subproblems 1 and 2
  /// for the general pair of axes (Murray, Li and Sastry, A Mathematical Introduction to Robotic
  /// Manipulation, 1994, section 3.2).
  std::vector<RotarySolution> SolveRotary(const Eigen::Vector3d& u_B) const;

  /// Distance of the tip at `p_BT_B` from each rotary axis, in rotary() order, mm (0 for a joint
  /// that is not there). The linear joints of `q` are taken as SolveLinear leaves them.
  std::array<double, 2> TipRadii(const Eigen::Vector3d& p_BT_B, double length,
                                 const JointVector& q) const;
  /// Distance of a point at `v_S` from the tip (in S) from the line through the tip parallel to
  /// each rotary axis.
  std::array<double, 2> RadiiAboutTip(const Eigen::Vector3d& v_S, const JointVector& q) const;
  /// For each linear joint, in linear() order: its greatest change when the tool moves by 1 mm.
  const Eigen::Vector3d& linear_gain() const { return linear_gain_; }
  /// True when the linear axes are square to each other: then a tool displacement of d moves no set
  /// of them by more than d.
  bool linear_square() const { return linear_square_; }
  /// All that it knows, as numbers: two that have the same ones give the same answers.
  std::vector<double> Parameters() const;

 private:
  /// A rotary joint at q = 0, in frame B.
  struct RotaryAxis {
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d point = Eigen::Vector3d::Zero();

    Eigen::Vector3d TurnPoint(double angle, const Eigen::Vector3d& p) const;
    double Distance(const Eigen::Vector3d& p) const;
  };

  FiveAxis() = default;
  bool FindLinearFrame(const std::vector<int>& rotary_before, int path_rotaries);
  /// True when rotary `k` (rotary() order) stands between B and the frame of the linear joints.
  bool BeforeLinear(std::size_t k) const;
  std::vector<RotarySolution> SolveOneRotary(std::size_t k, const Eigen::Vector3d& u_B) const;

  int spindle_link_ = 0;
  int table_link_ = 0;
  std::vector<int> linear_;
  std::vector<int> rotary_;
  std::array<RotaryAxis, 2> axes_;          // rotary() order: the tool meets axes_[0] first
  std::size_t rotaries_before_linear_ = 0;  // of those next to B
  Eigen::Matrix3d directions_ =
      Eigen::Matrix3d::Identity();  // columns in linear() order, in B at q = 0
  Eigen::Matrix3d directions_inverse_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d linear_gain_ = Eigen::Vector3d::Ones();
  bool linear_square_ = true;
  Eigen::Isometry3d X_BS0_ = Eigen::Isometry3d::Identity();  // at q = 0
};

}  // namespace ncsim::kinematics
