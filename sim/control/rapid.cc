// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/rapid.h"

#include <algorithm>
#include <cmath>

namespace ncsim::control {
namespace {

// Axes first..last share time in proportion to what the slowest needs.
void Group(const AxisMap& axes, int first, int last, motion::DogLeg* rapid) {
  double duration = 0.0;  // s, of the slowest
  double square = 0.0;    // s^2: the largest way over acceleration
  for (int axis = first; axis <= last; ++axis) {
    if (!axes.has(axis)) continue;
    const machine::Axis& data = axes.data(axis);
    const double way = std::abs(rapid->q1[axes.joint(axis)] - rapid->q0[axes.joint(axis)]);
    if (way > 0.0 && data.rapid > 0.0) duration = std::max(duration, way / data.rapid);
    if (way > 0.0 && data.acceleration > 0.0) square = std::max(square, way / data.acceleration);
  }
  if (!(duration > 0.0)) return;
  // With s' = 1 / duration and s'' = 1 / square, the ramp takes s' / s''.
  const double ramp = square / duration;
  for (int axis = first; axis <= last; ++axis) {
    if (!axes.has(axis)) continue;
    const int joint = axes.joint(axis);
    if (rapid->q1[joint] == rapid->q0[joint]) continue;
    rapid->duration[joint] = duration;
    rapid->ramp[joint] = ramp;
  }
}

}  // namespace

motion::DogLeg MakeRapid(const AxisMap& axes, RapidMode mode, const JointVector& q0,
                         const JointVector& q1) {
  motion::DogLeg rapid;
  rapid.q0 = q0;
  rapid.q1 = q1;
  rapid.duration = JointVector::Zero(q0.size());
  rapid.ramp = JointVector::Zero(q0.size());
  switch (mode) {
    case RapidMode::kIndependent:
      for (int axis = kX; axis < kNumAxes; ++axis) Group(axes, axis, axis, &rapid);
      break;
    case RapidMode::kLinearXyz:
      Group(axes, kX, kZ, &rapid);
      for (int axis = kA; axis < kNumAxes; ++axis) Group(axes, axis, axis, &rapid);
      break;
    case RapidMode::kLinearRotary:
      Group(axes, kX, kC, &rapid);
      break;
  }
  return rapid;
}

}  // namespace ncsim::control
