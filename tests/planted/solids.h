// SPDX-License-Identifier: BSD-3-Clause
// Tools and bodies whose distance from each other has a closed form. Nothing here uses the
// collision engine or FCL.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <variant>
#include <vector>

#include "sim/machine/mesh.h"
#include "sim/machine/tool.h"

namespace ncsim::planted {

/// A cylinder about the tool axis from `z0` to `z1` above the tip whose lower rim, and with
/// `round_top` the upper one too, is rounded by `corner`: end mill, bull nose, ball nose (corner =
/// radius), capsule, sphere. z1 - z0 >= 2 corner. mm.
struct Cutter {
  double z0 = 0.0, z1 = 0.0, radius = 0.0, corner = 0.0;
  bool round_top = false;

  /// Signed distance of a point at `rho` from the axis and `z` above the tip: exact on both sides.
  double Signed(double rho, double z) const;
  /// The least that it can be.
  double Floor() const { return -std::min(radius, 0.5 * (z1 - z0)); }
  /// At this height Signed is least, whatever rho.
  double Middle() const { return 0.5 * (z0 + z1); }
  /// The points within `radius` of a piece of the axis.
  bool IsCapsule() const { return round_top && corner == radius; }
  machine::Profile Profile() const;
};

/// Where the tool is: its tip, and its axis (unit, tip -> holder).
struct ToolPose {
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
};

/// `base` is convex and counter-clockwise.
struct Prism {
  std::vector<Eigen::Vector2d> base;
  double z0 = 0.0, z1 = 0.0;
};
/// All points with z <= 0: the top of a plate so large that its sides do not matter.
struct HalfSpace {};
/// A convex polyhedron.
struct Facets {
  machine::TriangleMesh mesh;
};
using Part = std::variant<Prism, HalfSpace, Facets>;

/// The least of Cutter::Signed over a part: the distance when they are apart; else minus the least
/// amount by which the tool must shrink to come free. Forms for: a prism and a tool along its
/// axis; a prism and a capsule; a half space and a sharp cylinder (z1 - z0 > 0, corner = 0); facets
/// and a sphere.
double Clearance(const Cutter& cutter, const ToolPose& tool, const Part& part);

/// A body in a frame G of its own: `mesh` is the surface of the union of `parts`.
struct Solid {
  std::vector<Part> parts;
  machine::TriangleMesh mesh;
};

Solid Block(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper);
/// Any convex counter-clockwise base.
Solid PrismSolid(const std::vector<Eigen::Vector2d>& base, double z0, double z1);
/// A regular prism with `sides` corners on a circle of `radius`, the first at `turn`.
std::vector<Eigen::Vector2d> RegularBase(int sides, double radius, double turn);
/// A block with a pocket that is open at the top; or, with `inner_upper` below the block's top,
/// with a cavity inside.
Solid PocketBlock(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper,
                  const Eigen::Vector3d& inner_lower, const Eigen::Vector3d& inner_upper);
Solid Plate(double half, double thickness);
Solid FacetedSphere(double radius, int rings);

}  // namespace ncsim::planted
