// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "sim/base/units.h"
#include "sim/machine/offset_name.h"
#include "sim/machine/test_files.h"

namespace ncsim::machine {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

struct RejectCase {
  const char* name;
  std::vector<std::string> reported;
};

// A planted fault a file, with the exact text; honest_* come as near as honest input can and are
// silent.
const std::vector<RejectCase>& Cases() {
  static const std::vector<RejectCase> cases = {
      {"ball_of_wrong_corner_radius",
       {"ball_of_wrong_corner_radius.toml:12:1: error: T3: the corner radius of a ball mill is "
        "half its diameter"}},
      {"box_of_negative_size",
       {"box_of_negative_size.toml:38:20: error: 'box' must be greater than 0, not -25"}},
      {"box_of_two_numbers",
       {"box_of_two_numbers.toml:38:7: error: 'box' must be an array of three numbers"}},
      {"bull_without_corner_radius",
       {"bull_without_corner_radius.toml:12:1: error: T3: a bull mill has a corner radius"}},
      {"clearance_nan", {"clearance_nan.toml:44:13: error: 'clearance' is not a number (nan)"}},
      {"clearance_negative",
       {"clearance_negative.toml:44:13: error: 'clearance' must not be negative, and is -2"}},
      {"complete", {}},
      {"corner_radius_larger_than_cutter",
       {"corner_radius_larger_than_cutter.toml:12:1: error: T3: the corner radius 3.1 is more than "
        "half the diameter 6"}},
      {"cutter_of_no_diameter",
       {"cutter_of_no_diameter.toml:16:38: error: 'diameter' must be greater than 0, not 0"}},
      {"cutter_of_unknown_type",
       {"cutter_of_unknown_type.toml:16:19: error: 'type' must be \"end\", \"ball\", \"bull\", "
        "\"drill\", \"taper\" or \"chamfer\", not \"bal\" (did you mean 'ball'?)"}},
      {"cutter_without_flute_length",
       {"cutter_without_flute_length.toml:16:10: error: the key 'flute_length' is missing"}},
      {"drill_with_corner_radius",
       {"drill_with_corner_radius.toml:16:44: error: unknown key 'corner_radius'"}},
      {"duplicate_section",
       {"duplicate_section.toml:43:1: error: not TOML: Error while parsing table header: cannot "
        "redefine existing table 'start'"}},
      {"fixture_named_like_an_offset",
       {"fixture_named_like_an_offset.toml:33:1: error: 'G54' is the name of a work offset, not of "
        "a fixture"}},
      {"fixture_named_part", {"fixture_named_part.toml:33:1: error: a second body 'part'"}},
      {"fixture_twice", {"fixture_twice.toml:33:1: error: a second body 'riser'"}},
      {"fixture_with_two_shapes",
       {"fixture_with_two_shapes.toml:33:1: error: 'pin' needs one shape: mesh, box or cylinder"}},
      {"fixture_without_name",
       {"fixture_without_name.toml:29:1: error: the key 'name' is missing"}},
      {"fixture_without_place",
       {"fixture_without_place.toml:33:1: error: the key 'at' is missing"}},
      {"fixture_without_shape",
       {"fixture_without_shape.toml:33:1: error: 'pin' needs one shape: mesh, box or cylinder"}},
      {"flutes_in_the_holder",
       {"flutes_in_the_holder.toml:12:1: error: T3: flutes (61 mm) and holder (60 mm) are longer "
        "than the tool (120 mm)"}},
      {"flutes_shorter_than_corner",
       {"flutes_shorter_than_corner.toml:12:1: error: T3: the flutes are shorter than the corner "
        "radius"}},
      {"frustum_key_misspelt",
       {"frustum_key_misspelt.toml:18:12: error: the key 'lower' is missing",
        "frustum_key_misspelt.toml:18:14: error: unknown key 'lover' (did you mean 'lower'?)"}},
      {"frustum_without_diameter",
       {"frustum_without_diameter.toml:12:1: error: T3: an element of the shank has no diameter"}},
      {"frustum_without_height",
       {"frustum_without_height.toml:17:48: error: 'height' must be greater than 0, not 0"}},
      {"gouge_misspelt",
       {"gouge_misspelt.toml:47:9: error: 'gouge' must be \"error\", \"warning\" or \"off\", not "
        "\"warn\""}},
      {"holder_longer_than_tool",
       {"holder_longer_than_tool.toml:12:1: error: T3: flutes (20 mm) and holder (160 mm) are "
        "longer than the tool (120 mm)"}},
      {"holder_unknown",
       {"holder_unknown.toml:28:10: error: no holder 'CAT40-ER32-110' ships with ncsim (did you "
        "mean 'CAT40-ER32-100'?)"}},
      {"honest_corner_radius_rounded", {}},
      {"honest_flutes_up_to_the_holder", {}},
      {"honest_shank_up_to_the_holder", {}},
      {"inch", {}},
      {"m_code_of_text",
       {"m_code_of_text.toml:54:27: error: an element of 'm_codes_without_motion' must be a whole "
        "number from 0 to 9999"}},
      {"margin_absurd",
       {"margin_absurd.toml:50:13: error: a clearance of 1001 mm is absurd: the greatest is 1000 "
        "mm"}},
      {"margin_is_a_table",
       {"margin_is_a_table.toml:48:1: error: 'margin' must be an array of tables "
        "([[margin]]), not a table"}},
      {"margin_key_misspelt",
       {"margin_key_misspelt.toml:48:1: error: the key 'clearance' is missing",
        "margin_key_misspelt.toml:50:1: error: unknown key 'clearence' (did you mean "
        "'clearance'?)"}},
      {"margin_negative",
       {"margin_negative.toml:50:13: error: 'clearance' must not be negative, and is -5"}},
      {"margin_of_a_body_with_itself",
       {"margin_of_a_body_with_itself.toml:48:1: error: 'riser' is no pair with itself"}},
      {"margin_of_three_bodies",
       {"margin_of_three_bodies.toml:49:10: error: 'bodies' must be an array of two names"}},
      {"margin_twice", {"margin_twice.toml:54:1: error: a second margin of 'riser' and 'holder'"}},
      {"margin_without_bodies",
       {"margin_without_bodies.toml:48:1: error: the key 'bodies' is missing"}},
      {"mesh_missing", {"mesh_missing.toml:38:8: error: mesh part.stl is missing: no such file"}},
      {"no_holder_and_too_short_for_the_assumed_one",
       {"no_holder_and_too_short_for_the_assumed_one.toml:12:1: error: T3: flutes (20 mm) and "
        "holder (100 mm) are longer than the tool (110 mm); the job states no holder, and one like "
        "CAT40-ER32-100 is assumed"}},
      {"no_schema", {"no_schema.toml:1:1: error: the key 'schema' is missing"}},
      {"no_units", {"no_units.toml:1:1: error: the key 'units' is missing"}},
      {"not_toml",
       {"not_toml.toml:4:7: error: not TOML: Error while parsing table header: expected ']', saw "
        "'\\n'"}},
      {"offset_is_a_number",
       {"offset_is_a_number.toml:9:7: error: 'G54' must be a table, not a number"}},
      {"offset_is_no_offset",
       {"offset_is_no_offset.toml:9:1: error: 'G53' is no work offset: G54-G59, G110-G129, "
        "\"G154 P1\"-\"G154 P99\", G500 and G505-G599 are"}},
      {"offset_letter_unknown", {"offset_letter_unknown.toml:9:33: error: unknown key 'W'"}},
      {"offset_placed_with_x",
       {"offset_placed_with_x.toml:10:62: error: an offset that is placed on something has no X: "
        "ncsim works it out"}},
      {"offset_under_both_names",
       {"offset_under_both_names.toml:12:13: error: work offset G154 P3 is stated twice"}},
      {"offset_with_rotation", {"offset_with_rotation.toml:10:58: error: unknown key 'rpy_deg'"}},
      {"place_without_on", {"place_without_on.toml:36:6: error: the key 'on' is missing"}},
      {"setting_of_wrong_word",
       {"setting_of_wrong_word.toml:49:15: error: 'setting 9' must be one of: inch, mm"}},
      {"setting_unknown",
       {"setting_unknown.toml:51:1: error: unknown key 'setting_85' (did you mean 'setting 85'?)"}},
      {"shank_in_the_holder",
       {"shank_in_the_holder.toml:12:1: error: T3: flutes (20 mm), shank (40.1 mm) and holder (60 "
        "mm) are longer than the tool (120 mm)"}},
      {"start_letter_unknown", {"start_letter_unknown.toml:6:1: error: unknown key 'D'"}},
      {"taper_without_angle",
       {"taper_without_angle.toml:16:10: error: the key 'taper_angle_deg' is missing"}},
      {"tool_number_0",
       {"tool_number_0.toml:20:10: error: 'number' must be from 1 to 9999, not 0"}},
      {"tool_of_negative_length",
       {"tool_of_negative_length.toml:15:10: error: 'length' must be greater than 0, not -120"}},
      {"tool_twice", {"tool_twice.toml:19:1: error: T3 is stated twice"}},
      {"tool_without_cutter",
       {"tool_without_cutter.toml:12:1: error: the key 'cutter' is missing"}},
      {"tool_without_length",
       {"tool_without_length.toml:12:1: error: the key 'length' is missing"}},
      {"unit_of_a_glb",
       {"unit_of_a_glb.toml:39:8: error: a DAE or GLB file states its own unit, and is read in m",
        "unit_of_a_glb.toml:38:8: error: mesh part.glb is missing: no such file"}},
      {"unit_unknown",
       {"unit_unknown.toml:39:8: error: 'unit' must be \"mm\", \"inch\" or \"m\", not \"cm\" (did "
        "you mean 'mm'?)",
        "unit_unknown.toml:38:8: error: mesh part.stl is missing: no such file"}},
      {"unit_without_mesh", {"unit_without_mesh.toml:39:1: error: unknown key 'unit'"}},
      {"unknown_key",
       {"unknown_key.toml:12:1: error: the key 'length' is missing",
        "unknown_key.toml:15:1: error: unknown key 'lenght' (did you mean 'length'?)"}},
      {"unknown_section",
       {"unknown_section.toml:43:2: error: unknown key 'checks' (did you mean 'check'?)"}},
  };
  return cases;
}

class JobRejectTest : public ::testing::TestWithParam<RejectCase> {};

TEST_P(JobRejectTest, SaysExactlyThis) {
  Diagnostics diagnostics;
  LoadJob(RejectFile("jobs/" + std::string(GetParam().name) + ".toml"), &diagnostics);
  EXPECT_THAT(Reported(diagnostics), ElementsAreArray(GetParam().reported));
}

INSTANTIATE_TEST_SUITE_P(Jobs, JobRejectTest, ::testing::ValuesIn(Cases()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(JobRejectTest, EveryFileHasACase) {
  std::vector<std::string> names;
  for (const RejectCase& c : Cases()) names.push_back(std::string(c.name) + ".toml");
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(RejectFile("jobs"))) {
    if (entry.path().extension() != ".urdf") files.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(files, ::testing::UnorderedElementsAreArray(names));
}

Job Load(const std::string& name) {
  Diagnostics diagnostics;
  std::optional<Job> job = LoadJob(RejectFile("jobs/" + name), &diagnostics);
  EXPECT_TRUE(job.has_value());
  EXPECT_THAT(Reported(diagnostics), IsEmpty());
  return std::move(*job);
}

TEST(JobTest, ReadsEverySection) {
  const Job job = Load("complete.toml");
  EXPECT_EQ(job.model, "umc750.urdf");
  EXPECT_EQ(job.start.at('X'), -10.0);
  EXPECT_NEAR(job.start.at('B'), Radians(90.0), 1e-12);
  EXPECT_EQ(job.start_tool, 3);
  ASSERT_EQ(job.offsets.size(), 3u);
  EXPECT_EQ(job.offsets.at("G54").values.at('Z'), -350.0);
  EXPECT_NEAR(job.offsets.at("G54").values.at('C'), Radians(10.0), 1e-12);
  ASSERT_TRUE(job.offsets.at("G55").placement.has_value());
  EXPECT_EQ(job.offsets.at("G55").placement->on, "workpiece_mount");
  EXPECT_NEAR(job.offsets.at("G55").values.at('B'), Radians(30.0), 1e-12);
  EXPECT_EQ(job.FindOffset("G112"), &job.offsets.at("G154 P3"));
  EXPECT_EQ(job.FindOffset("g154p3"), &job.offsets.at("G154 P3"));
  EXPECT_EQ(job.FindOffset("G56"), nullptr);
  ASSERT_EQ(job.bodies.size(), 4u);
  EXPECT_EQ(job.bodies[0].kind, BodyKind::kFixture);
  EXPECT_EQ(job.bodies[2].name, "part");
  EXPECT_EQ(job.bodies[3].kind, BodyKind::kStock);
  EXPECT_EQ(job.check.clearance, 2.0);
  EXPECT_EQ(job.check.part_tolerance, 0.15);
  EXPECT_EQ(job.check.gouge_tolerance, 0.3);
  EXPECT_EQ(job.check.gouge, GougeMode::kWarning);
  ASSERT_EQ(job.check.margins.size(), 2u);
  EXPECT_EQ(job.check.margins[0].bodies[0].name, "T3.holder");
  EXPECT_EQ(job.check.margins[0].bodies[1].name, "riser");
  EXPECT_EQ(job.check.margins[0].clearance, 5.0);
  EXPECT_EQ(job.check.margins[1].clearance, 0.0);
  EXPECT_EQ(job.control.at("setting 9"), "inch");
  EXPECT_EQ(job.control.at("setting 15"), "off");
  EXPECT_EQ(job.control.at("setting 85"), "0.635");
  EXPECT_EQ(job.control.at("block_skip"), "on");
  EXPECT_THAT(job.m_codes_without_motion, ElementsAre(21));
  EXPECT_THAT(job.subprogram_folders, ElementsAre(RejectFile("jobs/subs")));
}

TEST(JobTest, ReadsToolsInOrderWithTheirRegisters) {
  const Job job = Load("complete.toml");
  EXPECT_TRUE(job.has_tools);
  ASSERT_EQ(job.tools.size(), 2u);
  const Tool& t1 = job.tools[0];
  EXPECT_EQ(t1.number, 1);
  EXPECT_EQ(t1.length, 200.0);
  EXPECT_EQ(t1.h_geometry, 199.5);
  EXPECT_EQ(t1.h_wear, -0.1);
  EXPECT_EQ(t1.d_geometry, 11.9);
  EXPECT_EQ(t1.d_wear, 0.05);
  EXPECT_EQ(t1.assumed, "");
  const Tool& t3 = job.tools[1];
  EXPECT_EQ(t3.name, "BALL");
  EXPECT_EQ(t3.type, CutterType::kBall);
  EXPECT_EQ(t3.h_geometry, 120.0);
  EXPECT_EQ(t3.d_geometry, 6.0);
  EXPECT_EQ(t3.shank.z_min(), 20.0);
  EXPECT_EQ(t3.shank.z_max(), 60.0);  // goes on to the holder
  EXPECT_EQ(t3.holder.z_max(), 120.0);
}

TEST(JobTest, InchesScaleEveryLength) {
  const Job job = Load("inch.toml");
  EXPECT_NEAR(job.start.at('X'), -25.4, 1e-9);
  EXPECT_NEAR(job.start.at('B'), Radians(90.0), 1e-12);
  EXPECT_NEAR(job.offsets.at("G54").values.at('X'), -381.0, 1e-9);
  EXPECT_NEAR(job.offsets.at("G54").values.at('C'), Radians(10.0), 1e-12);
  const Tool& tool = job.tools.at(0);
  EXPECT_NEAR(tool.length, 203.2, 1e-9);
  EXPECT_NEAR(tool.h_geometry, 200.66, 1e-9);
  EXPECT_NEAR(tool.diameter, 12.7, 1e-9);
  EXPECT_NEAR(tool.flutes.z_max(), 31.75, 1e-9);
  EXPECT_NEAR(tool.holder.z_min(), 101.6, 1e-9);
  EXPECT_NEAR(job.bodies.at(0).mesh.vertices[0].cwiseAbs().maxCoeff(), 50.8, 1e-9);
  EXPECT_NEAR(job.bodies.at(0).at.X_OG.translation().x(), 25.4, 1e-9);
  EXPECT_NEAR(job.check.clearance, 2.54, 1e-9);
  EXPECT_NEAR(job.check.part_tolerance, 0.127, 1e-9);
  EXPECT_NEAR(job.check.margins.at(0).clearance, 5.08, 1e-9);
  EXPECT_EQ(job.control.at("setting 85"), "0.635");
}

// Boxes and cylinders are centred in x and y and stand on their frame.
TEST(JobTest, PrimitivesStandOnTheirFrame) {
  const Job job = Load("complete.toml");
  for (const PlacedBody& body : job.bodies) {
    double low = 1e9, high = -1e9, sum_x = 0.0;
    for (const Eigen::Vector3d& v : body.mesh.vertices) {
      low = std::min(low, v.z());
      high = std::max(high, v.z());
      sum_x += v.x();
    }
    EXPECT_NEAR(low, 0.0, 1e-12) << body.name;
    EXPECT_GT(high, 1.0) << body.name;
    EXPECT_NEAR(sum_x, 0.0, 1e-6) << body.name;
  }
}

TEST(JobTest, NoJobIsTheDefaultJobAndAMissingOneIsAnError) {
  Diagnostics diagnostics;
  const std::optional<Job> none = LoadJob("", &diagnostics);
  ASSERT_TRUE(none.has_value());
  EXPECT_FALSE(none->has_tools);
  EXPECT_THAT(Reported(diagnostics), IsEmpty());
  EXPECT_FALSE(LoadJob(RejectFile("jobs/QQQ.toml"), &diagnostics).has_value());
  EXPECT_THAT(Reported(diagnostics), ElementsAre("QQQ.toml: error: no such file"));
}

TEST(JobTest, WhatAToolDoesNotStateIsAssumedAndSaid) {
  TempFolder folder;
  Diagnostics diagnostics;
  const std::string path = folder.Write("j.toml", R"(schema = 1
units = "mm"
[[tool]]
number = 1
length = 180.0
cutter = { type = "drill", diameter = 8.0, flute_length = 40.0 }
[[tool]]
number = 2
length = 100.0
cutter = { type = "end", diameter = 8.0, flute_length = 100.0 }
holder = []
)");
  const std::optional<Job> job = LoadJob(path, &diagnostics);
  ASSERT_TRUE(job.has_value());
  EXPECT_THAT(Reported(diagnostics), IsEmpty());
  EXPECT_EQ(job->tools.at(0).assumed,
            "holder CAT40-ER32-100, shank as wide as the flutes' end, up to the holder");
  EXPECT_EQ(job->tools.at(1).assumed, "");
  EXPECT_TRUE(job->tools.at(1).holder.empty());
}

// A mesh's numbers are in `unit`, or else in the unit of the job.
TEST(JobTest, MeshUnits) {
  const std::string obj =
      "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  for (const auto& [units, unit, expected] : {std::tuple("mm", "", 2.0),
                                              {"inch", "", 50.8},
                                              {"mm", "unit = \"inch\"", 50.8},
                                              {"inch", "unit = \"mm\"", 2.0},
                                              {"inch", "unit = \"m\"", 2000.0}}) {
    TempFolder folder;
    folder.Write("part.obj", obj);
    Diagnostics diagnostics;
    const std::optional<Job> job =
        LoadJob(folder.Write("j.toml", std::string("schema = 1\nunits = \"") + units +
                                           "\"\n[part]\nmesh = \"part.obj\"\n" + unit +
                                           "\nat = { on = \"G54\" }\n"),
                &diagnostics);
    ASSERT_TRUE(job.has_value());
    EXPECT_THAT(Reported(diagnostics), IsEmpty());
    double high = 0.0;
    for (const auto& v : job->bodies.at(0).mesh.vertices) high = std::max(high, v.maxCoeff());
    EXPECT_NEAR(high, expected, 1e-9) << units << " " << unit;
  }
}

TEST(OffsetNameTest, OneSpellingForEach) {
  EXPECT_EQ(OffsetName("g54"), "G54");
  EXPECT_EQ(OffsetName("G154P03"), "G154 P3");
  EXPECT_EQ(OffsetName("G154 P99"), "G154 P99");
  EXPECT_EQ(OffsetName("G129"), "G129");
  EXPECT_EQ(OffsetName("G59.3"), "G59.3");
  EXPECT_EQ(OffsetName("G500"), "G500");
  EXPECT_EQ(OffsetName("g505"), "G505");
  for (const char* wrong : {"", "G", "G53", "G60", "G130", "G154", "G504", "G600", "G154 P0",
                            "G154 P100", "G54 P1", "G59.4", "X54", "G54x", "G-54", "vise"}) {
    EXPECT_EQ(OffsetName(wrong), std::nullopt) << wrong;
  }
  EXPECT_EQ(TwinOffset("G110"), "G154 P1");
  EXPECT_EQ(TwinOffset("G154 P20"), "G129");
  EXPECT_EQ(TwinOffset("G154 P21"), "");
  EXPECT_EQ(TwinOffset("G54"), "");
}

}  // namespace
}  // namespace ncsim::machine
