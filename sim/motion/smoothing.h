// SPDX-License-Identifier: BSD-3-Clause
// How far a control that smooths may take a pair of bodies off the motion that it was told.
#pragma once

#include <optional>
#include <vector>

#include "kinematics/five_axis.h"
#include "sim/motion/travel.h"

namespace ncsim::motion {

/// Off a motion, the tip is no further than Facts::corner_rounding from where it should be in the
/// part, the tool axis turned by no more than Facts::orientation_tolerance, and no rotary axis is
/// further than that from its place; the linear axes follow, so as to keep the tip (on a TcpCurve;
/// else they keep their places but for the rounding).
///
/// A point r from the tip then gets r tan(tolerance) away as seen from the part, which is more than
/// the chord: r of the farthest point of either body, whichever is less, since they would meet in a
/// point of both. For a body that is no solid of revolution about the tool's axis the spindle's own
/// turn counts too: that is no more than the sum over the rotary axes. For pairs with a link
/// between spindle and table, each rotary axis moves the point by tan(tolerance) times its distance
/// from that axis, and the linear axes by what they must, to take back what the rotary axes do to
/// the tip: tan(tolerance) times the sum of its distances from them.
///
/// Where the tool axis is led along a great circle, the second rotary joint may be off by more than
/// the tolerance: by asin(sin(tolerance) / sin(tilt)), and anywhere within a tolerance of the pole.
/// (A nutating machine's joints are taken as an orthogonal one's.)
class Smoothing {
 public:
  /// `five_axis` may be null (then no orientation is smoothed); it and `pair` outlive this. `reach`
  /// of a solid of revolution in the spindle: from the tool's tip to its farthest point, mm. `b` is
  /// the extent of body B, where it is known.
  Smoothing(const kinematics::KinematicTree& tree, const kinematics::FiveAxis* five_axis,
            const PairPath& pair, std::optional<double> reach,
            std::optional<kinematics::Extent> b = std::nullopt);

  /// Upper bound, mm, of what a clearance may lack of what it is at the same s of the motion: how
  /// far any point of A, seen from B, may be from its place; or any point of B, seen from A.
  /// `tool_length`: gauge line to tip of the metal.
  double Of(const Motion& motion, double tool_length) const;
  /// The same of all motions of a run.
  double Greatest(const Travel& run) const;

 private:
  /// What a stretch of motions may be off by, at most.
  struct Slack {
    double rounding = 0.0;  // mm
    double turn = 0.0;      // mm a mm from the axis: of the tool axis and the first rotary joint
    double second = 0.0;    // of the second rotary joint
    double length = 0.0;    // mm: the control's tool against the metal's
    double centre = 0.0;    // mm: TcpFrame::centre_error
    bool free = false;      // a motion that does not keep the tip
    bool empty() const { return turn <= 0.0; }
    double both(std::size_t joints) const { return joints > 1 ? turn + second : turn; }
    /// Bodies turn about the tip, wherever that is.
    bool about_tip(const PairPath& pair) const { return pair.tool_to_table && !free; }
  };
  static void Add(const Motion& motion, double tool_length, Slack* slack);
  double Over(const Motion& motion, const Span& span, double tool_length, const Slack& slack) const;
  double About(const JointVector& middle, const JointVector& half, double tool_length,
               const Slack& slack) const;
  double AboutTip(const Eigen::Vector3d& tip, double astray, double tool_length,
                  const Slack& slack) const;
  double AboutTip(const Motion& motion, double tool_length, const Slack& slack) const;
  /// Of a stretch of one box of the run, and the same with all of it in one place.
  struct Bounds {
    double all = 0.0;
    double place = 0.0;
  };
  Bounds OfStretch(const Travel& run, std::size_t leaf, const Slack& slack) const;

  const kinematics::FiveAxis* five_axis_;
  const PairPath* pair_;
  std::optional<double> reach_;
  std::optional<kinematics::Extent> b_;                // with its p_LC in the table's frame
  std::optional<kinematics::RelativePath> tool_path_;  // from the table to the spindle
};

}  // namespace ncsim::motion
