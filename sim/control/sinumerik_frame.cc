// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/units.h"

namespace ncsim::control {
namespace {

// Relative: columns that are square to each other but for rounding.
constexpr double kSquare = 1e-12;

/// mm or rad of a component as programs see it.
double UnitOf(std::size_t axis, double unit) { return axis < kA ? unit : kPi / 180.0; }

std::optional<SettableFrame> PartOf(const nc::SinumerikFrame::Part& part, double unit) {
  SettableFrame frame;
  for (const nc::SinumerikFrame::Axis& axis : part) {
    const std::size_t i = axis.name.size() == 1 ? kLetters.find(axis.name[0]) : kLetters.npos;
    if (i >= kNumAxes) continue;
    SetComponent(&frame, i, "TR", axis.tr, unit);
    SetComponent(&frame, i, "FI", axis.fi, unit);
    if (i >= 3) continue;
    SetComponent(&frame, i, "RT", axis.rt, unit);
    if (!SetComponent(&frame, i, "SC", axis.sc, unit)) return std::nullopt;
    SetComponent(&frame, i, "MI", axis.mi ? 1.0 : 0.0, unit);
  }
  return frame;
}

}  // namespace

Eigen::Matrix3d SinumerikRotation(const std::array<double, 3>& angles) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  if (angles == std::array<double, 3>{}) return Eigen::Matrix3d::Identity();
  return (AngleAxisd(angles[2], Vector3d::UnitZ()) * AngleAxisd(angles[1], Vector3d::UnitY()) *
          AngleAxisd(angles[0], Vector3d::UnitX()))
      .toRotationMatrix();
}

std::optional<Eigen::Matrix3d> SolidAngleRotation(const std::array<double, 3>& angles,
                                                  const std::array<bool, 3>& given) {
  for (int third = 0; third < 3; ++third) {
    const int first = (third + 1) % 3, second = (third + 2) % 3;
    const auto at = [](int axis) { return static_cast<std::size_t>(axis); };
    if (given[at(third)] || !given[at(first)] || !given[at(second)]) continue;
    if (std::max(std::abs(angles[at(first)]), std::abs(angles[at(second)])) >= 0.5 * kPi) break;
    using Eigen::Vector3d;
    const Vector3d in_first =
        Eigen::AngleAxisd(angles[at(second)], Vector3d::Unit(second)) * Vector3d::Unit(first);
    const Vector3d in_second =
        Eigen::AngleAxisd(angles[at(first)], Vector3d::Unit(first)) * Vector3d::Unit(second);
    Eigen::Matrix3d rotation;
    rotation.col(first) = in_first;
    rotation.col(third) = in_first.cross(in_second).normalized();
    rotation.col(second) = rotation.col(third).cross(in_first);
    return rotation;
  }
  return std::nullopt;
}

AxisValues SettableFrame::shift() const {
  AxisValues sum = coarse;
  for (std::size_t i = 0; i < kNumAxes; ++i) sum[i] += fine[i];
  return sum;
}

Eigen::Matrix3d SettableFrame::Linear() const {
  Eigen::Matrix3d linear = SinumerikRotation(turn);
  for (int i = 0; i < 3; ++i) {
    const std::size_t axis = static_cast<std::size_t>(i);
    linear.col(i) *= mirror[axis] ? -scale[axis] : scale[axis];
  }
  return linear;
}

bool AffineFrame::is_zero() const {
  return (linear - Eigen::Matrix3d::Identity()).isZero(0.0) && shift.isZero(0.0) &&
         rotary == std::array<double, 3>{};
}

AffineFrame ToAffine(const SettableFrame& frame) {
  const AxisValues shift = frame.shift();
  return {frame.Linear(),
          {shift[kX], shift[kY], shift[kZ]},
          {shift[kA], shift[kB], shift[kC]},
          frame.fine};
}

AffineFrame Chained(const AffineFrame& outer, const AffineFrame& inner) {
  AffineFrame chained;
  chained.linear = outer.linear * inner.linear;
  chained.shift = outer.shift + outer.linear * inner.shift;
  for (std::size_t i = 0; i < 3; ++i) chained.rotary[i] = outer.rotary[i] + inner.rotary[i];
  chained.fine = outer.fine;
  return chained;
}

std::optional<SettableFrame> ToSettable(const AffineFrame& frame) {
  SettableFrame settable;
  settable.fine = frame.fine;
  for (std::size_t i = 0; i < 3; ++i) {
    settable.coarse[i] = frame.shift[static_cast<int>(i)] - frame.fine[i];
    settable.coarse[i + kA] = frame.rotary[i] - frame.fine[i + kA];
    settable.scale[i] = frame.linear.col(static_cast<int>(i)).norm();
  }
  const Eigen::Matrix3d turn = frame.linear.colwise().normalized();
  const bool square = (turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm() <= kSquare;
  if (!square || turn.determinant() < 0.0) return std::nullopt;
  settable.turn = {std::atan2(turn(2, 1), turn(2, 2)),
                   std::asin(std::clamp(-turn(2, 0), -1.0, 1.0)),
                   std::atan2(turn(1, 0), turn(0, 0))};
  // About the middle axis at 90 degrees the other two turn about one line: all by Z.
  if (std::hypot(turn(0, 0), turn(1, 0)) <= kSquare) {
    settable.turn[0] = 0.0;
    settable.turn[2] = std::atan2(-turn(0, 1), turn(1, 1));
  }
  return settable;
}

nc::SinumerikFrame ToValue(const SettableFrame& frame, double unit) {
  nc::SinumerikFrame::Part part;
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    nc::SinumerikFrame::Axis axis;
    axis.name = kLetters.substr(i, 1);
    axis.tr = frame.coarse[i] / UnitOf(i, unit);
    axis.fi = frame.fine[i] / UnitOf(i, unit);
    if (i < 3) {
      axis.rt = Degrees(frame.turn[i]);
      axis.sc = frame.scale[i];
      axis.mi = frame.mirror[i];
    }
    part.push_back(std::move(axis));
  }
  return nc::SinumerikFrame{{std::move(part)}};
}

std::optional<AffineFrame> ToAffine(const nc::SinumerikValue& frame, double unit) {
  AffineFrame whole;
  if (frame.frame == nullptr) return whole;
  for (const nc::SinumerikFrame::Part& part : frame.frame->chain) {
    const std::optional<SettableFrame> settable = PartOf(part, unit);
    if (!settable) return std::nullopt;
    whole =
        frame.frame->chain.size() == 1 ? ToAffine(*settable) : Chained(whole, ToAffine(*settable));
  }
  return whole;
}

std::optional<SettableFrame> ToSettable(const nc::SinumerikValue& frame, double unit) {
  if (frame.frame == nullptr || frame.frame->chain.empty()) return SettableFrame();
  if (frame.frame->chain.size() == 1) return PartOf(frame.frame->chain.front(), unit);
  const std::optional<AffineFrame> affine = ToAffine(frame, unit);
  return affine ? ToSettable(*affine) : std::nullopt;
}

bool SetComponent(SettableFrame* frame, std::size_t axis, std::string_view component, double value,
                  double unit) {
  if (component == "TR") {
    frame->coarse[axis] = value * UnitOf(axis, unit);
  } else if (component == "FI") {
    frame->fine[axis] = value * UnitOf(axis, unit);
  } else if (axis < 3 && component == "RT") {
    frame->turn[axis] = Radians(value);
  } else if (axis < 3 && component == "SC" && value > 0.0) {
    frame->scale[axis] = value;
  } else if (axis < 3 && component == "MI") {
    frame->mirror[axis] = value != 0.0;
  } else {
    return false;
  }
  return true;
}

double Component(const SettableFrame& frame, std::size_t axis, std::string_view component,
                 double unit) {
  if (component == "TR") return frame.coarse[axis] / UnitOf(axis, unit);
  if (component == "FI") return frame.fine[axis] / UnitOf(axis, unit);
  if (axis >= 3) return component == "SC" ? 1.0 : 0.0;
  if (component == "RT") return Degrees(frame.turn[axis]);
  if (component == "SC") return frame.scale[axis];
  return frame.mirror[axis] ? 1.0 : 0.0;
}

}  // namespace ncsim::control
