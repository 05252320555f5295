// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_840d.h"

#include <utility>

#include "sim/base/diagnostics.h"
#include "sim/control/control_kinematics.h"
#include "sim/control/run_start.h"
#include "sim/control/sinumerik_interpreter.h"
#include "sim/control/sinumerik_system.h"

namespace ncsim::control {
namespace {

SinumerikFlowOptions ToFlowOptions(const machine::Machine& machine, const machine::Job& job,
                                   const SinumerikSettings& settings) {
  SinumerikFlowOptions options;
  options.skip_levels = settings.skip_levels;
  options.subprogram_folders = SubprogramFolders(machine, job);
  return options;
}

/// G0 under TRAORI is straight in the part; feeds slow down for the slowest axis.
MotionOptions ToMotionOptions() {
  MotionOptions options;
  options.track_tcp_rapids = true;
  options.rotary_follows = true;
  options.slows_down = true;
  options.rounds_rapids = true;  // STOLF, MD20560: the standard factor of G0 is 1
  return options;
}

/// CHANDATA(1), as the control writes it before the data of a channel.
bool IsFirstChannel(const SinumerikStep& step, const SinumerikItem& item) {
  return item.kind == SinumerikItemKind::kCall && item.command->name == "CHANDATA" &&
         item.value_count == 1 && step.argument(item, 0).number == 1.0;
}

/// Files of tool and work offsets are NC code: they are run first, and may move nothing.
void RunDataFiles(const machine::Job& job, Sinumerik840dSystem* system, SourceFiles* files,
                  RunLog* log) {
  for (const std::string& path : job.data_files) {
    Diagnostics diagnostics;
    const auto text = nc::Program::Load(path, &diagnostics);
    if (text == nullptr) {
      SourcePosition where;
      where.file = files->Add(path);
      log->Alarm(Rule::kControlAlarm, where, "the file of offsets cannot be read");
      return;
    }
    SinumerikFlow flow(text, {}, system, files,
                       [log](Finding finding) { log->Report(std::move(finding)); });
    SinumerikStep step;
    SinumerikEvent event = SinumerikEvent::kStep;
    while ((event = flow.Next(&step)) != SinumerikEvent::kEnd) {
      if (event == SinumerikEvent::kStopped) return log->Stop();
      if (event != SinumerikEvent::kStep) continue;
      for (const SinumerikItem& item : step.items) {
        if (item.used || IsFirstChannel(step, item)) continue;
        log->Report(Rule::kUnsupportedCode, step.where, "a file of offsets may set variables only");
        break;
      }
    }
  }
}

/// MCALL behind the motion of a block, and behind each position of a pattern of holes.
void CallModally(SinumerikFlow* flow, SinumerikInterpreter* interpreter, const RunLog& log) {
  do {
    if (log.stopped() || !interpreter->moved()) continue;
    const SinumerikModalCall* call = flow->PathMotionDone();
    if (call != nullptr) interpreter->ExecuteCycle(*call->command, call->arguments, call->where);
    // A subprogram of the user's runs block by block; its end leads to the next position.
  } while (!flow->busy() && interpreter->NextPosition());
}

}  // namespace

RunSummary RunSinumerik840d(std::shared_ptr<const nc::Program> program,
                            const machine::Machine& machine, const machine::Job& job,
                            const machine::ToolTable& tools, SourceFiles* files,
                            std::vector<PartFrame>* part_frames, RunSink* sink,
                            std::uint64_t max_blocks) {
  RunSummary summary;
  RunLog log(sink, &summary);
  const SettingSource source(machine, job);
  const SinumerikSettings settings = ReadSinumerikSettings(source, machine, job, &log);
  SinumerikRegisters registers(machine, job, tools);
  Sinumerik840dSystem system(machine, settings, &registers, &log);
  PartFrames frames_table(machine, part_frames);
  Frames frames(machine, MakeControlKinematics(machine, std::nullopt));
  const AxisValues start = StartPosition(machine, job, &log);
  AssumeRates(machine, &log);
  // The names of the texts begin with the main program's.
  SinumerikFlowOptions options = ToFlowOptions(machine, job, settings);
  options.max_blocks = max_blocks;
  SinumerikFlow flow(std::move(program), std::move(options), &system, files,
                     [&log](Finding finding) { log.Report(std::move(finding)); });
  RunDataFiles(job, &system, files, &log);
  ToMotion to_motion(machine, &frames, ToMotionOptions(), start, sink, &log, &summary);
  SinumerikInterpreter interpreter(
      {&machine, &tools, &settings, &registers, &frames_table, &frames, &to_motion, &log},
      MotionlessCodes(machine, job), job.start_tool);
  system.SetInterpreter(&interpreter);

  SinumerikStep step;
  SinumerikEvent event = SinumerikEvent::kStep;
  while (!log.stopped()) {
    event = flow.Next(&step);
    if (event == SinumerikEvent::kEnd || event == SinumerikEvent::kStopped) break;
    if (event == SinumerikEvent::kSave) interpreter.Save();
    if (event == SinumerikEvent::kRestore) interpreter.Restore();
    if (event == SinumerikEvent::kStep) interpreter.Execute(&step);
    if (event == SinumerikEvent::kModalEnd && !interpreter.NextPosition()) continue;
    if (event != SinumerikEvent::kStep && event != SinumerikEvent::kModalEnd) continue;
    CallModally(&flow, &interpreter, log);
  }
  interpreter.Finish();
  log.Finish();
  summary.blocks = flow.blocks_executed();
  summary.finished = !log.stopped() && event == SinumerikEvent::kEnd;
  return summary;
}

}  // namespace ncsim::control
