// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/tilt_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ncsim::kinematics {
namespace {

/// rad: directions that differ by less are the same.
constexpr double kSameDirection = 1e-10;

}  // namespace

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double AngleAbout(const Eigen::Vector3d& axis, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = axis.cross(from);
  const Eigen::Vector3d b = axis.cross(to);
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

bool Along(const Eigen::Vector3d& axis, const Eigen::Vector3d& v) {
  return axis.cross(v).norm() < kSameDirection;
}

TiltTriangle::TiltTriangle(const Eigen::Vector3d& tilt, const Eigen::Vector3d& other,
                           const Eigen::Vector3d& tool)
    : phi_other_(Angle(tilt, other)), phi_tool_(Angle(tilt, tool)) {
  nearest_ = std::abs(phi_other_ - phi_tool_);
  const double sum = phi_other_ + phi_tool_;
  farthest_ = std::min(sum, 2.0 * std::numbers::pi - sum);
  at_nearest_ = AngleAbout(tilt, tool, other);
}

double TiltTriangle::TurnTo(double alpha) const {
  const double sum = phi_other_ + phi_tool_;
  const double numerator =
      std::max(0.0, std::sin(0.5 * (alpha + nearest_)) * std::sin(0.5 * (alpha - nearest_)));
  const double denominator =
      std::max(0.0, std::sin(0.5 * (sum + alpha)) * std::sin(0.5 * (sum - alpha)));
  return 2.0 * std::atan2(std::sqrt(numerator), std::sqrt(denominator));
}

double TiltTriangle::Azimuth(double turn) const {
  const double half_sum = 0.5 * (phi_tool_ + phi_other_);
  const double half_difference = 0.5 * (phi_tool_ - phi_other_);
  const double c = std::cos(0.5 * turn);
  const double s = std::sin(0.5 * turn);
  return std::atan2(std::cos(half_difference) * c, std::cos(half_sum) * s) +
         std::atan2(std::sin(half_difference) * c, std::sin(half_sum) * s);
}

// There the great circle from `other` touches the tool's cone: a right angle at the tool.
double TiltTriangle::TurnOfExtremeAzimuth() const {
  const double numerator = std::sin(phi_tool_) * std::cos(phi_other_);
  const double denominator = std::cos(phi_tool_) * std::sin(phi_other_);
  if (std::abs(numerator) >= std::abs(denominator)) return 0.0;
  return std::acos(numerator / denominator);
}

}  // namespace ncsim::kinematics
