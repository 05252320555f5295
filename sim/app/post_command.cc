// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/post_command.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "post/post_options.h"
#include "post/post_program.h"
#include "sim/app/app.h"
#include "sim/app/compare_command.h"
#include "sim/app/line_origins.h"
#include "sim/app/post_candidates.h"
#include "sim/app/program_input.h"
#include "sim/base/digest.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/part_frames.h"
#include "sim/machine/load.h"
#include "sim/report/result.h"

namespace ncsim::app {
namespace {

namespace fs = std::filesystem;

/// Candidates that are checked at most: each costs a whole run.
constexpr int kMaxCandidates = 40;

/// mm that a tool's diameter may differ: files print four decimals, some in inches.
constexpr double kSameDiameter = 0.005;

/// 123 of "O00123", where a name is such.
std::optional<int> NumberOf(const std::string& name) {
  if (name.size() < 2 || (name[0] != 'O' && name[0] != 'o')) return std::nullopt;
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + 1, end, number);
  if (error != std::errc() || stop != end || number < 1) return std::nullopt;
  return number;
}

/// A rotary axis carries the spindle.
bool SpindleTurns(const machine::Machine& machine) {
  const auto joints = machine.tree.MovingJointsTo(machine.five_axis->spindle_link());
  const std::vector<int>& rotary = machine.five_axis->rotary();
  return std::any_of(rotary.begin(), rotary.end(), [&](int joint) {
    return std::any_of(joints.begin(), joints.end(), [&](int j) {
      return machine.tree.joints()[static_cast<std::size_t>(j)].index == joint;
    });
  });
}

class Posting {
 public:
  Posting(const PostCommandOptions& options, std::ostream& err) : options_(options), err_(&err) {}

  int Run(std::ostream& out) {
    const bool loaded = LoadJob() && LoadMachine() && LoadPost() && LoadCl() && Place();
    if (!loaded) return kExitBadInput;
    HoldTools();
    if (!Say(diagnostics_)) return kExitBadInput;
    const post::PlanOptions options = PlanOptions();
    const int limit = checked_ ? kMaxCandidates : 1;
    std::vector<std::string> notes;
    std::optional<Judged> best =
        FindPassing([&](const auto& choice) { return Candidate(options, choice); }, limit, &notes);
    if (!best) Say(unposted_);
    if (!best || !Write(best->program, out) || !WriteMaps(best->program)) return kExitBadInput;
    for (const std::string& note : notes) Complain(name_ + ": note: " + note);
    std::ostream& report = options_.out.empty() ? *err_ : out;
    TellWritten(best->program, report);
    if (!options_.check) return kExitPass;
    const int held = HoldAgainstCl(best->program, report);
    *err_ << best->outcome.messages;
    return CombinedExit({held, TellChecked(best->outcome, report)});
  }

 private:
  bool Complain(const std::string& message) {
    *err_ << message << "\n";
    return false;
  }
  /// False where there are errors; these come first.
  bool Say(const Diagnostics& diagnostics) {
    for (const Diagnostic::Level level : {Diagnostic::Level::kError, Diagnostic::Level::kWarning}) {
      for (const Diagnostic& diagnostic : diagnostics.all()) {
        if (diagnostic.level == level) Complain(ToString(diagnostic));
      }
    }
    return !diagnostics.has_errors();
  }

  bool LoadJob() {
    std::string complaint;
    std::optional<std::string> path;
    if (!options_.out.empty()) {
      path = JobPath(options_.out, options_.job, &complaint);
      if (!path) return Complain(complaint);
    }
    if (!path || path->empty()) path = JobPath(options_.cl_file, options_.job, &complaint);
    if (!path) return Complain(complaint);
    checked_ = options_.check && !path->empty();
    const auto job = machine::LoadJob(*path, &diagnostics_);
    if (!job || diagnostics_.has_errors()) return Say(diagnostics_) && false;
    job_ = *job;
    return true;
  }

  bool LoadMachine() {
    std::string complaint;
    const auto path = ModelPath(options_.cl_file, options_.model, job_, &complaint);
    if (!path) return Complain(complaint);
    model_path_ = *path;
    machine_ = machine::LoadMachine(*path, &diagnostics_);
    if (!machine_) return Say(diagnostics_) && false;
    if (machine_->five_axis) return true;
    return Complain(machine_->name + ": error: the machine has not three linear axes");
  }

  bool LoadPost() {
    std::string path = options_.post;
    if (path.empty()) path = fs::path(model_path_).replace_extension(".post.toml").string();
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) {
      return Complain(path + ": error: cannot be read" +
                      (options_.post.empty() ? ": name the post of this machine with --post" : ""));
    }
    const post::PostSettings settings{options_.unit, options_.constants};
    post_ = post::LoadPost(text.str(), path, settings, &diagnostics_);
    if (!post_) return Say(diagnostics_) && false;
    if (post_->dialect != machine_->control.dialect) {
      return Complain(path + ": error: it writes " + post_->dialect + ", and the control of " +
                      machine_->name + " reads " + machine_->control.dialect);
    }
    if (options_.mode.empty() || post_->ModeNamed(options_.mode) != nullptr) return true;
    std::vector<std::string> modes;
    std::string list;
    for (const post::PostMode& mode : post_->modes) {
      modes.push_back(mode.name);
      list += (list.empty() ? "" : ", ") + mode.name;
    }
    return Complain(path + ": error: no mode '" + options_.mode + "'" +
                    DidYouMean(options_.mode, modes) + "; there are " + list);
  }

  bool LoadCl() {
    cl_ = nc::Program::Load(options_.cl_file, &diagnostics_);
    if (cl_ == nullptr || diagnostics_.has_errors()) return Say(diagnostics_) && false;
    cl_options_.unit = options_.cl.unit;
    cl_options_.flavour = options_.cl.flavour;
    cl_options_.first_tool = options_.first_tool;
    summary_ = post::ReadCl(cl_, cl_options_, &diagnostics_);
    if (diagnostics_.has_errors()) return Say(diagnostics_) && false;
    const int pockets = machine_->control.tool_pockets;
    for (const post::ToolUse& use : summary_.tools) {
      const int number = use.tool.number.value_or(0);
      if (pockets == 0 || number <= pockets) continue;
      diagnostics_.Error(options_.cl_file, use.where.line, use.where.column,
                         "T" + std::to_string(number) + ": the tool changer of " + machine_->name +
                             " has " + std::to_string(pockets) + " pockets");
    }
    if (diagnostics_.has_errors()) return Say(diagnostics_) && false;
    if (summary_.motions > 0) return true;
    return Complain(options_.cl_file + ": error: the file moves no tool: there is nothing to post");
  }

  /// Where the part stands on the table: what words of the mode "axes" are worked out from.
  bool Place() {
    const auto rotary = post_->Increment(post::Value::kRotary1);
    const double increment = Radians(rotary > 0.0 ? rotary : 0.001);
    control::AxisValues values = control::GaugeAtMount(*machine_);
    if (const auto offset = post_->constants.find("offset"); offset != post_->constants.end()) {
      if (const auto stated = control::JobOffset(*machine_, job_, offset->second)) values = *stated;
    }
    const post::PostMode* mode = post_->ModeNamed(options_.mode);
    if (mode != nullptr && mode->kind == post::PlanMode::kAxes && SpindleTurns(*machine_)) {
      return Complain("ncsim: mode '" + options_.mode +
                      "' is for machines whose tables turn: " + machine_->name +
                      " turns the spindle, and its words would be those of one tool length");
    }
    std::vector<control::PartFrame> frames;
    control::PartFrames(*machine_, &frames).Index("", values);
    geometry_.emplace(*machine_, frames.front().X_BP, increment);
    const fs::path named = options_.out.empty() ? options_.cl_file : options_.out;
    name_ = options_.out.empty() ? named.stem().string() + post_->extension : options_.out;
    posting_.cl = cl_;
    posting_.cl_options = cl_options_;
    posting_.post = &*post_;
    posting_.geometry = &*geometry_;
    posting_.file_for_operation = options_.file_for_operation;
    posting_.info.name = named.stem().string();
    posting_.info.number = options_.number ? options_.number : NumberOf(posting_.info.name);
    if (!posting_.info.number) posting_.info.number = 1;
    posting_.info.source = options_.cl_file;
    posting_.info.mode = options_.mode;
    posting_.info.tools = summary_.tools;
    return true;
  }

  /// The tools of the job are what the machine has; a file made for others would cut another part.
  void HoldTools() {
    if (!job_.has_tools) return;
    const machine::ToolTable table{job_.tools};
    for (const post::ToolUse& use : summary_.tools) {
      if (!use.tool.number) continue;
      const std::string name = "T" + std::to_string(*use.tool.number);
      const machine::Tool* stated = table.Find(*use.tool.number);
      if (stated == nullptr) continue;
      const double width = use.tool.diameter.value_or(stated->diameter);
      if (std::abs(stated->diameter - width) > kSameDiameter) {
        diagnostics_.Warning(job_.path, 0, 0,
                             name + " cuts " + Short(stated->diameter) +
                                 " mm wide in the job, and " + Short(width) + " mm in " +
                                 options_.cl_file);
      }
      if (use.compensated && HasRadius(*stated)) {
        diagnostics_.Warning(job_.path, 0, 0,
                             "D of " + name + " has the tool's radius, and the points of " +
                                 options_.cl_file + " are those of its centre: d_geometry = 0");
      }
    }
  }

  /// In a register of the control.
  static bool HasRadius(const machine::Tool& tool) {
    if (tool.edges.empty()) return tool.d_geometry != 0.0;
    return std::any_of(tool.edges.begin(), tool.edges.end(),
                       [](const machine::ToolEdge& edge) { return edge.diameter != 0.0; });
  }

  post::PlanOptions PlanOptions() const {
    post::PlanOptions options = post::PlanOptionsOf(*post_, options_.mode);
    options.separate = options_.file_for_operation;
    if (options_.tolerance) options.tolerance = *options_.tolerance;
    return options;
  }

  /// Posts one candidate, and checks it where that can be done.
  std::optional<Judged> Candidate(post::PlanOptions options,
                                  const std::map<int, std::size_t>& choice) {
    options.choice = choice;
    Diagnostics diagnostics;
    Judged judged;
    judged.program = post::PostProgram(posting_, options, &diagnostics);
    // Each candidate has the same warnings; that another way cannot be posted is a note.
    if (choice.empty() && !Say(diagnostics)) return std::nullopt;
    if (diagnostics.has_errors()) {
      unposted_ = diagnostics;
      return std::nullopt;
    }
    if (!checked_) return judged;
    if (!WriteOperations(judged.program)) return std::nullopt;
    CheckOptions check;
    check.model = model_path_;
    check.job = job_.path;
    check.assume = options_.assume;
    check.strict = options_.strict;
    PostedLines posted{options_.cl_file, {}};
    for (const post::PostedFile& file : judged.program.files) {
      posted.lines[PathOf(file)] = file.lines;
    }
    judged.outcome =
        CheckProgram(check, name_, {}, nullptr,
                     nc::Program::FromText(name_, judged.program.files.front().text), &posted);
    return judged;
  }

  bool WriteFile(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    return file ? true : Complain(path + ": error: cannot be written");
  }

  /// The program itself, or the file of an operation beside it.
  std::string PathOf(const post::PostedFile& file) const {
    if (file.name.empty()) return name_;
    return (fs::path(options_.out).parent_path() / file.name).string();
  }

  bool WriteOperations(const post::PostedProgram& program) {
    for (std::size_t i = 1; i < program.files.size(); ++i) {
      if (!WriteFile(PathOf(program.files[i]), program.files[i].text)) return false;
    }
    return true;
  }

  /// `--map`
  bool WriteMaps(const post::PostedProgram& program) {
    if (!options_.map) return true;
    const fs::path cl = fs::absolute(options_.cl_file).lexically_normal();
    const fs::path folder = fs::absolute(options_.out).lexically_normal().parent_path();
    for (const post::PostedFile& file : program.files) {
      const post::LineMapFile map{ToString(DigestOf(file.text)), ToString(DigestOf(cl_->text())),
                                  cl.lexically_proximate(folder).generic_string(), file.lines};
      if (!WriteFile(LineMapPath(PathOf(file)), post::WriteLineMap(map))) return false;
    }
    return true;
  }

  bool Write(const post::PostedProgram& program, std::ostream& out) {
    if (options_.out.empty()) {
      out << program.files.front().text;
      return true;
    }
    return WriteOperations(program) && WriteFile(options_.out, program.files.front().text);
  }

  void TellWritten(const post::PostedProgram& program, std::ostream& out) const {
    std::size_t lines = 0;
    for (const post::PostedFile& file : program.files) {
      lines += static_cast<std::size_t>(std::count(file.text.begin(), file.text.end(), '\n'));
    }
    out << name_ << ": " << (options_.out.empty() ? "" : "written: ")
        << report::Count(lines, "line") << ", " << report::Count(program.moves, "move") << " of "
        << report::Count(program.operations.size(), "operation") << " with "
        << report::Count(summary_.tools.size(), "tool");
    if (program.files.size() > 1) out << ", in " << report::Count(program.files.size(), "file");
    out << "\n";
  }

  /// What the control makes of the program, and what the file says: the same motion? Where the part
  /// stands does not matter for that: what is assumed of it is check's matter.
  int HoldAgainstCl(const post::PostedProgram& program, std::ostream& out) {
    CompareOptions compare;
    compare.reference = options_.cl_file;
    compare.tested = name_;
    compare.model = model_path_;
    compare.job = job_.path;
    compare.assume = {"all"};
    compare.cl = options_.cl;
    const HeldTogether held =
        CompareText(compare, nc::Program::FromText(name_, program.files.front().text), *err_);
    out << held.text;
    return held.exit_code;
  }

  int TellChecked(const ProgramOutcome& outcome, std::ostream& out) const {
    if (checked_) {
      out << outcome.report;
      return outcome.exit_code;
    }
    out << name_
        << ": unproven: not checked, for no job says where the part stands and which tools "
        << "there are (--job, or " << name_ << ".job.toml)\n";
    return kExitUnproven;
  }

  const PostCommandOptions& options_;
  std::ostream* err_;
  Diagnostics diagnostics_;
  Diagnostics unposted_;  ///< Of the last other way that could not be posted.
  machine::Job job_;
  bool checked_ = false;
  std::string model_path_;
  std::optional<machine::Machine> machine_;
  std::optional<post::PostData> post_;
  std::shared_ptr<const nc::Program> cl_;
  post::ClOptions cl_options_;
  post::ClSummary summary_;
  std::optional<post::PartGeometry> geometry_;
  std::string name_;  ///< Of the program.
  post::PostJob posting_;
};

}  // namespace

int Post(const PostCommandOptions& options, std::ostream& out, std::ostream& err) {
  return Posting(options, err).Run(out);
}

}  // namespace ncsim::app
