// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/travel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/motion/path.h"

namespace ncsim::motion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Covers rounding of sums over a window (4096 terms, up to some kilometres in all), mm.
constexpr double kSumError = 1e-6;

/// The measures of one motion.
struct Measures {
  JointVector joints;
  double linear = 0.0;
  double tip = 0.0;
  double axis = 0.0;
};

/// How far the control's idea of a unit vector along the tool turns in the table's frame.
double AxisChange(const kinematics::FiveAxis& five_axis, const JointVector& q,
                  const JointVector& change) {
  const std::array<double, 2> radii = five_axis.RadiiAboutTip(Eigen::Vector3d::UnitZ(), q);
  double sum = 0.0;
  for (std::size_t k = 0; k < five_axis.rotary().size(); ++k) {
    sum += kinematics::Chord(change[five_axis.rotary()[k]]) * radii[k];
  }
  return sum;
}

Measures OfTcp(const TcpCurve& curve) {
  const kinematics::FiveAxis& control = curve.frame->control;
  JointVector q = Interpolate(curve.q0, curve.q1, 0.5);
  control.SolveLinear(TipPoint(curve, 0.5), curve.frame->length, &q);
  // Within half the way of the middle, so within twice that of an end.
  const TcpReach reach = Reach(curve, q, 0.5, 0.5);
  Measures measures;
  measures.joints = 2.0 * reach.deviation;
  double squares = 0.0;
  for (const int joint : control.linear())
    squares += measures.joints[joint] * measures.joints[joint];
  measures.linear = std::sqrt(squares);
  if (control.linear_square()) {
    measures.linear = std::min(measures.linear, 2.0 * reach.linear_distance);
  }
  measures.tip = TipTravel(curve, 1.0);
  for (const int joint : control.rotary()) {
    measures.tip += kinematics::Chord(measures.joints[joint]) * curve.frame->centre_error;
  }
  return measures;
}

Measures OfJoints(const Motion& motion, const kinematics::KinematicTree& tree) {
  const JointBox box = Box(motion, Whole(motion));
  Measures measures;
  measures.joints = box.upper - box.lower;
  double squares = 0.0;
  for (Eigen::Index i = 0; i < measures.joints.size(); ++i) {
    const auto joint = static_cast<std::size_t>(tree.moving_joints()[static_cast<std::size_t>(i)]);
    if (tree.joints()[joint].type == kinematics::JointType::kRevolute) continue;
    squares += measures.joints[i] * measures.joints[i];
  }
  measures.linear = std::sqrt(squares);
  return measures;
}

}  // namespace

Travel::Travel(const kinematics::KinematicTree& tree, const kinematics::FiveAxis* five_axis,
               double tool_length, std::vector<const Motion*> motions)
    : motions_(std::move(motions)), tool_length_(tool_length) {
  const auto joints = static_cast<std::size_t>(tree.num_moving());
  width_ = joints + 3;
  sums_.assign(width_ * (motions_.size() + 1), 0.0);
  JointVector lower = JointVector::Constant(tree.num_moving(), kInfinity);
  JointVector upper = -lower;
  std::optional<kinematics::RelativePath> tip_path;
  kinematics::Extent tip;
  if (five_axis != nullptr) {
    tip_path.emplace(tree, five_axis->table_link(), five_axis->spindle_link());
    tip = {five_axis->spindle_link(), {0.0, 0.0, tool_length}, 0.0};
  }
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Motion& motion = *motions_[i];
    const auto* curve = std::get_if<TcpCurve>(&motion.path);
    Measures measures = curve != nullptr ? OfTcp(*curve) : OfJoints(motion, tree);
    if (curve != nullptr) {
      length_error_ = std::max(length_error_, std::abs(curve->frame->length - tool_length));
    }
    if (five_axis != nullptr) {
      if (curve == nullptr) {
        measures.tip = std::max(tip_path->Bound(motion.q0(), tip, measures.joints),
                                tip_path->Bound(motion.q1(), tip, measures.joints));
      }
      measures.axis = std::max(AxisChange(*five_axis, motion.q0(), measures.joints),
                               AxisChange(*five_axis, motion.q1(), measures.joints));
    }
    lower = lower.cwiseMin(motion.q0() - measures.joints);
    upper = upper.cwiseMax(motion.q0() + measures.joints);
    corner_rounding_ = std::max(corner_rounding_, motion.facts.corner_rounding);
    const double* before = row(i);
    double* after = sums_.data() + (i + 1) * width_;
    for (std::size_t k = 0; k < joints; ++k) {
      after[k] = before[k] + measures.joints[static_cast<Eigen::Index>(k)];
    }
    after[joints] = before[joints] + measures.linear;
    after[joints + 1] = before[joints + 1] + measures.tip;
    after[joints + 2] = before[joints + 2] + measures.axis;
  }
  middle_ = 0.5 * (lower + upper);
  half_ = 0.5 * (upper - lower);
}

PairTravel::PairTravel(const PairPath& pair, const Travel& travel)
    : travel_(&travel), weights_(travel.width(), 0.0) {
  const std::size_t joints = travel.width() - 3;
  if (!pair.tool_to_table) {
    const kinematics::TravelWeights weights =
        pair.path.Weights(travel.middle(), travel.half(), pair.a);
    for (std::size_t k = 0; k < joints; ++k) {
      weights_[k] = weights.joints[static_cast<Eigen::Index>(k)];
    }
    weights_[joints] = weights.linear;
    return;
  }
  // A point of the body goes with the tip and turns about it: a solid of revolution by as much as
  // its axis turns, any other by as much as the rotary joints do.
  weights_[joints + 1] = 1.0;
  const Eigen::Vector3d p_ST(0.0, 0.0, travel.tool_length());
  const double reach = (pair.p_SC - p_ST).norm() + pair.a.radius + travel.length_error();
  if (pair.revolved) {
    weights_[joints + 2] = reach;
    return;
  }
  for (const int joint : pair.rotary) weights_[static_cast<std::size_t>(joint)] = reach;
}

double PairTravel::Between(std::size_t i, std::size_t j) const {
  const double* from = travel_->row(i);
  const double* to = travel_->row(j);
  double sum = kSumError;
  for (std::size_t k = 0; k < weights_.size(); ++k) sum += weights_[k] * (to[k] - from[k]);
  return sum;
}

// The totals only grow: strides that double, then halves.
std::size_t PairTravel::Furthest(std::size_t i, double limit) const {
  const std::size_t size = travel_->size();
  std::size_t low = i;
  std::size_t stride = 1;
  while (low + stride <= size && Between(i, low + stride) < limit) {
    low += stride;
    stride *= 2;
  }
  for (; stride > 0; stride /= 2) {
    if (low + stride <= size && Between(i, low + stride) < limit) low += stride;
  }
  return low;
}

}  // namespace ncsim::motion
