// SPDX-License-Identifier: BSD-3-Clause
// The moves of one hole: what drilling cycles of all controls are made of. Neutral of dialect.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/control/arc.h"
#include "sim/control/command.h"

namespace ncsim::control {

/// Writes moves from `position` on, in program coordinates; mm, mm/s, s. Levels are along the
/// normal axis of the prototype's plane. A move to where the tool stands is none.
class HoleMoves {
 public:
  using Out = std::function<void(const Command&)>;
  /// `prototype` carries frame, plane, feed, spindle and source; `out` outlives this.
  HoleMoves(const Command& prototype, const AxisValues& position, const Out& out);

  /// To `target` at the level of now.
  void RapidInPlane(const AxisValues& target);
  /// By these distances along the plane's first, second and normal axis.
  void Shift(double first, double second, double normal = 0.0);
  void RapidTo(double level) { Level(CommandKind::kRapid, level, feed_); }
  void FeedTo(double level, double factor = 1.0) {
    Level(CommandKind::kFeed, level, feed_ * factor);
  }
  void Dwell(double seconds);
  void SetSpindle(bool on) { move_.spindle_on = on; }
  double level() const { return move_.end[static_cast<std::size_t>(axes_.normal)]; }
  const AxisValues& position() const { return move_.end; }

 private:
  void Level(CommandKind kind, double level, double feed);
  void Send(CommandKind kind, std::uint8_t named);

  Command move_;
  const PlaneAxes axes_;
  const Out& out_;
  const double feed_;
  const std::uint8_t prototype_named_;
};

/// `count` positions about `centre` in the plane: the first at `angle` from the plane's first axis,
/// each further one by `step` on. mm, rad.
std::vector<AxisValues> HolesOnArc(const AxisValues& centre, Plane plane, double radius,
                                   double angle, double step, int count);
/// `count` positions from `first` on, `distance` apart in the direction `angle`.
std::vector<AxisValues> HolesOnLine(const AxisValues& first, Plane plane, double distance,
                                    double angle, int count);

}  // namespace ncsim::control
