// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/post_candidates.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace ncsim::app {
namespace {

/// What may go away where the rotary axes stand otherwise.
bool DependsOnWay(const Finding& finding) {
  if (finding.severity != Severity::kError) return false;
  switch (finding.rule) {
    case Rule::kTravelLimit:
    case Rule::kRotaryWrap:
    case Rule::kCollision:
    case Rule::kRapidContact:
    case Rule::kStockContact:
    case Rule::kControlAlarm:
      return true;
    default:
      return false;
  }
}

/// The operation that a place of the checked program is in; null before the first.
const post::PostedOperation* OperationAt(const Judged& judged, const SourcePosition& where) {
  const std::string& name = judged.outcome.files.name(where.file);
  const post::PostedOperation* found = nullptr;
  for (const post::PostedOperation& operation : judged.program.operations) {
    const std::string& file = judged.program.files[operation.file].name;
    const bool same = file.empty() ? where.file == 0 : name.ends_with(file);
    if (same && operation.line <= where.line) found = &operation;
  }
  return found;
}

}  // namespace

std::optional<Judged> FindPassing(const JudgeWays& judge, int limit,
                                  std::vector<std::string>* notes) {
  std::map<int, std::size_t> choice;
  std::set<int> given_up;
  std::optional<Judged> judged = judge(choice);
  for (int count = 1; judged && count < limit; ++count) {
    const post::PostedOperation* failing = nullptr;
    const Finding* why = nullptr;
    const auto& result = judged->outcome.result;
    if (!result) break;
    for (const Finding& finding : result->findings) {
      if (!DependsOnWay(finding)) continue;
      const post::PostedOperation* operation = OperationAt(*judged, finding.where);
      if (operation == nullptr || given_up.count(operation->operation) > 0) continue;
      if (failing != nullptr && failing->operation <= operation->operation) continue;
      failing = operation;
      why = &finding;
    }
    if (failing == nullptr) break;
    const int operation = failing->operation;
    const std::size_t next = failing->taken + 1;
    const bool last = next >= failing->ways;
    std::string note = "operation " + std::to_string(operation) + ": way " + std::to_string(next) +
                       " of " + std::to_string(failing->ways) + " fails: " + why->message;
    if (last && next > 1) note += "; no way passes, the first one is taken";
    if (failing->ways > 1) notes->push_back(std::move(note));
    if (last) given_up.insert(operation);
    if (last && failing->taken == 0) continue;  // There is nothing else to try in it.
    if (last) {
      choice.erase(operation);
    } else {
      choice[operation] = next;
    }
    std::optional<Judged> candidate = judge(choice);
    if (!candidate) {  // What could be posted before it can be again.
      notes->push_back("operation " + std::to_string(operation) + ": way " +
                       std::to_string(next + 1) + " cannot be posted; the first one is taken");
      given_up.insert(operation);
      choice.erase(operation);
      candidate = judge(choice);
    }
    judged = std::move(candidate);
  }
  return judged;
}

}  // namespace ncsim::app
