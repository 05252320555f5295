// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/outcome_record.h"

#include <utility>

#include "sim/base/bytes.h"

namespace ncsim::collision {

namespace {

enum class BlankChange : std::uint8_t { kNone, kCutHere };

void Put(const ContactRun& run, ByteWriter* out) {
  const auto& [kind, rule, severity, first, last, motion, at, points, least, tolerance, lean,
               only_lag, done] = run;
  out->Put(kind);
  out->Put(rule);
  out->Put(severity);
  for (const std::size_t index : {first, last, motion}) out->Put(index);
  for (const double number : {at.s, at.lag, least, tolerance, lean}) out->Put(number);
  out->Put(only_lag);
  out->Put(done);
  out->Put(points.size());
  for (const std::array<double, 3>& point : points) {
    for (const double number : point) out->Put(number);
  }
}

bool Get(ByteReader* in, std::size_t motions, ContactRun* run) {
  run->kind = in->Get<ContactRun::Kind>();
  run->rule = in->Get<Rule>();
  run->severity = in->Get<Severity>();
  run->first = in->Get<std::size_t>();
  run->last = in->Get<std::size_t>();
  run->motion = in->Get<std::size_t>();
  run->at.s = in->Get<double>();
  run->at.lag = in->Get<double>();
  run->least = in->Get<double>();
  run->tolerance = in->Get<double>();
  run->lean = in->Get<double>();
  run->only_lag = in->Get<bool>();
  run->done = in->Get<bool>();
  const auto points = in->Get<std::size_t>();
  for (std::size_t i = 0; i < points && in->ok(); ++i) {
    std::array<double, 3> point{};
    for (double& number : point) number = in->Get<double>();
    run->points.push_back(point);
  }
  return in->ok() && static_cast<std::size_t>(run->kind) < ContactRun::kKinds &&
         static_cast<std::size_t>(run->rule) < Rules().size() &&
         run->severity <= Severity::kWarning && run->first <= run->last && run->last < motions &&
         run->motion < motions;
}

void Put(const PairOutcome& outcome, ByteWriter* out) {
  const auto& [runs, uncertified, uncertified_at, touched, least, least_at, widened, queries] =
      outcome;
  out->PutText(uncertified);
  out->Put(uncertified_at);
  out->Put(touched);
  out->Put(least.lower);
  out->Put(least.upper);
  out->Put(least_at);
  out->Put(widened);
  out->Put(queries);
  out->Put(runs.size());
  for (const ContactRun& run : runs) Put(run, out);
}

bool Get(ByteReader* in, std::size_t motions, PairOutcome* outcome) {
  outcome->uncertified = in->GetText();
  outcome->uncertified_at = in->Get<std::size_t>();
  outcome->touched = in->Get<bool>();
  outcome->least.lower = in->Get<double>();
  outcome->least.upper = in->Get<double>();
  outcome->least_at = in->Get<std::size_t>();
  outcome->widened = in->Get<double>();
  outcome->queries = in->Get<std::uint64_t>();
  const auto runs = in->Get<std::size_t>();
  for (std::size_t i = 0; i < runs; ++i) {
    ContactRun run;
    if (!Get(in, motions, &run)) return false;
    outcome->runs.push_back(std::move(run));
  }
  return in->ok() && outcome->uncertified_at < motions && outcome->least_at < motions;
}

}  // namespace

std::string PackOutcome(const PairOutcome& outcome, const PairCarry& carry, const BlankState* blank,
                        const RunPlace& place) {
  ByteWriter out;
  Put(outcome, &out);
  const auto& [least, reference, feeds, warned] = carry;
  const auto& [after_feed, feed_depth, depth, cycle, cycle_depth] = reference.memory();
  for (const double number : {feed_depth, depth, cycle_depth, feeds}) out.Put(number);
  out.Put(after_feed);
  out.Put(warned);
  out.Put(cycle != 0);
  out.Put(place.cycle != 0 ? cycle - place.cycle : 0);
  const bool cut = blank != nullptr && blank->cut && blank->motion >= place.number;
  out.Put(cut ? BlankChange::kCutHere : BlankChange::kNone);
  if (cut) {
    out.Put(static_cast<std::size_t>(blank->motion - place.number));
    out.Put(blank->s);
  }
  return out.bytes();
}

bool UnpackOutcome(std::string_view bytes, const RunPlace& place, PairOutcome* outcome,
                   PairCarry* carry, BlankState* blank) {
  ByteReader in(bytes);
  PairOutcome found;
  if (!Get(&in, place.size, &found)) return false;
  RapidReference::Memory memory;
  memory.feed_depth = in.Get<double>();
  memory.depth = in.Get<double>();
  memory.cycle_depth = in.Get<double>();
  const auto feeds = in.Get<double>();
  memory.after_feed = in.Get<bool>();
  const auto warned = in.Get<bool>();
  const auto has_cycle = in.Get<bool>();
  const auto from_first = in.Get<int>();
  // Without a cycle in the run it is the one that came in.
  const int first = place.cycle != 0 ? place.cycle : carry->reference.memory().cycle;
  memory.cycle = has_cycle ? first + from_first : 0;
  const bool cut = in.Get<BlankChange>() == BlankChange::kCutHere;
  const std::size_t cut_at = cut ? in.Get<std::size_t>() : 0;
  const double cut_s = cut ? in.Get<double>() : 0.0;
  if (!in.ok() || in.left() > 0 || cut_at >= place.size || (cut && blank == nullptr)) return false;
  *outcome = std::move(found);
  carry->reference = RapidReference(memory);
  carry->feeds = feeds;
  carry->warned = warned;
  if (cut) *blank = {true, place.number + cut_at, cut_s};
  return true;
}

}  // namespace ncsim::collision
