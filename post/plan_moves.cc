// SPDX-License-Identifier: BSD-3-Clause
#include "post/plan_moves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

constexpr double kAlong = 1e-6;        // of a unit vector: an arc's normal along an axis
constexpr double kFlat = 1e-4;         // mm of rise: below, an arc is flat
constexpr double kSameAxis = 1e-7;     // rad
constexpr int kDeepest = 24;           // halvings of one motion
constexpr int kProbes = 8;             // places of a piece that are looked at
constexpr double kOfTolerance = 0.75;  // what may be between them
constexpr double kPoleMargin = 1e-4;   // rad: whether the control is nearer than its limit
constexpr double kNearest = 0.1;       // rad: of one branch
constexpr double kRests = 1e-6;        // mm: the tip stands still
constexpr double kGoesOn = 0.05;       // rad: what the second axis may turn beside the pole
constexpr double kQuarter = 0.5 * std::numbers::pi;

Rotary Between(const Rotary& a, const Rotary& b, double s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
}

/// Chords that keep to an arc; three in half a turn at least: of fewer the ends look like a short
/// line.
double PartsOf(const ClArc& arc, double tolerance) {
  const double most =
      2.0 * std::acos(1.0 - std::min(1.0, 0.999 * tolerance / std::max(arc.radius, 1e-6)));
  const double halves = 1.0 + std::floor(arc.sweep / std::numbers::pi);
  return std::max(3.0 * halves, std::ceil(arc.sweep / most));
}

/// Of one motion: a circle of a kilometre needs two thousand. What needs more is a mistake.
constexpr std::size_t kMostPieces = 100'000;

double Greatest(const Rotary& a, const Rotary& b) {
  return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1]));
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
        abilities_(options.abilities[static_cast<std::size_t>(frame.mode)]) {}

  struct Node {
    double t = 0.0;
    Rotary rotary{};
  };

  /// Appends the nodes after `begin` up to `end`.
  bool Lead(const Node& begin, const Node& end, const std::optional<ClArc>& arc,
            std::vector<Node>* nodes) const {
    const double share = end.t - begin.t;
    const double whole = arc ? PartsOf(*arc, kOfTolerance * options_.tolerance) : 1.0;
    if (!(whole <= static_cast<double>(kMostPieces))) return false;
    const int parts = std::max(1, static_cast<int>(std::ceil(share * whole)));
    Node last = begin;
    for (int i = 1; i <= parts; ++i) {
      Node next = end;
      if (i < parts) {
        next.t = begin.t + share * i / parts;
        const auto between =
            geometry_.Between(curve_.Axis(next.t), last.rotary, end.rotary, Beside());
        if (!between) return false;
        next.rotary = curve_.turn() < kSameAxis ? begin.rotary : *between;
      }
      if (!Split(last, next, 0, nodes)) return false;
      last = next;
    }
    return true;
  }

 private:
  /// Appends the nodes after `a` up to `b`.
  bool Split(const Node& a, const Node& b, int depth, std::vector<Node>* nodes) const {
    if (Holds(a, b)) {
      nodes->push_back(b);
      return true;
    }
    if (depth == kDeepest || nodes->size() >= kMostPieces) return false;
    const double t = 0.5 * (a.t + b.t);
    const auto rotary = geometry_.Between(curve_.Axis(t), a.rotary, b.rotary, Beside());
    if (!rotary) return false;
    const Node middle{t, *rotary};
    return Split(a, middle, depth + 1, nodes) && Split(middle, b, depth + 1, nodes);
  }

  /// The control's way from a to b keeps to the curve.
  bool Holds(const Node& a, const Node& b) const {
    bool turns = a.rotary != b.rotary;
    if (turns && abilities_.great_circle) {
      turns = !geometry_.OnCircle(a.rotary, b.rotary, abilities_.pole_limit + kPoleMargin);
      if (turns && !IsNearest(a, b)) return false;
    }
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
      if (turns && AngleBetween(geometry_.ToolAxis(rotary), curve_.Axis(t)) >
                       kOfTolerance * options_.angle_tolerance) {
        return false;
      }
      const Eigen::Vector3d tip = bows ? geometry_.TipOfAxes(xyz_a + s * (xyz_b - xyz_a), rotary)
                                       : Eigen::Vector3d(tip_a + s * (tip_b - tip_a));
      if ((tip - curve_.Tip(t)).norm() > kOfTolerance * options_.tolerance) return false;
    }
    return true;
  }

  /// How far from the tool axis the second axis may go on in proportion: as PartGeometry::Between.
  /// Where the control is told the tool's vector it goes where that says.
  double Beside() const { return abilities_.great_circle ? 0.0 : PoleTolerance(options_); }
  /// A control that is told the tool's vector takes the nearest of the positions for it.
  bool IsNearest(const Node& a, const Node& b) const {
    const std::vector<Rotary> reach = geometry_.ReachAnywhere(curve_.Axis(b.t), a.rotary);
    return !reach.empty() &&
           std::hypot(reach.front()[0] - b.rotary[0], reach.front()[1] - b.rotary[1]) < kNearest;
  }

  const PartGeometry& geometry_;
  const PlanOptions& options_;
  const MoveFrame& frame_;
  const ToolCurve& curve_;
  bool chords_;  ///< The tip goes straight from node to node.
  const PlanAbilities& abilities_;
};

/// The tool stands still, and the second axis turns to where the next motion needs it.
void TurnAtPole(const PartGeometry& geometry, const PlanOptions& options, const MoveFrame& frame,
                const ClPose& pose, const Rotary& from, const Rotary& to, const ClFeed& feed,
                std::vector<PlanMove>* moves) {
  const double turn = std::hypot(to[0] - from[0], to[1] - from[1]);
  int pieces = static_cast<int>(std::ceil(turn / kQuarter));
  if (frame.mode == PlanMode::kAxes) {
    // The tip is led on chords of its circle about the axis.
    const double radius = (geometry.Xyz(frame.mode, nullptr, pose.tip_M, from) -
                           geometry.Xyz(frame.mode, nullptr, pose.tip_M, to))
                              .norm() /
                          std::max(1e-9, 2.0 * std::abs(std::sin(0.5 * turn)));
    const double most =
        2.0 *
        std::acos(1.0 - std::min(1.0, kOfTolerance * options.tolerance / std::max(radius, 1e-6)));
    pieces = std::max(pieces, static_cast<int>(std::ceil(turn / most)));
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

/// The place where a motion comes to the pole and leaves it with the second axis at another
/// position.
struct PoleVisit {
  double t = 0.0;
  Rotary in{}, out{};
};

std::optional<PoleVisit> VisitPole(const PartGeometry& geometry, double tolerance,
                                   const ToolCurve& curve, const Rotary& from, const Rotary& to) {
  if (curve.turn() < kSameAxis || std::abs(to[1] - from[1]) < kGoesOn) return std::nullopt;
  const auto pole = geometry.Pole(curve.Axis(0.5));
  if (!pole) return std::nullopt;
  PoleVisit visit;
  visit.t = curve.NearestTo(*pole);
  const Eigen::Vector3d axis = curve.Axis(visit.t);
  if (AngleBetween(axis, *pole) > tolerance) return std::nullopt;
  const auto in = geometry.BesidePole(axis, from[1]), out = geometry.BesidePole(axis, to[1]);
  if (!in || !out) return std::nullopt;
  visit.in = visit.t <= 0.0 ? from : *in;
  visit.out = visit.t >= 1.0 ? to : *out;
  return visit;
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

std::string FeedMoves(const PartGeometry& geometry, const PlanOptions& options,
                      const MoveFrame& frame, const ClPose& start, const Rotary& from,
                      const ClPose& end, const Rotary& to, const std::optional<ClArc>& arc,
                      const ClFeed& feed, std::vector<PlanMove>* moves) {
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
      return "";
    }
  }
  using Node = Subdivision::Node;
  const Subdivision subdivision(geometry, options, frame, curve, arc.has_value());
  const auto go = [&](const Node& begin, const Node& goal) {
    std::vector<Node> nodes;
    if (!subdivision.Lead(begin, goal, arc, &nodes)) return false;
    double t = begin.t;
    Rotary rotary = begin.rotary;
    for (const Node& node : nodes) {
      const ClPose pose{node.t < 1.0 ? curve.Tip(node.t) : end.tip_M, curve.Axis(node.t)};
      move.end = PoseAt(geometry, frame, pose, node.rotary);
      move.time = time(node.t - t);
      if (curve.length() < kRests) {
        move.time = Greatest(node.rotary, rotary) / options.turn_rate;
        rotary = node.rotary;
      }
      move.of_file = node.t >= 1.0;
      moves->push_back(move);
      t = node.t;
    }
    return true;
  };
  Node begin{0.0, from};
  bool led = true;
  if (const auto visit = VisitPole(geometry, PoleTolerance(options), curve, from, to)) {
    const double turn = std::abs(visit->out[1] - visit->in[1]);
    const bool by_vector = options.abilities[static_cast<std::size_t>(frame.mode)].great_circle;
    const bool between = visit->t > 0.0 && visit->t < 1.0;  // A vector beside it turns the table.
    if (by_vector && (turn > kQuarter || between)) {
      return "the second rotary axis turns by " + Short(std::round(Degrees(turn))) +
             " deg at the pole, which the tool's vector does not tell a control: use a mode that "
             "names the rotary axes";
    }
    if (visit->t > 0.0) led = go(begin, {visit->t, visit->in});
    begin = {visit->t, visit->in};
    if (!by_vector) {
      const ClPose pose{curve.Tip(visit->t), curve.Axis(visit->t)};
      TurnAtPole(geometry, options, frame, pose, visit->in, visit->out, feed, moves);
      begin.rotary = visit->out;
    }
  }
  if (begin.t < 1.0) led = led && go(begin, {1.0, to});
  if (led) return "";
  return "the tool cannot be led along here within " + Short(Degrees(options.angle_tolerance)) +
         " deg and " + Short(options.tolerance) + " mm with " + std::to_string(kMostPieces) +
         " points";
}

}  // namespace ncsim::post
