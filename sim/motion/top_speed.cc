// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/top_speed.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "sim/base/units.h"

namespace ncsim::motion {

JointVector TravelAtTopSpeed(const Motion& motion) {
  constexpr double kPiece = Radians(5.0);
  double turn = 0.0;
  if (const auto* curve = std::get_if<TcpCurve>(&motion.path)) {
    for (const int joint : curve->frame->control.rotary()) {
      turn = std::max(turn, std::abs(curve->q1[joint] - curve->q0[joint]));
    }
    if (curve->great_circle != nullptr) turn = std::max(turn, curve->great_circle->angle());
    if (curve->arc) turn = std::max(turn, std::abs(curve->sweep));
  }
  const int pieces = std::clamp(static_cast<int>(std::ceil(turn / kPiece)), 1, 16);
  JointVector most = JointVector::Zero(motion.q0().size());
  JointVector before = motion.q0();
  for (int piece = 1; piece <= pieces; ++piece) {
    const JointVector here =
        piece == pieces ? motion.q1() : motion.At(static_cast<double>(piece) / pieces);
    most = most.cwiseMax((here - before).cwiseAbs());
    before = here;
  }
  return most * pieces;
}

}  // namespace ncsim::motion
