// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/cl_toolpath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "post/cl_path.h"
#include "sim/base/units.h"

namespace ncsim::compare {
namespace {

class ClToolpathTest : public ::testing::Test {
 protected:
  Toolpath Read(const std::string& text) {
    Diagnostics diagnostics;
    const auto program = nc::Program::FromText("a.cls", text);
    post::ClPath path(program, 0, {}, &diagnostics);
    ClToolpath toolpath({1e-4, 1e-6});
    post::ClEvent event;
    while (path.Next(&event)) toolpath.OnEvent(event);
    for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << ToString(diagnostic);
    findings_ = toolpath.TakeFindings();
    return toolpath.Take();
  }
  static std::string Nx(const std::string& body) {
    return "TOOL PATH/CUT,TOOL,MILL\nTLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\n"
           "MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\n"
           "LOAD/TOOL,1\n" +
           body + "END-OF-PATH\n";
  }
  std::vector<Finding> findings_;
};

// NX's CIRCLE about (0, 0, -1) goes counter-clockwise: a half circle of radius 10 over (0, 10).
TEST_F(ClToolpathTest, RapidsLinesAndArcs) {
  const Toolpath path = Read(
      Nx("RAPID\nGOTO/10.0000,0.0000,5.0000,0.0,0.0,1.0\nFEDRAT/MMPM,600.0000\n"
         "GOTO/10.0000,0.0000,0.0000\nCIRCLE/0.0000,0.0000,0.0000,0.0,0.0,-1.0,10.0000,0.0600,0.5,"
         "10.0,0.0\nGOTO/-10.0000,0.0000,0.0000\n"));
  ASSERT_EQ(path.runs.size(), 1U);
  const auto& run = path.runs[0];
  EXPECT_LT((run.vertices.front().p - Eigen::Vector3d(10, 0, 5)).norm(), 1e-9);
  EXPECT_LT((run.vertices.back().p - Eigen::Vector3d(-10, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(Length(run, 0.0, static_cast<double>(run.chords())), 5.0 + 10.0 * kPi, 1e-3);
  EXPECT_NEAR(run.vertices[1 + (run.chords() - 1) / 2].p.y(), 10.0, 0.01);
  EXPECT_NEAR(path.pieces.back().feed, 10.0, 1e-12);
  EXPECT_LE(path.chord_error.position, 1e-4);
}

// From (0, 0, 1) to (1, 0, 0): half way along the great circle is 45 degrees.
TEST_F(ClToolpathTest, TheAxisGoesAlongTheGreatCircle) {
  const Toolpath path =
      Read(Nx("RAPID\nGOTO/0.0,0.0,0.0,0.0,0.0,1.0\nFEDRAT/MMPM,600.0000\n"
              "GOTO/10.0,0.0,0.0,1.0,0.0,0.0\n"));
  ASSERT_EQ(path.runs.size(), 1U);
  const Pose middle = At(path.runs[0], 0.5 * static_cast<double>(path.runs[0].chords()));
  EXPECT_LT((middle.p - Eigen::Vector3d(5, 0, 0)).norm(), 1e-4);
  EXPECT_LT((middle.u - Eigen::Vector3d(std::sqrt(0.5), 0, std::sqrt(0.5))).norm(), 1e-5);
}

TEST_F(ClToolpathTest, AHoleIsAFeedToItsBottom) {
  const Toolpath path =
      Read(Nx("RAPID\nGOTO/0.0,0.0,20.0,0.0,0.0,1.0\nCYCLE/DRILL,RAPTO,3.0,FEDTO,-12.0,MMPM,120.0\n"
              "GOTO/5.0,0.0,0.0\nCYCLE/OFF\n"));
  ASSERT_EQ(path.runs.size(), 1U);
  EXPECT_LT((path.runs[0].vertices.front().p - Eigen::Vector3d(5, 0, 3)).norm(), 1e-9);
  EXPECT_LT((path.runs[0].vertices.back().p - Eigen::Vector3d(5, 0, -12)).norm(), 1e-9);
  EXPECT_NEAR(path.pieces.front().feed, 2.0, 1e-12);
}

TEST_F(ClToolpathTest, WhatMovesOrTurnsUnseenIsNotFollowed) {
  const std::string rest = "RAPID\nGOTO/0.0,0.0,20.0,0.0,0.0,1.0\n";
  for (const char* line :
       {"ROTATE/TABLE,ATANGL,90,CLW", "ROTABL/90", "ROTHED/30", "HEAD/2", "SET/MODE,INCR", "RETRCT",
        "PPFUN/1", "PREFUN/91", "INSERT G53 Z0.", "INSERT G0Z100M8"}) {
    Read(Nx("FEDRAT/MMPM,100.0\n" + std::string(line) + "\n" + rest));
    ASSERT_EQ(findings_.size(), 1U) << line;
    EXPECT_EQ(findings_[0].rule, Rule::kUnsupportedCode) << line;
    EXPECT_EQ(findings_[0].where.line, 6) << line;
  }
  for (const char* line : {"SEQNO/ON", "CLAMP/ON", "AUXFUN/8", "INSERT Stock Size X85. Y38.",
                           "INSERT STOP  change fixture", "PPRINT G0 Z1"}) {
    Read(Nx("FEDRAT/MMPM,100.0\n" + std::string(line) + "\n" + rest));
    EXPECT_TRUE(findings_.empty()) << line;
  }
}

}  // namespace
}  // namespace ncsim::compare
