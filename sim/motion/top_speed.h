// SPDX-License-Identifier: BSD-3-Clause
// How fast the joints of a motion get.
#pragma once

#include "sim/motion/motion.h"

namespace ncsim::motion {

/// How far each joint of a TCP curve, or of a line, would go in the motion's time if it kept its
/// highest speed (mm, rad), with the path gone through evenly. Under TCP the speed of a linear
/// joint changes: it is the mean over pieces in which nothing turns by more than 5 degrees, 16 at
/// most.
JointVector TravelAtTopSpeed(const Motion& motion);

}  // namespace ncsim::motion
