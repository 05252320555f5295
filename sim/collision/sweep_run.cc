// SPDX-License-Identifier: BSD-3-Clause
// PairSweep over runs of motions: looks whose clearances cover many of them at once.
#include <algorithm>
#include <cmath>

#include "sim/collision/sweep.h"

namespace ncsim::collision {

namespace {

constexpr std::size_t kMemory = 20000;  // poses of a pair
constexpr double kFarthest = 1e5;       // mm, worth looking ahead
constexpr double kOfAhead = 0.9;        // neighbourhoods up to this part of it are looked at
constexpr double kBeyond = 0.25;        // of what is asked for ahead, around a pose
constexpr double kStart = 0.02;         // mm, of clearance at a start that is near anyway
// How closely a clearance is worked out, in parts of what it is beyond the need: less takes longer.
constexpr double kGapOfSpare = 0.4;
constexpr double kGapOfMeshes = 0.5;
constexpr double kGapAround = 0.1;

// Of the grid whose places serve for clearances of `ahead` mm.
int GridOf(double ahead) { return std::ilogb(std::max(0.4 * ahead, 1e-3)); }

}  // namespace

double PairSweep::Gap() const { return engine_->has_depth() ? kGapOfSpare : kGapOfMeshes; }

// The clearance at X_BA, a pose of the motion, as far as `enough` beyond what is needed; the first
// one of all to its end, since what it shows is held against what is needed from then on.
std::optional<Interval> PairSweep::Look(const motion::Motion& motion, const Eigen::Isometry3d& X_BA,
                                        const Watch& watch, double enough) {
  DistanceGoal goal;
  goal.relative_gap = Gap();
  goal.floor = Spared(watch);
  if (!watch.track || has_least()) goal.stop_above = goal.floor + enough;
  if (!watch.track) goal.stop_below = goal.floor;  // no place to stand on
  ++queries_;
  const std::optional<Interval> clearance = engine_->Clearance(X_BA, goal);
  if (!clearance.has_value()) return clearance;
  See(clearance->upper, motion, watch.track);
  Expect(clearance->lower - Spared(watch));
  return clearance;
}

// Far beyond what was asked for: ask for more next time. Not there: for what there is.
void PairSweep::Expect(double spare) {
  ahead_ = spare >= ahead_ ? std::max(std::min(2.0 * ahead_, kFarthest), engine_->thrift() * spare)
                           : engine_->thrift() * std::max(0.0, spare);
}

double PairSweep::Spared(const Watch& watch) const { return std::max(0.0, Need(watch)); }

// Takes its stand at the start of a motion: clear of what is needed, and neither body inside the
// other?
bool PairSweep::Stand(const motion::Motion& motion, const Watch& watch, double enough) {
  const Eigen::Isometry3d X_BA = path_->path.Pose(motion.q0());
  const std::optional<Interval> clearance = Look(motion, X_BA, watch, enough);
  if (!clearance.has_value() || clearance->lower <= Spared(watch) || engine_->Contained(X_BA)) {
    return false;
  }
  known_ = {clearance->lower, true, motion.q0()};
  return true;
}

// As Stand; or in the middle of a stretch around the motion, which says something of all of it.
std::optional<PairSweep::Step> PairSweep::Settle(const motion::PairTravel& bound,
                                                 const motion::Motion& motion, std::size_t at,
                                                 const Watch& watch) {
  const int grid = GridOf(ahead_);
  for (std::size_t level = bound.levels(); level-- > 0 && (!watch.track || has_least());) {
    const motion::PairTravel::Neighbourhood& around = Stretch(bound, at, level, grid);
    if (around.radius >= kOfAhead * ahead_) continue;
    const double enough = Spared(watch) + around.radius;
    const std::optional<double> clearance = Explore(bound, around, enough, kBeyond * ahead_);
    if (!clearance.has_value() || *clearance <= enough ||
        engine_->Contained(bound.PoseOf(around))) {
      break;
    }
    level_ = level;
    const double left = *clearance - around.radius;
    return Step{around.end, left, left};
  }
  if (!Stand(motion, watch, ahead_)) return std::nullopt;
  return Step{at, known_.clearance, known_.clearance};
}

bool PairSweep::StartsClear(const motion::Motion& motion) {
  const bool known = known_.outside && SamePose(known_.q, motion.q0());
  return (known && known_.clearance > 0.0) || Stand(motion, Watch(), kStart);
}

// A clearance near one pose of the grid; programs come back to it.
std::optional<double> PairSweep::Recall(const motion::PairTravel::Neighbourhood& around) const {
  if (!around.key.has_value()) return std::nullopt;
  const auto found = memory_.find(*around.key);
  return found == memory_.end() ? std::nullopt : std::optional<double>(found->second);
}

std::optional<double> PairSweep::Explore(const motion::PairTravel& bound,
                                         const motion::PairTravel::Neighbourhood& around,
                                         double enough, double beyond) {
  DistanceGoal goal;
  goal.relative_gap = engine_->has_depth() ? kGapAround : kGapOfMeshes;
  goal.stop_above = enough + beyond;
  if (!around.key.has_value()) goal.stop_below = enough;
  ++queries_;
  const std::optional<Interval> clearance = engine_->Clearance(bound.PoseOf(around), goal);
  if (!clearance.has_value()) return std::nullopt;
  if (around.key.has_value()) {
    if (memory_.size() >= kMemory) memory_.clear();
    memory_[*around.key] = clearance->lower;
  }
  return clearance->lower;
}

// The neighbourhood of a stretch; that of the last one asked for at its level is kept.
const motion::PairTravel::Neighbourhood& PairSweep::Stretch(const motion::PairTravel& bound,
                                                            std::size_t at, std::size_t level,
                                                            int grid) {
  if (stretches_.size() <= level) stretches_.resize(bound.levels());
  Stretched& last = stretches_[level];
  const std::size_t end = bound.StretchEnd(at, level);
  if (last.end != end || last.grid != grid) last = {end, grid, bound.Around(at, level, grid)};
  return last.around;
}

// The motions from `at` on that stay in the neighbourhood of one pose, clear of what is needed. The
// neighbourhood is connected, and the pair is outside each other at `at`, so nothing is contained.
PairSweep::Step PairSweep::Around(const motion::PairTravel& bound, std::size_t at,
                                  std::size_t path_end, const Watch& watch) {
  const int grid = GridOf(ahead_);
  bool explored = false;
  for (std::size_t level = std::min(bound.levels(), level_ + 2); level-- > 0;) {
    if (bound.StretchEnd(at, level) <= path_end) break;  // the path gets further
    const motion::PairTravel::Neighbourhood& around = Stretch(bound, at, level, grid);
    const double enough = Spared(watch) + around.radius;
    std::optional<double> clearance = Recall(around);
    if ((!clearance.has_value() || *clearance <= enough) && around.radius < kOfAhead * ahead_ &&
        !explored) {
      explored = true;
      clearance = Explore(bound, around, enough, kBeyond * ahead_);
    }
    if (clearance.has_value() && *clearance > enough) {
      around_.Helped();
      level_ = level;
      return {around.end, *clearance - around.radius, *clearance - around.radius};
    }
  }
  if (level_ > 0) --level_;
  if (explored) around_.Failed();
  return {at, 0.0, 0.0};
}

// The motions from `at` on that a look at the end of one of them covers backward, with what is left
// of the clearance at `at`. Where that leaves a gap, it is looked into the middle of it: what was
// seen beyond is kept, and serves later.
PairSweep::Step PairSweep::Ahead(const motion::Travel& travel, const motion::PairTravel& bound,
                                 std::size_t at, const Watch& watch) {
  for (;;) {
    const double left = bound.Even(at) ? std::max(0.0, known_.clearance - Spared(watch)) : 0.0;
    std::size_t next = bound.Furthest(at, ahead_ + left);
    if (!ahead_seen_.empty()) {
      const auto [end, clearance] = ahead_seen_.back();
      const Step step = Backward(bound, at, {end, 0.0, clearance}, left > 0.0);
      if (step.least > Spared(watch)) {
        ahead_seen_.pop_back();
        return step;
      }
      const double gap = bound.Between(at, end) - left - (clearance - Spared(watch));
      const std::size_t middle = bound.Furthest(at, 0.5 * gap);
      next = std::min({next, std::max(middle, at + 1), end - 1});
    }
    if (next == at) return {at, 0.0, 0.0};
    const std::optional<Interval> clearance =
        Look(travel[next - 1], bound.Pose(next), watch, ahead_);
    if (!clearance.has_value()) return {at, 0.0, 0.0};
    ahead_seen_.push_back({next, clearance->lower});
  }
}

// What `seen.clearance` says of the motions from `at` to `seen.end`. Where the first of them is
// even, its poses are near to one of its ends, or as far from the one as they may be from the
// other.
PairSweep::Step PairSweep::Backward(const motion::PairTravel& bound, std::size_t at, Step seen,
                                    bool even) const {
  const double whole = seen.clearance - bound.Between(at, seen.end);
  seen.least = whole;
  if (even) {
    const double behind = seen.clearance - bound.Between(at + 1, seen.end);
    seen.least = std::max(whole, std::min(0.5 * (known_.clearance + whole), behind));
  }
  return seen;
}

PairSweep::Crossing PairSweep::Cross(const motion::Travel& travel, const motion::PairTravel& bound,
                                     std::size_t begin, const Watch& watch) {
  Crossing crossing{begin, std::numeric_limits<double>::infinity()};
  if (crossed_ != &bound) {
    ahead_seen_.clear();
    stretches_.clear();
    crossed_ = &bound;
  }
  if (ahead_ <= 0.0) ahead_ = engine_->Budget(Need(watch));
  const bool stands = known_.outside && SamePose(known_.q, travel[begin].q0());
  std::optional<Step> step;
  if (!stands) {
    step = Settle(bound, travel[begin], begin, watch);
    if (!step.has_value()) return crossing;
  }
  if (stands || step->end == begin) step = Onward(travel, bound, begin, watch);
  while (step->end > crossing.end) {
    crossing.end = step->end;
    crossing.least = std::min(crossing.least, step->least);
    known_ = {step->clearance, true, travel[step->end - 1].q1()};
    if (watch.track) least_.lower = std::min(least_.lower, step->least);
    if (crossing.end == travel.size()) break;
    step = Onward(travel, bound, crossing.end, watch);
  }
  return crossing;
}

// From where the pair stands, at the start of motion `at`.
PairSweep::Step PairSweep::Onward(const motion::Travel& travel, const motion::PairTravel& bound,
                                  std::size_t at, const Watch& watch) {
  if (ahead_ <= 0.0) ahead_ = engine_->Budget(Need(watch));
  for (; !ahead_seen_.empty() && ahead_seen_.back().end <= at; ahead_seen_.pop_back()) {
    const auto [end, clearance] = ahead_seen_.back();
    if (end == at) known_.clearance = std::max(known_.clearance, clearance);
  }
  Step step;
  step.end = bound.Furthest(at, known_.clearance - Spared(watch));
  step.least = step.clearance = known_.clearance - bound.Between(at, step.end);
  if (step.end < travel.size() && around_.Ready()) {
    const Step around = Around(bound, at, step.end, watch);
    if (around.end > step.end) step = around;
  }
  return step.end > at ? step : Ahead(travel, bound, at, watch);
}

}  // namespace ncsim::collision
