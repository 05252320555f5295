// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/smoothing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "sim/base/units.h"
#include "sim/motion/path.h"

namespace ncsim::motion {
namespace {

/// What a turn by `angle` moves a point at radius 1 by, at most: its tangent, which is more than
/// the chord, and from where it is more than any turn can do, that.
double Turned(double angle) {
  constexpr double kMost = 1.1;  // rad, of which the tangent is just below 2
  return angle < kMost ? std::tan(angle) : 2.0;
}

/// How far the second rotary joint may be off, rad, while the tool axis is off by `tolerance`.
double SecondJoint(const TcpCurve& curve, double tolerance) {
  if (curve.great_circle == nullptr) return tolerance;
  const kinematics::FiveAxis& control = curve.frame->control;
  const double sine = control.RadiiAboutTip(Eigen::Vector3d::UnitZ(), RotaryAt(curve, 0.5))[1];
  const double tilt = std::asin(std::min(1.0, sine)) - 0.5 * curve.great_circle->angle();
  if (tilt <= tolerance) return kPi;
  return std::max(tolerance, std::asin(std::sin(tolerance) / std::sin(tilt)));
}

constexpr double kLoose = 1.1;            // a bound that is no further above the truth is good
constexpr double kShortest = 1.0 / 16.0;  // piece of a motion that is halved

}  // namespace

Smoothing::Smoothing(const kinematics::KinematicTree& tree, const kinematics::FiveAxis* five_axis,
                     const PairPath& pair, std::optional<double> reach,
                     std::optional<kinematics::Extent> b)
    : five_axis_(five_axis), pair_(&pair), reach_(reach), b_(std::move(b)) {
  if (five_axis == nullptr) return;
  if (b_) b_->p_LC = pair.X_BTable.inverse() * b_->p_LC;
  tool_path_.emplace(tree, five_axis->table_link(), five_axis->spindle_link());
}

void Smoothing::Add(const Motion& motion, double tool_length, Slack* slack) {
  slack->rounding = std::max(slack->rounding, motion.facts.corner_rounding);
  if (motion.facts.orientation_tolerance <= 0.0) return;
  const double tolerance = motion.facts.orientation_tolerance;
  const auto* curve = std::get_if<TcpCurve>(&motion.path);
  const double second = curve != nullptr ? SecondJoint(*curve, tolerance) : tolerance;
  slack->turn = std::max(slack->turn, Turned(tolerance));
  slack->second = std::max(slack->second, Turned(second));
  slack->free = slack->free || curve == nullptr;
  if (curve == nullptr) return;
  slack->length = std::max(slack->length, std::abs(curve->frame->length - tool_length));
  slack->centre = std::max(slack->centre, curve->frame->centre_error);
}

double Smoothing::Of(const Motion& motion, double tool_length) const {
  Slack slack;
  Add(motion, tool_length, &slack);
  if (slack.empty() || five_axis_ == nullptr || pair_->path.rigid()) return slack.rounding;
  return slack.about_tip(*pair_) ? AboutTip(motion, tool_length, slack)
                                 : Over(motion, Whole(motion), tool_length, slack);
}

// What a box of joint positions adds to the truth comes off by halving it.
double Smoothing::Over(const Motion& motion, const Span& span, double tool_length,
                       const Slack& slack) const {
  const JointBox box = Box(motion, span);
  const JointVector middle = 0.5 * (box.lower + box.upper);
  const double bound = About(middle, 0.5 * (box.upper - box.lower), tool_length, slack);
  if (span.s1 - span.s0 < kShortest ||
      bound <= kLoose * About(middle, JointVector::Zero(middle.size()), tool_length, slack)) {
    return bound;
  }
  Span first = span, second = span;
  first.s1 = second.s0 = 0.5 * (span.s0 + span.s1);
  return std::max(Over(motion, first, tool_length, slack),
                  Over(motion, second, tool_length, slack));
}

double Smoothing::Greatest(const Travel& run) const {
  double greatest = run.corner_rounding();
  if (run.orientation_tolerance() <= 0.0 || five_axis_ == nullptr || pair_->path.rigid()) {
    return greatest;
  }
  for (std::size_t leaf = 0; leaf * Travel::kLeaf < run.size(); ++leaf) {
    const std::size_t begin = leaf * Travel::kLeaf;
    const std::size_t end = std::min(run.size(), begin + Travel::kLeaf);
    Slack slack;
    for (std::size_t i = begin; i < end; ++i) Add(run[i], run.tool_length(), &slack);
    if (slack.empty()) continue;
    const Bounds bounds = OfStretch(run, leaf, slack);
    if (bounds.all <= greatest) continue;
    if (bounds.all <= kLoose * bounds.place) {
      greatest = bounds.all;
      continue;
    }
    for (std::size_t i = begin; i < end; ++i) {
      greatest = std::max(greatest, Of(run[i], run.tool_length()));
    }
  }
  return greatest;
}

Smoothing::Bounds Smoothing::OfStretch(const Travel& run, std::size_t leaf,
                                       const Slack& slack) const {
  const Travel::Box& box = run.box(0, leaf);
  const double length = run.tool_length();
  if (slack.about_tip(*pair_)) {
    const Eigen::Vector3d tip = 0.5 * (box.tip_lower + box.tip_upper);
    const double astray = 0.5 * (box.tip_upper - box.tip_lower).norm();
    return {AboutTip(tip, astray, length, slack), AboutTip(tip, 0.0, length, slack)};
  }
  const JointVector middle = 0.5 * (box.lower + box.upper);
  const JointVector half = 0.5 * (box.upper - box.lower);
  return {About(middle, half, length, slack), About(middle, 0.0 * half, length, slack)};
}

// With the metal's tip within `astray` of `tip` in the table's frame. The control turns about its
// own, and may have put that off by what it rounds.
double Smoothing::AboutTip(const Eigen::Vector3d& tip, double astray, double tool_length,
                           const Slack& slack) const {
  double reach = reach_.value_or((pair_->p_SC - Eigen::Vector3d(0.0, 0.0, tool_length)).norm() +
                                 pair_->a.radius);
  if (b_) reach = std::min(reach, (b_->p_LC - tip).norm() + b_->radius + astray + slack.rounding);
  const double joints = slack.both(five_axis_->rotary().size());
  const double turn = pair_->revolved ? slack.turn : joints;
  return slack.rounding + turn * (reach + slack.length) + joints * slack.centre;
}

double Smoothing::AboutTip(const Motion& motion, double tool_length, const Slack& slack) const {
  Eigen::Vector3d tip, axis;
  five_axis_->TipInTable(motion.At(0.5), tool_length, &tip, &axis);
  // The metal's tip goes along with the control's, but for the two's lengths and rotary centres.
  const double astray =
      TipTravel(std::get<TcpCurve>(motion.path), 0.5) + 2.0 * slack.length + 4.0 * slack.centre;
  return AboutTip(tip, astray, tool_length, slack);
}

// RelativePath::Bound holds at every pose of the stretch, for changes of the joints by what is said
// here: Weights() has its radii at their greatest.
double Smoothing::About(const JointVector& middle, const JointVector& half, double tool_length,
                        const Slack& slack) const {
  const kinematics::Extent tip{
      five_axis_->spindle_link(), {0.0, 0.0, tool_length}, slack.length + slack.centre};
  const JointVector radii = tool_path_->Weights(middle, half, tip).joints;
  const kinematics::TravelWeights weights = pair_->path.Weights(middle, half, pair_->a);
  double sum = 0.0;
  double taken_back = slack.rounding;
  double turn = slack.turn;
  for (const int joint : five_axis_->rotary()) {
    sum += turn * weights.joints[joint];
    taken_back += turn * radii[joint];
    turn = slack.second;
  }
  const Eigen::Vector3d shares = taken_back * five_axis_->linear_gain();
  const std::vector<int>& linear = five_axis_->linear();
  for (std::size_t i = 0; i < linear.size(); ++i) {
    sum += weights.joints[linear[i]] * shares[static_cast<Eigen::Index>(i)];
  }
  return sum + weights.linear * (five_axis_->linear_square() ? taken_back : shares.norm());
}

}  // namespace ncsim::motion
