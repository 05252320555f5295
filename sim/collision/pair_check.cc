// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/pair_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/units.h"
#include "sim/collision/contact_text.h"
#include "sim/collision/witness.h"

namespace ncsim::collision {

namespace {

constexpr int kSweptPoses = 64;  // of one motion, before the pair itself is looked at
// A contact that the kernel finds deeper than this must be seen by FCL on circumscribed meshes too.
constexpr double kConfirmDepth = 0.02;

std::unique_ptr<PairEngine> EngineOf(const Pair& pair) {
  return pair.tool ? MakeEngine(pair.tool, pair.b) : MakeEngine(pair.mesh_a, pair.b);
}

const kinematics::FiveAxis* FiveAxisOf(const machine::Machine& machine) {
  return machine.five_axis ? &*machine.five_axis : nullptr;
}

template <class AnyPair>
motion::PairPath PathOf(const machine::Machine& machine, const AnyPair& pair) {
  return motion::PairPath(machine.tree, pair.extent_a(), pair.link_b(), FiveAxisOf(machine));
}

}  // namespace

PairSetup::PairSetup(const machine::Machine& machine_data, const machine::CheckSettings& check,
                     Pair bodies)
    : machine(&machine_data),
      settings(check),
      pair(std::move(bodies)),
      path(PathOf(machine_data, pair)),
      smoothing(machine_data.tree, FiveAxisOf(machine_data), path,
                pair.tool ? std::optional<double>(pair.tool->reach) : std::nullopt,
                pair.b->extent) {
  path.revolved = pair.tool != nullptr;
  if (pair.swept != nullptr) swept_path.emplace(PathOf(machine_data, *pair.swept));
}

bool IsSequential(PairRole role) { return role != PairRole::kNeverTouch; }

PairCheck::PairCheck(const PairSetup& setup, const motion::Travel& travel, std::uint64_t number,
                     BlankState* blank, PairCarry* carry)
    : setup_(&setup),
      travel_(&travel),
      number_(number),
      blank_(blank),
      carry_(carry),
      engine_(EngineOf(setup.pair)),
      sweep_(setup.path, engine_.get()),
      bound_(setup.path, travel) {
  sweep_.Seed(carry->least);
  if (setup.pair.swept == nullptr) return;
  swept_engine_ = MakeEngine(setup.pair.swept);
  swept_.emplace(*setup.swept_path, swept_engine_.get());
  swept_bound_.emplace(*setup.swept_path, travel);
}

PairOutcome PairCheck::Run() {
  if (IsWidened(pair().role)) outcome_.widened = setup_->smoothing.Greatest(*travel_);
  while (at_ < travel_->size()) {
    if (PassUnknownFeeds() || Cross()) continue;
    OnMotion();
    ++at_;
  }
  CloseRuns();
  if (cutting()) {
    const bool inside = DepthAt((*travel_)[travel_->size() - 1], 1.0) > 0.0;
    carry_->feeds = inside ? DepthOfFeeds() : 0.0;
  }
  outcome_.least = sweep_.least();
  // What was handed in was seen elsewhere.
  if (outcome_.least.upper >= carry_->least) outcome_.least.upper = kInfinity;
  carry_->least = std::min(carry_->least, outcome_.least.upper);
  if (outcome_.least.upper < kInfinity) outcome_.least_at = IndexOf(sweep_.least_motion());
  outcome_.queries = sweep_.queries() + (swept_ ? swept_->queries() : 0);
  return std::move(outcome_);
}

std::size_t PairCheck::IndexOf(const motion::Motion* motion) const {
  std::size_t i = 0;
  while (i + 1 < travel_->size() && &(*travel_)[i] != motion) ++i;
  return i;
}

bool PairCheck::cutting() const {
  return pair().role == PairRole::kFlutesPart || pair().role == PairRole::kThinShankPart;
}

Judgement PairCheck::JudgeMotion(double allowed) const {
  Judgement judgement =
      Judge(pair().role, motion(), setup_->settings, blank_, number(), allowed, engine_->floor());
  if (judgement.widened) {
    judgement.watch.rounding = setup_->smoothing.Of(motion(), travel_->tool_length());
  }
  return judgement;
}

// Passes over motions that are clear, and by so much that no rule has anything to say. What is
// asked for at the first holds for all, since a blank asks for less once it is cut.
bool PairCheck::Cross() {
  Judgement judgement = JudgeMotion(0.0);
  if (!judgement.checked || carry_->warned) return false;
  Watch& watch = judgement.watch;
  if (judgement.widened) watch.rounding = outcome_.widened;
  if (cutting()) watch.track = false;  // of rapids no depth is told
  std::size_t end = sweep_.has_least() ? CrossSwept(watch) : at_;
  if (end == at_ && cross_.Ready()) {
    end = sweep_.Cross(*travel_, bound_, at_, watch).end;
    end > at_ ? cross_.Helped() : cross_.Failed();
  }
  if (end == at_) return false;
  Passed(end);
  return true;
}

// Most motions of most pairs of links are settled by the swept pair, without a look at the rotary
// joint that turns most.
std::size_t PairCheck::CrossSwept(const Watch& watch) {
  if (!swept_ || !cross_swept_.Ready()) return at_;
  Watch whole;
  whole.contact = std::max(0.0, sweep_.Need(watch));
  const PairSweep::Crossing crossing = swept_->Cross(*travel_, *swept_bound_, at_, whole);
  if (crossing.end == at_) {
    cross_swept_.Failed();
    return at_;
  }
  cross_swept_.Helped();
  if (watch.track) sweep_.Include({crossing.least, kInfinity}, motion());
  sweep_.Accept((*travel_)[crossing.end - 1], swept_->known_clearance());
  return crossing.end;
}

bool PairCheck::ClearWhenSwept(const Watch& watch) {
  if (!swept_ || !sweep_.has_least() || !check_swept_.Ready()) return false;
  Watch whole;
  whole.contact = std::max(0.0, sweep_.Need(watch));
  whole.find_first = false;
  whole.max_poses = kSweptPoses;
  const SweepResult result = swept_->Check(motion(), whole, {&*swept_bound_, at_});
  if (result.contact || result.uncertified) {
    check_swept_.Failed();
    return false;
  }
  check_swept_.Helped();
  if (watch.track) sweep_.Include({result.least.lower, kInfinity}, motion());
  sweep_.Accept(motion(), swept_->known_clearance());
  return true;
}

// Motions without contact.
void PairCheck::Passed(std::size_t end) {
  CloseRuns();
  for (; cutting() && at_ < end; ++at_) {
    if (IsRapid(motion())) {
      carry_->reference.OnRapid(motion().facts.cycle, 0.0);
    } else {
      AfterFeed(0.0);
    }
  }
  at_ = end;
}

void PairCheck::AfterFeed(double depth) {
  carry_->reference.OnFeed(depth);
  feeds_end_ = at_ + 1;
}

void PairCheck::OnMotion() {
  OnSpindleStopped();
  Judgement judgement = JudgeMotion(AllowedDepth());
  if (!judgement.checked || carry_->warned) {
    CloseRuns();
    sweep_.Forget();
    if (feeds_unknown()) AfterFeed(0.0);
    return;
  }
  judgement.watch.run_least = near_.open ? near_.run.least : kInfinity;
  judgement.watch.find_first =
      !contact_.open || blank_ != nullptr || contact_.run.rule != judgement.rule;
  if (ClearWhenSwept(judgement.watch)) {
    CloseRuns();
    return;
  }
  const SweepResult result = Sweep(&judgement);
  if (result.uncertified) {
    ReportUncertified("clearance of " + Spoken(pair().names.front()) + " and " +
                      Spoken(pair().names.back()) + " could not be computed");
  } else if (result.contact) {
    OnContact(judgement, result);
  } else {
    OnClear(judgement, result);
  }
  if (!IsRapid(motion())) {
    const double seen = contact_.open ? contact_.run.least : result.least.upper;
    AfterFeed(std::max(0.0, -seen));
  }
}

// No gouge was asked for, so nobody has looked how deep the feeds went.
bool PairCheck::feeds_unknown() const {
  return pair().role == PairRole::kFlutesPart && setup_->settings.gouge == machine::GougeMode::kOff;
}

// Passes over feeds on which there is nothing to look at.
bool PairCheck::PassUnknownFeeds() {
  if (!feeds_unknown()) return false;
  std::size_t end = at_;
  while (end < travel_->size() && IsFeed((*travel_)[end]) && (*travel_)[end].facts.spindle_on) {
    ++end;
  }
  if (end == at_) return false;
  CloseRuns();
  sweep_.Forget();
  at_ = end - 1;
  AfterFeed(0.0);
  at_ = end;
  return true;
}

// What is known of the feeds' depth is what the sweeps came upon: enough for most rapids, but no
// ground to fail one.
SweepResult PairCheck::Sweep(Judgement* judgement) {
  const TravelPlace place{&bound_, at_};
  const SweepResult result = sweep_.Check(motion(), judgement->watch, place);
  const bool retreats = cutting() && IsRapid(motion()) && carry_->reference.inside();
  if (!result.contact || !retreats) return result;
  const double depth = DepthOfFeeds();
  const Watch asked = judgement->watch;
  judgement->watch =
      JudgeMotion(carry_->reference.OnFeedsBefore(motion().facts.cycle, depth)).watch;
  if (judgement->watch.contact >= asked.contact) return result;
  judgement->watch.run_least = asked.run_least;
  judgement->watch.find_first = asked.find_first;
  return sweep_.Check(motion(), judgement->watch, place);
}

// The depth that a rapid may keep: it is where the feed before it left the tool.
double PairCheck::AllowedDepth() {
  if (!cutting() || !IsRapid(motion())) return 0.0;
  const bool inside = carry_->reference.wants_start() && !sweep_.StartsClear(motion());
  const double start = inside ? DepthAt(motion(), 0.0) : 0.0;
  return carry_->reference.OnRapid(motion().facts.cycle, start);
}

double PairCheck::DepthAt(const motion::Motion& motion, double s) {
  const std::optional<Interval> at = sweep_.At(motion, {s, 0.0}, 0.0);
  return at.has_value() && std::isfinite(at->upper) ? std::max(0.0, -at->upper) : 0.0;
}

// Of the last feeds, back to the one that came into the part from outside.
double PairCheck::DepthOfFeeds() {
  double deepest = 0.0;
  int budget = OpenRun().depth_budget;
  for (std::size_t i = feeds_end_; i > 0; --i) {
    const motion::Motion& feed = (*travel_)[i - 1];
    if (IsRapid(feed)) return deepest;
    PathPoint at;
    const Interval depth = sweep_.Deepest(feed, {0.5, 0.0}, false, -deepest, &budget, &at);
    if (std::isfinite(depth.upper)) deepest = std::max(deepest, -depth.upper);
    if (DepthAt(feed, 0.0) <= 0.0) return deepest;
  }
  return std::max(deepest, carry_->feeds);
}

void PairCheck::OnSpindleStopped() {
  const bool applies = pair().role == PairRole::kFlutesPart ||
                       (pair().role == PairRole::kFlutesBlank && !blank_->cut);
  if (!applies || !IsFeed(motion()) || motion().facts.spindle_on) {
    Close(&stopped_);
    return;
  }
  Watch touch;
  touch.find_first = !stopped_.open;
  const SweepResult result = sweep_.Probe(motion(), touch);
  if (!result.contact) {
    Close(&stopped_);
    return;
  }
  if (!stopped_.open) {
    Open(ContactRun::Kind::kSpindleStopped, Rule::kSpindleStopped, Severity::kError, result.first,
         &stopped_);
  }
  stopped_.run.last = at_;
}

void PairCheck::OnContact(const Judgement& judgement, const SweepResult& result) {
  Close(&near_);
  Severity severity = judgement.severity;
  if (pair().role == PairRole::kFlutesBlank && IsFeed(motion())) {
    OnFirstCut(result);
    return;
  }
  // Flutes and a shank as wide come upon the blank at one place, which is known to 0.001 each.
  const double slack = pair().role == PairRole::kThinShankBlank ? 1e-3 : 0.0;
  if (blank_ != nullptr && !Uncut(*blank_, number(), result.first.s + slack)) {
    if (pair().role == PairRole::kThinShankBlank) {
      Close(&contact_);
      return;
    }
    severity = Severity::kWarning;
  }
  if (contact_.open) {
    const ContactRun& run = contact_.run;
    if (run.rule != judgement.rule || run.severity != severity) Close(&contact_);
  }
  if (!contact_.open) {
    const PathPoint onset = sweep_.Onset(motion(), result.first, judgement.watch.contact);
    Open(ContactRun::Kind::kContact, judgement.rule, severity, onset, &contact_);
    contact_.run.tolerance = judgement.tolerance;
    if (engine_->has_depth()) contact_.run.least = std::min(0.0, result.least.upper);
  }
  outcome_.touched = true;
  contact_.run.last = at_;
  Deepen(result.first, judgement.watch.track);
  // One warning a tool is enough: until the stock is simulated there is nothing more to say.
  if (pair().role == PairRole::kOtherBlank && severity == Severity::kWarning) {
    contact_.run.done = true;
    Close(&contact_);
    carry_->warned = true;
  }
}

void PairCheck::OnFirstCut(const SweepResult& result) {
  Close(&contact_);
  blank_->cut = true;
  blank_->motion = number();
  blank_->s = result.first.s;
}

void PairCheck::Deepen(const PathPoint& contact, bool track) {
  if (!engine_->has_depth()) return;
  const bool first = contact_.run.first == at_;
  const double known = first ? kInfinity : contact_.run.least;
  PathPoint at;
  const Interval depth =
      sweep_.Deepest(motion(), contact, contact_.with_lag, known, &contact_.depth_budget, &at);
  contact_.run.least = std::min(contact_.run.least, depth.upper);
  if (track) sweep_.Include({depth.lower, depth.upper}, motion());
  if (first && depth.upper < -kConfirmDepth) Confirm(at);
}

void PairCheck::Confirm(const PathPoint& at) {
  if (engine_->Confirms(sweep_.Pose(motion(), at))) return;
  ReportUncertified("the two collision engines disagree about a contact of " +
                    Spoken(pair().names.front()) + " and " + Spoken(pair().names.back()));
}

void PairCheck::OnClear(const Judgement& judgement, const SweepResult& result) {
  Close(&contact_);
  const Watch& watch = judgement.watch;
  const bool rounded = watch.rounding > 0.0 && result.least.lower <= watch.rounding;
  const bool near = watch.clearance > 0.0 && result.least.upper < watch.clearance;
  if (!rounded && !near) {
    Close(&near_);
    return;
  }
  const Rule rule = rounded ? Rule::kUncertified : Rule::kNearMiss;
  if (near_.open && near_.run.rule != rule) Close(&near_);
  if (!near_.open) {
    Open(ContactRun::Kind::kNear, rule, Info(rule).severity, result.least_at, &near_);
  }
  if (result.least.upper < near_.run.least) {
    near_.run.least = result.least.upper;
    near_.run.tolerance = rounded ? watch.rounding : watch.clearance;
    near_.run.lean = rounded ? motion().facts.orientation_tolerance : 0.0;
    Place(result.least_at, &near_);
  }
  near_.run.last = at_;
}

void PairCheck::ReportUncertified(std::string why) {
  if (!outcome_.uncertified.empty()) return;
  outcome_.uncertified = std::move(why);
  outcome_.uncertified_at = at_;
}

void PairCheck::Open(ContactRun::Kind kind, Rule rule, Severity severity, const PathPoint& at,
                     OpenRun* run) {
  *run = OpenRun();
  run->open = true;
  run->with_lag = at.lag > 0.0;
  run->run.kind = kind;
  run->run.rule = rule;
  run->run.severity = severity;
  run->run.first = at_;
  run->run.only_lag = run->with_lag;
  Place(at, run);
  if (kind != ContactRun::Kind::kNear) run->run.points = PointsOf(at);
}

std::vector<std::array<double, 3>> PairCheck::PointsOf(const PathPoint& contact) const {
  const std::optional<Witness> witness = FindWitness(pair(), sweep_.Pose(motion(), contact));
  if (!witness) return {};
  const motion::JointVector q = motion().At(contact.s, contact.lag);
  const machine::Machine& machine = *setup_->machine;
  const Eigen::Isometry3d X_MB = machine.tree.Pose(pair().link_b(), q);
  std::vector<std::array<double, 3>> points;
  for (const Eigen::Vector3d& p_B : {witness->a, witness->b}) {
    const Eigen::Vector3d p = machine.Coordinates(X_MB * p_B, q);
    points.push_back({p.x(), p.y(), p.z()});
  }
  if (pair().b->name == pair().names.front()) std::swap(points.front(), points.back());
  return points;
}

void PairCheck::Place(const PathPoint& at, OpenRun* run) {
  run->run.motion = at_;
  run->run.at = at;
}

void PairCheck::Close(OpenRun* run) {
  if (!run->open) return;
  outcome_.runs.push_back(std::move(run->run));
  *run = OpenRun();
}

void PairCheck::CloseRuns() {
  Close(&contact_);
  Close(&near_);
  Close(&stopped_);
}

}  // namespace ncsim::collision
