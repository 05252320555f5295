// SPDX-License-Identifier: BSD-3-Clause
// Exact distances to a solid of revolution, worked out in its half plane (z, r): z along the axis
// from the tip toward the gauge line, r from the axis; mm.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/collision/convex_profile.h"
#include "sim/machine/tool.h"

namespace ncsim::collision {

/// A chain of straight elements and of arcs that are convex outward, from the axis to the axis, z
/// never decreasing. The nearest surface point of any point lies in its own meridian half plane, so
/// everything happens in two dimensions.
class ProfileChain {
 public:
  ProfileChain() = default;
  explicit ProfileChain(const std::vector<machine::ProfileElement>& elements);

  /// Signed distance to the solid's surface; negative inside.
  double Distance(double z, double r) const;
  /// The point (z, r) of the surface that is nearest.
  Eigen::Vector2d Nearest(double z, double r) const;

 private:
  struct Element {
    bool arc = false;
    Eigen::Vector2d start, end;
    Eigen::Vector2d direction;  // line: unit
    double length = 0.0;        // line
    Eigen::Vector2d centre;     // arc
    double radius = 0.0;        // arc
    Eigen::Vector2d from, to;   // arc: unit, centre to start and to end
  };
  bool Inside(double z, double r) const;

  std::vector<Element> elements_;
};

/// A profile with what branch and bound needs: itself, its convex hull, and the convex parts, as
/// long as may be, whose union it is. Outside the solid the distance is the least of the parts'
/// distances; inside it is no more than that.
class ProfileShape {
 public:
  /// `profile` is not empty. A profile that does not reach the axis at its ends is closed by flat
  /// faces.
  explicit ProfileShape(const machine::Profile& profile);

  const ProfileChain& exact() const { return exact_; }
  /// One part, which is the hull: then its distance is exact inside, too.
  bool convex() const { return parts_.size() == 1; }
  const ConvexProfile& hull() const { return hull_; }
  const std::vector<ConvexProfile>& parts() const { return parts_; }
  double z_min() const { return z_min_; }
  double z_max() const { return z_max_; }
  double r_max() const { return r_max_; }
  /// Radius of the greatest ball inside, to 0.001 mm and never more than it is, and the place of
  /// its centre on the axis. (The distance to the surface never falls toward the axis, so some
  /// greatest ball is centred on it.)
  double inradius() const { return inradius_; }
  double inradius_z() const { return inradius_z_; }

  /// Least signed distance on the piece [z0, z1] of the axis, to 0.003 mm, never below the truth.
  double LeastOnAxis(double z0, double z1) const;

 private:
  double MinimiseOnAxis(double z0, double z1, double gap, double stop, double* at) const;

  ProfileChain exact_;
  ConvexProfile hull_;
  std::vector<ConvexProfile> parts_;
  double z_min_ = 0.0, z_max_ = 0.0, r_max_ = 0.0;
  double inradius_ = 0.0, inradius_z_ = 0.0;
};

/// The profile's elements with flat faces added where it does not start or end on the axis, and
/// with arcs that are not convex outward replaced by their chord (which encloses them).
std::vector<machine::ProfileElement> ClosedElements(const machine::Profile& profile);

/// The least convex solid of revolution around points (z, r), of which there is at least one;
/// without arcs.
machine::Profile ConvexHull(std::vector<Eigen::Vector2d> points);

/// Points of a polyline around `element` (an arc convex outward): tangents, so that it encloses the
/// arc, and no point is further than `sagitta` from it. Start and end are included.
std::vector<Eigen::Vector2d> CircumscribeArc(const machine::ProfileElement& element,
                                             double sagitta);

}  // namespace ncsim::collision
