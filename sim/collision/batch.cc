// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/batch.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/collision/threads.h"

namespace ncsim::collision {

namespace {

/// One pair over one run.
struct Step {
  BatchRun* run;
  WatchedPair* pair;
  PairOutcome* outcome;
};

/// Steps that must be done one after the other.
using Lane = std::vector<Step>;

// From what is known, or by a check.
void Perform(const Step& step, PairCarry* carry) {
  BatchRun& run = *step.run;
  const WatchedPair& pair = *step.pair;
  const auto check = [&] {
    *step.outcome = PairCheck(pair.setup, *run.travel, run.number, pair.blank, carry).Run();
  };
  if (run.known == nullptr) return check();
  const auto place = static_cast<std::size_t>(step.outcome - run.outcomes.data());
  const Digest key = run.known->KeyOf(pair.content, *carry, pair.blank);
  if (run.known->Recall(place, key, step.outcome, carry, pair.blank)) return;
  check();
  run.known->Keep(place, key, *step.outcome, *carry, pair.blank);
}

void Take(const Step& step) {
  WatchedPair& pair = *step.pair;
  PairCarry carry = pair.carry;  // others may be at the same pair in another run
  carry.least = RoundedLeast(carry.least);
  if (!IsSequential(pair.setup.pair.role)) return Perform(step, &carry);
  if (step.run->tool_changed) {
    carry.warned = false;
    if (pair.setup.pair.tool) carry.reference.Reset();
  }
  Perform(step, &carry);
  carry.least = std::min(pair.carry.least, step.outcome->least.upper);
  pair.carry = carry;
}

/// Pairs that cut go through the runs in their order, all that share a blank together; every other
/// step stands for itself.
std::vector<Lane> Lanes(Batch* batch) {
  std::map<const void*, std::size_t> index;  // of the lane of a pair or of a blank
  std::vector<Lane> lanes;
  std::vector<Lane> free;
  for (BatchRun& run : *batch) {
    std::size_t i = 0;
    for (WatchedPairs* group : run.groups) {
      for (const auto& pair : *group) {
        const Step step{&run, pair.get(), &run.outcomes[i++]};
        if (!IsSequential(pair->setup.pair.role)) {
          free.push_back({step});
          continue;
        }
        const void* key = pair->blank != nullptr ? static_cast<const void*>(pair->blank)
                                                 : static_cast<const void*>(pair.get());
        const auto [entry, is_new] = index.try_emplace(key, lanes.size());
        if (is_new) lanes.emplace_back();
        lanes[entry->second].push_back(step);
      }
    }
  }
  // The long ones first.
  lanes.insert(lanes.end(), free.begin(), free.end());
  return lanes;
}

template <class Function>
void ForEach(std::size_t size, const Function& function) {
  oneapi::tbb::parallel_for(std::size_t{0}, size, function, oneapi::tbb::simple_partitioner());
}

void CheckBatch(const machine::Machine& machine, const OutcomeCache* cache, Batch* batch) {
  const kinematics::FiveAxis* five_axis = machine.five_axis ? &*machine.five_axis : nullptr;
  ForEach(batch->size(), [&](std::size_t i) {
    BatchRun& run = (*batch)[i];
    run.travel =
        std::make_unique<motion::Travel>(machine.tree, five_axis, run.tool_length, run.motions);
    std::size_t pairs = 0;
    for (const WatchedPairs* group : run.groups) pairs += group->size();
    run.outcomes.resize(pairs);
    if (cache != nullptr) run.known = cache->Open(*run.travel, run.number, pairs);
  });
  const std::vector<Lane> lanes = Lanes(batch);
  ForEach(lanes.size(), [&](std::size_t i) {
    for (const Step& step : lanes[i]) Take(step);
  });
  if (cache == nullptr) return;
  for (BatchRun& run : *batch) run.known->Save();
}

}  // namespace

bool WatchedPair::has_clearance() const {
  if (setup.pair.role != PairRole::kNeverTouch || report.uncertified()) return false;
  if (report.touched() && setup.pair.tool == nullptr) return false;  // two meshes have no depth
  return std::isfinite(report.least().lower) && std::isfinite(report.least().upper);
}

// To the next greater number of five binary digits.
double RoundedLeast(double least) {
  if (!std::isfinite(least)) return least;
  constexpr double kDigits = 32.0;
  int exponent = 0;
  const double fraction = std::frexp(least, &exponent);
  return std::ldexp(std::ceil(kDigits * fraction) / kDigits, exponent);
}

struct BatchRunner::Group {
  oneapi::tbb::task_group tasks;
};

BatchRunner::BatchRunner() : group_(std::make_unique<Group>()) {}

BatchRunner::~BatchRunner() {
  group_->tasks.cancel();
  try {
    group_->tasks.wait();
  } catch (...) {  // NOLINT(bugprone-empty-catch): who asked for it is gone
  }
}

void BatchRunner::Start(const machine::Machine& machine, const OutcomeCache* cache, Batch* batch) {
  if (OnlyOneThread()) return CheckBatch(machine, cache, batch);
  // Isolated: a thread that waits for a piece of this batch takes no other program's work
  // meanwhile.
  group_->tasks.run([&machine, cache, batch] {
    oneapi::tbb::this_task_arena::isolate([&] { CheckBatch(machine, cache, batch); });
  });
}

void BatchRunner::Wait() { group_->tasks.wait(); }

void Tell(Batch* batch, NumberedFindings* findings) {
  for (BatchRun& run : *batch) {
    std::size_t i = 0;
    for (WatchedPairs* group : run.groups) {
      for (const auto& pair : *group) {
        PairOutcome& outcome = run.outcomes[i++];
        pair->carry.least = std::min(pair->carry.least, outcome.least.upper);
        pair->report.Add(pair->setup, *run.travel, run.number, std::move(outcome), findings);
      }
    }
  }
}

}  // namespace ncsim::collision
