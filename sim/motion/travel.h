// SPDX-License-Identifier: BSD-3-Clause
// Running totals over a run of motions, from which the travel of any pair over any stretch of them
// follows without a look at the motions: what makes a block that is far from everything free.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/motion/motion.h"
#include "sim/motion/translation.h"

namespace ncsim::motion {

/// Motions that follow each other: each starts where the one before it ended, and one tool is in
/// the spindle. Their totals are sums of upper bounds, one for each motion and measure, of how far
/// any pose of the motion is from either of its ends. The measures: the change of each joint (mm,
/// rad); the change of all prismatic joints as one vector (mm); how far the tool tip gets in the
/// table's frame (mm), and the change of the tool axis there (of a unit vector).
class Travel {
 public:
  /// Where everything stays during a stretch of motions: joints; tool tip and tool axis (unit, tip
  /// to gauge line) in the table's frame.
  struct Box {
    JointVector lower, upper;
    Eigen::Vector3d tip_lower, tip_upper, axis_lower, axis_upper;
  };
  /// Which measures of a motion are even: how far a pose is from the start and how far from the
  /// end come, together, to no more than the measure.
  struct Evenness {
    bool joints = false;  ///< In proportion.
    bool tip = false;     ///< On a straight way, the axes in proportion and by little.
  };
  /// Motions of the shortest stretch that has a box.
  static constexpr std::size_t kLeaf = 32;

  /// The motions must outlive it. `tool_length`: gauge line to tip of the tool in the spindle; 0
  /// without. `five_axis` may be null: then the tip's measures are not used.
  Travel(const kinematics::KinematicTree& tree, const kinematics::FiveAxis* five_axis,
         double tool_length, std::vector<const Motion*> motions);

  std::size_t size() const { return motions_.size(); }
  const Motion& operator[](std::size_t i) const { return *motions_[i]; }
  double tool_length() const { return tool_length_; }

  /// Boxes of stretches of kLeaf * 2^level motions, the last one perhaps shorter; the highest level
  /// has one, of all motions.
  std::size_t levels() const { return boxes_.size(); }
  const Box& box(std::size_t level, std::size_t i) const { return boxes_[level][i]; }
  /// Tip and axis of the tool in the table's frame where motion i starts; or, of size(), where the
  /// last one ends.
  const kinematics::FiveAxis::ToolPose& tool(std::size_t i) const { return tools_[i]; }
  const Evenness& even(std::size_t i) const { return even_[i]; }
  /// Of a dog-leg: where all of its joints are at half of their ways, and half of each way. No pose
  /// of it need be there.
  struct Middle {
    JointVector q, deviation;
  };
  /// Null for other motions.
  const Middle* middle(std::size_t i) const {
    return middle_of_[i] < 0 ? nullptr : &middles_[static_cast<std::size_t>(middle_of_[i])];
  }
  /// Greatest Facts::corner_rounding and Facts::orientation_tolerance.
  double corner_rounding() const { return corner_rounding_; }
  double orientation_tolerance() const { return orientation_tolerance_; }

  std::size_t width() const { return width_; }
  /// Sums over the motions before the i-th, `width()` of them; i up to size().
  const double* row(std::size_t i) const { return sums_.data() + i * width_; }

 private:
  void AddMiddle(const Motion& motion);
  void AddSums(std::size_t i, const JointVector& joints, double linear, double tip, double axis);
  void AddLevels();

  std::vector<const Motion*> motions_;
  double tool_length_ = 0.0;
  std::vector<std::vector<Box>> boxes_;
  std::vector<kinematics::FiveAxis::ToolPose> tools_;
  std::vector<Middle> middles_;
  std::vector<int> middle_of_;
  std::vector<Evenness> even_;
  double corner_rounding_ = 0.0;
  double orientation_tolerance_ = 0.0;
  std::size_t width_ = 0;
  std::vector<double> sums_;
};

/// What a pair makes of a Travel's totals.
class PairTravel {
 public:
  /// Both outlive this.
  PairTravel(const PairPath& pair, const Travel& travel);

  /// Upper bound of how far any point of A gets, as seen from B, from where it is at one end of the
  /// motions [i, j) to any pose of them, mm.
  double Between(std::size_t i, std::size_t j) const;
  /// Is no pose of motion i further from its two ends, in sum, than Between(i, i + 1)?
  bool Even(std::size_t i) const;
  /// The last j in [i, size()] with Between(i, j) < `limit`, and i where there is none.
  std::size_t Furthest(std::size_t i, double limit) const;

  /// X_BA where motion i starts; or, of size(), where the last one ends.
  Eigen::Isometry3d Pose(std::size_t i) const;
  /// As motion::TranslationOf.
  std::optional<Translation> TranslationOf(std::size_t i) const;

  /// A pose on a grid that is the same for all runs; `key` numbers its places.
  using GridKey = std::array<int, 7>;
  /// A pose, and how far from it any point of A is at any pose of the motions up to `end`.
  struct Neighbourhood {
    double radius = 0.0;  ///< mm
    std::size_t end = 0;
    std::optional<GridKey> key;  ///< For pairs whose poses a program comes back to.
    /// The pose: joints or, where there are none, tip and axis of the tool in the table's frame.
    JointVector q;
    Eigen::Vector3d tip, axis;
  };
  /// X_BA.
  Eigen::Isometry3d PoseOf(const Neighbourhood& around) const;
  /// Behind the stretch of `level` that motion i is in.
  std::size_t StretchEnd(std::size_t i, std::size_t level) const;
  /// Of the stretch of `level` that motion i is in. `grid`: the spacing of the grid is 2^grid mm.
  Neighbourhood Around(std::size_t i, std::size_t level, int grid) const;
  /// Of motion i alone, where it is a dog-leg.
  std::optional<Neighbourhood> AroundDogLeg(std::size_t i) const;
  std::size_t levels() const { return travel_->levels(); }

 private:
  Eigen::Isometry3d PoseOf(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis) const;
  void Weigh(std::size_t measure, double weight);
  bool by_tip() const { return pair_->tool_to_table && pair_->revolved; }

  const PairPath* pair_;
  const Travel* travel_;
  struct Weight {
    std::size_t measure;
    double weight;
  };
  std::vector<Weight> weights_;  // of those measures that move the pair
  double reach_ = 0.0;           // tip to the farthest point of A, mm
  bool in_spindle_ = false;      // A's link is the spindle's own
};

}  // namespace ncsim::motion
