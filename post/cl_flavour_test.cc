// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_flavour.h"

#include <gtest/gtest.h>

namespace ncsim::post {
namespace {

ClSurvey Of(const std::string& text) { return Survey(*nc::Program::FromText("t.cls", text)); }

TEST(ClFlavourTest, ByTheFilesOwnWords) {
  EXPECT_EQ(Of("tool  path/A,TOOL,B\nGOTO/1,2,3\n").flavour, ClFlavour::kNx);
  EXPECT_EQ(Of("GOTO/1,2,3\nMSYS/0,0,0,1,0,0,0,1,0\n").flavour_evidence, "MSYS at line 2");
  EXPECT_EQ(Of("$$*         Pro/CLfile  Version 2001\nPARTNO / X\n").flavour, ClFlavour::kCreo);
  EXPECT_EQ(Of("PARTNO / X\nPPWORD/TLANGL,1\n").flavour, ClFlavour::kCreo);
  EXPECT_EQ(Of("$$-> FEATNO / 12\n").flavour, ClFlavour::kCreo);
  EXPECT_EQ(Of("REMARK   ->  FEATNO / 12\n").flavour, ClFlavour::kCreo);
  EXPECT_EQ(Of("PARTNO/1\nUNIT/MM\nCSI_SET_FLUTE_LENGTH/16.\n").flavour, ClFlavour::kSolidWorksCam);
  EXPECT_EQ(Of("PARTNO/1\nCYCLE / INIT\n").flavour, ClFlavour::kSolidWorksCam);
  EXPECT_EQ(Of("PARTNO/1\nUNITS/MM\nCIRCLE/0,0,0,0,0,1,5\n").flavour, ClFlavour::kApt);
  EXPECT_EQ(Of("PARTNO/1\n").flavour_evidence, "");
}

TEST(ClFlavourTest, TwoSystemsAreTold) {
  const ClSurvey survey = Of("TOOL PATH/A,TOOL,B\nTRNTYP/WORLD,0,0,0\n");
  EXPECT_EQ(survey.flavour, ClFlavour::kNx);
  EXPECT_EQ(survey.flavour_contradiction, "TRNTYP at line 2");
}

TEST(ClFlavourTest, UnitByUnitsElseByTheFeedRates) {
  EXPECT_EQ(Of("UNITS / INCHES\nFEDRAT/5,IPM\n").unit, ClUnit::kInch);
  EXPECT_EQ(Of("UNIT/MM\n").unit, ClUnit::kMillimetre);
  EXPECT_EQ(Of("FEDRAT/MMPM,250.0\n").unit, ClUnit::kMillimetre);
  EXPECT_EQ(Of("FEDRAT/85.5 , ipr\n").unit, ClUnit::kInch);
  EXPECT_EQ(Of("CYCLE/DRILL,RAPTO,3.,FEDTO,0.,MMPM,250.\n").unit_evidence, "MMPM at line 1");
  EXPECT_FALSE(Of("FEDRAT/250\n").unit);
  const ClSurvey two = Of("FEDRAT/MMPM,250.0\n\nFEDRAT/IPM,10\n");
  EXPECT_EQ(two.unit_evidence, "MMPM at line 1");
  EXPECT_EQ(two.unit_contradiction, "IPM at line 3");
  const ClSurvey feed = Of("UNITS/MM\nFEDRAT/10,IPM\n");
  EXPECT_EQ(feed.unit, ClUnit::kMillimetre);
  EXPECT_EQ(feed.unit_contradiction, "");
  EXPECT_EQ(feed.other_feed_unit, "IPM at line 2");
}

}  // namespace
}  // namespace ncsim::post
