// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/comp_joint.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/units.h"

namespace ncsim::control {
namespace {

// A turn below this (rad) is tangent: the offsets' ends coincide.
constexpr double kTangent = 1e-9;
// Up to here an arc that should be tangent may miss its neighbour by rounding: a short line joins
// the two, and the tool comes nearer than its radius by at most radius * kNearlyTangent^2 / 2 (0.5
// um for a 10 mm tool radius).
constexpr double kNearlyTangent = 0.01;
constexpr double kRightAngle = 0.5 * kPi + 1e-9;
constexpr double kReversal = kPi - 1e-6;
// A move run backwards by less than this is rounding.
constexpr double kBackwards = 1e-6;

// The intersection of the two offset lines or tangents at a corner: corner + offset * Mitre().
Point Mitre(const Point& in, const Point& out) {
  return (Left(in) + Left(out)) / (1.0 + in.dot(out));
}

bool OnOutside(double turn, double offset) {
  return std::abs(turn) > kReversal || (offset > 0.0) == (turn < 0.0);
}

// The turn (magnitude) of an outside corner sharper than 270 degrees of outside angle?
bool Acute(const Point& in, const Point& out, double offset) {
  const double turn = Turn(in, out);
  return offset != 0.0 && std::abs(turn) > kRightAngle && OnOutside(turn, offset);
}

// Around an outside corner from beside the end of the first move to beside the start of the second.
void Around(const Point& corner, double offset, const Point& in, const Point& out,
            const ContourOptions& options, CompJoint* joint) {
  const Point from = corner + offset * Left(in);
  const Point to = corner + offset * Left(out);
  joint->first_end = from;
  joint->second_start = to;
  if (!options.fanuc_corners) {
    joint->links.push_back({to, true});
    return;
  }
  if (std::abs(Turn(in, out)) <= kRightAngle) {
    joint->links.push_back({corner + offset * Mitre(in, out), false});
  } else {
    joint->links.push_back({from + std::abs(offset) * in, false});
    joint->links.push_back({to - std::abs(offset) * out, false});
  }
  joint->links.push_back({to, false});
}

// A line runs on to the first link, and starts at the last: they lie on its own offset.
void ExtendLines(bool first_is_line, bool second_is_line, CompJoint* joint) {
  if (joint->links.empty() || joint->links.front().arc) return;
  if (first_is_line) {
    joint->first_end = joint->links.front().to;
    joint->links.erase(joint->links.begin());
  }
  if (!second_is_line) return;
  joint->links.pop_back();
  joint->second_start = joint->links.empty() ? joint->first_end : joint->links.back().to;
}

// The common point of the two offsets that takes the least away from both.
std::optional<Point> InsideCorner(const CompEdge& first, const CompEdge& second) {
  std::optional<Point> best;
  double least = 0.0;
  for (const Point& point : Intersections(first.ideal, second.ideal)) {
    const double before = first.ideal.length() - first.ideal.Along(point);
    const double after = second.ideal.Along(point);
    // The end of an arc is not moved outward; that of a line is, by an outside corner that follows.
    if (before < -kBackwards || after < -kBackwards) continue;
    if (second.ideal.arc && after > second.ideal.length() + kBackwards) continue;
    if (!best || before + after < least) {
      best = point;
      least = before + after;
    }
  }
  return best;
}

}  // namespace

CompEdge MakeEdge(const Curve& programmed, double offset) {
  CompEdge edge;
  edge.programmed = programmed;
  edge.ideal = OffsetLeft(programmed, offset);
  edge.offset = offset;
  return edge;
}

CompJoint JoinEdges(const CompEdge& first, const CompEdge& second, const ContourOptions& options) {
  const Point in = first.programmed.end_tangent();
  const Point out = second.programmed.start_tangent();
  const double turn = Turn(in, out);
  CompJoint joint;
  joint.first_end = first.ideal.end;
  joint.second_start = second.ideal.start;
  joint.first_along = first.ideal.length();
  if (first.offset != 0.0 && std::abs(turn) > kTangent) {
    if (OnOutside(turn, first.offset)) {
      Around(first.programmed.end, first.offset, in, out, options, &joint);
      ExtendLines(!first.ideal.arc, !second.ideal.arc, &joint);
      // Only lines run beyond their own ends.
      if (!first.ideal.arc) joint.first_along = first.ideal.Along(joint.first_end);
      if (!second.ideal.arc) joint.second_along = second.ideal.Along(joint.second_start);
    } else if (const std::optional<Point> point = InsideCorner(first, second)) {
      joint.first_end = joint.second_start = *point;
      joint.first_along = first.ideal.Along(*point);
      joint.second_along = second.ideal.Along(*point);
    } else {
      joint.fits = std::abs(turn) < kNearlyTangent;
    }
  }
  if (joint.links.empty() && (joint.first_end - joint.second_start).norm() > kTangent) {
    joint.links.push_back({joint.second_start, false});
  }
  if (joint.first_along < first.start_along - kBackwards) joint.fits = false;
  return joint;
}

CompJoint JoinEntry(const Curve& entry, const CompEdge& second, const ContourOptions& options) {
  CompJoint joint;
  joint.first_end = joint.second_start = second.ideal.start;
  const Point in = entry.end_tangent();
  const Point out = second.programmed.start_tangent();
  if (options.type_b && Acute(in, out, second.offset)) {
    Around(entry.end, second.offset, in, out, options, &joint);
    ExtendLines(false, !second.ideal.arc, &joint);
    if (!second.ideal.arc) joint.second_along = second.ideal.Along(joint.second_start);
  }
  return joint;
}

CompJoint JoinExit(const CompEdge& first, const Curve& exit, const ContourOptions& options) {
  CompJoint joint;
  joint.first_end = joint.second_start = first.ideal.end;
  joint.first_along = first.ideal.length();
  const Point in = first.programmed.end_tangent();
  const Point out = exit.start_tangent();
  if (options.type_b && Acute(in, out, first.offset)) {
    Around(exit.start, first.offset, in, out, options, &joint);
    ExtendLines(!first.ideal.arc, false, &joint);
    if (!first.ideal.arc) joint.first_along = first.ideal.Along(joint.first_end);
  }
  if (joint.first_along < first.start_along - kBackwards) joint.fits = false;
  return joint;
}

}  // namespace ncsim::control
