// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/finding.h"

#include <gtest/gtest.h>

#include <set>

namespace ncsim {
namespace {

TEST(RulesTest, EnumeratorsAndListAgree) {
  std::set<std::string_view> ids;
  for (std::size_t i = 0; i < Rules().size(); ++i) {
    const RuleInfo& info = Rules()[i];
    EXPECT_EQ(static_cast<std::size_t>(info.rule), i);
    EXPECT_EQ(RuleFromId(info.id), info.rule);
    EXPECT_EQ(&Info(info.rule), &info);
    EXPECT_TRUE(ids.insert(info.id).second) << info.id;
  }
  EXPECT_EQ(RuleFromId("travel-limits"), std::nullopt);
}

TEST(RulesTest, AFindingStartsWithTheSeverityOfItsRule) {
  EXPECT_EQ(MakeFinding(Rule::kGouge, {}, "").severity, Severity::kError);
  EXPECT_EQ(MakeFinding(Rule::kUncertified, {}, "").severity, Severity::kUnproven);
  EXPECT_EQ(MakeFinding(Rule::kNearMiss, {}, "").severity, Severity::kWarning);
}

// The contract: any error makes `fail`; else any unproven makes `unproven`; else `pass`.
TEST(JudgeTest, WorstSeverityDecides) {
  const Finding error = MakeFinding(Rule::kCollision, {}, "");
  const Finding unproven = MakeFinding(Rule::kUnsupportedCode, {}, "");
  const Finding warning = MakeFinding(Rule::kClamp, {}, "");
  EXPECT_EQ(Judge({}, {}, false), Verdict::kPass);
  EXPECT_EQ(Judge({warning}, {}, true), Verdict::kPass);
  EXPECT_EQ(Judge({warning, unproven}, {}, false), Verdict::kUnproven);
  EXPECT_EQ(Judge({unproven, error}, {}, false), Verdict::kFail);
}

TEST(JudgeTest, AssumptionsThatPlaceMetalCountUntilAccepted) {
  Assumption offset{"offset G54", "at machine zero", true, false};
  Assumption block_skip{"block skip", "off", false, false};
  EXPECT_EQ(Judge({}, {offset}, false), Verdict::kUnproven);
  EXPECT_EQ(Judge({}, {block_skip}, false), Verdict::kPass);
  EXPECT_EQ(Judge({}, {block_skip}, true), Verdict::kUnproven);
  offset.accepted = block_skip.accepted = true;
  EXPECT_EQ(Judge({}, {offset, block_skip}, true), Verdict::kPass);
}

TEST(SourceFilesTest, IndicesStayAsFilesAreAdded) {
  SourceFiles files;
  EXPECT_EQ(files.Add("part.nc"), 0);
  EXPECT_EQ(files.Add("O9000.nc"), 1);
  EXPECT_EQ(files.name(0), "part.nc");
}

}  // namespace
}  // namespace ncsim
