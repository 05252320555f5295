// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/pair_report.h"

#include <algorithm>
#include <string>

#include "sim/base/text.h"
#include "sim/collision/contact_text.h"

namespace ncsim::collision {

namespace {

std::string DescribeNear(const Pair& pair, const ContactRun& run, const Finding& finding) {
  const std::string& a = pair.names.front();
  const std::string limit = Short(run.words.tolerance, 3) + " mm";
  return Spoken(a) + " " + Verb(a, "comes", "come") + " within " + Short(*finding.clearance_mm, 2) +
         " mm of " + Spoken(pair.names.back()) +
         (finding.rule == Rule::kNearMiss
              ? " (clearance " + limit + ")"
              : ", and the control may round the corner by " + limit + ",") +
         " at " + ToString(finding.axes);
}

Finding Describe(const Pair& pair, ContactRun* run) {
  Finding& finding = run->blocks.finding();
  switch (run->kind) {
    case ContactRun::Kind::kNear:
      finding.clearance_mm = std::max(0.0, run->least);
      finding.message = DescribeNear(pair, *run, finding);
      break;
    case ContactRun::Kind::kContact:
      run->words.depth = std::max(0.0, -run->least);
      if (run->words.has_depth) finding.clearance_mm = -run->words.depth;
      finding.message = DescribeContact(pair, run->words, ToString(finding.axes));
      break;
    case ContactRun::Kind::kSpindleStopped:
      finding.message = DescribeContact(pair, run->words, ToString(finding.axes));
      break;
  }
  return run->blocks.Take();
}

bool GoesOn(const ContactRun& run, const ContactRun& next) {
  const Finding& fault = run.blocks.finding();
  const Finding& then = next.blocks.finding();
  return !run.done && run.last + 1 == next.first && fault.rule == then.rule &&
         fault.severity == then.severity;
}

/// `next` into `run`. A near miss stands at its nearest pose, a contact where it begins.
void Join(ContactRun* run, ContactRun* next) {
  if (run->kind == ContactRun::Kind::kNear && next->least < run->least) {
    run->blocks.finding() = next->blocks.finding();
  }
  run->blocks.Append(next->blocks);
  run->last = next->last;
  run->least = std::min(run->least, next->least);
}

}  // namespace

std::optional<ContactRun>& PairReport::open(ContactRun::Kind kind) {
  return open_[static_cast<std::size_t>(kind)];
}

void PairReport::Close(const Pair& pair, std::optional<ContactRun>* run,
                       NumberedFindings* findings) {
  if (!run->has_value()) return;
  findings->emplace_back((*run)->first, Describe(pair, &**run));
  run->reset();
}

void PairReport::Add(const Pair& pair, PairOutcome outcome, std::uint64_t last,
                     NumberedFindings* findings) {
  queries_ += outcome.queries;
  touched_ = touched_ || outcome.touched;
  least_.lower = std::min(least_.lower, outcome.least.lower);
  if (outcome.least.upper < least_.upper) {
    least_.upper = outcome.least.upper;
    least_where_ = outcome.least_where;
  }
  if (!outcome.uncertified.empty() && !uncertified_) {
    uncertified_ = true;
    Finding finding =
        MakeFinding(Rule::kUncertified, outcome.uncertified_where, std::move(outcome.uncertified));
    finding.bodies = pair.names;
    findings->emplace_back(outcome.uncertified_number, std::move(finding));
  }
  for (ContactRun& run : outcome.runs) {
    std::optional<ContactRun>& before = open(run.kind);
    if (before.has_value() && GoesOn(*before, run)) {
      Join(&*before, &run);
    } else {
      Close(pair, &before, findings);
      before = std::move(run);
    }
    if (before->last < last) Close(pair, &before, findings);
  }
  for (std::optional<ContactRun>& run : open_) {
    if (run.has_value() && run->last < last) Close(pair, &run, findings);
  }
}

void PairReport::Finish(const Pair& pair, NumberedFindings* findings) {
  for (std::optional<ContactRun>& run : open_) Close(pair, &run, findings);
}

}  // namespace ncsim::collision
