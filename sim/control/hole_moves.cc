// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/hole_moves.h"

#include <cmath>

namespace ncsim::control {
namespace {

constexpr double kNearDirection = 1e-9;

AxisValues Moved(AxisValues at, Plane plane, double distance, double angle) {
  const PlaneAxes axes = AxesOf(plane);
  at[static_cast<std::size_t>(axes.first)] += distance * std::cos(angle);
  at[static_cast<std::size_t>(axes.second)] += distance * std::sin(angle);
  return at;
}

}  // namespace

HoleMoves::HoleMoves(const Command& prototype, const AxisValues& position, const Out& out)
    : move_(prototype),
      axes_(AxesOf(prototype.plane)),
      out_(out),
      feed_(prototype.feed),
      prototype_named_(prototype.named) {
  move_.end = position;
  move_.corner_radius = move_.corner_chamfer = move_.corner_chamfer_length = 0.0;
  move_.exact_stop = true;  // Every feed of a cycle ends in a reversal or a stop.
}

void HoleMoves::RapidInPlane(const AxisValues& target) {
  const std::size_t normal = static_cast<std::size_t>(axes_.normal);
  std::uint8_t named = prototype_named_ & static_cast<std::uint8_t>(~(1U << axes_.normal));
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    if (i != normal && target[i] != move_.end[i]) named |= static_cast<std::uint8_t>(1U << i);
  }
  if (named == 0) return;
  const double level = move_.end[normal];
  move_.end = target;
  move_.end[normal] = level;
  Send(CommandKind::kRapid, named);
}

void HoleMoves::Shift(double first, double second, double normal) {
  const int axes[3] = {axes_.first, axes_.second, axes_.normal};
  const double distances[3] = {first, second, normal};
  std::uint8_t named = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    move_.end[static_cast<std::size_t>(axes[i])] += distances[i];
    if (distances[i] != 0.0) named |= static_cast<std::uint8_t>(1U << axes[i]);
  }
  Send(CommandKind::kRapid, named);
}

void HoleMoves::Dwell(double seconds) {
  if (seconds <= 0.0) return;
  move_.dwell = seconds;
  Send(CommandKind::kDwell, 0);
  move_.dwell = 0.0;
}

void HoleMoves::Level(CommandKind kind, double level, double feed) {
  double& value = move_.end[static_cast<std::size_t>(axes_.normal)];
  if (std::abs(value - level) < kNearDirection) return;
  value = level;
  move_.feed = feed;
  Send(kind, static_cast<std::uint8_t>(1U << axes_.normal));
}

void HoleMoves::Send(CommandKind kind, std::uint8_t named) {
  move_.kind = kind;
  move_.named = named;
  out_(move_);
}

std::vector<AxisValues> HolesOnArc(const AxisValues& centre, Plane plane, double radius,
                                   double angle, double step, int count) {
  std::vector<AxisValues> holes;
  for (int n = 0; n < count; ++n) holes.push_back(Moved(centre, plane, radius, angle + n * step));
  return holes;
}

std::vector<AxisValues> HolesOnLine(const AxisValues& first, Plane plane, double distance,
                                    double angle, int count) {
  std::vector<AxisValues> holes;
  for (int n = 0; n < count; ++n) holes.push_back(Moved(first, plane, n * distance, angle));
  return holes;
}

}  // namespace ncsim::control
