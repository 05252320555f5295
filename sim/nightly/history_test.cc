// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "sim/nightly/test_folder.h"

namespace ncsim::nightly {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

PastRow MakeRow(const std::string& name, double proven) {
  Report report;
  report.verdict = "pass";
  report.clearances.push_back({{"holder", "vise"}, proven, proven + 1.0, "a.nc", 3});
  return {name, "pass", "", report};
}

std::unique_ptr<History> OpenHistory(const std::string& path) {
  std::string reason;
  auto history = History::Open(path, &reason);
  EXPECT_NE(history, nullptr) << reason;
  return history;
}

std::string Day(int number) {
  std::string text = std::to_string(number);
  return "2026-01-" + std::string(2 - text.size(), '0') + text;
}

TEST(HistoryTest, ANightIsComparedWithTheLastOneBeforeIt) {
  const TestFolder folder("history");
  const auto history = OpenHistory(folder / "h.sqlite");
  EXPECT_EQ(history->NightBefore(Day(9)), "");
  ASSERT_TRUE(history->Record(Day(1), {MakeRow("a", 3.0), MakeRow("b", 5.0)}));
  ASSERT_TRUE(history->Record(Day(2), {MakeRow("a", 2.0), {"b", "error", "crashed", {}}}));
  ASSERT_TRUE(history->Record(Day(3), {MakeRow("a", 1.0)}));
  EXPECT_EQ(history->NightBefore(Day(3)), Day(2));
  EXPECT_EQ(history->NightBefore(Day(1)), "");
  EXPECT_THAT(history->NamesOf(Day(2)), ElementsAre("a", "b"));
  EXPECT_EQ(history->LastChecked("a", Day(3))->report->clearances.at(0).proven, 2.0);
  // A night in which it crashed is passed over.
  EXPECT_EQ(history->LastChecked("b", Day(3))->report->clearances.at(0).proven, 5.0);
  EXPECT_EQ(history->LastChecked("a", Day(1)), std::nullopt);
}

TEST(HistoryTest, TheSameNightAgainTakesThePlaceOfTheFirst) {
  const TestFolder folder("history_again");
  const auto history = OpenHistory(folder / "h.sqlite");
  ASSERT_TRUE(history->Record(Day(1), {MakeRow("a", 3.0), MakeRow("b", 5.0)}));
  ASSERT_TRUE(history->Record(Day(1), {MakeRow("b", 6.0)}));
  EXPECT_THAT(history->NamesOf(Day(1)), ElementsAre("b"));
  EXPECT_EQ(history->LastChecked("b", Day(2))->report->clearances.at(0).proven, 6.0);
}

TEST(HistoryTest, RemembersTheLastResult) {
  const TestFolder folder("history_known");
  Result result;
  result.name = "a";
  result.key = "k";
  result.report = MakeRow("a", 0.1 + 0.2).report;
  result.inputs = {{Input::Kind::kPlace, "a.nc", "file"}};
  ASSERT_TRUE(OpenHistory(folder / "h.sqlite")->Remember(result));
  const auto known = OpenHistory(folder / "h.sqlite")->Known("a");
  ASSERT_TRUE(known);
  EXPECT_EQ(known->inputs, result.inputs);
  EXPECT_EQ(known->report->clearances.at(0).proven, 0.1 + 0.2);
  EXPECT_EQ(OpenHistory(folder / "h.sqlite")->Known("b"), std::nullopt);
}

TEST(HistoryTest, OldNightsAreForgotten) {
  const TestFolder folder("history_old");
  const auto history = OpenHistory(folder / "h.sqlite");
  const int nights = History::kNightsKept + 3;
  // Sort as days do.
  const auto day = [](int n) { return "2026-" + std::to_string(100 + n); };
  for (int n = 0; n < nights; ++n) ASSERT_TRUE(history->Record(day(n), {MakeRow("a", n)})) << n;
  EXPECT_THAT(history->NamesOf(day(0)), IsEmpty());
  EXPECT_THAT(history->NamesOf(day(2)), IsEmpty());
  EXPECT_THAT(history->NamesOf(day(3)), ElementsAre("a"));
}

TEST(HistoryTest, WhatIsNoHistoryIsRefused) {
  const TestFolder folder("history_bad");
  std::string reason;
  EXPECT_EQ(History::Open(folder.Write("text", std::string(5000, 'x')), &reason), nullptr);
  EXPECT_EQ(reason, "file is not a database");
  EXPECT_EQ(History::Open(folder / "QQQ/h.sqlite", &reason), nullptr);
  EXPECT_EQ(reason, "unable to open database file");
}

/// Writes nights until it is killed, and says so on `pipe` each time.
[[noreturn]] void WriteUntilKilled(const std::string& path, int pipe) {
  std::string reason;
  const auto history = History::Open(path, &reason);
  for (int n = 0; history != nullptr; ++n) {
    std::vector<PastRow> rows;
    for (int i = 0; i < 50; ++i) rows.push_back(MakeRow("p" + std::to_string(i), n + i));
    if (!history->Record(Day(1 + n % 28), rows)) break;
    if (write(pipe, "x", 1) != 1) break;
  }
  _exit(1);
}

// kill -9 at any time: what is there is whole, and can be written on.
TEST(HistoryTest, SurvivesBeingKilledWhileItWrites) {
  const TestFolder folder("history_kill");
  const std::string path = folder / "h.sqlite";
  OpenHistory(path);
  for (int round = 0; round < 12; ++round) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) WriteUntilKilled(path, ends[1]);
    close(ends[1]);
    char byte = 0;
    ASSERT_EQ(read(ends[0], &byte, 1), 1);
    usleep(static_cast<useconds_t>(700 * round));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    close(ends[0]);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it was to be killed, not to end";
    const auto history = OpenHistory(path);
    int nights = 0;
    for (int n = 1; n <= 28; ++n) {
      const std::vector<std::string> names = history->NamesOf(Day(n));
      if (names.empty()) continue;
      ++nights;
      EXPECT_EQ(names.size(), 50U) << "half a night";
      EXPECT_NE(history->LastChecked("p49", Day(n) + "x"), std::nullopt);
    }
    EXPECT_GE(nights, 1);
    EXPECT_TRUE(history->Record("2025-12-31", {MakeRow("a", 1.0)})) << history->trouble();
  }
}

}  // namespace
}  // namespace ncsim::nightly
