// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/pair_monitor.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/collision/witness.h"

namespace ncsim::collision {

namespace {

using motion::Motion;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kSweptPoses = 64;  // of one motion, before the pair itself is looked at
// A contact that the kernel finds deeper than this must be seen by FCL on circumscribed meshes too.
constexpr double kConfirmDepth = 0.02;

std::unique_ptr<PairEngine> EngineOf(const Pair& pair) {
  return pair.tool ? MakeEngine(pair.tool, pair.b) : MakeEngine(pair.mesh_a, pair.b);
}

template <class AnyPair>
motion::PairPath PathOf(const machine::Machine& machine, const AnyPair& pair) {
  return motion::PairPath(machine.tree, pair.extent_a(), pair.link_b(),
                          machine.five_axis ? &*machine.five_axis : nullptr);
}

motion::PairPath PathOfPair(const machine::Machine& machine, const Pair& pair) {
  motion::PairPath path = PathOf(machine, pair);
  path.revolved = pair.tool != nullptr;
  return path;
}

}  // namespace

PairMonitor::PairMonitor(const machine::Machine& machine, const machine::CheckSettings& settings,
                         Pair pair, BlankState* blank, NumberedFindings* findings)
    : machine_(&machine),
      settings_(settings),
      pair_(std::move(pair)),
      blank_(blank),
      findings_(findings),
      engine_(EngineOf(pair_)),
      sweep_(PathOfPair(machine, pair_), engine_.get()) {
  if (pair_.swept == nullptr) return;
  swept_engine_ = MakeEngine(pair_.swept);
  swept_ = std::make_unique<PairSweep>(PathOf(machine, *pair_.swept), swept_engine_.get());
}

bool PairMonitor::has_clearance() const {
  if (pair_.role != PairRole::kNeverTouch || uncertified_) return false;
  if (touched_ && !engine_->has_depth()) return false;
  return std::isfinite(sweep_.least().lower) && std::isfinite(sweep_.least().upper);
}

void PairMonitor::Pause() {
  CloseRuns();
  sweep_.Forget();
  if (swept_ != nullptr) swept_->Forget();
  reference_.Reset();
  warned_ = false;
}

void PairMonitor::OnRun(const motion::Travel& travel, std::uint64_t number) {
  bound_.emplace(sweep_.path(), travel);
  if (swept_ != nullptr) swept_bound_.emplace(swept_->path(), travel);
  for (std::size_t i = 0; i < travel.size();) {
    const std::size_t next = Cross(travel, i, number + i);
    if (next > i) {
      Passed(travel, i, next);
      i = next;
    } else {
      OnMotion(travel[i], number + i);
      ++i;
    }
  }
}

// Motions that are clear, and by so much that no rule has anything to say: the first one that may
// not be. What is asked for at the first holds for all, since a blank asks for less once it is cut.
std::size_t PairMonitor::Cross(const motion::Travel& travel, std::size_t begin,
                               std::uint64_t number) {
  Judgement judgement =
      Judge(pair_.role, travel[begin], settings_, blank_, number, 0.0, engine_->floor());
  if (!judgement.checked || warned_) return begin;
  Watch& watch = judgement.watch;
  if (watch.clearance > 0.0) watch.rounding = travel.corner_rounding();
  if (sweep_.has_least()) {
    const std::size_t end = CrossSwept(travel, begin, watch);
    if (end > begin) return end;
  }
  if (!cross_.Ready()) return begin;
  const std::size_t end = sweep_.Cross(travel, *bound_, begin, watch).end;
  end > begin ? cross_.Helped() : cross_.Failed();
  return end;
}

// Most motions of most pairs of links are settled by the swept pair, without a look at the rotary
// joint that turns most.
std::size_t PairMonitor::CrossSwept(const motion::Travel& travel, std::size_t begin,
                                    const Watch& watch) {
  if (swept_ == nullptr || !cross_swept_.Ready()) return begin;
  Watch whole;
  whole.contact = std::max(0.0, sweep_.Need(watch));
  const PairSweep::Crossing crossing = swept_->Cross(travel, *swept_bound_, begin, whole);
  if (crossing.end == begin) {
    cross_swept_.Failed();
    return begin;
  }
  cross_swept_.Helped();
  if (watch.track) sweep_.Include({crossing.least, kInfinity}, travel[begin].where);
  sweep_.Accept(travel[crossing.end - 1], swept_->known_clearance());
  return crossing.end;
}

bool PairMonitor::ClearWhenSwept(const Motion& motion, const Watch& watch) {
  if (swept_ == nullptr || !sweep_.has_least() || !check_swept_.Ready()) return false;
  Watch whole;
  whole.contact = std::max(0.0, sweep_.Need(watch));
  whole.find_first = false;
  whole.max_poses = kSweptPoses;
  const SweepResult result = swept_->Check(motion, whole);
  if (result.contact || result.uncertified) {
    check_swept_.Failed();
    return false;
  }
  check_swept_.Helped();
  if (watch.track) sweep_.Include({result.least.lower, kInfinity}, motion.where);
  sweep_.Accept(motion, swept_->known_clearance());
  return true;
}

// Motions without contact.
void PairMonitor::Passed(const motion::Travel& travel, std::size_t begin, std::size_t end) {
  CloseRuns();
  if (pair_.role != PairRole::kFlutesPart && pair_.role != PairRole::kThinShankPart) return;
  for (std::size_t i = begin; i < end; ++i) {
    if (IsRapid(travel[i])) {
      reference_.OnRapid(travel[i].facts.cycle, 0.0);
    } else {
      reference_.OnFeed(0.0);
    }
  }
}

void PairMonitor::OnMotion(const Motion& motion, std::uint64_t number) {
  OnSpindleStopped(motion, number);
  const double allowed = AllowedDepth(motion);
  Judgement judgement =
      Judge(pair_.role, motion, settings_, blank_, number, allowed, engine_->floor());
  if (!judgement.checked || warned_) {
    CloseRuns();
    sweep_.Forget();
    return;
  }
  judgement.watch.run_least = near_.blocks.open() ? near_.least : kInfinity;
  judgement.watch.find_first = !contact_.blocks.open() || pair_.role == PairRole::kOtherBlank;
  if (ClearWhenSwept(motion, judgement.watch)) {
    CloseRuns();
    return;
  }
  const SweepResult result = sweep_.Check(motion, judgement.watch);
  if (result.uncertified) {
    ReportOnce(Rule::kUncertified, motion, number,
               "clearance of " + Spoken(pair_.names.front()) + " and " +
                   Spoken(pair_.names.back()) + " could not be computed");
  } else if (result.contact) {
    OnContact(motion, number, judgement, result);
  } else {
    OnClear(motion, number, judgement, result);
  }
  if (!IsRapid(motion)) {
    const double seen = contact_.blocks.open() ? contact_.least : result.least.upper;
    reference_.OnFeed(std::max(0.0, -seen));
  }
}

// The depth that a rapid may keep: it is where the feed before it left the tool.
double PairMonitor::AllowedDepth(const Motion& motion) {
  const bool cutting =
      pair_.role == PairRole::kFlutesPart || pair_.role == PairRole::kThinShankPart;
  if (!cutting || !IsRapid(motion)) return 0.0;
  double start = 0.0;
  if (reference_.wants_start()) {
    const std::optional<Interval> at = sweep_.At(motion, {0.0, 0.0}, 0.0);
    if (at.has_value() && std::isfinite(at->upper)) start = std::max(0.0, -at->upper);
  }
  return reference_.OnRapid(motion.facts.cycle, start);
}

void PairMonitor::OnSpindleStopped(const Motion& motion, std::uint64_t number) {
  const bool applies =
      pair_.role == PairRole::kFlutesPart || (pair_.role == PairRole::kFlutesBlank && !blank_->cut);
  if (!applies || !IsFeed(motion) || motion.facts.spindle_on) {
    CloseStopped();
    return;
  }
  Watch touch;
  touch.find_first = !stopped_.blocks.open();
  const SweepResult result = sweep_.Probe(motion, touch);
  if (!result.contact) {
    CloseStopped();
    return;
  }
  if (!stopped_.blocks.open()) {
    Open(motion, number, Rule::kSpindleStopped, Severity::kError, result.first, &stopped_);
  }
  stopped_.least = std::min(stopped_.least, std::min(0.0, result.least.upper));
  stopped_.blocks.Add(motion.where);
}

void PairMonitor::OnContact(const Motion& motion, std::uint64_t number, const Judgement& judgement,
                            const SweepResult& result) {
  CloseNear();
  Severity severity = judgement.severity;
  if (pair_.role == PairRole::kFlutesBlank && IsFeed(motion)) {
    OnFirstCut(number, result);
    return;
  }
  if (blank_ != nullptr && !Uncut(*blank_, number, result.first.s)) {
    if (pair_.role == PairRole::kThinShankBlank) {
      CloseContact();
      return;
    }
    severity = Severity::kWarning;
  }
  if (contact_.blocks.open() && (contact_.blocks.finding().rule != judgement.rule ||
                                 contact_.blocks.finding().severity != severity)) {
    CloseContact();
  }
  const bool first = !contact_.blocks.open();
  if (first) {
    Open(motion, number, judgement.rule, severity, result.first, &contact_);
    contact_.words.tolerance = judgement.tolerance;
    if (engine_->has_depth()) contact_.least = std::min(0.0, result.least.upper);
  }
  touched_ = true;
  contact_.blocks.Add(motion.where);
  Deepen(motion, result.first, judgement.watch.track, &contact_);
  // One warning a tool is enough: until the stock is simulated there is nothing more to say.
  if (pair_.role == PairRole::kOtherBlank && severity == Severity::kWarning) {
    CloseContact();
    warned_ = true;
  }
}

void PairMonitor::OnFirstCut(std::uint64_t number, const SweepResult& result) {
  CloseContact();
  blank_->cut = true;
  blank_->motion = number;
  blank_->s = result.first.s;
}

void PairMonitor::Deepen(const Motion& motion, const PathPoint& contact, bool track, Run* run) {
  if (!engine_->has_depth()) return;
  const double known = run->blocks.blocks() > 1 ? run->least : kInfinity;
  PathPoint at;
  const Interval depth =
      sweep_.Deepest(motion, contact, run->with_lag, known, &run->depth_budget, &at);
  run->least = std::min(run->least, depth.upper);
  if (track) sweep_.Include({depth.lower, depth.upper}, motion.where);
  if (run->blocks.blocks() == 1 && depth.upper < -kConfirmDepth) Confirm(motion, run->number, at);
}

void PairMonitor::Confirm(const Motion& motion, std::uint64_t number, const PathPoint& at) {
  if (engine_->Confirms(sweep_.Pose(motion, at))) return;
  ReportOnce(Rule::kUncertified, motion, number,
             "the two collision engines disagree about a contact of " +
                 Spoken(pair_.names.front()) + " and " + Spoken(pair_.names.back()));
}

void PairMonitor::OnClear(const Motion& motion, std::uint64_t number, const Judgement& judgement,
                          const SweepResult& result) {
  CloseContact();
  const Watch& watch = judgement.watch;
  const bool rounded = watch.rounding > 0.0 && result.least.lower <= watch.rounding;
  const bool near = watch.clearance > 0.0 && result.least.upper < watch.clearance;
  if (!rounded && !near) {
    CloseNear();
    return;
  }
  const Rule rule = rounded ? Rule::kUncertified : Rule::kNearMiss;
  if (near_.blocks.open() && near_.blocks.finding().rule != rule) CloseNear();
  if (!near_.blocks.open())
    Open(motion, number, rule, Info(rule).severity, result.least_at, &near_);
  near_.words.tolerance = rounded ? watch.rounding : watch.clearance;
  if (result.least.upper < near_.least) {
    near_.least = result.least.upper;
    Place(motion, result.least_at, &near_);
  }
  near_.blocks.Add(motion.where);
}

void PairMonitor::ReportOnce(Rule rule, const Motion& motion, std::uint64_t number,
                             std::string message) {
  if (uncertified_) return;
  uncertified_ = true;
  Finding finding = MakeFinding(rule, motion.where, std::move(message));
  finding.bodies = pair_.names;
  findings_->emplace_back(number, std::move(finding));
}

void PairMonitor::Open(const Motion& motion, std::uint64_t number, Rule rule, Severity severity,
                       const PathPoint& at, Run* run) {
  *run = Run();
  run->number = number;
  Finding finding = MakeFinding(rule, motion.where, "");
  finding.severity = severity;
  finding.bodies = pair_.names;
  run->blocks.Start(std::move(finding));
  run->with_lag = at.lag > 0.0;
  run->words.rule = rule;
  run->words.severity = severity;
  run->words.has_depth = engine_->has_depth();
  run->words.only_lag = run->with_lag;
  Place(motion, at, run);
  if (run != &near_) run->blocks.finding().points = PointsOf(motion, at);
}

std::vector<std::array<double, 3>> PairMonitor::PointsOf(const Motion& motion,
                                                         const PathPoint& contact) const {
  const std::optional<Witness> witness = FindWitness(pair_, sweep_.Pose(motion, contact));
  if (!witness) return {};
  const motion::JointVector q = motion.At(contact.s, contact.lag);
  const Eigen::Isometry3d X_MB = machine_->tree.Pose(pair_.link_b(), q);
  std::vector<std::array<double, 3>> points;
  for (const Eigen::Vector3d& p_B : {witness->a, witness->b}) {
    const Eigen::Vector3d p = machine_->Coordinates(X_MB * p_B, q);
    points.push_back({p.x(), p.y(), p.z()});
  }
  if (pair_.b->name == pair_.names.front()) std::swap(points.front(), points.back());
  return points;
}

void PairMonitor::Place(const Motion& motion, const PathPoint& at, Run* run) {
  Finding& finding = run->blocks.finding();
  finding.where = motion.where;
  finding.axes = machine_->Readout(motion.At(at.s, at.lag));
  finding.time_s = motion.start_time + motion.ElapsedTime(at.s, at.lag);
}

void PairMonitor::CloseContact() {
  if (!contact_.blocks.open()) return;
  contact_.words.depth = std::max(0.0, -contact_.least);
  Finding& finding = contact_.blocks.finding();
  if (engine_->has_depth()) finding.clearance_mm = -contact_.words.depth;
  Emit(DescribeContact(pair_, contact_.words, ToString(finding.axes)), &contact_);
}

void PairMonitor::CloseStopped() {
  if (!stopped_.blocks.open()) return;
  const std::string where = ToString(stopped_.blocks.finding().axes);
  Emit(DescribeContact(pair_, stopped_.words, where), &stopped_);
}

void PairMonitor::CloseNear() {
  if (!near_.blocks.open()) return;
  Finding& finding = near_.blocks.finding();
  const double least = std::max(0.0, near_.least);
  finding.clearance_mm = least;
  const std::string& a = pair_.names.front();
  const std::string limit = Short(near_.words.tolerance, 3) + " mm";
  Emit(Spoken(a) + " " + Verb(a, "comes", "come") + " within " + Short(least, 2) + " mm of " +
           Spoken(pair_.names.back()) +
           (finding.rule == Rule::kNearMiss
                ? " (clearance " + limit + ")"
                : ", and the control may round the corner by " + limit + ",") +
           " at " + ToString(finding.axes),
       &near_);
}

void PairMonitor::Emit(std::string message, Run* run) {
  run->blocks.finding().message = std::move(message);
  findings_->emplace_back(run->number, run->blocks.Take());
  *run = Run();
}

void PairMonitor::CloseRuns() {
  CloseContact();
  CloseNear();
  CloseStopped();
}

}  // namespace ncsim::collision
