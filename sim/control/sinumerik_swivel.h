// SPDX-License-Identifier: BSD-3-Clause
// CYCLE800 without the machine: which plane its parameters describe, and which of two ways to stand
// on it they ask for (NC programming 12/2019, "Programming cycles externally"; Operating Manual
// Milling, "Swiveling a plane/tool"). Pure.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/five_axis.h"
#include "sim/control/sinumerik_cycle_arguments.h"
#include "sim/control/sinumerik_drilling.h"

namespace ncsim::control {

/// Coordinates q in the plane are origin + rotation q in those before it; mm.
struct SwivelPlane {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  SwivelPlane Then(const SwivelPlane& next) const {
    return {rotation * next.rotation, origin + rotation * next.origin};
  }
};

/// X0 Y0 Z0, the turn, X1 Y1 Z1.
SwivelPlane ShiftedPlane(const SinumerikCycleArguments& arguments, const Eigen::Matrix3d& rotation);

/// The turn of _MODE, _A, _B, _C: axis by axis (bits 7, 6 = 00; bits 1 and 0, 3 and 2, 5 and 4 say
/// about which axis _A, _B and _C turn, 1 X, 2 Y, 3 Z, each about the axis as the ones before have
/// left it), by solid angles (01; about Z, then Y) or by projection angles (10) about X and Y, in
/// either order, then about the plane's Z. nullopt: `unsupported` says why.
std::optional<Eigen::Matrix3d> SwivelRotation(const SinumerikCycleArguments& arguments,
                                              std::string* unsupported);
/// _MODE bits 7, 6 = 11: _A and _B are positions of the two rotary axes.
bool IsDirectSwivel(const SinumerikCycleArguments& arguments);
bool IsAxisByAxisSwivel(const SinumerikCycleArguments& arguments);

/// The one of two solutions that _DIR means: with 1 the greater, with -1 the smaller angle of the
/// reference axis (0 or 1, in FiveAxis::rotary() order); the only one, whatever _DIR says. Angles
/// of an endless axis are compared within 0 to 360 deg.
const kinematics::RotarySolution& ChooseSwivel(
    const std::vector<kinematics::RotarySolution>& solutions, long direction, int reference,
    bool endless);

/// nullopt, or which parameter asks for what is not simulated.
std::optional<std::string> UnsupportedSwivel(const SinumerikCycleArguments& arguments, Plane plane);

}  // namespace ncsim::control
