// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/contact_rules.h"

#include <algorithm>

#include "sim/base/units.h"

namespace ncsim::collision {

namespace {

void WatchClearance(const machine::CheckSettings& settings, Judgement* judgement) {
  judgement->widened = true;
  Watch& watch = judgement->watch;
  watch.clearance = settings.clearance;
  watch.track = true;
  watch.track_below = std::max(2.0 * settings.clearance, settings.exact_below);
}

}  // namespace

void RapidReference::OnFeed(double depth) {
  memory_.feed_depth = memory_.after_feed ? std::max(memory_.feed_depth, depth) : depth;
  memory_.after_feed = true;
}

double RapidReference::OnRapid(int cycle, double start_depth) {
  if (memory_.after_feed) {
    memory_.depth = std::max(memory_.feed_depth, start_depth);
    if (cycle != memory_.cycle) memory_.cycle_depth = 0.0;
    memory_.cycle = cycle;
    if (cycle > 0) memory_.cycle_depth = std::max(memory_.cycle_depth, memory_.depth);
    memory_.after_feed = false;
    memory_.feed_depth = 0.0;
  }
  if (start_depth <= 0.0) memory_.depth = 0.0;
  return Kept(cycle);
}

double RapidReference::OnFeedsBefore(int cycle, double depth) {
  memory_.depth = std::max(memory_.depth, depth);
  if (cycle > 0 && cycle == memory_.cycle)
    memory_.cycle_depth = std::max(memory_.cycle_depth, depth);
  return Kept(cycle);
}

double RapidReference::Kept(int cycle) const {
  return std::max(memory_.depth, cycle > 0 && cycle == memory_.cycle ? memory_.cycle_depth : 0.0);
}

bool IsWidened(PairRole role) {
  return role == PairRole::kNeverTouch || role == PairRole::kOtherBlank;
}

bool Uncut(const BlankState& blank, std::uint64_t number, double s) {
  return !blank.cut || number < blank.motion || (number == blank.motion && s < blank.s);
}

Judgement Judge(PairRole role, const motion::Motion& motion, const machine::CheckSettings& settings,
                const BlankState* blank, std::uint64_t number, double allowed, double floor) {
  Judgement judgement;
  judgement.checked = true;
  const bool rapid = IsRapid(motion);
  const auto clamp = [floor](double tolerance) { return std::min(tolerance, -0.5 * floor); };
  switch (role) {
    case PairRole::kNeverTouch:
      WatchClearance(settings, &judgement);
      break;
    case PairRole::kFlutesPart:
    case PairRole::kThinShankPart:
      judgement.tolerance = rapid ? settings.part_tolerance : settings.gouge_tolerance;
      judgement.watch.contact = -(clamp(judgement.tolerance) + (rapid ? allowed : 0.0));
      if (role == PairRole::kThinShankPart) break;
      judgement.rule = rapid ? Rule::kRapidContact : Rule::kGouge;
      if (rapid) break;
      judgement.checked = settings.gouge != machine::GougeMode::kOff;
      if (settings.gouge == machine::GougeMode::kWarning) judgement.severity = Severity::kWarning;
      judgement.watch.track = true;
      judgement.watch.track_below = kInfinity;
      judgement.watch.track_ceiling = 0.0;
      judgement.watch.track_within = 0.25 * judgement.tolerance;
      break;
    case PairRole::kFlutesBlank:
      judgement.rule = Rule::kStockContact;
      judgement.checked = !blank->cut;
      break;
    case PairRole::kThinShankBlank:
      judgement.rule = Rule::kStockContact;
      judgement.checked = Uncut(*blank, number, 0.0);
      break;
    case PairRole::kOtherBlank:
      judgement.rule = Rule::kStockContact;
      if (blank->cut && blank->motion <= number) break;
      WatchClearance(settings, &judgement);
      judgement.watch.track = false;  // a clearance to what will be cut away is no number to report
      break;
  }
  return judgement;
}

}  // namespace ncsim::collision
