// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/path.h"

#include <algorithm>
#include <cmath>

#include "kinematics/relative_bound.h"

namespace ncsim::motion {

JointVector Interpolate(const JointVector& q0, const JointVector& q1, double s) {
  JointVector q(q0.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = std::lerp(q0[i], q1[i], s);
  return q;
}

Eigen::Vector3d ArcPoint(const AxisArc& arc, double s) {
  const double phi = arc.phi0 + s * arc.sweep;
  return arc.centre + arc.radius * (std::cos(phi) * arc.e1 + std::sin(phi) * arc.e2) +
         s * (arc.pitch + arc.end_error);
}

Eigen::Vector3d TipPoint(const TcpCurve& curve, double s) {
  if (!curve.arc) return curve.p0_B + s * (curve.p1_B - curve.p0_B);
  const double phi = curve.phi0 + s * curve.sweep;
  return curve.centre + curve.radius * (std::cos(phi) * curve.e1 + std::sin(phi) * curve.e2) +
         s * (curve.pitch + curve.end_error);
}

double TipTravel(const TcpCurve& curve, double ds) {
  if (!curve.arc) return ds * (curve.p1_B - curve.p0_B).norm();
  const Eigen::Vector3d drift = ds * (curve.pitch + curve.end_error);
  const double out_of_plane = drift.dot(curve.e1.cross(curve.e2));
  const double in_plane =
      std::sqrt(std::max(0.0, drift.squaredNorm() - out_of_plane * out_of_plane));
  const double chord = curve.radius * kinematics::Chord(ds * std::abs(curve.sweep));
  return std::hypot(chord + in_plane, out_of_plane);
}

/// With linear directions D (mm per mm) in a frame that R turns, D x = R^T (tip - T(rotary joints)
/// tool): each rotary joint's change moves one of the two points about its axis. Joint by joint as
/// in kinematics::RelativePath,
///   |D dx| <= |d tip| + sum_k Chord(|d rotary_k|) * (distance of the tip from rotary axis k, at
///   q).
TcpReach Reach(const TcpCurve& curve, const JointVector& q, double s, double ds) {
  const kinematics::FiveAxis& control = curve.frame->control;
  TcpReach reach;
  reach.deviation = RotaryTravel(curve, s, ds);
  const std::array<double, 2> radii = control.TipRadii(TipPoint(curve, s), curve.frame->length, q);
  reach.linear_distance = TipTravel(curve, ds);
  for (std::size_t k = 0; k < control.rotary().size(); ++k) {
    reach.linear_distance += kinematics::Chord(reach.deviation[control.rotary()[k]]) * radii[k];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    reach.deviation[control.linear()[i]] =
        reach.linear_distance * control.linear_gain()[static_cast<Eigen::Index>(i)];
  }
  return reach;
}

}  // namespace ncsim::motion
