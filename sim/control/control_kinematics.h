// SPDX-License-Identifier: BSD-3-Clause
// What a control believes about its machine: the model's kinematics about the rotary centre that
// its settings state. Neutral of dialect; the metal moves by the model.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "kinematics/five_axis.h"
#include "kinematics/reachable.h"
#include "sim/machine/machine.h"

namespace ncsim::control {

struct ControlKinematics {
  std::optional<kinematics::FiveAxis> five_axis;  ///< Absent where the model has none.
  double centre_error = 0.0;  ///< mm: distance of the believed centre from the metal's.
};

/// `stated_centre`: what the control's settings say (machine values, mm); absent = as the model.
ControlKinematics MakeControlKinematics(const machine::Machine& machine,
                                        const std::optional<Eigen::Vector3d>& stated_centre);

/// Where the machine's limits let the rotary axes stand.
kinematics::RotaryLimits RotaryLimitsOf(const machine::Machine& machine,
                                        const kinematics::FiveAxis& five_axis);

}  // namespace ncsim::control
