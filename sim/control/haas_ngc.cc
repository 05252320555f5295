// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/haas_ngc.h"

#include <utility>

#include "sim/control/flow.h"
#include "sim/control/haas_interpreter.h"
#include "sim/control/haas_variables.h"
#include "sim/control/run_start.h"

namespace ncsim::control {
namespace {

// A 0 in the diameters is "not stated": then a degree is a unit.
MotionOptions ToMotionOptions(const HaasSettings& settings) {
  MotionOptions options;
  options.track_tcp_rapids = settings.track_tcp_rapids;
  options.rotary_diameter = settings.rotary_diameter;
  options.degree_counts_as = settings.mm_per_unit();
  return options;
}

FlowOptions ToFlowOptions(const machine::Machine& machine, const machine::Job& job,
                          const SettingSource& source, const HaasSettings& settings) {
  FlowOptions options;
  options.block_delete = settings.block_skip;
  options.optional_stop = settings.optional_stop;
  options.subprogram_folders = SubprogramFolders(machine, job);
  for (const char* setting : {"setting 251", "setting 252"}) {
    if (const auto folder = source.Text(setting)) options.subprogram_folders.push_back(*folder);
  }
  return options;
}

}  // namespace

RunSummary RunHaasNgc(std::shared_ptr<const nc::Program> program, const machine::Machine& machine,
                      const machine::Job& job, const machine::ToolTable& tools, SourceFiles* files,
                      std::vector<PartFrame>* part_frames, RunSink* sink) {
  RunSummary summary;
  RunLog log(sink, &summary);
  const SettingSource source(machine, job);
  const HaasSettings settings = ReadHaasSettings(source, machine, *program, &log);
  HaasRegisters registers(machine, job, tools, !settings.diameter_d);
  PartFrames frames_table(machine, part_frames);
  Frames frames(machine, MakeControlKinematics(machine, settings.rotary_centre));
  const AxisValues start = StartPosition(machine, job, &log);
  AssumeRates(machine, &log);
  ToMotion to_motion(machine, &frames, ToMotionOptions(settings), start, sink, &log, &summary);
  const CodeIndex codes(nc::HaasNgc());
  HaasInterpreter interpreter(
      {&machine, &tools, &settings, &source, &registers, &frames_table, &frames, &to_motion, &log},
      codes, MotionlessCodes(machine, job), job.start_tool);
  HaasVariables variables(machine, settings, source, &registers, &interpreter, &log);
  Flow flow(std::move(program), ToFlowOptions(machine, job, source, settings), &variables, files,
            [&log](Finding finding) { log.Report(std::move(finding)); });

  ResolvedBlock block;
  FlowEvent event = FlowEvent::kBlock;
  while (!log.stopped() && (event = flow.Next(&block)) == FlowEvent::kBlock) {
    interpreter.Execute(&block);
    variables.SetWhere(block.where);
    if (interpreter.ended()) flow.End();
  }
  interpreter.Finish();
  log.Finish();
  summary.blocks = flow.blocks_executed();
  summary.finished = !log.stopped() && event == FlowEvent::kProgramEnd;
  return summary;
}

}  // namespace ncsim::control
