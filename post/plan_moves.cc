// SPDX-License-Identifier: BSD-3-Clause
#include "post/plan_moves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ncsim::post {
namespace {

constexpr double kAlong = 1e-6;        // of a unit vector: an arc's normal along an axis
constexpr double kFlat = 1e-4;         // mm of rise: below, an arc is flat
constexpr double kSameAxis = 1e-7;     // rad
constexpr int kDeepest = 24;           // halvings of one motion
constexpr int kProbes = 8;             // places of a piece that are looked at
constexpr double kOfTolerance = 0.75;  // what may be between them

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Rotary Between(const Rotary& a, const Rotary& b, double s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
}

class Subdivision {
 public:
  Subdivision(const PartGeometry& geometry, const PlanOptions& options, const MoveFrame& frame,
              const ToolCurve& curve, bool chords)
      : geometry_(geometry),
        options_(options),
        frame_(frame),
        curve_(curve),
        chords_(chords || frame.mode == PlanMode::kAxes),
        great_circle_(options.abilities[static_cast<std::size_t>(frame.mode)].great_circle) {}

  struct Node {
    double t = 0.0;
    Rotary rotary{};
  };

  /// Appends the nodes after `a` up to `b`.
  bool Split(const Node& a, const Node& b, int depth, std::vector<Node>* nodes) const {
    if (Holds(a, b)) {
      nodes->push_back(b);
      return true;
    }
    if (depth == kDeepest) return false;
    const double t = 0.5 * (a.t + b.t);
    const auto rotary = geometry_.Between(curve_.Axis(t), a.rotary, b.rotary);
    if (!rotary) return false;
    const Node middle{t, *rotary};
    return Split(a, middle, depth + 1, nodes) && Split(middle, b, depth + 1, nodes);
  }

 private:
  /// The control's way from a to b keeps to the curve.
  bool Holds(const Node& a, const Node& b) const {
    const bool turns = a.rotary != b.rotary && !great_circle_;
    if (!turns && !chords_) return true;
    const Eigen::Vector3d tip_a = curve_.Tip(a.t), tip_b = curve_.Tip(b.t);
    const bool bows = turns && frame_.mode == PlanMode::kAxes;
    Eigen::Vector3d xyz_a, xyz_b;
    if (bows) {
      xyz_a = geometry_.Xyz(frame_.mode, nullptr, tip_a, a.rotary);
      xyz_b = geometry_.Xyz(frame_.mode, nullptr, tip_b, b.rotary);
    }
    for (int i = 1; i < kProbes; ++i) {
      const double s = static_cast<double>(i) / kProbes;
      const double t = a.t + s * (b.t - a.t);
      const Rotary rotary = Between(a.rotary, b.rotary, s);
      if (turns && Angle(geometry_.ToolAxis(rotary), curve_.Axis(t)) >
                       kOfTolerance * options_.angle_tolerance) {
        return false;
      }
      const Eigen::Vector3d tip = bows ? geometry_.TipOfAxes(xyz_a + s * (xyz_b - xyz_a), rotary)
                                       : Eigen::Vector3d(tip_a + s * (tip_b - tip_a));
      if ((tip - curve_.Tip(t)).norm() > kOfTolerance * options_.tolerance) return false;
    }
    return true;
  }

  const PartGeometry& geometry_;
  const PlanOptions& options_;
  const MoveFrame& frame_;
  const ToolCurve& curve_;
  bool chords_;        ///< The tip goes straight from node to node.
  bool great_circle_;  ///< As PlanAbilities.
};

/// Chords that keep to an arc; three in half a turn at least: of fewer the ends look like a short
/// line.
int PartsOf(const ClArc& arc, double tolerance) {
  const double most =
      2.0 * std::acos(1.0 - std::min(1.0, 0.999 * tolerance / std::max(arc.radius, 1e-6)));
  const int halves = 1 + static_cast<int>(arc.sweep / std::numbers::pi);
  return std::max(3 * halves, static_cast<int>(std::ceil(arc.sweep / most)));
}

/// The tool stands still, and the second axis turns to where the next motion needs it.
void TurnAtPole(const PartGeometry& geometry, const PlanOptions& options, const MoveFrame& frame,
                const ClPose& pose, const Rotary& from, const Rotary& to, const ClFeed& feed,
                std::vector<PlanMove>* moves) {
  const double turn = std::hypot(to[0] - from[0], to[1] - from[1]);
  int pieces = 1;
  if (frame.mode == PlanMode::kAxes) {
    // The tip is led on chords of its circle about the axis.
    const double radius = (geometry.Xyz(frame.mode, nullptr, pose.tip_M, from) -
                           geometry.Xyz(frame.mode, nullptr, pose.tip_M, to))
                              .norm() /
                          std::max(1e-9, 2.0 * std::abs(std::sin(0.5 * turn)));
    const double most =
        2.0 *
        std::acos(1.0 - std::min(1.0, kOfTolerance * options.tolerance / std::max(radius, 1e-6)));
    pieces = static_cast<int>(std::ceil(turn / most));
  }
  PlanMove move;
  move.feed = feed;
  move.time = turn / pieces / options.turn_rate;
  move.of_file = false;
  for (int i = 1; i <= pieces; ++i) {
    move.end = PoseAt(geometry, frame, pose,
                      geometry.OnGrid(Between(from, to, static_cast<double>(i) / pieces)));
    moves->push_back(move);
  }
}

/// The arc in the coordinates of the frame, if the mode can carry it there.
std::optional<PlanArc> ArcOf(const PartGeometry& geometry, const PlanOptions& options,
                             const MoveFrame& frame, const ClArc& arc, const Rotary& rotary) {
  const Eigen::Matrix3d directions = geometry.Directions(frame.mode, frame.plane_P, rotary);
  const Eigen::Vector3d normal = directions * arc.normal_M;
  const PlanAbilities& abilities = options.abilities[static_cast<std::size_t>(frame.mode)];
  for (const auto& [plane, axis] :
       {std::pair(PlanPlane::kXY, 2), std::pair(PlanPlane::kZX, 1), std::pair(PlanPlane::kYZ, 0)}) {
    if (!abilities.arcs[static_cast<std::size_t>(plane)]) continue;
    if (!abilities.helices && std::abs(arc.rise) > kFlat) continue;
    if (normal.cross(Eigen::Vector3d::Unit(axis)).norm() > kAlong) continue;
    PlanArc found;
    found.plane = plane;
    found.clockwise = normal[axis] < 0.0;
    found.radius = arc.radius;
    found.centre = geometry.Xyz(frame.mode, frame.plane_P, arc.centre_M, rotary);
    const double whole = std::ceil(arc.sweep / (2.0 * std::numbers::pi) - 1e-9);
    found.turns = std::max(0, static_cast<int>(whole) - 1);
    return found;
  }
  return std::nullopt;
}

}  // namespace

PlanPose PoseAt(const PartGeometry& geometry, const MoveFrame& frame, const ClPose& pose,
                const Rotary& rotary) {
  return {geometry.Xyz(frame.mode, frame.plane_P, pose.tip_M, rotary), rotary, pose.axis_M};
}

bool FeedMoves(const PartGeometry& geometry, const PlanOptions& options, const MoveFrame& frame,
               const ClPose& start, const Rotary& from, const ClPose& end, const Rotary& to,
               const std::optional<ClArc>& arc, const ClFeed& feed, std::vector<PlanMove>* moves) {
  const ToolCurve curve(start, end, arc);
  const auto time = [&](double share) {
    return feed.per_revolution || feed.value <= 0.0 ? 0.0 : share * curve.length() / feed.value;
  };
  PlanMove move;
  move.feed = feed;
  if (arc && curve.turn() < kSameAxis) {
    move.arc = ArcOf(geometry, options, frame, *arc, from);
    if (move.arc) {
      move.end = PoseAt(geometry, frame, end, to);
      move.time = time(1.0);
      moves->push_back(move);
      return true;
    }
  }
  Rotary begin = from;
  if (curve.turn() > 0.0) {
    const auto way = geometry.Follow(end.axis_M, from, 0.5 * options.angle_tolerance);
    if (way && way->start != from) {
      TurnAtPole(geometry, options, frame, start, from, way->start, feed, moves);
      begin = way->start;
    }
  }
  std::vector<Subdivision::Node> nodes;
  const Subdivision subdivision(geometry, options, frame, curve, arc.has_value());
  const int parts = arc ? PartsOf(*arc, kOfTolerance * options.tolerance) : 1;
  Subdivision::Node last{0.0, begin};
  for (int i = 1; i <= parts; ++i) {
    Subdivision::Node next{static_cast<double>(i) / parts, to};
    if (i < parts) {
      const auto between = geometry.Between(curve.Axis(next.t), last.rotary, to);
      if (!between) return false;
      next.rotary = curve.turn() < kSameAxis ? begin : *between;
    }
    if (!subdivision.Split(last, next, 0, &nodes)) return false;
    last = next;
  }
  double t = 0.0;
  for (const auto& node : nodes) {
    const ClPose pose{node.t < 1.0 ? curve.Tip(node.t) : end.tip_M, curve.Axis(node.t)};
    move.end = PoseAt(geometry, frame, pose, node.rotary);
    move.time = time(node.t - t);
    move.of_file = node.t >= 1.0;
    moves->push_back(move);
    t = node.t;
  }
  return true;
}

}  // namespace ncsim::post
