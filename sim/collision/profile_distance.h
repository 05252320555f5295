// SPDX-License-Identifier: BSD-3-Clause
// How near, or how deep, a solid of revolution is to a mesh: branch and bound with certificates.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "sim/collision/profile_shape.h"
#include "sim/collision/triangle_descent.h"
#include "sim/collision/triangle_tree.h"
#include "sim/collision/wide_shape.h"

namespace ncsim::collision {

/// A certified interval for a clearance, mm; negative where the bodies overlap.
struct Interval {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// Where the solid of revolution stands in the mesh's frame: p(z) = tip + z axis.
struct RevolvedPose {
  Eigen::Vector3d tip;
  Eigen::Vector3d axis;  ///< Unit, from the tip toward the gauge line.
};

/// The pose of a tool whose frame S (gauge line, Z toward the tool) stands at X_GS in the mesh's
/// frame G.
RevolvedPose ToolPose(const Eigen::Isometry3d& X_GS, double length);

/// When to stop: as soon as one of these holds.
struct DistanceGoal {
  /// upper - lower <= max(gap, relative_gap * (lower - floor)): tight near `floor`, loose far above
  /// it.
  double gap = 2e-3;
  double relative_gap = 0.0;
  double floor = 0.0;
  double stop_above = std::numeric_limits<double>::infinity();   ///< lower is at least this.
  double stop_below = -std::numeric_limits<double>::infinity();  ///< upper is less than this.
  int max_evaluations = 200000;  ///< The interval is then wide, but still right.
};

/// Bounds on the least signed distance, over all points of the mesh's SURFACE, to the solid. What
/// bounds a box, a triangle or a piece of one from below is a supporting plane of the solid (or of
/// each convex part of it, where it lies outside of them all), least over the corners; and for a
/// piece that may be inside a solid that is not convex, the distance at its middle less its radius.
/// What bounds the result from above is a point of the mesh; each search starts from that of the
/// last one, so a result may depend on earlier ones within its goal.
class ProfileDistance {
 public:
  /// Both outlive this.
  ProfileDistance(const ProfileShape& shape, const TriangleTree& tree);

  Interval Surface(const RevolvedPose& pose, const DistanceGoal& goal);

  /// The same over all of a way of the solid, which goes from `pose` straight on by `way` (mm, in
  /// the mesh's frame) and does not turn: the distance to a convex part is a convex function of the
  /// point and the place on the way, so there is nothing between poses that is not looked at. Where
  /// the mesh gets into a solid that is not convex, `lower` is below 0, and how far is not worked
  /// out.
  Interval AllTheWay(const RevolvedPose& pose, const Eigen::Vector3d& way,
                     const DistanceGoal& goal);

  /// The same over all points of the mesh's SOLID: minus the least amount by which the profile must
  /// shrink to clear it. From any common inner point the way toward the axis never leads to a
  /// greater distance and ends on the mesh's surface or on the axis, so beside the surface only the
  /// axis inside the solid needs a look. The axis part of `upper` is within 0.003.
  Interval Solid(const RevolvedPose& pose, const DistanceGoal& goal);

  /// Is the middle of the solid's greatest ball inside the mesh? With no surface contact: is the
  /// tool inside it?
  bool Contained(const RevolvedPose& pose) const;

  /// The point of the mesh that the last search's `upper` was seen at; none before the first.
  const std::optional<Eigen::Vector3d>& witness() const { return witness_; }
  /// Of the solid, to a point, at the pose of the last search.
  Eigen::Vector3d NearestOnSurface(const Eigen::Vector3d& p) const;

 private:
  enum class Kind { kNode, kTriangle, kPiece, kConvexPiece };
  struct Cell {
    double lower = 0.0;
    Kind kind = Kind::kNode;
    int index = 0;  ///< Of a node (or ~ of a leaf) or a triangle of the tree, or into pieces_.
  };
  struct Later {
    bool operator()(const Cell& a, const Cell& b) const { return a.lower > b.lower; }
  };
  struct Local {
    double z = 0.0, r = 0.0;
    Eigen::Vector3d radial;
  };
  struct Tangent {
    double distance = 0.0;
    QuadraticModel model;  ///< Its slope bounds the distance from below.
  };
  /// Of a triangle, while the solid is on this part of its way: -1 to 1, from the middle.
  struct Piece {
    TriangleTree::Triangle triangle;
    double begin = 0.0, end = 0.0;

    double middle() const { return 0.5 * (begin + end); }
  };
  Local ToLocal(const Eigen::Vector3d& p) const;
  double Distance(const Eigen::Vector3d& p) const;
  void See(const Eigen::Vector3d& p, double distance);
  void SetUpper(double upper);
  void Push(double lower, Kind kind, int index);
  using Bounds = std::array<float, kWide>;
  template <class Index>
  void PushAll(const Bounds& lower, const WideNear& near, double at_least, Kind kind, int count,
               const Index& index);
  void Expand(const Cell& cell);
  void ExpandNode(const TriangleTree::Node& node, double at_least);
  void ExpandLeaf(int leaf, double at_least);
  Interval Search(const RevolvedPose& pose, const Eigen::Vector3d& half_way,
                  const DistanceGoal& goal);
  bool moves() const { return !half_way_.isZero(0.0); }
  void ExpandPiece(const Piece& piece, double lower, bool solve);
  void PushPiece(const Piece& piece, double at_least);
  Tangent TangentAt(const ConvexProfile& convex, const Eigen::Vector3d& p);
  double LeastOver(const ConvexProfile& convex, bool is_part, const TriangleTree::Triangle& piece);
  double LeastOnWay(const ConvexProfile& convex, bool is_part, const Piece& piece);
  double LeastOver(const Piece& piece);

  const ProfileShape* shape_;
  const TriangleTree* tree_;
  WideShape wide_;

  const WideSolid* solid_ = nullptr;
  RevolvedPose pose_;  // in the middle of its way
  Eigen::Vector3d half_way_ = Eigen::Vector3d::Zero();
  DistanceGoal goal_;
  double upper_ = 0.0;
  double enough_ = 0.0;       // a bound that is no lower needs no improving
  float wide_enough_ = 0.0F;  // no less than that
  double passed_ = 0.0;       // least bound of what was not looked into
  int evaluations_ = 0;
  std::vector<Cell> heap_;
  std::vector<Piece> pieces_;
  std::vector<int> free_pieces_;
  std::optional<Eigen::Vector3d> witness_;  // a point of the mesh at upper_, or of the last search
};

/// Covers rounding for coordinates up to some metres, and profiles that count as convex with
/// tangents that turn back by 1e-9 rad, mm.
inline constexpr double kKernelError = 1e-6;

}  // namespace ncsim::collision
