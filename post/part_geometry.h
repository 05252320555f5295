// SPDX-License-Identifier: BSD-3-Clause
// A part on a machine, as a post sees it: from poses of the tool in the part frame P to rotary
// positions and program coordinates. mm, rad; P and program coordinates as plan.h has them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "kinematics/reachable.h"
#include "post/plan.h"
#include "sim/machine/machine.h"

namespace ncsim::post {

using Rotary = std::array<double, 2>;  ///< In FiveAxis::rotary() order, rad.

/// rad, of two vectors.
inline double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

class PartGeometry {
 public:
  /// `machine` must outlive this and have `five_axis`. `X_BP`: the part frame on the table.
  /// `increment`: what a rotary word is rounded to, rad. `length`: of the tool from the gauge line,
  /// which matters where a rotary axis carries the spindle.
  PartGeometry(const machine::Machine& machine, const Eigen::Isometry3d& X_BP, double increment,
               double length = 0.0);

  std::size_t num_rotary() const { return five_axis_->rotary().size(); }
  /// The letter of a rotary axis, in FiveAxis::rotary() order.
  char letter(std::size_t k) const { return letters_[k]; }
  const kinematics::RotaryLimits& limits() const { return limits_; }

  /// The nearest positions that rotary words can say.
  Rotary OnGrid(const Rotary& rotary) const;
  /// The rotary positions on the control's grid within the limits for a tool axis, nearest first
  /// (kinematics::ReachableRotary). Empty where it cannot be reached.
  std::vector<Rotary> Reach(const Eigen::Vector3d& axis_P, const Rotary& from) const;
  /// The same without looking at the limits.
  std::vector<Rotary> ReachAnywhere(const Eigen::Vector3d& axis_P, const Rotary& from) const;
  /// How the rotary axes lead the tool axis along the great circle from where they stand to
  /// `axis_P`, without a jump, on the control's grid; on to the other branch where the circle comes
  /// nearer to the pole than `pole_tolerance` (rad). `start`: where they must stand to begin with,
  /// which is `from` but at the pole, where the second axis is free. nullopt where they would leave
  /// the limits.
  struct Way {
    Rotary start{}, end{};
  };
  std::optional<Way> Follow(const Eigen::Vector3d& axis_P, const Rotary& from,
                            double pole_tolerance) const;
  /// The positions for a tool axis between those of a and b, which Follow() has joined. Beside the
  /// pole the second axis goes on in proportion where that leads the tool axis within
  /// `pole_tolerance` (rad).
  std::optional<Rotary> Between(const Eigen::Vector3d& axis_P, const Rotary& a, const Rotary& b,
                                double pole_tolerance) const;
  /// The second axis is free: the tool axis is parallel to it, within half a millionth of a degree.
  bool AtPole(const Eigen::Vector3d& axis_P) const;
  /// The tool axis that is parallel to the second axis, on the side of `axis_P`; none without one.
  std::optional<Eigen::Vector3d> Pole(const Eigen::Vector3d& axis_P) const;
  /// The position with the second axis at `second` that leads the tool axis nearest to `axis_P`, a
  /// degree from the pole at most.
  std::optional<Rotary> BesidePole(const Eigen::Vector3d& axis_P, double second) const;
  /// The control that leads the tool axis on great circles leads it so from a to b: along the
  /// branch they are on, no nearer to the pole than `pole_limit` (rad).
  bool OnCircle(const Rotary& a, const Rotary& b, double pole_limit) const;
  /// The tool axis at rotary positions.
  Eigen::Vector3d ToolAxis(const Rotary& rotary) const;

  /// Program coordinates of the tip. `plane_P` in kIndexed: the plane's own directions; null: those
  /// of P as the rotary axes have turned them.
  Eigen::Vector3d Xyz(PlanMode mode, const Eigen::Matrix3d* plane_P, const Eigen::Vector3d& tip_P,
                      const Rotary& rotary) const;
  /// What a displacement in P is in program coordinates, at fixed rotary positions: a rotation.
  Eigen::Matrix3d Directions(PlanMode mode, const Eigen::Matrix3d* plane_P,
                             const Rotary& rotary) const;
  /// Which axis a feed of `time` (s) from a to b would need to be faster than it is, and the time
  /// that it needs; none where all are fast enough. Of modes whose X, Y, Z are the machine's.
  struct Slow {
    char letter = ' ';
    double time = 0.0;  ///< s
  };
  std::optional<Slow> TooSlow(const PlanPose& a, const PlanPose& b, double time) const;
  /// Where the tip is in P when X, Y, Z of kAxes and the rotary axes stand there.
  Eigen::Vector3d TipOfAxes(const Eigen::Vector3d& xyz, const Rotary& rotary) const;

 private:
  std::vector<Rotary> ReachWithin(const Eigen::Vector3d& axis_P, const Rotary& from,
                                  const kinematics::RotaryLimits& limits) const;
  kinematics::JointVector Joints(const Rotary& rotary) const;
  /// X, Y, Z of the machine with the tip at p_B.
  Eigen::Vector3d Linear(const Eigen::Vector3d& p_B, const Rotary& rotary) const;

  const machine::Machine* machine_;
  const kinematics::FiveAxis* five_axis_;
  Eigen::Isometry3d X_BP_;
  double increment_;
  double length_;
  std::array<int, 3> xyz_joints_{};
  std::array<char, 2> letters_{};
  kinematics::RotaryLimits limits_;
  Eigen::Vector3d zero_;  ///< X, Y, Z of the machine with the tip at P's zero, rotary axes at 0.
};

}  // namespace ncsim::post
