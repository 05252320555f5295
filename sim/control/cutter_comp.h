// SPDX-License-Identifier: BSD-3-Clause
// 2D cutter compensation G41/G42 (Haas NGC Mill Operator's Manual 2017, 5.7 "Cutter Compensation",
// G40-G42, settings 43, 44 and 58), in the XY plane.
//
// A compensated move's end depends on the next XY move, so one XY move waits, with the moves
// outside XY that follow it: these run where it ends. The offset is signed, left of the path
// positive; G42 and a negative register turn it over.
//
//   entry   type A: straight to the point beside the start of the next move. Type B, where the next
//   move turns more than
//           90 degrees away on the outside: to the point beside the entry's own end, then around
//           the corner. Exit mirrors it.
//   inside  corner: the intersection of the two offsets; none, or a move run backwards, is a
//   control-alarm. outside corner: FANUC: the offsets' tangents are extended to their intersection
//   up to 90 degrees of turn (270 outside),
//           beyond it by the radius each and joined by a line; YASNAC: an arc about the corner.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/finding.h"
#include "sim/control/comp_joint.h"
#include "sim/control/contour.h"

namespace ncsim::control {

class CutterComp {
 public:
  using Out = std::function<void(const Command&)>;
  using Report = std::function<void(Finding)>;
  CutterComp(const ContourOptions& options, Out out, Report report);

  void SetPosition(const AxisValues& start) { programmed_ = start; }
  void set_look_ahead(bool on) { look_ahead_ = on; }
  /// Where the tool is, in program coordinates, after Flush().
  AxisValues position() const;
  void Push(const Command& command);
  /// Sends on what waits, ended beside its own end: what comes next is not known.
  void Flush();
  /// The program stops or ends at `where` with G41 or G42 in force.
  void AlarmAtStop(const SourcePosition& where);

 private:
  enum class Phase {
    kOff,      ///< The tool is on the programmed path.
    kEntry,    ///< pending_ turns compensation on.
    kOn,       ///< pending_ is an edge.
    kFlushed,  ///< Beside the path, nothing pending: the next corner cannot be joined.
  };
  // An XY move that waits for the next one.
  struct Move {
    Command command;
    CompEdge edge;                ///< `programmed` only, for an entry.
    Point start = Point::Zero();  ///< Of the tool.
    bool skewed = false;          ///< The offset changes along it: not an edge for the look-ahead.
    bool first = false;           ///< First edge after the entry.
  };
  // A finished edge, for the check of two moves' look-ahead.
  struct Done {
    Curve programmed;
    Curve actual;
    SourcePosition where;
    bool first = false;
  };

  bool MovesInXY(const Command& command) const;
  void OutsideXY(const Command& command);
  void Enter(const Command& command);
  void Continue(const Command& command);
  void Exit(const Command& command);
  Move MakeMove(Command command);
  void Resume(Move* move);
  void MachineMove(const Command& command);

  void Finish(const CompJoint& joint, const Command& next);
  void SendEntry(const Point& end);
  void SendEdge(const Point& end, double along);
  void SendBetween();
  void SendLinks(const CompJoint& joint, const Command& next);
  void SendTo(Command command, const Point& end);
  void SendBeside(Command command);
  void CheckLookAhead(const Curve& actual, bool last);
  void CheckLength(const Command& command, double offset, const char* what);
  void Alarm(const SourcePosition& where, const std::string& message);
  Point ProgrammedXY() const { return {programmed_[kX], programmed_[kY]}; }

  const ContourOptions options_;
  bool look_ahead_ = true;
  Out out_;
  Report report_;
  Phase phase_ = Phase::kOff;
  bool alarmed_ = false;     ///< The control stops at its first alarm; more would be noise.
  AxisValues programmed_{};  ///< Programmed end of the last command.
  Point beside_ =
      Point::Zero();     ///< Tool minus programmed position, XY, after what has been sent on.
  double offset_ = 0.0;  ///< Of the last move.
  std::optional<Move> pending_;
  std::vector<Command> between_;  ///< Moves outside XY after pending_.
  std::vector<Done> done_;        ///< The last two edges.
};

}  // namespace ncsim::control
