// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/contact_rules.h"

#include <algorithm>

namespace ncsim::collision {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void WatchClearance(const motion::Motion& motion, const machine::CheckSettings& settings,
                    Watch* watch) {
  watch->clearance = settings.clearance;
  watch->rounding = motion.facts.corner_rounding;
  watch->track = true;
  watch->track_below = std::max(2.0 * settings.clearance, settings.exact_below);
}

}  // namespace

void RapidReference::OnFeed(double depth) {
  feed_depth_ = after_feed_ ? std::max(feed_depth_, depth) : depth;
  after_feed_ = true;
}

double RapidReference::OnRapid(int cycle, double start_depth) {
  if (after_feed_) {
    depth_ = std::max(feed_depth_, start_depth);
    if (cycle != cycle_) cycle_depth_ = 0.0;
    cycle_ = cycle;
    if (cycle > 0) cycle_depth_ = std::max(cycle_depth_, depth_);
    after_feed_ = false;
    feed_depth_ = 0.0;
  }
  if (start_depth <= 0.0) depth_ = 0.0;
  return Kept(cycle);
}

double RapidReference::OnFeedsBefore(int cycle, double depth) {
  depth_ = std::max(depth_, depth);
  if (cycle > 0 && cycle == cycle_) cycle_depth_ = std::max(cycle_depth_, depth);
  return Kept(cycle);
}

double RapidReference::Kept(int cycle) const {
  return std::max(depth_, cycle > 0 && cycle == cycle_ ? cycle_depth_ : 0.0);
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
      WatchClearance(motion, settings, &judgement.watch);
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
      WatchClearance(motion, settings, &judgement.watch);
      judgement.watch.track = false;  // a clearance to what will be cut away is no number to report
      break;
  }
  return judgement;
}

}  // namespace ncsim::collision
