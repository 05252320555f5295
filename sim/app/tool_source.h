// SPDX-License-Identifier: BSD-3-Clause
// Which tools are in the machine: the job's; else what the program's own header comments list; else
// assumed ones.
#pragma once

#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/tool.h"
#include "sim/nc/program.h"

namespace ncsim::app {

/// The job's tools, where it states any. Else a tool for each T number that the header comments or
/// the blocks of `program` name; what the comments do not say is assumed (Tool::assumed). A T
/// number that is computed is not known here.
machine::ToolTable FindTools(const machine::Machine& machine, const machine::Job& job,
                             const nc::Program& program);

/// mm in a unit of a Haas program's words and header comments.
double ProgramUnit(const machine::Machine& machine, const machine::Job& job,
                   const nc::Program& program);

}  // namespace ncsim::app
