// SPDX-License-Identifier: BSD-3-Clause
#include "post/part_geometry.h"

#include <algorithm>
#include <cmath>

#include "kinematics/great_circle.h"

namespace ncsim::post {
namespace {

constexpr double kPole = 1e-8;          // rad
constexpr double kLimit = 1e-9;         // rad: how exactly limits hold
constexpr double kBranch = 1e-4;        // rad of tilt: nearer branches are at the pole
constexpr double kBesidePole = 0.0175;  // rad

bool Within(const Rotary& rotary, const kinematics::RotaryLimits& limits) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (rotary[k] < limits.lower[k] - kLimit || rotary[k] > limits.upper[k] + kLimit) return false;
  }
  return true;
}

}  // namespace

PartGeometry::PartGeometry(const machine::Machine& machine, const Eigen::Isometry3d& X_BP,
                           double increment, double length)
    : machine_(&machine),
      five_axis_(&*machine.five_axis),
      X_BP_(X_BP),
      increment_(increment),
      length_(length) {
  for (std::size_t i = 0; i < 3; ++i) xyz_joints_[i] = machine.FindAxis("XYZ"[i])->joint;
  for (std::size_t k = 0; k < num_rotary(); ++k) {
    for (const machine::Axis& axis : machine.axes) {
      if (axis.joint != five_axis_->rotary()[k]) continue;
      letters_[k] = axis.letter;
      limits_.lower[k] = axis.lower;
      limits_.upper[k] = axis.upper;
    }
  }
  zero_ = Linear(X_BP_.translation(), Rotary{});
}

Rotary PartGeometry::OnGrid(const Rotary& rotary) const {
  return {std::round(rotary[0] / increment_) * increment_,
          std::round(rotary[1] / increment_) * increment_};
}

std::vector<Rotary> PartGeometry::ReachWithin(const Eigen::Vector3d& axis_P, const Rotary& from,
                                              const kinematics::RotaryLimits& limits) const {
  std::vector<Rotary> found;
  const Eigen::Vector3d u_B = X_BP_.linear() * axis_P;
  for (const auto& solution : kinematics::ReachableRotary(*five_axis_, u_B, from, limits)) {
    Rotary rotary = solution.angles;
    bool within = true;
    for (std::size_t k = 0; k < num_rotary(); ++k) {
      rotary[k] = std::round(rotary[k] / increment_) * increment_;
      within =
          within && rotary[k] >= limits.lower[k] - kLimit && rotary[k] <= limits.upper[k] + kLimit;
    }
    if (within) found.push_back(rotary);
  }
  return found;
}

std::vector<Rotary> PartGeometry::Reach(const Eigen::Vector3d& axis_P, const Rotary& from) const {
  return ReachWithin(axis_P, from, limits_);
}

std::vector<Rotary> PartGeometry::ReachAnywhere(const Eigen::Vector3d& axis_P,
                                                const Rotary& from) const {
  return ReachWithin(axis_P, from, {});
}

std::optional<PartGeometry::Way> PartGeometry::Follow(const Eigen::Vector3d& axis_P,
                                                      const Rotary& from,
                                                      double pole_tolerance) const {
  using kinematics::GreatCircle;
  for (const Rotary& to : ReachAnywhere(axis_P, from)) {
    GreatCircle circle;
    switch (GreatCircle::Make(*five_axis_, from, to, &circle)) {
      case GreatCircle::Fault::kNone: {
        const auto range = circle.RotaryOver(0.0, 1.0);
        const Rotary lower{range[0].lower, range[1].lower}, upper{range[0].upper, range[1].upper};
        const Way way{OnGrid(circle.start()), OnGrid(circle.end())};
        if (Within(lower, limits_) && Within(upper, limits_) && Within(way.end, limits_))
          return way;
        return std::nullopt;
      }
      case GreatCircle::Fault::kOtherBranch:
        if (kinematics::AngleFromPole(*five_axis_, from, to) > pole_tolerance) break;
        [[fallthrough]];
      case GreatCircle::Fault::kNoTurn:
      case GreatCircle::Fault::kThroughPole:
      case GreatCircle::Fault::kNotTwoAxes:
        if (Within(to, limits_)) return Way{from, to};
        break;
      case GreatCircle::Fault::kOpposite:
      case GreatCircle::Fault::kUnreachable:
        break;
    }
  }
  return std::nullopt;
}

std::optional<Rotary> PartGeometry::Between(const Eigen::Vector3d& axis_P, const Rotary& a,
                                            const Rotary& b, double pole_tolerance) const {
  const Rotary half{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  const std::optional<Rotary> beside = BesidePole(axis_P, half[1]);
  if (beside && Within(*beside, limits_) &&
      AngleBetween(ToolAxis(*beside), axis_P) <= pole_tolerance) {
    return beside;
  }
  const std::vector<Rotary> reach = Reach(axis_P, half);
  if (reach.empty()) return std::nullopt;
  // They are on the same side of the pole, and that is told by the tilt.
  const auto best =
      std::min_element(reach.begin(), reach.end(), [&](const Rotary& x, const Rotary& y) {
        const double tilt_x = std::abs(x[0] - half[0]), tilt_y = std::abs(y[0] - half[0]);
        if (std::abs(tilt_x - tilt_y) > kBranch) return tilt_x < tilt_y;
        return std::abs(x[1] - half[1]) < std::abs(y[1] - half[1]);
      });
  return *best;
}

bool PartGeometry::AtPole(const Eigen::Vector3d& axis_P) const {
  if (num_rotary() < 2) return false;
  const Eigen::Vector3d u_B = X_BP_.linear() * axis_P;
  return u_B.cross(five_axis_->rotary_direction(1)).norm() < kPole;
}

bool PartGeometry::OnCircle(const Rotary& a, const Rotary& b, double pole_limit) const {
  kinematics::GreatCircle circle;
  return kinematics::GreatCircle::Make(*five_axis_, a, b, &circle) ==
             kinematics::GreatCircle::Fault::kNone &&
         kinematics::AngleFromPole(*five_axis_, a, b) > pole_limit;
}

std::optional<Eigen::Vector3d> PartGeometry::Pole(const Eigen::Vector3d& axis_P) const {
  if (num_rotary() < 2) return std::nullopt;
  const Eigen::Vector3d pole = X_BP_.linear().transpose() * five_axis_->rotary_direction(1);
  return pole.dot(axis_P) < 0.0 ? Eigen::Vector3d(-pole) : pole;
}

std::optional<Rotary> PartGeometry::BesidePole(const Eigen::Vector3d& axis_P, double second) const {
  const std::optional<Eigen::Vector3d> pole = Pole(axis_P);
  if (!pole || AngleBetween(*pole, axis_P) > kBesidePole) return std::nullopt;
  const std::vector<Rotary> at_pole = ReachAnywhere(*pole, {0.0, second});
  if (at_pole.empty()) return std::nullopt;
  const double first = at_pole.front()[0];
  // The tool axis leaves the pole along `way`, a radian each.
  const Eigen::Vector3d way =
      (ToolAxis({first + kBesidePole, second}) - ToolAxis({first - kBesidePole, second})) /
      (2.0 * std::sin(kBesidePole));
  return OnGrid({first + way.dot(axis_P) / way.squaredNorm(), second});
}

kinematics::JointVector PartGeometry::Joints(const Rotary& rotary) const {
  kinematics::JointVector q = kinematics::JointVector::Zero(machine_->tree.num_moving());
  for (std::size_t k = 0; k < num_rotary(); ++k) q[five_axis_->rotary()[k]] = rotary[k];
  return q;
}

Eigen::Vector3d PartGeometry::ToolAxis(const Rotary& rotary) const {
  Eigen::Vector3d tip, axis;
  five_axis_->TipInTable(Joints(rotary), length_, &tip, &axis);
  return X_BP_.linear().transpose() * axis;
}

Eigen::Vector3d PartGeometry::Linear(const Eigen::Vector3d& p_B, const Rotary& rotary) const {
  kinematics::JointVector q = Joints(rotary);
  five_axis_->SolveLinear(p_B, length_, &q);
  return {q[xyz_joints_[0]], q[xyz_joints_[1]], q[xyz_joints_[2]]};
}

Eigen::Vector3d PartGeometry::Xyz(PlanMode mode, const Eigen::Matrix3d* plane_P,
                                  const Eigen::Vector3d& tip_P, const Rotary& rotary) const {
  if (mode == PlanMode::kTcp) return tip_P;
  if (mode == PlanMode::kAxes) return Linear(X_BP_ * tip_P, rotary) - zero_;
  if (plane_P != nullptr) return plane_P->transpose() * tip_P;
  return Linear(X_BP_ * tip_P, rotary) - Linear(X_BP_.translation(), rotary);
}

Eigen::Matrix3d PartGeometry::Directions(PlanMode mode, const Eigen::Matrix3d* plane_P,
                                         const Rotary& rotary) const {
  const Eigen::Vector3d zero = Xyz(mode, plane_P, Eigen::Vector3d::Zero(), rotary);
  Eigen::Matrix3d directions;
  for (int i = 0; i < 3; ++i) {
    directions.col(i) = Xyz(mode, plane_P, Eigen::Vector3d::Unit(i), rotary) - zero;
  }
  return directions;
}

std::optional<PartGeometry::Slow> PartGeometry::TooSlow(const PlanPose& a, const PlanPose& b,
                                                        double time) const {
  std::optional<Slow> slowest;
  for (const machine::Axis& axis : machine_->axes) {
    double way = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (axis.letter == "XYZ"[i]) way = std::abs(b.xyz[at] - a.xyz[at]);
    }
    for (std::size_t k = 0; k < num_rotary(); ++k) {
      if (axis.letter == letters_[k]) way = std::abs(b.rotary[k] - a.rotary[k]);
    }
    if (!(axis.rapid > 0.0) || way <= time * axis.rapid) continue;
    if (!slowest || way / axis.rapid > slowest->time) slowest = {axis.letter, way / axis.rapid};
  }
  return slowest;
}

Eigen::Vector3d PartGeometry::TipOfAxes(const Eigen::Vector3d& xyz, const Rotary& rotary) const {
  kinematics::JointVector q = Joints(rotary);
  for (int i = 0; i < 3; ++i) q[xyz_joints_[static_cast<std::size_t>(i)]] = xyz[i] + zero_[i];
  Eigen::Vector3d tip, axis;
  five_axis_->TipInTable(q, length_, &tip, &axis);
  return X_BP_.inverse() * tip;
}

}  // namespace ncsim::post
