// SPDX-License-Identifier: BSD-3-Clause
#include "tests/conformance/haas_run.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "kinematics/test_machines.h"
#include "sim/base/units.h"
#include "sim/control/controller.h"
#include "sim/nc/program.h"

namespace ncsim::conformance {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

machine::Machine PlainMachine(const HaasRunOptions& options) {
  kinematics::MachineBuilder builder;
  using kinematics::JointType;
  const Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d axes[3] = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                   Eigen::Vector3d::UnitZ()};
  int link = 0;
  for (int k = 0; k < 3; ++k) {
    link = builder.Add(link, std::string(1, "XYZ"[k]), JointType::kPrismatic, axes[k], origin);
  }
  builder.Add(link, "spindle", JointType::kFixed, axes[0],
              kinematics::Downward(Eigen::Vector3d::Zero()));
  // A stands aside: it is programmed and moves nothing between tool and table.
  builder.Add(0, "A", JointType::kRevolute, -axes[0], origin);
  link = builder.Add(0, "B", JointType::kRevolute, -axes[1], origin);
  link = builder.Add(link, "C", JointType::kRevolute, -axes[2], origin);
  builder.Add(link, "table", JointType::kFixed, axes[0], origin);

  machine::Machine machine;
  machine.name = "plain";
  machine.tree = builder.Build();
  machine.spindle_link = machine.tree.FindLink("spindle_link");
  machine.table_link = machine.tree.FindLink("table_link");
  machine.five_axis =
      kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  for (int k = 0; k < 6; ++k) {
    machine::Axis axis;
    axis.letter = "XYZABC"[k];
    axis.joint = k;
    axis.rotary = k > 2;
    axis.lower = -kEndless;
    axis.upper = kEndless;
    axis.rapid = 1e6;
    axis.acceleration = 1e7;
    machine.axes.push_back(axis);
  }
  machine.control.dialect = "haas-ngc";
  machine.control.subprogram_folders = options.subprogram_folders;
  return machine;
}

machine::ToolTable RsTools() {
  machine::ToolTable table;
  for (int n = 1; n <= 99; ++n) {
    machine::Tool tool;
    tool.number = n;
    tool.length = (50.0 + n) * kMmPerInch;
    tool.diameter = kMmPerInch;
    tool.h_geometry = tool.length;
    tool.d_geometry = tool.diameter;
    table.tools.push_back(tool);
  }
  return table;
}

double ToNc(int axis, double value) { return axis < 3 ? value : Degrees(value); }

class Collector : public control::RunSink {
 public:
  explicit Collector(HaasRun* run) : run_(run) {}

  void OnMotion(const motion::Motion& motion) override {
    Step step;
    step.line = motion.where.line;
    for (int k = 0; k < 6; ++k) step.end[static_cast<std::size_t>(k)] = ToNc(k, motion.q1()[k]);
    step.spindle = motion.facts.spindle_on;
    step.tool = motion.facts.tool;
    switch (motion.kind) {
      case motion::MotionKind::kRapid:
        step.kind = StepKind::kRapid;
        break;
      case motion::MotionKind::kFeed:
        step.kind = StepKind::kFeed;
        step.feed = motion.facts.feed;
        break;
      case motion::MotionKind::kArc:
        step.kind = StepKind::kArc;
        step.feed = motion.facts.feed;
        AddArc(motion, &step);
        break;
      case motion::MotionKind::kDwell:
        step.kind = StepKind::kDwell;
        step.dwell = motion.duration;
        break;
      case motion::MotionKind::kToolChange:
        step.kind = StepKind::kToolChange;
        MarkWay(step.line);
        break;
    }
    run_->steps.push_back(step);
  }
  void OnFinding(Finding finding) override { run_->findings.push_back(std::move(finding)); }

 private:
  static void AddArc(const motion::Motion& motion, Step* step) {
    const auto* arc = std::get_if<motion::AxisArc>(&motion.path);
    if (arc == nullptr) return;
    step->centre = arc->centre;
    const Eigen::Vector3d normal = arc->e1.cross(arc->e2);
    for (int k = 0; k < 3; ++k) {
      if (std::abs(normal[k]) > 0.5) step->normal = k;
    }
    step->sweep_deg = Degrees(normal[step->normal] > 0.0 ? arc->sweep : -arc->sweep);
  }

  // The rapids of an M06 block are the way to the changer.
  void MarkWay(int line) {
    for (auto step = run_->steps.rbegin(); step != run_->steps.rend() && step->line == line;
         ++step) {
      if (step->kind == StepKind::kRapid) step->kind = StepKind::kToolChange;
    }
  }

  HaasRun* run_;
};

// The text of one line in the spelling that both read.
std::string NormaliseLine(std::string_view line) {
  std::string out;
  bool comment = false;
  for (const char c : line) {
    if (!comment && c == ';') break;
    if (c == '(') comment = true;
    out += comment ? c : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (c == ')') comment = false;
  }
  return out;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// "X 1.5" becomes "X1.5": on a Haas the letter alone would be an expression.
void JoinWords(std::string* line) {
  bool comment = false;
  std::string out;
  for (std::size_t i = 0; i < line->size(); ++i) {
    const char c = (*line)[i];
    if (c == '(') comment = true;
    if (c == ')') comment = false;
    if (!comment && (c == ' ' || c == '\t') && !out.empty() &&
        std::isupper(static_cast<unsigned char>(out.back())) != 0) {
      const std::size_t next = line->find_first_not_of(" \t", i);
      const bool number = next != std::string::npos &&
                          (IsDigit((*line)[next]) || (*line)[next] == '.' || (*line)[next] == '-');
      const bool word =
          out.size() < 2 || std::isalpha(static_cast<unsigned char>(out[out.size() - 2])) == 0;
      if (number && word) continue;
    }
    out += c;
  }
  *line = out;
}

// Drops a block number with a fraction (N1.5): a Haas has whole ones.
void DropFractionalNumber(std::string* line) {
  std::size_t i = line->find_first_not_of(" \t/");
  if (i == std::string::npos || (*line)[i] != 'N') return;
  std::size_t end = i + 1;
  while (end < line->size() && IsDigit((*line)[end])) ++end;
  if (end >= line->size() || (*line)[end] != '.') return;
  ++end;
  while (end < line->size() && IsDigit((*line)[end])) ++end;
  line->erase(i, end - i);
}

// "P2" of a block with a dwell becomes "P2.".
void PointDwell(std::string* line) {
  const bool dwell =
      line->find("G4") != std::string::npos || line->find("G04") != std::string::npos ||
      line->find("G82") != std::string::npos || line->find("G89") != std::string::npos;
  if (!dwell || line->find('(') != std::string::npos) return;
  for (std::size_t i = line->find('P'); i != std::string::npos; i = line->find('P', i + 1)) {
    std::size_t end = i + 1;
    while (end < line->size() && IsDigit((*line)[end])) ++end;
    if (end > i + 1 && (end >= line->size() || (*line)[end] != '.')) line->insert(end, ".");
  }
}

// G41 and G42 without a D mean the D of the tool in the spindle there.
void AddToolD(std::string* line, std::string* tool) {
  const std::string code = line->substr(0, line->find('('));
  if (const std::size_t t = code.find('T'); t != std::string::npos) {
    std::size_t end = t + 1;
    while (end < code.size() && IsDigit(code[end])) ++end;
    if (end > t + 1) *tool = code.substr(t + 1, end - t - 1);
  }
  const std::size_t comp = std::min(code.find("G41"), code.find("G42"));
  if (comp == std::string::npos || code.find('D') != std::string::npos || tool->empty()) return;
  line->insert(comp + 3, " D" + *tool + " ");
}

}  // namespace

std::string Normalise(const std::string& text) {
  std::string out, tool;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = NormaliseLine(std::string_view(text).substr(begin, end - begin));
    JoinWords(&line);
    DropFractionalNumber(&line);
    PointDwell(&line);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    AddToolD(&line, &tool);
    out += line + "\n";
    begin = end + 1;
  }
  return out;
}

HaasRun RunHaas(const std::string& name, const std::string& text, const HaasRunOptions& options) {
  HaasRun run;
  const std::string normalised = Normalise(text);
  const machine::Machine machine = PlainMachine(options);
  machine::Job job;
  job.control["setting 15"] = "off";
  job.control["setting 162"] = "on";
  job.control["setting 22"] = "0.254";  // LinuxCNC's retract in G73 and gap in G83: .010 in.
  if (options.yasnac_corners) job.control["setting 58"] = "yasnac";
  if (normalised.find("G20") == std::string::npos && normalised.find("G21") == std::string::npos) {
    job.control["setting 9"] = "mm";
  }
  SourceFiles files;
  std::vector<control::PartFrame> part_frames;
  Collector collector(&run);
  const control::RunSummary summary =
      control::RunProgram(nc::Program::FromText(name, normalised), machine, job, RsTools(), &files,
                          &part_frames, &collector);
  run.finished = summary.finished;
  return run;
}

}  // namespace ncsim::conformance
