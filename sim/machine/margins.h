// SPDX-License-Identifier: BSD-3-Clause
// How near two bodies may come before it is a near miss, where a pair has a number of its own.
#pragma once

#include <string_view>

#include "sim/base/diagnostics.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"

namespace ncsim::machine {

/// A body as far as margins tell bodies apart.
struct MarginBody {
  std::string_view name;  ///< As reports have it: "T3.holder", "vise_jaw", "z_head/2".
  BodyKind kind = BodyKind::kMachine;
  int link = 0;
};

/// The clearance (mm) below which the pair is a near miss: the job's margin for it, else that of
/// the model (SRDF), else the general one. A name of the job's fits the body that has it; "holder"
/// the holder of each tool (as "shank", "flutes"); a link's name each shape of the link. Where
/// several margins fit, more names that are the bodies' own win, then the greater clearance.
double NearMissClearance(const Machine& machine, const CheckSettings& settings, const MarginBody& a,
                         const MarginBody& b);

/// Reports margins of the job that name no body or two of a tool, and warns of those that judge no
/// pair.
void CheckMargins(const Machine& machine, const Job& job, const Scene& scene,
                  const ToolTable& tools, Diagnostics* diagnostics);

/// Warns of margins of the model that judge no pair; `file` is its SRDF.
void CheckMargins(const Machine& machine, const std::string& file, Diagnostics* diagnostics);

}  // namespace ncsim::machine
