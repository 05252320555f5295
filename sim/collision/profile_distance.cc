// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/profile_distance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "sim/base/units.h"
#include "sim/collision/convex_minimum.h"

namespace ncsim::collision {

namespace {

using Eigen::Vector3d;

// Parts of a solid that is not convex meet in flat faces inside it: a point that is no further than
// this from a part, mm, may lie deep in their union.
constexpr double kInterface = 1e-9;

}  // namespace

RevolvedPose ToolPose(const Eigen::Isometry3d& X_GS, double length) {
  const Vector3d z_S = X_GS.linear().col(2);
  return {X_GS.translation() + length * z_S, -z_S};
}

ProfileDistance::ProfileDistance(const ProfileShape& shape, const TriangleTree& tree)
    : shape_(&shape), tree_(&tree), wide_(shape) {}

ProfileDistance::Local ProfileDistance::ToLocal(const Vector3d& p) const {
  const Vector3d v = p - pose_.tip;
  Local local;
  local.z = v.dot(pose_.axis);
  Vector3d across = v - local.z * pose_.axis;
  // Again: what rounding left along the axis may be much of a short vector, and would tilt a plane.
  across -= across.dot(pose_.axis) * pose_.axis;
  local.r = across.norm();
  // On the axis zero is a subgradient across it: the distance is even there.
  local.radial = local.r > 1e-9 ? Vector3d(across / local.r) : Vector3d(Vector3d::Zero());
  return local;
}

double ProfileDistance::Distance(const Vector3d& p) const {
  const Local local = ToLocal(p);
  double least = kInfinity;
  for (const ConvexProfile& part : shape_->parts()) {
    least = std::min(least, part.At(local.z, local.r).distance);
  }
  if (least > kInterface || shape_->convex()) return least;
  return shape_->exact().Distance(local.z, local.r);
}

Vector3d ProfileDistance::NearestOnSurface(const Vector3d& p) const {
  const Local local = ToLocal(p);
  const Eigen::Vector2d nearest = shape_->exact().Nearest(local.z, local.r);
  // From the axis, any direction.
  const Vector3d radial = local.radial.isZero() ? pose_.axis.unitOrthogonal() : local.radial;
  return pose_.tip + nearest.x() * pose_.axis + nearest.y() * radial;
}

void ProfileDistance::See(const Vector3d& p, double distance) {
  if (distance >= upper_) return;
  witness_ = p;
  SetUpper(distance);
}

void ProfileDistance::SetUpper(double upper) {
  upper_ = upper;
  const double relative = (upper + goal_.relative_gap * goal_.floor) / (1.0 + goal_.relative_gap);
  enough_ = std::min({upper - goal_.gap, relative, goal_.stop_above});
  wide_enough_ =
      std::nextafter(static_cast<float>(enough_), std::numeric_limits<float>::infinity());
}

void ProfileDistance::Push(double lower, Kind kind, int index) {
  if (lower >= enough_) {
    passed_ = std::min(passed_, lower);
    return;
  }
  heap_.push_back({lower, kind, index});
  std::push_heap(heap_.begin(), heap_.end(), Later());
}

// Lanes to spare repeat others.
template <class Index>
void ProfileDistance::PushAll(const Bounds& lower, const WideNear& near, double at_least, Kind kind,
                              int count, const Index& index) {
  passed_ = std::min(passed_, static_cast<double>(near.passed));
  for (unsigned lanes = static_cast<unsigned>(near.lanes); lanes != 0; lanes &= lanes - 1) {
    const int i = std::countr_zero(lanes);
    if (i >= count) return;
    Push(std::max(at_least, static_cast<double>(lower[static_cast<std::size_t>(i)])), kind,
         index(i));
  }
}

void ProfileDistance::Expand(const Cell& cell) {
  switch (cell.kind) {
    case Kind::kNode:
      return cell.index < 0 ? ExpandLeaf(~cell.index, cell.lower)
                            : ExpandNode(tree_->node(cell.index), cell.lower);
    case Kind::kTriangle: {
      const double half = moves() ? 1.0 : 0.0;
      return ExpandPiece({tree_->triangle(cell.index), -half, half}, cell.lower, true);
    }
    default:
      free_pieces_.push_back(cell.index);
      const Piece piece = pieces_[static_cast<std::size_t>(cell.index)];
      return ExpandPiece(piece, cell.lower, cell.kind == Kind::kConvexPiece);
  }
}

void ProfileDistance::ExpandNode(const TriangleTree::Node& node, double at_least) {
  ++evaluations_;
  Bounds lower;
  const WideNear near = BoundBoxes(node.boxes, *solid_, wide_enough_, lower.data());
  PushAll(lower, near, at_least, Kind::kNode, node.count, [&node](int i) { return node.child[i]; });
}

void ProfileDistance::ExpandLeaf(int leaf, double at_least) {
  ++evaluations_;
  Bounds lower;
  const WideNear near = BoundTriangles(tree_->leaf(leaf), *solid_, wide_enough_, lower.data());
  PushAll(lower, near, at_least, Kind::kTriangle, tree_->leaf_size(leaf),
          [leaf](int i) { return kWide * leaf + i; });
}

// The distance to a convex solid is a convex function, so a plane that supports the solid bounds it
// over all of the triangle by its least value at a corner. Newton's method brings that to the truth
// in a few steps where the distance is smooth; where it is not, cutting planes do.
double ProfileDistance::LeastOver(const ConvexProfile& convex, bool is_part,
                                  const TriangleTree::Triangle& piece) {
  constexpr int kSteps = 8;
  const bool is_whole = is_part && shape_->convex();
  TriangleDescent descent(piece);
  TriangleDescent best = descent;
  double lower = -kInfinity;
  double upper = kInfinity;
  for (int i = 0; i < kSteps; ++i) {
    const Vector3d p = descent.at();
    const Tangent tangent = TangentAt(convex, p);
    See(p, is_part ? tangent.distance : Distance(p));
    if (is_part && !is_whole && tangent.distance <= kInterface) return -kInfinity;
    const Vector3d& slope = tangent.model.slope;
    lower = std::max(lower,
                     tangent.distance + std::min({slope.dot(piece[0] - p), slope.dot(piece[1] - p),
                                                  slope.dot(piece[2] - p)}));
    if (lower >= enough_ || upper_ < goal_.stop_below) return lower;
    if (tangent.distance > upper) {
      descent.Retreat(best);
      continue;
    }
    upper = tangent.distance;
    best = descent;
    descent.Step(tangent.model);
  }
  const ConvexMinimum minimum = MinimiseOverTriangle(
      piece,
      [&](const Vector3d& p) {
        const Tangent tangent = TangentAt(convex, p);
        return ConvexSample{tangent.distance, tangent.model.slope};
      },
      enough_, 0.5 * goal_.gap);
  See(minimum.at, is_part ? minimum.upper : Distance(minimum.at));
  return std::max(lower, minimum.lower);
}

ProfileDistance::Tangent ProfileDistance::TangentAt(const ConvexProfile& convex,
                                                    const Vector3d& p) {
  ++evaluations_;
  const Local local = ToLocal(p);
  const ConvexProfile::Support support = convex.At(local.z, local.r);
  const double z = support.normal.x();
  const double r = support.normal.y();
  // How the distance bends along the profile and around the axis. Its sum with the larger radius of
  // the two has a square that bends as much along the slope: about a corner or the axis that is
  // exact, however far the point.
  const double around = r / std::max(local.r, 1e-9);
  const double most = support.curvature > 0.0 ? support.curvature : around;
  return {support.distance,
          {z * pose_.axis + r * local.radial,
           {z * pose_.axis + r * local.radial, z * local.radial - r * pose_.axis,
            pose_.axis.cross(local.radial)},
           {most, support.curvature, around}}};
}

// A point p is to the solid, t half ways on, as p - t half_way_ is to where it stands: a function
// of p and t that is convex too, and as its planes bound it over the triangle, so over the way. By
// turns to the least over the one and the other.
double ProfileDistance::LeastOnWay(const ConvexProfile& convex, bool is_part, const Piece& piece) {
  constexpr int kSteps = 24;
  const TriangleTree::Triangle& triangle = piece.triangle;
  const bool is_whole = is_part && shape_->convex();
  TriangleDescent descent(triangle);
  double t = piece.middle();
  double lower = -kInfinity;
  for (int i = 0; i < kSteps; ++i) {
    const Vector3d p = descent.at();
    const Vector3d seen = p - t * half_way_;
    const Tangent tangent = TangentAt(convex, seen);
    See(p, is_part ? tangent.distance : Distance(seen));
    if (is_part && !is_whole && tangent.distance <= kInterface) return -kInfinity;
    const Vector3d& slope = tangent.model.slope;
    const double along = -slope.dot(half_way_);
    lower = std::max(lower, tangent.distance +
                                std::min({slope.dot(triangle[0] - p), slope.dot(triangle[1] - p),
                                          slope.dot(triangle[2] - p)}) +
                                std::min(along * (piece.begin - t), along * (piece.end - t)));
    if (lower >= enough_ || upper_ < goal_.stop_below) return lower;
    if (i % 2 == 1) {
      descent.Step(tangent.model);
      continue;
    }
    double bend = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double part = tangent.model.direction[k].dot(half_way_);
      bend += tangent.model.bend[k] * part * part;
    }
    t = std::clamp(t - along / std::max(bend, 1e-300), piece.begin, piece.end);
  }
  return lower;
}

// Where the triangle may be inside a solid that is not convex, its parts bound nothing.
double ProfileDistance::LeastOver(const Piece& piece) {
  const auto least_over = [&](const ConvexProfile& convex, bool is_part) {
    return moves() ? LeastOnWay(convex, is_part, piece)
                   : LeastOver(convex, is_part, piece.triangle);
  };
  double least = kInfinity;
  for (const ConvexProfile& part : shape_->parts()) {
    least = std::min(least, least_over(part, true));
    if (least <= kInterface && !shape_->convex()) return least_over(shape_->hull(), false);
  }
  return least;
}

// What bounds it too weakly is halved: the way, or the longest side.
void ProfileDistance::ExpandPiece(const Piece& piece, double lower, bool solve) {
  if (solve) lower = std::max(lower, LeastOver(piece));
  if (lower >= enough_ || upper_ < goal_.stop_below) {
    passed_ = std::min(passed_, lower);
    return;
  }
  const TriangleTree::Triangle& triangle = piece.triangle;
  std::size_t longest = 0;
  double length = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge = (triangle[(k + 1) % 3] - triangle[k]).squaredNorm();
    if (edge > length) {
      length = edge;
      longest = k;
    }
  }
  const double way = piece.end - piece.begin;
  if (way * way * half_way_.squaredNorm() > length) {
    PushPiece({triangle, piece.begin, piece.middle()}, lower);
    PushPiece({triangle, piece.middle(), piece.end}, lower);
    return;
  }
  const Vector3d& a = triangle[longest];
  const Vector3d& b = triangle[(longest + 1) % 3];
  const Vector3d& c = triangle[(longest + 2) % 3];
  const Vector3d middle = 0.5 * (a + b);
  PushPiece({{a, middle, c}, piece.begin, piece.end}, lower);
  PushPiece({{middle, b, c}, piece.begin, piece.end}, lower);
}

// The distance changes by no more than the way. And no point is deeper than it is far from any one
// point of the surface; that way is longest to a corner.
void ProfileDistance::PushPiece(const Piece& piece, double at_least) {
  ++evaluations_;
  const Vector3d centre = (piece.triangle[0] + piece.triangle[1] + piece.triangle[2]) / 3.0;
  const Vector3d seen = centre - piece.middle() * half_way_;
  double squared = 0.0;
  for (const Vector3d& v : piece.triangle) squared = std::max(squared, (v - centre).squaredNorm());
  const double radius = std::sqrt(squared) + 0.5 * (piece.end - piece.begin) * half_way_.norm();
  const double distance = Distance(seen);
  See(centre, distance);
  double lower = std::max(at_least, distance - radius);
  if (distance < 0.0 && !moves()) {
    const Vector3d nearest = NearestOnSurface(centre);
    double deepest = 0.0;
    for (const Vector3d& v : piece.triangle) deepest = std::max(deepest, (v - nearest).norm());
    lower = std::max(lower, -deepest);
  }
  if (lower >= enough_) {
    passed_ = std::min(passed_, lower);
    return;
  }
  int slot = static_cast<int>(pieces_.size());
  if (free_pieces_.empty()) {
    pieces_.push_back(piece);
  } else {
    slot = free_pieces_.back();
    free_pieces_.pop_back();
    pieces_[static_cast<std::size_t>(slot)] = piece;
  }
  // Pieces of a triangle that is no convex problem become one when they lie outside.
  Push(lower, distance > 0.5 * radius ? Kind::kConvexPiece : Kind::kPiece, slot);
}

Interval ProfileDistance::Surface(const RevolvedPose& pose, const DistanceGoal& goal) {
  return Search(pose, Vector3d::Zero(), goal);
}

Interval ProfileDistance::AllTheWay(const RevolvedPose& pose, const Vector3d& way,
                                    const DistanceGoal& goal) {
  const Vector3d half_way = 0.5 * way;
  return Search({pose.tip + half_way, pose.axis}, half_way, goal);
}

Interval ProfileDistance::Search(const RevolvedPose& pose, const Vector3d& half_way,
                                 const DistanceGoal& goal) {
  if (tree_->empty()) return {kInfinity, kInfinity};
  if (!pose.tip.allFinite() || !pose.axis.allFinite() || !half_way.allFinite()) return {};
  pose_ = pose;
  half_way_ = half_way;
  solid_ = &wide_.Place(pose.tip, pose.axis, *tree_, half_way);
  goal_ = goal;
  passed_ = kInfinity;
  SetUpper(kInfinity);
  evaluations_ = 0;
  heap_.clear();
  pieces_.clear();
  free_pieces_.clear();
  if (witness_.has_value()) See(*witness_, Distance(*witness_));
  ExpandNode(tree_->node(0), -kInfinity);
  while (!heap_.empty() && heap_.front().lower < enough_ && upper_ >= goal.stop_below &&
         evaluations_ <= goal.max_evaluations) {
    const Cell cell = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    heap_.pop_back();
    Expand(cell);
  }
  double lower = std::min(upper_, passed_);
  if (!heap_.empty()) lower = std::min(lower, heap_.front().lower);
  return {lower - kKernelError, upper_ + kKernelError};
}

Interval ProfileDistance::Solid(const RevolvedPose& pose, const DistanceGoal& goal) {
  Interval result = Surface(pose, goal);
  if (result.upper < goal.stop_below) {
    result.lower = std::min(result.lower, -shape_->inradius());
    return result;
  }
  std::vector<double> cuts{shape_->z_min()};
  for (double z : tree_->Crossings(pose.tip, pose.axis)) {
    if (z > shape_->z_min() && z < shape_->z_max()) cuts.push_back(z);
  }
  cuts.push_back(shape_->z_max());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] < 1e-6) continue;
    if (!tree_->Contains(pose.tip + 0.5 * (cuts[i] + cuts[i + 1]) * pose.axis)) continue;
    const double least = shape_->LeastOnAxis(cuts[i], cuts[i + 1]);
    result.upper = std::min(result.upper, least + kKernelError);
    result.lower = std::min(result.lower, least - 4e-3);
  }
  return result;
}

bool ProfileDistance::Contained(const RevolvedPose& pose) const {
  return tree_->Contains(pose.tip + shape_->inradius_z() * pose.axis);
}

}  // namespace ncsim::collision
