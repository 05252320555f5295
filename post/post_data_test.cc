// SPDX-License-Identifier: BSD-3-Clause
#include "post/post_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "post/post_options.h"
#include "post/test_plan.h"
#include "post/toml_text.h"

namespace ncsim::post {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::string Changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Messages of a post in which `from` is `to`.
std::string ErrorsOf(const std::string& from, const std::string& to) {
  Diagnostics diagnostics;
  EXPECT_FALSE(LoadPost(Changed(ShippedPost(kFanuc), from, to), "my.post.toml", {}, &diagnostics));
  return AllOf(diagnostics);
}

/// "12:3" of the first `what` in the post of ErrorsOf.
std::string PlaceOf(const std::string& text, const std::string& what) {
  const std::size_t at = text.find(what);
  int line = 1, column = 1;
  for (std::size_t i = 0; i < at; ++i) {
    ++column;
    if (text[i] == '\n') ++line, column = 1;
  }
  return std::to_string(line) + ":" + std::to_string(column);
}

TEST(PostDataTest, AnUnknownNameIsAnErrorWithItsPlace) {
  const std::string text = Changed(ShippedPost(kFanuc), "T{tool.number} M06", "T{tool.nummer} M06");
  Diagnostics diagnostics;
  EXPECT_FALSE(LoadPost(text, "my.post.toml", {}, &diagnostics));
  EXPECT_EQ(AllOf(diagnostics), "my.post.toml:" + PlaceOf(text, "tool.nummer") +
                                    ": error: unknown name 'tool.nummer' (did you mean "
                                    "'tool.number'?)\n");
}

TEST(PostDataTest, SoIsOneInAStringOfOneLine) {
  const std::string text = Changed(ShippedPost(kFanuc), "P{dwell.seconds}", "\\t P{dwel}");
  Diagnostics diagnostics;
  EXPECT_FALSE(LoadPost(text, "my.post.toml", {}, &diagnostics));
  EXPECT_THAT(AllOf(diagnostics),
              HasSubstr("my.post.toml:" + PlaceOf(text, "dwel}") + ": error: unknown name 'dwel'"));
}

TEST(PostDataTest, ANameWithoutAValueThere) {
  EXPECT_THAT(ErrorsOf("T{tool.number} M06", "T{tool.number} M06 Z{z}"),
              HasSubstr("error: 'z' has no value in this block"));
  EXPECT_THAT(ErrorsOf("T{tool.number} M06", "T{tool.number} M06 {X}"),
              HasSubstr("error: 'X' has no value in this block"));
}

TEST(PostDataTest, BracesFormatsAndKeys) {
  EXPECT_THAT(ErrorsOf("T{tool.number} M06", "T{tool.number M06"), HasSubstr("'{' without '}'"));
  EXPECT_THAT(ErrorsOf("T{tool.number} M06", "T} M06"), HasSubstr("'}' without '{'"));
  EXPECT_THAT(ErrorsOf("T{tool.number} M06", "{?T{tool.number} M06"), HasSubstr("'{?'"));
  EXPECT_THAT(ErrorsOf("T{tool.number} M06", "T{tool.number:tow} M06"),
              HasSubstr("no format 'tow' (did you mean 'two'?)"));
  EXPECT_THAT(ErrorsOf("T{tool.number} M06", "T{tool.name:two} M06"),
              HasSubstr("only a number takes a format"));
  EXPECT_THAT(ErrorsOf("cycle_end = ", "cycle_edn = "), HasSubstr("cycle_edn"));
  EXPECT_THAT(ErrorsOf("off = \"M05\", ", ""), HasSubstr("no code 'codes.spindle.off'"));
  EXPECT_THAT(ErrorsOf("cycle_end = \"G80\"", ""), HasSubstr("no block 'cycle_end'"));
  EXPECT_THAT(
      ErrorsOf("G00 {X!} {Y!}\n", "G00 {X!}\n"),
      HasSubstr("block 'index' of mode 'three' prints not all of x, y, z and the rotary axes"));
  EXPECT_THAT(ErrorsOf("value = \"x\"", "value = \"xx\""), HasSubstr("'xx' is no number"));
  EXPECT_THAT(ErrorsOf("X = { value = \"x\", format = \"length\" }", ""),
              HasSubstr("no word has the value 'x'"));
}

TEST(PostDataTest, ASiteChangesTheOutputWithoutCode) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, TestPlan::Pose(1, 2, 3)).Feed(TestPlan::Pose(1, 2, -3));
  const std::string post = ShippedPost(kFanuc);
  EXPECT_THAT(plan.Write(post), Contains("T3 M06"));
  const auto lines = plan.Write(Changed(
      Changed(post, "T{tool.number} M06", "M06 T{tool.number:two}\nG65 P9811 A{tool.diameter}"),
      "length = { decimals = { mm = 3, inch = 4 }, digits = 0 }",
      "length = { decimals = 2, digits = 3, point = false, plus = true }"));
  EXPECT_THAT(lines, Contains("M06 T03"));
  EXPECT_THAT(lines, Contains("G01 Z-003 F600."));
  for (const std::string& line : lines) EXPECT_EQ(line.find("G65"), std::string::npos);
  EXPECT_EQ(AllOf(plan.diagnostics), "");
}

TEST(PostDataTest, ConstantsOfTheCommand) {
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, TestPlan::Pose(1, 2, 3));
  PostSettings settings;
  settings.constants["offset"] = "G55";
  EXPECT_THAT(plan.Write(ShippedPost(kFanuc), settings), Contains("G55"));
  settings.constants["ofset"] = "G56";
  plan.Write(ShippedPost(kFanuc), settings);
  EXPECT_THAT(AllOf(plan.diagnostics),
              HasSubstr("the post has no constant 'ofset' (did you mean 'offset'?)"));
}

TEST(PostDataTest, WhatStandsInABlockIsWhatTheControlHas) {
  // G00 in the block of a stop: the feed that follows says G01 again, though it was the last code
  // that a word printed. Words in comments are none.
  TestPlan plan;
  plan.Begin(PlanMode::kIndexed, TestPlan::Pose(0, 0, 3));
  plan.Feed(TestPlan::Pose(1, 0, 3)).Add(cl::Stop{}).Feed(TestPlan::Pose(2, 0, 3));
  const std::string post = ShippedPost(kFanuc);
  EXPECT_THAT(plan.Write(Changed(post, "stop = \"M00\"", "stop = \"M00 (G00 F9.)\"")),
              Contains("X2."));
  EXPECT_THAT(plan.Write(Changed(post, "stop = \"M00\"", "stop = \"M00 G00 F9.\"")),
              Contains("G01 X2. F600."));
}

TEST(PostDataTest, IncrementsAndRounding) {
  Diagnostics diagnostics;
  PostSettings inch;
  inch.unit = ClUnit::kInch;
  const auto post = LoadPost(ShippedPost(kUmc750), "p", inch, &diagnostics);
  ASSERT_TRUE(post);
  EXPECT_DOUBLE_EQ(post->Increment(Value::kX), 0.0001);
  EXPECT_DOUBLE_EQ(post->Increment(Value::kRotary1), 0.001);
  EXPECT_EQ(post->AsPrinted(Value::kX, 0.81544), 0.8154);
  EXPECT_EQ(post->Mode(PlanMode::kIndexed, "")->name, "indexed");
  EXPECT_EQ(post->Mode(PlanMode::kIndexed, "three")->name, "three");
  EXPECT_EQ(post->Mode(PlanMode::kTcp, "three")->name, "tcp");
}

TEST(PostDataTest, WhatThePlannerMayUse) {
  Diagnostics diagnostics;
  const auto haas = LoadPost(ShippedPost(kUmc750), "p", {}, &diagnostics);
  const auto table = LoadPost(ShippedPost(kBcTable), "p", {}, &diagnostics);
  ASSERT_TRUE(haas && table);
  const PlanOptions any = PlanOptionsOf(*haas, "");
  EXPECT_FALSE(any.mode);
  EXPECT_FALSE(any.turned_planes);
  EXPECT_TRUE(any.abilities[static_cast<std::size_t>(PlanMode::kIndexed)].holes);
  EXPECT_FALSE(any.abilities[static_cast<std::size_t>(PlanMode::kTcp)].holes);
  EXPECT_FALSE(any.abilities[static_cast<std::size_t>(PlanMode::kTcp)].arcs[0]);
  EXPECT_EQ(PlanOptionsOf(*haas, "axes").mode, PlanMode::kAxes);
  const PlanOptions plane = PlanOptionsOf(*table, "rot");
  EXPECT_EQ(plane.mode, PlanMode::kIndexed);
  EXPECT_TRUE(plane.turned_planes);
  EXPECT_TRUE(plane.abilities[static_cast<std::size_t>(PlanMode::kTcp)].helices);
}

TEST(TomlTextTest, PlacesInEveryKindOfString) {
  const auto place = [](std::string_view source, int line, int column, std::size_t offset) {
    const TextPosition at = PositionInString(source, {line, column}, offset);
    return std::to_string(at.line) + ":" + std::to_string(at.column);
  };
  EXPECT_EQ(place("a = \"bcd\"", 1, 5, 2), "1:8");
  EXPECT_EQ(place("a = \"b\\\"d\"", 1, 5, 2), "1:9");
  EXPECT_EQ(place("a = 'b\\\"d'", 1, 5, 2), "1:8");
  EXPECT_EQ(place("\na = \"\"\"\nbc\nde\"\"\"", 2, 5, 4), "4:2");
  EXPECT_EQ(place("a = '''bc\nde'''", 1, 5, 3), "2:1");
  EXPECT_EQ(place("a = \"\"\"b\\\n   cd\"\"\"", 1, 5, 2), "2:5");
}

}  // namespace
}  // namespace ncsim::post
