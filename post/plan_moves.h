// SPDX-License-Identifier: BSD-3-Clause
// One motion between two rotary positions as moves that the control makes: a line, an arc where the
// mode can carry it, else pieces that keep to the tolerances. Knows no file and no operation.
#pragma once

#include <vector>

#include "post/part_geometry.h"
#include "post/planner.h"
#include "post/tool_curve.h"

namespace ncsim::post {

/// The coordinates that a stretch of moves is written in.
struct MoveFrame {
  PlanMode mode = PlanMode::kIndexed;
  const Eigen::Matrix3d* plane_P = nullptr;  ///< As PartGeometry::Xyz.
};

/// So near to the pole (rad) the tool axis is at it.
inline double PoleTolerance(const PlanOptions& options) { return 0.5 * options.angle_tolerance; }

PlanPose PoseAt(const PartGeometry& geometry, const MoveFrame& frame, const ClPose& pose,
                const Rotary& rotary);

/// The moves from `start` to `end` (P), with `feed`; the last ends at `end`. What cannot be done
/// (no subdivision keeps to the tolerances), else ""; `moves` is then not complete.
std::string FeedMoves(const PartGeometry& geometry, const PlanOptions& options,
                      const MoveFrame& frame, const ClPose& start, const Rotary& from,
                      const ClPose& end, const Rotary& to, const std::optional<ClArc>& arc,
                      const ClFeed& feed, std::vector<PlanMove>* moves);

}  // namespace ncsim::post
