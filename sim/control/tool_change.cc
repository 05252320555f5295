// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/tool_change.h"

#include <string>

#include "sim/base/text.h"

namespace ncsim::control {

ToolChangeWay::ToolChangeWay(const machine::ControlData& control)
    : nominal_(control.tool_change_nominal) {
  for (const auto& [letter, value] : control.tool_change_pose) {
    const std::size_t axis = kLetters.find(letter);
    if (axis >= kNumAxes) continue;
    pose[axis] = value;
    stated |= 1U << axis;
  }
  unsigned gone = 0;
  for (const std::string& step : control.tool_change_order) {
    unsigned axes = 0;
    for (const char letter : step) {
      const std::size_t axis = kLetters.find(letter);
      if (axis < kNumAxes) axes |= 1U << axis;
    }
    if ((axes & stated) != 0) steps.push_back(axes & stated);
    gone |= axes;
  }
  if ((stated & ~gone) != 0) steps.push_back(stated & ~gone);
}

void ToolChangeWay::AssumePose(RunLog* log) const {
  if (!nominal_) return;
  std::string text = "at";
  for (std::size_t axis = 0; axis <= kZ; ++axis) {
    if ((stated & 1U << axis) != 0) text += std::string(" ") + "XYZ"[axis] + Fixed(pose[axis], 3);
  }
  log->Assume("tool-change pose", text + ": the model's nominal values", false);
}

}  // namespace ncsim::control
