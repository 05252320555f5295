// SPDX-License-Identifier: BSD-3-Clause
// Files that are none, or broken: an error that names the line, exit code 3, and no program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/app/app.h"
#include "tests/post/post_rig.h"
#include "tests/post/random_cl.h"

namespace ncsim::posting {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class BadCl : public testing::Test {
 protected:
  BadCl() : rig_("bad_cl") {}
  /// The first line of what is said of it.
  std::string FirstLine(const std::string& text, const std::string& model = kUmc750) {
    EXPECT_EQ(rig_.PostText(text, {model, "", {}}), app::kExitBadInput) << rig_.said();
    EXPECT_FALSE(std::filesystem::exists(rig_.program()));
    return rig_.said().substr(0, rig_.said().find('\n'));
  }
  std::string At(const std::string& place) const {
    return (rig_.folder() / "part.cls").string() + ":" + place + ": error: ";
  }
  PostRig rig_;
};

// Nine lines, the sixth and seventh a rapid.
std::string With(const std::string& lines, const std::string& tool = "LOAD/TOOL,1") {
  return "TOOL PATH/OP1,TOOL,MILL\nTLDATA/MILL,10,0,75,0,0\nMSYS/0,0,0,1,0,0,0,1,0\n" + tool +
         "\nSPINDL/RPM,3000,CLW\nRAPID\nGOTO/0,0,50,0,0,1\nFEDRAT/MMPM,500\n" + lines +
         "END-OF-PATH\n";
}

TEST_F(BadCl, NotThere) {
  EXPECT_EQ(rig_.Post(rig_.folder() / "none.cls", {kUmc750, "", {}}), app::kExitBadInput);
  EXPECT_THAT(rig_.said(), HasSubstr("none.cls"));
}

TEST_F(BadCl, Empty) { EXPECT_THAT(FirstLine(""), HasSubstr("part.cls")); }

TEST_F(BadCl, Binary) {
  std::string bytes;
  std::uint64_t state = 1;
  for (int i = 0; i < 5000; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    bytes += static_cast<char>(state >> 56U);
  }
  EXPECT_THAT(FirstLine(bytes), StartsWith((rig_.folder() / "part.cls").string() + ":"));
}

TEST_F(BadCl, CutInAStatement) {
  EXPECT_THAT(
      FirstLine(
          "TOOL "
          "PATH/OP1,TOOL,MILL\nTLDATA/MILL,10,0,75,0,0\nLOAD/TOOL,1\nFEDRAT/MMPM,5\nGOTO/1.5,2.7"),
      StartsWith(At("5:1")));
}

TEST_F(BadCl, CutInACircle) {
  const std::string first = FirstLine(
      "TOOL PATH/OP1,TOOL,MILL\nTLDATA/MILL,10,0,75,0,0\nLOAD/TOOL,1\nRAPID\n"
      "GOTO/0,0,50,0,0,1\nFEDRAT/MMPM,500\nGOTO/9,0,50\nCIRCLE/9,5,50,0,0,-1,5,.006,.5,10,0\n");
  EXPECT_THAT(first, StartsWith((rig_.folder() / "part.cls").string() + ":8:"));
}

TEST_F(BadCl, CutAnywhereItIsSaidOrWhole) {
  RandomMotion motion;
  motion.tilts = motion.holes = true;
  const std::string text = RandomCl(7, motion);
  for (std::size_t size = 1; size < text.size(); size += text.size() / 60) {
    SCOPED_TRACE(size);
    const int code = rig_.PostText(text.substr(0, size), {kUmc750, "", {}});
    EXPECT_TRUE(code == app::kExitPass || code == app::kExitBadInput) << rig_.said();
    EXPECT_EQ(std::filesystem::exists(rig_.program()), code == app::kExitPass);
    if (code == app::kExitBadInput) {
      EXPECT_THAT(rig_.said(), HasSubstr("error: "));
    }
  }
}

TEST_F(BadCl, NoTool) {
  EXPECT_EQ(rig_.Post(rig_.Write("part.cls", With("GOTO/9,0,50\n", "$$ none")), {kUmc750, "", {}}),
            app::kExitPass);  // The rig names the tool that the file begins with.
  const std::string model = std::string(NCSIM_SOURCE_DIR) + "/models/" + kUmc750;
  EXPECT_EQ(rig_.PostText(With("GOTO/9,0,50\nEND-OF-PATH\nTOOL PATH/OP2,TOOL,DRILL\n"
                               "TLDATA/DRILL,6,0,75,0,0\nGOTO/0,0,50\n"),
                          {kUmc750, "", {}}),
            app::kExitBadInput);
  EXPECT_THAT(rig_.said(), StartsWith((rig_.folder() / "part.cls").string() + ":"));
}

TEST_F(BadCl, ToolAxes) {
  EXPECT_THAT(FirstLine(With("GOTO/9,0,50,0,0,0\n")), StartsWith(At("9:1")));
  EXPECT_THAT(FirstLine(With("GOTO/9,0,50,0,0,2\n")), StartsWith(At("9:1")));
  EXPECT_THAT(FirstLine(With("GOTO/9,0,50,0,0\n")), StartsWith(At("9:1")));
}

TEST_F(BadCl, Numbers) {
  EXPECT_THAT(FirstLine(With("GOTO/NaN,0,50\n")), StartsWith(At("9:6")));
  EXPECT_THAT(FirstLine(With("GOTO/1,INF,50\n")), StartsWith(At("9:8")));
  EXPECT_THAT(FirstLine(With("GOTO/1,1.2.3,50\n")), StartsWith(At("9:8")));
  EXPECT_THAT(FirstLine(With("GOTO/1,1E400,50\n")), StartsWith(At("9:8")));
}

TEST_F(BadCl, ACircleThatDoesNotMeetItsEnd) {
  EXPECT_THAT(FirstLine(With("GOTO/9,0,50\nCIRCLE/9,5,50,0,0,-1,5,.006,.5,10,0\nGOTO/9,10.2,50\n")),
              StartsWith(At("11:1")));
}

TEST_F(BadCl, WhatTheMachineCannotReach) {
  EXPECT_THAT(FirstLine(With("RAPID\nGOTO/9,0,50,0,0,-1\n")),
              StartsWith(At("10:1") + "the machine cannot tilt the tool to the axis"));
  EXPECT_THAT(FirstLine(With("GOTO/9,0,50\n", "LOAD/TOOL,99"), kBcTable),
              StartsWith(At("4:1") + "T99: the tool changer of "));
}

}  // namespace
}  // namespace ncsim::posting
