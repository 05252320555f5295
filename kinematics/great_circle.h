// SPDX-License-Identifier: BSD-3-Clause
// A tool axis that goes along a great circle in the part (ORIVECT, vector interpolation), as a
// continuous function of two rotary joints.
#pragma once

#include <array>

#include "kinematics/five_axis.h"
#include "kinematics/tilt_triangle.h"

namespace ncsim::kinematics {

/// u(s), s in [0, 1], goes at constant speed along the shorter arc of the great circle through u(0)
/// and u(1), unit vectors in B. At each s the rotary joints are the closed solution of the branch
/// that they start on, so u is exact everywhere, near the pole too (where the second joint swings).
///
/// With o the second joint's axis ("the pole") and psi the way along the circle from its point
/// nearest to o, the angle alpha to the pole and the azimuth about it are
///   cos alpha = cos psi cos alpha0,   azimuth = +-atan2(sin psi, cos psi sin alpha0),
/// alpha0 the angle between o and the circle's plane. The first joint follows from alpha alone, and
/// grows or falls with it; the second is the circle's azimuth less that of the tilted tool
/// (TiltTriangle). Each is made of monotone pieces, so what they take over a stretch is known from
/// its ends and these pieces' ends.
class GreatCircle {
 public:
  enum class Fault {
    kNone,
    kNotTwoAxes,   ///< The machine has not two rotary joints that both turn the tool axis.
    kNoTurn,       ///< The tool axes of the ends are equal (within 1e-9 rad): no circle.
    kOpposite,     ///< Or opposite: no one circle.
    kThroughPole,  ///< The circle leads through the pole: a path for each side of it can be made.
    kUnreachable,  ///< It leads where the machine cannot tilt the tool.
    kOtherBranch,  ///< The joints, led along it from `from`, come to another solution than `to`.
  };

  /// From the joints' positions `from` to those of `to`, in FiveAxis::rotary() order, rad. Where
  /// the circle leads to is end(): `to` but for whole turns of the joints, and for the second joint
  /// where it ends at the pole. Where it starts at the pole the second joint is free to begin with,
  /// and must stand at start(); elsewhere start() is `from`.
  static Fault Make(const FiveAxis& five_axis, const std::array<double, 2>& from,
                    const std::array<double, 2>& to, GreatCircle* circle);

  const std::array<double, 2>& start() const { return start_; }
  const std::array<double, 2>& end() const { return end_; }
  /// Between u(0) and u(1), rad.
  double angle() const { return angle_; }
  Eigen::Vector3d AxisAt(double s) const;
  /// Joint positions; start() and end() at the ends, exactly.
  std::array<double, 2> RotaryAt(double s) const;

  struct Range {
    double lower = 0.0, upper = 0.0;
  };
  /// What the joints take over [s0, s1], within [0, 1]: never too little; too much only for the
  /// second joint of a nutating machine, by what shrinks with the stretch.
  std::array<Range, 2> RotaryOver(double s0, double s1) const;

  /// Made by Make() only.
  GreatCircle()
      : triangle_(Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ()) {}

 private:
  void Place(const Eigen::Vector3d& other, Eigen::Vector3d u0, Eigen::Vector3d u1);
  Fault Anchor(const std::array<double, 2>& from, const std::array<double, 2>& to);
  bool PassesPole() const;
  /// At the way psi along the circle.
  double Alpha(double psi) const;
  double Azimuth(double psi) const;
  Range AlphaOver(double psi0, double psi1) const;
  double Tilt(double turn) const { return tilt_at_nearest_ + branch_ * turn; }
  double Other(double azimuth, double turn) const {
    return other_offset_ + azimuth + branch_ * triangle_.Azimuth(turn);
  }
  std::array<double, 2> Joints(double psi) const;

  TiltTriangle triangle_;
  double angle_ = 0.0;
  Eigen::Vector3d nearest_B_ = Eigen::Vector3d::UnitX();  // the circle's point nearest to the pole
  Eigen::Vector3d ahead_B_ = Eigen::Vector3d::UnitY();    // a quarter turn on
  double sin_alpha0_ = 0.0, cos_alpha0_ = 1.0;
  double sense_ = 1.0;     // of the azimuth
  bool meridian_ = false;  // the circle leads through the pole: its azimuth is constant
  double psi0_ = 0.0;
  double branch_ = 1.0;
  double tilt_at_nearest_ = 0.0, other_offset_ = 0.0;
  std::array<double, 2> start_{}, end_{};
  double slack_ = 0.0;  // rad: rounding, and what the stated ends differ from the closed solution
};

/// The least angle, rad, between the second joint's axis (either way round: the poles) and the
/// shorter arc of the great circle from the tool axis at the joints `from` to that at `to`, in
/// FiveAxis::rotary() order. Half a turn for a machine without two rotary joints: it has no pole.
double AngleFromPole(const FiveAxis& five_axis, const std::array<double, 2>& from,
                     const std::array<double, 2>& to);

}  // namespace ncsim::kinematics
