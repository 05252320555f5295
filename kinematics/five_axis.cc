// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/five_axis.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kinematics/chain.h"

namespace ncsim::kinematics {
namespace {

/// Least volume of the three unit directions of the linear joints.
constexpr double kLeastVolume = 1e-3;
constexpr double kParallel = 1e-9;

bool Parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.cross(b).norm() < kParallel;
}

}  // namespace

Eigen::Vector3d FiveAxis::RotaryAxis::TurnPoint(double angle, const Eigen::Vector3d& p) const {
  return point + Turn(direction, angle, p - point);
}

double FiveAxis::RotaryAxis::Distance(const Eigen::Vector3d& p) const {
  return direction.cross(p - point).norm();
}

std::optional<FiveAxis> FiveAxis::Make(const KinematicTree& tree, int spindle_link,
                                       int table_link) {
  const Chain chain(tree, table_link, spindle_link);
  FiveAxis result;
  result.spindle_link_ = spindle_link;
  result.table_link_ = table_link;

  struct Linear {
    int index;
    Eigen::Vector3d direction;
    int rotary_before;  // rotary joints between B and it
  };
  std::vector<Linear> linear;
  std::vector<RotaryAxis> axes;
  Eigen::Isometry3d X_BJ = chain.X_before();  // at q = 0
  for (const ChainStep& step : chain.steps()) {
    const Eigen::Vector3d direction = X_BJ.linear() * step.axis;
    if (step.revolute) {
      axes.push_back({direction, X_BJ.translation()});
      result.rotary_.push_back(step.index);
    } else {
      linear.push_back({step.index, direction, static_cast<int>(axes.size())});
    }
    X_BJ = X_BJ * step.X_after;
  }
  if (linear.size() != 3 || axes.size() > 2) return std::nullopt;

  std::reverse(result.rotary_.begin(), result.rotary_.end());
  std::copy(axes.rbegin(), axes.rend(), result.axes_.begin());
  std::sort(linear.begin(), linear.end(),
            [](const Linear& a, const Linear& b) { return a.index < b.index; });
  std::vector<int> rotary_before;
  for (int i = 0; i < 3; ++i) {
    result.linear_.push_back(linear[i].index);
    result.directions_.col(i) = linear[i].direction;
    rotary_before.push_back(linear[i].rotary_before);
  }
  if (std::abs(result.directions_.determinant()) < kLeastVolume) return std::nullopt;
  if (!result.FindLinearFrame(rotary_before, static_cast<int>(axes.size()))) return std::nullopt;

  result.directions_inverse_ = result.directions_.inverse();
  result.linear_gain_ = result.directions_inverse_.rowwise().norm();
  result.linear_square_ =
      (result.directions_.transpose() * result.directions_).isIdentity(kParallel);
  result.X_BS0_ = X_BJ;
  return result;
}

/// Looks for a place among the rotary joints where all three linear joints could stand: a linear
/// joint may be moved past a rotary one that is parallel to it.
bool FiveAxis::FindLinearFrame(const std::vector<int>& rotary_before, int path_rotaries) {
  for (int place = 0; place <= path_rotaries; ++place) {
    bool fits = true;
    for (int i = 0; i < 3; ++i) {
      const auto [first, last] = std::minmax(rotary_before[i], place);
      for (int r = first; r < last; ++r) {  // r counts from B, axes_ from the spindle
        fits = fits && Parallel(axes_[path_rotaries - 1 - r].direction, directions_.col(i));
      }
    }
    if (fits) {
      rotaries_before_linear_ = static_cast<std::size_t>(place);
      return true;
    }
  }
  return false;
}

bool FiveAxis::BeforeLinear(std::size_t k) const {
  return k + rotaries_before_linear_ >= rotary_.size();
}

Eigen::Isometry3d FiveAxis::SpindleInTable(const JointVector& q) const {
  Eigen::Isometry3d X_BS = X_BS0_;
  Eigen::Vector3d slide =
      directions_ * Eigen::Vector3d(q[linear_[0]], q[linear_[1]], q[linear_[2]]);
  for (std::size_t k = 0; k < rotary_.size(); ++k) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(q[rotary_[k]], axes_[k].direction).toRotationMatrix();
    X_BS.linear() = R * X_BS.linear();
    X_BS.translation() = axes_[k].point + R * (X_BS.translation() - axes_[k].point);
    if (BeforeLinear(k)) slide = R * slide;
  }
  X_BS.translation() += slide;
  return X_BS;
}

void FiveAxis::TipInTable(const JointVector& q, double length, Eigen::Vector3d* p_BT_B,
                          Eigen::Vector3d* u_B) const {
  const ToolPose pose = ToolInTable(q, length);
  *p_BT_B = pose.tip;
  *u_B = pose.axis;
}

// As SpindleInTable, for a point and a direction.
FiveAxis::ToolPose FiveAxis::ToolInTable(const JointVector& q, double length) const {
  ToolPose pose;
  pose.axis = -X_BS0_.linear().col(2);
  pose.tip = X_BS0_.translation() - length * pose.axis;
  Eigen::Vector3d slide =
      directions_ * Eigen::Vector3d(q[linear_[0]], q[linear_[1]], q[linear_[2]]);
  for (std::size_t k = 0; k < rotary_.size(); ++k) {
    const RotaryAxis& axis = axes_[k];
    const double c = std::cos(q[rotary_[k]]);
    const double s = std::sin(q[rotary_[k]]);
    pose.radii[k] = axis.direction.cross(pose.axis).norm();
    pose.axis = Turn(axis.direction, c, s, pose.axis);
    pose.tip = axis.point + Turn(axis.direction, c, s, pose.tip - axis.point);
    if (BeforeLinear(k)) slide = Turn(axis.direction, c, s, slide);
  }
  pose.tip += slide;
  return pose;
}

void FiveAxis::SolveLinear(const Eigen::Vector3d& p_BT_B, double length, JointVector* q) const {
  Eigen::Vector3d tip = X_BS0_.translation() + length * X_BS0_.linear().col(2);
  for (std::size_t k = 0; k < rotary_.size(); ++k) {
    tip = axes_[k].TurnPoint((*q)[rotary_[k]], tip);
  }
  Eigen::Vector3d slide = p_BT_B - tip;
  for (std::size_t k = rotary_.size(); k-- > 0 && BeforeLinear(k);) {
    slide = Turn(axes_[k].direction, -(*q)[rotary_[k]], slide);
  }
  const Eigen::Vector3d x = directions_inverse_ * slide;
  for (int i = 0; i < 3; ++i) (*q)[linear_[i]] = x[i];
}

std::array<double, 2> FiveAxis::TipRadii(const Eigen::Vector3d& p_BT_B, double length,
                                         const JointVector& q) const {
  std::array<double, 2> radii{};
  // Axes on the table's side of the linear joints: from B; those on the tool's side: from S.
  Eigen::Vector3d p = p_BT_B;
  std::size_t k = rotary_.size();
  while (k-- > 0 && BeforeLinear(k)) {
    radii[k] = axes_[k].Distance(p);
    if (k > 0 && BeforeLinear(k - 1)) p = axes_[k].TurnPoint(-q[rotary_[k]], p);
  }
  Eigen::Vector3d tip = X_BS0_.translation() + length * X_BS0_.linear().col(2);
  for (k = 0; k < rotary_.size() && !BeforeLinear(k); ++k) {
    radii[k] = axes_[k].Distance(tip);
    if (k + 1 < rotary_.size()) tip = axes_[k].TurnPoint(q[rotary_[k]], tip);
  }
  return radii;
}

std::array<double, 2> FiveAxis::RadiiAboutTip(const Eigen::Vector3d& v_S,
                                              const JointVector& q) const {
  std::array<double, 2> radii{};
  Eigen::Vector3d v = X_BS0_.linear() * v_S;
  for (std::size_t k = 0; k < rotary_.size(); ++k) {
    radii[k] = axes_[k].direction.cross(v).norm();
    if (k + 1 < rotary_.size()) v = Turn(axes_[k].direction, q[rotary_[k]], v);
  }
  return radii;
}

std::vector<double> FiveAxis::Parameters() const {
  // Does not compile when a member is added: it belongs in here too.
  const auto& [spindle, table, linear, rotary, axes, before, directions, inverse, gain, square, X] =
      *this;
  std::vector<double> numbers{static_cast<double>(spindle), static_cast<double>(table),
                              static_cast<double>(before), square ? 1.0 : 0.0};
  const auto add = [&numbers](const auto& matrix) {
    numbers.insert(numbers.end(), matrix.data(), matrix.data() + matrix.size());
  };
  for (const std::vector<int>* joints : {&linear, &rotary}) {
    numbers.push_back(static_cast<double>(joints->size()));
    numbers.insert(numbers.end(), joints->begin(), joints->end());
  }
  for (const RotaryAxis& axis : axes) {
    add(axis.direction);
    add(axis.point);
  }
  add(directions);
  add(inverse);
  add(gain);
  add(X.matrix());
  return numbers;
}

}  // namespace ncsim::kinematics
