// SPDX-License-Identifier: BSD-3-Clause
// Arcs in program coordinates: from the words of a block to centre and sweep. Neutral of dialect
// but for the tolerance. mm, rad. "Counter-clockwise" is seen from the positive end of the plane's
// normal axis (ISO 841; Haas NGC Mill Operator's Manual 2017, G17/G18/G19).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "sim/control/command.h"

namespace ncsim::control {

/// First, second and normal axis of a plane, each an AxisIndex kX..kZ. G18 is ZX: Z first.
struct PlaneAxes {
  int first = kX;
  int second = kY;
  int normal = kZ;
};
constexpr PlaneAxes AxesOf(Plane plane) {
  switch (plane) {
    case Plane::kZX:
      return {kZ, kX, kY};
    case Plane::kYZ:
      return {kY, kZ, kX};
    case Plane::kXY:
      break;
  }
  return {kX, kY, kZ};
}
/// "G17", "G18", "G19".
std::string PlaneName(Plane plane);

/// Haas alarm 304: start and end radius differ by more than 0.01 mm (.001 in). From practice; the
/// manual states none.
inline constexpr double kHaasArcTolerance = 0.01;

/// The words of G02/G03, as written: mm, nothing filled in.
struct ArcWords {
  std::array<std::optional<double>, 3> ijk;  ///< Start to centre, incremental.
  std::optional<double> r;                   ///< > 0: at most 180 degrees; < 0: more.
  bool clockwise = false;                    ///< G02.
};

/// A circle or helix from `start`: the normal axis goes linearly with the angle.
struct Arc {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< Normal coordinate: that of the start.
  double start_radius = 0.0;
  double end_radius = 0.0;   ///< Differs from start_radius by at most the tolerance.
  double start_angle = 0.0;  ///< From the plane's first axis toward the second.
  double sweep = 0.0;        ///< Signed, counter-clockwise positive; |sweep| in (0, 2 pi].
  bool full_circle = false;
};

/// The arc from `start` to `end` (X, Y, Z; axes that the block does not name have the start's
/// value), or nullopt with `error` in words ("radius at the start 10 mm, at the end 10.5 mm"). An
/// end that is the start in the plane is a full circle with I, J, K, and an error with R. A letter
/// of the normal axis is an error unless its value is 0.
std::optional<Arc> ResolveArc(Plane plane, const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                              const ArcWords& words, double tolerance, std::string* error);

/// As ResolveArc; sets kind, centre, clockwise and full_circle of `command`, whose plane and end
/// are set already. False: `error` says why, and `command` is as it was.
bool MakeArc(const AxisValues& start, const ArcWords& words, double tolerance, Command* command,
             std::string* error);

/// The geometry of an arc command that starts at `start`.
Arc ArcOf(const AxisValues& start, const Command& command);

}  // namespace ncsim::control
