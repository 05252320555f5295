// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace ncsim::app {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ProgressLineTest, ShowsPercentBarRateAndTimes) {
  EXPECT_EQ(ProgressLine({"part.nc", 0.42, 414'000, 12.0, 12.0}, 79),
            "part.nc  42% [=============>                 ] 34.5 k blocks/s, 0:12, 0:16 left");
  EXPECT_EQ(ProgressLine({"part.nc", 0.99, 90'000'000, 7322.0, 7322.0}, 200),
            "part.nc  99% [=====================================>] 12.3 k blocks/s, 2:02:02, "
            "1:13 left");
  EXPECT_EQ(ProgressLine({"", 1.0, 3'000'000, 2.0, 2.0}, 60),
            "100% [=====================] 1.5 M blocks/s, 0:02, 0:00 left");
}

TEST(ProgressLineTest, WhatIsNotKnownYetIsNotShown) {
  EXPECT_EQ(ProgressLine({"a.nc", 0.3, 900, 0.6, 0.6}, 40),
            "a.nc  30% [======>                ] 0:00");
  EXPECT_EQ(ProgressLine({"a.nc", 0.0, 0, 0.0, 6.0}, 40),
            "a.nc   0% [>                      ] 0:06");
  EXPECT_THAT(ProgressLine({"a.nc", 0.01, 8000, 10.0, 10.0}, 60), EndsWith("] 800 blocks/s, 0:10"));
}

// The report of 10 s ago promised the end in 14 s: 4 are left. One that is late leaves none.
TEST(ProgressLineTest, TheTimeThatIsLeftRunsWithTheClock) {
  EXPECT_THAT(ProgressLine({"a.nc", 0.5, 700, 14.0, 24.0}, 70),
              EndsWith("] 50 blocks/s, 0:24, 0:04 left"));
  EXPECT_THAT(ProgressLine({"a.nc", 0.5, 700, 14.0, 44.0}, 70),
              EndsWith("] 50 blocks/s, 0:44, 0:00 left"));
}

// What is left out first is the label, then the bar, the rate, the times.
TEST(ProgressLineTest, FitsAnyWidth) {
  const ProgressView view{"Fr\xc3\xa4sen.nc", 0.42, 414'000, 12.0, 12.0};
  for (int width = -1; width < 130; ++width) {
    const std::string line = ProgressLine(view, width);
    const auto columns =
        std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    EXPECT_LE(columns, std::max(width, 0)) << line;
    if (width >= 3) {
      EXPECT_THAT(line, HasSubstr("42%")) << width;
    }
    if (width >= 21) {
      EXPECT_THAT(line, HasSubstr("0:12, 0:16 left")) << width;
    }
    if (width >= 38) {
      EXPECT_THAT(line, HasSubstr("34.5 k blocks/s,")) << width;
    }
    if (width >= 51) {
      EXPECT_THAT(line, HasSubstr("[")) << width;
    }
    if (width >= 61) {
      EXPECT_THAT(line, StartsWith("Fr\xc3\xa4sen.nc  42% [")) << width;
    }
  }
}

class ProgressTotalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "large.nc") << std::string(3000, 'X');
    std::ofstream(folder_ / "small.nc") << std::string(1000, 'X');
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string Path(const char* name) const { return (folder_ / name).string(); }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("ncsim_progress_") +
       ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(ProgressTotalTest, OneProgramNeverGoesBackNorToTheEnd) {
  ProgressTotal total({Path("large.nc")});
  total.Update(0, 0.5, 100, 1.0);
  EXPECT_EQ(total.View(1.0).done, 0.5);
  total.Update(0, 0.2, 150, 1.5);  // a loop
  EXPECT_EQ(total.View(2.0).done, 0.5);
  EXPECT_EQ(total.View(2.0).blocks, 150u);
  EXPECT_EQ(total.View(2.0).reached, 1.5);
  EXPECT_EQ(total.View(2.0).elapsed, 2.0);
  EXPECT_EQ(total.View(2.0).label, "large.nc");
  total.Update(0, 1.0, 160, 2.5);  // a subprogram behind the last line
  EXPECT_EQ(total.View(3.0).done, 0.99);
  total.Finish(0, 3.0);
  EXPECT_EQ(total.View(3.0).done, 1.0);
}

TEST_F(ProgressTotalTest, SeveralCountByTheirSize) {
  ProgressTotal total({Path("large.nc"), Path("small.nc")});
  total.Update(1, 0.5, 20, 1.0);
  EXPECT_EQ(total.View(0.0).done, 0.125);
  EXPECT_EQ(total.View(0.0).label, "0 of 2 programs");
  total.Finish(0, 3.0);
  total.Update(0, 0.1, 40, 3.0);  // late
  EXPECT_EQ(total.View(0.0).done, 0.875);
  EXPECT_EQ(total.View(0.0).blocks, 60u);
  EXPECT_EQ(total.View(0.0).label, "1 of 2 programs");
}

TEST_F(ProgressTotalTest, AProgramThatIsNotThereCountsLittle) {
  ProgressTotal total({Path("none.nc"), Path("small.nc")});
  total.Finish(0, 3.0);
  EXPECT_LT(total.View(0.0).done, 0.01);
}

TEST(ProgressBarTest, LeavesNothingBehind) {
  std::ostringstream out;
  {
    ProgressBar bar({"part.nc"}, &out);
    bar.ReportOf(0)(0.2, 20);
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    bar.Finish(0);
  }
  if (out.str().empty()) GTEST_SKIP() << "this machine was too busy to draw";
  EXPECT_THAT(out.str(), StartsWith("\rpart.nc  20% ["));
  EXPECT_THAT(out.str(), EndsWith("\r\033[K"));
}

TEST(ProgressBarTest, DrawsNothingWithoutATerminal) {
  ProgressBar bar({"part.nc"}, nullptr);
  EXPECT_FALSE(bar.ReportOf(0));
  bar.Finish(0);
}

}  // namespace
}  // namespace ncsim::app
