// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/post_candidates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace ncsim::app {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Choice = std::map<int, std::size_t>;

/// A post whose operations 1 and 2 (10 lines each) have three ways each, and a check that fails
/// those of `bad` (operation, way) with `rule`.
class Bench {
 public:
  std::set<std::pair<int, std::size_t>> bad;
  Rule rule = Rule::kCollision;
  std::vector<Choice> judged;

  std::optional<Judged> Judge(const Choice& choice) {
    judged.push_back(choice);
    Judged result;
    result.program.files = {{"", ""}};
    result.outcome.files.Add("part.nc");
    result.outcome.result.emplace();
    for (const int operation : {1, 2}) {
      post::PostedOperation posted;
      posted.operation = operation;
      posted.line = operation * 10;
      posted.ways = 3;
      const auto found = choice.find(operation);
      posted.taken = found == choice.end() ? 0 : found->second;
      result.program.operations.push_back(posted);
      if (bad.count({operation, posted.taken}) == 0) continue;
      Finding finding;
      finding.rule = rule;
      finding.where.line = operation * 10 + 5;
      finding.message = "T1 hits the vise";
      result.outcome.result->findings.push_back(finding);
    }
    return result;
  }
  std::optional<Judged> Find(int limit = 40) {
    return FindPassing([this](const Choice& choice) { return Judge(choice); }, limit, &notes);
  }
  std::vector<std::string> notes;
};

std::vector<std::size_t> Taken(const Judged& judged) {
  std::vector<std::size_t> taken;
  for (const auto& operation : judged.program.operations) taken.push_back(operation.taken);
  return taken;
}

TEST(FindPassing, TheBestWaysWhereTheyPass) {
  Bench bench;
  EXPECT_THAT(Taken(*bench.Find()), ElementsAre(0, 0));
  EXPECT_EQ(bench.judged.size(), 1u);
  EXPECT_THAT(bench.notes, IsEmpty());
}

TEST(FindPassing, TheNextWayOfWhatFails) {
  Bench bench;
  bench.bad = {{2, 0}, {2, 1}};
  const auto found = bench.Find();
  EXPECT_THAT(Taken(*found), ElementsAre(0, 2));
  EXPECT_THAT(found->outcome.result->findings, IsEmpty());
  EXPECT_THAT(bench.judged, ElementsAre(Choice{}, Choice{{2, 1}}, Choice{{2, 2}}));
  EXPECT_THAT(bench.notes, ElementsAre("operation 2: way 1 of 3 fails: T1 hits the vise",
                                       "operation 2: way 2 of 3 fails: T1 hits the vise"));
}

TEST(FindPassing, TheFirstOperationThatFailsFirst) {
  Bench bench;
  bench.bad = {{1, 0}, {2, 0}};
  EXPECT_THAT(Taken(*bench.Find()), ElementsAre(1, 1));
  EXPECT_THAT(bench.judged, ElementsAre(Choice{}, Choice{{1, 1}}, Choice{{1, 1}, {2, 1}}));
}

TEST(FindPassing, WhereNoneOfThemPassesTheBestOneIsBackAndTheOthersGoOn) {
  Bench bench;
  bench.bad = {{1, 0}, {1, 1}, {1, 2}, {2, 0}};
  const auto found = bench.Find();
  EXPECT_THAT(Taken(*found), ElementsAre(0, 1));
  EXPECT_EQ(found->outcome.result->findings.size(), 1u);
  EXPECT_EQ(bench.notes[2],
            "operation 1: way 3 of 3 fails: T1 hits the vise; no way passes, the first one is "
            "taken");
}

TEST(FindPassing, WhatNoOtherWayCanMendIsLeft) {
  Bench bench;
  bench.bad = {{1, 0}};
  bench.rule = Rule::kToolMissing;
  const auto found = bench.Find();
  EXPECT_EQ(bench.judged.size(), 1u);
  EXPECT_EQ(found->outcome.result->findings.size(), 1u);
}

TEST(FindPassing, NoMoreThanTheLimit) {
  Bench bench;
  bench.bad = {{1, 0}, {1, 1}, {2, 0}, {2, 1}};
  bench.Find(3);
  EXPECT_EQ(bench.judged.size(), 3u);
}

TEST(FindPassing, AWayThatCannotBePostedIsGivenUp) {
  Bench bench;
  bench.bad = {{1, 0}, {2, 0}};
  std::vector<std::string> notes;
  const auto found = FindPassing(
      [&](const Choice& choice) -> std::optional<Judged> {
        if (choice.count(1) > 0) return std::nullopt;
        return bench.Judge(choice);
      },
      40, &notes);
  ASSERT_TRUE(found);
  EXPECT_THAT(Taken(*found), ElementsAre(0, 1));
  EXPECT_EQ(found->outcome.result->findings.size(), 1u);  // That of operation 1 is still told.
  EXPECT_EQ(notes[1], "operation 1: way 2 cannot be posted; the first one is taken");
}

TEST(FindPassing, WhatCannotBePosted) {
  std::vector<std::string> notes;
  EXPECT_FALSE(FindPassing([](const Choice&) { return std::nullopt; }, 40, &notes));
}

}  // namespace
}  // namespace ncsim::app
