// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/corner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/arc.h"

namespace ncsim::control {
namespace {

constexpr double kNoLength = 1e-9;
// Below this turn (rad) a corner is a straight line, above pi less this a reversal.
constexpr double kNoTurn = 1e-9;

bool HasCorner(const Command& command) {
  return command.corner_radius != 0.0 || command.corner_chamfer != 0.0 ||
         command.corner_chamfer_length != 0.0;
}

Eigen::Vector2d PlanePoint(const AxisValues& point, const PlaneAxes& axes) {
  return {point[static_cast<std::size_t>(axes.first)],
          point[static_cast<std::size_t>(axes.second)]};
}

void SetInPlane(const Eigen::Vector2d& value, const PlaneAxes& axes, AxisValues* point) {
  (*point)[static_cast<std::size_t>(axes.first)] = value.x();
  (*point)[static_cast<std::size_t>(axes.second)] = value.y();
}

bool SameOutside(const AxisValues& a, const AxisValues& b, const PlaneAxes& axes) {
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    const int axis = static_cast<int>(i);
    if (axis != axes.first && axis != axes.second && a[i] != b[i]) return false;
  }
  return true;
}

/// Radius, or the way of the chamfer on each line.
double SizeOf(const Command& command, double turn) {
  if (command.corner_radius != 0.0) return command.corner_radius;
  if (command.corner_chamfer != 0.0) return command.corner_chamfer;
  return command.corner_chamfer_length / (2.0 * std::cos(0.5 * turn));
}

// In inverse time a piece of length `part` keeps the speed that the block of length `whole` has.
void KeepSpeed(double whole, double part, Command* command) {
  if (command->feed_mode == Command::FeedMode::kInverseTime && part > kNoLength) {
    command->feed *= whole / part;
  }
}

}  // namespace

CornerStage::CornerStage(Out out, Report report, const CornerNames& names)
    : names_(names), out_(std::move(out)), report_(std::move(report)) {}

void CornerStage::Push(const Command& command) {
  if (!first_) {
    if (HasCorner(command)) {
      start_ = position_;
      Hold(command);
      return;
    }
    position_ = command.end;
    out_(command);
    return;
  }
  if (command.kind == CommandKind::kDwell) {
    dwells_.push_back(command);
    return;
  }
  const AxisValues corner = position_;
  Command second = command;
  const bool inserted = Insert(&second);
  if (!inserted) Send();
  // After an inserted corner, position_ is where it ends; `second` starts there.
  if (HasCorner(second)) {
    start_ = inserted ? position_ : corner;
    Hold(second);
  } else {
    position_ = second.end;
    out_(second);
  }
}

void CornerStage::Flush() {
  if (!first_) return;
  Alarm("is not followed by a linear move (G01)");
  Send();
}

void CornerStage::Hold(const Command& command) {
  if (command.kind != CommandKind::kFeed) {
    first_ = command;
    Alarm("is not in a linear move (G01)");
    Send();
    position_ = command.end;
    return;
  }
  first_ = command;
  position_ = command.end;
}

void CornerStage::Send() {
  Command first = *first_;
  first.corner_radius = first.corner_chamfer = first.corner_chamfer_length = 0.0;
  first_.reset();
  out_(first);
  for (const Command& dwell : dwells_) out_(dwell);
  dwells_.clear();
}

bool CornerStage::Alarm(const std::string& why) {
  std::string name = "corner rounding ";
  if (first_->corner_radius != 0.0) {
    name += std::string(names_.round) + Short(first_->corner_radius);
  } else if (first_->corner_chamfer != 0.0) {
    name = "chamfer " + std::string(names_.chamfer) + Short(first_->corner_chamfer);
  } else {
    name = "chamfer " + std::string(names_.chamfer_length) + Short(first_->corner_chamfer_length);
  }
  report_(MakeFinding(Rule::kControlAlarm, first_->where, name + " mm " + why));
  return false;
}

// Cuts the corner between *first_ and *second, sends *first_, the dwells and the new piece. False:
// nothing was done.
bool CornerStage::Insert(Command* second) {
  const Command& first = *first_;
  const PlaneAxes axes = AxesOf(first.plane);
  if (second->kind != CommandKind::kFeed) return Alarm("is not followed by a linear move (G01)");
  const int corners = (first.corner_radius != 0.0) + (first.corner_chamfer != 0.0) +
                      (first.corner_chamfer_length != 0.0);
  if (corners > 1) return Alarm("stands beside " + std::string(names_.chamfer) + " in one block");
  const Eigen::Vector2d corner = PlanePoint(first.end, axes);
  const Eigen::Vector2d in = corner - PlanePoint(start_, axes);
  const Eigen::Vector2d out = PlanePoint(second->end, axes) - corner;
  const double in_length = in.norm();
  const double out_length = out.norm();
  if (in_length < kNoLength || out_length < kNoLength || second->plane != first.plane) {
    return Alarm("needs two moves in the active plane");
  }
  const Eigen::Vector2d u = in / in_length;
  const Eigen::Vector2d v = out / out_length;
  const double turn = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));  // Left positive.
  const bool round = first.corner_radius != 0.0;
  const double size = SizeOf(first, turn);
  if (!(size > 0.0)) return Alarm("is not greater than 0");
  if (kPi - std::abs(turn) < kNoTurn) return Alarm("stands at a reversal of direction");
  const double setback = round ? size * std::tan(0.5 * std::abs(turn)) : size;
  if (setback > in_length + kNoLength || setback > out_length + kNoLength) {
    return Alarm("needs " + Short(setback) + " mm of moves that are " + Short(in_length) + " and " +
                 Short(out_length) + " mm long");
  }
  if (std::abs(turn) < kNoTurn) return false;  // Nothing to cut on a straight line.
  if (!SameOutside(first.end, start_, axes) || !SameOutside(second->end, first.end, axes)) {
    report_(MakeFinding(
        Rule::kUnsupportedCode, first.where,
        "a corner with " + std::string(names_.round) + " or " + std::string(names_.chamfer) +
            " between moves that leave the plane is taken in the "
            "plane at the corner's level; the manual does not say what the control does"));
  }

  Command piece = first;
  piece.corner_radius = piece.corner_chamfer = piece.corner_chamfer_length = 0.0;
  piece.named = static_cast<std::uint8_t>(1U << axes.first | 1U << axes.second);
  SetInPlane(corner + setback * v, axes, &piece.end);
  double piece_length = (setback * (v + u)).norm();
  if (round) {
    piece.kind = CommandKind::kArc;
    piece.clockwise = turn < 0.0;
    piece.full_circle = false;
    const Eigen::Vector2d left(-u.y(), u.x());
    const Eigen::Vector2d centre = corner - setback * u + (turn > 0.0 ? size : -size) * left;
    AxisValues at = first.end;
    SetInPlane(centre, axes, &at);
    piece.centre = {at[kX], at[kY], at[kZ]};
    piece_length = size * std::abs(turn);
  }
  KeepSpeed(in_length, piece_length, &piece);
  KeepSpeed(in_length, in_length - setback, &*first_);
  KeepSpeed(out_length, out_length - setback, second);
  SetInPlane(corner - setback * u, axes, &first_->end);
  Send();
  position_ = piece.end;
  out_(piece);
  return true;
}

}  // namespace ncsim::control
