// SPDX-License-Identifier: BSD-3-Clause
// The seam. A control makes Motions, checks and collision consume them; a Motion knows no NC text
// and no control.
//
// Every path is a function of a parameter s in [0, 1]; a dog-leg rapid also of `lag` in [0, 1],
// because the machine's acceleration is known only as "at least the stated one": lag 0 is infinite
// acceleration (the polyline), lag 1 the stated one. Other paths ignore lag.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "kinematics/five_axis.h"
#include "kinematics/great_circle.h"
#include "kinematics/relative_bound.h"
#include "sim/base/finding.h"

namespace ncsim::motion {

using kinematics::JointVector;

enum class MotionKind : std::uint8_t { kRapid, kFeed, kArc, kDwell, kToolChange };
/// "rapid", "feed", "arc", "dwell", "toolchange": the trace's words.
std::string_view ToString(MotionKind kind);

/// All axes in proportion: q(s) = q0 + s (q1 - q0).
struct AxisLinear {
  JointVector q0, q1;
};

/// Each axis at its own rate (Haas setting 335 NONE; the groups of LINEAR modes move in proportion
/// inside a group, which is expressed by giving the axes of a group the same `duration` and the
/// same `ramp`). An axis alone accelerates to its rate, keeps it and brakes, or turns from the one
/// to the other at once when the way is short. With the acceleration stated / lag its ramp takes
/// lag * ramp[i], and it arrives after duration[i] + lag * ramp[i] (a trapezoid, for duration >=
/// lag * ramp) or 2 sqrt(duration * lag * ramp) (a triangle). All axes start together.
///
/// s is not time but time seen from a clock that waits: at s, the time since the start is
///   t = begin + s (end - begin) + lag * shift,  clamped to the time that the motion takes at that
///   lag,
/// with shift = half the ramp of the axis with the longest duration, begin = -shift, and end so
/// late that all axes stand at s = 1 whatever the lag. So that axis, while it runs at its rate, is
/// at the same place at a given s whatever the lag: poses with equal s and different lag lie close
/// together, and boxes over lag are thin. Each axis is monotone in s.
struct DogLeg {
  JointVector q0, q1;
  JointVector duration;  ///< s, at infinite acceleration; 0 for an axis that rests.
  JointVector ramp;      ///< s, rate / stated acceleration: the time from rest to full rate.
};

/// s that the slowest axis takes at `lag`: 1, with the stated acceleration, is the motion's
/// duration.
double Duration(const DogLeg& path, double lag = 1.0);

/// A circle or helix of the linear joints in the machine frame, the rotary joints in proportion:
/// linear(s) = centre + radius (cos(phi) e1 + sin(phi) e2) + s * pitch, phi = phi0 + s * sweep. The
/// linear vector is the three linear joints in FiveAxis::linear() order. `end_error` (from an arc
/// whose end is not on the circle within the control's tolerance) goes in linearly with s.
struct AxisArc {
  JointVector q0, q1;
  Eigen::Vector3d centre, e1, e2, pitch, end_error;
  double radius = 0.0, phi0 = 0.0, sweep = 0.0;
  std::array<int, 3> linear{};
};

/// What a control believes about the machine while TCP is active. The metal may differ (settings
/// 255-257).
struct TcpFrame {
  kinematics::FiveAxis control;  ///< The control's idea of the kinematics.
  double length = 0.0;           ///< Active tool length, mm.
  /// mm: how far the rotary axes that the control believes in lie from the metal's, all by one
  /// vector (0 when they agree). With it, the tip's places in B as control and metal see them move
  /// against each other by at most centre_error times the sum of the rotary joints' changes: a part
  /// of the motion bound.
  double centre_error = 0.0;
};

/// The tip follows a line or an arc in the table frame B (as the control sees it); rotary joints in
/// proportion, or as the tool axis' way along a great circle asks; the linear joints follow from
/// FiveAxis::SolveLinear.
struct TcpCurve {
  std::shared_ptr<const TcpFrame> frame;
  /// The tool axis' way in B (null: rotary joints in proportion). q0 and q1 are at its start() and
  /// end().
  std::shared_ptr<const kinematics::GreatCircle> great_circle;
  JointVector q0, q1;  ///< Machine values at the ends (linear joints included).
  bool arc = false;
  Eigen::Vector3d p0_B, p1_B;                        ///< Tip, line.
  Eigen::Vector3d centre, e1, e2, pitch, end_error;  ///< Tip, arc: as AxisArc.
  double radius = 0.0, phi0 = 0.0, sweep = 0.0;
};

using Path = std::variant<AxisLinear, DogLeg, AxisArc, TcpCurve>;

/// Modal facts that a check needs. Tool and part frame are indices into tables that outlive the
/// stream.
struct Facts {
  double feed = 0.0;  ///< mm/s along the tip's path; 0 for rapids.
  bool tcp = false;   ///< TCP active (not only a TcpCurve: a held rapid is a DogLeg with tcp true).
  bool spindle_on = false;
  bool brake_conflict = false;  ///< A rotary axis feeds while its brake is commanded on.
  bool exact_stop = false;
  int tool = 0;    ///< T number in the spindle; 0 = none.
  int offset = 0;  ///< Index into OffsetTable (control's summary): the part frame of the trace.
  int cycle =
      0;  ///< Same number > 0 for all motions of one canned cycle's hole: retract and re-entry.
  bool names_linear = false;  ///< The block names X, Y or Z (what the trace is held against).
  double corner_rounding =
      0.0;  ///< mm: how far the control may leave the programmed corner at this motion's ends.
  /// rad: how far smoothing may turn the tool away from the programmed orientation.
  double orientation_tolerance = 0.0;
  /// What decides at this control how a rotary axis gets from one turn to the next; for people, and
  /// static.
  std::string_view wrap_note;
};

struct Motion {
  MotionKind kind = MotionKind::kFeed;
  SourcePosition where;
  Path path;
  double start_time = 0.0;  ///< s, from the start of the program.
  double duration = 0.0;    ///< s.
  Facts facts;

  const JointVector& q0() const;
  const JointVector& q1() const;
  /// Joint positions at s in [0, 1]. Equal to q0() and q1() at the ends (an arc's and a TCP curve's
  /// linear joints to rounding: below 1e-9 mm).
  JointVector At(double s, double lag = 0.0) const;
  /// s since start_time at which the motion is at s.
  double ElapsedTime(double s, double lag = 0.0) const;
};

/// A feed along a line or an arc, as distinct from rapids, dwells and tool changes.
bool IsFeed(const Motion& motion);
/// A rapid, or the way to and from the tool changer.
bool IsRapid(const Motion& motion);

/// A piece of a motion.
struct Span {
  double s0 = 0.0, s1 = 1.0;
  double lag0 = 0.0, lag1 = 0.0;
};
/// The whole motion: every pose that it may take lies in it. lag1 is 1 for a DogLeg, unless all its
/// axes keep in proportion, so that the acceleration does not change the path; 0 otherwise.
Span Whole(const Motion& motion);

/// For each joint an interval [lower, upper] that contains its position over the whole span:
/// rigorous (to rounding, 1e-9), and exact for AxisLinear and DogLeg; for AxisArc and TcpCurve
/// within a bound that shrinks with the span.
struct JointBox {
  JointVector lower, upper;
};
JointBox Box(const Motion& motion, const Span& span);

/// The two bodies of a pair, and what their relative motion needs. Built once a pair and tool.
/// Keeps nothing of `tree`.
struct PairPath {
  /// `five_axis`: the metal's; may be null, and then TCP curves get the general bound.
  PairPath(const kinematics::KinematicTree& tree, const kinematics::Extent& a, int link_b,
           const kinematics::FiveAxis* five_axis);

  /// What leads over the table and the spindle from body B to body A, whose motion against each
  /// other TCP rules.
  struct Detour {
    kinematics::RelativePath table_from_b;
    kinematics::RelativePath a_from_table;
    kinematics::RelativePath a_from_spindle;
  };

  kinematics::RelativePath path;
  kinematics::Extent a;  ///< Extent of body A (tool side where one of the two is).
  /// A is rigid with the spindle link and B with the table link: the TCP bound applies alone.
  bool tool_to_table = false;
  /// When tool_to_table: the table's frame in B's link, A's link and the extent centre in S, and
  /// the rotary joints between.
  Eigen::Isometry3d X_BTable = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_SA = Eigen::Isometry3d::Identity();
  Eigen::Vector3d p_SC = Eigen::Vector3d::Zero();
  std::vector<int> rotary;
  /// A is a solid of revolution about S's Z axis: a turn about that moves nothing. Set by who
  /// knows.
  bool revolved = false;
  /// For other pairs with a rotary joint of the five between them (tool and trunnion, ram and
  /// table): a second bound.
  std::optional<Detour> detour;
};

/// Upper bound of the displacement of any point of body A, as seen from body B's link, between the
/// pose at (s_ref, lag_ref), a point of `span`, and any other pose of the span: never an
/// under-estimate but for rounding (below 1e-9 mm).
///
/// Under TCP, for tool against table, it is |tip path| + sum Chord(|rotary|) * (distance of the
/// extent from the rotary axis's parallel through the tip + centre_error); for other pairs the
/// lesser of kinematics::RelativePath with what the joints can do about s_ref, and the sum over the
/// way b - table - spindle - a. Otherwise RelativePath over Box().
double RelativeBound(const Motion& motion, const PairPath& pair, const Span& span, double s_ref,
                     double lag_ref);

}  // namespace ncsim::motion
