// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/check_program.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "sim/app/app.h"
#include "sim/app/assumptions.h"
#include "sim/app/finding_log.h"
#include "sim/app/line_origins.h"
#include "sim/app/nominal.h"
#include "sim/app/pictures.h"
#include "sim/app/pipeline.h"
#include "sim/app/program_input.h"
#include "sim/app/tool_source.h"
#include "sim/base/text.h"
#include "sim/machine/load.h"
#include "sim/machine/margins.h"
#include "sim/machine/scene.h"

namespace ncsim::app {
namespace {

class ProgramCheck {
 public:
  ProgramCheck(const CheckOptions& options, const std::string& program,
               const ProgressReport& progress, const collision::OutcomeCache* cache,
               std::shared_ptr<const nc::Program> text, const PostedLines* posted)
      : options_(options),
        name_(program),
        progress_(progress),
        cache_(cache),
        program_(std::move(text)),
        posted_(posted),
        pictures_(options) {}

  ProgramOutcome Run() {
    outcome_.exit_code = kExitBadInput;
    const bool loaded = LoadProgram() && LoadJob() && LoadMachine() && BuildScene() &&
                        OpenTrace() && OpenPictures();
    AppendDiagnostics();
    if (!loaded) return std::move(outcome_);
    Simulate();
    if (pipeline_->motions() == 0 && !log_.HasOtherThan(Rule::kSyntax, Severity::kError)) {
      RejectMotionless();
      return std::move(outcome_);
    }
    if (!CloseTrace()) return std::move(outcome_);
    Judge();
    TraceOrigins();
    if (!WritePictures()) return std::move(outcome_);
    Report();
    outcome_.result = std::move(result_);
    outcome_.files = std::move(files_);
    return std::move(outcome_);
  }

 private:
  void Complain(const std::string& message) { outcome_.messages += message + "\n"; }

  void AppendDiagnostics() {
    for (const Diagnostic& diagnostic : diagnostics_.all()) Complain(ToString(diagnostic));
  }

  bool LoadProgram() {
    if (program_ == nullptr) program_ = nc::Program::Load(name_, &diagnostics_);
    return program_ != nullptr && !diagnostics_.has_errors();
  }

  bool LoadJob() {
    std::string complaint;
    const auto path = JobPath(name_, options_.job, &complaint);
    if (!path) {
      Complain(complaint);
      return false;
    }
    job_ = machine::LoadJob(*path, &diagnostics_);
    if (job_ && options_.clearance) job_->check.clearance = *options_.clearance;
    return job_.has_value() && !diagnostics_.has_errors();
  }

  bool LoadMachine() {
    std::string complaint;
    const auto path = ModelPath(name_, options_.model, *job_, &complaint);
    if (!path) {
      Complain(complaint);
      return false;
    }
    machine_ = machine::LoadMachine(*path, &diagnostics_);
    return machine_.has_value() && !diagnostics_.has_errors();
  }

  bool BuildScene() {
    tools_ = FindTools(*machine_, *job_, *program_);
    scene_ = machine::BuildScene(*machine_, *job_, &diagnostics_);
    if (!diagnostics_.has_errors()) {
      machine::CheckMargins(*machine_, *job_, scene_, tools_, &diagnostics_);
    }
    return !diagnostics_.has_errors();
  }

  bool OpenTrace() {
    if (options_.trace.empty()) return true;
    trace_file_.open(options_.trace, std::ios::binary | std::ios::trunc);
    if (!trace_file_) {
      Complain(options_.trace + ": error: cannot be written");
      return false;
    }
    trace_.emplace(*machine_, trace_file_);
    return true;
  }

  bool CloseTrace() {
    if (!trace_) return true;
    trace_file_.close();
    if (trace_file_) return true;
    Complain(options_.trace + ": error: could not be written to its end");
    return false;
  }

  bool OpenPictures() {
    std::string complaint;
    if (pictures_.Open(&complaint)) return true;
    Complain(complaint);
    return false;
  }

  bool WritePictures() {
    std::string complaint;
    Diagnostics missing;
    SourceLines texts(files_);
    texts.Know(0, program_);
    const bool written =
        pictures_.Write(result_, files_, &texts, pipeline_->used_tools(), &missing, &complaint);
    for (const Diagnostic& diagnostic : missing.all()) Complain(ToString(diagnostic));
    if (!written) Complain(complaint);
    return written;
  }

  /// Tells `progress_` by lines of the program itself; a subprogram's are those of its call.
  std::function<void(const motion::Window&)> WindowReport() const {
    if (!progress_) return {};
    const std::string_view text = program_->text();
    const auto lines = std::max(std::count(text.begin(), text.end(), '\n'),
                                std::count(text.begin(), text.end(), '\r'));
    return [this, lines = static_cast<double>(lines + 1), line = 0, blocks = std::uint64_t{0},
            last = SourcePosition()](const motion::Window& window) mutable {
      for (const motion::Motion& motion : window.motions) {
        const SourcePosition& where = motion.where;
        if (where.line != last.line || where.file != last.file) ++blocks;
        if (where.file == 0) line = where.line;
        last = where;
      }
      progress_(line / lines, blocks);
    };
  }

  void Simulate() {
    if (!options_.interpret_only) {
      checker_.emplace(*machine_, scene_, tools_, job_->check, cache_);
    }
    Pipeline::Parts parts;
    parts.machine = &*machine_;
    parts.tools = &tools_;
    parts.files = &files_;
    parts.part_frames = &part_frames_;
    parts.trace = trace_ ? &*trace_ : nullptr;
    pictures_.Start(*machine_, scene_, tools_);
    parts.recorder = pictures_.recorder();
    parts.collision = checker_ ? &*checker_ : nullptr;
    parts.log = &log_;
    pipeline_.emplace(parts, WindowReport());
    summary_ = control::RunProgram(program_, *machine_, *job_, tools_, &files_, &part_frames_,
                                   &*pipeline_);
    pipeline_->Finish();
  }

  void RejectMotionless() {
    SourceLines lines(files_);
    lines.Know(0, program_);
    std::ostringstream text;
    report::WriteFindings(log_.Take(), files_, std::ref(lines), text);
    outcome_.messages += text.str();
    Complain(name_ + ": error: the program moves no axis: there is nothing to check");
  }

  void AddToolAssumptions() {
    for (const int number : pipeline_->used_tools()) {
      const machine::Tool* tool = tools_.Find(number);
      if (tool == nullptr || tool->assumed.empty()) continue;
      Assume({"tool T" + std::to_string(number), tool->assumed, true, false},
             &summary_.assumptions);
    }
  }

  void Judge() {
    report::CheckResult& result = result_;
    result.not_checked = {"stock"};
    if (checker_) {
      collision::CollisionResult bodies = checker_->Finish();
      log_.Add(std::move(bodies.findings));
      result.clearances = std::move(bodies.clearances);
      result.cuts = std::move(bodies.cuts);
      result.orientation_tolerance = bodies.orientation_tolerance;
      outcome_.outcomes = bodies.outcomes;
      outcome_.recalled = bodies.recalled;
    } else {
      result.not_checked.emplace_back("collision");
      log_.Add(MakeFinding(Rule::kUncertified, {},
                           "the clearance of every pair of bodies: they were not checked "
                           "(--interpret-only)"));
    }
    for (const std::string& what : summary_.not_checked) {
      if (std::find(result.not_checked.begin(), result.not_checked.end(), what) ==
          result.not_checked.end()) {
        result.not_checked.push_back(what);
      }
    }
    AddToolAssumptions();
    for (Assumption& a : NominalShapes(*machine_, scene_, result.clearances)) {
      Assume(std::move(a), &summary_.assumptions);
    }
    if (checker_) {
      for (Assumption& a :
           NominalToolChange(*machine_, scene_, tools_, pipeline_->tool_changes())) {
        Assume(std::move(a), &summary_.assumptions);
      }
    }
    for (const std::string& name : Accept(options_.assume, &summary_.assumptions)) {
      Complain(name_ + ": warning: --assume '" + name + "': nothing of that name was assumed" +
               DidYouMean(name, AssumptionNames()));
    }
    log_.Add(OpenAssumptions(summary_.assumptions, options_.strict));
    if (!summary_.finished && !log_.Has(Severity::kError)) {
      log_.Add(MakeFinding(Rule::kUncertified, {},
                           "the program was not followed to its end: the rest was not checked"));
    }
    result.findings = log_.Take();
    result.assumptions = summary_.assumptions;
    result.verdict = ncsim::Judge(result.findings, result.assumptions, options_.strict);
    result.program = name_;
    result.model = machine_->name;
    result.job = job_->path;
    result.blocks = summary_.blocks;
    result.motion_time = summary_.motion_time;
  }

  void TraceOrigins() {
    SourceLines texts(files_);
    texts.Know(0, program_);
    LineOrigins origins(&files_, &texts, posted_);
    origins.Trace(&result_.findings);
    for (const std::string& note : origins.notes()) Complain(note);
  }

  std::vector<std::string> AssumptionNames() const {
    std::vector<std::string> names;
    for (const Assumption& assumption : summary_.assumptions) names.push_back(assumption.name);
    return names;
  }

  void Report() {
    std::ostringstream text;
    if (options_.format == Format::kJson) {
      report::WriteJson(result_, files_, text);
    } else if (options_.format == Format::kText) {
      SourceLines lines(files_);
      lines.Know(0, program_);
      report::WriteText(result_, files_, std::ref(lines), text);
    }
    outcome_.report = std::move(text).str();
    outcome_.summary = name_ + ": " + report::Summary(result_);
    outcome_.exit_code = ExitOf(result_.verdict);
  }

  const CheckOptions& options_;
  const std::string name_;
  const ProgressReport& progress_;
  const collision::OutcomeCache* cache_;
  ProgramOutcome outcome_;
  Diagnostics diagnostics_;
  std::shared_ptr<const nc::Program> program_;
  const PostedLines* posted_;
  std::optional<machine::Job> job_;
  std::optional<machine::Machine> machine_;
  machine::ToolTable tools_;
  machine::Scene scene_;
  std::ofstream trace_file_;
  std::optional<report::TraceWriter> trace_;
  std::optional<collision::CollisionChecker> checker_;
  SourceFiles files_;
  std::vector<control::PartFrame> part_frames_;
  FindingLog log_;
  Pictures pictures_;
  std::optional<Pipeline> pipeline_;
  control::RunSummary summary_;
  report::CheckResult result_;
};

}  // namespace

ProgramOutcome CheckProgram(const CheckOptions& options, const std::string& program,
                            const ProgressReport& progress, const collision::OutcomeCache* cache,
                            std::shared_ptr<const nc::Program> text, const PostedLines* posted) {
  return ProgramCheck(options, program, progress, cache, std::move(text), posted).Run();
}

}  // namespace ncsim::app
