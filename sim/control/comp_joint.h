// SPDX-License-Identifier: BSD-3-Clause
// The corner between two compensated moves: pure geometry of the plane, see cutter_comp.h for the
// rules.
#pragma once

#include <vector>

#include "sim/control/contour.h"
#include "sim/control/plane_curve.h"

namespace ncsim::control {

/// One programmed move beside which the tool runs.
struct CompEdge {
  Curve programmed;
  Curve ideal;               ///< `programmed` offset over its whole length.
  double offset = 0.0;       ///< mm, left of the path positive.
  double start_along = 0.0;  ///< Where on `ideal` the tool starts: > 0 trimmed, < 0 extended.
};
/// Needs CanOffset().
CompEdge MakeEdge(const Curve& programmed, double offset);

/// A piece put in at an outside corner: a line, or an arc about the corner.
struct CompLink {
  Point to = Point::Zero();
  bool arc = false;
};

struct CompJoint {
  Point first_end = Point::Zero();  ///< Where the tool ends the first move.
  std::vector<CompLink> links;      ///< From there to second_start, in order.
  Point second_start = Point::Zero();
  double first_along = 0.0;   ///< Where on the first move's ideal offset its end lies,
  double second_along = 0.0;  ///< and on the second's its start.
  bool fits = true;  ///< False: the moves are too short, or have no corner that the tool can reach.
};

/// Both moves are edges with the same offset.
CompJoint JoinEdges(const CompEdge& first, const CompEdge& second, const ContourOptions& options);
/// `entry` (a line, uncompensated) turns compensation on for `second`.
CompJoint JoinEntry(const Curve& entry, const CompEdge& second, const ContourOptions& options);
/// `exit` (a line, uncompensated) turns compensation off after `first`.
CompJoint JoinExit(const CompEdge& first, const Curve& exit, const ContourOptions& options);
}  // namespace ncsim::control
