// SPDX-License-Identifier: BSD-3-Clause
// For tests: a UMC-750 in code, and a run of a program given as text.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "kinematics/test_machines.h"
#include "sim/base/units.h"
#include "sim/control/controller.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/tool.h"

namespace ncsim::control {

inline constexpr int kJointX = 0, kJointY = 1, kJointZ = 2, kJointB = 3, kJointC = 4;

/// Two branches: X, Y, Z carry the spindle; B on the base carries C. Rotary centre X-381 Y-254
/// Z-495.7; the table's mount is the platter's centre, 50.8 mm below it.
inline machine::Machine MakeTestMachine() {
  using kinematics::JointType;
  const Eigen::Vector3d centre(-381.0, -254.0, -495.7);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  const Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  kinematics::MachineBuilder builder;
  int link = builder.Add(0, "X", JointType::kPrismatic, x, origin);
  link = builder.Add(link, "Y", JointType::kPrismatic, y, origin);
  link = builder.Add(link, "Z", JointType::kPrismatic, z, origin);
  builder.Add(link, "spindle_gauge", JointType::kFixed, x,
              kinematics::Downward(Eigen::Vector3d::Zero()));
  link = builder.Add(0, "B", JointType::kRevolute, -y, kinematics::At(centre));
  link = builder.Add(link, "C", JointType::kRevolute, -z, kinematics::At(centre));
  builder.Add(link, "workpiece_mount", JointType::kFixed, x,
              kinematics::At(centre - Eigen::Vector3d(0.0, 0.0, 50.8)));
  machine::Machine machine;
  machine.name = "test";
  machine.tree = builder.Build();
  machine.spindle_link = machine.tree.FindLink("spindle_gauge_link");
  machine.table_link = machine.tree.FindLink("workpiece_mount_link");
  machine.five_axis =
      kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  const double rapid = 22900.0 / 60.0, turn = Radians(50.0);
  machine.axes = {
      {'X', kJointX, false, -762.0, 0.0, rapid, 2000.0, 0.0},
      {'Y', kJointY, false, -508.0, 0.0, rapid, 2000.0, 0.0},
      {'Z', kJointZ, false, -444.5, 63.5, rapid, 2000.0, 0.0},
      {'B', kJointB, true, Radians(-35.0), Radians(120.0), turn, Radians(500.0), 0.0},
      {'C', kJointC, true, Radians(-13320.0), Radians(13320.0), turn, Radians(500.0), 0.0}};
  machine.control.dialect = "haas-ngc";
  machine.control.tool_change_pose = {{'X', -736.6}, {'Y', -203.2}, {'Z', 0.0}};
  return machine;
}

inline machine::Tool MakeTestTool(int number, double length, double diameter) {
  machine::Tool tool;
  tool.number = number;
  tool.length = tool.h_geometry = length;
  tool.diameter = tool.d_geometry = diameter;
  return tool;
}

/// What a run made.
struct TestRun : RunSink {
  void OnMotion(const motion::Motion& motion) override { motions.push_back(motion); }
  void OnFinding(Finding finding) override { findings.push_back(std::move(finding)); }

  bool Has(Rule rule) const { return Find(rule) != nullptr; }
  const Finding* Find(Rule rule) const {
    const auto found = std::find_if(findings.begin(), findings.end(),
                                    [rule](const Finding& f) { return f.rule == rule; });
    return found == findings.end() ? nullptr : &*found;
  }
  /// Line of the first finding of a rule; 0 for none.
  int LineOf(Rule rule) const { return Has(rule) ? Find(rule)->where.line : 0; }
  bool Assumed(const std::string& name) const {
    return std::any_of(summary.assumptions.begin(), summary.assumptions.end(),
                       [&](const Assumption& a) { return a.name == name; });
  }
  std::string Text() const {
    std::string text;
    for (const Finding& f : findings) {
      text += std::to_string(f.where.line) + ":" + std::to_string(f.where.column) + " " +
              std::string(Info(f.rule).id) + ": " + f.message + "\n";
    }
    return text;
  }
  /// The last motion of a line.
  const motion::Motion& Last(int line) const {
    const motion::Motion* last = &motions.at(0);
    for (const motion::Motion& motion : motions) {
      if (motion.where.line == line) last = &motion;
    }
    return *last;
  }
  const motion::JointVector& End() const { return motions.back().q1(); }

  std::vector<motion::Motion> motions;
  std::vector<Finding> findings;
  std::vector<PartFrame> part_frames;
  RunSummary summary;
  SourceFiles files;
};

/// A machine, a job with G54 at X-300 Y-200 Z-400, and T1 (100 mm, 10 mm) in the spindle.
struct TestControl {
  TestControl() {
    machine = MakeTestMachine();
    SetOffset("G54", {{'X', -300.0}, {'Y', -200.0}, {'Z', -400.0}});
    job.start = {{'X', 0.0}};
    job.start_tool = 1;
    job.control["setting 9"] = "mm";
    tools.tools = {MakeTestTool(1, 100.0, 10.0), MakeTestTool(2, 150.0, 6.0)};
  }
  void SetOffset(const std::string& name, std::map<char, double> values) {
    machine::WorkOffset offset;
    offset.name = name;
    offset.values = std::move(values);
    job.offsets[name] = offset;
  }
  TestRun Run(const std::string& text) const {
    TestRun run;
    run.summary = RunProgram(nc::Program::FromText("test.nc", text), machine, job, tools,
                             &run.files, &run.part_frames, &run);
    return run;
  }

  machine::Machine machine;
  machine::Job job;
  machine::ToolTable tools;
};

}  // namespace ncsim::control
