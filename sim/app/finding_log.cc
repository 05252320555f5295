// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/finding_log.h"

#include <algorithm>
#include <string>
#include <utility>

#include "sim/report/result.h"

namespace ncsim::app {

void FindingLog::Add(Finding finding) {
  if (++count_[{finding.rule, finding.severity}] <= kMaxKept) {
    findings_.push_back(std::move(finding));
  }
}

void FindingLog::Add(std::vector<Finding> findings) {
  for (Finding& finding : findings) Add(std::move(finding));
}

bool FindingLog::Has(Severity severity) const {
  return std::any_of(count_.begin(), count_.end(),
                     [&](const auto& entry) { return entry.first.second == severity; });
}

bool FindingLog::HasOtherThan(Rule rule, Severity severity) const {
  return std::any_of(count_.begin(), count_.end(), [&](const auto& entry) {
    return entry.first.second == severity && entry.first.first != rule;
  });
}

std::vector<Finding> FindingLog::Take() {
  report::SortFindings(&findings_);
  for (const auto& [key, count] : count_) {
    if (count <= kMaxKept) continue;
    Finding finding = MakeFinding(
        key.first, {}, std::to_string(count - kMaxKept) + " more of these are not listed");
    finding.severity = key.second;
    findings_.push_back(std::move(finding));
  }
  count_.clear();
  return std::exchange(findings_, {});
}

}  // namespace ncsim::app
