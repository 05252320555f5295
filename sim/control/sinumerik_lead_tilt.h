// SPDX-License-Identifier: BSD-3-Clause
// LEAD and TILT: the tool leaned against the surface along its path (NC programming 12/2019,
// "Programming the tool orientation with LEAD and TILT"; MD21094 ORIPATH_MODE). Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ncsim::control {

/// The tens digit of MD21094: what turns first, and about what.
enum class LeanOrder {
  kLeadThenTiltAboutNormal = 0,
  kLeadThenTiltAboutTangent = 1,
  kLeadThenTiltAboutTurnedTangent = 2,
  kTiltThenLeadAboutFirstSide = 3,
  kTiltThenLeadAboutTurnedSide = 4
};

/// Unit vector from tip to holder; angles in rad, `normal` and `tangent` of any length. LEAD turns
/// about normal x tangent: a positive one leans the tool the way it goes (MD21094: the forward
/// angle). nullopt: normal and tangent span no plane.
std::optional<Eigen::Vector3d> LeanedAxis(const Eigen::Vector3d& normal,
                                          const Eigen::Vector3d& tangent, double lead, double tilt,
                                          LeanOrder order);

}  // namespace ncsim::control
