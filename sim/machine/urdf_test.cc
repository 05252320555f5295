// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/urdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/machine/test_files.h"

namespace ncsim::machine {
namespace {

using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

struct RejectCase {
  const char* name;
  bool leaves_a_tree;
  std::vector<std::string> reported;
};

// A planted fault a file, with the exact text; honest_* come as near as honest input can and are
// silent.
const std::vector<RejectCase>& Cases() {
  static const std::vector<RejectCase> cases = {
      {"bad_origin",
       false,
       {"bad_origin.urdf:4: error: <origin xyz> must be 3 numbers, not \"0 0\""}},
      {"blank_after_number",
       false,
       {"blank_after_number.urdf:8: error: <limit velocity> must be a number, not \"0.3 \""}},
      {"child_of_two_joints",
       false,
       {"child_of_two_joints.urdf:15: error: link 'b' is the child of two joints"}},
      {"comma_in_number",
       false,
       {"comma_in_number.urdf:8: error: <limit lower> must be a number, not \"-0,381\""}},
      {"duplicate_joint",
       false,
       {"duplicate_joint.urdf:10: error: a second joint 'j'; the first is on line 5"}},
      {"duplicate_link",
       false,
       {"duplicate_link.urdf:4: error: a second link 'b'; the first is on line 3"}},
      {"empty", false, {"empty.urdf: error: not XML: XML_ERROR_EMPTY_DOCUMENT"}},
      {"empty_geometry", true, {"empty_geometry.urdf:4: error: <geometry> is empty"}},
      {"honest_axis_rounding", true, {}},
      {"honest_blanks_in_numbers", true, {}},
      {"honest_comment_with_xacro", true, {}},
      {"honest_continuous", true, {}},
      {"honest_extensions", true, {}},
      {"honest_inertial_and_shapes", true, {}},
      {"honest_smallest_travel", true, {}},
      {"honest_twelve_joints", true, {}},
      {"limit_without_velocity",
       false,
       {"limit_without_velocity.urdf:8: error: <limit velocity> is missing"}},
      {"long_axis",
       true,
       {"long_axis.urdf:7: warning: the axis of joint 'j' is not a unit vector (length 2): "
        "normalised"}},
      {"loop",
       false,
       {"loop.urdf:1: error: the joints form a loop: not all links hang on the root"}},
      {"lower_above_upper",
       true,
       {"lower_above_upper.urdf:8: error: joint 'j': lower 0.5 is above upper -0.5"}},
      {"malformed_box",
       true,
       {"malformed_box.urdf:4: error: <box size> must be 3 numbers, not \"1 1\""}},
      {"malformed_inertial",
       true,
       {"malformed_inertial.urdf:2: error: link 'a': urdfdom kept 0 of its 1 shapes (Inertial: "
        "mass [heavy] is not a float; Could not parse inertial element for Link [a])"}},
      {"mesh_without_filename",
       true,
       {"mesh_without_filename.urdf:4: error: <mesh> has no filename"}},
      {"mimic", true, {"mimic.urdf:16: error: mimic joints are not supported"}},
      {"mimic_of_nothing",
       true,
       {"mimic_of_nothing.urdf:9: error: mimics joint 'k', which is not there"}},
      {"missing_axis",
       true,
       {"missing_axis.urdf:4: warning: joint 'j' has no <axis>: URDF means 1 0 0"}},
      {"misspelt_collision",
       true,
       {"misspelt_collision.urdf:3: error: <colision> in <link> is not known (did you mean "
        "'collision'?)"}},
      {"nan_limit",
       false,
       {"nan_limit.urdf:8: error: <limit lower> must be a number, not \"nan\""}},
      {"negative_radius",
       true,
       {"negative_radius.urdf:4: error: <cylinder radius> must be greater than 0, not -0.1"}},
      {"no_limit", false, {"no_limit.urdf:4: error: joint 'j' has no <limit>"}},
      {"no_link", false, {"no_link.urdf:1: error: there is no link"}},
      {"no_robot_name", false, {"no_robot_name.urdf:1: error: <robot> has no name"}},
      {"no_travel",
       true,
       {"no_travel.urdf:8: error: joint 'j' has no travel: lower and upper are 0"}},
      {"not_a_robot", false, {"not_a_robot.urdf:1: error: the root element must be <robot>"}},
      {"not_xml", false, {"not_xml.urdf:2: error: not XML: XML_ERROR_MISMATCHED_ELEMENT"}},
      {"planar_joint",
       false,
       {"planar_joint.urdf:4: error: joint 'j': type 'planar' is not supported: fixed, prismatic, "
        "revolute and continuous are"}},
      {"tabs_in_vector",
       false,
       {"tabs_in_vector.urdf:4: error: <origin xyz> must be 3 numbers, not \"0\t0\t0.5\""}},
      {"thirteen_joints", false, {"thirteen_joints.urdf:28: error: more than 12 joints move"}},
      {"two_roots",
       false,
       {"two_roots.urdf:4: error: a machine has one root link; 'a' and 'c' are both nobody's "
        "child"}},
      {"two_shapes_in_one_geometry",
       true,
       {"two_shapes_in_one_geometry.urdf:4: error: a second shape in one <geometry>: give it a "
        "<collision> of its own"}},
      {"unknown_child",
       false,
       {"unknown_child.urdf:6: error: there is no link 'bb' (did you mean 'b'?)"}},
      {"unknown_geometry",
       true,
       {"unknown_geometry.urdf:4: error: <capsule> is no URDF geometry: box, cylinder, sphere and "
        "mesh are"}},
      {"unknown_joint_type",
       false,
       {"unknown_joint_type.urdf:4: error: joint 'j': type 'revolut' is not supported: fixed, "
        "prismatic, revolute and continuous are"}},
      {"version_2", false, {"version_2.urdf:1: error: URDF version 2.0 is not read: only 1.0 is"}},
      {"xacro_expression",
       false,
       {"xacro_expression.urdf:4: error: this is xacro, not URDF: expand it first (xacro IN > "
        "OUT.urdf)"}},
      {"xacro_macro",
       false,
       {"xacro_macro.urdf:2: error: this is xacro, not URDF: expand it first (xacro IN > "
        "OUT.urdf)"}},
      {"zero_axis", false, {"zero_axis.urdf:7: error: the axis of joint 'j' has no length"}},
      {"zero_scale", true, {"zero_scale.urdf:4: error: <mesh scale> has a 0"}},
  };
  return cases;
}

class UrdfRejectTest : public ::testing::TestWithParam<RejectCase> {};

TEST_P(UrdfRejectTest, SaysExactlyThis) {
  Diagnostics diagnostics;
  const auto urdf =
      ReadUrdf(RejectFile("models/" + std::string(GetParam().name) + ".urdf"), &diagnostics);
  EXPECT_THAT(Reported(diagnostics), ElementsAreArray(GetParam().reported));
  EXPECT_EQ(urdf.has_value(), GetParam().leaves_a_tree);
}

INSTANTIATE_TEST_SUITE_P(Models, UrdfRejectTest, ::testing::ValuesIn(Cases()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(UrdfRejectTest, EveryFileHasACase) {
  std::vector<std::string> names;
  for (const RejectCase& c : Cases()) names.push_back(std::string(c.name) + ".urdf");
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(RejectFile("models"))) {
    if (entry.path().extension() == ".urdf") files.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(files, ::testing::UnorderedElementsAreArray(names));
}

TEST(UrdfTest, NothingIsPrinted) {
  Diagnostics diagnostics;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  ReadUrdf(RejectFile("models/unknown_geometry.urdf"), &diagnostics);
  ReadUrdf(RejectFile("models/malformed_inertial.urdf"), &diagnostics);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(UrdfTest, ConvertsMetresAndKeepsTheOrderOfTheFile) {
  TempFolder folder;
  const std::string path = folder.Write("m.urdf", R"(<robot name="m">
    <link name="z"/><link name="root"><collision><origin xyz="0 0 0.5"/>
      <geometry><box size="0.1 0.2 0.3"/></geometry></collision></link><link name="y"/>
    <joint name="Z" type="prismatic"><parent link="root"/><child link="z"/><origin xyz="0.1 0 0"/>
      <axis xyz="0 0 2"/><limit lower="-0.4445" upper="0.0635" effort="0" velocity="0.5"/></joint>
    <joint name="C" type="continuous"><parent link="root"/><child link="y"/><axis xyz="0 0 -1"/>
      <limit effort="0" velocity="0.8"/></joint></robot>)");
  Diagnostics diagnostics;
  const auto urdf = ReadUrdf(path, &diagnostics);
  ASSERT_TRUE(urdf.has_value());
  const auto& z = urdf->tree.joints()[static_cast<std::size_t>(urdf->tree.FindJoint("Z"))];
  EXPECT_EQ(z.index, 0);
  EXPECT_NEAR(z.lower, -444.5, 1e-9);
  EXPECT_NEAR(z.upper, 63.5, 1e-9);
  EXPECT_EQ(z.axis, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(z.X_PJ.translation().x(), 100.0, 1e-12);
  EXPECT_NEAR(urdf->velocity.at("Z"), 500.0, 1e-12);
  EXPECT_NEAR(urdf->velocity.at("C"), 0.8, 1e-12);
  const auto& c = urdf->tree.joints()[static_cast<std::size_t>(urdf->tree.FindJoint("C"))];
  EXPECT_TRUE(std::isinf(c.lower) && std::isinf(c.upper));
  const std::vector<LinkBody> bodies = MakeBodies(*urdf, path, &diagnostics);
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0].link, 0);  // the root, though not first in the file
  for (const Eigen::Vector3d& v : bodies[0].mesh.vertices) {
    EXPECT_NEAR(std::abs(v.x()), 50.0, 1e-9);
    EXPECT_NEAR(std::abs(v.z() - 500.0), 150.0, 1e-9);
  }
}

TEST(UrdfTest, LaterShapesAreNumberedAndAVisualStandsInForNoCollision) {
  TempFolder folder;
  const std::string path = folder.Write("m.urdf", R"(<robot name="m">
<link name="a">
  <visual><geometry><box size="9 9 9"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision>
  <collision><geometry><sphere radius="0.01"/></geometry></collision>
</link>
<link name="b">
  <visual><geometry><box size="2 2 2"/></geometry></visual>
</link>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>)");
  Diagnostics diagnostics;
  const auto urdf = ReadUrdf(path, &diagnostics);
  ASSERT_TRUE(urdf.has_value());
  const std::vector<LinkBody> bodies = MakeBodies(*urdf, path, &diagnostics);
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_EQ(bodies[0].name, "a");
  EXPECT_EQ(bodies[1].name, "a/2");
  EXPECT_EQ(bodies[2].name, "b");
  EXPECT_THAT(Reported(diagnostics),
              ::testing::ElementsAre("m.urdf:8: warning: link 'b' has no <collision>: its <visual> "
                                     "is checked instead"));
}

// The metal lies inside: 0.3 m of radius is past what 20,000 triangles can follow to 0.005 mm.
TEST(UrdfTest, ALargeSphereSaysHowMuchLargerItIsChecked) {
  TempFolder folder;
  const std::string path = folder.Write("m.urdf", R"(<robot name="m"><link name="a">
<collision><geometry><sphere radius="0.3"/></geometry></collision></link></robot>)");
  Diagnostics diagnostics;
  const auto urdf = ReadUrdf(path, &diagnostics);
  ASSERT_TRUE(urdf.has_value());
  MakeBodies(*urdf, path, &diagnostics);
  EXPECT_THAT(Reported(diagnostics), ::testing::SizeIs(1));
  EXPECT_THAT(Reported(diagnostics)[0],
              ::testing::StartsWith("m.urdf:2: warning: a round shape of link 'a' is checked 0.0"));
}

class MeshUriTest : public ::testing::Test {
 protected:
  std::string Resolve(const std::string& uri) {
    reason_.clear();
    const std::string path = ResolveMeshUri(uri, urdf_, &reason_);
    return path.starts_with(folder_.path()) ? path.substr(folder_.path().size()) : path;
  }

  TempFolder folder_;
  std::string urdf_ = folder_.Write("src/robot_folder/urdf/r.urdf", "");
  std::string reason_;
};

TEST_F(MeshUriTest, ResolvesPackagesFilesAndRelativePaths) {
  folder_.Write("src/robot_folder/package.xml", "<package>\n<name> my_robot </name></package>");
  folder_.Write("src/other_package/meshes/a.stl", "");
  EXPECT_EQ(Resolve("package://my_robot/meshes/a.stl"), "/src/robot_folder/meshes/a.stl");
  EXPECT_EQ(Resolve("package://robot_folder/meshes/a.stl"), "/src/robot_folder/meshes/a.stl");
  EXPECT_EQ(Resolve("package://other_package/meshes/a.stl"), "/src/other_package/meshes/a.stl");
  EXPECT_EQ(Resolve("model://robot_folder/a.stl"), "/src/robot_folder/a.stl");
  EXPECT_EQ(Resolve("../meshes/a.stl"), "/src/robot_folder/meshes/a.stl");
  EXPECT_EQ(Resolve("file:///opt/a.stl"), "/opt/a.stl");
}

TEST_F(MeshUriTest, SaysWhyNot) {
  EXPECT_EQ(Resolve("package://my_robot_QQQ/meshes/a.stl"), "");
  EXPECT_EQ(reason_, "no folder above the URDF is the package 'my_robot_QQQ'");
  EXPECT_EQ(Resolve("package://"), "");
  EXPECT_EQ(Resolve("package:///a.stl"), "");
  EXPECT_EQ(Resolve("https://example.org/a.stl"), "");
  EXPECT_EQ(reason_,
            "'https://' is not read: package://, model://, file:// and relative paths are");
}

}  // namespace
}  // namespace ncsim::machine
