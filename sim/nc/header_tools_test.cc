// SPDX-License-Identifier: BSD-3-Clause
// Formats: Siemens NX's "TOOL TABLE SUMMARY" of its Haas posts; the tool list of Autodesk's Haas
// posts
// ("(T1 D=0.5 CR=0. - ZMIN=-0.45 - flat end mill)").
#include "sim/nc/header_tools.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace ncsim::nc {
namespace {

std::vector<HeaderTool> Read(std::string text) {
  return ReadHeaderTools(*Program::FromText("test.nc", std::move(text)));
}

TEST(HeaderToolsTest, NxSummary) {
  const auto tools = Read(
      "%\nO00001 (PART)\n(---- TOOL TABLE SUMMARY ----)\n"
      "(TOOL-NO.   TOOL-NAME                   DIAMETER   OFFSET )\n"
      "(   1       END MILL 2 FL               0.750      0     )\n"
      "(   12      BALL_MILL                   .25        12    )\n"
      "(-----END OF TOOL TABLE SUMMARY ----)\n(   3  NOT_A_TOOL  0.5  0 )\nN5 G40\n");
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[0].number, 1);
  EXPECT_EQ(tools[0].name, "END MILL 2 FL");
  EXPECT_DOUBLE_EQ(tools[0].diameter, 0.75);
  EXPECT_FALSE(tools[0].has_corner_radius);
  EXPECT_EQ(tools[0].line, 5);
  EXPECT_EQ(tools[1].number, 12);
  EXPECT_DOUBLE_EQ(tools[1].diameter, 0.25);
}

TEST(HeaderToolsTest, SinumerikComments) {
  const auto tools = ReadSinumerikHeaderTools(*Program::FromText(
      "test.mpf",
      "; PART\n; T1 D=10. CR=1. - BALL MILL X5\nN10 G710 ; T2 D=8.\nN20 G0 X0\n; T3 D=9.\n"));
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[0].number, 1);
  EXPECT_EQ(tools[0].name, "BALL MILL X5");
  EXPECT_DOUBLE_EQ(tools[0].diameter, 10.0);
  EXPECT_DOUBLE_EQ(tools[0].corner_radius, 1.0);
  EXPECT_EQ(tools[1].number, 2);
  EXPECT_EQ(tools[1].line, 3);
}

TEST(HeaderToolsTest, AutodeskList) {
  const auto tools = Read(
      "%\nO1\n(T1 D=0.5 CR=0. - ZMIN=-0.45 - flat end mill)\n"
      "(T3 D=0.125 CR=0.0625 TAPER=118deg - ZMIN=-0.54 - BALL END MILL)\n"
      "(T1 D=9. - repeated)\n(T7 has no diameter)\n(Tool 4 D=3.)\n");
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[0].name, "flat end mill");
  EXPECT_DOUBLE_EQ(tools[0].diameter, 0.5);
  EXPECT_TRUE(tools[0].has_corner_radius);
  EXPECT_DOUBLE_EQ(tools[0].corner_radius, 0.0);
  EXPECT_EQ(tools[1].number, 3);
  EXPECT_DOUBLE_EQ(tools[1].corner_radius, 0.0625);
  EXPECT_EQ(tools[1].name, "BALL END MILL");
}

TEST(HeaderToolsTest, ReadsUpToTheFirstMotionOnly) {
  EXPECT_TRUE(Read("G0 X1\n(T1 D=0.5 CR=0. - flat end mill)\n").empty());
  EXPECT_EQ(Read("G90 G54\n(T1 D=0.5 CR=0. - flat end mill)\nG0 X1\n").size(), 1u);
}

TEST(HeaderToolsTest, NonsenseIsLeftAlone) {
  EXPECT_TRUE(Read("(TOOL TABLE SUMMARY)\n(1 2 3)\n(TOOL)\n(TOOL A DIAMETER)\n(x y z)\n").empty());
  EXPECT_TRUE(Read("(T99999999999 D=1)\n(T1 D=nan)\n(T2 D=-1)\n(T D=1)\n(T3 D=)\n").empty());
  EXPECT_TRUE(Read(std::string(20000, '\n') + "(T1 D=1. CR=0. - x)\n").empty());
}

}  // namespace
}  // namespace ncsim::nc
