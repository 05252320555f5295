// SPDX-License-Identifier: BSD-3-Clause
// Children that crash, hang and print rubbish: a shell script stands in for the checker.
#include "sim/nightly/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>

#include "sim/nightly/test_folder.h"

namespace ncsim::nightly {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Called as: check PROGRAM ... --out JSON --inputs INPUTS. Does what PROGRAM is called.
constexpr const char* kScript = R"sh(#!/bin/sh
echo "$2" >> ran
program=$2
while [ $# -gt 1 ]; do
  [ "$1" = --out ] && out=$2
  [ "$1" = --inputs ] && inputs=$2
  shift
done
report() {
  echo "{\"schema\":1,\"verdict\":\"$1\",\"program\":\"$2\",\"model\":\"m\",\"blocks\":7,\"motion_time_s\":1.5,
  \"findings\":[{\"rule\":\"gouge\",\"severity\":\"error\",\"file\":\"$2\",\"line\":2,\"column\":1,\"message\":\"deep\"}],
  \"clearances\":[],\"not_checked\":[]}" > "$out"
  echo "[[\"place\",\"marker\",\"nothing\"]]" > "$inputs"
}
case $program in
  pass*) report pass "$program" ;;
  fail*) report fail "$program"; exit 1 ;;
  liar*) report pass "$program"; exit 1 ;;
  other*) report pass pass.nc ;;
  half*) echo '{"schema":1,"verdict":"pass"' > "$out" ;;
  crash*) echo "about to crash" >&2; kill -SEGV $$ ;;
  hang*) sleep 1000 & echo $! > sleeper; wait ;;
  last*) echo $$ > sleeper; exec sleep 1000 ;;
  bad*) echo "bad.nc: error: no machine" >&2; exit 3 ;;
  silent*) ;;
  *) exit 4 ;;
esac
)sh";

class RunnerTest : public ::testing::Test {
 protected:
  RunnerTest() : folder_("runner") {
    options_.executable = folder_.Write("checker", kScript);
    fs::permissions(options_.executable, fs::perms::owner_all);
    options_.build = "build";
    options_.root = folder_.path();
    options_.scratch = folder_ / "scratch";
    fs::create_directory(options_.scratch);
  }

  static Entry MakeEntry(const std::string& name) {
    Entry entry;
    entry.name = entry.program = name;
    entry.timeout = 60.0;
    return entry;
  }

  std::vector<Result> Run(const std::vector<std::string>& names, double timeout = 60.0) {
    std::vector<Entry> entries;
    for (const std::string& name : names) {
      entries.push_back(MakeEntry(name));
      entries.back().timeout = timeout;
    }
    checked_ = 0;
    return RunChecks(
        entries, options_, [this](const Entry& entry) { return Known(entry); },
        [this](const Result&, bool checked) { checked_ += checked ? 1 : 0; });
  }
  std::optional<Result> Known(const Entry& entry) const {
    for (const Result& result : known_) {
      if (result.name == entry.name) return result;
    }
    return std::nullopt;
  }

  TestFolder folder_;
  RunOptions options_;
  std::vector<Result> known_;
  int checked_ = 0;
};

TEST_F(RunnerTest, OneThatCrashesHangsOrPrintsRubbishIsNothingToTheOthers) {
  folder_.Write("fail.nc", "O1\r\n  G01 X5. \r\n");
  for (const int jobs : {1, 3}) {
    options_.jobs = jobs;
    const std::vector<Result> results =
        Run({"bad.nc", "crash.nc", "fail.nc", "half.nc", "hang.nc", "liar.nc", "odd.nc", "other.nc",
             "pass.nc", "silent.nc"},
            1.0);
    ASSERT_EQ(results.size(), 10U);
    EXPECT_EQ(checked_, 10);
    EXPECT_TRUE(results[0].bad_input);
    EXPECT_EQ(results[0].trouble, "bad.nc: error: no machine");
    EXPECT_THAT(results[1].trouble, StartsWith("crashed: signal 11"));
    EXPECT_THAT(results[1].trouble, HasSubstr("\nabout to crash"));
    ASSERT_TRUE(results[2].report);
    EXPECT_EQ(results[2].report->verdict, "fail");
    EXPECT_EQ(results[2].report->findings.at(0).source, "G01 X5.");
    EXPECT_EQ(results[4].trouble, "took longer than 1 s and was stopped");
    EXPECT_EQ(results[6].trouble, "internal error (exit code 4)");
    for (const int rubbish : {3, 5, 7, 9}) {
      EXPECT_FALSE(results[static_cast<std::size_t>(rubbish)].report);
      EXPECT_THAT(results[static_cast<std::size_t>(rubbish)].trouble,
                  StartsWith("the report is not what a check writes"));
    }
    EXPECT_EQ(results[8].report->verdict, "pass");
    EXPECT_TRUE(fs::is_empty(options_.scratch));
  }
}

/// Whether the process runs whose number stands in `file`. One that is killed may lie unburied.
bool IsAlive(const std::string& file) {
  std::string pid, state;
  if (!(std::ifstream(file) >> pid)) return false;
  std::ifstream("/proc/" + pid + "/stat") >> state >> state >> state;
  return !state.empty() && state != "Z";
}

/// Within a minute.
bool ComesTrue(const std::function<bool()>& condition) {
  for (int i = 0; i < 6000 && !condition(); ++i) usleep(10'000);
  return condition();
}

TEST_F(RunnerTest, NothingOfOneThatHangsIsLeft) {
  Run({"hang.nc"}, 0.5);
  ASSERT_GT(fs::file_size(folder_ / "sleeper"), 0U);
  EXPECT_TRUE(ComesTrue([&] { return !IsAlive(folder_ / "sleeper"); }));
}

TEST_F(RunnerTest, ACheckDiesWithWhoRunsIt) {
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    fs::remove(folder_ / "sleeper");
    const pid_t night = fork();
    if (night == 0) {
      Run({"last.nc"}, 1000.0);
      _exit(0);
    }
    const bool runs = ComesTrue([&] { return IsAlive(folder_ / "sleeper"); });
    kill(night, signal);
    waitpid(night, nullptr, 0);
    EXPECT_TRUE(runs);
    EXPECT_TRUE(ComesTrue([&] { return !IsAlive(folder_ / "sleeper"); })) << signal;
  }
}

TEST_F(RunnerTest, OnlyWhatChangedIsCheckedAgain) {
  known_ = Run({"pass.nc", "fail.nc", "crash.nc"});
  EXPECT_EQ(checked_, 3);
  known_ = Run({"pass.nc", "fail.nc", "crash.nc"});
  EXPECT_EQ(checked_, 1) << "the crash";
  folder_.Write("marker", "");  // What was looked for and not there.
  known_ = Run({"pass.nc", "fail.nc"});
  EXPECT_EQ(checked_, 2);
}

TEST_F(RunnerTest, AnotherBuildOrOtherOptionsAreCheckedAgain) {
  known_ = Run({"pass.nc"});
  options_.build = "another";
  known_ = Run({"pass.nc"});
  EXPECT_EQ(checked_, 1);
  Run({"pass.nc"});
  EXPECT_EQ(checked_, 0);
  Entry entry = MakeEntry("pass.nc");
  const std::string key = KeyOf(entry, "b");
  entry.strict = true;
  EXPECT_NE(KeyOf(entry, "b"), key);
}

TEST_F(RunnerTest, WithoutAListOfInputsItIsCheckedAgain) {
  known_ = Run({"pass.nc"});
  ASSERT_EQ(known_.at(0).inputs.size(), 1U);
  known_.at(0).inputs.clear();
  Run({"pass.nc"});
  EXPECT_EQ(checked_, 1);
}

TEST_F(RunnerTest, WhatCannotBeStartedSaysSo) {
  options_.executable = folder_ / "QQQ";
  EXPECT_THAT(Run({"pass.nc"}).at(0).trouble, StartsWith("could not be started: No such file"));
}

TEST_F(RunnerTest, AFileIsWholeOrNotThere) {
  EXPECT_TRUE(WriteWhole(folder_ / "file", "text"));
  EXPECT_FALSE(WriteWhole(folder_ / "QQQ/file", "text"));
  EXPECT_TRUE(WriteWhole(folder_ / "file", "other"));
  std::string text;
  std::ifstream(folder_ / "file") >> text;
  EXPECT_EQ(text, "other");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 3)
      << "checker, scratch and the file";
}

TEST(ResultTest, ComesBackFromItsText) {
  Result result;
  result.name = "a";
  result.key = "k";
  result.report = Report();
  result.report->verdict = "unproven";
  result.report->time = 12.5;
  result.report->findings = {{"gouge", "error", "a.nc", "deep", 3, {"T1", "part"}, "G01"}};
  result.report->clearances = {{{"T1", "part"}, std::nullopt, 0.1, "a.nc", 3}};
  result.inputs = {{Input::Kind::kVariable, "V", "=x"}, {Input::Kind::kListing, "d", "nothing"}};
  const std::string text = WriteResult(result);
  const auto back = ReadResult(text);
  ASSERT_TRUE(back);
  EXPECT_EQ(WriteResult(*back), text);
  EXPECT_EQ(back->inputs, result.inputs);
  for (std::size_t length = 0; length + 2 < text.size(); ++length) {
    EXPECT_FALSE(ReadResult(text.substr(0, length))) << length;
  }
}

TEST(ResultTest, AReportIsReadStrictly) {
  const std::string good =
      R"({"schema":1,"verdict":"pass","program":"a","model":"m","blocks":1,"motion_time_s":null,)"
      R"("findings":[],"clearances":[],"not_checked":[]})";
  EXPECT_TRUE(ReadReport(good));
  for (const char* part : {"\"schema\":1,", "\"findings\":[],", "\"verdict\":\"pass\","}) {
    std::string lacking = good;
    EXPECT_FALSE(ReadReport(lacking.replace(lacking.find(part), std::string(part).size(), "")));
  }
  std::string odd = good;
  EXPECT_FALSE(ReadReport(odd.replace(odd.find("pass"), 4, "good")));
  EXPECT_FALSE(ReadReport("[" + good + "]"));
}

}  // namespace
}  // namespace ncsim::nightly
