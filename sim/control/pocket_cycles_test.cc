// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/pocket_cycles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/control/command_test_util.h"

namespace ncsim::control {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Made {
  std::vector<Command> commands;
  std::optional<AxisValues> end;
  std::string error;
};

Made Mill(const CircularPocketWords& words) {
  Made run;
  Command prototype;
  prototype.feed = 10.0;
  run.end = ExpandCircularPocket(
      words, prototype, At(1, 2, 5), [&](const Command& c) { run.commands.push_back(c); },
      &run.error);
  return run;
}

TEST(PocketCyclesTest, SinglePass) {
  CircularPocketWords words;
  words.clockwise = true;
  words.first_radius = 10;
  words.tool_radius = 3;
  words.depth = -4;
  const Made run = Mill(words);
  EXPECT_THAT(ToText(run.commands),
              ElementsAre("feed X1 Y2 Z-4 F10", "cw X8 Y2 Z-4 about X4.5 Y2 Z-4",
                          "cw full X8 Y2 Z-4 about X1 Y2 Z-4", "cw X1 Y2 Z-4 about X4.5 Y2 Z-4"));
  ASSERT_TRUE(run.end);
  EXPECT_EQ(*run.end, At(1, 2, -4));
}

TEST(PocketCyclesTest, StepsOutToKAndStaysInsideIt) {
  // Manual O60131: I.400 K2.0 Q.400 with a 0.5 in end mill: circles of 0.4, 0.8 ... 2.0 in.
  CircularPocketWords words;
  words.first_radius = 0.4 * 25.4;
  words.radius = 2.0 * 25.4;
  words.stepover = 0.4 * 25.4;
  words.tool_radius = 0.25 * 25.4;
  words.depth = -12.7;
  const Made run = Mill(words);
  std::vector<double> circles;
  AxisValues at = At(1, 2, -12.7);
  for (const Command& c : run.commands) {
    if (c.kind != CommandKind::kArc) continue;
    const Arc arc = ArcOf(at, c);
    EXPECT_NEAR(arc.start_radius, arc.end_radius, 1e-9);
    if (c.full_circle) circles.push_back(arc.start_radius / 25.4 + 0.25);
    for (double s = 0; s <= 1.0; s += 0.05) {
      const double a = arc.start_angle + s * arc.sweep;
      const double x = arc.centre.x() + arc.start_radius * std::cos(a) - 1;
      const double y = arc.centre.y() + arc.start_radius * std::sin(a) - 2;
      EXPECT_LE(std::hypot(x, y) + words.tool_radius, *words.radius + 1e-9);
    }
    at = c.end;
  }
  ASSERT_EQ(circles.size(), 5U);
  EXPECT_NEAR(circles.front(), 0.4, 1e-9);
  EXPECT_NEAR(circles.back(), 2.0, 1e-9);
}

TEST(PocketCyclesTest, WrongWordsAreAlarms) {
  CircularPocketWords words;
  words.first_radius = 3;
  words.tool_radius = 3;
  EXPECT_THAT(Mill(words).error, HasSubstr("I greater than the tool radius"));
  words.first_radius = 4;
  words.radius = 10;
  EXPECT_THAT(Mill(words).error, HasSubstr("K and Q together"));
  words.stepover = 0.0;
  EXPECT_THAT(Mill(words).error, HasSubstr("needs a Q"));
  words.stepover = 1.0;
  words.radius = 4;
  EXPECT_THAT(Mill(words).error, HasSubstr("K greater than I"));
}

}  // namespace
}  // namespace ncsim::control
