// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/run_log.h"

#include <algorithm>
#include <utility>

namespace ncsim::control {

void RunLog::Report(Finding finding) { sink_->OnFinding(std::move(finding)); }

void RunLog::Report(Rule rule, SourcePosition where, std::string message) {
  Report(MakeFinding(rule, where, std::move(message)));
}

void RunLog::Alarm(Rule rule, SourcePosition where, std::string message) {
  if (stopped_) return;
  stopped_ = true;
  Report(rule, where, std::move(message));
}

void RunLog::ReportOnce(std::string_view key, Rule rule, SourcePosition where,
                        std::string message) {
  ReportOnce(key, MakeFinding(rule, where, std::move(message)));
}

void RunLog::ReportOnce(std::string_view key, Finding finding) {
  const auto found = repeated_.find(key);
  if (found != repeated_.end()) {
    ++found->second.count;
    return;
  }
  order_.emplace_back(key);
  repeated_.emplace(order_.back(), Repeated{std::move(finding), 1});
}

void RunLog::Assume(std::string_view name, std::string text, bool places_metal) {
  if (Assumed(name)) return;
  Assumption assumption;
  assumption.name = name;
  assumption.text = std::move(text);
  assumption.places_metal = places_metal;
  summary_->assumptions.push_back(std::move(assumption));
}

bool RunLog::Assumed(std::string_view name) const {
  return std::any_of(summary_->assumptions.begin(), summary_->assumptions.end(),
                     [&](const Assumption& assumption) { return assumption.name == name; });
}

void RunLog::NotChecked(std::string_view what) {
  std::vector<std::string>& list = summary_->not_checked;
  if (std::find(list.begin(), list.end(), what) == list.end()) list.emplace_back(what);
}

void RunLog::Finish() {
  for (const std::string& key : order_) {
    Repeated& repeated = repeated_.find(key)->second;
    if (repeated.count > 1) {
      repeated.finding.message +=
          " (and at " + std::to_string(repeated.count - 1) + " more places)";
    }
    Report(std::move(repeated.finding));
  }
  repeated_.clear();
  order_.clear();
}

}  // namespace ncsim::control
