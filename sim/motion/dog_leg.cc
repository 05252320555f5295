// SPDX-License-Identifier: BSD-3-Clause
// The timing of dog-leg rapids: trapezoid and triangle, for every acceleration from the stated one
// up.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "sim/motion/path.h"

namespace ncsim::motion {
namespace {

/// s from rest to rest, for a way that takes `duration` at full rate and a ramp of `ramp`.
double AxisTime(double duration, double ramp) {
  return duration >= ramp ? duration + ramp : 2.0 * std::sqrt(duration * ramp);
}

/// How much of the way is done `t` after the start, t in the first half of the motion.
double Rise(double duration, double ramp, double t) {
  return t < ramp ? t * t / (2.0 * ramp * duration) : (t - 0.5 * ramp) / duration;
}

double AxisProgress(double duration, double ramp, double t) {
  const double total = AxisTime(duration, ramp);
  if (t <= 0.0) return 0.0;
  if (t >= total) return 1.0;
  return t <= 0.5 * total ? Rise(duration, ramp, t) : 1.0 - Rise(duration, ramp, total - t);
}

}  // namespace

double Duration(const DogLeg& path, double lag) {
  double longest = 0.0;
  for (Eigen::Index i = 0; i < path.duration.size(); ++i) {
    longest = std::max(longest, AxisTime(path.duration[i], lag * path.ramp[i]));
  }
  return longest;
}

/// An axis arrives at AxisTime(duration, lag * ramp) - lag * shift on this clock. That is linear in
/// lag for a trapezoid, and so greatest at lag 0 or 1; for a triangle it is concave and may be
/// greatest between, but is then less than the shift, and so less than the longest duration.
DogLegClock::DogLegClock(const DogLeg& path) : path_(path) {
  for (Eigen::Index i = 0; i < path.duration.size(); ++i) {
    if (path.duration[i] <= end_) continue;
    end_ = path.duration[i];
    shift_ = 0.5 * std::min(path.ramp[i], path.duration[i]);
  }
  for (Eigen::Index i = 0; i < path.duration.size(); ++i) {
    end_ = std::max(end_, AxisTime(path.duration[i], path.ramp[i]) - shift_);
  }
}

double DogLegClock::Time(double s, double lag) const {
  return std::max(0.0, std::lerp(-shift_, end_, s) + lag * shift_);
}

double DogLegClock::Progress(int axis, double s, double lag) const {
  if (path_.duration[axis] <= 0.0) return s;  // rests
  return AxisProgress(path_.duration[axis], lag * path_.ramp[axis], Time(s, lag));
}

/// At a given s, progress is once continuously differentiable in lag; its derivative is 0 only
/// where the axis rests or passes at its rate in step with the clock, and at two lags: from the
/// ramp up, (s + lag shift)^2 / lag, and from the ramp down, (duration + lag ramp - s - lag
/// shift)^2 / lag, with s short for the clock without lag. (The triangle's ramp down has its own at
/// the first of the two.) So the extremes lie at these or at the ends.
Interval DogLegClock::ProgressAt(int axis, double s, const Span& span) const {
  const double duration = path_.duration[axis];
  const double clock = std::lerp(-shift_, end_, s);
  const double up = shift_ > 0.0 ? clock / shift_ : span.lag0;
  const double behind = path_.ramp[axis] - shift_;
  const double down = behind != 0.0 ? (duration - clock) / behind : span.lag0;
  const double first = Progress(axis, s, span.lag0);
  const double last = Progress(axis, s, span.lag1);
  Interval progress{std::min(first, last), std::max(first, last)};
  for (const double lag : {up, down}) {
    if (!(lag > span.lag0 && lag < span.lag1)) continue;
    const double p = Progress(axis, s, lag);
    progress.lower = std::min(progress.lower, p);
    progress.upper = std::max(progress.upper, p);
  }
  return progress;
}

Interval DogLegClock::ProgressOver(int axis, const Span& span) const {
  if (span.lag0 == span.lag1) {
    return {Progress(axis, span.s0, span.lag0), Progress(axis, span.s1, span.lag0)};
  }
  return {ProgressAt(axis, span.s0, span).lower, ProgressAt(axis, span.s1, span).upper};
}

}  // namespace ncsim::motion
