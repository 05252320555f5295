// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/assumptions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/app/finding_log.h"

namespace ncsim::app {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<Assumption> Two() {
  return {{"offset G54", "the centre of the table", true, false}, {"start", "home", false, false}};
}

TEST(AssumptionsTest, AcceptedByNameInAnyCase) {
  std::vector<Assumption> assumptions = Two();
  EXPECT_THAT(Accept({"Offset g54"}, &assumptions), IsEmpty());
  EXPECT_TRUE(assumptions[0].accepted);
  EXPECT_FALSE(assumptions[1].accepted);
  EXPECT_EQ(Judge({}, assumptions, false), Verdict::kPass);
  EXPECT_EQ(Judge({}, assumptions, true), Verdict::kUnproven);
}

TEST(AssumptionsTest, AllAcceptsAllAndUnknownNamesComeBack) {
  std::vector<Assumption> assumptions = Two();
  EXPECT_THAT(Accept({"all", "offset G55"}, &assumptions), ElementsAre("offset G55"));
  EXPECT_TRUE(assumptions[0].accepted && assumptions[1].accepted);
}

TEST(AssumptionsTest, OpenOnesAreFindings) {
  std::vector<Assumption> assumptions = Two();
  const auto findings = OpenAssumptions(assumptions, false);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].rule, Rule::kAssumed);
  EXPECT_EQ(
      findings[0].message,
      "offset G54 is assumed: the centre of the table; state it in the job, or accept it with "
      "--assume \"offset G54\"");
  EXPECT_THAT(OpenAssumptions(assumptions, true), SizeIs(2));
  Accept({"all"}, &assumptions);
  EXPECT_THAT(OpenAssumptions(assumptions, true), IsEmpty());
}

TEST(AssumptionsTest, TheGraverOfTwoStays) {
  std::vector<Assumption> assumptions = Two();
  Assume({"start", "near a contact", true, false}, &assumptions);
  Assume({"offset G54", "harmless", false, false}, &assumptions);
  ASSERT_THAT(assumptions, SizeIs(2));
  EXPECT_EQ(assumptions[0].text, "the centre of the table");
  EXPECT_EQ(assumptions[1].text, "near a contact");
}

TEST(FindingLogTest, KeepsABoundedNumberOfEachRule) {
  FindingLog log;
  for (int i = 0; i < FindingLog::kMaxKept + 5; ++i) {
    log.Add(MakeFinding(Rule::kNumberScale, {0, i + 1, 1}, "scaled"));
  }
  log.Add(MakeFinding(Rule::kCollision, {0, 7, 1}, "hit"));
  EXPECT_TRUE(log.Has(Severity::kError));
  EXPECT_FALSE(log.HasOtherThan(Rule::kCollision, Severity::kError));
  const std::vector<Finding> findings = log.Take();
  ASSERT_THAT(findings, SizeIs(FindingLog::kMaxKept + 2));
  EXPECT_EQ(findings.back().message, "5 more of these are not listed");
  EXPECT_EQ(findings.back().severity, Severity::kWarning);
}

}  // namespace
}  // namespace ncsim::app
