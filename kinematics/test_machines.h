// SPDX-License-Identifier: BSD-3-Clause
// Machines for tests: random ones of every five-axis layout, and a BC table-table one with given
// pivots.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kinematics/tree.h"

namespace ncsim::kinematics {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double Uniform(double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(engine_()) / 4294967295.0);
  }
  bool Chance(double probability) { return Uniform(0.0, 1.0) < probability; }
  int Below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  Eigen::Vector3d InBox(double half) {
    const double x = Uniform(-half, half);
    const double y = Uniform(-half, half);
    return {x, y, Uniform(-half, half)};
  }
  Eigen::Vector3d Direction() {
    Eigen::Vector3d v = InBox(1.0);
    while (v.norm() < 0.1 || v.norm() > 1.0) v = InBox(1.0);
    return v.normalized();
  }
  Eigen::Isometry3d Pose(double half) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(Uniform(-3.0, 3.0), Direction()).toRotationMatrix();
    X.translation() = InBox(half);
    return X;
  }

 private:
  std::mt19937 engine_;
};

/// A tree with a tool branch and a table branch.
struct TestMachine {
  KinematicTree tree;
  int spindle_link = 0;
  int table_link = 0;
};

/// Builds a tree branch by branch; joints are given in the machine frame, at q = 0.
class MachineBuilder {
 public:
  MachineBuilder() { links_.push_back({"base", -1}); }

  /// Appends a joint and its child link to `parent`; the link's frame is `X_MC` at q = 0. Returns
  /// the child.
  int Add(int parent, const std::string& name, JointType type, const Eigen::Vector3d& axis_M,
          const Eigen::Isometry3d& X_MC) {
    Joint joint;
    joint.name = name;
    joint.type = type;
    joint.parent_link = parent;
    joint.child_link = static_cast<int>(links_.size());
    joint.X_PJ = poses_[parent].inverse() * X_MC;
    joint.axis = (X_MC.linear().transpose() * axis_M).normalized();
    joint.lower = -std::numeric_limits<double>::infinity();
    joint.upper = std::numeric_limits<double>::infinity();
    links_.push_back({name + "_link", -1});
    poses_.push_back(X_MC);
    joints_.push_back(std::move(joint));
    return joints_.back().child_link;
  }

  KinematicTree Build() const { return KinematicTree(links_, joints_); }

 private:
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::vector<Eigen::Isometry3d> poses_{Eigen::Isometry3d::Identity()};
};

inline Eigen::Isometry3d At(const Eigen::Vector3d& p) {
  return Eigen::Isometry3d(Eigen::Translation3d(p));
}

/// At `p`, with Z toward -Z_M: frame S of a vertical spindle.
inline Eigen::Isometry3d Downward(const Eigen::Vector3d& p) {
  return At(p) * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX());
}

/// X, Y, Z carry the spindle, whose gauge line stands at machine (X, Y, Z); B on the base carries
/// C. B turns about `pivot_b`, C about `pivot_c` (machine frame, at B0); frame B of the table
/// coincides with M at q = 0. JointVector: X Y Z B C, NC values.
inline TestMachine TrunnionBC(const Eigen::Vector3d& pivot_b, const Eigen::Vector3d& pivot_c) {
  MachineBuilder builder;
  const Eigen::Isometry3d X_origin = Eigen::Isometry3d::Identity();
  int link = builder.Add(0, "X", JointType::kPrismatic, Eigen::Vector3d::UnitX(), X_origin);
  link = builder.Add(link, "Y", JointType::kPrismatic, Eigen::Vector3d::UnitY(), X_origin);
  link = builder.Add(link, "Z", JointType::kPrismatic, Eigen::Vector3d::UnitZ(), X_origin);
  builder.Add(link, "spindle_gauge", JointType::kFixed, Eigen::Vector3d::UnitX(),
              Downward(Eigen::Vector3d::Zero()));
  link = builder.Add(0, "B", JointType::kRevolute, -Eigen::Vector3d::UnitY(), At(pivot_b));
  link = builder.Add(link, "C", JointType::kRevolute, -Eigen::Vector3d::UnitZ(), At(pivot_c));
  builder.Add(link, "workpiece_mount", JointType::kFixed, Eigen::Vector3d::UnitX(), X_origin);
  TestMachine machine{builder.Build()};
  machine.spindle_link = machine.tree.FindLink("spindle_gauge_link");
  machine.table_link = machine.tree.FindLink("workpiece_mount_link");
  return machine;
}

struct MachineOptions {
  bool nutating = false;  ///< The tilting axis oblique.
  bool skewed = false;    ///< The linear axes not quite square.
  int axes = -1;          ///< 0: AB, 1: AC, 2: BC; else any.
  int on_table = -1;      ///< How many of the two rotary axes carry the table; else any.
};

/// A random machine: table-table, head-table or head-head; AB, AC or BC; the linear joints on
/// either side; links with frames of their own and fixed joints between. Pivots within 300 mm.
inline TestMachine RandomMachine(Random* random, const MachineOptions& options = {}) {
  const Eigen::Vector3d kAxes[3] = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                    Eigen::Vector3d::UnitZ()};
  constexpr int kPairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};  // tilt, other: AB, AC, BC
  const int any_pair = random->Below(3);
  const int pair = options.axes < 0 ? any_pair : options.axes;
  Eigen::Vector3d tilt = kAxes[kPairs[pair][0]];
  const Eigen::Vector3d other = kAxes[kPairs[pair][1]];
  if (options.nutating) tilt = (tilt + random->Uniform(0.3, 1.5) * other).normalized();
  bool tilt_on_table = random->Chance(0.5);
  bool other_on_table = tilt_on_table || random->Chance(0.5);
  if (options.on_table >= 0) {
    tilt_on_table = options.on_table == 2;
    other_on_table = options.on_table >= 1;
  }

  MachineBuilder builder;
  int link[2] = {0, 0};  // last of the tool branch, of the table branch
  const auto add = [&](const char* name, JointType type, Eigen::Vector3d axis, bool table) {
    if (table) axis = -axis;
    if (random->Chance(0.3)) {
      link[table] = builder.Add(link[table], std::string(name) + "_bracket", JointType::kFixed,
                                kAxes[0], random->Pose(300.0));
    }
    link[table] = builder.Add(link[table], name, type, axis, random->Pose(300.0));
  };
  const int first = random->Below(3);
  for (int i = 0; i < 3; ++i) {
    const int k = (first + i) % 3;
    Eigen::Vector3d axis = kAxes[k];
    if (options.skewed) axis += random->InBox(0.2);
    add(k == 0 ? "X" : (k == 1 ? "Y" : "Z"), JointType::kPrismatic, axis.normalized(),
        random->Chance(0.5));
  }
  const auto add_other = [&] { add("R2", JointType::kRevolute, other, other_on_table); };
  const auto add_tilt = [&] { add("R1", JointType::kRevolute, tilt, tilt_on_table); };
  if (tilt_on_table) {  // the tilting joint next to the other one, on the spindle's side of it
    add_tilt();
    add_other();
  } else {
    add_other();
    add_tilt();
  }
  builder.Add(link[0], "spindle", JointType::kFixed, kAxes[0], Downward(random->InBox(300.0)));
  builder.Add(link[1], "table", JointType::kFixed, kAxes[0], random->Pose(300.0));
  TestMachine machine{builder.Build()};
  machine.spindle_link = machine.tree.FindLink("spindle_link");
  machine.table_link = machine.tree.FindLink("table_link");
  return machine;
}

/// Linear joints within 500 mm, revolute ones within a turn.
inline JointVector RandomPosition(Random* random, const KinematicTree& tree) {
  JointVector q(tree.num_moving());
  for (int i = 0; i < tree.num_moving(); ++i) {
    const bool revolute = tree.joints()[tree.moving_joints()[i]].type == JointType::kRevolute;
    const double reach = revolute ? std::numbers::pi : 500.0;
    q[i] = random->Uniform(-reach, reach);
  }
  return q;
}

}  // namespace ncsim::kinematics
