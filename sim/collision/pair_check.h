// SPDX-License-Identifier: BSD-3-Clause
// One pair over one run of motions: sweeps them, applies the pair's rule, and folds consecutive
// blocks with one fault into a run. Starts from nothing but what it is handed, so runs can be
// checked in any order, at a time, or not at all when the outcome is known.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/collision/contact_rules.h"
#include "sim/collision/engine.h"
#include "sim/collision/pair_outcome.h"
#include "sim/collision/pairs.h"
#include "sim/collision/patience.h"
#include "sim/collision/sweep.h"
#include "sim/machine/machine.h"
#include "sim/motion/smoothing.h"

namespace ncsim::collision {

/// What all checks of a pair share and none changes. The machine outlives it.
struct PairSetup {
  PairSetup(const machine::Machine& machine, const machine::CheckSettings& settings, Pair pair);
  PairSetup(const PairSetup&) = delete;  // `smoothing` holds on to `path`
  PairSetup& operator=(const PairSetup&) = delete;

  const machine::Machine* machine;
  machine::CheckSettings settings;
  Pair pair;
  motion::PairPath path;
  std::optional<motion::PairPath> swept_path;  ///< Of pair.swept, if there is one.
  motion::Smoothing smoothing;
};

/// What passes from one run of motions of a pair to the next.
struct PairCarry {
  /// The least clearance seen so far: above it, no number is worth working out.
  double least = std::numeric_limits<double>::infinity();
  RapidReference reference;
  /// With no gouge asked for: how deep the feeds went that took the flutes into the part, where the
  /// run ended; mm.
  double feeds = 0.0;
  /// The pair has said what there is to say about the cut blank, for this tool.
  bool warned = false;
};

/// Whether a run's outcome depends on more of the runs before it than PairCarry::least: then they
/// are checked in their order.
bool IsSequential(PairRole role);

class PairCheck {
 public:
  /// `number` is that of the travel's first motion among all. `blank` is the pair's, or null. All
  /// references outlive this.
  PairCheck(const PairSetup& setup, const motion::Travel& travel, std::uint64_t number,
            BlankState* blank, PairCarry* carry);

  /// Once.
  PairOutcome Run();

 private:
  /// A fault that goes on.
  struct OpenRun {
    ContactRun run;
    bool open = false;
    bool with_lag = false;
    int depth_budget = 3000;  ///< Poses to look for the deepest one.
  };

  const motion::Motion& motion() const { return (*travel_)[at_]; }
  const Pair& pair() const { return setup_->pair; }
  std::uint64_t number() const { return number_ + at_; }
  std::size_t IndexOf(const motion::Motion* motion) const;
  bool cutting() const;
  void OnMotion();
  Judgement JudgeMotion(double allowed) const;
  SweepResult Sweep(Judgement* judgement);
  bool PassUnknownFeeds();
  bool Cross();
  std::size_t CrossSwept(const Watch& watch);
  bool ClearWhenSwept(const Watch& watch);
  void Passed(std::size_t end);
  void AfterFeed(double depth);
  void OnSpindleStopped();
  double AllowedDepth();
  bool feeds_unknown() const;
  double DepthAt(const motion::Motion& motion, double s);
  double DepthOfFeeds();
  void OnContact(const Judgement& judgement, const SweepResult& result);
  void OnClear(const Judgement& judgement, const SweepResult& result);
  void OnFirstCut(const SweepResult& result);
  void Deepen(const PathPoint& contact, bool track);
  void Confirm(const PathPoint& at);
  void ReportUncertified(std::string why);
  void Open(ContactRun::Kind kind, Rule rule, Severity severity, const PathPoint& at, OpenRun* run);
  void Place(const PathPoint& at, OpenRun* run);
  std::vector<std::array<double, 3>> PointsOf(const PathPoint& contact) const;
  void Close(OpenRun* run);
  void CloseRuns();

  const PairSetup* setup_;
  const motion::Travel* travel_;
  std::uint64_t number_;
  std::size_t at_ = 0;         // the motion at hand
  std::size_t feeds_end_ = 0;  // behind the last feed of the run
  BlankState* blank_;
  PairCarry* carry_;
  std::unique_ptr<PairEngine> engine_;
  PairSweep sweep_;
  motion::PairTravel bound_;
  std::unique_ptr<PairEngine> swept_engine_;
  std::optional<PairSweep> swept_;
  std::optional<motion::PairTravel> swept_bound_;
  Patience cross_, cross_swept_, check_swept_;
  OpenRun contact_, near_, stopped_;
  PairOutcome outcome_;
};

}  // namespace ncsim::collision
