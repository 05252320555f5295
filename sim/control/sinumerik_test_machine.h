// SPDX-License-Identifier: BSD-3-Clause
// For tests: a BC table machine with a SINUMERIK 840D sl, whose two rotary axes meet in X0 Y0
// Z-300.
#pragma once

#include <limits>
#include <string>

#include "sim/base/text.h"
#include "sim/control/test_machine.h"

namespace ncsim::control {

/// G54 at X10 Y20 Z-250; T1 (100 mm, 10 mm) in the spindle, T2 (150 mm, 6 mm).
struct SinumerikTest : TestControl {
  SinumerikTest() {
    using kinematics::JointType;
    const Eigen::Vector3d centre(0.0, 0.0, -300.0);
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
    builder.Add(link, "workpiece_mount", JointType::kFixed, x, kinematics::At(centre));
    machine.tree = builder.Build();
    machine.spindle_link = machine.tree.FindLink("spindle_gauge_link");
    machine.table_link = machine.tree.FindLink("workpiece_mount_link");
    machine.five_axis =
        kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    const double rapid = 5000.0 / 60.0, endless = std::numeric_limits<double>::infinity();
    machine.axes = {
        {'X', kJointX, false, -250.0, 250.0, rapid, 2000.0, 0.0},
        {'Y', kJointY, false, -150.0, 150.0, rapid, 2000.0, 0.0},
        {'Z', kJointZ, false, -500.0, 0.0, rapid, 2000.0, 0.0},
        {'B', kJointB, true, Radians(-11.0), Radians(100.0), Radians(96.0), Radians(500.0), 0.0},
        {'C', kJointC, true, -endless, endless, Radians(162.0), Radians(1000.0), 0.0}};
    machine.control = {};
    machine.control.dialect = "sinumerik-840d";
    machine.control.settings = {{"MD21104", "1"}, {"MD30310[C]", "1"}};
    machine.control.tool_change_pose = {{'Z', 0.0}};
    machine.control.tool_change_order = {"Z"};
    job = {};
    SetOffset("G54", {{'X', 10.0}, {'Y', 20.0}, {'Z', -250.0}});
    job.start = {{'X', 0.0}};
    job.start_tool = 1;
    tools.tools = {MakeTestTool(1, 100.0, 10.0), MakeTestTool(2, 150.0, 6.0)};
    tools.tools[1].name = "BALL_6";
  }
};

/// Machine values (mm, deg) at the end of a line's last motion.
inline std::string EndOf(const TestRun& run, int line) {
  const motion::JointVector& q = run.Last(line).q1();
  return "X" + Short(q[kJointX]) + " Y" + Short(q[kJointY]) + " Z" + Short(q[kJointZ]) + " B" +
         Short(Degrees(q[kJointB])) + " C" + Short(Degrees(q[kJointC]));
}

}  // namespace ncsim::control
