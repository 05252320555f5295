// SPDX-License-Identifier: BSD-3-Clause
// Sequences: Programming Guide Cycles 11/2002 ("manual"), sections CYCLE81 to CYCLE89, and the text
// of the cycles themselves as control software 06.02 has them ("source"); depths worked out by
// hand.
#include "sim/control/sinumerik_drilling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/control/command_test_util.h"

namespace ncsim::control {
namespace {

using ::testing::DoubleEq;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Made {
  std::vector<Command> commands;
  std::optional<AxisValues> end;
  SinumerikCycleAlarm alarm;
};

// At X5 Y6 Z20, F 10 mm/s.
Made Drill(const SinumerikDrilling& words, Plane plane = Plane::kXY) {
  Made run;
  Command prototype;
  prototype.plane = plane;
  prototype.feed = 10.0;
  prototype.spindle_on = true;
  run.end = ExpandSinumerikDrilling(
      words, prototype, At(5, 6, 20), [&](const Command& c) { run.commands.push_back(c); },
      &run.alarm);
  return run;
}

SinumerikDrilling Words(int cycle, double depth) {
  SinumerikDrilling words;
  words.cycle = cycle;
  words.rtp = 10.0;
  words.sdis = 2.0;
  words.depth = depth;
  return words;
}

TEST(SinumerikDrilling, Cycle81And82) {
  EXPECT_THAT(ToText(Drill(Words(81, -10)).commands),
              ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10", "rapid X5 Y6 Z10"));
  SinumerikDrilling words = Words(82, -10);
  words.dwell = 0.5;
  const Made run = Drill(words);
  EXPECT_THAT(ToText(run.commands),
              ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10", "dwell 0.5", "rapid X5 Y6 Z10"));
  EXPECT_EQ(run.end, At(5, 6, 10));
  EXPECT_EQ(run.commands[1].named, 1U << kZ);
  // A hole of no depth is none (source).
  EXPECT_THAT(Drill(Words(81, 0)).commands, IsEmpty());
}

TEST(SinumerikDrilling, UpwardAndInOtherPlanes) {
  SinumerikDrilling words = Words(81, 30.0);
  words.rfp = 22.0;
  EXPECT_THAT(ToText(Drill(words).commands), ElementsAre("feed X5 Y6 Z30 F10", "rapid X5 Y6 Z10"));
  EXPECT_THAT(ToText(Drill(Words(81, -10), Plane::kZX).commands),
              ElementsAre("rapid X5 Y2 Z20", "feed X5 Y-10 Z20 F10", "rapid X5 Y10 Z20"));
}

TEST(SinumerikDrilling, DepthByDpOrDpr) {
  SinumerikCycleAlarm alarm;
  const auto depth = [&](double rtp, double rfp, double dp, double dpr, int mode = 0) {
    alarm = {};
    return HoleDepth(rtp, rfp, dp, dpr, mode, &alarm).value_or(std::nan(""));
  };
  EXPECT_EQ(depth(10, 5, -3, 0), -3.0);
  // DPR counts before DP, and without its sign, away from RTP (source).
  EXPECT_EQ(depth(10, 5, -3, 4), 1.0);
  EXPECT_EQ(depth(10, 5, -3, -4), 1.0);
  EXPECT_EQ(depth(0, 5, 0, 4), 9.0);
  EXPECT_EQ(depth(5, 5, -3, 0), -3.0);
  EXPECT_EQ(depth(10, 5, -3, 4, 1), 1.0);
  EXPECT_EQ(depth(10, 5, -3, 4, 2), -3.0);
  EXPECT_TRUE(std::isnan(depth(5, 5, 0, 4)));
  EXPECT_EQ(alarm.number, 61101);
  EXPECT_TRUE(std::isnan(depth(10, 5, 7, 0)));
  EXPECT_EQ(alarm.number, 61101);
}

TEST(SinumerikDrilling, StrokesFallByAnAmount) {
  // Manual, example of CYCLE83: RFP150 DP5 FDEP100 DAM20. Strokes fall to DAM and not below; less
  // than twice DAM is shared by the last two.
  EXPECT_THAT(StrokeDepths(145, 50, 20, 0), ElementsAre(50, 80, 100, 120, 132.5, 145));
  // What is left when the next stroke would leave less than DAM: all but DAM, then DAM.
  EXPECT_THAT(StrokeDepths(75, 30, 10, 0), ElementsAre(30, 50, 60, 67.5, 75));
  EXPECT_THAT(StrokeDepths(62, 30, 5, 0), ElementsAre(30, 55, 62));
  EXPECT_THAT(StrokeDepths(20, 30, 5, 0), ElementsAre(20));
}

TEST(SinumerikDrilling, StrokesFallByAFactorOrNotAtAll) {
  // Each is 0.8 of the one before, down to _MDEP.
  EXPECT_THAT(StrokeDepths(100, 40, -0.8, 20), ElementsAre(40, 72, DoubleNear(86, 1e-9), 100));
  // DAM 0: all alike; what is left below twice the stroke is halved until it is less than one.
  EXPECT_THAT(StrokeDepths(33.004, 5, 0, 0),
              ElementsAre(5, 10, 15, 20, 25, DoubleEq(25 + 8.004 / 2), 33.004));
  EXPECT_THAT(StrokeDepths(100, 40, -0.1, 0), IsEmpty());
  EXPECT_THAT(StrokeDepths(100, 0, 0, 0), IsEmpty());
}

TEST(SinumerikDrilling, Cycle83ClearsChips) {
  SinumerikDrilling words = Words(83, -60);
  words.strokes = SinumerikDrilling::Strokes::kClearChips;
  words.first = 25.0;
  words.degression = 5.0;
  words.first_factor = 0.5;
  words.dwell = 0.1;
  words.dwell_top = 0.2;
  words.dwell_bottom = 0.3;
  // 0.6 mm above the last depth up to 30 mm, a fiftieth of the depth beyond (source).
  EXPECT_THAT(ToText(Drill(words).commands),
              ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-25 F5", "dwell 0.1", "rapid X5 Y6 Z2",
                          "dwell 0.2", "rapid X5 Y6 Z-24.4", "feed X5 Y6 Z-45 F10", "dwell 0.1",
                          "rapid X5 Y6 Z2", "dwell 0.2", "rapid X5 Y6 Z-44.1",
                          "feed X5 Y6 Z-60 F10", "dwell 0.3", "rapid X5 Y6 Z10"));
  words.reapproach = 3.0;
  EXPECT_EQ(ToText(Drill(words).commands)[5], "rapid X5 Y6 Z-22");
}

TEST(SinumerikDrilling, Cycle83BreaksChips) {
  SinumerikDrilling words = Words(83, -30);
  words.strokes = SinumerikDrilling::Strokes::kBreakChips;
  words.first = 20.0;
  words.retract = 1.5;
  EXPECT_THAT(ToText(Drill(words).commands),
              ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-20 F10", "rapid X5 Y6 Z-18.5",
                          "feed X5 Y6 Z-30 F10", "rapid X5 Y6 Z10"));
  words.first = 0.001;
  EXPECT_FALSE(Drill(words).end);
  words.degression = -0.5;
  EXPECT_FALSE(Drill(words).end);
}

TEST(SinumerikDrilling, Cycle84FollowsTheThread) {
  SinumerikDrilling words = Words(84, -20);
  words.feed_in = 8.0;
  words.feed_out = 16.0;
  words.dwell = 0.2;
  EXPECT_THAT(ToText(Drill(words).commands),
              ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-20 F8", "dwell 0.2", "feed X5 Y6 Z2 F16",
                          "rapid X5 Y6 Z10"));
  words.dwell = 0.0;
  words.first = 15.0;
  words.retract = 1.0;
  words.strokes = SinumerikDrilling::Strokes::kBreakChips;
  EXPECT_THAT(ToText(Drill(words).commands),
              ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-15 F8", "feed X5 Y6 Z-14 F16",
                          "feed X5 Y6 Z-20 F8", "feed X5 Y6 Z2 F16", "rapid X5 Y6 Z10"));
  words.strokes = SinumerikDrilling::Strokes::kClearChips;
  EXPECT_EQ(ToText(Drill(words).commands)[2], "feed X5 Y6 Z2 F16");
  words.first = 21.0;
  const Made run = Drill(words);
  EXPECT_EQ(run.alarm.number, 61809);
}

TEST(SinumerikDrilling, PitchOfMetricThreads) {
  // ISO 261, coarse series.
  EXPECT_EQ(CoarsePitch(5), 0.8);
  EXPECT_EQ(CoarsePitch(8), 1.25);
  EXPECT_EQ(CoarsePitch(12), 1.75);
  EXPECT_EQ(CoarsePitch(48), 5.0);
  EXPECT_EQ(CoarsePitch(2), 0.0);
  EXPECT_EQ(CoarsePitch(7.5), 0.0);
}

TEST(SinumerikDrilling, BoringCyclesEachRetractTheirWay) {
  SinumerikDrilling words = Words(85, -10);
  words.feed_in = 4.0;
  words.feed_out = 6.0;
  EXPECT_THAT(ToText(Drill(words).commands), ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F4",
                                                         "feed X5 Y6 Z2 F6", "rapid X5 Y6 Z10"));
  words = Words(86, -10);
  words.lift_first = -0.2;
  words.lift_normal = 0.1;
  const Made run = Drill(words);
  EXPECT_THAT(ToText(run.commands),
              ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10", "rapid X4.8 Y6 Z-9.9",
                          "rapid X4.8 Y6 Z2", "rapid X5 Y6 Z2", "rapid X5 Y6 Z10"));
  EXPECT_TRUE(run.commands[1].spindle_on);
  EXPECT_FALSE(run.commands[2].spindle_on);
  EXPECT_THAT(ToText(Drill(Words(87, -10)).commands),
              ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10", "rapid X5 Y6 Z10"));
  EXPECT_THAT(
      ToText(Drill(Words(89, -10)).commands),
      ElementsAre("rapid X5 Y6 Z2", "feed X5 Y6 Z-10 F10", "feed X5 Y6 Z2 F10", "rapid X5 Y6 Z10"));
}

}  // namespace
}  // namespace ncsim::control
