// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "sim/machine/mesh_check.h"
#include "sim/machine/test_files.h"

namespace ncsim::machine {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// tests/reject/machines/complete.*: pivot at machine X-300 Y-250, 100 mm above the machine frame;
/// the table mount 50 mm below it.
class SceneTest : public ::testing::Test {
 protected:
  SceneTest() {
    machine_ = *LoadMachine(RejectFile("machines/complete.urdf"), &diagnostics_);
    EXPECT_THAT(Reported(diagnostics_), IsEmpty());
  }

  Job Read(const std::string& text) {
    return *LoadJob(folder_.Write("job.toml", "schema = 1\nunits = \"mm\"\n" + text),
                    &diagnostics_);
  }
  std::map<char, double> Values(const Job& job, const std::string& name) {
    return OffsetValues(machine_, job, name, &diagnostics_).value_or(std::map<char, double>());
  }
  const SceneBody* Find(const Scene& scene, const std::string& name) {
    for (const SceneBody& body : scene.bodies) {
      if (body.name == name) return &body;
    }
    return nullptr;
  }

  TempFolder folder_;
  Diagnostics diagnostics_;
  Machine machine_;
};

// A machine data number on a Haas, a Haas setting on a SINUMERIK: nobody would look at it.
TEST_F(SceneTest, WhatIsForAnotherControlIsRefused) {
  const std::string sinumerik =
      "[control]\n\"MD21104\" = 0\ndata_files = [\"a.ini\"]\n[[tool]]\n"
      "number = 3\nlength = 100.0\nholder = []\nedges = [ { number = 1 } ]\n"
      "cutter = { type = \"end\", diameter = 6.0, flute_length = 100.0 }\n";
  const std::string both = "[control]\nblock_skip = true\noptional_stop = true\n";
  BuildScene(machine_, Read(both), &diagnostics_);
  EXPECT_THAT(Reported(diagnostics_), IsEmpty());
  BuildScene(machine_, Read(sinumerik), &diagnostics_);
  EXPECT_THAT(
      Reported(diagnostics_),
      ElementsAre("job.toml: error: 'MD21104' is no setting of the machine's control, haas-ngc",
                  "job.toml: error: 'data_files' are not for the machine's control, haas-ngc",
                  "job.toml: error: T3: 'edges' are not for the machine's control, haas-ngc"));
  machine_.control.dialect = "sinumerik-840d";
  Diagnostics others;
  BuildScene(machine_, Read(sinumerik), &others);
  BuildScene(machine_, Read(both), &others);
  EXPECT_THAT(Reported(others), IsEmpty());
  BuildScene(machine_, Read("[control]\n\"setting 9\" = \"mm\"\n"), &others);
  EXPECT_THAT(
      Reported(others),
      ElementsAre(
          "job.toml: error: 'setting 9' is no setting of the machine's control, sinumerik-840d"));
}

TEST_F(SceneTest, ValuesAsEnteredAreTakenWithZerosForTheRest) {
  const auto values =
      Values(Read("[offsets]\nG54 = { X = -300.0, Z = -410.0, C = 45.0 }\n"), "G54");
  EXPECT_EQ(values.size(), 6u);
  EXPECT_EQ(values.at('X'), -300.0);
  EXPECT_EQ(values.at('Y'), 0.0);
  EXPECT_NEAR(values.at('C'), Radians(45.0), 1e-12);
}

// The mount stands at machine (-300, -250, 50); the gauge line at Z0 is at height 500.
TEST_F(SceneTest, APlacedOffsetBecomesTheValuesThatPutTheGaugeLineThere) {
  const Job job =
      Read("[offsets]\nG55 = { on = \"workpiece_mount\", xyz = [10.0, 20.0, 120.0] }\n");
  const auto values = Values(job, "G55");
  EXPECT_NEAR(values.at('X'), -290.0, 1e-9);
  EXPECT_NEAR(values.at('Y'), -230.0, 1e-9);
  EXPECT_NEAR(values.at('Z'), -330.0, 1e-9);
}

// At B90 the platter's normal points to machine -X and part +X points up (ISO 841; Haas UMC): the
// point (10, 20, 120 - 50) from the pivot goes to (-70, 20, 10).
TEST_F(SceneTest, AnOffsetAtATiltedTableFollowsTheMetal) {
  const Job job =
      Read("[offsets]\nG55 = { on = \"workpiece_mount\", xyz = [10.0, 20.0, 120.0], B = 90.0 }\n");
  const auto values = Values(job, "G55");
  EXPECT_NEAR(values.at('X'), -370.0, 1e-9);
  EXPECT_NEAR(values.at('Y'), -230.0, 1e-9);
  EXPECT_NEAR(values.at('Z'), -390.0, 1e-9);
  // As a frame it rides on the table: origin back at the point, and its x axis is machine X, which
  // at B90 is table -Z.
  const Eigen::Isometry3d X_BP = OffsetFrame(machine_, values);
  EXPECT_LT((X_BP.translation() - Eigen::Vector3d(10.0, 20.0, 120.0)).norm(), 1e-9);
  EXPECT_LT((X_BP.linear().col(0) + Eigen::Vector3d::UnitZ()).norm(), 1e-9);
}

// C90: part +X points to machine -Y, as the table turns clockwise seen from above.
TEST_F(SceneTest, AnOffsetAtATurnedTableHasMachineDirections) {
  const Eigen::Isometry3d X_BP = OffsetFrame(machine_, {{'C', Radians(90.0)}});
  EXPECT_LT((X_BP.linear().col(1) + Eigen::Vector3d::UnitX()).norm(), 1e-9);
}

TEST_F(SceneTest, BodiesStandOnLinksFixturesAndOffsets) {
  const Job job = Read(R"([offsets]
G54 = { on = "riser", xyz = [0.0, 0.0, 50.0] }
[[fixture]]
name = "pin"
box = [2.0, 2.0, 4.0]
at = { on = "riser", xyz = [20.0, 0.0, 50.0] }
[[fixture]]
name = "riser"
box = [100.0, 80.0, 50.0]
at = { on = "workpiece_mount", xyz = [0.0, 0.0, 5.0], rpy_deg = [0.0, 0.0, 90.0] }
[[fixture]]
name = "camera"
box = [2.0, 2.0, 2.0]
at = { on = "z_head" }
[part]
box = [10.0, 10.0, 10.0]
at = { on = "G54", xyz = [1.0, 0.0, 0.0] }
)");
  const Scene scene = BuildScene(machine_, job, &diagnostics_);
  EXPECT_THAT(Reported(diagnostics_), IsEmpty());
  EXPECT_EQ(scene.bodies.size(), machine_.bodies.size() + 4);
  Eigen::Vector3d lower, upper;
  BoundingBox(Find(scene, "riser")->mesh, &lower, &upper);
  EXPECT_LT((upper - Eigen::Vector3d(40.0, 50.0, 55.0)).norm(), 1e-9);
  BoundingBox(Find(scene, "pin")->mesh, &lower, &upper);
  EXPECT_LT((upper - Eigen::Vector3d(1.0, 21.0, 59.0)).norm(), 1e-9);
  BoundingBox(Find(scene, "part")->mesh, &lower, &upper);  // machine directions, not the riser's
  EXPECT_LT((upper - Eigen::Vector3d(6.0, 5.0, 65.0)).norm(), 1e-9);
  EXPECT_EQ(Find(scene, "part")->link, machine_.table_link);
  EXPECT_EQ(Find(scene, "camera")->link, machine_.tree.FindLink("z_head"));
}

TEST_F(SceneTest, PlacementsThatLeadNowhereAreErrors) {
  const Job job = Read(R"([offsets]
G54 = { on = "y_slide" }
[[fixture]]
name = "a"
box = [1.0, 1.0, 1.0]
at = { on = "b" }
[[fixture]]
name = "b"
box = [1.0, 1.0, 1.0]
at = { on = "a" }
[[fixture]]
name = "c"
box = [1.0, 1.0, 1.0]
at = { on = "workpiece_mout" }
[[fixture]]
name = "d"
box = [1.0, 1.0, 1.0]
at = { on = "G55" }
[[fixture]]
name = "z_head"
box = [1.0, 1.0, 1.0]
at = { on = "base_link" }
[part]
box = [1.0, 1.0, 1.0]
at = { on = "G54" }
)");
  const Scene scene = BuildScene(machine_, job, &diagnostics_);
  EXPECT_EQ(scene.bodies.size(), machine_.bodies.size());
  EXPECT_THAT(
      Reported(diagnostics_),
      ElementsAre(
          "job.toml:8:13: error: 'b' is placed on itself, through others",
          "job.toml:12:13: error: 'a' is placed on itself, through others",
          "job.toml:16:13: error: there is no link, fixture or work offset 'workpiece_mout' "
          "(did you mean 'workpiece_mount'?)",
          "job.toml:20:13: error: the job states no work offset G55",
          "job.toml:24:13: error: 'z_head' is the name of a part of the machine",
          "job.toml:4:14: error: 'y_slide' does not ride on the table: G54 cannot be placed "
          "on it"));
}

TEST_F(SceneTest, NothingIsPlacedOnAnOffsetOfATouchOffLength) {
  const std::string tool =
      "[[tool]]\nnumber = 3\nlength = 120.0\nh_geometry = -300.0\nholder = []\n"
      "cutter = { type = \"end\", diameter = 6.0, flute_length = 120.0 }\n"
      "[part]\nbox = [1.0, 1.0, 1.0]\nat = { on = \"G54\" }\n";
  BuildScene(machine_, Read("[offsets]\nG54 = { X = -300.0 }\n" + tool), &diagnostics_);
  EXPECT_THAT(Reported(diagnostics_),
              ElementsAre("job.toml:13:13: error: nothing can be placed on G54: T3 has a touch-off "
                          "length (-300), so the offset's Z is not where the part is"));
  Diagnostics none;
  BuildScene(machine_, Read("[offsets]\nG54 = { on = \"workpiece_mount\" }\n" + tool), &none);
  EXPECT_THAT(Reported(none), IsEmpty());
}

}  // namespace
}  // namespace ncsim::machine
