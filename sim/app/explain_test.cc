// SPDX-License-Identifier: BSD-3-Clause
// docs/findings.md against the list of rules: neither may have what the other lacks.
#include "sim/app/explain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "sim/app/app.h"
#include "sim/base/finding.h"

namespace ncsim::app {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> RuleIds() {
  std::vector<std::string> ids;
  for (const RuleInfo& info : Rules()) ids.emplace_back(info.id);
  return ids;
}

class EntryTest : public ::testing::TestWithParam<std::string> {};

TEST_P(EntryTest, SaysSeverityDefinitionAndExample) {
  const std::string id = GetParam();
  const std::string entry(FindingsEntry(id));
  ASSERT_FALSE(entry.empty()) << "docs/findings.md has no entry for " << id;
  EXPECT_THAT(entry, StartsWith("## " + id + "\n"));
  std::string severity(ToString(Info(*RuleFromId(id)).severity));
  const std::size_t example = entry.find("\n```\n");
  ASSERT_NE(example, std::string::npos);
  EXPECT_THAT(entry.substr(example), HasSubstr(": " + severity + ": "));
  EXPECT_THAT(entry.substr(example), HasSubstr("[" + id + "]"));
  severity[0] = static_cast<char>(severity[0] - 'a' + 'A');
  EXPECT_THAT(entry, HasSubstr("**" + severity));
  EXPECT_THAT(entry, HasSubstr("\nExact: "));
}

INSTANTIATE_TEST_SUITE_P(EveryRule, EntryTest, ::testing::ValuesIn(RuleIds()));

TEST(ExplainTest, EveryHeadingIsARule) {
  std::istringstream text{std::string(FindingsText())};
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("## ", 0) != 0) continue;
    EXPECT_TRUE(RuleFromId(line.substr(3)).has_value()) << line;
  }
}

TEST(ExplainTest, PrintsAnEntryOrAll) {
  std::ostringstream out, err;
  EXPECT_EQ(app::Run({"explain", "rotary-wrap"}, out, err), kExitPass);
  EXPECT_THAT(out.str(), StartsWith("## rotary-wrap\n"));
  EXPECT_THAT(out.str(), ::testing::Not(HasSubstr("## collision")));
  std::ostringstream all;
  EXPECT_EQ(app::Run({"explain"}, all, err), kExitPass);
  EXPECT_THAT(all.str(), HasSubstr("travel-limit (error): "));
  EXPECT_EQ(err.str(), "");
}

TEST(ExplainTest, UnknownRuleIsBadUsageWithASuggestion) {
  std::ostringstream out, err;
  EXPECT_EQ(app::Run({"explain", "rotary-warp"}, out, err), kExitBadInput);
  EXPECT_EQ(err.str(),
            "ncsim: there is no rule 'rotary-warp' (did you mean 'rotary-wrap'?); ncsim explain "
            "lists them\n");
}

}  // namespace
}  // namespace ncsim::app
