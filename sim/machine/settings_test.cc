// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "sim/machine/test_files.h"
#include "sim/machine/trafo_type.h"

namespace ncsim::machine {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A job of these [control] settings; what is wrong with them goes to `reported`.
Job LoadControl(const std::string& settings, std::vector<std::string>* reported) {
  TempFolder folder;
  Diagnostics diagnostics;
  const std::string path =
      folder.Write("j.toml", "schema = 1\nunits = \"mm\"\n[control]\n" + settings);
  Job job = LoadJob(path, &diagnostics).value_or(Job());
  *reported = Reported(diagnostics);
  return job;
}

TEST(SettingsTest, MachineDataAreReadByNumber) {
  std::vector<std::string> reported;
  const Job job = LoadControl(R"("MD20150[7]" = "g54"
"MD20150[50]" = "OriAxes"
"MD21104" = 0
"MD21000" = 0.02
"MD30455[C]" = 5
"MD30330[C]" = 360.0
"SD55441" = 10
"block_skip" = "ON"
"block_skip 2" = true
data_files = ["tools.ini", "../offsets.spf"]
)",
                              &reported);
  EXPECT_THAT(reported, IsEmpty());
  EXPECT_EQ(job.control.at("MD20150[7]"), "G54");  // as the table spells it
  EXPECT_EQ(job.control.at("MD20150[50]"), "ORIAXES");
  EXPECT_EQ(job.control.at("MD21104"), "0");
  EXPECT_EQ(job.control.at("MD21000"), "0.02");
  EXPECT_EQ(job.control.at("MD30455[C]"), "5");
  EXPECT_EQ(job.control.at("block_skip"), "on");
  EXPECT_EQ(job.control.at("block_skip 2"), "on");
  ASSERT_EQ(job.data_files.size(), 2u);
  EXPECT_EQ(std::filesystem::path(job.data_files[0]).filename(), "tools.ini");
  EXPECT_EQ(std::filesystem::path(job.data_files[1]).filename(), "offsets.spf");
  EXPECT_EQ(std::filesystem::path(job.data_files[0]).parent_path().parent_path(),
            std::filesystem::path(job.data_files[1]).parent_path());
}

TEST(SettingsTest, WhatMakesNoSenseIsAnError) {
  const auto fault = [](const std::string& line) {
    std::vector<std::string> reported;
    LoadControl(line, &reported);
    return reported;
  };
  EXPECT_THAT(fault("\"MD21104\" = 2"),
              ElementsAre("j.toml:4:13: error: 'MD21104' must be a whole number from 0 to 1"));
  EXPECT_THAT(fault("\"MD21104\" = true"),
              ElementsAre("j.toml:4:13: error: 'MD21104' must be a whole number from 0 to 1"));
  EXPECT_THAT(fault("\"MD30455[C]\" = 4.0"), ElementsAre(StartsWith("j.toml:4:16: error: ")));
  EXPECT_THAT(fault("\"MD20150[13]\" = \"G92\""),
              ElementsAre("j.toml:4:17: error: 'MD20150[13]' must be one of: G90, G91"));
  EXPECT_THAT(fault("\"MD20150[7]\" = \"G504\""), ElementsAre(StartsWith("j.toml:4:16: error: ")));
  EXPECT_THAT(fault("MD21105 = 1"), ElementsAre(StartsWith("j.toml:4:1: error: unknown key")));
  EXPECT_THAT(fault("\"MD30455[X]\" = 1"), ElementsAre(StartsWith("j.toml:4:1: error: unknown")));
  EXPECT_THAT(fault("data_files = \"a.ini\""), ElementsAre(StartsWith("j.toml:4:14: error: ")));
}

// Numbers reach the control in mm and rad; a mask and a switch as they are.
TEST(SettingsTest, NumbersAreAppliedInMmAndRad) {
  ControlData control;
  control.dialect = "sinumerik-840d";
  ApplySettings(
      {{"MD21000", "0.02"}, {"MD30330[C]", "360"}, {"MD30455[C]", "5"}, {"MD20150[7]", "G54"}},
      &control);
  EXPECT_EQ(control.numbers.at("MD21000"), 0.02);
  EXPECT_NEAR(control.numbers.at("MD30330[C]"), 2.0 * kPi, 1e-15);
  EXPECT_EQ(control.numbers.at("MD30455[C]"), 5.0);
  EXPECT_FALSE(control.numbers.contains("MD20150[7]"));
  EXPECT_EQ(control.settings.at("MD20150[7]"), "G54");
}

TEST(SettingsTest, EdgesOfATool) {
  TempFolder folder;
  Diagnostics diagnostics;
  const std::string tool = R"(schema = 1
units = "inch"
[[tool]]
number = 3
name = "UGT0203_004"
length = 5.0
cutter = { type = "ball", diameter = 0.5, flute_length = 1.0 }
holder = []
)";
  const auto job =
      LoadJob(folder.Write("j.toml",
                           tool + R"(edges = [ { number = 2, length = 4.9, diameter_wear = -0.01 },
  { number = 1, length_wear = 0.1 } ])"),
              &diagnostics);
  ASSERT_TRUE(job.has_value());
  EXPECT_THAT(Reported(diagnostics), IsEmpty());
  const std::vector<ToolEdge>& edges = job->tools.at(0).edges;
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(edges[0].number, 1);
  EXPECT_NEAR(edges[0].length, 127.0, 1e-12);
  EXPECT_NEAR(edges[0].length_wear, 2.54, 1e-12);
  EXPECT_NEAR(edges[0].diameter, 12.7, 1e-12);
  EXPECT_NEAR(edges[1].length, 124.46, 1e-12);
  EXPECT_NEAR(edges[1].diameter_wear, -0.254, 1e-12);
  const auto fault = [&](const std::string& keys) {
    Diagnostics found;
    LoadJob(folder.Write("j.toml", tool + keys), &found);
    return Reported(found);
  };
  EXPECT_THAT(fault("edges = [ { number = 1 }, { number = 1 } ]"),
              ElementsAre("j.toml:9:27: error: edge D1 is stated twice"));
  EXPECT_THAT(fault("edges = [ { number = 13 } ]"),
              ElementsAre(StartsWith("j.toml:9:22: error: ")));
  EXPECT_THAT(fault("edges = [ { length = 1.0 } ]"),
              ElementsAre("j.toml:9:11: error: the key 'number' is missing"));
  EXPECT_THAT(fault("edges = [ { number = 1, lenght = 1.0 } ]"),
              ElementsAre(StartsWith("j.toml:9:25: error: unknown key 'lenght'")));
  EXPECT_THAT(fault("h_wear = 0.1\nedges = [ { number = 1 } ]"),
              ElementsAre("j.toml:3:1: error: 'edges' are the registers of D1 and on: state one or "
                          "the other"));
}

class BcTableModel : public ::testing::Test {
 protected:
  static std::string Folder() { return std::string(NCSIM_SOURCE_DIR) + "/models/bc_table_840d"; }

  Machine Load(const std::string& path) {
    std::optional<Machine> machine = LoadMachine(path, &diagnostics_);
    EXPECT_TRUE(machine.has_value());
    return std::move(*machine);
  }

  Diagnostics diagnostics_;
};

// Zhang, design of a post-processor for an 840D sl machine (2021), table 2-1: travels, B, rates,
// magazine; the zero points are the model's own (README).
TEST_F(BcTableModel, IsThatOfTheTable) {
  const Machine machine = Load(Folder() + "/bc_table_840d.urdf");
  EXPECT_THAT(Reported(diagnostics_), IsEmpty());
  const std::map<char, std::pair<double, double>> travel = {
      {'X', {-250.0, 250.0}}, {'Y', {-150.0, 150.0}}, {'Z', {-500.0, 0.0}}};
  for (const auto& [letter, ends] : travel) {
    const Axis& axis = *machine.FindAxis(letter);
    EXPECT_NEAR(axis.lower, ends.first, 1e-9);
    EXPECT_NEAR(axis.upper, ends.second, 1e-9);
    EXPECT_NEAR(axis.rapid, 5000.0 / 60.0, 1e-9);
    EXPECT_EQ(axis.home, 0.0);
  }
  const Axis& b = *machine.FindAxis('B');
  EXPECT_NEAR(Degrees(b.lower), -11.0, 1e-9);
  EXPECT_NEAR(Degrees(b.upper), 100.0, 1e-9);
  EXPECT_NEAR(b.rapid, 16.0 * 2.0 * kPi / 60.0, 1e-9);
  const Axis& c = *machine.FindAxis('C');
  EXPECT_TRUE(std::isinf(c.lower) && std::isinf(c.upper));
  EXPECT_NEAR(c.rapid, 27.0 * 2.0 * kPi / 60.0, 1e-9);
  EXPECT_EQ(machine.control.max_spindle_rpm, 9000.0);
  EXPECT_EQ(machine.control.tool_pockets, 16);
  EXPECT_EQ(machine.control.spindle_interface, "BT40");
  EXPECT_EQ(machine.control.settings.at("MD21104"), "1");
  EXPECT_EQ(machine.control.settings.at("MD30310[C]"), "1");
  EXPECT_EQ(machine.control.settings.at("MD30455[C]"), "0");
  EXPECT_THAT(machine.control.nominal_settings, ::testing::Contains("MD30455[C]"));
  EXPECT_THAT(Inspect(machine, diagnostics_),
              ::testing::AllOf(::testing::HasSubstr("  MD21104 = 1, nominal\n"),
                               ::testing::HasSubstr("  MD22550 = 1\n"),
                               ::testing::HasSubstr("base_link -> [Y] y_saddle -> [X] x_table -> "
                                                    "[B] b_cradle -> [C] c_platter")));
}

// The C axis stands under the spindle at X0 Y0; the tool axis in the part is that of a BC table
// (docs/notation.md).
TEST_F(BcTableModel, CStandsUnderTheSpindleAtHome) {
  const Machine machine = Load(Folder() + "/bc_table_840d.urdf");
  kinematics::JointVector q = machine.Home();
  Eigen::Vector3d tip, axis;
  machine.five_axis->TipInTable(q, 0.0, &tip, &axis);
  EXPECT_LT(tip.head<2>().norm(), 1e-9);
  q[machine.FindAxis('B')->joint] = Radians(60.0);
  q[machine.FindAxis('C')->joint] = Radians(30.0);
  machine.five_axis->TipInTable(q, 0.0, &tip, &axis);
  EXPECT_LT((axis - Eigen::Vector3d(0.75, std::sqrt(3.0) / 4.0, 0.5)).norm(), 1e-12);
}

// MD24100: 32 and on are tables, 3 is the sequence BC, 8 the generic transformation.
TEST_F(BcTableModel, TheTransformationTypeIsHeldAgainstTheUrdf) {
  const Machine machine = Load(Folder() + "/bc_table_840d.urdf");
  for (const int right : {35, 40, 72}) EXPECT_EQ(TrafoTypeFault(machine, right), "") << right;
  EXPECT_EQ(TrafoTypeFault(machine, 33),
            "MD24100 = 33 does not fit the URDF: a table machine, BC, is 35 or 40");
  for (const int wrong : {16, 19, 24, 32, 34, 37, 51, 56}) {
    EXPECT_NE(TrafoTypeFault(machine, wrong), "") << wrong;
  }
}

TEST_F(BcTableModel, WrongDataAreReported) {
  TempFolder folder;
  const std::filesystem::path copy = std::filesystem::path(folder.path()) / "model";
  std::filesystem::copy(Folder(), copy, std::filesystem::copy_options::recursive);
  std::ifstream in(Folder() + "/bc_table_840d.toml");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  text.replace(text.find("\"MD24100\" = 35"), 14, "\"MD24100\" = 33");
  text.replace(text.find("\"MD21104\", "), 9, "\"MD21105\"");
  std::ofstream(copy / "bc_table_840d.toml") << text;
  Load((copy / "bc_table_840d.urdf").string());
  EXPECT_THAT(Reported(diagnostics_),
              ElementsAre(::testing::HasSubstr("'MD21105' is not stated in [control.settings]"),
                          "bc_table_840d.toml: error: MD24100 = 33 does not fit the URDF: a table "
                          "machine, BC, is 35 or 40"));
}

}  // namespace
}  // namespace ncsim::machine
