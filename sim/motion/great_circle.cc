// SPDX-License-Identifier: BSD-3-Clause
// The rotary joints of a TCP curve: in proportion, or as the tool axis' way along a great circle
// asks (kinematics::GreatCircle, whose ranges are rigorous).
#include <algorithm>

#include "sim/motion/path.h"

namespace ncsim::motion {

JointVector RotaryAt(const TcpCurve& curve, double s) {
  JointVector q = Interpolate(curve.q0, curve.q1, s);
  if (curve.great_circle == nullptr) return q;
  const std::array<double, 2> angles = curve.great_circle->RotaryAt(s);
  for (std::size_t k = 0; k < 2; ++k) q[curve.frame->control.rotary()[k]] = angles[k];
  return q;
}

JointBox RotaryOver(const TcpCurve& curve, double s0, double s1) {
  const JointVector a = Interpolate(curve.q0, curve.q1, s0);
  const JointVector b = Interpolate(curve.q0, curve.q1, s1);
  JointBox box{a.cwiseMin(b), a.cwiseMax(b)};
  if (curve.great_circle == nullptr) return box;
  const auto ranges = curve.great_circle->RotaryOver(s0, s1);
  for (std::size_t k = 0; k < 2; ++k) {
    box.lower[curve.frame->control.rotary()[k]] = ranges[k].lower;
    box.upper[curve.frame->control.rotary()[k]] = ranges[k].upper;
  }
  return box;
}

JointVector RotaryTravel(const TcpCurve& curve, double s, double ds) {
  if (curve.great_circle == nullptr) return ds * (curve.q1 - curve.q0).cwiseAbs();
  const JointVector q = RotaryAt(curve, s);
  const JointBox box = RotaryOver(curve, std::max(0.0, s - ds), std::min(1.0, s + ds));
  return (box.upper - q).cwiseMax(q - box.lower).cwiseMax(0.0);
}

}  // namespace ncsim::motion
