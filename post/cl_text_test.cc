// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncsim::post {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ClTextTest : public testing::Test {
 protected:
  std::vector<ClLine> Read(const std::string& text) {
    program_ = nc::Program::FromText("t.cls", text);
    ClText reader(program_, &diagnostics_);
    std::vector<ClLine> lines;
    for (ClLine line; reader.Next(&line);) lines.push_back(line);
    return lines;
  }
  std::string Error() const {
    return diagnostics_.all().empty() ? "" : ToString(diagnostics_.all().front());
  }
  static std::vector<std::string> Words(const ClLine& line) {
    std::vector<std::string> words;
    for (const ClToken& token : line.tokens) words.emplace_back(token.text);
    return words;
  }

  std::shared_ptr<const nc::Program> program_;
  Diagnostics diagnostics_;
};

// Blanks and tabs around separators, and keywords in any case: what the tests of the open parsers
// bcpost and PostProcessor take.
TEST_F(ClTextTest, BlanksAndCaseAreFree) {
  const auto lines =
      Read("  goto / -24.5855 ,\t.5 , 1.E-3\r\nTOOL \t PATH/A,TOOL,B\n\nRAPID/\rFINI");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0].major, "GOTO");
  EXPECT_EQ(lines[0].column, 3);
  ASSERT_EQ(lines[0].tokens.size(), 3u);
  EXPECT_EQ(lines[0].tokens[0].number, -24.5855);
  EXPECT_EQ(lines[0].tokens[1].number, 0.5);
  EXPECT_EQ(lines[0].tokens[1].column, 21);
  EXPECT_EQ(lines[0].tokens[2].number, 0.001);
  EXPECT_EQ(lines[1].major, "TOOL PATH");
  EXPECT_EQ(lines[1].text, "A,TOOL,B");
  EXPECT_EQ(lines[2].major, "RAPID");
  EXPECT_EQ(lines[2].line, 4);
  EXPECT_TRUE(lines[2].tokens.empty());
  EXPECT_EQ(lines[3].line, 5);
  EXPECT_EQ(Error(), "");
}

TEST_F(ClTextTest, ADollarGoesOnInTheNextLine) {
  EXPECT_THAT(Words(Read("GOTO / 1, 2, 3,  $\n0.5, $\n$\n  0.25, 0 $$ end\nFINI\n")[0]),
              ElementsAre("1", "2", "3", "0.5", "0.25", "0"));
  const auto three = Read("GOTO/1,2 $\n ,3\n");
  EXPECT_THAT(Words(three[0]), ElementsAre("1", "2", "3"));
  EXPECT_EQ(three[0].tokens[2].line, 2);
  EXPECT_EQ(three[0].tokens[2].column, 3);
}

TEST_F(ClTextTest, TextWordsAreTakenLiterally) {
  const auto lines = Read("INSERT/[HOLDER=C40] 3mm $ x, y  \nPPRINT  hello/world\nREMARK * PRO\n");
  EXPECT_EQ(lines[0].kind, ClLine::Kind::kText);
  EXPECT_EQ(lines[0].text, "[HOLDER=C40] 3mm $ x, y");
  EXPECT_EQ(lines[1].text, "hello/world");
  EXPECT_EQ(lines[2].text, "* PRO");
}

TEST_F(ClTextTest, CommentsMayCarryData) {
  const auto lines = Read(
      "$$ centerline data\n$$-> CUTTER / 6.000000\nREMARK -> MFGNO / MY PART\n$$-> CSYS / 1, 0, $\n"
      "  0, 5\nFINI\n");
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0].kind, ClLine::Kind::kComment);
  EXPECT_EQ(lines[1].kind, ClLine::Kind::kData);
  EXPECT_EQ(lines[1].major, "CUTTER");
  EXPECT_EQ(lines[1].tokens[0].number, 6.0);
  EXPECT_EQ(lines[2].major, "MFGNO");
  EXPECT_EQ(lines[2].text, "MY PART");
  EXPECT_THAT(Words(lines[3]), ElementsAre("1", "0", "0", "5"));
  EXPECT_EQ(Error(), "");
}

TEST_F(ClTextTest, ALineOfNumbersHasNoMajorWord) {
  const auto lines = Read("GOTO/1,2,3\n 4,5,6\n-.5,+1,0\n");
  EXPECT_EQ(lines[1].kind, ClLine::Kind::kNumbers);
  EXPECT_EQ(lines[1].major, "");
  EXPECT_EQ(lines[2].tokens[0].number, -0.5);
  EXPECT_EQ(lines[2].tokens[1].number, 1.0);
}

TEST_F(ClTextTest, WhatIsNoNumber) {
  for (const char* text : {"nan", "inf", "-nan", "-inf", "1.2.3", "1STPECK", "1e999", "1e13", ".",
                           "-", "0x10", "1,", "--1"}) {
    const auto lines = Read("GOTO/" + std::string(text) + "\n");
    EXPECT_FALSE(lines[0].tokens.back().is_number) << text;
  }
}

TEST_F(ClTextTest, SaysWhereALineIsWrong) {
  Read("GOTO/1,2,3\nGOTO/1 2,3\n");
  EXPECT_EQ(Error(), "t.cls:2:6: error: '1 2' has a blank inside: a comma is missing");
  diagnostics_ = {};
  Read("GOTO/1,2 $\n3\n");
  EXPECT_EQ(Error(), "t.cls:2:1: error: a comma is missing between the lines");
  diagnostics_ = {};
  Read("GOTO/1,2, $ 3\n4\n");
  EXPECT_EQ(Error(), "t.cls:1:13: error: '3' after the '$' that continues the statement");
  diagnostics_ = {};
  Read("GOTO/1,2,3, $\n\n4,5,6\n");
  EXPECT_EQ(Error(), "t.cls:2:1: error: nothing follows the comma of the line before");
  diagnostics_ = {};
  Read("GOTO/1,2, $");
  EXPECT_EQ(Error(), "t.cls:1:12: error: the file ends where a statement goes on");
}

TEST_F(ClTextTest, AStatementHasAnEnd) {
  std::string deep = "GOTO/1";
  for (int i = 0; i < 100'000; ++i) deep += ",$\n1";
  const auto lines = Read(deep + "\nFINI\n");
  EXPECT_THAT(Error(), HasSubstr("t.cls:1001:1: error: a statement of more than 1000 values"));
  EXPECT_EQ(lines.front().kind, ClLine::Kind::kBroken);
  EXPECT_EQ(lines.back().major, "FINI");
  EXPECT_EQ(diagnostics_.all().size(), 1u);
  diagnostics_ = {};
  std::string wide = "GOTO/";
  for (int i = 0; i < 1'000'000; ++i) wide += "1.0,";
  EXPECT_EQ(Read(wide + "\nFINI\n").size(), 2u);
  EXPECT_EQ(diagnostics_.all().size(), 1u);
}

TEST(QuotedTest, IsPrintableAndShort) {
  EXPECT_EQ(Quoted("a\x01\xFF"),
            "'a?"
            "?'");
  EXPECT_EQ(Quoted(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace ncsim::post
