// SPDX-License-Identifier: BSD-3-Clause
#include "post/block_template.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "post/test_plan.h"

namespace ncsim::post {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// "G0 X" of the words: codes, or addresses in brackets where they are more than a letter.
std::string Words(std::string_view text, std::string_view open, std::string_view close) {
  std::string all;
  for (const WrittenWord& word : WordsOf(text, open, close)) {
    all += (all.empty() ? "" : " ") + (word.code.empty() ? "[" + word.address + "]" : word.code);
  }
  return all;
}

TEST(WordsOfTest, CodesWithoutLeadingZeros) {
  EXPECT_EQ(Words("G53 G00 Z0.", "(", ")"), "G53 G0 Z0.");
  EXPECT_EQ(Words("g53g00z-1.5", "(", ")"), "G53 G0 Z-1.5");
  EXPECT_EQ(Words("G254 M06", "(", ")"), "G254 M6");
}

TEST(WordsOfTest, AnAddressWhoseValueANamePrints) { EXPECT_EQ(Words("M06 T", "(", ")"), "M6 T"); }

TEST(WordsOfTest, CommentsStringsAndArgumentsAreNone) {
  EXPECT_EQ(Words("M00 (G01 X5.) M01", "(", ")"), "M0 M1");
  EXPECT_EQ(Words("G0 ; X5.", ";", ""), "G0");
  EXPECT_EQ(Words("MSG(\"G1 X5\") M5", ";", ""), "MSG M5");
  EXPECT_EQ(Words("CYCLE832(.01,_FINISH,1)", ";", ""), "CYCLE832");
}

TEST(WordsOfTest, AssignmentsOfThe840D) {
  EXPECT_EQ(Words("TRAORI", ";", ""), "TRAORI");
  EXPECT_EQ(Words("SUPA G0 Z=_Z_HOME D0", ";", ""), "SUPA G0 [Z=] [Z] D0");
  EXPECT_EQ(Words("A3=.5 C=DC(10.)", ";", ""), "[A3=] [C=] [C]");
}

/// What a line of the home block of the Fanuc post prints.
std::vector<std::string> Home(const std::string& block, const std::string& tool_name = "") {
  std::string post = ShippedPost(kFanuc);
  const std::size_t begin = post.find("home = \"\"\"\n") + 11;
  post.replace(begin, post.find("\"\"\"", begin) - begin, block + "\n");
  TestPlan plan;
  plan.tool().name = tool_name;
  plan.Share().Begin(PlanMode::kIndexed, TestPlan::Pose(0, 0, 5)).Add(ClHome{});
  return Behind(plan.Write(post), "G90 G49");
}

TEST(BlockTemplateTest, ALineWithoutAPrintedNameVanishes) {
  EXPECT_THAT(Home("M1\nM2 {tool.name}\nM3"), ElementsAre("M1", "M3"));
  EXPECT_THAT(Home("M1\nM2 {tool.name}\nM3", "A"), ElementsAre("M1", "M2 A", "M3"));
}

TEST(BlockTemplateTest, SoDoesAnOptionalPart) {
  EXPECT_THAT(Home("T{tool.number} {?A{tool.name} {?B{tool.length}}} M3"), ElementsAre("T3 M3"));
  EXPECT_THAT(Home("T{tool.number} {?A{tool.name} {?B{tool.length}}} M3", "X"),
              ElementsAre("T3 AX M3"));
  EXPECT_THAT(Home("{?A{tool.name}}{?B{tool.length}}"), IsEmpty());
}

TEST(BlockTemplateTest, TheBlankOfANameGoesWithIt) {
  EXPECT_THAT(Home("{unit} {coolant!} {unit} {spindle!} M1"), ElementsAre("M09 M03 M1"));
  EXPECT_THAT(Home("{unit} {unit}"), IsEmpty());
}

TEST(BlockTemplateTest, WhatVanishesWasNotPrinted) {
  // G00 stands in a line that vanishes: the feed behind it goes on without a code.
  std::string post = ShippedPost(kFanuc);
  const std::string stop = "stop = \"M00\"";
  post.replace(post.find(stop), stop.size(), "stop = \"M00\\nG00 {tool.name}\"");
  TestPlan plan;
  plan.tool().name = "";
  plan.Share().Begin(PlanMode::kIndexed, TestPlan::Pose(0, 0, 5));
  plan.Feed(TestPlan::Pose(1, 0, 5)).Add(cl::Stop{}).Feed(TestPlan::Pose(2, 0, 5));
  EXPECT_THAT(Behind(plan.Write(post), "M00"), ElementsAre("S8000 M03", "X2."));
}

}  // namespace
}  // namespace ncsim::post
