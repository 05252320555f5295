// SPDX-License-Identifier: BSD-3-Clause
// RelativeBound: how far one body gets, as seen from another, over a span of a motion.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/motion/path.h"

namespace ncsim::motion {
namespace {

bool Contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// Spindle against table within `ds` of the pose `q`, for a ball about `p_SC` in S, while the
/// rotary joints turn by at most `turn`. A point of the tool stands at tip + R v, v fixed in S: it
/// moves with the tip, and turns about it. What the metal's rotary centres differ from the
/// control's adds its share. The linear joints of `q` and `turn` do not matter.
double ToolBound(const TcpCurve& curve, const JointVector& q, double ds, const JointVector& turn,
                 const Eigen::Vector3d& p_SC, double radius) {
  const kinematics::FiveAxis& control = curve.frame->control;
  const Eigen::Vector3d v_S = p_SC - Eigen::Vector3d(0.0, 0.0, curve.frame->length);
  const std::array<double, 2> radii = control.RadiiAboutTip(v_S, q);
  double bound = TipTravel(curve, ds);
  for (std::size_t k = 0; k < control.rotary().size(); ++k) {
    const double chord = kinematics::Chord(turn[control.rotary()[k]]);
    bound += chord * (radii[k] + radius + curve.frame->centre_error);
  }
  return bound;
}

/// Over b - table - spindle - a: the same argument as for RelativePath, with the spindle's motion
/// in the table as one step.
double DetourBound(const TcpCurve& curve, const PairPath& pair, const JointVector& q, double ds,
                   const TcpReach& reach, double prismatic_limit) {
  const PairPath::Detour& detour = *pair.detour;
  const kinematics::Extent in_table{0, detour.a_from_table.Pose(q) * pair.a.p_LC, pair.a.radius};
  const Eigen::Vector3d p_SC = detour.a_from_spindle.Pose(q) * pair.a.p_LC;
  return detour.table_from_b.Bound(q, in_table, reach.deviation, prismatic_limit) +
         ToolBound(curve, q, ds, reach.deviation, p_SC, pair.a.radius) +
         detour.a_from_spindle.Bound(q, pair.a, reach.deviation, prismatic_limit);
}

double TcpBound(const TcpCurve& curve, const PairPath& pair, const Span& span, double s_ref) {
  const double ds = std::max(span.s1 - s_ref, s_ref - span.s0);
  JointVector q = RotaryAt(curve, s_ref);
  if (pair.tool_to_table) {
    return ToolBound(curve, q, ds, RotaryTravel(curve, s_ref, ds), pair.p_SC, pair.a.radius);
  }
  curve.frame->control.SolveLinear(TipPoint(curve, s_ref), curve.frame->length, &q);
  const TcpReach reach = Reach(curve, q, s_ref, ds);
  const double prismatic_limit = curve.frame->control.linear_square()
                                     ? reach.linear_distance
                                     : std::numeric_limits<double>::infinity();
  const double bound = pair.path.Bound(q, pair.a, reach.deviation, prismatic_limit);
  if (!pair.detour) return bound;
  return std::min(bound, DetourBound(curve, pair, q, ds, reach, prismatic_limit));
}

}  // namespace

PairPath::PairPath(const kinematics::KinematicTree& tree, const kinematics::Extent& extent,
                   int link_b, const kinematics::FiveAxis* five_axis)
    : path(tree, link_b, extent.link), a(extent) {
  if (five_axis == nullptr || path.rigid()) return;
  Detour way{{tree, link_b, five_axis->table_link()},
             {tree, five_axis->table_link(), extent.link},
             {tree, five_axis->spindle_link(), extent.link}};
  tool_to_table = way.table_from_b.rigid() && way.a_from_spindle.rigid();
  if (tool_to_table) {
    const JointVector any = JointVector::Zero(tree.num_moving());
    X_BTable = way.table_from_b.Pose(any);
    X_SA = way.a_from_spindle.Pose(any);
    p_SC = X_SA * extent.p_LC;
    rotary = five_axis->rotary();
    return;
  }
  const std::vector<int>& between = path.joint_indices();
  if (std::any_of(between.begin(), between.end(),
                  [&](int joint) { return Contains(five_axis->rotary(), joint); })) {
    detour = std::move(way);
  }
}

double RelativeBound(const Motion& motion, const PairPath& pair, const Span& span, double s_ref,
                     double lag_ref) {
  if (pair.path.rigid()) return 0.0;
  if (const auto* curve = std::get_if<TcpCurve>(&motion.path)) {
    return TcpBound(*curve, pair, span, s_ref);
  }
  const JointVector q = motion.At(s_ref, lag_ref);
  const JointBox box = Box(motion, span);
  const JointVector deviation = (box.upper - q).cwiseMax(q - box.lower).cwiseMax(0.0);
  return pair.path.Bound(q, pair.a, deviation);
}

}  // namespace ncsim::motion
