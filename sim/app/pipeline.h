// SPDX-License-Identifier: BSD-3-Clause
// Between the control and what judges its motions: trace, checks, windows for the collision
// checker.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sim/app/finding_log.h"
#include "sim/app/nominal.h"
#include "sim/checks/check.h"
#include "sim/collision/checker.h"
#include "sim/control/controller.h"
#include "sim/machine/tool.h"
#include "sim/motion/window.h"
#include "sim/report/recording.h"
#include "sim/report/result.h"

namespace ncsim::app {

class Pipeline : public control::RunSink {
 public:
  /// What a pipeline feeds; all outlive it. `trace`, `recorder` and `collision` may be null.
  struct Parts {
    const machine::Machine* machine = nullptr;
    const machine::ToolTable* tools = nullptr;
    const SourceFiles* files = nullptr;
    const std::vector<control::PartFrame>* part_frames = nullptr;
    report::TraceWriter* trace = nullptr;
    report::Recorder* recorder = nullptr;
    collision::CollisionChecker* collision = nullptr;
    FindingLog* log = nullptr;
  };
  /// `on_window` is called with each window as it goes to be checked: for a progress display.
  Pipeline(Parts parts, std::function<void(const motion::Window&)> on_window);

  void OnMotion(const motion::Motion& motion) override;
  void OnFinding(Finding finding) override { parts_.log->Add(std::move(finding)); }
  /// After the last motion.
  void Finish();

  std::uint64_t motions() const { return motions_; }
  /// T numbers that were in the spindle while something moved, in order of first use.
  const std::vector<int>& used_tools() const { return used_tools_; }
  const ToolChangePoses& tool_changes() const { return tool_changes_; }

 private:
  void OnWindow(motion::Window window);
  double ToolLength(int number) const;

  Parts parts_;
  std::function<void(const motion::Window&)> on_window_;
  std::vector<std::unique_ptr<checks::Check>> checks_;
  std::vector<Finding> found_;
  motion::WindowCutter windows_;
  std::uint64_t motions_ = 0;
  std::vector<int> used_tools_;
  ToolChangePoses tool_changes_;
};

}  // namespace ncsim::app
