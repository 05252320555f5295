// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/pocket_cycles.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/control/arc.h"

namespace ncsim::control {
namespace {

constexpr double kMaxPasses = 10'000.0;

bool Check(const CircularPocketWords& words, std::string* error) {
  const std::string name = words.clockwise ? "G12" : "G13";
  if (!(words.first_radius > words.tool_radius)) {
    *error = name + " needs I greater than the tool radius: I" + Short(words.first_radius) +
             ", tool radius " + Short(words.tool_radius) + " mm";
    return false;
  }
  if (words.radius.has_value() != words.stepover.has_value()) {
    *error = name + " needs K and Q together";
    return false;
  }
  if (words.radius && !(*words.radius > words.first_radius)) {
    *error = name + " needs K greater than I";
    return false;
  }
  if (words.stepover && !(*words.stepover * kMaxPasses > *words.radius - words.first_radius)) {
    *error = name + " needs a Q that reaches K in fewer than 10000 circles";
    return false;
  }
  return true;
}

// Emits arcs about points of the X axis through the pocket's centre; the tool is always on that
// axis between arcs.
class Spiral {
 public:
  Spiral(const Command& prototype, const AxisValues& centre, bool clockwise,
         const std::function<void(const Command&)>& out)
      : move_(prototype), centre_(centre), out_(out) {
    move_.kind = CommandKind::kArc;
    move_.plane = Plane::kXY;
    move_.clockwise = clockwise;
    move_.named = 1U << kX | 1U << kY;
    move_.end = centre;
  }

  void HalfCircleTo(double x) {
    move_.full_circle = false;
    ArcTo(x, 0.5 * (x_ + x));
  }
  void FullCircle() {
    move_.full_circle = true;
    ArcTo(x_, 0.0);
  }
  double x() const { return x_; }

 private:
  void ArcTo(double x, double about) {
    move_.end[kX] = centre_[kX] + x;
    move_.centre = {centre_[kX] + about, centre_[kY], centre_[kZ]};
    x_ = x;
    out_(move_);
  }

  Command move_;
  const AxisValues centre_;
  const std::function<void(const Command&)>& out_;
  double x_ = 0.0;
};

}  // namespace

std::optional<AxisValues> ExpandCircularPocket(const CircularPocketWords& words,
                                               const Command& prototype, const AxisValues& position,
                                               const std::function<void(const Command&)>& out,
                                               std::string* error) {
  if (!Check(words, error)) return std::nullopt;
  AxisValues bottom = position;
  bottom[kZ] = words.depth;
  Command plunge = prototype;
  plunge.kind = CommandKind::kFeed;
  plunge.end = bottom;
  plunge.named = 1U << kZ;
  if (position[kZ] != words.depth) out(plunge);

  Spiral spiral(plunge, bottom, words.clockwise, out);
  const double last = words.radius.value_or(words.first_radius) - words.tool_radius;
  double radius = words.first_radius - words.tool_radius;
  while (true) {
    spiral.HalfCircleTo(spiral.x() > 0.0 ? -radius : radius);
    spiral.FullCircle();
    if (radius >= last) break;
    radius = std::min(radius + *words.stepover, last);
  }
  spiral.HalfCircleTo(0.0);
  return bottom;
}

}  // namespace ncsim::control
