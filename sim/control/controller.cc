// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/controller.h"

#include <string>
#include <utility>

#include "sim/control/haas_ngc.h"
#include "sim/control/sinumerik_840d.h"
#include "sim/nc/code_table.h"

namespace ncsim::control {

RunSummary RunProgram(std::shared_ptr<const nc::Program> program, const machine::Machine& machine,
                      const machine::Job& job, const machine::ToolTable& tools, SourceFiles* files,
                      std::vector<PartFrame>* part_frames, RunSink* sink) {
  const std::string& dialect = machine.control.dialect;
  if (dialect == nc::HaasNgc().id) {
    return RunHaasNgc(std::move(program), machine, job, tools, files, part_frames, sink);
  }
  if (dialect == kSinumerik840d) {
    return RunSinumerik840d(std::move(program), machine, job, tools, files, part_frames, sink);
  }
  SourcePosition where;
  where.file = files->Add(program->name());
  sink->OnFinding(MakeFinding(
      Rule::kUnsupportedCode, where,
      dialect.empty() ? "the model states no control, so the program was not simulated"
                      : "no program of the control '" + dialect + "' can be simulated"));
  return {};
}

}  // namespace ncsim::control
