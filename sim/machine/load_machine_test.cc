// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/units.h"
#include "sim/machine/test_files.h"

namespace ncsim::machine {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

struct RejectCase {
  const char* name;
  std::vector<std::string> reported;
};

// A planted fault a file, with the exact text; honest_* come as near as honest input can and are
// silent.
const std::vector<RejectCase>& Cases() {
  static const std::vector<RejectCase> cases = {
      {"complete.toml", {}},
      {"duplicate_key.toml",
       {"model.toml:3:9: error: not TOML: Error while parsing key-value pair: cannot redefine "
        "existing string 'units'",
        "model.urdf: warning: axis X: no acceleration is stated: 2000 mm/s2 is taken",
        "model.urdf: warning: axis Y: no acceleration is stated: 2000 mm/s2 is taken",
        "model.urdf: warning: axis Z: no acceleration is stated: 2000 mm/s2 is taken",
        "model.urdf: warning: axis B: no acceleration is stated: 500 deg/s2 is taken",
        "model.urdf: warning: axis C: no acceleration is stated: 500 deg/s2 is taken"}},
      {"fixed_joint.toml",
       {"model.toml:15:1: error: axis C: joint 'nose' is not revolute or continuous",
        "model.urdf:29: warning: joint 'C' is no axis of the control: it stays at 0"}},
      {"home_outside.toml", {"model.toml:5:1: error: axis X: home is outside the limits"}},
      {"honest_home_at_the_limit.toml", {}},
      {"inch.toml", {}},
      {"infinite_rapid.toml", {"model.toml:6:19: error: 'rapid_m_per_min' is infinite"}},
      {"negative_acceleration.toml",
       {"model.toml:7:26: error: 'acceleration_mm_per_s2' must be greater than 0, not -3000",
        "model.toml:5:1: warning: axis X: no acceleration is stated: 2000 mm/s2 is taken"}},
      {"no_dialect.toml", {"model.toml:29:1: error: the key 'dialect' is missing"}},
      {"no_schema.toml", {"model.toml:1:1: error: the key 'schema' is missing"}},
      {"no_units.toml", {"model.toml:1:1: error: the key 'units' is missing"}},
      {"order_names_axis_twice.toml",
       {"model.toml:24:9: error: 'order' must name axes, each once: \"XZ\""}},
      {"order_of_unknown_axis.toml",
       {"model.toml:24:9: error: 'order' must name axes, each once: \"XQ\""}},
      {"rotary_letter_on_linear_joint.toml",
       {"model.toml:15:1: error: axis C: joint 'Z' is not revolute or continuous",
        "model.urdf:29: warning: joint 'C' is no axis of the control: it stays at 0"}},
      {"rotary_rapid_in_m_per_min.toml", {"model.toml:13:1: error: unknown key 'rapid_m_per_min'"}},
      {"same_joint_twice.toml",
       {"model.toml:8:1: error: axis Y: joint 'X' is axis X already",
        "model.urdf:14: warning: joint 'Y' is no axis of the control: it stays at 0",
        "model.toml:21:1: error: tool change: axis Y is not there"}},
      {"schema_2.toml", {"model.toml:1:10: error: this ncsim reads schema 1 of this file"}},
      {"setting_of_wrong_type.toml",
       {"model.toml:34:15: error: 'setting 9' must be one of: inch, mm"}},
      {"setting_of_wrong_word.toml",
       {"model.toml:34:15: error: 'setting 9' must be one of: inch, mm"}},
      {"shapes_misspelt.toml",
       {"model.toml:4:10: error: 'shapes' must be \"nominal\" or \"measured\", not \"mesured\" "
        "(did you mean 'measured'?)"}},
      {"string_for_number.toml", {"model.toml:26:11: error: 'pockets' must be a whole number"}},
      {"tool_change_of_missing_axis.toml",
       {"model.toml:20:1: error: tool change: axis A is not there"}},
      {"tool_change_outside.toml",
       {"model.toml:20:1: error: tool change: axis X is outside its limits"}},
      {"units_cm.toml",
       {"model.toml:2:9: error: 'units' must be \"mm\" or \"inch\", not \"cm\" (did you mean "
        "'mm'?)"}},
      {"unknown_axis_letter.toml",
       {"model.toml:15:7: error: unknown key 'W'",
        "model.urdf:29: warning: joint 'C' is no axis of the control: it stays at 0"}},
      {"unknown_dialect.toml",
       {"model.toml:30:11: error: 'dialect' must be \"haas-ngc\" or \"sinumerik-840d\", not "
        "\"hass-ngc\" (did you mean 'haas-ngc'?)"}},
      {"unknown_frame.toml",
       {"model.toml:18:11: error: there is no link 'spindle_guage', the spindle frame (did you "
        "mean 'spindle_gauge'?)"}},
      {"unknown_joint.toml",
       {"model.toml:5:1: error: axis X: there is no joint 'XX' in the URDF (did you mean 'X'?)",
        "model.urdf:10: warning: joint 'X' is no axis of the control: it stays at 0",
        "model.toml:21:1: error: tool change: axis X is not there"}},
      {"unknown_key.toml",
       {"model.toml:27:1: error: unknown key 'max_tool_lenght' (did you mean 'max_tool_length'?)"}},
      {"unknown_section.toml",
       {"model.toml:17:2: error: unknown key 'spindel' (did you mean 'spindle'?)"}},
      {"unknown_setting.toml",
       {"model.toml:35:1: error: unknown key 'setting 5085' (did you mean 'setting 108'?)"}},
      {"complete.srdf", {}},
      {"honest_unread_element.srdf",
       {"model.srdf:2: warning: <collision_margins> in <robot> is not known: it is not read"}},
      {"margin_absurd.srdf",
       {"model.srdf:2: error: a clearance of 5 m is absurd: the greatest is 1 m (an SRDF is in "
        "metres)"}},
      {"margin_misspelt.srdf",
       {"model.srdf:2: error: <ncsim:margn> in <robot> is not known (did you mean "
        "'ncsim:margin'?)"}},
      {"margin_negative.srdf", {"model.srdf:2: error: a clearance must not be negative"}},
      {"margin_of_adjacent.srdf",
       {"model.srdf:3: warning: the model says that 'base_link' and 'x_slide' need no check: this "
        "margin judges nothing"}},
      {"margin_of_frame.srdf",
       {"model.srdf:2: warning: link 'workpiece_mount' has no shape: this margin judges nothing",
        "model.srdf:3: warning: link 'y_slide' has no shape: this margin judges nothing"}},
      {"margin_of_unknown_link.srdf",
       {"model.srdf:2: error: there is no link 'z_hed' in the URDF (did you mean 'z_head'?)"}},
      {"margin_twice.srdf", {"model.srdf:3: error: a second margin of 'b_trunnion' and 'z_head'"}},
      {"margin_without_clearance.srdf",
       {"model.srdf:2: error: <ncsim:margin clearance> is missing"}},
      {"misspelt_element.srdf",
       {"model.srdf:2: error: <disable_collision> in <robot> is not known (did you mean "
        "'disable_collisions'?)"}},
      {"no_reason.srdf",
       {"model.srdf:2: warning: no reason why 'base_link' and 'x_slide' need no check: taken as "
        "User"}},
      {"pair_of_one.srdf", {"model.srdf:2: error: a link is no pair with itself"}},
      {"pose_of_fixed_joint.srdf", {"model.srdf:2: error: joint 'nose' is fixed"}},
      {"pose_of_unknown_joint.srdf", {"model.srdf:2: error: there is no joint 'U' in the URDF"}},
      {"pose_outside_limits.srdf",
       {"model.srdf:2: error: pose 'home' puts joint 'Z' outside its limits"}},
      {"pose_twice.srdf", {"model.srdf:3: error: a second pose 'home'"}},
      {"pose_without_number.srdf",
       {"model.srdf:2: error: <joint value> must be a number, not \"up\""}},
      {"reason_never.srdf",
       {"model.srdf:2: warning: reason Never comes from sampling: 'base_link' and 'x_slide' stay "
        "checked",
        "model.srdf:3: warning: reason Default comes from sampling: 'base_link' and 'z_head' stay "
        "checked"}},
      {"unknown_link.srdf",
       {"model.srdf:2: error: there is no link 'x_slid' in the URDF (did you mean 'x_slide'?)"}},
      {"unknown_reason.srdf",
       {"model.srdf:2: error: reason \"adjacent\" is not known: Adjacent, User and Always are (did "
        "you mean 'Adjacent'?)"}},
  };
  return cases;
}

/// complete.urdf, .toml and .srdf as model.*, one of them replaced by `file` of
/// tests/reject/machines.
std::string Stage(const TempFolder& folder, const std::string& file) {
  namespace fs = std::filesystem;
  for (const char* extension : {".urdf", ".toml", ".srdf"}) {
    const bool replaced = fs::path(file).extension() == extension;
    fs::copy_file(RejectFile("machines/" + (replaced ? file : std::string("complete") + extension)),
                  folder.path() + "/model" + extension);
  }
  return folder.path() + "/model.urdf";
}

class MachineRejectTest : public ::testing::TestWithParam<RejectCase> {};

TEST_P(MachineRejectTest, SaysExactlyThis) {
  TempFolder folder;
  Diagnostics diagnostics;
  EXPECT_TRUE(LoadMachine(Stage(folder, GetParam().name), &diagnostics).has_value());
  EXPECT_THAT(Reported(diagnostics), ElementsAreArray(GetParam().reported));
}

std::string CaseName(const ::testing::TestParamInfo<RejectCase>& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Machines, MachineRejectTest, ::testing::ValuesIn(Cases()), CaseName);

TEST(MachineRejectTest, EveryFileHasACase) {
  std::vector<std::string> names;
  for (const RejectCase& c : Cases()) names.push_back(c.name);
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(RejectFile("machines"))) {
    if (entry.path().extension() != ".urdf") files.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(files, ::testing::UnorderedElementsAreArray(names));
}

class CompleteMachineTest : public ::testing::Test {
 protected:
  Machine Load(const std::string& file = "complete.urdf") {
    std::optional<Machine> machine = LoadMachine(Stage(folder_, file), &diagnostics_);
    EXPECT_TRUE(machine.has_value());
    return std::move(*machine);
  }

  TempFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(CompleteMachineTest, ReadsAxesInMmRadAndSeconds) {
  const Machine machine = Load();
  std::string letters;
  for (const Axis& axis : machine.axes) letters += axis.letter;
  EXPECT_EQ(letters, "XYZBC");
  const Axis& x = *machine.FindAxis('X');
  EXPECT_NEAR(x.lower, -600.0, 1e-9);
  EXPECT_NEAR(x.upper, 100.0, 1e-9);
  EXPECT_NEAR(x.rapid, 400.0, 1e-9);                       // 24 m/min
  EXPECT_NEAR(machine.FindAxis('Y')->rapid, 400.0, 1e-9);  // the URDF's 0.4 m/s
  EXPECT_NEAR(x.acceleration, 3000.0, 1e-9);
  EXPECT_NEAR(machine.FindAxis('Z')->home, 50.0, 1e-9);  // the SRDF's pose "home"
  const Axis& b = *machine.FindAxis('B');
  EXPECT_TRUE(b.rotary);
  EXPECT_NEAR(b.rapid, Radians(50.0), 1e-12);
  EXPECT_NEAR(b.acceleration, Radians(500.0), 1e-12);
  EXPECT_TRUE(std::isinf(machine.FindAxis('C')->upper));
  EXPECT_EQ(machine.FindAxis('A'), nullptr);
  EXPECT_FALSE(machine.nominal_shapes);
}

TEST_F(CompleteMachineTest, ReadsMarginsOfLinksInMm) {
  const Machine machine = Load();
  ASSERT_EQ(machine.margins.size(), 1u);
  EXPECT_EQ(machine.margins[0].link_a, machine.tree.FindLink("b_trunnion"));
  EXPECT_EQ(machine.margins[0].link_b, machine.tree.FindLink("z_head"));
  EXPECT_NEAR(machine.margins[0].clearance, 5.0, 1e-12);
}

// The gauge line stands at (X, Y, Z + 500) in M; the spindle is on the X, Y, Z side of all joints.
TEST_F(CompleteMachineTest, CoordinatesAreWhatTheControlShowsWithTheGaugeLineThere) {
  const Machine machine = Load();
  kinematics::JointVector q = machine.Home();
  q[machine.FindAxis('X')->joint] = -200.0;
  q[machine.FindAxis('B')->joint] = 0.3;
  const Eigen::Vector3d at = machine.Coordinates({10.0, -20.0, 450.0}, q);
  EXPECT_NEAR((at - Eigen::Vector3d(10.0, -20.0, -50.0)).norm(), 0.0, 1e-9);
}

TEST_F(CompleteMachineTest, ReadsTheControl) {
  const ControlData control = Load().control;
  EXPECT_EQ(control.dialect, "haas-ngc");
  EXPECT_EQ(control.settings.at("setting 9"), "inch");
  EXPECT_EQ(control.settings.at("setting 15"), "on");
  EXPECT_EQ(control.settings.at("setting 85"), "0.635");
  EXPECT_NEAR(control.numbers.at("setting 85"), 0.635, 1e-12);
  EXPECT_NEAR(control.numbers.at("setting 72"), Radians(45.0), 1e-12);
  EXPECT_EQ(control.tcp_rapid, "track");
  EXPECT_THAT(control.tool_change_order, ElementsAre("Z", "X", "Y"));
  EXPECT_EQ(control.tool_change_pose.size(), 3u);
  EXPECT_NEAR(control.tool_change_pose.at('X'), -500.0, 1e-12);
  EXPECT_FALSE(control.tool_change_nominal);
  EXPECT_EQ(control.tool_pockets, 40);
  EXPECT_THAT(control.subprogram_folders, ElementsAre(folder_.path() + "/subs"));
  EXPECT_THAT(control.m_codes_without_motion, ElementsAre(21, 22));
}

TEST_F(CompleteMachineTest, InchesScaleLengthsButNotWhatNamesItsUnit) {
  const Machine machine = Load("inch.toml");
  EXPECT_NEAR(machine.FindAxis('X')->rapid, 400.0, 1e-9);
  EXPECT_NEAR(machine.FindAxis('X')->acceleration, 3000.0, 1e-9);
  EXPECT_NEAR(machine.FindAxis('X')->home, -25.4, 1e-9);
  EXPECT_NEAR(machine.FindAxis('B')->home, Radians(-10.0), 1e-12);
  EXPECT_NEAR(machine.control.tool_change_pose.at('X'), -508.0, 1e-9);
  EXPECT_NEAR(machine.control.max_tool_length, 304.8, 1e-9);
  EXPECT_NEAR(machine.control.numbers.at("setting 85"), 0.635, 1e-9);
  ASSERT_TRUE(machine.control.rotary_centre.has_value());
  EXPECT_NEAR(machine.control.rotary_centre->x(), -254.0, 1e-9);
  EXPECT_NEAR(machine.control.rotary_centre->y(), -250.0, 1e-9);  // as the URDF has it
  EXPECT_TRUE(machine.nominal_shapes);                            // not called measured
}

// By hand from complete.urdf: X and Z of the B axis (-300, 100), Y of the C axis (-200 - 50); the
// gauge line stands at Z 500 at Z0.
TEST_F(CompleteMachineTest, TheRotaryCentreFollowsFromTheUrdf) {
  const Machine machine = Load();
  ASSERT_TRUE(machine.control.rotary_centre.has_value());
  EXPECT_LT((*machine.control.rotary_centre - Eigen::Vector3d(-300.0, -250.0, -400.0)).norm(),
            1e-9);
}

TEST_F(CompleteMachineTest, ReadsPairsAndPoses) {
  const Machine machine = Load();
  ASSERT_EQ(machine.disabled_pairs.size(), 3u);
  EXPECT_EQ(machine.disabled_pairs[0].reason, "Adjacent");
  EXPECT_LT(machine.disabled_pairs[1].link_a, machine.disabled_pairs[1].link_b);
  const auto& pose = machine.named_poses.at("tool_change");
  EXPECT_NEAR(pose[machine.FindAxis('X')->joint], -500.0, 1e-9);
  EXPECT_NEAR(pose[machine.FindAxis('B')->joint], 0.1, 1e-12);
  EXPECT_NEAR(pose[machine.FindAxis('Z')->joint], 50.0, 1e-9);  // what it does not name is at home
}

TEST_F(CompleteMachineTest, InspectPrintsItInWords) {
  const Machine machine = Load();
  const std::string text = Inspect(machine, diagnostics_);
  for (const char* line :
       {"tool side:  base_link -> [X] x_slide -> [Y] y_slide -> [Z] z_head -> spindle_gauge\n",
        "table side: base_link -> [B] b_trunnion -> [C] c_platter -> workpiece_mount\n",
        "  X  -600 to 100 mm, rapid 24 m/min, acceleration 3000 mm/s2, home 0 mm\n",
        "  C  endless, rapid 51.5662 deg/s, acceleration 500 deg/s2, home 0 deg\n",
        "  base_link: 12 triangles, 1000 x 1000 x 100, closed\n", "  y_slide: a frame, no shape\n",
        "  x_slide, z_head: User\n", "margins of pairs\n  b_trunnion, z_head: 5 mm\n",
        "  tool_change: X-500 Y0 Z50 B5.73 C0\n",
        "  rotary centre (gauge line at the pivot): X Y Z -300 -250 -400\n",
        "  tool change: X-500 Y-100 Z0, order Z X Y, measured\n", "lint: nothing found\n"}) {
    EXPECT_THAT(text, ::testing::HasSubstr(line));
  }
}

TEST_F(CompleteMachineTest, WithoutTomlAndSrdfItSaysWhatIsMissing) {
  const std::string path = Stage(folder_, "complete.urdf");
  std::filesystem::remove(folder_.path() + "/model.toml");
  std::filesystem::remove(folder_.path() + "/model.srdf");
  const std::optional<Machine> machine = LoadMachine(path, &diagnostics_);
  ASSERT_TRUE(machine.has_value());
  EXPECT_EQ(machine->axes.size(), 5u);  // the joints named X Y Z B C
  EXPECT_TRUE(machine->five_axis.has_value());
  EXPECT_FALSE(diagnostics_.has_errors());
  EXPECT_THAT(Reported(diagnostics_)[0],
              "model.toml: warning: no such file: the model says nothing about its control");
  EXPECT_THAT(
      Reported(diagnostics_)[1],
      "model.srdf: warning: no such file: every pair of links is checked, adjacent ones too");
}

// ISO 841: plus means that the tool moves plus against the part. A table that turns the other way
// is the classic slip.
TEST_F(CompleteMachineTest, ATableAxisOfTheWrongSenseIsReported) {
  const std::string path = Stage(folder_, "complete.urdf");
  std::ifstream in(path);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  text.replace(text.find("0 -1 0"), 6, "0 1 0");
  folder_.Write("model.urdf", text);
  LoadMachine(path, &diagnostics_);
  EXPECT_THAT(Reported(diagnostics_),
              ElementsAre("model.urdf:25: warning: axis B points the wrong way for the table side: "
                          "plus must mean that the tool moves plus against the part"));
}

TEST(FindModelTest, LooksWhereThePageSays) {
  TempFolder folder;
  const std::string direct = folder.Write("direct.urdf", "");
  folder.Write("a/models/one/umc.urdf", "");
  folder.Write("a/models/two.urdf", "");
  folder.Write("prefix/share/ncsim/models/shipped/shipped.urdf", "");
  std::filesystem::create_directories(folder.path() + "/prefix/bin");
  const std::string program = folder.path() + "/prefix/bin";
  ::setenv("NCSIM_MODELS", (folder.path() + "/none:" + folder.path() + "/a/models").c_str(), 1);
  EXPECT_EQ(FindModel(direct, program), direct);
  EXPECT_EQ(FindModel("umc", program), folder.path() + "/a/models/one/umc.urdf");
  EXPECT_EQ(FindModel("umc.urdf", program), folder.path() + "/a/models/one/umc.urdf");
  EXPECT_EQ(FindModel("two", program), folder.path() + "/a/models/two.urdf");
  EXPECT_THAT(FindModel("shipped", program), ::testing::EndsWith("shipped/shipped.urdf"));
  EXPECT_EQ(FindModel("QQQ", program), "");
  EXPECT_EQ(FindModel("", program), "");
  ::unsetenv("NCSIM_MODELS");
  EXPECT_THAT(FindModel("umc750.urdf", program), ::testing::EndsWith("haas_umc750/umc750.urdf"));
}

}  // namespace
}  // namespace ncsim::machine
