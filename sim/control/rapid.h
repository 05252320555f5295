// SPDX-License-Identifier: BSD-3-Clause
// Rapids: how the axes share the time (Haas NGC Mill Operator's Manual 2017, G00 and setting 335).
// Neutral of dialect.
#pragma once

#include "sim/control/frames.h"
#include "sim/motion/motion.h"

namespace ncsim::control {

/// The dog-leg from `q0` to `q1`. Axes of a group get the same duration and ramp: rate and
/// acceleration of the group are the greatest that no axis of it exceeds.
motion::DogLeg MakeRapid(const AxisMap& axes, RapidMode mode, const JointVector& q0,
                         const JointVector& q1);

}  // namespace ncsim::control
