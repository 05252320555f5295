// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/haas_settings.h"

#include <gtest/gtest.h>

#include "sim/control/test_machine.h"

namespace ncsim::control {
namespace {

TEST(HaasSettings, FirstUnitCodeIsReadAsTheControlReadsIt) {
  EXPECT_EQ(FirstUnitCode("G0 X1.\nG21\nG20\n"), 21);
  EXPECT_EQ(FirstUnitCode("(G21)\nN5 G40G20 G90\n"), 20);
  EXPECT_EQ(FirstUnitCode("g020\n"), 20);
  EXPECT_EQ(FirstUnitCode("G200 G21.1 G2 X0 (inch, G20"), 0);
  EXPECT_EQ(FirstUnitCode("(open\nG21"), 21);  // A comment ends with its line.
  EXPECT_EQ(FirstUnitCode(""), 0);
}

struct Read {
  explicit Read(const TestControl& control, const std::string& text = "G0\n")
      : log(&run, &summary),
        settings(ReadHaasSettings(SettingSource(control.machine, control.job), control.machine,
                                  *nc::Program::FromText("test.nc", text), &log)) {}
  TestRun run;
  RunSummary summary;
  RunLog log;
  HaasSettings settings;
};

TEST(HaasSettings, JobGoesBeforeModelBeforeDefault) {
  TestControl control;
  EXPECT_EQ(Read(control).settings.rapid, RapidMode::kIndependent);
  control.machine.control.settings["setting 335"] = "linear";
  EXPECT_EQ(Read(control).settings.rapid, RapidMode::kLinearXyz);
  control.job.control["setting 335"] = "linear+rotary";
  const Read read(control);
  EXPECT_EQ(read.settings.rapid, RapidMode::kLinearRotary);
  EXPECT_FALSE(read.log.Assumed("setting 335"));
  EXPECT_TRUE(read.log.Assumed("setting 162"));
}

TEST(HaasSettings, TypedValues) {
  TestControl control;
  control.job.control = {{"setting 9", "mm"},      {"setting 40", "radius"},  {"setting 43", "b"},
                         {"setting 58", "yasnac"}, {"setting 27", "y-"},      {"setting 72", "90"},
                         {"setting 79", "50"},     {"setting 257", "-490.5"}, {"setting 296", "90"},
                         {"tcp_rapid", "track"},   {"block_skip", "on"}};
  const HaasSettings settings = Read(control).settings;
  EXPECT_FALSE(settings.inch);
  EXPECT_FALSE(settings.diameter_d);
  EXPECT_TRUE(settings.contour.type_b);
  EXPECT_FALSE(settings.contour.fanuc_corners);
  EXPECT_EQ(settings.cycles.setting27, 3);
  EXPECT_NEAR(settings.g68_angle, kPi / 2.0, 1e-12);
  EXPECT_EQ(settings.rotary_diameter[1], 0.0);  // B is the fourth axis, C the fifth.
  EXPECT_EQ(settings.rotary_diameter[2], 50.0);
  // One of settings 255-257 alone: the others are the model's.
  EXPECT_NEAR((*settings.rotary_centre)[0], -381.0, 1e-9);
  EXPECT_EQ((*settings.rotary_centre)[2], -490.5);
  EXPECT_NEAR(*settings.tool_change_mid[3], kPi / 2.0, 1e-12);
  EXPECT_TRUE(settings.track_tcp_rapids);
  EXPECT_TRUE(settings.block_skip);
}

TEST(HaasSettings, UnitOfTheProgramIsTheDefaultOfSetting9) {
  // Haas NGC Mill Operator's Manual 2017, G20/G21.
  TestControl control;
  control.job.control.clear();
  EXPECT_FALSE(Read(control, "G21\n").settings.inch);
  EXPECT_TRUE(Read(control, "G20\n").settings.inch);
  EXPECT_TRUE(Read(control, "G0\n").settings.inch);
}

}  // namespace
}  // namespace ncsim::control
