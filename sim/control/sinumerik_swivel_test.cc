// SPDX-License-Identifier: BSD-3-Clause
// CYCLE800 (NC programming 12/2019, "Programming cycles externally"; Operating Manual Milling,
// "Swiveling a plane/tool"): the plane by rotation matrices in closed form; X Y Z machine values by
// q_machine = c + R (w + X0 + S (X1 + q) - c) + L, with R = Ry(-B) Rz(-C) the tables' turn about
// their centre c and S the plane's.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "sim/control/sinumerik_test_machine.h"

namespace ncsim::control {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr const char* kHead = "G54 G90 D1 M3 S1200 F300\nG0 X0 Y0 Z50\n";
const Vector3d kCentre(0.0, 0.0, -300.0), kOffset(10.0, 20.0, -250.0), kTool(0.0, 0.0, 100.0);

Matrix3d Turn(int axis, double degrees) {
  return Eigen::AngleAxisd(Radians(degrees), Vector3d::Unit(axis)).toRotationMatrix();
}
Matrix3d Tables(double b, double c) { return Turn(1, -b) * Turn(2, -c); }

TestRun Simulate(const std::string& rest, const SinumerikTest& control = {}) {
  return control.Run(kHead + rest);
}

struct Pose {
  Vector3d point;
  double b = 0.0, c = 0.0;  ///< deg
};
Pose PoseOf(const TestRun& run, int line) {
  const motion::JointVector& q = run.Last(line).q1();
  return {{q[kJointX], q[kJointY], q[kJointZ]}, Degrees(q[kJointB]), Degrees(q[kJointC])};
}

/// The line's motion ends at q of the plane S about X0 and X1, and the plane's normal is the tool.
void ExpectInPlane(const TestRun& run, int line, const Vector3d& q, const Matrix3d& plane,
                   const Vector3d& before = Vector3d::Zero(),
                   const Vector3d& after = Vector3d::Zero()) {
  const Pose pose = PoseOf(run, line);
  const Matrix3d tables = Tables(pose.b, pose.c);
  const Vector3d part = kOffset + before + plane * (after + q);
  EXPECT_LT((pose.point - (kCentre + tables * (part - kCentre) + kTool)).norm(), 1e-9)
      << run.Text();
  EXPECT_LT((tables * plane * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(SinumerikSwivel, AxisByAxisInEveryOrder) {
  // From the manual's table of _MODE: bits 1 and 0 the first axis, 3 and 2 the second, 5 and 4 the
  // third, each about the axes as already turned.
  const double a = 10.0, b = 20.0, c = 30.0;
  const struct {
    int mode, first, second, third;
  } orders[] = {{57, 0, 1, 2}, {45, 0, 2, 1}, {54, 1, 0, 2},
                {30, 1, 2, 0}, {39, 2, 0, 1}, {27, 2, 1, 0}};
  for (const auto& order : orders) {
    const TestRun run = Simulate("CYCLE800(0,\"\",0," + std::to_string(order.mode) +
                                 ",1,2,3,10,20,30,4,5,6,1)\nG0 X7 Y8 Z9\n");
    ExpectInPlane(run, 4, {7, 8, 9},
                  Turn(order.first, a) * Turn(order.second, b) * Turn(order.third, c), {1, 2, 3},
                  {4, 5, 6});
    EXPECT_TRUE(run.findings.empty()) << run.Text();
  }
}

TEST(SinumerikSwivel, SolidAngleAndDirect) {
  const TestRun solid = Simulate("CYCLE800(0,\"\",0,64,0,0,0,30,20,0,0,0,0,1)\nG0 X7 Y8 Z9\n");
  ExpectInPlane(solid, 4, {7, 8, 9}, Turn(2, 30) * Turn(1, 20));
  EXPECT_NEAR(PoseOf(solid, 4).b, 20.0, 1e-9);
  EXPECT_NEAR(PoseOf(solid, 4).c, 30.0, 1e-9);
  // Direct: X and Y of the plane are those of the machine.
  const TestRun direct =
      Simulate("CYCLE800(0,\"\",0,192,1,2,3,20,30,0,0,0,0,1)\nG0 X7 Y8 Z9\nX8\n");
  ExpectInPlane(direct, 4, {7, 8, 9}, Tables(20, 30).transpose(), {1, 2, 3});
  EXPECT_LT((PoseOf(direct, 5).point - PoseOf(direct, 4).point - Vector3d::UnitX()).norm(), 1e-9);
}

// Operating Manual Milling: the plane's traces in the old YZ and ZX planes make the angles with Y
// and X, and the new X lies in the old ZX plane. So the normal is along (tan b, -tan a, 1).
TEST(SinumerikSwivel, ProjectionAnglesAreThoseOfThePlanesTraces) {
  const double a = Radians(10.0), b = Radians(20.0);
  Matrix3d plane;
  plane.col(0) = Vector3d(std::cos(b), 0.0, -std::sin(b));
  plane.col(2) = Vector3d(std::tan(b), -std::tan(a), 1.0).normalized();
  plane.col(1) = plane.col(2).cross(plane.col(0));
  const std::string call = "CYCLE800(0,\"\",0,", rest = "0,0,0,0,1)\nG0 X7 Y8 Z9\n";
  ExpectInPlane(Simulate(call + "185,1,2,3,10,20," + rest), 4, {7, 8, 9}, plane, {1, 2, 3});
  ExpectInPlane(Simulate(call + "182,1,2,3,20,10," + rest), 4, {7, 8, 9}, plane, {1, 2, 3});
  ExpectInPlane(Simulate(call + "185,1,2,3,10,20,3" + rest), 4, {7, 8, 9}, plane * Turn(2, 30),
                {1, 2, 3});
  // One angle alone is a turn about its axis.
  ExpectInPlane(Simulate(call + "185,0,0,0,0,20," + rest), 4, {7, 8, 9}, Turn(1, 20));
}

TEST(SinumerikSwivel, AnglesOfAPostGiveTheToolAxesOfOthers) {
  // One part posted for four controls: these angles stand for these tool axes.
  const TestRun run =
      Simulate("CYCLE800(1,\" R_DATA\",0,57,0,0,1.433,28.5492,-25.5438,90.,0,0,0,1,)\n");
  const Pose pose = PoseOf(run, 3);
  const Vector3d axis = Tables(pose.b, pose.c).transpose() * Vector3d::UnitZ();
  EXPECT_LT((axis - Vector3d(-.431, -.431, .793)).norm(), 1e-3) << run.Text();
  EXPECT_NEAR(pose.b, 37.57, 0.01);
  const TestRun second = Simulate("CYCLE800(1,\"R\",0,57,0,0,0,45.,35.2644,150.,0,0,0,1,)\n");
  EXPECT_NEAR(PoseOf(second, 3).b, 54.7356, 1e-4);
}

TEST(SinumerikSwivel, DirectionChoosesBetweenTwoSolutions) {
  // B5 C0 and B-5 C180; B may go to -11.
  const std::string plane = "CYCLE800(0,\"\",0,57,0,0,0,0,5,0,0,0,0,";
  const TestRun plus = Simulate(plane + "1)\nG0 X7 Y8 Z9\n");
  const TestRun minus = Simulate(plane + "-1)\nG0 X7 Y8 Z9\n");
  EXPECT_NEAR(PoseOf(plus, 4).b, 5.0, 1e-9);
  EXPECT_NEAR(PoseOf(plus, 4).c, 0.0, 1e-9);
  EXPECT_NEAR(PoseOf(minus, 4).b, -5.0, 1e-9);
  EXPECT_NEAR(std::abs(PoseOf(minus, 4).c), 180.0, 1e-9);
  ExpectInPlane(plus, 4, {7, 8, 9}, Turn(1, 5));
  ExpectInPlane(minus, 4, {7, 8, 9}, Turn(1, 5));
  EXPECT_TRUE(plus.Assumed("swivel direction"));
  // By the second axis: within 0 to 360 the greater C is 180.
  SinumerikTest control;
  control.job.control["swivel_reference"] = "2";
  const TestRun by_c = Simulate(plane + "1)\n", control);
  EXPECT_NEAR(PoseOf(by_c, 3).b, -5.0, 1e-9);
  EXPECT_FALSE(by_c.Assumed("swivel direction"));
  // Beyond the limit there is one solution, whatever _DIR says.
  const TestRun one = Simulate("CYCLE800(0,\"\",0,57,0,0,0,0,20,0,0,0,0,-1)\n");
  EXPECT_NEAR(PoseOf(one, 3).b, 20.0, 1e-9);
  EXPECT_FALSE(one.Assumed("swivel direction"));
}

TEST(SinumerikSwivel, AtThePoleTheLastTableTakesTheTurn) {
  const std::string text = "CYCLE800(0,\"\",0,57,0,0,0,0,0,30,0,0,0,-1)\nG0 X7 Y8 Z9\n";
  const TestRun run = Simulate(text);
  EXPECT_NEAR(PoseOf(run, 4).c, 30.0, 1e-9) << run.Text();
  ExpectInPlane(run, 4, {7, 8, 9}, Turn(2, 30));
  EXPECT_TRUE(run.Assumed("swivel at the pole"));
  SinumerikTest control;
  control.job.control["SD55221"] = std::to_string(1 << 13);
  const TestRun half = Simulate(text, control);
  EXPECT_NEAR(std::abs(PoseOf(half, 4).c), 150.0, 1e-9);
  ExpectInPlane(half, 4, {7, 8, 9}, Turn(2, 30));
  EXPECT_FALSE(half.Assumed("swivel at the pole"));
}

TEST(SinumerikSwivel, WhatANominalModelStatesIsAssumedWithoutHarm) {
  // B5 C0 or B-5 C180, then the pole, with a retraction: all three data count.
  const std::string text =
      "CYCLE800(1,\"\",0,57,0,0,0,0,5,0,0,0,0,1)\nCYCLE800(1,\"\",0,57,0,0,0,0,0,30,0,0,0,1)\n";
  const std::vector<std::string> names = {"SD55221", "TC_CARR40", "swivel_reference"};
  const auto placing = [](const TestRun& run) {
    int count = 0;
    for (const Assumption& assumption : run.summary.assumptions) count += assumption.places_metal;
    return count;
  };
  SinumerikTest control;
  const int from_the_start = placing(Simulate("", control));
  EXPECT_EQ(placing(Simulate(text, control)), from_the_start + 3);
  control.machine.control.settings.insert(
      {{"SD55221", "8192"}, {"TC_CARR40", "-10"}, {"swivel_reference", "1"}});
  control.machine.control.nominal_settings = names;
  const TestRun nominal = Simulate(text, control);
  EXPECT_EQ(placing(nominal), from_the_start);
  EXPECT_NEAR(PoseOf(nominal, 4).c, 30.0, 1e-9);
  for (const std::string& name : names) EXPECT_TRUE(nominal.Assumed(name)) << name;
  // Not of a program that does not swivel, nor where the job states them.
  for (const std::string& name : names) EXPECT_FALSE(Simulate("", control).Assumed(name)) << name;
  for (const std::string& name : names) {
    control.job.control[name] = control.machine.control.settings[name];
  }
  for (const std::string& name : names) EXPECT_FALSE(Simulate(text, control).Assumed(name)) << name;
}

TEST(SinumerikSwivel, DirectGoesWhereItSaysAtThePoleToo) {
  SinumerikTest control;
  control.job.control["SD55221"] = std::to_string(1 << 13);
  const TestRun run = Simulate("CYCLE800(0,\"\",0,192,0,0,0,0,30,0,0,0,0,-1)\n", control);
  EXPECT_NEAR(PoseOf(run, 3).c, 30.0, 1e-9);
}

TEST(SinumerikSwivel, WithoutPositioningTheAxesMustStandThere) {
  const std::string plane = "CYCLE800(0,\"\",0,57,0,0,0,0,20,0,0,0,0,0)\n";
  const TestRun there = Simulate("G0 B20 C0\n" + plane + "G0 X7 Y8 Z9\n");
  ExpectInPlane(there, 5, {7, 8, 9}, Turn(1, 20));
  EXPECT_TRUE(there.findings.empty()) << there.Text();
  EXPECT_EQ(Simulate(plane).Find(Rule::kUnsupportedCode)->message.substr(0, 22),
            "CYCLE800 with _DIR = 0");
}

TEST(SinumerikSwivel, RetractsFirst) {
  SinumerikTest control;
  control.job.control["TC_CARR40"] = "-10";
  const auto ways = [&](const std::string& way, const std::string& inc = "") {
    const TestRun run =
        Simulate("CYCLE800(" + way + ",\"\",0,57,0,0,0,0,20,0,0,0,0,1," + inc + ")\n", control);
    std::string text;
    for (const motion::Motion& motion : run.motions) {
      if (motion.where.line != 3) continue;
      const motion::JointVector& q = motion.q1();
      text += "X" + Short(q[kJointX]) + " Y" + Short(q[kJointY]) + " Z" + Short(q[kJointZ]) + " B" +
              Short(Degrees(q[kJointB])) + ";";
    }
    return run.Has(Rule::kControlAlarm) ? run.Find(Rule::kControlAlarm)->message : text;
  };
  EXPECT_EQ(ways("0"), "X10 Y20 Z-100 B20;");
  EXPECT_EQ(ways("1"), "X10 Y20 Z-10 B0;X10 Y20 Z-10 B20;");
  EXPECT_EQ(ways("2"), "X10 Y20 Z-10 B0;X0 Y0 Z-10 B0;X0 Y0 Z-10 B20;");
  EXPECT_EQ(ways("4"), "X10 Y20 Z0 B0;X10 Y20 Z0 B20;");
  EXPECT_EQ(ways("5", "7"), "X10 Y20 Z-93 B0;X10 Y20 Z-93 B20;");
  EXPECT_NE(ways("5", "-7").find("61190"), std::string::npos);
  EXPECT_NE(ways("3").find("61183"), std::string::npos);
}

TEST(SinumerikSwivel, TheTipMayStayOnThePart) {
  const TestRun run = Simulate("G0 Z0\nCYCLE800(0,\"\",10,57,0,0,0,0,20,0,0,0,0,1)\n");
  const Pose pose = PoseOf(run, 4);
  const Vector3d part = kOffset - kCentre;
  EXPECT_LT((pose.point - (kCentre + Tables(20, 0) * part + kTool)).norm(), 1e-9) << run.Text();
  // Half way too.
  const motion::JointVector middle = run.Last(4).At(0.5);
  const Vector3d there(middle[kJointX], middle[kJointY], middle[kJointZ]);
  const Matrix3d tables = Tables(Degrees(middle[kJointB]), Degrees(middle[kJointC]));
  EXPECT_LT((there - (kCentre + tables * part + kTool)).norm(), 1e-6);
}

TEST(SinumerikSwivel, AdditiveNewAndDeselected) {
  const std::string first = "CYCLE800(0,\"\",0,57,1,2,3,0,20,0,0,0,0,1)\n";
  const TestRun run = Simulate(first +
                               "CYCLE800(0,\"\",200001,57,4,0,0,10,0,0,0,0,0,1)\nG0 X7 Y8 Z9\n"
                               "CYCLE800()\nG0 X7 Y8 Z9\n" +
                               first +
                               "TRANS X5\nG0 X2 Y8 Z9\n"
                               "CYCLE800(0,\"0\")\nG0 X7\n");
  const Matrix3d turned = Turn(1, 20);
  ExpectInPlane(run, 5, {7, 8, 9}, turned * Turn(0, 10),
                Vector3d(1, 2, 3) + turned * Vector3d(4, 0, 0));
  // Deselecting turns nothing back.
  EXPECT_LT((PoseOf(run, 7).point - (kOffset + Vector3d(7, 8, 9) + kTool)).norm(), 1e-9)
      << run.Text();
  EXPECT_GT(PoseOf(run, 7).b, 10.0);
  ExpectInPlane(run, 10, {7, 8, 9}, turned, {1, 2, 3});
  EXPECT_NEAR(PoseOf(run, 12).point.x(), 17.0, 1e-9);
}

TEST(SinumerikSwivel, AnotherOffsetAndSupa) {
  SinumerikTest control;
  control.SetOffset("G55", {{'X', 40.0}, {'Y', 20.0}, {'Z', -250.0}});
  const TestRun run = Simulate(
      "CYCLE800(0,\"\",0,57,0,0,0,0,20,0,0,0,0,1)\nG55 G0 X7 Y8 Z9\nSUPA G0 Z0 D0\n", control);
  ExpectInPlane(run, 4, {7, 8, 9}, Turn(1, 20), {30, 0, 0});
  EXPECT_NEAR(PoseOf(run, 5).point.z(), 0.0, 1e-9);
}

TEST(SinumerikSwivel, ACycleDrillsAlongThePlanesNormal) {
  const TestRun run =
      Simulate("CYCLE800(0,\"\",0,57,0,0,0,0,20,0,0,0,0,1)\nG0 X7 Y8 Z9\nCYCLE81(9,0,2,-5)\n");
  const motion::Motion* feed = nullptr;
  for (const motion::Motion& motion : run.motions) {
    if (motion.where.line == 5 && motion.kind == motion::MotionKind::kFeed) feed = &motion;
  }
  ASSERT_NE(feed, nullptr) << run.Text();
  const motion::JointVector way = feed->q1() - feed->q0();
  EXPECT_NEAR(way[kJointZ], -7.0, 1e-9);
  EXPECT_NEAR(way.norm(), 7.0, 1e-9);
}

TEST(SinumerikSwivel, AnArcLiesInThePlane) {
  const Matrix3d plane = Turn(0, 13.7) * Turn(1, 21.3) * Turn(2, 77.1);
  const TestRun run = Simulate(
      "CYCLE800(0,\"\",0,57,0,0,0,13.7,21.3,77.1,0,0,0,1)\nG0 X10 Y0 Z9\nG1 Z2\n"
      "G3 X-10 Y0 I-10 J0\n");
  ExpectInPlane(run, 6, {-10, 0, 2}, plane);
  EXPECT_EQ(run.Last(6).kind, motion::MotionKind::kArc) << run.Text();
  const Pose end = PoseOf(run, 6);
  const motion::JointVector middle = run.Last(6).At(0.5);
  const Vector3d half =
      kCentre + Tables(end.b, end.c) * (kOffset + plane * Vector3d(0, 10, 2) - kCentre) + kTool;
  EXPECT_LT((Vector3d(middle[kJointX], middle[kJointY], middle[kJointZ]) - half).norm(), 1e-9);
}

TEST(SinumerikSwivel, WhatIsNotSimulatedIsNamed) {
  const auto message = [](const std::string& text) {
    const TestRun run = Simulate(text + "\n");
    const Finding* found = run.Find(Rule::kUnsupportedCode);
    return found == nullptr ? "" : found->message;
  };
  EXPECT_EQ(message("CYCLE800(0,\"\",0,128,0,0,0,10,20,0,0,0,0,1)"),
            "CYCLE800 with _MODE = 128 was not simulated");
  EXPECT_EQ(message("CYCLE800(0,\"\",100,57,0,0,0,10,20,0,0,0,0,1)"),
            "CYCLE800 with _ST = 100 was not simulated");
  EXPECT_EQ(message("CYCLE800(0,\"\",0,57,0,0,0,10,20,0,0,0,0,1,,2)"),
            "CYCLE800 with _DMODE = 2 was not simulated");
  EXPECT_EQ(message("CYCLE800(0,\"\",0,57,0,0,0,10,20,0,0,0,0,2)"),
            "CYCLE800 with _DIR = 2 was not simulated");
  EXPECT_EQ(message("TRAORI\nG54\nCYCLE800(0,\"\",0,57,0,0,0,10,20,0,0,0,0,1)"),
            "CYCLE800 under TRAORI was not simulated");
  EXPECT_EQ(message("CYCLE800(0,\"\",0,57,0,0,0,0,20,0,0,0,0,1)\nTRAORI"),
            "TRAORI while CYCLE800 is active was not simulated");
  EXPECT_EQ(message("CYCLE800(0,\"\",0,57,0,0,0,0,20,0,0,0,0,1)\nG53 G0 Z0").substr(0, 28),
            "G53 while CYCLE800 is active");
  const TestRun run = Simulate("CYCLE800(0,\"\",0,57,0,0,0,0,110,0,0,0,0,1)\n");
  EXPECT_NE(run.Find(Rule::kControlAlarm)->message.find("61184"), std::string::npos);
}

}  // namespace
}  // namespace ncsim::control
