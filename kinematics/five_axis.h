// SPDX-License-Identifier: BSD-3-Clause
// Tool against part: what a control's kinematic transformation (TCPC, TRAORI) needs, written once for any tree with
// three linear and up to two rotary axes: table-table, head-table, head-head; AB, AC, BC; orthogonal or nutating.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kinematics/tree.h"

namespace ncsim::kinematics {

/// One way to reach a tool axis: the rotary joints' positions in rad, in the order of FiveAxis::rotary().
struct RotarySolution {
  std::array<double, 2> angles{};
  /// True where the second rotary is free (its axis is parallel to the tool axis): its angle is then 0.
  bool at_pole = false;
};

class FiveAxis {
 public:
  /// `spindle_link` carries frame S (gauge line, Z out of the spindle toward the tool: the NC tool axis is -Z_S);
  /// `table_link` carries frame B. The moving joints between them must be three prismatic ones with independent
  /// directions and at most two revolute ones; nullopt otherwise.
  static std::optional<FiveAxis> Make(const KinematicTree& tree, int spindle_link, int table_link);

  const std::vector<int>& linear() const { return linear_; }   ///< JointVector indices.
  const std::vector<int>& rotary() const { return rotary_; }   ///< JointVector indices: nearer the base of the
                                                               ///< orientation (tilt) first, then the other.
  int spindle_link() const { return spindle_link_; }
  int table_link() const { return table_link_; }

  /// X_BS at q.
  Eigen::Isometry3d SpindleInTable(const JointVector& q) const;
  /// Tip (at `length` along the tool from the gauge line) and tool axis (unit, tip -> holder), in frame B.
  void TipInTable(const JointVector& q, double length, Eigen::Vector3d* p_BT_B, Eigen::Vector3d* u_B) const;

  /// Writes into the linear joints of `q` what puts the tip on `p_BT_B`, at the rotary positions that `q` has. Exact: the
  /// tip depends on the linear joints affinely.
  void SolveLinear(const Eigen::Vector3d& p_BT_B, double length, JointVector* q) const;

  /// All rotary positions in (-pi, pi] that turn the tool axis to `u_B` (unit); none if it cannot be reached.
  /// Limits are not looked at.
  std::vector<RotarySolution> SolveRotary(const Eigen::Vector3d& u_B) const;

 private:
  KinematicTree tree_;
  int spindle_link_ = 0;
  int table_link_ = 0;
  std::vector<int> linear_;
  std::vector<int> rotary_;
};

}  // namespace ncsim::kinematics
