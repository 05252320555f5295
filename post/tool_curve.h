// SPDX-License-Identifier: BSD-3-Clause
// One motion of a cutter-location file as a curve: the tip on a line or an arc, the tool axis on a
// great circle, both in proportion to t. P, mm, rad.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "post/cl_event.h"

namespace ncsim::post {

class ToolCurve {
 public:
  ToolCurve(const ClPose& start, const ClPose& end, const std::optional<ClArc>& arc);

  /// t in [0, 1]; the ends are exact.
  Eigen::Vector3d Tip(double t) const;
  Eigen::Vector3d Axis(double t) const;  ///< Unit.
  /// The t at which the tool axis is nearest to `axis`, which is on the same side.
  double NearestTo(const Eigen::Vector3d& axis) const;
  double length() const { return length_; }
  /// rad: by how much the tool axis turns.
  double turn() const { return turn_; }

 private:
  ClPose start_, end_;
  std::optional<ClArc> arc_;
  Eigen::Vector3d e1_, e2_;   ///< Of the arc's plane; e1 to the start.
  Eigen::Vector3d miss_;      ///< What the circle ends beside the stated end.
  Eigen::Vector3d sideways_;  ///< Unit, square to the start's axis, on the great circle.
  double length_ = 0.0;
  double turn_ = 0.0;
};

/// `pose` in the coordinates of another frame: X_PM * pose.
ClPose Transformed(const Eigen::Isometry3d& X_PM, const ClPose& pose);
ClArc Transformed(const Eigen::Isometry3d& X_PM, const ClArc& arc);

}  // namespace ncsim::post
