// SPDX-License-Identifier: BSD-3-Clause
// FiveAxis::SolveRotary: which rotary positions turn the tool axis to a direction.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinematics/chain.h"
#include "kinematics/five_axis.h"

namespace ncsim::kinematics {
namespace {

/// rad: directions that differ by less are the same.
constexpr double kSameDirection = 1e-10;
/// rad: how far beyond its reach a tool axis may lie and still be taken to the edge (rounded NC
/// words are normalised).
constexpr double kReach = 1e-9;

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// To (-pi, pi].
double Fold(double angle) {
  const double folded = std::remainder(angle, 2.0 * std::numbers::pi);
  return folded <= -std::numbers::pi ? std::numbers::pi : folded;
}

/// Paden-Kahan subproblem 1: the angle about `axis` that turns `from` to `to`, which make the same
/// angle with it. By cross products, because near the pole the dot products cancel.
double AngleAbout(const Eigen::Vector3d& axis, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = axis.cross(from);
  const Eigen::Vector3d b = axis.cross(to);
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

/// True when `axis` is parallel to `v`, either way.
bool Along(const Eigen::Vector3d& axis, const Eigen::Vector3d& v) {
  return axis.cross(v).norm() < kSameDirection;
}

/// Angles about `tilt` that turn `tool` to the angle `alpha` from `other`: the sides of a spherical
/// triangle are Angle(tilt, tool), Angle(tilt, other) and alpha. By half angles, which stay exact
/// near the pole. None, one or two.
std::vector<double> TiltAngles(const Eigen::Vector3d& tilt, const Eigen::Vector3d& other,
                               const Eigen::Vector3d& tool, double alpha) {
  const double phi_other = Angle(tilt, other);
  const double phi_tool = Angle(tilt, tool);
  const double nearest = std::abs(phi_other - phi_tool);
  const double sum = phi_other + phi_tool;
  const double farthest = std::min(sum, 2.0 * std::numbers::pi - sum);
  if (alpha < nearest - kReach || alpha > farthest + kReach) return {};

  const double at_nearest = AngleAbout(tilt, tool, other);  // puts the tool nearest to `other`
  const double numerator =
      std::max(0.0, std::sin(0.5 * (alpha + nearest)) * std::sin(0.5 * (alpha - nearest)));
  const double denominator =
      std::max(0.0, std::sin(0.5 * (sum + alpha)) * std::sin(0.5 * (sum - alpha)));
  const double turn = 2.0 * std::atan2(std::sqrt(numerator), std::sqrt(denominator));
  if (turn < kSameDirection || turn > std::numbers::pi - kSameDirection) {
    return {Fold(at_nearest + turn)};
  }
  return {Fold(at_nearest + turn), Fold(at_nearest - turn)};
}

}  // namespace

/// The joint `k` alone, the other one (if any) at 0 and free.
std::vector<RotarySolution> FiveAxis::SolveOneRotary(std::size_t k,
                                                     const Eigen::Vector3d& u_B) const {
  const Eigen::Vector3d tool = -X_BS0_.linear().col(2);
  const Eigen::Vector3d& axis = axes_[k].direction;
  if (std::abs(Angle(axis, u_B) - Angle(axis, tool)) > kReach) return {};
  RotarySolution solution;
  solution.at_pole = rotary_.size() == 2 || Along(axis, tool);
  if (!Along(axis, tool)) solution.angles[k] = Fold(AngleAbout(axis, tool, u_B));
  return {solution};
}

std::vector<RotarySolution> FiveAxis::SolveRotary(const Eigen::Vector3d& u_B) const {
  const Eigen::Vector3d tool = -X_BS0_.linear().col(2);
  if (rotary_.empty()) {
    if (Angle(tool, u_B) > kReach) return {};
    return {RotarySolution{}};
  }
  if (rotary_.size() == 1) return SolveOneRotary(0, u_B);
  const Eigen::Vector3d& tilt = axes_[0].direction;
  const Eigen::Vector3d& other = axes_[1].direction;
  if (Along(tilt, tool)) return SolveOneRotary(1, u_B);   // the first turns the tool about itself
  if (Along(tilt, other)) return SolveOneRotary(0, u_B);  // one joint would do

  std::vector<RotarySolution> solutions;
  for (const double angle : TiltAngles(tilt, other, tool, Angle(other, u_B))) {
    const Eigen::Vector3d tilted = Turn(tilt, angle, tool);
    RotarySolution solution;
    solution.angles[0] = angle;
    solution.at_pole = Along(other, u_B);
    if (!solution.at_pole) solution.angles[1] = Fold(AngleAbout(other, tilted, u_B));
    solutions.push_back(solution);
  }
  return solutions;
}

}  // namespace ncsim::kinematics
