// SPDX-License-Identifier: BSD-3-Clause
// CUTCOM: points of the tool's centre, G41 and D, and what a job says of D.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "sim/app/app.h"
#include "tests/post/post_rig.h"

namespace ncsim::posting {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A 14 mm end mill along a wall: on and off in lines, between them arcs.
const char* const kWall =
    "TOOL PATH/OP1,TOOL,MILL\nTLDATA/MILL,14,0,75,0,0\nMSYS/0,0,0,1,0,0,0,1,0\nLOAD/TOOL,1\n"
    "SPINDL/RPM,3000,CLW\nRAPID\nGOTO/-20,-30,50,0,0,1\nFEDRAT/MMPM,500\nGOTO/-20,-30,10\n"
    "CUTCOM/LEFT\nGOTO/-10,-20,10\nCIRCLE/0,-20,10,0,0,-1,10,.006,.5,14,0\nGOTO/10,-20,10\n"
    "GOTO/10,30,10\nCUTCOM/OFF\nGOTO/-5,40,10\nRAPID\nGOTO/-5,40,50\nEND-OF-PATH\n";

class Compensation : public testing::Test {
 protected:
  Compensation() : rig_("compensation"), cl_(rig_.Write("part.cls", kWall)) {}

  /// `d`: a line of the job's tool.
  std::string Job(const std::string& d) const {
    return rig_
        .Write("job.toml",
               "schema = 1\nunits = \"mm\"\nmodel = \"umc750.urdf\"\n[offsets]\n"
               "G54 = { on = \"workpiece_mount\", xyz = [0.0, 0.0, 100.0] }\n[[tool]]\nnumber = 1\n"
               "length = 165.0\n" +
                   d +
                   "\ncutter = { type = \"end\", diameter = 14.0, flute_length = 40.0 }\n"
                   "holder = \"CAT40-ER32-100\"\n")
        .string();
  }
  int Run(const std::vector<std::string>& arguments) {
    std::ostringstream out, err;
    const int code = app::Run(arguments, out, err);
    said_ = out.str() + err.str();
    return code;
  }
  int Compare(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"compare", cl_.string(), rig_.program().string(),
                                          "--model", kModel};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Run(arguments);
  }

  const std::string kModel = std::string(NCSIM_SOURCE_DIR) + "/models/" + kUmc750;
  PostRig rig_;
  std::filesystem::path cl_;
  std::string said_;
};

TEST_F(Compensation, WithoutAJobDIsTheWear) {
  for (const Way& way : {Way{kUmc750, "", {}}, Way{kBcTable, "", {}}}) {
    ASSERT_EQ(rig_.Post(cl_, way), app::kExitPass) << rig_.said();
    EXPECT_THAT(rig_.Program(), HasSubstr("COMPENSATION=WEAR"));
    EXPECT_THAT(rig_.Program(), HasSubstr("G41"));
    EXPECT_EQ(rig_.Compare(cl_, way), app::kExitPass) << rig_.said();
    EXPECT_THAT(rig_.said(), HasSubstr("cutter compensation: the radius in D of each tool"));
  }
}

TEST_F(Compensation, ItIsAnAssumptionThatKeepsFromPassing) {
  ASSERT_EQ(rig_.Post(cl_, {kUmc750, "", {}}), app::kExitPass) << rig_.said();
  EXPECT_EQ(Compare({"--assume", "offset G54,tool T1"}), app::kExitUnproven);
  EXPECT_THAT(said_, HasSubstr("--assume \"cutter compensation\""));
  EXPECT_EQ(Compare({"--assume", "offset G54,tool T1,cutter compensation"}), app::kExitPass);
}

TEST_F(Compensation, AJobSaysWhatDHolds) {
  ASSERT_EQ(rig_.Post(cl_, {kUmc750, "", {}}), app::kExitPass) << rig_.said();
  EXPECT_EQ(Compare({"--job", Job("d_geometry = 0.0"), "--assume", "all"}), app::kExitPass)
      << said_;
  EXPECT_THAT(said_, Not(HasSubstr("cutter compensation")));
  // With the tool's radius in D the wall is 7 mm off.
  EXPECT_EQ(Compare({"--job", Job(""), "--assume", "all"}), app::kExitFail);
  EXPECT_THAT(said_, HasSubstr("path-deviation"));
}

TEST_F(Compensation, AJobWithTheRadiusInDIsSaid) {
  const auto post = [&](const std::string& d) {
    Run({"post", cl_.string(), "--model", kModel, "--job", Job(d), "--out",
         (rig_.folder() / "out.nc").string(), "--no-check"});
    return said_;
  };
  EXPECT_THAT(post(""), HasSubstr("D of T1 has the tool's radius"));
  EXPECT_THAT(post("d_geometry = 0.0"), Not(HasSubstr("D of T1")));
}

TEST_F(Compensation, OnAnArcAControlAlarms) {
  const std::string arc =
      "TOOL PATH/OP1,TOOL,MILL\nTLDATA/MILL,14,0,75,0,0\nMSYS/0,0,0,1,0,0,0,1,0\nLOAD/TOOL,1\n"
      "SPINDL/RPM,3000,CLW\nRAPID\nGOTO/-10,-20,50,0,0,1\nFEDRAT/MMPM,500\nGOTO/-10,-20,10\n"
      "CUTCOM/LEFT\nCIRCLE/0,-20,10,0,0,-1,10,.006,.5,14,0\nGOTO/10,-20,10\nGOTO/10,30,10\n"
      "CUTCOM/OFF\nGOTO/-5,40,10\nEND-OF-PATH\n";
  EXPECT_EQ(rig_.PostText(arc, {kUmc750, "", {}}), app::kExitBadInput);
  EXPECT_THAT(rig_.said(), HasSubstr("part.cls:11:1: error: cutter compensation begins or ends on "
                                     "an arc"));
  EXPECT_FALSE(std::filesystem::exists(rig_.program()));
}

}  // namespace
}  // namespace ncsim::posting
