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
/// Of a turn on the grid, mm: any will do, one near the size of a machine's links does well.
constexpr double kGridRadius = 256.0;

/// Turns up to here count as even, rad: their arcs are longer than their chords by less than 1 in
/// 2000.
constexpr double kEvenTurn = 0.1;

/// The measures of one motion.
struct Measures {
  JointVector joints;
  double linear = 0.0;
  double tip = 0.0;
  double axis = 0.0;
  Travel::Evenness even;
};

double ChordOrArc(double turn, const Measures& measures) {
  return measures.even.tip ? turn : kinematics::Chord(turn);
}

Measures OfTcp(const TcpCurve& curve) {
  const kinematics::FiveAxis& control = curve.frame->control;
  // Within half the way of the middle, so within twice that of an end.
  const JointVector middle =
      curve.great_circle == nullptr ? 0.5 * (curve.q0 + curve.q1) : RotaryAt(curve, 0.5);
  const TcpReach reach = Reach(curve, middle, 0.5, 0.5);
  Measures measures;
  measures.joints = 2.0 * reach.deviation;
  double squares = 0.0;
  for (const int joint : control.linear())
    squares += measures.joints[joint] * measures.joints[joint];
  measures.linear = std::sqrt(squares);
  if (control.linear_square()) {
    measures.linear = std::min(measures.linear, 2.0 * reach.linear_distance);
  }
  const auto& rotary = control.rotary();
  measures.even.tip = !curve.arc && curve.great_circle == nullptr &&
                      std::all_of(rotary.begin(), rotary.end(),
                                  [&](int joint) { return measures.joints[joint] <= kEvenTurn; });
  measures.tip = TipTravel(curve, 1.0);
  for (const int joint : rotary) {
    measures.tip += ChordOrArc(measures.joints[joint], measures) * curve.frame->centre_error;
  }
  return measures;
}

Measures OfJoints(const Motion& motion, const kinematics::KinematicTree& tree) {
  Measures measures;
  if (std::holds_alternative<AxisArc>(motion.path)) {
    const JointBox box = Box(motion, Whole(motion));
    measures.joints = box.upper - box.lower;
  } else {
    measures.joints = (motion.q1() - motion.q0()).cwiseAbs();  // each axis goes one way
  }
  double squares = 0.0;
  for (Eigen::Index i = 0; i < measures.joints.size(); ++i) {
    const auto joint = static_cast<std::size_t>(tree.moving_joints()[static_cast<std::size_t>(i)]);
    if (tree.joints()[joint].type == kinematics::JointType::kRevolute) continue;
    squares += measures.joints[i] * measures.joints[i];
  }
  measures.linear = std::sqrt(squares);
  measures.even.joints = std::holds_alternative<AxisLinear>(motion.path);
  return measures;
}

/// All that is within `change` of both ends.
template <class Vector, class Change>
void Enclose(const Vector& a, const Vector& b, const Change& change, Vector* lower, Vector* upper) {
  *lower = lower->cwiseMin(a.cwiseMax(b) - change);
  *upper = upper->cwiseMax(a.cwiseMin(b) + change);
}

Travel::Box EmptyBox(Eigen::Index joints) {
  Travel::Box box;
  box.lower = JointVector::Constant(joints, kInfinity);
  box.upper = -box.lower;
  box.tip_lower = box.axis_lower = Eigen::Vector3d::Constant(kInfinity);
  box.tip_upper = box.axis_upper = -box.tip_lower;
  return box;
}

Travel::Box Union(const Travel::Box& a, const Travel::Box& b) {
  return {a.lower.cwiseMin(b.lower),           a.upper.cwiseMax(b.upper),
          a.tip_lower.cwiseMin(b.tip_lower),   a.tip_upper.cwiseMax(b.tip_upper),
          a.axis_lower.cwiseMin(b.axis_lower), a.axis_upper.cwiseMax(b.axis_upper)};
}

bool Turns(const JointVector& change, const kinematics::FiveAxis& five_axis) {
  return std::any_of(five_axis.rotary().begin(), five_axis.rotary().end(),
                     [&](int joint) { return change[joint] != 0.0; });
}

/// Measures motions of one tool.
class Meter {
 public:
  using ToolPose = kinematics::FiveAxis::ToolPose;

  Meter(const kinematics::KinematicTree& tree, const kinematics::FiveAxis* five_axis, double length)
      : tree_(tree), five_axis_(five_axis), length_(length) {
    if (five_axis == nullptr) return;
    tip_path_.emplace(tree, five_axis->table_link(), five_axis->spindle_link());
    tip_ = {five_axis->spindle_link(), {0.0, 0.0, length}, 0.0};
  }

  ToolPose ToolAt(const JointVector& q) const {
    return five_axis_ == nullptr ? ToolPose() : five_axis_->ToolInTable(q, length_);
  }

  /// Of a motion between two poses of the tool.
  Measures Of(const Motion& motion, const ToolPose& from, const ToolPose& to) const {
    const auto* curve = std::get_if<TcpCurve>(&motion.path);
    Measures measures = curve != nullptr ? OfTcp(*curve) : OfJoints(motion, tree_);
    if (five_axis_ == nullptr) return measures;
    for (std::size_t k = 0; k < five_axis_->rotary().size(); ++k) {
      measures.axis += ChordOrArc(measures.joints[five_axis_->rotary()[k]], measures) *
                       std::max(from.radii[k], to.radii[k]);
    }
    if (curve != nullptr && curve->great_circle != nullptr) {
      measures.axis = std::min(measures.axis, kinematics::Chord(curve->great_circle->angle()));
    }
    if (curve != nullptr) {
      // The control leads its own tip; the metal's is somewhere else on the tool's axis.
      measures.tip += std::abs(curve->frame->length - length_) * measures.axis;
    } else {
      measures.tip = std::max(tip_path_->Bound(motion.q0(), tip_, measures.joints),
                              tip_path_->Bound(motion.q1(), tip_, measures.joints));
      measures.even.tip = measures.even.joints && !Turns(measures.joints, *five_axis_);
    }
    return measures;
  }

 private:
  const kinematics::KinematicTree& tree_;
  const kinematics::FiveAxis* five_axis_;
  double length_;
  std::optional<kinematics::RelativePath> tip_path_;
  kinematics::Extent tip_;
};

}  // namespace

Travel::Travel(const kinematics::KinematicTree& tree, const kinematics::FiveAxis* five_axis,
               double tool_length, std::vector<const Motion*> motions)
    : motions_(std::move(motions)), tool_length_(tool_length) {
  width_ = static_cast<std::size_t>(tree.num_moving()) + 3;
  sums_.assign(width_ * (motions_.size() + 1), 0.0);
  boxes_.emplace_back((motions_.size() + kLeaf - 1) / kLeaf, EmptyBox(tree.num_moving()));
  if (motions_.empty()) return;
  const Meter meter(tree, five_axis, tool_length);
  tools_.reserve(motions_.size() + 1);
  middle_of_.reserve(motions_.size());
  even_.reserve(motions_.size());
  tools_.push_back(meter.ToolAt(motions_.front()->q0()));
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Motion& motion = *motions_[i];
    tools_.push_back(meter.ToolAt(motion.q1()));
    const Meter::ToolPose& from = tools_[i];
    const Meter::ToolPose& to = tools_[i + 1];
    const Measures measures = meter.Of(motion, from, to);
    corner_rounding_ = std::max(corner_rounding_, motion.facts.corner_rounding);
    orientation_tolerance_ = std::max(orientation_tolerance_, motion.facts.orientation_tolerance);
    Box& box = boxes_[0][i / kLeaf];
    const auto all = [](double change) { return Eigen::Vector3d::Constant(change); };
    Enclose(motion.q0(), motion.q1(), measures.joints, &box.lower, &box.upper);
    Enclose(from.tip, to.tip, all(measures.tip), &box.tip_lower, &box.tip_upper);
    Enclose(from.axis, to.axis, all(measures.axis), &box.axis_lower, &box.axis_upper);
    AddSums(i, measures.joints, measures.linear, measures.tip, measures.axis);
    even_.push_back(measures.even);
    AddMiddle(motion);
  }
  AddLevels();
}

void Travel::AddMiddle(const Motion& motion) {
  middle_of_.push_back(-1);
  if (!std::holds_alternative<DogLeg>(motion.path)) return;
  middle_of_.back() = static_cast<int>(middles_.size());
  // Each axis goes one way.
  middles_.push_back(
      {0.5 * (motion.q0() + motion.q1()), (0.5 * (motion.q1() - motion.q0())).cwiseAbs()});
}

void Travel::AddSums(std::size_t i, const JointVector& joints, double linear, double tip,
                     double axis) {
  const double* before = row(i);
  double* after = sums_.data() + (i + 1) * width_;
  const auto count = static_cast<std::size_t>(joints.size());
  for (std::size_t k = 0; k < count; ++k) {
    after[k] = before[k] + joints[static_cast<Eigen::Index>(k)];
  }
  after[count] = before[count] + linear;
  after[count + 1] = before[count + 1] + tip;
  after[count + 2] = before[count + 2] + axis;
}

void Travel::AddLevels() {
  while (boxes_.back().size() > 1) {
    const std::vector<Box>& below = boxes_.back();
    std::vector<Box> level;
    for (std::size_t i = 0; i < below.size(); i += 2) {
      level.push_back(i + 1 < below.size() ? Union(below[i], below[i + 1]) : below[i]);
    }
    boxes_.push_back(std::move(level));
  }
}

PairTravel::PairTravel(const PairPath& pair, const Travel& travel)
    : pair_(&pair), travel_(&travel) {
  const std::size_t joints = travel.width() - 3;
  if (!pair.tool_to_table) {
    const Travel::Box& all = travel.box(travel.levels() - 1, 0);
    const kinematics::TravelWeights weights =
        pair.path.Weights(0.5 * (all.lower + all.upper), 0.5 * (all.upper - all.lower), pair.a);
    for (std::size_t k = 0; k < joints; ++k) {
      Weigh(k, weights.joints[static_cast<Eigen::Index>(k)]);
    }
    Weigh(joints, weights.linear);
    return;
  }
  // A point of the body goes with the tip and turns about it: a solid of revolution by as much as
  // its axis turns, any other by as much as the rotary joints do.
  Weigh(joints + 1, 1.0);
  const Eigen::Vector3d p_ST(0.0, 0.0, travel.tool_length());
  reach_ = (pair.p_SC - p_ST).norm() + pair.a.radius;
  in_spindle_ = pair.X_SA.matrix() == Eigen::Matrix4d::Identity();
  if (pair.revolved) {
    Weigh(joints + 2, reach_);
    return;
  }
  for (const int joint : pair.rotary) Weigh(static_cast<std::size_t>(joint), reach_);
}

void PairTravel::Weigh(std::size_t measure, double weight) {
  if (weight != 0.0) weights_.push_back({measure, weight});
}

double PairTravel::Between(std::size_t i, std::size_t j) const {
  const double* from = travel_->row(i);
  const double* to = travel_->row(j);
  double sum = kSumError;
  for (const auto& [k, weight] : weights_) sum += weight * (to[k] - from[k]);
  return sum;
}

bool PairTravel::Even(std::size_t i) const {
  const Travel::Evenness& even = travel_->even(i);
  return pair_->tool_to_table ? even.tip : even.joints;
}

std::size_t PairTravel::StretchEnd(std::size_t i, std::size_t level) const {
  const std::size_t stretch = Travel::kLeaf << level;
  return std::min(travel_->size(), (i / stretch + 1) * stretch);
}

PairTravel::Neighbourhood PairTravel::Around(std::size_t i, std::size_t level, int grid) const {
  const Travel::Box& box = travel_->box(level, i / (Travel::kLeaf << level));
  Neighbourhood around;
  around.end = StretchEnd(i, level);
  if (!by_tip()) {
    JointVector& q = around.q;
    q = 0.5 * (box.lower + box.upper);
    const kinematics::RelativePath& path = pair_->path;
    const std::vector<int>& joints = path.joint_indices();
    if (joints.size() < std::tuple_size_v<GridKey>) {
      around.key.emplace().fill(0);
      std::size_t k = 0;
      (*around.key)[k++] = grid;
      for (const int joint : joints) {
        const double spacing = std::ldexp(1.0, grid) / (path.revolute(k - 1) ? kGridRadius : 1.0);
        const double place = std::round(q[joint] / spacing);
        (*around.key)[k++] = static_cast<int>(place);
        q[joint] = place * spacing;
      }
    }
    const JointVector astray = (box.upper - q).cwiseMax(q - box.lower).cwiseMax(0.0);
    around.radius = kSumError + pair_->path.Bound(q, pair_->a, astray);
    return around;
  }
  const Eigen::Vector3d middle = 0.5 * (box.axis_lower + box.axis_upper);
  around.axis = middle.norm() > 0.1 ? middle.normalized() : Eigen::Vector3d::UnitZ();
  around.tip = 0.5 * (box.tip_lower + box.tip_upper);
  const double turn =
      0.5 * (box.axis_upper - box.axis_lower).norm() + (middle - around.axis).norm();
  around.radius =
      kSumError + 0.5 * (box.tip_upper - box.tip_lower).norm() + std::min(turn, 2.0) * reach_;
  return around;
}

Eigen::Isometry3d PairTravel::PoseOf(const Neighbourhood& around) const {
  return around.q.size() > 0 ? pair_->path.Pose(around.q) : PoseOf(around.tip, around.axis);
}

// Of a solid of revolution: any turn about its axis will do.
Eigen::Isometry3d PairTravel::PoseOf(const Eigen::Vector3d& tip,
                                     const Eigen::Vector3d& axis) const {
  const Eigen::Vector3d axis_B = pair_->X_BTable.linear() * axis;
  Eigen::Isometry3d X_BS = Eigen::Isometry3d::Identity();
  X_BS.linear().col(2) = -axis_B;
  X_BS.linear().col(0) = axis_B.unitOrthogonal();
  X_BS.linear().col(1) = X_BS.linear().col(2).cross(X_BS.linear().col(0));
  X_BS.translation() = pair_->X_BTable * tip + travel_->tool_length() * axis_B;
  return in_spindle_ ? X_BS : X_BS * pair_->X_SA;
}

Eigen::Isometry3d PairTravel::Pose(std::size_t i) const {
  if (by_tip()) return PoseOf(travel_->tool(i).tip, travel_->tool(i).axis);
  return pair_->path.Pose(i > 0 ? (*travel_)[i - 1].q1() : (*travel_)[0].q0());
}

// The way of a solid of revolution that does not turn is its tip's.
std::optional<Translation> PairTravel::TranslationOf(std::size_t i) const {
  const Motion& motion = (*travel_)[i];
  if (!by_tip() || !IsStraight(motion, pair_->path)) return motion::TranslationOf(motion, *pair_);
  Translation result;
  result.X_BA = Pose(i);
  result.way = pair_->X_BTable.linear() * (travel_->tool(i + 1).tip - travel_->tool(i).tip);
  result.astray = kStraight + kSumError;
  return result;
}

std::optional<PairTravel::Neighbourhood> PairTravel::AroundDogLeg(std::size_t i) const {
  const Travel::Middle* middle = travel_->middle(i);
  if (middle == nullptr) return std::nullopt;
  Neighbourhood around;
  around.radius = kSumError + pair_->path.Bound(middle->q, pair_->a, middle->deviation);
  around.end = i + 1;
  around.q = middle->q;
  return around;
}

// The totals only grow: strides that double, then halves of what is left.
std::size_t PairTravel::Furthest(std::size_t i, double limit) const {
  const std::size_t size = travel_->size();
  if (limit <= 0.0) return i;
  if (Between(i, size) < limit) return size;
  std::size_t low = i;
  std::size_t high = size;  // not below the limit
  for (std::size_t stride = 1; low + stride < high; stride *= 2) {
    if (Between(i, low + stride) < limit) {
      low += stride;
    } else {
      high = low + stride;
      break;
    }
  }
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (Between(i, middle) < limit ? low : high) = middle;
  }
  return low;
}

}  // namespace ncsim::motion
