// SPDX-License-Identifier: BSD-3-Clause
// Frames of the SINUMERIK as the interpreter uses them and as programs see them (NC programming
// 12/2019, "Frame variables"; MD10600 = 1). mm, rad.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "sim/control/command.h"
#include "sim/nc/sinumerik_value.h"

namespace ncsim::control {

/// The rotation of ROT X Y Z and of frames, angles in rad: about Z, the new Y, the new X (MD10600 =
/// 1). With one angle there is no order.
Eigen::Matrix3d SinumerikRotation(const std::array<double, 3>& angles);

/// The rotation of ROTS and of CYCLE800 by projection angles: angles (rad) about X, Y, Z, of which
/// two are `given`. Each turns the other of the two axes into the line in which the oblique plane
/// cuts that axis' plane with the third; the first of the two (in the order of G17, G18, G19) then
/// lies in that line (K2 08/2005, p. 2-101). nullopt: not two, or one of 90 degrees or more.
std::optional<Eigen::Matrix3d> SolidAngleRotation(const std::array<double, 3>& angles,
                                                  const std::array<bool, 3>& given);

/// A settable frame: an axis is shifted (coarse and fine), then turned, scaled, mirrored.
struct SettableFrame {
  AxisValues coarse{};
  AxisValues fine{};
  std::array<double, 3> turn{};  ///< rad, about X, Y, Z.
  std::array<double, 3> scale{1.0, 1.0, 1.0};
  std::array<bool, 3> mirror{};
  bool stated = true;  ///< False: the shift is assumed.

  AxisValues shift() const;
  /// Rotation, scaling and mirroring.
  Eigen::Matrix3d Linear() const;
};

/// Any chain of frames: X, Y, Z by an affine frame, rotary axes by a shift.
struct AffineFrame {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  std::array<double, 3> rotary{};
  AxisValues fine{};  ///< How much of `shift` and `rotary` ATRANS and G59 have made (MD24000).
  bool is_zero() const;
};

AffineFrame ToAffine(const SettableFrame& frame);
/// `inner` seen through `outer`: outer : inner.
AffineFrame Chained(const AffineFrame& outer, const AffineFrame& inner);
/// nullopt: the axes are not square to each other any more, or lie mirrored, so that no angles and
/// factors say which.
std::optional<SettableFrame> ToSettable(const AffineFrame& frame);

/// As programs see it: deg, and lengths in units of `unit` mm.
nc::SinumerikFrame ToValue(const SettableFrame& frame, double unit);
/// nullopt: a factor that is not above 0. Axes of other names than X Y Z A B C are left out.
std::optional<AffineFrame> ToAffine(const nc::SinumerikValue& frame, double unit);
/// One part alone as it is, a chain as what it comes to; nullopt as ToSettable() and ToAffine().
std::optional<SettableFrame> ToSettable(const nc::SinumerikValue& frame, double unit);

/// TR, FI, RT, SC, MI of an axis (AxisIndex). False: there is none of that name for this axis, or
/// no such value.
bool SetComponent(SettableFrame* frame, std::size_t axis, std::string_view component, double value,
                  double unit);
double Component(const SettableFrame& frame, std::size_t axis, std::string_view component,
                 double unit);

}  // namespace ncsim::control
