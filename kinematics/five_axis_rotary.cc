// SPDX-License-Identifier: BSD-3-Clause
// FiveAxis::SolveRotary: which rotary positions turn the tool axis to a direction.
#include <cmath>
#include <numbers>

#include "kinematics/chain.h"
#include "kinematics/five_axis.h"
#include "kinematics/tilt_triangle.h"

namespace ncsim::kinematics {
namespace {

/// rad: a tilt this near to the edge of its reach has one solution.
constexpr double kOneSolution = 1e-10;
/// rad: how far beyond its reach a tool axis may lie and still be taken to the edge (rounded NC
/// words are normalised).
constexpr double kReach = 1e-9;

/// To (-pi, pi].
double Fold(double angle) {
  const double folded = std::remainder(angle, 2.0 * std::numbers::pi);
  return folded <= -std::numbers::pi ? std::numbers::pi : folded;
}

/// Angles about `tilt` that turn `tool` to the angle `alpha` from `other`. None, one or two.
std::vector<double> TiltAngles(const Eigen::Vector3d& tilt, const Eigen::Vector3d& other,
                               const Eigen::Vector3d& tool, double alpha) {
  const TiltTriangle triangle(tilt, other, tool);
  if (alpha < triangle.nearest() - kReach || alpha > triangle.farthest() + kReach) return {};
  const double turn = triangle.TurnTo(alpha);
  if (turn < kOneSolution || turn > std::numbers::pi - kOneSolution) {
    return {Fold(triangle.at_nearest() + turn)};
  }
  return {Fold(triangle.at_nearest() + turn), Fold(triangle.at_nearest() - turn)};
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
