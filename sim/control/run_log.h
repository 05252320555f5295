// SPDX-License-Identifier: BSD-3-Clause
// What a run reports: findings, assumptions, and whether the control has stopped. Neutral of
// dialect.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/finding.h"
#include "sim/control/controller.h"

namespace ncsim::control {

class RunLog {
 public:
  /// `sink` and `summary` outlive this.
  RunLog(RunSink* sink, RunSummary* summary) : sink_(sink), summary_(summary) {}

  void Report(Finding finding);
  void Report(Rule rule, SourcePosition where, std::string message);
  /// The control stops here: reports and sets stopped(). Only the first alarm of a run counts.
  void Alarm(Rule rule, SourcePosition where, std::string message);
  /// One finding a run for each `key`: the first place, with the number of further ones. Sent by
  /// Finish().
  void ReportOnce(std::string_view key, Finding finding);
  void ReportOnce(std::string_view key, Rule rule, SourcePosition where, std::string message);
  /// Remembers an assumption once a name.
  void Assume(std::string_view name, std::string text, bool places_metal);
  bool Assumed(std::string_view name) const;
  void NotChecked(std::string_view what);
  void Finish();

  /// No further block may be executed.
  bool stopped() const { return stopped_; }
  void Stop() { stopped_ = true; }

 private:
  struct Repeated {
    Finding finding;
    std::uint64_t count = 0;
  };
  RunSink* sink_;
  RunSummary* summary_;
  std::map<std::string, Repeated, std::less<>> repeated_;
  std::vector<std::string> order_;
  bool stopped_ = false;
};

}  // namespace ncsim::control
