// SPDX-License-Identifier: BSD-3-Clause
// Running totals over a run of motions, from which the travel of any pair over any stretch of them
// follows without a look at the motions: what makes a block that is far from everything free.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/motion/motion.h"

namespace ncsim::motion {

/// Motions that follow each other: each starts where the one before it ended, and one tool is in
/// the spindle. Their totals are sums of upper bounds, one for each motion and measure, of how far
/// any pose of the motion is from either of its ends. The measures: the change of each joint (mm,
/// rad); the change of all prismatic joints as one vector (mm); how far the tool tip gets in the
/// table's frame (mm), and the change of the tool axis there (of a unit vector).
class Travel {
 public:
  /// The motions must outlive it. `tool_length`: gauge line to tip of the tool in the spindle; 0
  /// without. `five_axis` may be null: then the tip's measures are not used.
  Travel(const kinematics::KinematicTree& tree, const kinematics::FiveAxis* five_axis,
         double tool_length, std::vector<const Motion*> motions);

  std::size_t size() const { return motions_.size(); }
  const Motion& operator[](std::size_t i) const { return *motions_[i]; }
  double tool_length() const { return tool_length_; }
  /// Greatest difference between tool_length() and the length that the control believes in, mm.
  double length_error() const { return length_error_; }

  /// Every pose of every motion has its joints in middle() +- half().
  const JointVector& middle() const { return middle_; }
  const JointVector& half() const { return half_; }
  /// Greatest Facts::corner_rounding.
  double corner_rounding() const { return corner_rounding_; }

  std::size_t width() const { return width_; }
  /// Sums over the motions before the i-th, `width()` of them; i up to size().
  const double* row(std::size_t i) const { return sums_.data() + i * width_; }

 private:
  std::vector<const Motion*> motions_;
  double tool_length_ = 0.0;
  double length_error_ = 0.0;
  JointVector middle_, half_;
  double corner_rounding_ = 0.0;
  std::size_t width_ = 0;
  std::vector<double> sums_;
};

/// What a pair makes of a Travel's totals.
class PairTravel {
 public:
  PairTravel(const PairPath& pair, const Travel& travel);

  /// Upper bound of how far any point of A gets, as seen from B, from where it is at one end of the
  /// motions [i, j) to any pose of them, mm.
  double Between(std::size_t i, std::size_t j) const;
  /// The last j in [i, size()] with Between(i, j) < `limit`, and i where there is none.
  std::size_t Furthest(std::size_t i, double limit) const;

 private:
  const Travel* travel_;
  std::vector<double> weights_;
};

}  // namespace ncsim::motion
