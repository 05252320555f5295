// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/pair_report.h"

#include <algorithm>
#include <string>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/collision/contact_text.h"

namespace ncsim::collision {

namespace {

std::string DescribeNear(const Pair& pair, const ContactRun& run, const Finding& finding) {
  const std::string& a = pair.names.front();
  const std::string limit = Short(run.tolerance, 3) + " mm";
  return Spoken(a) + " " + Verb(a, "comes", "come") + " within " + Short(*finding.clearance_mm, 2) +
         " mm of " + Spoken(pair.names.back()) +
         (finding.rule == Rule::kNearMiss ? " (clearance " + limit + ")"
          : run.lean > 0.0
              ? ", and smoothing, which may turn the tool by " + Short(Degrees(run.lean), 3) +
                    " deg, may take it " + limit + " off its way,"
              : ", and the control may round the corner by " + limit + ",") +
         " at " + ToString(finding.axes);
}

/// Placed, and without its message.
Finding Place(const PairSetup& setup, const motion::Travel& motions, ContactRun* run) {
  const motion::Motion& motion = motions[run->motion];
  Finding finding = MakeFinding(run->rule, motion.where, "");
  finding.severity = run->severity;
  finding.bodies = setup.pair.names;
  finding.axes = setup.machine->Readout(motion.At(run->at.s, run->at.lag));
  finding.time_s = motion.start_time + motion.ElapsedTime(run->at.s, run->at.lag);
  finding.points = std::move(run->points);
  return finding;
}

void Describe(const Pair& pair, const ContactRun& run, Finding* finding) {
  if (run.kind == ContactRun::Kind::kNear) {
    finding->clearance_mm = std::max(0.0, run.least);
    finding->message = DescribeNear(pair, run, *finding);
    return;
  }
  ContactWords words;
  words.rule = run.rule;
  words.severity = run.severity;
  words.depth = std::max(0.0, -run.least);
  words.has_depth = pair.tool != nullptr;
  words.only_lag = run.only_lag;
  words.tolerance = run.tolerance;
  const bool deep = run.kind == ContactRun::Kind::kContact && words.has_depth;
  if (deep) finding->clearance_mm = -words.depth;
  finding->message = DescribeContact(pair, words, ToString(finding->axes));
}

}  // namespace

void PairReport::Close(const PairSetup& setup, std::optional<Open>* run,
                       NumberedFindings* findings) {
  if (!run->has_value()) return;
  Describe(setup.pair, (*run)->run, &(*run)->blocks.finding());
  findings->emplace_back((*run)->first, (*run)->blocks.Take());
  run->reset();
}

// One with the run before, or the next one. A near miss stands at its nearest pose, a contact where
// it begins.
void PairReport::Take(const PairSetup& setup, Open next, NumberedFindings* findings) {
  std::optional<Open>& open = open_[static_cast<std::size_t>(next.run.kind)];
  const bool goes_on = open.has_value() && !open->run.done && open->last + 1 == next.first &&
                       open->run.rule == next.run.rule && open->run.severity == next.run.severity;
  if (!goes_on) {
    Close(setup, &open, findings);
    open = std::move(next);
    return;
  }
  if (next.run.kind == ContactRun::Kind::kNear && next.run.least < open->run.least) {
    open->blocks.finding() = next.blocks.finding();
    open->run.tolerance = next.run.tolerance;
    open->run.lean = next.run.lean;
  }
  open->blocks.Append(next.blocks);
  open->last = next.last;
  open->run.done = next.run.done;
  open->run.least = std::min(open->run.least, next.run.least);
}

void PairReport::Add(const PairSetup& setup, const motion::Travel& run, std::uint64_t number,
                     PairOutcome outcome, NumberedFindings* findings) {
  queries_ += outcome.queries;
  touched_ = touched_ || outcome.touched;
  widened_ = std::max(widened_, outcome.widened);
  least_.lower = std::min(least_.lower, outcome.least.lower);
  if (outcome.least.upper < least_.upper) {
    least_.upper = outcome.least.upper;
    least_where_ = run[outcome.least_at].where;
  }
  if (!outcome.uncertified.empty() && !uncertified_) {
    uncertified_ = true;
    Finding finding = MakeFinding(Rule::kUncertified, run[outcome.uncertified_at].where,
                                  std::move(outcome.uncertified));
    finding.bodies = setup.pair.names;
    findings->emplace_back(number + outcome.uncertified_at, std::move(finding));
  }
  for (ContactRun& fault : outcome.runs) {
    Open next;
    next.blocks.Start(Place(setup, run, &fault));
    for (std::size_t i = fault.first; i <= fault.last; ++i) next.blocks.Add(run[i].where);
    next.first = number + fault.first;
    next.last = number + fault.last;
    next.run = std::move(fault);
    Take(setup, std::move(next), findings);
  }
  for (std::optional<Open>& open : open_) {
    if (open.has_value() && open->last + 1 < number + run.size()) Close(setup, &open, findings);
  }
}

void PairReport::Finish(const PairSetup& setup, NumberedFindings* findings) {
  for (std::optional<Open>& open : open_) Close(setup, &open, findings);
}

}  // namespace ncsim::collision
