// SPDX-License-Identifier: BSD-3-Clause
// How each kind of path runs: what motion.cc, box.cc and relative_bound.cc share. Private to this
// folder.
#pragma once

#include "sim/motion/motion.h"

namespace ncsim::motion {

/// The interval that something takes over a span.
struct Interval {
  double lower = 0.0;
  double upper = 0.0;
};

/// Component-wise from q0 to q1; exact at both ends and monotone.
JointVector Interpolate(const JointVector& q0, const JointVector& q1, double s);

/// The clock of a dog-leg (see DogLeg), made once a query.
class DogLegClock {
 public:
  explicit DogLegClock(const DogLeg& path);

  /// s since the start, not clamped to the end of the motion.
  double Time(double s, double lag) const;
  /// How far axis `axis` is on its way, 0 to 1.
  double Progress(int axis, double s, double lag) const;
  /// Least and greatest Progress over the span: exact.
  Interval ProgressOver(int axis, const Span& span) const;

 private:
  /// Least and greatest Progress at `s` over the span's lags.
  Interval ProgressAt(int axis, double s, const Span& span) const;

  const DogLeg& path_;
  double shift_ = 0.0;
  double end_ = 0.0;
};

/// centre + radius (cos(phi) e1 + sin(phi) e2) + s (pitch + end_error).
Eigen::Vector3d ArcPoint(const AxisArc& arc, double s);
/// The tip of the control's tool in B.
Eigen::Vector3d TipPoint(const TcpCurve& curve, double s);
/// All joints but the linear ones, which are in proportion.
JointVector RotaryAt(const TcpCurve& curve, double s);
/// What all joints but the linear ones take over [s0, s1], within [0, 1].
JointBox RotaryOver(const TcpCurve& curve, double s0, double s1);
/// How far each of them gets from where it is at `s` within `ds` of it.
JointVector RotaryTravel(const TcpCurve& curve, double s, double ds);
/// Upper bound of the distance between two tips whose s differ by at most `ds`.
double TipTravel(const TcpCurve& curve, double ds);

/// What the joints of a TCP curve can do within `ds` of the pose `q` at `s`.
struct TcpReach {
  JointVector deviation;  ///< Of each joint.
  double linear_distance =
      0.0;  ///< Of the linear joints together: how far they carry the tool, mm.
};
TcpReach Reach(const TcpCurve& curve, const JointVector& q, double s, double ds);

}  // namespace ncsim::motion
