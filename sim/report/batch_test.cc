// SPDX-License-Identifier: BSD-3-Clause
// SARIF, JUnit and workflow commands: their bytes and their limits. tests/report holds real ones
// against the schemas.
#include "sim/report/batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace ncsim::report {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Programs with findings, and one that could not be read.
class Batch {
 public:
  Batch& Add(const std::string& name, std::vector<Finding> findings,
             const std::string& line = "N10 G01 X1.") {
    files_.emplace_back().Add(name);
    CheckResult& result = results_.emplace_back();
    result.program = name;
    result.model = "Haas UMC-750";
    result.verdict = Judge(findings, {}, false);
    result.findings = std::move(findings);
    programs_.push_back(
        {name, &result, &files_.back(),
         [text = lines_.emplace_back(line)](int, int) -> std::string_view { return text; }, ""});
    return *this;
  }
  Batch& AddUnread(const std::string& name, const std::string& messages) {
    programs_.push_back({name, nullptr, nullptr, {}, messages});
    return *this;
  }
  std::string Sarif() const {
    return Write([](auto& p, auto& o) { WriteSarif(p, "1.2.3", o); });
  }
  json SarifRun() const { return json::parse(Sarif())["runs"][0]; }
  std::string Junit() const {
    return Write([](auto& p, auto& o) { WriteJunit(p, o); });
  }
  std::string Github() const {
    return Write([](auto& p, auto& o) { WriteGithub(p, o); });
  }

 private:
  template <typename Writer>
  std::string Write(const Writer& writer) const {
    std::ostringstream out;
    writer(programs_, out);
    return out.str();
  }
  std::deque<SourceFiles> files_;
  std::deque<CheckResult> results_;
  std::deque<std::string> lines_;
  std::vector<ProgramReport> programs_;
};

Finding Hit(int line) {
  Finding finding = MakeFinding(Rule::kCollision, {0, line, 5}, "holder of T1 hits jaw");
  finding.bodies = {"T1.holder", "jaw"};
  finding.clearance_mm = -1.999999;
  return finding;
}
Finding Near(int line) { return MakeFinding(Rule::kNearMiss, {0, line, 1}, "T1 comes near jaw"); }
Finding Assumed() { return MakeFinding(Rule::kAssumed, {}, "offset G54 is assumed"); }

TEST(SarifTest, ResultsWithPlaceLevelAndDetails) {
  const json run = Batch()
                       .Add("parts/a b.nc", {Hit(12), Near(13)})
                       .Add("b.nc", {Assumed()})
                       .AddUnread("c.nc", "c.nc: error: cannot be read\n")
                       .SarifRun();
  EXPECT_EQ(run["tool"]["driver"]["semanticVersion"], "1.2.3");
  EXPECT_EQ(run["tool"]["driver"]["rules"].size(), Rules().size() + 1);
  EXPECT_EQ(run["invocations"][0]["executionSuccessful"], false);
  const json& results = run["results"];
  ASSERT_EQ(results.size(), 4u);
  EXPECT_EQ(results[0]["ruleId"], "collision");
  EXPECT_EQ(results[0]["level"], "error");
  const json& place = results[0]["locations"][0]["physicalLocation"];
  EXPECT_EQ(place["artifactLocation"]["uri"], "parts/a%20b.nc");  // RFC 3986
  EXPECT_EQ(place["region"], json({{"startLine", 12}, {"startColumn", 5}}));
  EXPECT_EQ(results[0]["properties"]["clearance_mm"], -2.0);
  EXPECT_EQ(results[1]["level"], "warning");
  // What is unproven must not pass a gate on errors; nor what could not be read at all.
  EXPECT_EQ(results[2]["level"], "error");
  EXPECT_EQ(results[2]["properties"]["severity"], "unproven");
  EXPECT_FALSE(results[2]["locations"][0]["physicalLocation"].contains("region"));
  EXPECT_EQ(results[3]["ruleId"], "not-checked");
  EXPECT_EQ(results[3]["message"]["text"], "c.nc: error: cannot be read");
}

// Lines above a finding come and go; the finding stays the same one until its own line changes.
TEST(SarifTest, FingerprintsAreOfTheTextAndNotOfItsNumber) {
  const auto print = [](const Batch& batch, std::size_t i) {
    return batch.SarifRun()["results"][i]["partialFingerprints"]["ncsimFinding/v1"]
        .get<std::string>();
  };
  const std::string first = print(Batch().Add("a.nc", {Hit(12)}), 0);
  EXPECT_EQ(print(Batch().Add("a.nc", {Hit(40)}, "  N10 G01 X1.\r"), 0), first);
  EXPECT_NE(print(Batch().Add("a.nc", {Hit(12)}, "N10 G01 X2."), 0), first);
  EXPECT_NE(print(Batch().Add("b.nc", {Hit(12)}), 0), first);
  const Batch twice = std::move(Batch().Add("a.nc", {Hit(12), Hit(40)}));
  EXPECT_EQ(print(twice, 0), first);
  EXPECT_NE(print(twice, 1), first);
}

TEST(SarifTest, ColumnsCountUtf16CodeUnits) {
  // Before the fifth byte: a letter of two bytes, and two of one.
  const json run = Batch()
                       .Add("a.nc", {Hit(12)},
                            "\xC3\xA4"
                            "bcdef")
                       .SarifRun();
  EXPECT_EQ(run["results"][0]["locations"][0]["physicalLocation"]["region"]["startColumn"], 4);
}

TEST(SarifTest, AHundredThousandFindingsStayWithinTheLimitsAndLoseNoRule) {
  Batch batch;
  std::set<std::string> rules;
  for (int program = 0; program < 10; ++program) {
    std::vector<Finding> findings;
    for (const RuleInfo& info : Rules()) {
      const int count = info.rule == Rule::kCollision ? 9'800 : program;
      for (int i = 0; i < count; ++i) {
        findings.push_back(MakeFinding(info.rule, {0, i + 1, 1}, "of " + std::string(info.id)));
      }
      rules.insert(std::string(info.id));
    }
    batch.Add("p" + std::to_string(program) + ".nc", std::move(findings));
  }
  const std::string text = batch.Sarif();
  EXPECT_LT(text.size(), 10'000'000u);  // Packed, it may have 10 MB.
  const json run = json::parse(text)["runs"][0];
  EXPECT_LE(run["results"].size(), kMaxSarifResults);
  EXPECT_GT(run["results"].size(), kMaxSarifResults * 9 / 10);
  std::map<std::string, std::size_t> found;
  std::size_t named = 0;  // Findings that a last result counts.
  for (const json& result : run["results"]) {
    ++found[result["ruleId"].get<std::string>()];
    const std::string message = result["message"]["text"];
    if (message.find(" more finding") == std::string::npos) continue;
    named += std::stoul(message);
    --found[result["ruleId"].get<std::string>()];
  }
  EXPECT_EQ(found.size(), rules.size());
  EXPECT_EQ(found["gouge"], 45u);  // 0 + 1 + ... + 9: those of few findings keep all.
  EXPECT_EQ(found["collision"] + named, 98'000u);
}

// More programs and rules than a run may have results: each rule is still there.
TEST(SarifTest, ManyProgramsShareTheLimit) {
  Batch batch;
  for (int i = 0; i < 4'000; ++i) {
    batch.Add("p" + std::to_string(i) + ".nc", {Hit(1), Near(2)});
  }
  const json run = batch.SarifRun();
  EXPECT_LE(run["results"].size(), kMaxSarifResults);
  std::map<std::string, std::size_t> found;
  for (const json& result : run["results"]) ++found[result["ruleId"].get<std::string>()];
  EXPECT_GT(found["collision"], 2'000u);
  EXPECT_GT(found["near-miss"], 2'000u);
}

TEST(JunitTest, ATestCaseAProgram) {
  const std::string text = Batch()
                               .Add("a.nc", {Hit(12), Near(13)})
                               .Add("b.nc", {Near(2)})
                               .Add("c.nc", {Assumed()})
                               .AddUnread("d.nc", "d.nc: error: cannot be read\n")
                               .Junit();
  EXPECT_THAT(text,
              StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                         "<testsuites name=\"ncsim\" tests=\"4\" failures=\"1\" errors=\"2\">"));
  EXPECT_THAT(text,
              HasSubstr("<testcase classname=\"Haas UMC-750\" name=\"a.nc\">\n"
                        "   <failure type=\"collision\" message=\"a.nc:12:5: holder of T1 hits "
                        "jaw\">a.nc:12:5: holder of T1 hits jaw\n</failure>\n   <system-out>"));
  EXPECT_THAT(text, HasSubstr("name=\"b.nc\">\n   <system-out>pass"));
  EXPECT_THAT(text, HasSubstr("<error type=\"assumed\" message=\"c.nc: offset G54 is assumed\">"));
  EXPECT_THAT(text, HasSubstr("<error type=\"not-checked\" message=\"the program could not be "
                              "checked\">d.nc: error: cannot be read\n</error>"));
}

// Jenkins' schema has errors before failures, whatever the rules' order.
TEST(JunitTest, ErrorsStandBeforeFailures) {
  const std::string text =
      Batch().Add("a.nc", {MakeFinding(Rule::kUncertified, {0, 1, 1}, "u"), Hit(2)}).Junit();
  EXPECT_LT(text.find("<error type=\"uncertified\""), text.find("<failure type=\"collision\""));
  EXPECT_THAT(text, HasSubstr("failures=\"1\" errors=\"0\">\n  <testcase"));
}

TEST(JunitTest, HostileTextIsText) {
  Finding finding = Hit(1);
  finding.message = "\"<&>]]>\x1B[2J\xEF\xBF\xBF\xFF";
  const std::string text = Batch().Add("a<b>.nc", {finding}).Junit();
  EXPECT_THAT(text, HasSubstr("name=\"a&lt;b&gt;.nc\""));
  EXPECT_THAT(text, HasSubstr("&quot;&lt;&amp;&gt;]]&gt;?[2J????"));
  for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << int(c);
}

TEST(GithubTest, EachRulesFirstFindingComesBeforeAnySecond) {
  std::vector<Finding> findings;
  for (int i = 1; i <= 30; ++i) findings.push_back(Hit(i));
  findings.push_back(MakeFinding(Rule::kGouge, {0, 31, 2}, "100% wrong,\nat a: b"));
  const std::string text =
      Batch().Add("a.nc", findings).Add("b,c.nc", {Assumed(), Near(3)}).Github();
  EXPECT_THAT(text, StartsWith("::error file=a.nc,line=1,col=5,title=collision::holder of T1"));
  EXPECT_THAT(text, HasSubstr("\n::error file=a.nc,line=31,col=2,title=gouge::100%25 wrong,?at a: "
                              "b\n::error file=b%2Cc.nc,title=assumed::offset"));
  EXPECT_THAT(text, HasSubstr("::error file=a.nc,line=8,"));
  EXPECT_THAT(text, Not(HasSubstr("::error file=a.nc,line=9,")));
  EXPECT_THAT(text, HasSubstr("\n22 more errors are not shown here\n"));
  EXPECT_THAT(text, HasSubstr("\n::warning file=b%2Cc.nc,line=3,col=1,title=near-miss::"));
  EXPECT_THAT(text, HasSubstr("\na.nc: fail: 31 errors"));
  EXPECT_THAT(text, HasSubstr("\nb,c.nc: unproven: "));
}

TEST(GithubTest, WhatCouldNotBeReadIsAnError) {
  EXPECT_EQ(
      Batch().AddUnread("d.nc", "d.nc: error: cannot be read\nmore\n").Github(),
      "::error file=d.nc,title=not-checked::d.nc: error: cannot be read\nd.nc: not checked\n");
}

}  // namespace
}  // namespace ncsim::report
