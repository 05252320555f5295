// SPDX-License-Identifier: BSD-3-Clause
// Moves: rapids, lines, arcs and helices, their feeds.
#include <algorithm>
#include <cmath>

#include "post/plane_axes.h"
#include "post/writer.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

constexpr std::array<Value, 3> kXyz = {Value::kX, Value::kY, Value::kZ};
constexpr std::array<Value, 2> kRotary = {Value::kRotary1, Value::kRotary2};
constexpr std::array<Value, 3> kCentre = {Value::kArcI, Value::kArcJ, Value::kArcK};
constexpr std::array<Value, 3> kFeeds = {Value::kFeedPerMinute, Value::kFeedPerRevolution,
                                         Value::kFeedInverse};
/// mm: an arc whose ends are no further apart is a whole turn. Less than any increment, more than
/// what rounding makes of one point that is computed twice.
constexpr double kOnePoint = 1e-6;

/// rad in (0, 2 pi] from `start` to `end` about `centre`, in the arc's sense.
double Sweep(const Eigen::Vector3d& start, const Eigen::Vector3d& end,
             const Eigen::Vector3d& centre, PlanPlane plane, bool clockwise) {
  const PlaneAxes axes = AxesOf(plane);
  const auto angle = [&](const Eigen::Vector3d& point) {
    return std::atan2(point[axes.second] - centre[axes.second],
                      point[axes.first] - centre[axes.first]);
  };
  double sweep = angle(end) - angle(start);
  if (clockwise) sweep = -sweep;
  while (sweep <= 0.0) sweep += 2.0 * kPi;
  while (sweep > 2.0 * kPi) sweep -= 2.0 * kPi;
  return sweep;
}

}  // namespace

Eigen::Vector3d NcWriter::Rounded(const Eigen::Vector3d& xyz) const {
  Eigen::Vector3d rounded;
  for (int i = 0; i < 3; ++i) {
    rounded[i] = data_.AsPrinted(kXyz[static_cast<std::size_t>(i)], xyz[i] / data_.unit_mm());
  }
  return rounded;
}

void NcWriter::SetPoint(const Eigen::Vector3d& xyz) {
  for (int i = 0; i < 3; ++i) {
    values_.Set(kXyz[static_cast<std::size_t>(i)], xyz[i] / data_.unit_mm());
  }
}

void NcWriter::SetPose(const PlanPose& pose) {
  SetPoint(pose.xyz);
  for (std::size_t k = 0; k < 2; ++k) values_.Set(kRotary[k], Degrees(pose.rotary[k]));
  values_.Set(Value::kAxisX, pose.axis_P.x());
  values_.Set(Value::kAxisY, pose.axis_P.y());
  values_.Set(Value::kAxisZ, pose.axis_P.z());
}

void NcWriter::Arrive(const PlanPose& end) {
  pose_ = end;
  here_ = Rounded(end.xyz);
}

bool NcWriter::Turns(const PlanPose& end) const {
  for (std::size_t k = 0; k < 2; ++k) {
    const double from = data_.AsPrinted(kRotary[k], Degrees(pose_.rotary[k]));
    if (data_.AsPrinted(kRotary[k], Degrees(end.rotary[k])) != from) return true;
  }
  return false;
}

void NcWriter::SetFeed(const ClFeed& feed, double time, bool turns) {
  constexpr double kSeconds = 60.0;
  for (const Value value : kFeeds) values_.Clear(value);
  Value used = Value::kFeedPerMinute;
  double number = feed.value * kSeconds / data_.unit_mm();
  if (feed.per_revolution) {
    used = Value::kFeedPerRevolution;
    number = feed.value / data_.unit_mm();
    Want(Group::kFeedMode, "per_revolution");
    if (!mode_->per_revolution || turns) {
      Problem("a feed per revolution is not for mode '" + mode_->name + "'");
    }
  } else if (mode_->inverse_time && turns) {
    used = Value::kFeedInverse;
    number = time > 0.0 ? kSeconds / time : 0.0;
    Want(Group::kFeedMode, "inverse_time");
  } else {
    Want(Group::kFeedMode, "per_minute");
  }
  values_.Set(used, number);
  if (data_.FindWord(used) == nullptr) {
    Problem("the post has no word for " + std::string(Info(used).name));
  } else if (data_.AsPrinted(used, number) <= 0.0) {
    Problem("the feed is 0 as it is printed");
  }
}

void NcWriter::CheckPrinted(Block block) {
  const std::string name(BlockTable()[static_cast<std::size_t>(block)].name);
  const auto check = [&](Group group) {
    if (printer_.Has(group, wanted_)) return;
    Problem("the block '" + name + "' of the post prints no {" +
            std::string(GroupTable()[static_cast<std::size_t>(group)].name) + "}");
  };
  check(Group::kMotion);
  check(block == Block::kArc ? Group::kPlane : Group::kComp);
  if (block != Block::kRapid) check(Group::kFeedMode);
}

void NcWriter::Handle(const PlanMove& move) {
  EndCycle();
  if (!positioned_) {
    Problem("a motion before the machine is positioned");
    return;
  }
  Switch();
  if (move.rapid) {
    Rapid(move.end);
  } else if (move.arc) {
    Arc(move);
  } else {
    Line(move);
  }
}

void NcWriter::Rapid(const PlanPose& end) {
  Want(Group::kMotion, "rapid");
  const Eigen::Vector3d to = Rounded(end.xyz);
  const bool across = to.head<2>() != here_.head<2>();
  if (mode_->split_rapids && across && to.z() != here_.z()) {
    PlanPose middle = to.z() > here_.z() ? pose_ : end;
    middle.xyz.z() = std::max(end.xyz.z(), pose_.xyz.z());
    SetPose(middle);
    if (Emit(Block::kRapid, BlockPrinter::Counts::kPosition)) CheckPrinted(Block::kRapid);
  }
  SetPose(end);
  if (Emit(Block::kRapid, BlockPrinter::Counts::kPosition)) CheckPrinted(Block::kRapid);
  Arrive(end);
}

void NcWriter::RapidTo(const Eigen::Vector3d& xyz) {
  PlanPose end = pose_;
  end.xyz = xyz;
  Want(Group::kMotion, "rapid");
  SetPose(end);
  Emit(Block::kRapid, BlockPrinter::Counts::kPosition);
  Arrive(end);
}

void NcWriter::Line(const PlanMove& move) {
  const bool turns = Turns(move.end);
  for (std::size_t k = 0; k < 2; ++k) {
    const WordFormat* word = data_.FindWord(kRotary[k]);
    const BlockTemplate* block = data_.Find(Block::kLine, mode_);
    const bool printed = block != nullptr && block->Uses(kRotary[k]);
    if (word != nullptr && printed && word->wrap &&
        std::abs(move.end.rotary[k] - pose_.rotary[k]) >= kPi) {
      Problem(word->name +
              " turns by 180 degrees or more in a block, and the control goes the "
              "shortest way");
    }
  }
  Want(Group::kMotion, "line");
  SetPose(move.end);
  SetFeed(move.feed, move.time, turns);
  if (Emit(Block::kLine, BlockPrinter::Counts::kPosition)) CheckPrinted(Block::kLine);
  Arrive(move.end);
}

void NcWriter::Arc(const PlanMove& move) {
  const PlanArc& arc = *move.arc;
  if (!printer_.Has(Group::kComp, wanted_)) {
    Problem("cutter compensation begins or ends on an arc");
  }
  const PlaneAxes axes = AxesOf(arc.plane);
  const Eigen::Vector3d start = pose_.xyz, end = move.end.xyz;
  Eigen::Vector3d apart = end - start;
  apart[axes.normal] = 0.0;
  const bool circle = apart.norm() < kOnePoint;
  const double sweep = circle ? 2.0 * kPi : Sweep(start, end, arc.centre, arc.plane, arc.clockwise);
  const double total = sweep + 2.0 * kPi * arc.turns;
  const BlockTemplate* block = data_.Find(Block::kArc, mode_);
  if (block == nullptr) {
    Problem("the post has no block 'arc'");
    return;
  }
  if (arc.turns == 0 || block->Uses(Value::kArcTurns)) {
    ArcBlock(move, start, move.end, 1.0, arc.turns);
    return;
  }
  // A block a turn, each a circle that ends where it began, at its own height.
  PlanPose turn = pose_;
  for (int k = 1; k <= arc.turns; ++k) {
    const double done = 2.0 * kPi * k / total;
    turn.xyz[axes.normal] = start[axes.normal] + done * (end - start)[axes.normal];
    ArcBlock(move, pose_.xyz, turn, 2.0 * kPi / total, 0);
  }
  ArcBlock(move, pose_.xyz, move.end, sweep / total, 0);
}

void NcWriter::ArcBlock(const PlanMove& move, const Eigen::Vector3d& start, const PlanPose& end,
                        double share, int turns) {
  const PlanArc& arc = *move.arc;
  const PlaneAxes axes = AxesOf(arc.plane);
  const double unit = data_.unit_mm();
  Eigen::Vector3d apart = end.xyz - start;
  apart[axes.normal] = 0.0;
  const bool circle = apart.norm() < kOnePoint;
  PlanPose to = end;
  if (circle) {
    // One point, printed twice alike.
    to.xyz[axes.first] = start[axes.first];
    to.xyz[axes.second] = start[axes.second];
  }
  const Eigen::Vector3d printed = Rounded(to.xyz);
  const Eigen::Vector3d centre = arc.centre / unit;
  bool as_line = false;
  if (!circle) {
    const double sweep = Sweep(start, to.xyz, arc.centre, arc.plane, arc.clockwise);
    const bool falls_together =
        printed[axes.first] == here_[axes.first] && printed[axes.second] == here_[axes.second];
    // An arc of about the increment may turn round when its ends are rounded.
    as_line = falls_together ||
              std::abs(Sweep(here_, printed, centre, arc.plane, arc.clockwise) - sweep) > kPi;
    if (as_line && sweep > kPi) {
      Problem("an arc does not end where it began, but prints so");
    }
  }
  for (const Value value : kCentre) values_.Clear(value);
  bool has_radius = false;
  for (const int axis : {axes.first, axes.second}) {
    const Value value = kCentre[static_cast<std::size_t>(axis)];
    values_.Set(value, centre[axis] - here_[axis]);
    has_radius = has_radius || data_.AsPrinted(value, centre[axis] - here_[axis]) != 0.0;
  }
  if (as_line || !has_radius) {
    PlanMove line = move;
    line.arc.reset();
    line.end = to;
    line.time = move.time * share;
    Line(line);
    return;
  }
  values_.Clear(Value::kArcTurns);
  if (turns > 0) values_.Set(Value::kArcTurns, static_cast<double>(turns));
  Want(Group::kMotion, arc.clockwise ? "arc_cw" : "arc_ccw");
  Want(Group::kPlane, KeyOf(arc.plane));
  SetPose(to);
  SetFeed(move.feed, move.time * share, Turns(to));
  if (Emit(Block::kArc, BlockPrinter::Counts::kPosition)) CheckPrinted(Block::kArc);
  Arrive(to);
}

}  // namespace ncsim::post
