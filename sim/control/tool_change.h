// SPDX-License-Identifier: BSD-3-Clause
// How the axes go to the model's tool-change pose. Neutral of dialect.
#pragma once

#include <vector>

#include "sim/control/command.h"
#include "sim/control/run_log.h"
#include "sim/machine/machine.h"

namespace ncsim::control {

struct ToolChangeWay {
  explicit ToolChangeWay(const machine::ControlData& control);
  /// Where nobody has measured it.
  void AssumePose(RunLog* log) const;

  AxisValues pose{};            ///< Machine values.
  unsigned stated = 1U << kZ;   ///< Bit per AxisIndex that `pose` holds.
  std::vector<unsigned> steps;  ///< Axes that go together, in order; all of `stated`.

 private:
  bool nominal_ = true;
};

}  // namespace ncsim::control
