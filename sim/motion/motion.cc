// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/motion.h"

#include <algorithm>
#include <cmath>

#include "sim/motion/path.h"

namespace ncsim::motion {
namespace {

struct PositionAt {
  double s;
  double lag;

  JointVector operator()(const AxisLinear& path) const { return Interpolate(path.q0, path.q1, s); }

  JointVector operator()(const DogLeg& path) const {
    const DogLegClock clock(path);
    JointVector q(path.q0.size());
    for (int i = 0; i < static_cast<int>(q.size()); ++i) {
      const bool rests = path.q0[i] == path.q1[i];
      q[i] = rests ? path.q0[i] : std::lerp(path.q0[i], path.q1[i], clock.Progress(i, s, lag));
    }
    return q;
  }

  JointVector operator()(const AxisArc& path) const {
    JointVector q = Interpolate(path.q0, path.q1, s);
    const Eigen::Vector3d point = ArcPoint(path, s);
    for (int i = 0; i < 3; ++i) q[path.linear[static_cast<std::size_t>(i)]] = point[i];
    return q;
  }

  JointVector operator()(const TcpCurve& path) const {
    JointVector q = RotaryAt(path, s);
    path.frame->control.SolveLinear(TipPoint(path, s), path.frame->length, &q);
    return q;
  }
};

/// True when all axes that move keep in proportion, whatever the acceleration.
bool InProportion(const DogLeg& path) {
  double duration = 0.0;
  double ramp = 0.0;
  for (Eigen::Index i = 0; i < path.q0.size(); ++i) {
    if (path.q0[i] == path.q1[i]) continue;
    if (duration > 0.0 && (path.duration[i] != duration || path.ramp[i] != ramp)) return false;
    duration = path.duration[i];
    ramp = path.ramp[i];
  }
  return true;
}

}  // namespace

bool IsFeed(const Motion& motion) {
  return motion.kind == MotionKind::kFeed || motion.kind == MotionKind::kArc;
}

bool IsRapid(const Motion& motion) {
  return motion.kind == MotionKind::kRapid || motion.kind == MotionKind::kToolChange;
}

std::string_view ToString(MotionKind kind) {
  switch (kind) {
    case MotionKind::kRapid:
      return "rapid";
    case MotionKind::kFeed:
      return "feed";
    case MotionKind::kArc:
      return "arc";
    case MotionKind::kDwell:
      return "dwell";
    case MotionKind::kToolChange:
      return "toolchange";
  }
  return "";
}

const JointVector& Motion::q0() const {
  return std::visit([](const auto& p) -> const JointVector& { return p.q0; }, path);
}

const JointVector& Motion::q1() const {
  return std::visit([](const auto& p) -> const JointVector& { return p.q1; }, path);
}

JointVector Motion::At(double s, double lag) const { return std::visit(PositionAt{s, lag}, path); }

double Motion::ElapsedTime(double s, double lag) const {
  if (const auto* dog_leg = std::get_if<DogLeg>(&path)) {
    return std::min(DogLegClock(*dog_leg).Time(s, lag), Duration(*dog_leg, lag));
  }
  return s * duration;
}

Span Whole(const Motion& motion) {
  Span span;
  if (const auto* dog_leg = std::get_if<DogLeg>(&motion.path)) {
    span.lag1 = InProportion(*dog_leg) ? 0.0 : 1.0;
  }
  return span;
}

}  // namespace ncsim::motion
