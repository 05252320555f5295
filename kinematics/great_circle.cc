// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/great_circle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinematics/chain.h"

namespace ncsim::kinematics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn = 2.0 * kPi;
/// rad.
constexpr double kLeastAngle = 1e-9;
/// rad: a circle that comes this near to the pole leads through it.
constexpr double kMeridian = 1e-12;
/// rad: beyond its reach by less, the machine stays at the edge (as SolveRotary).
constexpr double kCircleReach = 1e-9;
/// rad: what a joint's stated end may differ from the closed solution. At the edge of the reach the
/// tilt is known to the root of the rounding only.
constexpr double kSameEnd = 1e-7;
constexpr double kRounding = 1e-12;
/// rad: of Alpha(). At the edge of the reach it comes to 1e-7 of the tilt.
constexpr double kAlphaRounding = 2e-15;

/// The tool axis at the rotary joints' positions, in B.
Eigen::Vector3d ToolAxisAt(const FiveAxis& five_axis, const std::array<double, 2>& joints) {
  return Turn(five_axis.rotary_direction(1), joints[1],
              Turn(five_axis.rotary_direction(0), joints[0], five_axis.tool_axis()))
      .normalized();
}

/// A multiple of `period`, counted from `first`, lies strictly between a < b, by more than
/// `margin`.
bool Between(double first, double period, double a, double b, double margin) {
  const double next = first + period * std::floor((a + margin - first) / period + 1.0);
  return next < b - margin;
}

}  // namespace

GreatCircle::Fault GreatCircle::Make(const FiveAxis& five_axis, const std::array<double, 2>& from,
                                     const std::array<double, 2>& to, GreatCircle* circle) {
  if (five_axis.rotary().size() != 2) return Fault::kNotTwoAxes;
  const Eigen::Vector3d tool = five_axis.tool_axis();
  const Eigen::Vector3d& tilt = five_axis.rotary_direction(0);
  const Eigen::Vector3d& other = five_axis.rotary_direction(1);
  if (Along(tilt, tool) || Along(tilt, other)) return Fault::kNotTwoAxes;
  const Eigen::Vector3d u0 = ToolAxisAt(five_axis, from);
  const Eigen::Vector3d u1 = ToolAxisAt(five_axis, to);
  const double angle = Angle(u0, u1);
  if (angle < kLeastAngle) return Fault::kNoTurn;
  if (angle > kPi - kLeastAngle) return Fault::kOpposite;
  circle->triangle_ = TiltTriangle(tilt, other, tool);
  circle->Place(other, u0, u1);
  if (circle->PassesPole()) return Fault::kThroughPole;
  const Range alpha = circle->AlphaOver(circle->psi0_, circle->psi0_ + circle->angle_);
  if (alpha.lower < circle->triangle_.nearest() - kCircleReach ||
      alpha.upper > circle->triangle_.farthest() + kCircleReach) {
    return Fault::kUnreachable;
  }
  return circle->Anchor(from, to);
}

void GreatCircle::Place(const Eigen::Vector3d& other, Eigen::Vector3d u0, Eigen::Vector3d u1) {
  const bool at_pole = Along(other, u0) || Along(other, u1);
  if (Along(other, u0)) u0 = std::copysign(1.0, other.dot(u0)) * other;
  if (Along(other, u1)) u1 = std::copysign(1.0, other.dot(u1)) * other;
  angle_ = Angle(u0, u1);
  Eigen::Vector3d normal = u0.cross(u1).normalized();
  if (at_pole) normal = (normal - other * other.dot(normal)).normalized();
  const Eigen::Vector3d nearest = other - normal * normal.dot(other);
  sin_alpha0_ = at_pole ? 0.0 : std::abs(normal.dot(other));
  cos_alpha0_ = nearest.norm();
  meridian_ = sin_alpha0_ < kMeridian;
  sense_ = std::copysign(1.0, normal.dot(other));
  nearest_B_ = cos_alpha0_ < kMeridian ? u0 : Eigen::Vector3d(nearest / cos_alpha0_);
  ahead_B_ = normal.cross(nearest_B_);
  psi0_ = std::atan2(u0.dot(ahead_B_), u0.dot(nearest_B_));
  if (at_pole && Along(other, u0)) psi0_ = other.dot(u0) > 0.0 ? 0.0 : -kPi;
  if (at_pole && Along(other, u1)) psi0_ = (other.dot(u1) > 0.0 ? 0.0 : kPi) - angle_;
}

bool GreatCircle::PassesPole() const {
  return meridian_ && Between(0.0, kPi, psi0_, psi0_ + angle_, kMeridian);
}

double GreatCircle::Alpha(double psi) const {
  return std::atan2(std::hypot(std::sin(psi), std::cos(psi) * sin_alpha0_),
                    std::cos(psi) * cos_alpha0_);
}

/// Continuous over whole turns of psi.
double GreatCircle::Azimuth(double psi) const {
  if (meridian_) psi = psi0_ + 0.5 * angle_;
  const double within = std::remainder(psi, kTurn);
  const double sine = meridian_ ? 0.0 : sin_alpha0_;
  return sense_ * (std::atan2(std::sin(within), std::cos(within) * sine) + (psi - within));
}

/// Alpha grows with the distance of psi from 0, up to half a turn.
GreatCircle::Range GreatCircle::AlphaOver(double psi0, double psi1) const {
  Range range;
  const auto [least, most] = std::minmax({Alpha(psi0), Alpha(psi1)});
  range.lower = Between(0.0, kTurn, psi0, psi1, 0.0) ? Alpha(0.0) : least;
  range.upper = Between(kPi, kTurn, psi0, psi1, 0.0) ? Alpha(kPi) : most;
  return range;
}

std::array<double, 2> GreatCircle::Joints(double psi) const {
  const double turn = triangle_.TurnTo(Alpha(psi));
  return {Tilt(turn), Other(Azimuth(psi), turn)};
}

/// Hangs the closed solution on the end that is farther from the pole.
GreatCircle::Fault GreatCircle::Anchor(const std::array<double, 2>& from,
                                       const std::array<double, 2>& to) {
  const double psi1 = psi0_ + angle_;
  const bool first = std::sin(Alpha(psi0_)) >= std::sin(Alpha(psi1));
  const std::array<double, 2>& anchor = first ? from : to;
  const double psi = first ? psi0_ : psi1;
  const double turn = triangle_.TurnTo(Alpha(psi));
  tilt_at_nearest_ = triangle_.at_nearest();
  branch_ = std::sin(anchor[0] - tilt_at_nearest_) < 0.0 ? -1.0 : 1.0;
  if (std::sin(turn) < kSameEnd) {  // at the edge of its reach: the other end says which branch
    const double there = (first ? to : from)[0] - tilt_at_nearest_;
    branch_ = std::sin(there) < 0.0 ? -1.0 : 1.0;
  }
  other_offset_ = 0.0;
  other_offset_ = anchor[1] - Joints(psi)[1];
  start_ = Joints(psi0_);
  tilt_at_nearest_ += kTurn * std::round((from[0] - start_[0]) / kTurn);
  other_offset_ += kTurn * std::round((from[1] - start_[1]) / kTurn);
  start_ = Joints(psi0_);
  end_ = Joints(psi1);

  slack_ = kRounding;
  const auto settle = [&](double stated, double* found) {
    const double whole = kTurn * std::round((*found - stated) / kTurn);
    const double off = std::abs(*found - stated - whole);
    if (off > kSameEnd) return false;
    slack_ = std::max(slack_, kRounding + off);
    *found = stated + whole;
    return true;
  };
  const auto at_pole = [&](double way) { return meridian_ && std::sin(Alpha(way)) < kMeridian; };
  // At the pole the second joint is where the circle has it, to the bit of what is stated.
  const bool fits = settle(from[0], &start_[0]) && settle(to[0], &end_[0]) &&
                    (settle(from[1], &start_[1]) || at_pole(psi0_)) &&
                    (settle(to[1], &end_[1]) || at_pole(psi1));
  return fits ? Fault::kNone : Fault::kOtherBranch;
}

Eigen::Vector3d GreatCircle::AxisAt(double s) const {
  const double psi = psi0_ + s * angle_;
  return std::cos(psi) * nearest_B_ + std::sin(psi) * ahead_B_;
}

std::array<double, 2> GreatCircle::RotaryAt(double s) const {
  if (s <= 0.0) return start_;
  if (s >= 1.0) return end_;
  return Joints(psi0_ + s * angle_);
}

std::array<GreatCircle::Range, 2> GreatCircle::RotaryOver(double s0, double s1) const {
  const double psi0 = psi0_ + std::max(0.0, s0) * angle_;
  const double psi1 = psi0_ + std::min(1.0, s1) * angle_;
  const Range alpha = AlphaOver(psi0, psi1);
  const double turn0 = triangle_.TurnTo(std::max(0.0, alpha.lower - kAlphaRounding));
  const double turn1 = triangle_.TurnTo(std::min(kPi, alpha.upper + kAlphaRounding));
  const auto [azimuth0, azimuth1] = std::minmax({Azimuth(psi0), Azimuth(psi1)});
  auto [tool0, tool1] = std::minmax({triangle_.Azimuth(turn0), triangle_.Azimuth(turn1)});
  const double extreme = triangle_.TurnOfExtremeAzimuth();
  if (extreme > turn0 && extreme < turn1) {
    tool0 = std::min(tool0, triangle_.Azimuth(extreme));
    tool1 = std::max(tool1, triangle_.Azimuth(extreme));
  }
  if (branch_ < 0.0) std::swap(tool0, tool1);
  const auto [tilt0, tilt1] = std::minmax({Tilt(turn0), Tilt(turn1)});
  std::array<Range, 2> ranges;
  ranges[0] = {tilt0 - slack_, tilt1 + slack_};
  ranges[1] = {other_offset_ + azimuth0 + branch_ * tool0 - slack_,
               other_offset_ + azimuth1 + branch_ * tool1 + slack_};
  return ranges;
}

double AngleFromPole(const FiveAxis& five_axis, const std::array<double, 2>& from,
                     const std::array<double, 2>& to) {
  if (five_axis.rotary().size() != 2) return kPi;
  const Eigen::Vector3d& pole = five_axis.rotary_direction(1);
  const Eigen::Vector3d u0 = ToolAxisAt(five_axis, from);
  const Eigen::Vector3d u1 = ToolAxisAt(five_axis, to);
  double least = kPi;
  for (const Eigen::Vector3d& u : {u0, u1}) {
    least = std::min({least, Angle(u, pole), Angle(u, Eigen::Vector3d(-pole))});
  }
  const Eigen::Vector3d normal = u0.cross(u1);
  if (normal.norm() < kLeastAngle) return least;
  for (const double sign : {1.0, -1.0}) {
    // The circle's point nearest to this pole, if it lies on the arc.
    const Eigen::Vector3d nearest = normal.cross(Eigen::Vector3d(sign * pole)).cross(normal);
    const bool on_arc =
        normal.dot(u0.cross(nearest)) >= 0.0 && normal.dot(nearest.cross(u1)) >= 0.0;
    if (on_arc) least = std::min(least, std::abs(std::asin(normal.normalized().dot(pole))));
  }
  return least;
}

}  // namespace ncsim::kinematics
