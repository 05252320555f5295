// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_index.h"

#include <gtest/gtest.h>

namespace ncsim::nc {
namespace {

TEST(SinumerikIndexTest, ProgramsOfAnArchive) {
  const auto program = Program::FromText(
      "t",
      "%_N_SHAFT123_MPF\n;$PATH=/_N_MPF_DIR\nX1\nM30\n%_N_POCK_SPF\nLA: X2\nM17\n%Flange3_MPF\n");
  const SinumerikIndex index(*program);
  ASSERT_EQ(index.sections().size(), 3u);
  EXPECT_EQ(index.sections()[0].name, "SHAFT123");
  EXPECT_TRUE(index.sections()[0].is_main);
  EXPECT_EQ(index.sections()[0].begin.line, 2);
  EXPECT_EQ(index.Find("POCK")->begin.line, 6);
  EXPECT_EQ(index.Find("FLANGE3")->begin.line, 9);
  EXPECT_EQ(index.Find("NONE"), nullptr);
  EXPECT_EQ(index.SectionAt(index.Find("POCK")->begin.offset + 2).name, "POCK");
}

TEST(SinumerikIndexTest, LabelsAndNumbersInBothDirections) {
  const std::string text = "N10 LA: X1\nN20 X2\nla: X3\nN010 X4\n:20 X5\n";
  const auto program = Program::FromText("t", text);
  const SinumerikIndex index(*program);
  EXPECT_EQ(index.FindForward("LA", 0, text.size())->line, 1);
  EXPECT_EQ(index.FindForward("la", 1, text.size())->line, 3);
  EXPECT_EQ(index.FindForward("LA", 1, 12), std::nullopt);
  EXPECT_EQ(index.FindBackward("LA", 0, text.size())->line, 3);
  EXPECT_EQ(index.FindBackward("LA", 1, 5), std::nullopt);
  EXPECT_EQ(index.FindForward("N10", 1, text.size())->line, 4);
  EXPECT_EQ(index.FindBackward("N0020", 0, text.size())->line, 5);
  EXPECT_EQ(index.FindForward("N5", 0, text.size()), std::nullopt);
}

TEST(SinumerikIndexTest, PartnersOfControlStructures) {
  const std::string text =
      "IF 1\nFOR R1=1 TO 2\nENDFOR\nELSE\nIF 1 GOTOF LA\nENDIF\nLA: X1\nUNTIL 1\n";
  const auto program = Program::FromText("t", text);
  const SinumerikIndex index(*program);
  const SinumerikPartner* outer = index.Partner(0);
  ASSERT_NE(outer, nullptr);
  EXPECT_EQ(outer->else_block->line, 4);
  EXPECT_EQ(outer->other.line, 6);
  EXPECT_EQ(index.Partner(5)->other.line, 3);
  EXPECT_EQ(index.Partner(text.find("ENDFOR"))->other.line, 2);
  EXPECT_EQ(index.Partner(text.find("IF 1 GOTOF")), nullptr);  // One line: no structure.
  EXPECT_NE(index.Partner(text.find("UNTIL"))->error.find("12640"), std::string::npos);
}

}  // namespace
}  // namespace ncsim::nc
