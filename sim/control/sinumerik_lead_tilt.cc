// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_lead_tilt.h"

#include <Eigen/Geometry>

namespace ncsim::control {
namespace {

// Sine of an angle below which two directions are one.
constexpr double kParallel = 1e-6;

Eigen::Vector3d Turned(const Eigen::Vector3d& v, const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis) * v;
}

}  // namespace

std::optional<Eigen::Vector3d> LeanedAxis(const Eigen::Vector3d& normal,
                                          const Eigen::Vector3d& tangent, double lead, double tilt,
                                          LeanOrder order) {
  const Eigen::Vector3d n = normal.normalized(), t = tangent.normalized();
  const Eigen::Vector3d across = n.cross(t);  // Not a number for one of length 0.
  if (!(across.norm() > kParallel)) return std::nullopt;
  const Eigen::Vector3d side = across.normalized();
  const Eigen::Vector3d led = Turned(n, side, lead), tilted = Turned(n, t, tilt);
  switch (order) {
    case LeanOrder::kLeadThenTiltAboutNormal:
      return Turned(led, n, tilt);
    case LeanOrder::kLeadThenTiltAboutTangent:
      return Turned(led, t, tilt);
    case LeanOrder::kLeadThenTiltAboutTurnedTangent:
      return Turned(led, Turned(t, side, lead), tilt);
    case LeanOrder::kTiltThenLeadAboutFirstSide:
      return Turned(tilted, side, lead);
    case LeanOrder::kTiltThenLeadAboutTurnedSide:
      return Turned(tilted, tilted.cross(t).normalized(), lead);
  }
  return std::nullopt;
}

}  // namespace ncsim::control
