// SPDX-License-Identifier: BSD-3-Clause
// A convex solid of revolution by its supporting planes, in the half plane (z, r): z along the axis
// from the tip toward the gauge line, r from the axis; mm.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/machine/tool.h"

namespace ncsim::collision {

/// Every supporting line of a convex profile belongs to a straight element or turns about a centre
/// (of an arc; of a corner, an arc of radius 0) through a sector. The signed distance, outside and
/// inside, is the greatest distance from any of them; and any of them bounds it from below.
class ConvexProfile {
 public:
  /// normal . p <= offset holds for all points p of the solid, with equality on the element.
  struct Line {
    Eigen::Vector2d normal;
    double offset = 0.0;
  };
  /// The lines at `radius` from `centre`, with normals between `from` and `to` (unit; turning from
  /// the tip outward).
  struct Round {
    Eigen::Vector2d centre;
    double radius = 0.0;
    Eigen::Vector2d from, to;
  };
  /// Signed distance and the supporting line that it was found with.
  struct Support {
    double distance = 0.0;
    Eigen::Vector2d normal;
    double curvature = 0.0;  ///< Of the distance's level line there, 1/mm; 0 beside a line.
  };

  ConvexProfile() = default;
  /// A convex chain from the axis to the axis; `IsConvex` says so.
  explicit ConvexProfile(const std::vector<machine::ProfileElement>& elements);

  Support At(double z, double r) const;
  const std::vector<Line>& lines() const { return lines_; }
  const std::vector<Round>& rounds() const { return rounds_; }

 private:
  std::vector<Line> lines_;
  std::vector<Round> rounds_;
};

/// Is the solid that a chain from the axis to the axis bounds convex? Tangents that turn back by up
/// to 1e-9 rad are rounding: kKernelError covers what that may come to.
bool IsConvex(const std::vector<machine::ProfileElement>& elements);

}  // namespace ncsim::collision
