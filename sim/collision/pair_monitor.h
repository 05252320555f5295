// SPDX-License-Identifier: BSD-3-Clause
// One pair over a program: sweeps each motion, applies the pair's rule, and folds runs of blocks
// into one finding each.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim/base/run_finding.h"
#include "sim/collision/contact_rules.h"
#include "sim/collision/contact_text.h"
#include "sim/collision/engine.h"
#include "sim/collision/pairs.h"
#include "sim/collision/patience.h"
#include "sim/collision/sweep.h"
#include "sim/machine/machine.h"

namespace ncsim::collision {

/// Findings with the number of the motion where each begins.
using NumberedFindings = std::vector<std::pair<std::uint64_t, Finding>>;

class PairMonitor {
 public:
  /// `blank`: of the pair's blank, or null. All references outlive this.
  PairMonitor(const machine::Machine& machine, const machine::CheckSettings& settings, Pair pair,
              BlankState* blank, NumberedFindings* findings);

  /// Motions in order, while the pair exists (a tool in the spindle). `number` is that of the first
  /// of them among all motions.
  void OnRun(const motion::Travel& travel, std::uint64_t number);
  /// The tool leaves the spindle, or another comes: runs end, what is known of the pose is void.
  void Pause();
  /// Another tool: a pair of the scene may warn about the cut blank again.
  void OnToolChange() { warned_ = false; }
  void Finish() { CloseRuns(); }

  const Pair& pair() const { return pair_; }
  const PairSweep& sweep() const { return sweep_; }
  std::uint64_t queries() const {
    return sweep_.queries() + (swept_ == nullptr ? 0 : swept_->queries());
  }
  /// sweep().least() holds over the whole program.
  bool has_clearance() const;

 private:
  /// Consecutive blocks with the same fault.
  struct Run {
    RunFinding blocks;
    std::uint64_t number = 0;
    ContactWords words;
    double least = std::numeric_limits<double>::infinity();
    bool with_lag = false;
    int depth_budget = 3000;  ///< Poses to look for the deepest one.
  };

  void OnMotion(const motion::Motion& motion, std::uint64_t number);
  std::size_t Cross(const motion::Travel& travel, std::size_t begin, std::uint64_t number);
  std::size_t CrossSwept(const motion::Travel& travel, std::size_t begin, const Watch& watch);
  bool ClearWhenSwept(const motion::Motion& motion, const Watch& watch);
  void Passed(const motion::Travel& travel, std::size_t begin, std::size_t end);
  void OnSpindleStopped(const motion::Motion& motion, std::uint64_t number);
  double AllowedDepth(const motion::Motion& motion);
  void OnContact(const motion::Motion& motion, std::uint64_t number, const Judgement& judgement,
                 const SweepResult& result);
  void OnClear(const motion::Motion& motion, std::uint64_t number, const Judgement& judgement,
               const SweepResult& result);
  void OnFirstCut(std::uint64_t number, const SweepResult& result);
  void Deepen(const motion::Motion& motion, const PathPoint& contact, bool track, Run* run);
  void Confirm(const motion::Motion& motion, std::uint64_t number, const PathPoint& at);
  void ReportOnce(Rule rule, const motion::Motion& motion, std::uint64_t number,
                  std::string message);
  void Open(const motion::Motion& motion, std::uint64_t number, Rule rule, Severity severity,
            const PathPoint& at, Run* run);
  void Place(const motion::Motion& motion, const PathPoint& at, Run* run);
  std::vector<std::array<double, 3>> PointsOf(const motion::Motion& motion,
                                              const PathPoint& contact) const;
  void CloseContact();
  void CloseStopped();
  void CloseNear();
  void Emit(std::string message, Run* run);
  void CloseRuns();

  const machine::Machine* machine_;
  machine::CheckSettings settings_;
  Pair pair_;
  BlankState* blank_;
  NumberedFindings* findings_;
  std::unique_ptr<PairEngine> engine_;
  PairSweep sweep_;
  std::unique_ptr<PairEngine> swept_engine_;
  std::unique_ptr<PairSweep> swept_;
  std::optional<motion::PairTravel> bound_, swept_bound_;  // of the run at hand
  Patience cross_, cross_swept_, check_swept_;
  RapidReference reference_;
  Run contact_, near_, stopped_;
  bool uncertified_ = false;
  bool touched_ = false;
  bool warned_ = false;
};

}  // namespace ncsim::collision
