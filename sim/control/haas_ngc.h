// SPDX-License-Identifier: BSD-3-Clause
// The Haas NGC control, put together: flow, interpreter, contour stage, motions.
#pragma once

#include <memory>
#include <vector>

#include "sim/control/controller.h"

namespace ncsim::control {

/// RunProgram() for the dialect "haas-ngc".
RunSummary RunHaasNgc(std::shared_ptr<const nc::Program> program, const machine::Machine& machine,
                      const machine::Job& job, const machine::ToolTable& tools, SourceFiles* files,
                      std::vector<PartFrame>* part_frames, RunSink* sink);

}  // namespace ncsim::control
