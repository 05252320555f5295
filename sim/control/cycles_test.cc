// SPDX-License-Identifier: BSD-3-Clause
// Sequences: Haas NGC Mill Operator's Manual 2017, figures F7.21 to F7.34 and the text of each
// cycle.
#include "sim/control/cycles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/control/command_test_util.h"

namespace ncsim::control {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr CycleSettings kSettings{1.0, 0.0, 0};  // Setting 22 = 1 mm.

struct Made {
  std::vector<Command> commands;
  std::optional<AxisValues> end;
  std::string error;
};

// From X0 Y0 Z20 to a hole at X5 Y6.
Made Drill(const CycleWords& words, const CycleSettings& settings = kSettings,
           Plane plane = Plane::kXY, AxisValues hole = At(5, 6, 0)) {
  Made run;
  Command prototype;
  prototype.plane = plane;
  prototype.feed = 10.0;
  prototype.spindle_on = true;
  run.end = ExpandCycle(
      words, settings, prototype, At(0, 0, 20), hole, 20.0,
      [&](const Command& c) { run.commands.push_back(c); }, &run.error);
  return run;
}

CycleWords Words(int code, double r, double z) {
  CycleWords words;
  words.code = code;
  words.r = r;
  words.z = z;
  return words;
}

TEST(CyclesTest, G81ReturnsToTheInitialLevelOrToR) {
  CycleWords words = Words(81, 2, -10);
  EXPECT_THAT(ToText(Drill(words).commands), ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2",
                                                         "feed X5 Y6 Z-10 F10", "rapid X5 Y6 Z20"));
  words.return_to_initial = false;
  const Made run = Drill(words);
  EXPECT_THAT(ToText(run.commands), ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2",
                                                "feed X5 Y6 Z-10 F10", "rapid X5 Y6 Z2"));
  ASSERT_TRUE(run.end);
  EXPECT_EQ(*run.end, At(5, 6, 2));
}

TEST(CyclesTest, OtherPlanesDrillAlongTheirNormal) {
  EXPECT_THAT(ToText(Drill(Words(81, -2, -10), kSettings, Plane::kZX, At(5, 0, 30)).commands),
              ElementsAre("rapid X5 Y0 Z30", "rapid X5 Y-2 Z30", "feed X5 Y-10 Z30 F10",
                          "rapid X5 Y20 Z30"));
  EXPECT_THAT(ToText(Drill(Words(81, -2, -10), kSettings, Plane::kYZ, At(0, 6, 30)).commands),
              ElementsAre("rapid X0 Y6 Z30", "rapid X-2 Y6 Z30", "feed X-10 Y6 Z30 F10",
                          "rapid X20 Y6 Z30"));
}

TEST(CyclesTest, G82AndG89Dwell) {
  CycleWords words = Words(82, 2, -10);
  words.dwell = 0.3;
  EXPECT_THAT(ToText(Drill(words).commands),
              ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10", "dwell 0.3",
                          "rapid X5 Y6 Z20"));
  words.code = 89;
  EXPECT_THAT(ToText(Drill(words).commands),
              ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10", "dwell 0.3",
                          "feed X5 Y6 Z2 F10", "rapid X5 Y6 Z20"));
}

TEST(CyclesTest, G73RetractsBySetting22) {
  CycleWords words = Words(73, 2, -5);
  words.q = 3;
  EXPECT_THAT(ToText(Drill(words).commands),
              ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2", "feed X5 Y6 Z-1 F10",
                          "rapid X5 Y6 Z0", "feed X5 Y6 Z-4 F10", "rapid X5 Y6 Z-3",
                          "feed X5 Y6 Z-5 F10", "rapid X5 Y6 Z20"));
}

TEST(CyclesTest, G73WithKAndQClearsToRWhenThePecksComeToK) {
  CycleWords words = Words(73, 0, -10);
  words.q = 2;
  words.k = 4;
  EXPECT_THAT(
      ToText(Drill(words).commands),
      ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z0", "feed X5 Y6 Z-2 F10", "rapid X5 Y6 Z-1",
                  "feed X5 Y6 Z-4 F10", "rapid X5 Y6 Z0", "rapid X5 Y6 Z-3", "feed X5 Y6 Z-6 F10",
                  "rapid X5 Y6 Z-5", "feed X5 Y6 Z-8 F10", "rapid X5 Y6 Z0", "rapid X5 Y6 Z-7",
                  "feed X5 Y6 Z-10 F10", "rapid X5 Y6 Z20"));
}

TEST(CyclesTest, G83ReturnsToRPlusSetting52) {
  CycleWords words = Words(83, 2, -5);
  words.q = 4;
  words.dwell = 1.5;
  words.return_to_initial = false;
  CycleSettings settings = kSettings;
  settings.setting52 = 0.5;
  EXPECT_THAT(
      ToText(Drill(words, settings).commands),
      ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2", "feed X5 Y6 Z-2 F10", "rapid X5 Y6 Z2.5",
                  "rapid X5 Y6 Z-1", "feed X5 Y6 Z-5 F10", "dwell 1.5", "rapid X5 Y6 Z2"));
}

TEST(CyclesTest, PecksFallFromIByJToK) {
  CycleWords words = Words(83, 0, -10);
  words.i = 4;
  words.j = 1.5;
  words.k = 2;
  std::vector<double> depths;
  for (const Command& c : Drill(words).commands) {
    if (c.kind == CommandKind::kFeed) depths.push_back(c.end[kZ]);
  }
  EXPECT_THAT(depths, ElementsAre(-4, -6.5, -8.5, -10));  // 4, 2.5, 2 (not 1), the rest.
}

TEST(CyclesTest, TapsFeedOutAtJTimesTheFeed) {
  for (const int code : {74, 84}) {
    CycleWords words = Words(code, 2, -10);
    words.retract_feed_factor = 2.0;
    const Made run = Drill(words);
    EXPECT_THAT(ToText(run.commands),
                ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10",
                            "feed X5 Y6 Z2 F20", "rapid X5 Y6 Z20"));
    EXPECT_TRUE(run.commands[2].spindle_on && run.commands[3].spindle_on);
  }
}

TEST(CyclesTest, G76ShiftsBySetting27AndLeavesStopped) {
  CycleWords words = Words(76, 2, -10);
  words.q = 0.5;
  CycleSettings settings = kSettings;
  settings.setting27 = 3;  // Y-.
  const Made run = Drill(words, settings);
  EXPECT_THAT(ToText(run.commands),
              ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10",
                          "rapid X5 Y5.5 Z-10", "rapid X5 Y5.5 Z20", "rapid X5 Y6 Z20"));
  EXPECT_TRUE(run.commands[2].spindle_on);
  EXPECT_FALSE(run.commands[4].spindle_on);
}

TEST(CyclesTest, G77PassesTheBoreShifted) {
  // The manual's example: Z-1. Q0.1, setting 27 X+ (in mm here).
  CycleWords words = Words(77, -16, -10);
  words.q = 1;
  words.return_to_initial = false;  // G98 is assumed all the same.
  const Made run = Drill(words);
  EXPECT_THAT(
      ToText(run.commands),
      ElementsAre("rapid X5 Y6 Z20", "rapid X6 Y6 Z20", "rapid X6 Y6 Z-16", "rapid X5 Y6 Z-16",
                  "feed X5 Y6 Z-10 F10", "rapid X6 Y6 Z-10", "rapid X6 Y6 Z20", "rapid X5 Y6 Z20"));
  EXPECT_FALSE(run.commands[2].spindle_on);
  EXPECT_TRUE(run.commands[4].spindle_on);
}

TEST(CyclesTest, G85FeedsOutAndG86RapidsOutStopped) {
  EXPECT_THAT(ToText(Drill(Words(85, 2, -10)).commands),
              ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10",
                          "feed X5 Y6 Z2 F10", "rapid X5 Y6 Z20"));
  const Made run = Drill(Words(86, 2, -10));
  EXPECT_THAT(ToText(run.commands), ElementsAre("rapid X5 Y6 Z20", "rapid X5 Y6 Z2",
                                                "feed X5 Y6 Z-10 F10", "rapid X5 Y6 Z20"));
  EXPECT_FALSE(run.commands.back().spindle_on);
}

TEST(CyclesTest, BelowRTheToolGoesSidewaysFirst) {
  std::vector<Command> commands;
  std::string error;
  ExpandCycle(
      Words(81, 2, -10), kSettings, Command{}, At(0, 0, 1), At(5, 6, 0), 1.0,
      [&](const Command& c) { commands.push_back(c); }, &error);
  EXPECT_THAT(ToText(commands), ElementsAre("rapid X5 Y6 Z1", "rapid X5 Y6 Z2",
                                            "feed X5 Y6 Z-10 F0", "rapid X5 Y6 Z1"));
}

TEST(CyclesTest, WrongWordsAreAlarms) {
  CycleWords words = Words(83, 2, -5);
  words.q = 1;
  words.i = 1;
  EXPECT_EQ(Drill(words).error, "G83 has Q as well as I or J");
  words.i.reset();
  words.q = 0.0;
  EXPECT_THAT(Drill(words).error, HasSubstr("greater than 0"));
  words.q = -1.0;
  EXPECT_THAT(Drill(words).error, HasSubstr("greater than 0"));
  EXPECT_EQ(Drill(Words(81, -10, 2)).error, "G81 needs Z below R: Z2, R-10");
  EXPECT_EQ(Drill(Words(77, -10, -16)).error, "G77 needs Z above R: Z-16, R-10");
  EXPECT_THAT(Drill(Words(81, 0, std::nan(""))).error, HasSubstr("needs R and Z"));
  EXPECT_THAT(Drill(Words(88, 0, -1)).error, HasSubstr("not a canned cycle"));
}

TEST(CyclesTest, PecksThatNeverReachTheBottomAreAnAlarm) {
  CycleWords words = Words(83, 0, -100);
  words.q = 1e-9;
  EXPECT_THAT(Drill(words).error, HasSubstr("too small"));
  words.q.reset();
  words.i = 4;  // 4, 3, 2, 1, nothing.
  words.j = 1;
  EXPECT_THAT(Drill(words).error, HasSubstr("too small"));
  words.z = -10;  // Just enough.
  EXPECT_EQ(Drill(words).error, "");
}

}  // namespace
}  // namespace ncsim::control
