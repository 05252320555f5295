// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/sweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/units.h"

namespace ncsim::collision {

namespace {

using motion::Motion;
using motion::Span;

constexpr double kGapOfBound = 0.2;
constexpr double kCutOut = 0.9;           // of what a clearance covers if the travel is even
constexpr double kBestOfBounds = 0.4;     // of what the totals say of a motion
constexpr double kBeyondBox = 0.25;       // of its radius, to be known clear at a dog-leg's end
constexpr double kFirstContact = 1e-3;    // of the motion
constexpr double kOnset = 1e-6;           // of the motion, where it begins
constexpr double kOnsetGap = 1e-5;        // mm
constexpr double kDepthTolerance = 6e-3;  // mm
constexpr int kRefinements = 4000;        // queries a motion for the sake of a number only
constexpr int kDepthQueries = 1000;       // a motion
constexpr int kNearQueries = 60;          // of them near the contact
constexpr int kDepthEvaluations = 3000;   // a query
constexpr double kAstray = 0.01;          // mm off a straight way
constexpr double kLeastWidth = 1e-9;      // of a span: below it the bound does not close

PathPoint Middle(const Span& span) {
  return {0.5 * (span.s0 + span.s1), 0.5 * (span.lag0 + span.lag1)};
}

bool IsAlongAxis(const motion::Translation& translation) {
  const Eigen::Vector3d axis = translation.X_BA.linear().col(2);
  return translation.way.cross(axis).norm() <= kAstray;
}

// The half of a (s, lag) box that matters more: cut the side along which the pair moves further.
std::pair<Span, Span> Halve(const Motion& motion, const motion::PairPath& path, const Span& span) {
  const PathPoint middle = Middle(span);
  Span first = span;
  Span second = span;
  bool cut_lag = false;
  if (span.lag1 > span.lag0) {
    const Span along{span.s0, span.s1, middle.lag, middle.lag};
    const Span across{middle.s, middle.s, span.lag0, span.lag1};
    cut_lag = motion::RelativeBound(motion, path, across, middle.s, middle.lag) >
              motion::RelativeBound(motion, path, along, middle.s, middle.lag);
  }
  if (cut_lag) {
    first.lag1 = second.lag0 = middle.lag;
  } else {
    first.s1 = second.s0 = middle.s;
  }
  return {first, second};
}

}  // namespace

bool SamePose(const motion::JointVector& a, const motion::JointVector& b) {
  return a.size() == b.size() && (a - b).cwiseAbs().maxCoeff() <= 1e-9;
}

PairSweep::PairSweep(const motion::PairPath& path, PairEngine* engine)
    : path_(&path), engine_(engine) {}

void PairSweep::Forget() { known_ = Known{}; }

Eigen::Isometry3d PairSweep::Pose(const Motion& motion, const PathPoint& point) const {
  return path_->path.Pose(motion.At(point.s, point.lag));
}

void PairSweep::Include(const Interval& clearance, const Motion& motion) {
  least_.lower = std::min(least_.lower, clearance.lower);
  if (clearance.upper < least_.upper) {
    least_.upper = clearance.upper;
    least_motion_ = &motion;
  }
}

void PairSweep::Accept(const Motion& motion, double clearance) {
  known_ = {clearance, true, motion.q1()};
}

double PairSweep::Need(const Watch& watch) const { return Need(watch, kInfinity, false); }

double PairSweep::Need(const Sweep& sweep) const {
  return Need(sweep.watch, sweep.result.least.upper, sweep.refinements >= kRefinements);
}

// What an interval must be proven to clear, where `found` is the least that was seen of the motion.
// Above the contact level this serves reported numbers only.
double PairSweep::Need(const Watch& watch, double found, bool tired) const {
  double need = watch.contact;
  // Not known to be below a threshold: prove that it is not.
  if (watch.rounding > 0.0 && found >= watch.rounding) need = std::max(need, watch.rounding);
  if (watch.track && least_.upper < kInfinity) {
    const double seen = std::min(least_.upper, watch.track_ceiling);
    const bool fine = seen < watch.track_below && !tired;
    need = std::max(need, fine ? seen - watch.track_within : (tired ? 0.5 : 0.75) * seen);
  }
  if (tired) return need;
  if (watch.clearance > 0.0 && found >= watch.clearance) {
    need = std::max(need, watch.clearance);
  } else if (watch.clearance > 0.0) {
    // Known to be: follow the least clearance of the run.
    const double run = std::min(watch.run_least, found);
    need = std::max(need, run - std::max(0.05, 0.1 * run));
  }
  return need;
}

SweepResult PairSweep::Check(const Motion& motion, const Watch& watch, const TravelPlace& place) {
  if (!SamePose(known_.q, motion.q0())) Forget();
  const Span whole = motion::Whole(motion);
  Sweep sweep;
  sweep.motion = &motion;
  sweep.watch = watch;
  sweep.place = place;
  sweep.result.least = {kInfinity, kInfinity};
  if (!known_.outside && !Start(&sweep)) {
    Forget();
    known_.q = motion.q1();
    return sweep.result;
  }
  if (known_.outside) {
    const std::optional<double> passed = PassAtOnce(&sweep);
    if (passed.has_value()) return Pass(*passed, &sweep);
  }
  Cover(whole, &sweep);
  const SweepResult& result = sweep.result;
  if (result.contact || result.uncertified) {
    Forget();
    known_.q = motion.q1();
    if (result.contact && whole.lag1 > 0.0 && watch.find_first) {
      return FirstWithoutLag(result, motion, watch);
    }
    return result;
  }
  Arrive(sweep.end, sweep);
  if (watch.track) least_.lower = std::min(least_.lower, result.least.lower);
  return result;
}

// The clearance all the way, where what is known at the start leaves enough of it, or what the tool
// sweeps on a straight way, or a look into the middle of a dog-leg's box.
std::optional<double> PairSweep::PassAtOnce(Sweep* sweep) {
  const Motion& motion = *sweep->motion;
  const TravelPlace& place = sweep->place;
  const double need = Need(*sweep);
  const double spare = known_.clearance - need;
  bool hopeless = false;  // no bound is that much less than that of the totals
  if (place.travel != nullptr) {
    const double most = place.travel->Between(place.at, place.at + 1);
    if (spare > most) return known_.clearance - most;
    hopeless = spare < kBestOfBounds * most;
  }
  std::optional<motion::Translation> translation;
  if (!hopeless || path_->revolved) {
    translation = place.travel != nullptr ? place.travel->TranslationOf(place.at)
                                          : motion::TranslationOf(motion, *path_);
  }
  const Span whole = motion::Whole(motion);
  double bound = kInfinity;
  if (translation.has_value()) {
    bound = translation->way.norm() + translation->astray;
  } else if (!hopeless) {
    bound = motion::RelativeBound(motion, *path_, whole, 0.0, whole.lag0);
  }
  if (spare > bound) return known_.clearance - bound;
  if (!translation.has_value() || translation->astray > kAstray) return PassInBox(*sweep, need);
  if (!path_->revolved) return std::nullopt;
  if (motion::IsRapid(motion)) return ClearAllTheWay(*translation, need);
  // How deep a feed goes is looked at. Where it may cut, it mostly touches, but for holes.
  const bool cuts = sweep->watch.contact < 0.0;
  if (cuts && !IsAlongAxis(*translation)) return std::nullopt;
  return ClearAllTheWay(*translation, std::max(need, 0.0));
}

// A dog-leg's poses are nearer to the middle of its box than to any of each other: one look there
// often is enough.
std::optional<double> PairSweep::PassInBox(const Sweep& sweep, double need) {
  const TravelPlace& place = sweep.place;
  if (place.travel == nullptr || (sweep.watch.track && !has_least())) return std::nullopt;
  const auto around = place.travel->AroundDogLeg(place.at);
  if (!around.has_value()) return std::nullopt;
  const double enough = need + around->radius;
  const auto clearance =
      Explore(*place.travel, *around, enough, kBeyondBox * around->radius + kContactResolution);
  if (!clearance.has_value() || *clearance <= enough) return std::nullopt;
  return *clearance - around->radius;
}

// A motion that is clear by `clearance` all the way. What was seen at its start stays seen.
SweepResult PairSweep::Pass(double clearance, Sweep* sweep) {
  Arrive(clearance, *sweep);
  sweep->result.least.lower = clearance;
  return sweep->result;
}

// At the end of a motion without contact, clear by `clearance` there. Where even the greatest depth
// is no contact, the pair may be inside each other by now.
void PairSweep::Arrive(double clearance, const Sweep& sweep) {
  known_.clearance = clearance;
  known_.q = sweep.motion->q1();
  const double contact = sweep.watch.contact;
  if (contact < 0.0 && contact <= engine_->floor()) known_.outside = false;
  if (sweep.watch.track) least_.lower = std::min(least_.lower, clearance);
}

// The least clearance of a straight way, in one look, if it is what is needed.
std::optional<double> PairSweep::ClearAllTheWay(const motion::Translation& translation,
                                                double need) {
  if (!(translation.astray <= kAstray)) return std::nullopt;
  ++queries_;
  const std::optional<double> clearance =
      engine_->ClearanceAllTheWay(translation.X_BA, translation.way, need + translation.astray);
  if (!clearance.has_value() || !(*clearance - translation.astray > need)) return std::nullopt;
  return *clearance - translation.astray;
}

// Where nothing is known of the start: is one body inside the other, or in contact? From a start
// that is neither, no body gets inside another without contact on the way.
bool PairSweep::Start(Sweep* sweep) {
  std::optional<Interval> clearance = Query(Span{0.0, 0.0, 0.0, 0.0}, 0.0, sweep);
  sweep->result.uncertified = !clearance.has_value();
  if (!clearance.has_value()) return false;
  if (clearance->lower > sweep->watch.contact &&
      engine_->Contained(Pose(*sweep->motion, PathPoint{}))) {
    clearance = Interval{engine_->floor(), engine_->floor()};
    Observe(*clearance, PathPoint{}, sweep);
  }
  sweep->result.contact = clearance->lower <= sweep->watch.contact;
  if (sweep->result.contact) return false;
  known_.outside = clearance->lower > engine_->floor();
  known_.clearance = clearance->lower;
  return true;
}

SweepResult PairSweep::Probe(const Motion& motion, const Watch& watch) {
  const Known before = known_;
  Watch untracked = watch;
  untracked.track = false;
  const SweepResult result = Check(motion, untracked);
  known_ = before;
  return result;
}

// A contact of the lag box is worth more where the polyline has it too.
SweepResult PairSweep::FirstWithoutLag(const SweepResult& with_lag, const Motion& motion,
                                       const Watch& watch) {
  Sweep sweep;
  sweep.motion = &motion;
  sweep.watch = watch;
  sweep.watch.track = false;
  sweep.watch.clearance = 0.0;
  sweep.result.least = {kInfinity, kInfinity};
  Cover(Span{0.0, 1.0, 0.0, 0.0}, &sweep);
  const motion::JointVector q = motion.q1();
  Forget();
  known_.q = q;
  return sweep.result.contact ? sweep.result : with_lag;
}

std::optional<Interval> PairSweep::Query(const Span& span, double bound, Sweep* sweep) {
  const PathPoint middle = Middle(span);
  const Eigen::Isometry3d X_BA = Pose(*sweep->motion, middle);
  const double need = Need(*sweep);
  DistanceGoal goal;
  goal.relative_gap = Gap();
  goal.floor = std::max(need, engine_->floor());
  goal.stop_below = sweep->watch.contact;
  // Whatever the answer is, it is worth no more than what the pair may move by.
  const double fine = sweep->watch.track ? 0.25 * sweep->watch.track_within : kInfinity;
  goal.gap = std::max(goal.gap, std::min(kGapOfBound * bound, fine));
  if (!sweep->watch.track || has_least()) {
    // Inside a motion a proof is enough; at its end, what is left serves the motions to come.
    goal.stop_above = span.s1 < 1.0 ? need + 1.25 * bound + kContactResolution
                                    : std::max(need, 0.0) + 2.0 * bound + engine_->Budget(need);
  }
  ++queries_;
  const std::optional<Interval> clearance = engine_->Clearance(X_BA, goal);
  if (!clearance.has_value()) return clearance;
  Observe(*clearance, middle, sweep);
  return clearance;
}

void PairSweep::Observe(const Interval& clearance, const PathPoint& at, Sweep* sweep) {
  if (clearance.upper < sweep->result.least.upper) {
    sweep->result.least.upper = clearance.upper;
    sweep->result.least_at = at;
  }
  See(clearance.upper, *sweep->motion, sweep->watch.track);
}

void PairSweep::See(double clearance, const Motion& motion, bool track) {
  if (!track || clearance >= least_.upper) return;
  least_.upper = clearance;
  least_motion_ = &motion;
}

bool PairSweep::Accept(const Span& span, const Span& whole, const Interval& clearance, double bound,
                       Sweep* sweep) {
  const double proven = clearance.lower - bound;
  if (proven <= sweep->watch.contact) return false;
  if (proven <= Need(*sweep) && bound > kContactResolution) {
    ++sweep->refinements;
    return false;
  }
  sweep->result.least.lower = std::min(sweep->result.least.lower, proven);
  if (span.s1 == whole.s1) sweep->end = std::min(sweep->end, proven);
  return true;
}

// What is left to look at: with what the clearance covers cut out of the middle, where that is
// worth it; else both halves.
void PairSweep::Split(const Span& span, double clearance, double bound, Sweep* sweep) {
  const double half = 0.5 * (span.s1 - span.s0);
  const double part = kCutOut * (clearance - std::max(sweep->watch.contact, Need(*sweep))) / bound;
  if (part > 0.1) {
    const PathPoint middle = Middle(span);
    const Span clear{middle.s - part * half, middle.s + part * half, span.lag0, span.lag1};
    const double proven =
        clearance - motion::RelativeBound(*sweep->motion, *path_, clear, middle.s, middle.lag);
    if (proven > sweep->watch.contact && proven > Need(*sweep)) {
      sweep->result.least.lower = std::min(sweep->result.least.lower, proven);
      stack_.push_back({clear.s1, span.s1, span.lag0, span.lag1});
      stack_.push_back({span.s0, clear.s0, span.lag0, span.lag1});
      return;
    }
  }
  const auto [first, second] = Halve(*sweep->motion, *path_, span);
  stack_.push_back(second);
  stack_.push_back(first);
}

void PairSweep::Cover(const Span& whole, Sweep* sweep) {
  SweepResult& result = sweep->result;
  stack_.assign(1, whole);
  while (!stack_.empty()) {
    const Span span = stack_.back();
    stack_.pop_back();
    // Spans come from left to right: a short one may still be the first of many that are not clear.
    if (result.contact && result.first.s - span.s0 <= kFirstContact) continue;
    const PathPoint middle = Middle(span);
    const double bound = motion::RelativeBound(*sweep->motion, *path_, span, middle.s, middle.lag);
    const std::optional<Interval> clearance = Query(span, bound, sweep);
    if (!clearance.has_value() || !std::isfinite(bound) ||
        ++sweep->poses > sweep->watch.max_poses) {
      result.uncertified = true;
      return;
    }
    if (Accept(span, whole, *clearance, bound, sweep)) continue;
    const bool unresolved =
        bound <= kContactResolution && clearance->lower - bound <= sweep->watch.contact;
    if (clearance->upper <= sweep->watch.contact || unresolved) {
      result.contact = true;
      result.first = middle;
      if (!sweep->watch.find_first) return;
      // Only what comes before can still matter; with lag, that is all lags up to here.
      stack_.clear();
      const bool boxed = whole.lag1 > whole.lag0;
      stack_.push_back(boxed ? Span{whole.s0, middle.s, whole.lag0, whole.lag1}
                             : Span{span.s0, middle.s, span.lag0, span.lag1});
      continue;
    }
    if (span.s1 - span.s0 < kLeastWidth && span.lag1 - span.lag0 < kLeastWidth) {
      result.uncertified = true;
      return;
    }
    Split(span, clearance->lower, bound, sweep);
  }
}

std::optional<Interval> PairSweep::At(const Motion& motion, const PathPoint& point, double enough,
                                      double gap) {
  DistanceGoal goal;
  goal.stop_above = enough;
  goal.gap = std::max(goal.gap, gap);
  goal.max_evaluations = kDepthEvaluations;
  ++queries_;
  return engine_->Solid(Pose(motion, point), goal);
}

PathPoint PairSweep::Onset(const Motion& motion, const PathPoint& first, double contact) {
  const auto touches = [&](double s) {
    DistanceGoal goal;
    goal.gap = kOnsetGap;
    ++queries_;
    const auto clearance = engine_->Clearance(Pose(motion, {s, first.lag}), goal);
    return clearance.has_value() && clearance->upper <= contact + 2.0 * kOnsetGap;
  };
  double clear = std::max(0.0, first.s - kFirstContact);
  double hit = first.s;
  if (touches(clear) || !touches(hit)) return first;
  while (hit - clear > kOnset) {
    const double middle = 0.5 * (clear + hit);
    (touches(middle) ? hit : clear) = middle;
  }
  return {hit, first.lag};
}

Interval PairSweep::Deepest(const Motion& motion, const PathPoint& contact, bool with_lag,
                            double known, int* budget, PathPoint* at) {
  const Span box = motion::Whole(motion);
  Span whole = box;
  if (!with_lag) whole.lag0 = whole.lag1 = 0.0;
  // A small contact on a long way: what is deepest near it is found first.
  Span near = whole;
  near.s0 = std::max(whole.s0, contact.s - kFirstContact);
  near.s1 = std::min(whole.s1, contact.s + kFirstContact);
  Deepening search{known, {kInfinity, kInfinity}, at};
  if (*budget > 0) Deepen(motion, near, kNearQueries, &search);
  search.best.lower = kInfinity;
  Deepen(motion, whole, std::min(kDepthQueries, *budget), &search);
  *budget -= search.queries;
  if (whole.lag1 < box.lag1) search.best.lower = engine_->floor();
  return search.best;
}

// Best first; leaves a lower bound of the whole span in `search`.
void PairSweep::Deepen(const Motion& motion, const Span& whole, int queries, Deepening* search) {
  struct Piece {
    double lower;
    Span span;
    bool operator<(const Piece& o) const { return lower > o.lower; }
  };
  Interval& best = search->best;
  std::vector<Piece> heap;
  const int last = search->queries + queries;
  const auto look = [&](const Span& span) {
    const PathPoint middle = Middle(span);
    const double bound = motion::RelativeBound(motion, *path_, span, middle.s, middle.lag);
    const std::optional<Interval> clearance =
        At(motion, middle, search->limit - kDepthTolerance + bound, 0.25 * bound);
    ++search->queries;
    if (!clearance.has_value()) {
      best.lower = engine_->floor();
      return;
    }
    if (clearance->upper < best.upper) {
      best.upper = clearance->upper;
      *search->at = middle;
      search->limit = std::min(search->limit, best.upper);
    }
    heap.push_back({std::max(clearance->lower - bound, engine_->floor()), span});
    std::push_heap(heap.begin(), heap.end());
  };
  look(whole);
  // The ends are where a plunge is deepest.
  look({whole.s1, whole.s1, whole.lag0, whole.lag0});
  while (!heap.empty() && heap.front().lower < search->limit - kDepthTolerance &&
         search->queries < last) {
    const Piece piece = heap.front();
    std::pop_heap(heap.begin(), heap.end());
    heap.pop_back();
    if (piece.span.s1 <= piece.span.s0 && piece.span.lag1 <= piece.span.lag0) {
      best.lower = std::min(best.lower, piece.lower);
      continue;
    }
    const auto [first, second] = Halve(motion, *path_, piece.span);
    look(first);
    look(second);
  }
  for (const Piece& piece : heap) best.lower = std::min(best.lower, piece.lower);
}

}  // namespace ncsim::collision
