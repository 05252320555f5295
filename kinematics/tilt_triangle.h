// SPDX-License-Identifier: BSD-3-Clause
// Spherical trigonometry of two rotary axes and a tool. Private to this folder.
#pragma once

#include <Eigen/Core>

namespace ncsim::kinematics {

/// Angle between two directions, [0, pi]; exact near both ends.
double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Paden-Kahan subproblem 1: the angle about `axis` that turns `from` to `to`, which make the same
/// angle with it. By cross products, because near the pole the dot products cancel.
double AngleAbout(const Eigen::Vector3d& axis, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to);

/// True when `axis` is parallel to `v`, either way (to 1e-10 rad).
bool Along(const Eigen::Vector3d& axis, const Eigen::Vector3d& v);

/// The triangle on the unit sphere between the joint that tilts the tool, the other one, and the
/// tool: two sides are fixed, the third, from `other` to the tool, follows from the angle at the
/// tilting axis. By half angles, which stay exact near the pole.
class TiltTriangle {
 public:
  TiltTriangle(const Eigen::Vector3d& tilt, const Eigen::Vector3d& other,
               const Eigen::Vector3d& tool);

  /// Least and greatest angle between the tool and `other` that tilting can make.
  double nearest() const { return nearest_; }
  double farthest() const { return farthest_; }
  /// Position of the tilting joint at `nearest`.
  double at_nearest() const { return at_nearest_; }
  /// How far from there, [0, pi], either way, the tool makes the angle `alpha` with `other`: grows
  /// with alpha; the ends beyond nearest and farthest.
  double TurnTo(double alpha) const;
  /// The angle at `other` between the tilting axis and the tool, [0, pi], at that turn (Napier's
  /// analogies). At a turn of 0 that puts the tool on `other`, its limit.
  double Azimuth(double turn) const;
  /// The turn at which Azimuth() has its one extreme between 0 and pi; 0 where it has none.
  double TurnOfExtremeAzimuth() const;

 private:
  double phi_other_;
  double phi_tool_;
  double nearest_;
  double farthest_;
  double at_nearest_;
};

}  // namespace ncsim::kinematics
