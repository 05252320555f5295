// SPDX-License-Identifier: BSD-3-Clause
#include "post/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "post/test_planner.h"
#include "post/tool_curve.h"

namespace ncsim::post {
namespace {

using ::testing::HasSubstr;

// Source paper 000, figure 10: the same tool axis by B82.875 with C180 or with C-180, or with B
// turned the other way.
TEST(PlannerTest, TwoBranchesAndTheTurnsOfAnAxis) {
  Plan plan("haas_umc750/umc750.urdf");
  const Eigen::Vector3d axis = AxisOf(82.875, 180.0);
  const auto near = [&](double c) {
    const auto reach = plan.geometry.Reach(axis, {0.0, c * kDeg});
    EXPECT_EQ(reach.size(), 1u);  // B-82.875 is beyond the travel.
    return reach.empty() ? Rotary{} : Rotary{reach[0][0] / kDeg, reach[0][1] / kDeg};
  };
  EXPECT_NEAR(near(10.0)[0], 82.875, 1e-9);
  EXPECT_NEAR(near(10.0)[1], 180.0, 1e-9);
  EXPECT_NEAR(near(-10.0)[1], -180.0, 1e-9);
  EXPECT_NEAR(near(700.0)[1], 540.0, 1e-9);
  EXPECT_EQ(plan.geometry.ReachAnywhere(axis, {0.0, 0.0}).size(), 2u);
}

TEST(PlannerTest, AnIndexedOperationTurnsWithThePart) {
  Plan plan("haas_umc750/umc750.urdf");
  const Eigen::Vector3d axis = AxisOf(90.0, -90.0);  // The tool comes along P's -Y.
  const Steps& steps = plan.Make("RAPID\n" + Goto({5, -40, 7}, axis) + Goto({5, -30, 7}, axis));
  ASSERT_EQ(plan.FirstError(), "");
  const auto indices = steps.All<PlanIndex>();
  ASSERT_EQ(indices.size(), 1u);
  EXPECT_EQ(indices[0].mode, PlanMode::kIndexed);
  EXPECT_NEAR(indices[0].rotary[0], 90.0 * kDeg, 1e-9);
  EXPECT_NEAR(indices[0].rotary[1], -90.0 * kDeg, 1e-9);
  const auto moves = steps.All<PlanMove>();
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_TRUE(moves[0].rapid);
  // C-90 brings P's -Y to the machine's X, B90 that up to Z, and P's Z to -X; P's X to Y (ISO 841:
  // the words are those of the tool as if it moved).
  EXPECT_LT((moves[0].end.xyz - Eigen::Vector3d(-7, 5, 40)).norm(), 1e-9);
  EXPECT_LT((moves[1].end.xyz - Eigen::Vector3d(-7, 5, 30)).norm(), 1e-9);
  EXPECT_NEAR(moves[1].time, 1.0, 1e-12);  // 10 mm at 600 mm/min.
}

TEST(PlannerTest, ATurnedPlaneHasItsOwnDirections) {
  Plan plan("bc_table_840d/bc_table_840d.urdf");
  plan.options.turned_planes = true;
  const Eigen::Vector3d axis = AxisOf(30.0, 40.0);
  const Steps& steps = plan.Make("RAPID\n" + Goto(12.0 * axis, axis) + Goto(2.0 * axis, axis));
  const auto moves = steps.All<PlanMove>();
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_LT((moves[0].end.xyz - Eigen::Vector3d(0, 0, 12)).norm(), 1e-9);
  const Eigen::Matrix3d plane = steps.All<PlanIndex>()[0].plane_P;
  EXPECT_LT((plane.transpose() * plane - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(plane.determinant(), 1.0, 1e-12);
}

// The arc lies in a plane of the turned coordinates, and keeps its sense as seen along the tool.
TEST(PlannerTest, ArcsStayArcsWhereThePlaneIsTheControls) {
  Plan plan("haas_umc750/umc750.urdf");
  const Eigen::Vector3d u = AxisOf(90.0, 0.0);  // X of P.
  // A quarter about X: NX turns clockwise about the stated axis.
  const std::string path =
      "RAPID\n" + Goto({0, 10, 0}, u) + "CIRCLE/0,0,0,-1,0,0,10,0.06,0.5,10,0\nGOTO/0,0,10\n";
  const auto moves = plan.Make(path).All<PlanMove>();
  ASSERT_EQ(plan.FirstError(), "");
  ASSERT_EQ(moves.size(), 2u);
  ASSERT_TRUE(moves[1].arc.has_value());
  EXPECT_EQ(moves[1].arc->plane, PlanPlane::kXY);
  EXPECT_FALSE(moves[1].arc->clockwise);
  EXPECT_EQ(moves[1].arc->turns, 0);
  EXPECT_LT(moves[1].arc->centre.norm(), 1e-9);
  // The same where the mode has no arcs: chords within the tolerance, on the circle.
  plan.options.abilities[0].arcs = {false, false, false};
  const auto chords = plan.Make(path).All<PlanMove>();
  ASSERT_GT(chords.size(), 10u);
  Eigen::Vector3d last = chords[0].end.xyz;
  for (std::size_t i = 1; i < chords.size(); ++i) {
    EXPECT_NEAR(chords[i].end.xyz.norm(), 10.0, 1e-9);
    EXPECT_GT((0.5 * (last + chords[i].end.xyz)).norm(), 10.0 - plan.options.tolerance);
    last = chords[i].end.xyz;
  }
  EXPECT_LT((last - moves[1].end.xyz).norm(), 1e-9);
}

TEST(PlannerTest, WhatAModeCannotCarryIsRefusedAtItsLine) {
  Plan plan("haas_umc750/umc750.urdf");
  plan.options.mode = PlanMode::kIndexed;
  plan.Make("RAPID\n" + Goto({0, 0, 50}, AxisOf(10, 0)) + Goto({0, 9, 50}, AxisOf(20, 0)));
  EXPECT_THAT(plan.FirstError(), HasSubstr("x.cls:8:"));
  EXPECT_THAT(plan.FirstError(), HasSubstr("a feed turns the tool axis"));
  Plan other("haas_umc750/umc750.urdf");
  other.Make("RAPID\n" + Goto({0, 0, 50}, AxisOf(10, 0)) + Goto({0, 9, 50}, AxisOf(130, 0)));
  EXPECT_THAT(other.FirstError(), HasSubstr("x.cls:8:"));
  EXPECT_THAT(other.FirstError(), HasSubstr("cannot tilt the tool to the axis 0.766044, 0.000000"));
}

// B goes to -11 only: what tilts further the other way needs C turned by half a turn, and the tool
// out of the part for it.
TEST(PlannerTest, ARewindWhereALimitIsMet) {
  Plan plan("bc_table_840d/bc_table_840d.urdf");
  std::string path = "RAPID\n" + Goto({0, 0, 60}, AxisOf(16, 0));
  for (int i = 1; i <= 16; ++i) path += Goto({0, 1.0 * i, 60}, AxisOf(16.0 - 2.0 * i, 0));
  const Steps& steps = plan.Make(path);
  ASSERT_EQ(plan.FirstError(), "");
  const auto indices = steps.All<PlanIndex>();
  ASSERT_EQ(indices.size(), 2u);
  EXPECT_EQ(indices[1].why, PlanIndex::Why::kRewind);
  EXPECT_EQ(indices[1].retract, plan.options.rewind_retract);
  EXPECT_NEAR(std::abs(indices[1].rotary[1] - indices[0].rotary[1]), kPi, 2 * kGrid);
  Rotary last{};
  for (const PlanStep& step : steps.steps) {
    if (const auto* index = std::get_if<PlanIndex>(&step.what)) last = index->rotary;
    const auto* move = std::get_if<PlanMove>(&step.what);
    if (move == nullptr) continue;
    EXPECT_GE(move->end.rotary[0], -11.0 * kDeg - 1e-9);
    EXPECT_LT(std::abs(move->end.rotary[1] - last[1]), 2.0);  // No feed turns C by half a turn.
    last = move->end.rotary;
  }
  // From a lesser tilt the other branch needs none: it is ranked first.
  path = "RAPID\n" + Goto({0, 0, 60}, AxisOf(8, 0));
  for (int i = 1; i <= 12; ++i) path += Goto({0, 1.0 * i, 60}, AxisOf(8.0 - 2.0 * i, 0));
  EXPECT_EQ(plan.Make(path).All<PlanIndex>().size(), 1u);
}

// The tool comes to each point with a tilt of 2 degrees less than to the last one, from 16: it must
// rewind before -12 degrees, the fourteenth, and may do so as soon as the other branch (B from -11
// up) reaches: the third.
TEST(PlannerTest, TheOtherWaysRewindEarlier) {
  Plan plan("bc_table_840d/bc_table_840d.urdf");
  std::string path = "RAPID\n" + Goto({0, 0, 60}, AxisOf(16, 0));
  for (int i = 1; i <= 16; ++i) path += Goto({0, 1.0 * i, 60}, AxisOf(16.0 - 2.0 * i, 0));
  std::vector<double> rewinds;
  plan.Make(path);
  ASSERT_EQ(plan.choices.size(), 1u);
  for (std::size_t way = 0; way < plan.choices[0].ways; ++way) {
    plan.options.choice[1] = way;
    for (const PlanStep& step : plan.Make(path).steps) {
      const auto* index = std::get_if<PlanIndex>(&step.what);
      if (index == nullptr || index->why != PlanIndex::Why::kRewind) continue;
      rewinds.push_back(16.0 - 2.0 * std::round(index->approach.xyz.y()));
      EXPECT_EQ(plan.FirstError(), "");
    }
  }
  ASSERT_GE(rewinds.size(), 3u);
  EXPECT_EQ(rewinds.front(), -10.0);
  for (std::size_t i = 1; i < rewinds.size(); ++i) {
    EXPECT_GE(rewinds[i], rewinds[i - 1]);
    EXPECT_LE(rewinds[i], 10.0);
  }
  EXPECT_GT(rewinds.back(), 0.0);
}

TEST(PlannerTest, AnotherWayIsTakenWhenAskedFor) {
  Plan plan("haas_umc750/umc750.urdf");
  const std::string path =
      "RAPID\n" + Goto({0, 0, 50}, AxisOf(10, 0)) + Goto({0, 9, 50}, AxisOf(20, 30));
  EXPECT_NEAR(plan.Make(path).All<PlanIndex>()[0].rotary[0], 10.0 * kDeg, 1e-9);
  ASSERT_GT(plan.choices[0].ways, 1u);
  bool other = false;
  for (std::size_t way = 1; way < plan.choices[0].ways; ++way) {
    plan.options.choice[1] = way;
    other = other || plan.Make(path).All<PlanIndex>()[0].rotary[0] < 0.0;
    plan.Make(path);
    EXPECT_EQ(plan.choices[0].taken, way);
  }
  EXPECT_TRUE(other);
}

/// Every place that a control takes between two moves, against the file's line and great circle.
void ExpectKeepsToTheFile(const Plan& plan, const Steps& steps, const ClPose& start,
                          const ClPose& end) {
  const ToolCurve curve(start, end, std::nullopt);
  const Eigen::Vector3d way = end.tip_M - start.tip_M;
  PlanPose last;
  PlanMode mode = PlanMode::kTcp;
  for (const PlanStep& step : steps.steps) {
    if (const auto* index = std::get_if<PlanIndex>(&step.what)) mode = index->mode;
    const auto* move = std::get_if<PlanMove>(&step.what);
    if (move == nullptr) continue;
    for (int i = 0; i <= 50 && !move->rapid; ++i) {
      const double s = i / 50.0;
      const Rotary rotary{std::lerp(last.rotary[0], move->end.rotary[0], s),
                          std::lerp(last.rotary[1], move->end.rotary[1], s)};
      const Eigen::Vector3d xyz = last.xyz + s * (move->end.xyz - last.xyz);
      const Eigen::Vector3d tip =
          mode == PlanMode::kTcp ? xyz : plan.geometry.TipOfAxes(xyz, rotary);
      const double t = (tip - start.tip_M).dot(way) / way.squaredNorm();
      EXPECT_LT((tip - curve.Tip(t)).norm(), plan.options.tolerance);
      const Eigen::Vector3d u = curve.Axis(t);
      const double angle = std::atan2(plan.geometry.ToolAxis(rotary).cross(u).norm(),
                                      plan.geometry.ToolAxis(rotary).dot(u));
      // The control's own place along the way may be off by the tolerance of the tip.
      const double ahead = curve.turn() * plan.options.tolerance / way.norm();
      EXPECT_LT(angle, plan.options.angle_tolerance + kGrid + ahead) << t;
    }
    last = move->end;
  }
  EXPECT_LT((last.axis_P - end.axis_M).norm(), 1e-9);
}

TEST(PlannerTest, RandomToolAxesAndThePoles) {
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int checked = 0;
  for (const char* model : {"haas_umc750/umc750.urdf", "bc_table_840d/bc_table_840d.urdf"}) {
    for (const PlanMode mode : {PlanMode::kTcp, PlanMode::kAxes}) {
      Plan plan(model);
      plan.options.mode = mode;
      for (int i = 0; i < 60; ++i) {
        // Of every three one begins at the pole, one passes by it within a tenth of a degree.
        const double b = i % 3 == 0 ? 0.0 : i % 3 == 1 ? uniform(0.0, 0.1) : uniform(0.0, 90.0);
        const double c = uniform(-180.0, 180.0);
        const Eigen::Vector3d tip(uniform(-50, 50), uniform(-50, 50), uniform(0, 50));
        const Eigen::Vector3d way(uniform(-9, 9), uniform(-9, 9), uniform(1, 9));
        const ClPose start{tip, AxisOf(b, c)};
        const ClPose end{tip + way, AxisOf(uniform(0.0, 60.0), c + uniform(-120.0, 120.0))};
        if (start.axis_M.dot(end.axis_M) < 0.2) continue;
        const Steps& steps =
            plan.Make("RAPID\n" + Goto(start.tip_M, start.axis_M) + Goto(end.tip_M, end.axis_M));
        ASSERT_EQ(plan.FirstError(), "") << model << " " << i;
        if (steps.All<PlanIndex>().size() != 1) continue;  // A rewind: not one curve.
        ExpectKeepsToTheFile(plan, steps, start, end);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 150);
}

}  // namespace
}  // namespace ncsim::post
