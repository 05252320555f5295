// SPDX-License-Identifier: BSD-3-Clause
// Box: what every joint can be at, anywhere in a span.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/motion/path.h"

namespace ncsim::motion {
namespace {

/// Box with the corners `a` and `b`, in any order.
JointBox Between(const JointVector& a, const JointVector& b) {
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

/// Extremes of the cosine over [angle0, angle1], in any order.
Interval CosineOver(double angle0, double angle1) {
  const auto [first, last] = std::minmax(angle0, angle1);
  const double cosine0 = std::cos(first);
  const double cosine1 = std::cos(last);
  Interval cosine{std::min(cosine0, cosine1), std::max(cosine0, cosine1)};
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (std::floor(last / kTurn) >= std::ceil(first / kTurn)) cosine.upper = 1.0;
  constexpr double kHalf = std::numbers::pi;
  if (std::floor((last - kHalf) / kTurn) >= std::ceil((first - kHalf) / kTurn)) {
    cosine.lower = -1.0;
  }
  return cosine;
}

struct BoxOver {
  Span span;

  JointBox operator()(const AxisLinear& path) const {
    return Between(Interpolate(path.q0, path.q1, span.s0), Interpolate(path.q0, path.q1, span.s1));
  }

  JointBox operator()(const DogLeg& path) const {
    const DogLegClock clock(path);
    JointVector begin(path.q0.size());
    JointVector end(path.q0.size());
    for (int i = 0; i < static_cast<int>(begin.size()); ++i) {
      begin[i] = end[i] = path.q0[i];
      if (path.q0[i] == path.q1[i]) continue;
      const Interval progress = clock.ProgressOver(i, span);
      begin[i] = std::lerp(path.q0[i], path.q1[i], progress.lower);
      end[i] = std::lerp(path.q0[i], path.q1[i], progress.upper);
    }
    return Between(begin, end);
  }

  JointBox operator()(const AxisArc& path) const {
    JointBox box =
        Between(Interpolate(path.q0, path.q1, span.s0), Interpolate(path.q0, path.q1, span.s1));
    const double phi0 = path.phi0 + span.s0 * path.sweep;
    const double phi1 = path.phi0 + span.s1 * path.sweep;
    const Eigen::Vector3d drift = path.pitch + path.end_error;
    for (int i = 0; i < 3; ++i) {
      const double amplitude = path.radius * std::hypot(path.e1[i], path.e2[i]);
      const double phase = std::atan2(path.e2[i], path.e1[i]);
      const Interval cosine = CosineOver(phi0 - phase, phi1 - phase);
      const auto [least, most] = std::minmax({span.s0 * drift[i], span.s1 * drift[i]});
      const int joint = path.linear[static_cast<std::size_t>(i)];
      box.lower[joint] = path.centre[i] + amplitude * cosine.lower + least;
      box.upper[joint] = path.centre[i] + amplitude * cosine.upper + most;
    }
    return box;
  }

  JointBox operator()(const TcpCurve& path) const {
    JointBox box = RotaryOver(path, span.s0, span.s1);
    const double middle = 0.5 * (span.s0 + span.s1);
    JointVector q = RotaryAt(path, middle);
    path.frame->control.SolveLinear(TipPoint(path, middle), path.frame->length, &q);
    const TcpReach reach = Reach(path, q, middle, 0.5 * (span.s1 - span.s0));
    for (const int i : path.frame->control.linear()) {
      box.lower[i] = q[i] - reach.deviation[i];
      box.upper[i] = q[i] + reach.deviation[i];
    }
    return box;
  }
};

}  // namespace

JointBox Box(const Motion& motion, const Span& span) {
  return std::visit(BoxOver{span}, motion.path);
}

}  // namespace ncsim::motion
