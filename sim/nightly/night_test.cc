// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/night.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "sim/nightly/test_folder.h"

namespace ncsim::nightly {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

ReportFinding Finding(const std::string& rule, const std::string& severity, int line,
                      const std::string& source) {
  return {rule, severity, "a.nc", "message of " + std::to_string(line), line, {}, source};
}

Result Checked(const std::string& name, const std::string& verdict,
               std::vector<ReportFinding> findings, double proven = 5.0, double seen = 5.5) {
  Result result;
  result.name = name;
  result.report = Report();
  result.report->verdict = verdict;
  result.report->model = "mill";
  result.report->findings = std::move(findings);
  result.report->clearances.push_back({{"holder", "vise"}, proven, seen, "a.nc", 12});
  return result;
}

Result Failed(const std::string& name, const std::string& trouble) {
  Result result;
  result.name = name;
  result.trouble = trouble;
  return result;
}

class NightTest : public ::testing::Test {
 protected:
  NightTest() : folder_("night") {
    std::string reason;
    history_ = History::Open(folder_ / "h.sqlite", &reason);
  }

  Night Judged(const std::string& day, const std::vector<Result>& results) {
    Night night = JudgeNight(day, {}, results, baseline_, history_.get());
    EXPECT_TRUE(history_->Record(day, PastRows(night)));
    return night;
  }

  TestFolder folder_;
  std::unique_ptr<History> history_;
  Baseline baseline_;
};

TEST_F(NightTest, NothingIsNewInTheFirstNight) {
  const Night night =
      Judged("2026-01-01", {Checked("a.nc", "fail", {Finding("gouge", "error", 3, "G01 X5.")})});
  EXPECT_EQ(night.before, "");
  EXPECT_EQ(News(night.rows.at(0)), "");
  EXPECT_EQ(night.rows.at(0).verdict, "fail");
}

TEST_F(NightTest, WhatIsNewAndWhatIsFixed) {
  Judged("2026-01-01", {Checked("a.nc", "unproven",
                                {Finding("near-miss", "warning", 3, "G01 X5."),
                                 Finding("assumed", "unproven", 0, "")})});
  const Night night = Judged("2026-01-02", {Checked("a.nc", "fail",
                                                    {Finding("near-miss", "warning", 30, "G01 X5."),
                                                     Finding("near-miss", "warning", 31, "G01 X5."),
                                                     Finding("gouge", "error", 33, "G01 X6.")})});
  const Row& row = night.rows.at(0);
  EXPECT_FALSE(row.findings.at(0).is_new) << "it has only moved down";
  EXPECT_TRUE(row.findings.at(1).is_new) << "there was one before, now there are two";
  EXPECT_TRUE(row.findings.at(2).is_new);
  ASSERT_EQ(row.fixed.size(), 1U);
  EXPECT_EQ(row.fixed.at(0).rule, "assumed");
  EXPECT_EQ(News(row), "was unproven, 2 new, 1 fixed");
}

TEST_F(NightTest, ANightThatCrashedIsNothingToCompareWith) {
  const std::vector<ReportFinding> findings = {Finding("gouge", "error", 3, "G01 X5.")};
  Judged("2026-01-01", {Checked("a.nc", "fail", findings)});
  const Night second = Judged("2026-01-02", {Failed("a.nc", "crashed: signal 11")});
  EXPECT_EQ(second.rows.at(0).verdict, "error");
  EXPECT_EQ(News(second.rows.at(0)), "was fail");
  EXPECT_EQ(second.rows.at(0).exit_code(), 4);
  const Night third = Judged("2026-01-03", {Checked("a.nc", "fail", findings)});
  EXPECT_EQ(News(third.rows.at(0)), "");
}

TEST_F(NightTest, ProgramsComeAndGo) {
  Judged("2026-01-01", {Checked("a.nc", "pass", {}), Checked("b.nc", "pass", {})});
  const Night night =
      Judged("2026-01-02", {Checked("a.nc", "pass", {}), Checked("c.nc", "pass", {})});
  EXPECT_THAT(night.gone, ElementsAre("b.nc"));
  EXPECT_EQ(News(night.rows.at(0)), "");
  EXPECT_EQ(News(night.rows.at(1)), "new program");
}

// Never less than 3.1 before, 0.4 now: it has come closer, whatever the slack of both proofs.
TEST_F(NightTest, AClearanceThatFellIsSaid) {
  Judged("2026-01-01", {Checked("a.nc", "pass", {}, 3.1, 4.0)});
  const Night fell = Judged("2026-01-02", {Checked("a.nc", "pass", {}, 0.3, 0.4)});
  ASSERT_EQ(fell.rows.at(0).falls.size(), 1U);
  EXPECT_EQ(InALine(fell.rows.at(0).falls.at(0)),
            "holder and vise fell from 3.10 to 0.40 mm (a.nc:12)");
  EXPECT_EQ(News(fell.rows.at(0)), "1 closer");
}

TEST_F(NightTest, AProofThatIsLessTightIsNoFall) {
  Judged("2026-01-01", {Checked("a.nc", "pass", {}, 3.1, 4.0)});
  EXPECT_THAT(Judged("2026-01-02", {Checked("a.nc", "pass", {}, 2.0, 4.0)}).rows.at(0).falls,
              IsEmpty());
}

TEST_F(NightTest, TheBaselineAcceptsUntilItsDay) {
  baseline_.accepted = {{"a.nc", "gouge", "G01 X5.", "", "a chamfer", "2026-01-02"}};
  const std::vector<ReportFinding> findings = {Finding("gouge", "error", 3, "G01 X5."),
                                               Finding("assumed", "unproven", 0, "")};
  const Night night = Judged("2026-01-02", {Checked("a.nc", "fail", findings)});
  EXPECT_EQ(night.rows.at(0).verdict, "unproven");
  EXPECT_FALSE(night.rows.at(0).findings.at(0).counts());
  EXPECT_EQ(InALine(night.baseline.at(0)),
            "gouge of a.nc (G01 X5.) accepted until 2026-01-02: a chamfer; 1 found");
  const Night expired = Judged("2026-01-03", {Checked("a.nc", "fail", findings)});
  EXPECT_EQ(expired.rows.at(0).verdict, "fail");
  EXPECT_EQ(expired.baseline.at(0).fault, "expired, no longer counts");
}

TEST_F(NightTest, WhatTheBaselineNoLongerMatchesIsSaid) {
  baseline_.accepted = {{"a.nc", "gouge", "G01 X5.", "", "r", "2027-01-01"},
                        {"q.nc", "gouge", "G01 X5.", "", "r", "2027-01-01"},
                        {"b.nc", "gouge", "G01 X5.", "", "r", "2027-01-01"}};
  const Night night =
      Judged("2026-01-02", {Checked("a.nc", "pass", {}), Failed("b.nc", "crashed")});
  EXPECT_EQ(night.baseline.at(0).fault, "matches nothing any more: remove it");
  EXPECT_EQ(night.baseline.at(1).fault, "there is no such program");
  EXPECT_EQ(night.baseline.at(2).fault, "its program could not be checked");
}

TEST_F(NightTest, AVerdictThatItsFindingsDoNotExplainStays) {
  baseline_.accepted = {{"a.nc", "near-miss", "G01 X5.", "", "r", "2027-01-01"}};
  const Night night = Judged(
      "2026-01-02", {Checked("a.nc", "unproven", {Finding("near-miss", "warning", 3, "G01 X5.")})});
  EXPECT_EQ(night.rows.at(0).verdict, "unproven");
}

TEST_F(NightTest, EveryDocumentHasEveryRow) {
  baseline_.accepted = {{"a.nc", "gouge", "G01 X5.", "", "a <chamfer>", "2026-01-09"}};
  Judged("2026-01-01", {Checked("a.nc", "pass", {}), Checked("gone.nc", "pass", {})});
  const Night night =
      Judged("2026-01-02", {Checked("a.nc", "fail", {Finding("gouge", "error", 3, "G01 X5.")}),
                            Failed("b<b>.nc", "crashed: signal 11\nlast \x1b words")});
  for (const auto writer : {WriteTable, WriteNightJson, WriteNightPage}) {
    std::ostringstream text;
    writer(night, text);
    for (const char* part :
         {"a.nc", "gone.nc", "crashed: signal 11", "chamfer", "2026-01-02", "message of 3"}) {
      EXPECT_THAT(text.str(), HasSubstr(part));
    }
    EXPECT_THAT(text.str(), Not(HasSubstr("\x1b")));
  }
  std::ostringstream page, junit;
  WriteNightPage(night, page);
  EXPECT_THAT(page.str(), HasSubstr("b&lt;b&gt;.nc"));
  EXPECT_THAT(page.str(), Not(HasSubstr("http"))) << "it needs no network";
  WriteNightJunit(night, junit);
  EXPECT_THAT(junit.str(), HasSubstr("tests=\"2\" failures=\"0\" errors=\"1\""));
  EXPECT_THAT(junit.str(), HasSubstr("a &lt;chamfer&gt;; 1 found"));
}

}  // namespace
}  // namespace ncsim::nightly
