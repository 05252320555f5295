// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/baseline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/nightly/test_folder.h"

namespace ncsim::nightly {
namespace {

using ::testing::HasSubstr;

const std::string kWhole =
    "schema = 1\n[[accept]]\nprogram = \"a.nc\"\nrule = \"near-miss\"\nline_text = \" G01 X5. \"\n"
    "reason = \"measured\"\nexpires = \"2027-03-01\"\n";

std::string Fault(const std::string& text) {
  const TestFolder folder("baseline");
  Diagnostics diagnostics;
  const auto baseline = ReadBaseline(folder.Write("b.toml", text), &diagnostics);
  EXPECT_EQ(baseline.has_value(), diagnostics.all().empty());
  return diagnostics.all().empty() ? "" : ToString(diagnostics.all().front());
}

std::string With(const std::string& from, const std::string& to) {
  std::string text = kWhole;
  return text.replace(text.find(from), from.size(), to);
}

TEST(BaselineTest, AcceptsByProgramRuleAndTextOfTheLine) {
  const TestFolder folder("baseline_whole");
  Diagnostics diagnostics;
  const auto baseline = ReadBaseline(folder.Write("b.toml", kWhole), &diagnostics);
  ASSERT_TRUE(baseline);
  const Acceptance& accepted = baseline->accepted.at(0);
  ReportFinding finding;
  finding.rule = "near-miss";
  finding.source = "G01 X5.";
  EXPECT_TRUE(accepted.Matches("a.nc", finding));
  EXPECT_FALSE(accepted.Matches("b.nc", finding));
  finding.source = "G01 X5.5";
  EXPECT_FALSE(accepted.Matches("a.nc", finding));
  finding.source = "G01 X5.";
  finding.rule = "collision";
  EXPECT_FALSE(accepted.Matches("a.nc", finding));
}

TEST(BaselineTest, OrByPartOfTheMessage) {
  Acceptance accepted{"a.nc", "assumed", "", "offset G54", "measured", "2027-03-01"};
  ReportFinding finding;
  finding.rule = "assumed";
  finding.message = "offset G54 is taken to be 0";
  EXPECT_TRUE(accepted.Matches("a.nc", finding));
  finding.message = "offset G55 is taken to be 0";
  EXPECT_FALSE(accepted.Matches("a.nc", finding));
}

TEST(BaselineTest, IsStrict) {
  EXPECT_EQ(Fault(kWhole), "");
  EXPECT_THAT(Fault(With("reason = \"measured\"\n", "")), HasSubstr("'reason' is missing"));
  EXPECT_THAT(Fault(With("measured", " ")), HasSubstr("'reason' must not be empty"));
  EXPECT_THAT(Fault(With("expires = \"2027-03-01\"\n", "")), HasSubstr("'expires' is missing"));
  EXPECT_THAT(Fault(With("2027-03-01", "2027-02-29")), HasSubstr("must be a day"));
  EXPECT_THAT(Fault(With("near-miss", "near-mist")), HasSubstr("did you mean 'near-miss'?"));
  EXPECT_THAT(Fault(With("line_text = \" G01 X5. \"\n", "")),
              HasSubstr("'line_text' or 'message'"));
  EXPECT_THAT(Fault(With("line_text", "linetext")), HasSubstr("unknown key 'linetext'"));
}

TEST(BaselineTest, DaysOfTheCalendar) {
  EXPECT_TRUE(IsDay("2028-02-29"));
  for (const char* text : {"2026-02-29", "2026-13-01", "2026-00-10", "2026-1-01", "26-01-01", "",
                           "2026-01-0x", "2026/01/01", "2026-01-01 "}) {
    EXPECT_FALSE(IsDay(text)) << text;
  }
}

}  // namespace
}  // namespace ncsim::nightly
