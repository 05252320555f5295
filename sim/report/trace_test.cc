// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>

#include "sim/base/units.h"
#include "sim/report/result.h"

namespace ncsim::report {
namespace {

using kinematics::Joint;
using kinematics::JointType;
using motion::JointVector;

/// X and Z carry the spindle, C the table: axis letters X, Z, C; Y, A and B are missing.
machine::Machine ThreeAxisMachine() {
  const auto joint = [](const char* name, JointType type, int parent, int child,
                        const Eigen::Vector3d& axis) {
    Joint result;
    result.name = name;
    result.type = type;
    result.parent_link = parent;
    result.child_link = child;
    result.axis = axis;
    return result;
  };
  std::vector<Joint> joints = {joint("X", JointType::kPrismatic, 0, 1, Eigen::Vector3d::UnitX()),
                               joint("Z", JointType::kPrismatic, 1, 2, Eigen::Vector3d::UnitZ()),
                               joint("nose", JointType::kFixed, 2, 3, Eigen::Vector3d::UnitX()),
                               joint("C", JointType::kRevolute, 0, 4, -Eigen::Vector3d::UnitZ())};
  joints[2].X_PJ.linear() = Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  machine::Machine machine;
  machine.tree = kinematics::KinematicTree(
      {{"base", -1}, {"x", 0}, {"z", 1}, {"spindle_gauge", 2}, {"table", 3}}, std::move(joints));
  machine.spindle_link = machine.tree.FindLink("spindle_gauge");
  machine.table_link = machine.tree.FindLink("table");
  machine.axes.resize(3);
  const char letters[] = {'X', 'Z', 'C'};
  for (std::size_t i = 0; i < 3; ++i) {
    machine.axes[i].letter = letters[i];
    machine.axes[i].joint = static_cast<int>(i);
    machine.axes[i].rotary = letters[i] == 'C';
  }
  return machine;
}

JointVector Joints(double x, double z, double c_deg) {
  JointVector q(3);
  q << x, z, Radians(c_deg);
  return q;
}

std::string Row(const machine::Machine& machine, const motion::Motion& motion,
                const Eigen::Isometry3d& X_BP, double length, const std::string& name = "p.nc") {
  SourceFiles files;
  files.Add(name);
  std::ostringstream out;
  TraceWriter writer(machine, out);
  writer.Write(motion, X_BP, length, files);
  const std::string text = out.str();
  return text.substr(text.find('\n') + 1);
}

motion::Motion FeedTo(const JointVector& q1) {
  motion::Motion motion;
  motion.kind = motion::MotionKind::kFeed;
  motion.where = {0, 17, 1};
  motion.path = motion::AxisLinear{Joints(0.0, 0.0, 0.0), q1};
  motion.start_time = 2.0;
  motion.duration = 0.5;
  motion.facts.feed = 10.0;
  return motion;
}

TEST(TraceTest, HeaderIsTheContract) {
  std::ostringstream out;
  const machine::Machine machine = ThreeAxisMachine();
  TraceWriter writer(machine, out);
  EXPECT_EQ(out.str(), "file,line,kind,time_s,X,Y,Z,A,B,C,px,py,pz,ui,uj,uk,feed\n");
}

// The table has turned by +90 (C is clockwise seen from above), the part frame is 10 mm along the
// table's X: a point at machine X 100 stands at table (0, 100), so at part (-10, 100). The tip is
// 50 below the gauge line at Z 80.
TEST(TraceTest, TipAndAxisInThePartFrameThatTurnsWithTheTable) {
  Eigen::Isometry3d X_BP = Eigen::Isometry3d::Identity();
  X_BP.translation() = Eigen::Vector3d(10.0, 0.0, 5.0);
  EXPECT_EQ(Row(ThreeAxisMachine(), FeedTo(Joints(100.0, 80.0, 90.0)), X_BP, 50.0),
            "p.nc,17,feed,2.500000,100.000000,,80.000000,,,90.000000,-10.000000,100.000000,"
            "25.000000,0.000000,0.000000,1.000000,600.000000\n");
}

TEST(TraceTest, RotaryValuesAreContinuousAndRapidsHaveNoFeed) {
  motion::Motion motion = FeedTo(Joints(-1e-9, 0.0, -663.055));
  motion.kind = motion::MotionKind::kRapid;
  motion.facts.feed = 0.0;
  const std::string row = Row(ThreeAxisMachine(), motion, Eigen::Isometry3d::Identity(), 0.0);
  EXPECT_EQ(row.substr(0, 56), "p.nc,17,rapid,2.500000,0.000000,,0.000000,,,-663.055000,");
  EXPECT_EQ(row.substr(row.rfind(',')), ",0.000000\n");
}

TEST(TraceTest, ANameWithCommaAndQuoteIsQuoted) {
  const std::string row = Row(ThreeAxisMachine(), FeedTo(Joints(0.0, 0.0, 0.0)),
                              Eigen::Isometry3d::Identity(), 0.0, "a,\"b\".nc");
  EXPECT_EQ(row.substr(0, 16), "\"a,\"\"b\"\".nc\",17,");
}

}  // namespace
}  // namespace ncsim::report
