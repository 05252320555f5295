// SPDX-License-Identifier: BSD-3-Clause
// Third-party machines and meshes. The outside source of a triangle count is the STL file's own
// header (bytes 80-83), or the number of its "facet normal" lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <vector>

#include "sim/machine/load.h"
#include "sim/machine/mesh_check.h"
#include "sim/machine/mesh_file.h"
#include "sim/machine/test_files.h"

namespace ncsim::machine {
namespace {

std::string Bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(in)), {});
}

/// What an STL file states: its triangles, and how many of them have a corner twice (those carry no
/// area and are dropped).
struct Stated {
  std::size_t triangles = 0;
  std::size_t without_area = 0;
};

Stated ReadStated(const std::string& bytes) {
  std::vector<std::array<float, 3>> corners;
  Stated stated;
  if (bytes.find("endsolid") != std::string::npos) {
    for (std::size_t at = bytes.find("vertex "); at != std::string::npos;
         at = bytes.find("vertex ", at + 1)) {
      std::array<float, 3> corner{};
      std::istringstream(bytes.substr(at + 7, 120)) >> corner[0] >> corner[1] >> corner[2];
      corners.push_back(corner);
    }
    stated.triangles = corners.size() / 3;
  } else {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, 4);
    stated.triangles = count;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::memcpy(corners.emplace_back().data(), bytes.data() + 84 + 50 * i + 12 + 12 * k, 12);
      }
    }
  }
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const bool twice = corners[i] == corners[i + 1] || corners[i + 1] == corners[i + 2] ||
                       corners[i + 2] == corners[i];
    stated.without_area += twice ? 1 : 0;
  }
  return stated;
}

TEST(CorpusTest, EveryStlLoadsWithTheTrianglesThatItStates) {
  NCSIM_REQUIRE_CORPUS();
  int files = 0, closed = 0;
  for (const char* folder : {"urdf", "haas/umc750-ubc"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(CorpusFile(folder))) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".stl" && extension != ".STL") continue;
      const MeshFile file = ReadMeshFile(entry.path().string(), Eigen::Vector3d::Ones());
      ++files;
      closed += file.mesh.watertight;
      EXPECT_GT(file.mesh.triangles.size(), 0u) << entry.path();
      const Stated stated = ReadStated(Bytes(entry.path()));
      // These are open by slivers narrower than 1e-6 of their size: welding closes them, and drops
      // four triangles.
      const bool slivers = entry.path().stem().string().starts_with("Hip");
      EXPECT_EQ(file.mesh.triangles.size() + (slivers ? 4 : 0),
                stated.triangles - stated.without_area)
          << entry.path();
      if (!file.mesh.watertight) {
        EXPECT_NE(file.defect, "") << entry.path();
      }
    }
  }
  RecordProperty("files", files);
  RecordProperty("closed", closed);
  EXPECT_GT(files, 90);
}

// The part of the real five-axis program: 4 x 4 x 3 in, program zero at a bottom corner.
TEST(CorpusTest, TheUmcPartIsClosedAndInInches) {
  NCSIM_REQUIRE_CORPUS();
  const std::string path = CorpusFile("haas/umc750-ubc/FinalWorkpieceForFIVEAxisMachining.stl");
  const MeshFile file = ReadMeshFile(path, Eigen::Vector3d::Constant(25.4));
  EXPECT_EQ(file.defect, "");
  EXPECT_EQ(file.mesh.triangles.size(), ReadStated(Bytes(path)).triangles);
  Eigen::Vector3d lower, upper;
  BoundingBox(file.mesh, &lower, &upper);
  EXPECT_LT(lower.norm(), 0.01);
  EXPECT_LT((upper - Eigen::Vector3d(101.6, 101.6, 76.2)).norm(), 0.01);
}

// Package name from package.xml (moveit_resources_fanuc_description), folder fanuc_description.
TEST(CorpusTest, FanucLoadsThroughItsPackage) {
  NCSIM_REQUIRE_CORPUS();
  const std::string folder = CorpusFile("urdf/moveit/fanuc_description/");
  Diagnostics diagnostics;
  const auto machine = LoadMachine(folder + "urdf/fanuc.urdf", &diagnostics);
  ASSERT_TRUE(machine.has_value());
  EXPECT_EQ(machine->tree.num_moving(), 6);
  ASSERT_EQ(machine->bodies.size(), 7u);
  for (const LinkBody& body : machine->bodies) {
    EXPECT_EQ(body.defect, "") << body.name;
    EXPECT_EQ(body.mesh.triangles.size(),
              ReadStated(Bytes(folder + "meshes/collision/" + body.name + ".stl")).triangles);
  }
  EXPECT_TRUE(diagnostics.has_errors());  // a robot has no spindle_gauge
}

TEST(CorpusTest, PandaSaysThatItsFingerMimics) {
  NCSIM_REQUIRE_CORPUS();
  Diagnostics diagnostics;
  const auto machine =
      LoadMachine(CorpusFile("urdf/moveit/panda_description/urdf/panda.urdf"), &diagnostics);
  ASSERT_TRUE(machine.has_value());
  EXPECT_THAT(Reported(diagnostics),
              ::testing::Contains("panda.urdf:222: error: mimic joints are not supported"));
}

TEST(CorpusTest, TriAthleteHasTooManyJoints) {
  NCSIM_REQUIRE_CORPUS();
  Diagnostics diagnostics;
  LoadMachine(CorpusFile("urdf/urdf-loaders/urdf/TriATHLETE/urdf/TriATHLETE.URDF"), &diagnostics);
  EXPECT_THAT(Reported(diagnostics),
              ::testing::Contains("TriATHLETE.URDF:772: error: more than 12 joints move"));
}

}  // namespace
}  // namespace ncsim::machine
