// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sim/machine/machine.h"

namespace ncsim::machine {

/// Machine values X, Y, Z (mm) that put the gauge line on the table's pivot, all rotary axes at 0:
/// on the tilt axis (the rotary nearer the base) at the place along it where the other rotary axis
/// passes. For B and C: X and Z of the B axis, Y of the C axis, as Haas defines settings 255-257
/// (NGC Mill Operator's Manual 2017, settings 255-257). nullopt where not both rotary axes carry
/// the table, or an axis letter is missing.
std::optional<Eigen::Vector3d> RotaryCentre(const Machine& machine);

}  // namespace ncsim::machine
