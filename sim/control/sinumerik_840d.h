// SPDX-License-Identifier: BSD-3-Clause
// The SINUMERIK 840D sl control, put together: flow, interpreter, contour stage, motions.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/control/controller.h"
#include "sim/control/sinumerik_flow.h"

namespace ncsim::control {

/// The dialect that the model names.
inline constexpr const char* kSinumerik840d = "sinumerik-840d";

/// RunProgram() for it; stopped after `max_blocks`.
RunSummary RunSinumerik840d(std::shared_ptr<const nc::Program> program,
                            const machine::Machine& machine, const machine::Job& job,
                            const machine::ToolTable& tools, SourceFiles* files,
                            std::vector<PartFrame>* part_frames, RunSink* sink,
                            std::uint64_t max_blocks = kMaxSinumerikBlocks);

}  // namespace ncsim::control
