// SPDX-License-Identifier: BSD-3-Clause
// The last stage: commands in program coordinates -> motions of the joints, with their time.
// Neutral of dialect.
#pragma once

#include <array>
#include <cstdint>

#include "sim/control/command.h"
#include "sim/control/frames.h"
#include "sim/control/rapid.h"
#include "sim/control/run_log.h"
#include "sim/motion/motion.h"

namespace ncsim::control {

struct MotionOptions {
  bool track_tcp_rapids = false;  ///< TCP rapids keep the tip on its line; else dog-legs.
  /// Feed per minute of a rotary axis without TCP: diameter (mm) at which A, B, C run at the feed
  /// (settings 34, 79). 0: a degree counts as `degree_counts_as`.
  std::array<double, 3> rotary_diameter{};
  double degree_counts_as = 1.0;  ///< mm: one unit of the feed's length (1 mm, or 25.4 mm).
  /// Rotary axes count for the feed only where no linear axis moves (SINUMERIK: FGROUP).
  bool rotary_follows = false;
  /// Smoothing leaves the corners of rapids too, and turns the tool there.
  bool rounds_rapids = false;
  /// A feed that an axis cannot follow takes longer; else the control stops with an alarm.
  bool slows_down = false;
};

class ToMotion {
 public:
  /// All pointers outlive this. `start`: machine values.
  ToMotion(const machine::Machine& machine, Frames* frames, MotionOptions options,
           const AxisValues& start, RunSink* sink, RunLog* log, RunSummary* summary);

  /// One command, one motion (none where nothing moves). Motions chain bit for bit. After
  /// RunLog::stopped() nothing is sent any more.
  void Execute(const Command& command);
  /// The control's readout: machine values now.
  AxisValues position() const;
  /// Counts `axis` anew by whole turns, so that it reads `value` where it stands (Haas setting
  /// 108); the metal does not move and the motions stay continuous.
  void Renumber(int axis, double value);
  double time() const { return time_; }

 private:
  JointVector ToJoints(const AxisValues& readout) const;
  JointVector Target(const Command& command);
  void Rapid(const Command& command, const JointVector& q1);
  void Feed(const Command& command, const JointVector& q1);
  void TcpFeed(const Command& command, const JointVector& q1);
  void Arc(const Command& command, const JointVector& q1);
  void TcpArc(const Command& command, const JointVector& q1);
  void SetCurve(const Command& command, const JointVector& q1, motion::TcpCurve* curve);
  void LeadToolAxis(const Command& command, motion::TcpCurve* curve);
  double TcpTime(const motion::Motion& motion) const;
  double RotaryLength(const JointVector& q1) const;
  bool FeedTime(const Command& command, double length, double rotary);
  bool CheckRates(const Command& command, const JointVector& most, double rotary);
  void SetFacts(const Command& command);
  void Send(const Command& command, motion::MotionKind kind);

  const machine::Machine* machine_;
  Frames* frames_;
  const MotionOptions options_;
  RunSink* sink_;
  RunLog* log_;
  RunSummary* summary_;
  JointVector q_;                         ///< Where the joints stand.
  std::array<double, kNumAxes> turns_{};  ///< Joint value = readout + turns (Renumber()).
  double time_ = 0.0;
  motion::Motion motion_;  ///< Reused.
};

}  // namespace ncsim::control
