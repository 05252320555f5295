// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/cutter_comp.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/control/arc.h"

namespace ncsim::control {
namespace {

constexpr double kNoMove = 1e-9;
// Overcuts below this are rounding of the program's numbers (an arc's ends may be off by 0.01 mm).
constexpr double kOvercut = 0.02;
// Moves outside XY that may wait; a control has room for a few.
constexpr std::size_t kMaxBetween = 1000;

bool InMachineCoordinates(const Command& command) {
  return command.kind == CommandKind::kMachineRapid || command.kind == CommandKind::kMachineFeed ||
         command.kind == CommandKind::kToolChange;
}

// mm, left of the path positive; 0 while compensation is off.
double OffsetOf(const Command& command) {
  switch (command.comp) {
    case Command::Comp::kLeft:
      return command.comp_radius;
    case Command::Comp::kRight:
      return -command.comp_radius;
    case Command::Comp::kOff:
      break;
  }
  return 0.0;
}

Curve CurveOf(const AxisValues& start, const Command& command) {
  const Point from(start[kX], start[kY]);
  const Point to(command.end[kX], command.end[kY]);
  if (command.kind != CommandKind::kArc) return Curve::Line(from, to);
  return Curve::Arc(from, to, {command.centre.x(), command.centre.y()},
                    ArcOf(start, command).sweep);
}

Point XY(const AxisValues& point) { return {point[kX], point[kY]}; }

}  // namespace

CutterComp::CutterComp(const ContourOptions& options, Out out, Report report)
    : options_(options), out_(std::move(out)), report_(std::move(report)) {}

AxisValues CutterComp::position() const {
  AxisValues at = programmed_;
  at[kX] += beside_.x();
  at[kY] += beside_.y();
  return at;
}

void CutterComp::Push(const Command& command) {
  if (InMachineCoordinates(command)) {
    MachineMove(command);
    return;
  }
  const bool commanded = command.comp != Command::Comp::kOff;
  if (phase_ == Phase::kOff && !commanded) {
    programmed_ = command.end;
    out_(command);
    return;
  }
  if (command.cycle != 0 && commanded) {
    report_(MakeFinding(Rule::kUnsupportedCode, command.where,
                        "a canned cycle while cutter compensation is active"));
  }
  if (!MovesInXY(command)) {
    OutsideXY(command);
  } else if (phase_ == Phase::kOff) {
    Enter(command);
  } else if (commanded) {
    Continue(command);
  } else {
    Exit(command);
  }
  programmed_ = command.end;
}

void CutterComp::Flush() {
  if (!pending_) return;
  const Point corner = pending_->edge.programmed.end;
  if (phase_ == Phase::kEntry) {
    const Point beside =
        corner + pending_->edge.offset * Left(pending_->edge.programmed.end_tangent());
    SendEntry(beside);
    beside_ = beside - corner;
  } else {
    const Curve& ideal = pending_->edge.ideal;
    SendEdge(ideal.end, ideal.length());
    beside_ = ideal.end - corner;
  }
  SendBetween();
  phase_ = Phase::kFlushed;
}

void CutterComp::AlarmAtStop(const SourcePosition& where) {
  Alarm(where, "the program stops while cutter compensation is active (G40 is missing)");
}

bool CutterComp::MovesInXY(const Command& command) const {
  if (command.kind == CommandKind::kDwell) return false;
  if (command.kind == CommandKind::kArc && command.full_circle) return true;
  return (XY(command.end) - ProgrammedXY()).norm() > kNoMove;
}

// A move along Z or of a rotary axis, a dwell: runs where the XY move before it ends.
void CutterComp::OutsideXY(const Command& command) {
  if (pending_ && between_.size() >= kMaxBetween) Flush();
  if (pending_) {
    between_.push_back(command);
    return;
  }
  SendBeside(command);
}

void CutterComp::MachineMove(const Command& command) {
  const bool on = phase_ != Phase::kOff;
  Flush();
  const bool leaves =
      (command.named & (1U << kX | 1U << kY)) != 0 || command.kind == CommandKind::kToolChange;
  if (on && command.comp != Command::Comp::kOff) {
    report_(MakeFinding(Rule::kUnsupportedCode, command.where,
                        "a move in machine coordinates while cutter compensation is active"));
  }
  if (leaves) {
    phase_ = Phase::kOff;
    beside_ = Point::Zero();
  }
  out_(command);
}

void CutterComp::Enter(const Command& command) {
  const double offset = OffsetOf(command);
  done_.clear();
  if (command.kind == CommandKind::kArc) {
    Alarm(command.where, "cutter compensation starts in an arc (G02 or G03)");
    out_(command);
    return;
  }
  if (command.plane != Plane::kXY) {
    Alarm(command.where,
          "cutter compensation starts in " + PlaneName(command.plane) + "; it works in G17 only");
  }
  CheckLength(command, offset, "on");
  Move move;
  move.command = command;
  move.edge.programmed = CurveOf(programmed_, command);
  move.edge.offset = offset;
  move.start = ProgrammedXY();
  offset_ = offset;
  pending_ = std::move(move);
  phase_ = Phase::kEntry;
}

// The edge of a command; what the control refuses becomes an alarm and a line, so that the rest can
// be read.
CutterComp::Move CutterComp::MakeMove(Command command) {
  double offset = OffsetOf(command);
  Curve programmed = CurveOf(programmed_, command);
  if (command.kind == CommandKind::kArc) {
    bool refuse = true;
    if (command.plane != Plane::kXY) {
      Alarm(command.where, "an arc in " + PlaneName(command.plane) +
                               " while cutter compensation is active; it works in G17 only");
    } else if (offset != offset_) {
      Alarm(command.where, "cutter compensation changes its side or D in an arc");
      offset = offset_;
      refuse = !CanOffset(programmed, offset);
    } else if (!CanOffset(programmed, offset)) {
      Alarm(command.where, "an inside arc of radius " + Short(programmed.radius) +
                               " mm is too small for the cutter compensation of " +
                               Short(std::abs(offset)) + " mm");
    } else {
      refuse = false;
    }
    if (refuse) {
      command.kind = CommandKind::kFeed;
      programmed = Curve::Line(programmed.start, programmed.end);
    }
  }
  Move move;
  move.edge = MakeEdge(programmed, offset);
  move.command = std::move(command);
  move.start = move.edge.ideal.start;
  return move;
}

void CutterComp::Continue(const Command& command) {
  Move move = MakeMove(command);
  if (phase_ == Phase::kFlushed) {
    Resume(&move);
  } else {
    CompJoint joint;
    if (phase_ == Phase::kEntry) {
      joint = JoinEntry(pending_->edge.programmed, move.edge, options_);
      move.first = true;
    } else if (move.edge.offset != offset_) {
      const Curve& ideal = pending_->edge.ideal;
      joint.first_end = joint.second_start = ideal.end;
      joint.first_along = ideal.length();
      move.skewed = true;
    } else {
      joint = JoinEdges(pending_->edge, move.edge, options_);
    }
    Finish(joint, command);
    move.start = joint.second_start;
    move.edge.start_along = joint.second_along;
  }
  offset_ = move.edge.offset;
  pending_ = std::move(move);
  phase_ = Phase::kOn;
}

// After a flush the tool stands beside the end of a move whose corner with this one is not known
// any more.
void CutterComp::Resume(Move* move) {
  const Point at = ProgrammedXY() + beside_;
  if ((at - move->start).norm() > kNoMove) {
    report_(MakeFinding(Rule::kUnsupportedCode, move->command.where,
                        "the corner before this move was taken without look-ahead in cutter "
                        "compensation (a position was read, or the frame changed)"));
    Command link = move->command;
    link.kind = CommandKind::kFeed;
    for (std::size_t i = kZ; i < kNumAxes; ++i) link.end[i] = programmed_[i];
    SendTo(std::move(link), move->start);
  }
}

void CutterComp::Exit(const Command& command) {
  const bool arc = command.kind == CommandKind::kArc;
  if (arc) Alarm(command.where, "cutter compensation ends in an arc (G02 or G03)");
  CheckLength(command, offset_, "off");
  const Curve exit = CurveOf(programmed_, command);
  if (phase_ == Phase::kEntry) {
    CompJoint joint;
    const Curve& entry = pending_->edge.programmed;
    joint.first_end = joint.second_start =
        entry.end + pending_->edge.offset * Left(entry.end_tangent());
    Finish(joint, command);
  } else if (phase_ == Phase::kOn) {
    Finish(JoinExit(pending_->edge, exit, options_), command);
  }
  phase_ = Phase::kOff;
  beside_ = Point::Zero();
  if (arc) {
    Command link = command;
    link.kind = CommandKind::kFeed;
    for (std::size_t i = kZ; i < kNumAxes; ++i) link.end[i] = programmed_[i];
    SendTo(std::move(link), ProgrammedXY());
  }
  SendTo(command, XY(command.end));
}

// Sends the pending move as far as the joint, what waited behind it, and the links to `next`.
void CutterComp::Finish(const CompJoint& joint, const Command& next) {
  const Point corner = pending_->edge.programmed.end;
  const bool last = next.comp == Command::Comp::kOff;
  if (!joint.fits) {
    Alarm(pending_->command.where,
          "cutter compensation of " + Short(std::abs(pending_->edge.offset)) +
              " mm does not fit: the tool would overcut the corner with line " +
              std::to_string(next.where.line));
  }
  if (phase_ == Phase::kEntry) {
    SendEntry(joint.first_end);
  } else {
    if (pending_->skewed || pending_->edge.offset == 0.0 || !joint.fits) {
      done_.clear();
    } else {
      const Curve& ideal = pending_->edge.ideal;
      const Curve actual =
          ideal.arc
              ? Curve::Arc(
                    pending_->start, joint.first_end, ideal.centre,
                    std::copysign((joint.first_along - pending_->edge.start_along) / ideal.radius,
                                  ideal.sweep))
              : Curve::Line(pending_->start, joint.first_end);
      if (look_ahead_) CheckLookAhead(actual, last);
    }
    SendEdge(joint.first_end, joint.first_along);
  }
  beside_ = joint.first_end - corner;
  SendBetween();
  SendLinks(joint, next);
  beside_ = joint.second_start - corner;
}

void CutterComp::SendEntry(const Point& end) {
  SendTo(pending_->command, end);
  pending_.reset();
}

void CutterComp::SendEdge(const Point& end, double along) {
  Move move = std::move(*pending_);
  pending_.reset();
  const Curve& ideal = move.edge.ideal;
  if (move.command.kind == CommandKind::kArc) {
    const double length = along - move.edge.start_along;
    const double programmed = move.edge.programmed.radius;
    // What is left of an arc between two inside corners may be nothing: a point, not a full circle.
    if (length < kNoMove) move.command.kind = CommandKind::kFeed;
    move.command.full_circle = move.command.full_circle && length > ideal.length() - kNoMove;
    if (ideal.radius < programmed && move.command.feed_mode != Command::FeedMode::kInverseTime) {
      move.command.feed *= std::max(ideal.radius / programmed, options_.least_arc_feed);
    }
  }
  SendTo(std::move(move.command), end);
}

void CutterComp::SendBetween() {
  for (const Command& command : between_) SendBeside(command);
  between_.clear();
}

// The pieces of a corner feed as the cutting move beside it does; they keep the level of the move
// before.
void CutterComp::SendLinks(const CompJoint& joint, const Command& next) {
  if (joint.links.empty()) return;
  Command link = next;
  link.corner_radius = link.corner_chamfer = 0.0;
  link.dwell = 0.0;
  link.named = 0;
  link.end = programmed_;
  link.centre = {programmed_[kX], programmed_[kY], programmed_[kZ]};
  link.full_circle = false;
  link.clockwise = offset_ > 0.0;
  link.plane = Plane::kXY;
  const CommandKind straight =
      next.kind == CommandKind::kRapid ? CommandKind::kRapid : CommandKind::kFeed;
  for (const CompLink& piece : joint.links) {
    const bool arc = piece.arc && straight == CommandKind::kFeed;
    link.kind = arc ? CommandKind::kArc : straight;
    SendTo(link, piece.to);
  }
}

// Compensation moves X and Y together, whatever the block names.
void CutterComp::SendTo(Command command, const Point& end) {
  command.named |= 1U << kX | 1U << kY;
  command.end[kX] = end.x();
  command.end[kY] = end.y();
  out_(command);
}

// A move outside XY: the tool stays beside the programmed point.
void CutterComp::SendBeside(Command command) {
  command.end[kX] += beside_.x();
  command.end[kY] += beside_.y();
  out_(command);
}

// Three moves are held against each other: the tool on one must not overcut the one before last,
// nor the other way about (manual 5.7.1). A lead-in and a lead-out around a contour of one move may
// cross: nothing is cut there.
void CutterComp::CheckLookAhead(const Curve& actual, bool last) {
  const Curve& programmed = pending_->edge.programmed;
  if (done_.size() == 2) {
    const Done& before = done_.front();
    const double radius = std::abs(pending_->edge.offset);
    const double clearance =
        std::min(Distance(actual, before.programmed), Distance(before.actual, programmed));
    if (clearance < radius - kOvercut && !(before.first && last)) {
      Alarm(before.where, "cutter compensation of " + Short(radius) +
                              " mm does not fit: the tool would overcut by " +
                              Short(radius - clearance) + " mm between here and line " +
                              std::to_string(pending_->command.where.line));
    }
    done_.erase(done_.begin());
  }
  done_.push_back({programmed, actual, pending_->command.where, pending_->first});
}

// The manual forbids it and does not say what the control does.
void CutterComp::CheckLength(const Command& command, double offset, const char* what) {
  const double length = (XY(command.end) - ProgrammedXY()).norm();
  if (!options_.long_lead || length >= std::abs(offset) - kOvercut) return;
  report_(MakeFinding(Rule::kUnsupportedCode, command.where,
                      std::string("cutter compensation of ") + Short(std::abs(offset)) +
                          " mm is turned " + what + " in a move of " + Short(length) +
                          " mm; the manual asks for one at least as long"));
}

void CutterComp::Alarm(const SourcePosition& where, const std::string& message) {
  if (alarmed_) return;
  alarmed_ = true;
  report_(MakeFinding(Rule::kControlAlarm, where, message));
}

}  // namespace ncsim::control
