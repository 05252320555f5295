// SPDX-License-Identifier: BSD-3-Clause
// Which of its solutions a machine follows along a row of tool axes.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "post/part_geometry.h"

namespace ncsim::post {

/// Rotary positions along a row of tool axes.
struct RotaryPath {
  std::vector<Rotary> rotary;  ///< Of each tool axis.
  /// At these the positions before the turn, ascending: the tool comes to axis i at `before` and
  /// goes on from rotary[i], another position for the same axis.
  struct Rewind {
    std::size_t at = 0;
    Rotary before{};
  };
  std::vector<Rewind> rewinds;
  double earlier = 0.0;  ///< Rewinds are made this share of their stretch before they must.
  /// How often the second axis turns at the pole, the tool standing still.
  int pole_turns = 0;
  double travel = 0.0;  ///< rad, of both axes, rewinds included, from where they stood.
};

/// The ways to follow `axes_P` from where the rotary axes stand, the best first: the one with the
/// fewest rewinds, of these with the fewest turns at the pole, of these with the latest rewinds, of
/// these with the least travel. They begin with another solution for the first axis (the branches;
/// turns of an axis with limits; at the pole where the second axis will be needed), or rewind
/// elsewhere: where the continuous way would leave the limits, or before that. Empty where one of
/// the axes cannot be reached: `unreachable` is its index. `pole_tolerance`: as
/// PartGeometry::Follow.
std::vector<RotaryPath> RankRotary(const PartGeometry& geometry,
                                   const std::vector<Eigen::Vector3d>& axes_P, const Rotary& from,
                                   double pole_tolerance, std::size_t* unreachable);

}  // namespace ncsim::post
