// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/compare_command.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "post/cl_path.h"
#include "sim/app/app.h"
#include "sim/app/assumptions.h"
#include "sim/app/finding_log.h"
#include "sim/app/program_input.h"
#include "sim/app/tool_source.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/compare/cl_toolpath.h"
#include "sim/compare/nc_path.h"
#include "sim/control/sinumerik_840d.h"
#include "sim/machine/load.h"
#include "sim/report/compare_result.h"

namespace ncsim::app {
namespace {

/// The deviation that is allowed beside one output increment, mm and deg.
constexpr double kPosition = 0.005, kAngle = 0.01;

/// The tested program is followed first.
constexpr int kTestedFile = 0;

/// What the last digit of a post's words counts: position mm, feed mm/s.
struct Increments {
  double position = 0.001, feed = 1.0 / 60.0;
};

Increments IncrementsOf(const machine::Machine& machine, const machine::Job& job,
                        const nc::Program& program) {
  const bool inch = machine.control.dialect != control::kSinumerik840d &&
                    ProgramUnit(machine, job, program) == kMmPerInch;
  return inch ? Increments{0.0001 * kMmPerInch, 0.1 * kMmPerInch / 60.0} : Increments();
}

/// By its content: a statement GOTO/x,y,z, which no control has.
bool IsClFile(const nc::Program& program) {
  const std::string_view text = program.text();
  for (std::size_t at = program.begin(); at < text.size();) {
    const std::string_view line = program.Line(at);
    const std::size_t word = line.find_first_not_of(" \t");
    if (word != std::string_view::npos && line.substr(word).starts_with("GOTO")) {
      const std::size_t next = line.find_first_not_of(" \t", word + 4);
      if (next != std::string_view::npos && line[next] == '/') return true;
    }
    at += line.size() + 1;
  }
  return false;
}

/// One of the two programs, read and followed.
struct Side {
  std::string name, model_option, job_option;
  std::shared_ptr<const nc::Program> program;
  machine::Job job;
  bool cl = false;  ///< A cutter-location file: no control, no machine.
  std::optional<machine::Machine> machine;
  Increments increments;
  report::ComparedProgram report;
  compare::Toolpath path;
  std::vector<Finding> findings;
};

class Comparing {
 public:
  Comparing(const CompareOptions& options, std::ostream& err) : options_(options), err_(&err) {
    reference_.name = options.reference;
    reference_.model_option = options.model;
    reference_.job_option = options.job;
    tested_.name = options.tested;
    tested_.model_option = options.model_b.empty() ? options.model : options.model_b;
    tested_.job_option = options.job_b.empty() ? options.job : options.job_b;
  }

  /// `tested`: the text of B where it is in no file; else null.
  bool Hold(std::shared_ptr<const nc::Program> tested) {
    tested_.program = std::move(tested);
    if (!Load(&reference_) || !Load(&tested_)) return false;
    // What the CAM system meant is what is right.
    if (tested_.cl && !reference_.cl) std::swap(reference_, tested_);
    SetTolerances();
    // The tested program first: its findings, and its files, come first.
    if (!Follow(&tested_) || !Follow(&reference_)) return false;
    Judge();
    return true;
  }

  std::string Text() const {
    std::ostringstream text;
    if (options_.format == Format::kJson) {
      report::WriteJson(result_, files_, text);
    } else {
      SourceLines lines(files_);
      lines.Know(kTestedFile, tested_.program);
      report::WriteText(result_, files_, std::ref(lines), text);
    }
    return std::move(text).str();
  }

  bool Write(std::ostream& out) {
    if (options_.out.empty()) {
      out << Text();
      return true;
    }
    std::ofstream file(options_.out, std::ios::binary | std::ios::trunc);
    file << Text();
    file.close();
    if (!file) return Complain(options_.out + ": error: cannot be written");
    out << report::Summary(result_) << "\n";
    return true;
  }

  const report::CompareResult& result() const { return result_; }

 private:
  bool Complain(const std::string& message) {
    *err_ << message << "\n";
    return false;
  }

  bool Fine(const Diagnostics& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics.all()) Complain(ToString(diagnostic));
    return !diagnostics.has_errors();
  }

  bool Load(Side* side) {
    Diagnostics diagnostics;
    if (side->program == nullptr) side->program = nc::Program::Load(side->name, &diagnostics);
    if (side->program == nullptr || !Fine(diagnostics)) return Fine(diagnostics);
    side->report.program = side->name;
    side->cl = IsClFile(*side->program);
    if (side->cl) {
      side->increments = {0.0, 0.0};
      return true;
    }
    std::string complaint;
    auto job_path = JobPath(side->name, side->job_option, &complaint);
    if (!job_path) return Complain(complaint);
    if (job_path->empty()) job_path = reference_.job.path;  // "" while that is read.
    const auto job = machine::LoadJob(*job_path, &diagnostics);
    if (!job || !Fine(diagnostics)) return Fine(diagnostics);
    side->job = *job;
    const auto model_path = ModelPath(side->name, side->model_option, side->job, &complaint);
    if (!model_path) return Complain(complaint);
    side->machine = machine::LoadMachine(*model_path, &diagnostics);
    if (!side->machine) return Fine(diagnostics);
    if (!side->machine->five_axis) {
      return Complain(side->name + ": error: " + side->machine->name +
                      " has not three linear axes: the tool's way in the part is not known");
    }
    side->increments = IncrementsOf(*side->machine, side->job, *side->program);
    side->report = {side->name, side->machine->name, side->job.path, "", 0, {}};
    return Fine(diagnostics);
  }

  void SetTolerances() {
    compare::Tolerances& tolerances = result_.tolerances;
    const double increment = std::max(reference_.increments.position, tested_.increments.position);
    const double used = increment > 0.0 ? increment : Increments().position;
    tolerances.position = options_.tolerance.value_or(kPosition + used);
    tolerances.angle = Radians(options_.angle_tolerance.value_or(kAngle));
    tolerances.feed_resolution =
        0.5 * std::max(reference_.increments.feed, tested_.increments.feed);
  }

  bool Follow(Side* side) { return side->cl ? FollowCl(side) : FollowNc(side); }

  post::ClOptions ClOptionsOf() const {
    post::ClOptions options;
    options.need_tool = false;  // Tools are not compared.
    options.unit = options_.cl.unit;
    options.flavour = options_.cl.flavour;
    return options;
  }

  bool FollowCl(Side* side) {
    Diagnostics diagnostics;
    post::ClPath path(side->program, files_.Add(side->name), ClOptionsOf(), &diagnostics);
    compare::ClToolpath toolpath(compare::ChordErrorFor(result_.tolerances));
    for (post::ClEvent event; path.Next(&event); ++side->report.blocks) toolpath.OnEvent(event);
    if (!Fine(diagnostics)) return false;
    side->findings = toolpath.TakeFindings();
    side->path = toolpath.Take();
    return toolpath.motions() > 0 || Motionless(*side);
  }

  bool Motionless(const Side& side) {
    return Complain(side.name + ": error: the program moves no axis: there is nothing to compare");
  }

  /// A cutter-location file in which cutter compensation is on.
  bool Compensates(const Side& side) const {
    if (!side.cl || side.program->text().find("CUTCOM") == std::string_view::npos) return false;
    Diagnostics diagnostics;
    post::ClPath path(side.program, 0, ClOptionsOf(), &diagnostics);
    for (post::ClEvent event; path.Next(&event);) {
      if (event.modal->comp.side != post::cl::CutterComp::Side::kOff) return true;
    }
    return false;
  }

  bool FollowNc(Side* side) {
    machine::ToolTable tools = FindTools(*side->machine, side->job, *side->program);
    const Side& other = side == &tested_ ? reference_ : tested_;
    const bool wear = !side->job.has_tools && Compensates(other);
    if (wear) {
      for (machine::Tool& tool : tools.tools) tool.d_geometry = 0.0;
    }
    std::vector<control::PartFrame> part_frames;
    compare::NcPath path(*side->machine, tools, part_frames,
                         compare::ChordErrorFor(result_.tolerances), side->increments.position);
    const control::RunSummary summary = control::RunProgram(
        side->program, *side->machine, side->job, tools, &files_, &part_frames, &path);
    side->report.frame = path.frame();
    side->report.blocks = summary.blocks;
    side->report.assumptions = summary.assumptions;
    if (wear) {
      side->report.assumptions.push_back(
          {"cutter compensation",
           "the radius in D of each tool is its wear alone, taken as 0, for the points of " +
               std::filesystem::path(other.name).filename().string() +
               " are those of the tool's centre",
           true, false});
    }
    side->findings = path.TakeFindings();
    side->path = path.Take();
    if (path.motions() == 0 && side->findings.empty()) return Motionless(*side);
    if (!summary.finished && side->findings.empty()) {
      side->findings.push_back(
          MakeFinding(Rule::kUncertified, {}, side->name + " was not followed to its end"));
    }
    return true;
  }

  void Judge() {
    std::vector<Assumption> all;
    std::vector<std::string> unused = options_.assume;
    for (Side* side : {&tested_, &reference_}) {
      const std::vector<std::string> left = Accept(options_.assume, &side->report.assumptions);
      std::erase_if(unused, [&](const std::string& name) {
        return std::find(left.begin(), left.end(), name) == left.end();
      });
      log_.Add(std::move(side->findings));
      for (const Assumption& assumption : side->report.assumptions) {
        Assume(assumption, &all);
      }
    }
    for (const std::string& name : unused) {
      Complain("ncsim: warning: --assume '" + name + "': nothing of that name was assumed");
    }
    log_.Add(OpenAssumptions(all, options_.strict));
    result_.comparison = compare::Compare(std::move(reference_.path), std::move(tested_.path),
                                          result_.tolerances, files_);
    log_.Add(std::move(result_.comparison.findings));
    if (result_.comparison.runs == 0 && !log_.Has(Severity::kError)) {
      log_.Add(MakeFinding(Rule::kUncertified, {},
                           "there is no feed that both programs have: nothing was held together"));
    }
    result_.findings = log_.Take();
    result_.verdict = ncsim::Judge(result_.findings, all, options_.strict);
    result_.reference = reference_.report;
    result_.tested = tested_.report;
  }

  const CompareOptions& options_;
  std::ostream* err_;
  Side reference_, tested_;
  SourceFiles files_;
  FindingLog log_;
  report::CompareResult result_;
};

}  // namespace

int Compare(const CompareOptions& options, std::ostream& out, std::ostream& err) {
  Comparing comparing(options, err);
  if (!comparing.Hold(nullptr) || !comparing.Write(out)) return kExitBadInput;
  return ExitOf(comparing.result().verdict);
}

HeldTogether CompareText(const CompareOptions& options, std::shared_ptr<const nc::Program> tested,
                         std::ostream& err) {
  Comparing comparing(options, err);
  if (!comparing.Hold(std::move(tested))) return {kExitBadInput, ""};
  const report::CompareResult& result = comparing.result();
  const bool pass = result.verdict == Verdict::kPass;
  return {ExitOf(result.verdict), pass ? report::Nearness(result) + "\n" : comparing.Text()};
}

}  // namespace ncsim::app
