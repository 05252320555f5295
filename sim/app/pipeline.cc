// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/pipeline.h"

#include <algorithm>
#include <utility>

namespace ncsim::app {

Pipeline::Pipeline(Parts parts, std::function<void(const motion::Window&)> on_window)
    : parts_(parts), on_window_(std::move(on_window)), checks_(checks::AllChecks(*parts.machine)) {}

double Pipeline::ToolLength(int number) const {
  const machine::Tool* tool = parts_.tools->Find(number);
  return tool == nullptr ? 0.0 : tool->length;
}

void Pipeline::OnMotion(const motion::Motion& motion) {
  ++motions_;
  const int tool = motion.facts.tool;
  OnWindow(windows_.Add(motion));
  if (tool > 0 && std::find(used_tools_.begin(), used_tools_.end(), tool) == used_tools_.end()) {
    used_tools_.push_back(tool);
  }
  if (parts_.trace != nullptr) {
    const auto& frame = parts_.part_frames->at(static_cast<std::size_t>(motion.facts.offset));
    parts_.trace->Write(motion, frame.X_BP, ToolLength(tool), *parts_.files);
  }
  if (parts_.recorder != nullptr) parts_.recorder->OnMotion(motion);
  for (const std::unique_ptr<checks::Check>& check : checks_) check->OnMotion(motion, &found_);
  if (!found_.empty()) parts_.log->Add(std::exchange(found_, {}));
  tool_changes_.OnMotion(motion);
}

void Pipeline::OnWindow(motion::Window window) {
  if (window.motions.empty()) return;
  if (on_window_) on_window_(window);
  if (parts_.collision != nullptr) parts_.collision->Check(std::move(window));
}

void Pipeline::Finish() {
  OnWindow(windows_.Take());
  for (const std::unique_ptr<checks::Check>& check : checks_) check->Finish(&found_);
  parts_.log->Add(std::exchange(found_, {}));
}

}  // namespace ncsim::app
