// SPDX-License-Identifier: BSD-3-Clause
// The bytes of the text and JSON reports, pinned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "sim/base/units.h"
#include "sim/report/printable.h"
#include "sim/report/result.h"

namespace ncsim::report {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

class ReportTest : public ::testing::Test {
 protected:
  ReportTest() {
    files_.Add("part.nc");
    result_.program = "part.nc";
    result_.model = "umc750";
    result_.not_checked = {"stock"};
    result_.verdict = Verdict::kPass;
  }

  static Finding HolderHitsVise() {
    Finding finding = MakeFinding(Rule::kCollision, {0, 412, 1},
                                  "holder of T3 hits vise_jaw 1.4 mm deep at X-81.280");
    finding.bodies = {"T3.holder", "vise_jaw"};
    finding.clearance_mm = -1.4;
    finding.axes = {{'X', -81.28}, {'Y', -1e-9}, {'Z', -312.4}, {'B', -20.0}, {'C', 45.0}};
    finding.time_s = 733.1;
    return finding;
  }

  std::string Text() const {
    std::ostringstream out;
    WriteText(
        result_, files_,
        [](int, int line) { return line == 412 ? std::string_view("N10 X1. Y2.") : ""; }, out);
    return out.str();
  }
  std::string Json() const {
    std::ostringstream out;
    WriteJson(result_, files_, out);
    return out.str();
  }

  SourceFiles files_;
  CheckResult result_;
};

TEST_F(ReportTest, TextOfAContact) {
  result_.verdict = Verdict::kFail;
  result_.blocks = 16115;
  result_.motion_time = 8123.4;
  result_.findings = {HolderHitsVise()};
  result_.clearances = {{{"T3.holder", "platter"}, 12.349, 12.35, {0, 388, 1}},
                        {{"T3.holder", "vise_jaw"}, 0.0, -1.4, {0, 412, 1}}};
  result_.cuts = {{3, 0.1234, {0, 500, 1}}};
  result_.assumptions = {{"offset G54", "the centre of the table", true, false},
                         {"start", "home", false, false},
                         {"tool T3", "length 150 mm", true, true}};
  EXPECT_EQ(Text(),
            "part.nc:412:1: error: holder of T3 hits vise_jaw 1.4 mm deep at X-81.280 [collision]\n"
            "  N10 X1. Y2.\n"
            "  ^\n"
            "deepest cut of T3 into the finished part: 0.123 mm at line 500\n"
            "least clearance of each pair, nearest first:\n"
            "  T3.holder and vise_jaw: never less than 0.00 mm, seen -1.40 mm at line 412\n"
            "  T3.holder and platter: never less than 12.34 mm, seen 12.35 mm at line 388\n"
            "assumed, because neither the job nor the command line says:\n"
            "  offset G54: the centre of the table (keeps the verdict from being pass)\n"
            "  start: home\n"
            "  tool T3: length 150 mm (accepted)\n"
            "machine time: " +
                std::string(MotionTimeModel()) +
                "\n"
                "fail, stock not simulated: 1 error, 0 unproven, 0 warnings; 16115 blocks, 2 h 15 "
                "min 23 s of machine time, least clearance 0.00 mm (T3.holder and vise_jaw)\n");
}

TEST_F(ReportTest, AFindingOfTheWholeFileHasNoLine) {
  result_.findings = {MakeFinding(Rule::kAssumed, {0, 0, 0}, "offset G54: not stated")};
  EXPECT_THAT(Text(), HasSubstr("part.nc: unproven: offset G54: not stated [assumed]\n"));
}

TEST_F(ReportTest, RepeatedFindingsAreSummed) {
  for (int line = 1; line <= kMaxFindingsOfRule + 37; ++line) {
    result_.findings.push_back(MakeFinding(Rule::kClamp, {0, line, 1}, "brake"));
  }
  result_.findings.push_back(HolderHitsVise());
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("part.nc:20:1: warning: brake [clamp]\n"));
  EXPECT_THAT(text, Not(HasSubstr("part.nc:21:1: warning: brake")));
  EXPECT_THAT(text, HasSubstr("... and 37 more of severity warning [clamp]"));
  EXPECT_THAT(text, HasSubstr("holder of T3 hits vise_jaw"));
}

TEST_F(ReportTest, WideningIsTold) {
  result_.clearances = {{{"T3.shank", "ring"}, 5.0, 5.1, {0, 388, 1}, 1.2},
                        {{"T3.holder", "ring"}, 5.0, 5.1, {0, 388, 1}, 2.5}};
  EXPECT_THAT(Text(), Not(HasSubstr("widened")));
  result_.orientation_tolerance = Radians(1.0);
  EXPECT_THAT(Text(), HasSubstr("\npairs were widened for smoothing, which may turn the tool by 1 "
                                "deg: by up to 2.50 mm (T3.holder and ring)\n"));
}

TEST_F(ReportTest, HostileBytesDoNotReachTheTerminal) {
  result_.findings = {MakeFinding(Rule::kSyntax, {0, 3, 1}, "'\x1b[2J' \xff \xc2\x9b is no word")};
  EXPECT_THAT(Text(), HasSubstr("'?[2J' ? ?? is no word [syntax]"));
}

TEST_F(ReportTest, JsonOfAContact) {
  result_.verdict = Verdict::kFail;
  result_.blocks = 16115;
  result_.motion_time = 8123.42;
  result_.findings = {HolderHitsVise()};
  result_.clearances = {{{"T3.holder", "vise_jaw"}, 1.819, 1.83, {0, 388, 1}, 2.5}};
  result_.orientation_tolerance = Radians(1.0);
  result_.assumptions = {{"offset G54", "...", true, false}};
  std::string flat;
  for (const char c : Json()) {
    if (c != '\n') flat.push_back(c);
  }
  std::string squeezed;  // One blank for the indentation.
  for (const char c : flat) {
    if (c != ' ' || squeezed.empty() || squeezed.back() != ' ') squeezed.push_back(c);
  }
  EXPECT_EQ(
      squeezed,
      R"({ "schema": 1, "verdict": "fail", "program": "part.nc", "model": "umc750", )"
      R"("blocks": 16115, "motion_time_s": 8123.4, "findings": [ { "rule": "collision", )"
      R"("severity": "error", "file": "part.nc", "line": 412, "column": 1, "message": )"
      R"("holder of T3 hits vise_jaw 1.4 mm deep at X-81.280", "bodies": [ "T3.holder", )"
      R"("vise_jaw" ], "clearance_mm": -1.4, "axes": { "X": -81.28, "Y": 0.0, "Z": -312.4, "B": -20.0, )"
      R"("C": 45.0 }, "time_s": 733.1 } ], "clearances": [ { "bodies": [ "T3.holder", )"
      R"("vise_jaw" ], "proven_mm": 1.81, "seen_mm": 1.83, "line": 388, "file": "part.nc", )"
      R"("widened_mm": 2.5 } ], )"
      R"("assumptions": [ { "name": "offset G54", "text": "...", "places_metal": true, )"
      R"("accepted": false } ], "not_checked": [ "stock" ], "cuts": [], "job": null, )"
      R"("motion_time_model": ")" +
          std::string(MotionTimeModel()) + R"(", "orientation_tolerance_deg": 1.0})");
}

TEST_F(ReportTest, ThePointsOfAContact) {
  Finding finding = HolderHitsVise();
  finding.points = {{-57.31, 4.2, -372.1184}, {-57.31, -1e-9, -372.12}};
  result_.findings = {finding};
  EXPECT_THAT(Text(),
              HasSubstr("  N10 X1. Y2.\n  ^\n"
                        "  contact point, machine coordinates: X-57.310 Y0.000 Z-372.120\n"));
  std::string json = Json();
  json.erase(std::remove_if(json.begin(), json.end(), [](char c) { return c <= ' '; }), json.end());
  EXPECT_THAT(json, HasSubstr(R"("points_mm":[[-57.31,4.2,-372.118],[-57.31,0.0,-372.12]],)"));
}

TEST_F(ReportTest, JsonNeverRoundsAProvenClearanceUp) {
  result_.clearances = {{{"a", "b"}, 0.0099, 0.0149, {0, 1, 1}},
                        {{"a", "c"}, std::nan(""), std::numeric_limits<double>::infinity(), {}}};
  const std::string json = Json();
  EXPECT_THAT(json, HasSubstr("\"proven_mm\": 0.0,"));
  EXPECT_THAT(json, HasSubstr("\"seen_mm\": 0.01,"));
  EXPECT_THAT(json, HasSubstr("\"proven_mm\": null,"));
  EXPECT_THAT(json, HasSubstr("\"seen_mm\": null,"));
}

TEST_F(ReportTest, JsonOfAContactBetweenMachineLinksHasNullClearance) {
  Finding finding = HolderHitsVise();
  finding.clearance_mm.reset();
  result_.findings = {finding};
  EXPECT_THAT(Json(), HasSubstr("\"clearance_mm\": null"));
}

TEST_F(ReportTest, JsonSurvivesBytesThatAreNotUtf8) {
  result_.findings = {MakeFinding(Rule::kSyntax, {0, 1, 1}, "quote \" and \xe9 and \x01")};
  EXPECT_THAT(Json(), HasSubstr("quote \\\" and \xef\xbf\xbd and \\u0001"));
}

TEST_F(ReportTest, FindingsAreSortedByPlaceThenRule) {
  std::vector<Finding> findings = {
      MakeFinding(Rule::kClamp, {0, 9, 1}, "b"), MakeFinding(Rule::kClamp, {0, 2, 5}, "c"),
      MakeFinding(Rule::kSyntax, {0, 9, 1}, "a"), MakeFinding(Rule::kClamp, {0, 2, 1}, "d")};
  SortFindings(&findings);
  std::string order;
  for (const Finding& finding : findings) order += finding.message;
  EXPECT_EQ(order, "dcab");
}

TEST(LineWithCaretTest, PointsAtTheColumnThroughTabsAndUtf8) {
  EXPECT_EQ(LineWithCaret("G1 X", 4), "  G1 X\n     ^\n");
  EXPECT_EQ(LineWithCaret("\tX1", 2), "  \tX1\n  \t^\n");
  EXPECT_EQ(LineWithCaret("(\xc3\xa4) X", 5), "  (\xc3\xa4) X\n     ^\n");
  EXPECT_EQ(LineWithCaret("X", 99), "  X\n   ^\n");
}

TEST(LineWithCaretTest, CutsALineOfTenMegabytes) {
  const std::string line(10'000'000, 'X');
  const std::string text = LineWithCaret(line, 5'000'000);
  EXPECT_LT(text.size(), 250U);
  EXPECT_THAT(text, HasSubstr("..."));
  EXPECT_THAT(text, EndsWith("^\n"));
}

TEST(PrintableTest, KeepsValidUtf8AndNothingElse) {
  EXPECT_EQ(Printable("Fr\xc3\xa4ser 20\xe2\x84\x83"), "Fr\xc3\xa4ser 20\xe2\x84\x83");
  EXPECT_EQ(Printable("\xe9t\xe9"), "?t?");     // Latin-1.
  EXPECT_EQ(Printable("\xc0\xaf"), "??");       // Overlong.
  EXPECT_EQ(Printable("\xed\xa0\x80"), "???");  // A surrogate.
  EXPECT_EQ(Printable("\xe2\x84"), "??");       // Cut short.
  EXPECT_EQ(Printable(std::string_view("a\0b\r\x7f", 5)), "a?b??");
}

}  // namespace
}  // namespace ncsim::report
