// SPDX-License-Identifier: BSD-3-Clause
// Circles of the SINUMERIK: G2, G3 with I J K, CR=, AR=; CIP; CT (NC programming 12/2019,
// "Circular interpolation"). mm, rad, program coordinates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "sim/control/command.h"

namespace ncsim::control {

struct SinumerikArcWords {
  std::array<std::optional<double>, 3> centre;  ///< I, J, K: absolute.
  std::optional<double> radius;                 ///< CR: > 0 at most 180 degrees, < 0 more.
  std::optional<double> angle;                  ///< AR.
  std::optional<Eigen::Vector3d> through;       ///< CIP.
  std::optional<Eigen::Vector3d> tangent;       ///< CT: direction of the path at the start.
  bool end_named = true;                        ///< An end in the plane was programmed.
  bool clockwise = false;                       ///< G2.
};

/// MD21000, MD21010.
struct CircleTolerance {
  double constant = 0.01;  ///< mm.
  double factor = 0.001;   ///< Of the radius.
};

/// Sets kind, end, centre, arc_normal, clockwise and full_circle of `command`, whose plane and end
/// are set already (AR with a centre works the end out). An end that is off the circle by no more
/// than the tolerance moves the centre. Returns "" or why not, with the alarm. CT that goes on
/// straight makes a feed.
std::string MakeSinumerikArc(const AxisValues& start, const SinumerikArcWords& words,
                             const CircleTolerance& tolerance, Command* command);

/// The axis of an arc that MakeSinumerikArc() has made; counter-clockwise about it is G3.
Eigen::Vector3d ArcNormal(const Command& arc);
/// Its direction at its end, of any length.
Eigen::Vector3d EndTangent(const Command& arc);

}  // namespace ncsim::control
