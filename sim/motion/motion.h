// SPDX-License-Identifier: BSD-3-Clause
// The seam. A control makes Motions, checks and collision consume them; a Motion knows no NC text and no control.
//
// Every path is a function of a parameter s in [0, 1]; a dog-leg rapid also of `lag` in [0, 1], because the machine's
// acceleration is known only as "at least the stated one": lag 0 is infinite acceleration (the polyline), lag 1 the
// stated one. Other paths ignore lag.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "kinematics/five_axis.h"
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

/// Each axis at its own rate (Haas setting 335 NONE; the groups of LINEAR modes move in proportion inside a group, which
/// is expressed by giving the axes of a group the same `duration`). Axis i alone, at infinite acceleration, takes
/// duration[i]; s is the fraction of the whole motion's time at the given lag. Each axis is monotone in time, and at a
/// given time never further along with more lag: that makes the boxes of JointBox() exact.
struct DogLeg {
  JointVector q0, q1;
  JointVector duration;   ///< s, at infinite acceleration; 0 for an axis that rests.
  JointVector ramp;       ///< s, rate / stated acceleration: the time from rest to full rate.
};

/// A circle or helix of the linear joints in the machine frame, the rotary joints in proportion:
/// linear(s) = centre + radius (cos(phi) e1 + sin(phi) e2) + s * pitch, phi = phi0 + s * sweep. The linear vector is the
/// three linear joints in FiveAxis::linear() order. `end_error` (from an arc whose end is not on the circle within the
/// control's tolerance) goes in linearly with s.
struct AxisArc {
  JointVector q0, q1;
  Eigen::Vector3d centre, e1, e2, pitch, end_error;
  double radius = 0.0, phi0 = 0.0, sweep = 0.0;
  std::array<int, 3> linear{};
};

/// What a control believes about the machine while TCP is active. The metal may differ (settings 255-257).
struct TcpFrame {
  kinematics::FiveAxis control;   ///< The control's idea of the kinematics.
  double length = 0.0;            ///< Active tool length, mm.
  /// Largest distance, in mm, between where the control believes a table point to be and where it is (0 when the rotary
  /// centres agree): goes into the motion bound.
  double centre_error = 0.0;
};

/// The tip follows a line or an arc in the table frame B (as the control sees it); rotary joints in proportion; the
/// linear joints follow from FiveAxis::SolveLinear.
struct TcpCurve {
  std::shared_ptr<const TcpFrame> frame;
  JointVector q0, q1;             ///< Machine values at the ends (linear joints included).
  bool arc = false;
  Eigen::Vector3d p0_B, p1_B;     ///< Tip, line.
  Eigen::Vector3d centre, e1, e2, pitch, end_error;  ///< Tip, arc: as AxisArc.
  double radius = 0.0, phi0 = 0.0, sweep = 0.0;
};

using Path = std::variant<AxisLinear, DogLeg, AxisArc, TcpCurve>;

/// Modal facts that a check needs. Tool and part frame are indices into tables that outlive the stream.
struct Facts {
  double feed = 0.0;          ///< mm/s along the tip's path; 0 for rapids.
  bool tcp = false;           ///< TCP active (not only a TcpCurve: a held rapid is a DogLeg with tcp true).
  bool spindle_on = false;
  bool brake_conflict = false;   ///< A rotary axis feeds while its brake is commanded on.
  bool exact_stop = false;
  int tool = 0;               ///< T number in the spindle; 0 = none.
  int offset = 0;             ///< Index into OffsetTable (control's summary): the part frame of the trace.
  int cycle = 0;              ///< Same number > 0 for all motions of one canned cycle's hole: retract and re-entry.
  bool names_linear = false;  ///< The block names X, Y or Z (what the trace is held against).
  double corner_rounding = 0.0;  ///< mm: how far the control may leave the programmed corner at this motion's ends.
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
  /// Joint positions at s.
  JointVector At(double s, double lag = 0.0) const;
};

/// A piece of a motion.
struct Span {
  double s0 = 0.0, s1 = 1.0;
  double lag0 = 0.0, lag1 = 0.0;  ///< lag1 is 1 for a whole DogLeg, 0 otherwise.
};
Span Whole(const Motion& motion);

/// For each joint an interval [lower, upper] that contains its position over the whole span: rigorous, and exact for
/// AxisLinear and DogLeg; for AxisArc and TcpCurve within a bound that shrinks with the span.
struct JointBox {
  JointVector lower, upper;
};
JointBox Box(const Motion& motion, const Span& span);

/// The two bodies of a pair, and what their relative motion needs. Built once a pair and tool.
struct PairPath {
  PairPath(const kinematics::KinematicTree& tree, const kinematics::Extent& a, int link_b,
           const kinematics::FiveAxis* five_axis);
  kinematics::RelativePath path;
  kinematics::Extent a;       ///< Extent of body A (tool side where one of the two is).
  bool tool_to_table = false; ///< A is rigid with the spindle link and B with the table link: TCP bound applies.
  Eigen::Vector3d p_SC = Eigen::Vector3d::Zero();  ///< Extent centre in S, when tool_to_table.
};

/// Upper bound of the displacement of any point of body A, as seen from body B's link, between the pose at (s_ref,
/// lag_ref), a point of `span`, and any other pose of the span. Under TCP, for tool against table, it is
/// |tip path| + sum |rotary| * distance from the rotary axis through the tip + centre_error * sum |rotary|; otherwise
/// kinematics::RelativePath over Box(). Never an under-estimate (tested against dense sampling).
double RelativeBound(const Motion& motion, const PairPath& pair, const Span& span, double s_ref,
                     double lag_ref);

/// Motions travel in immutable windows, cut at tool changes and at a fixed count.
inline constexpr std::size_t kWindowSize = 4096;
struct Window {
  std::vector<Motion> motions;
};

}  // namespace ncsim::motion
