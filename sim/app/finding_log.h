// SPDX-License-Identifier: BSD-3-Clause
// Findings of one program. Bounded: a hostile program can make one in every block.
#pragma once

#include <map>
#include <vector>

#include "sim/base/finding.h"

namespace ncsim::app {

class FindingLog {
 public:
  /// Of one rule and severity so many are kept; what follows is counted.
  static constexpr int kMaxKept = 10'000;

  void Add(Finding finding);
  void Add(std::vector<Finding> findings);
  bool Has(Severity severity) const;
  bool HasOtherThan(Rule rule, Severity severity) const;
  /// Sorted; a rule that has more than kMaxKept closes with a finding that says how many more.
  std::vector<Finding> Take();

 private:
  std::map<std::pair<Rule, Severity>, int> count_;
  std::vector<Finding> findings_;
};

}  // namespace ncsim::app
