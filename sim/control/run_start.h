// SPDX-License-Identifier: BSD-3-Clause
// What every control's run begins with. Neutral of dialect.
#pragma once

#include <string>
#include <vector>

#include "sim/control/command.h"
#include "sim/control/run_log.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"

namespace ncsim::control {

/// The job's, else home, which is then assumed.
AxisValues StartPosition(const machine::Machine& machine, const machine::Job& job, RunLog* log);
/// The model's rapid rates, as an assumption.
void AssumeRates(const machine::Machine& machine, RunLog* log);
/// M codes that job or model call without motion.
std::vector<int> MotionlessCodes(const machine::Machine& machine, const machine::Job& job);
/// The job's, then the model's.
std::vector<std::string> SubprogramFolders(const machine::Machine& machine,
                                           const machine::Job& job);

}  // namespace ncsim::control
