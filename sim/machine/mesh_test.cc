// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <limits>

#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "sim/machine/mesh_check.h"
#include "sim/machine/mesh_file.h"
#include "sim/machine/primitives.h"
#include "sim/machine/test_files.h"

namespace ncsim::machine {
namespace {

/// The least and greatest distance of the surface's facets from the axis z (as infinite planes) and
/// of its vertices.
struct Radii {
  double inner = std::numeric_limits<double>::infinity();
  double outer = 0.0;
};

Radii CylinderRadii(const TriangleMesh& mesh) {
  Radii radii;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d n = (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                                  .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                                  .normalized();
    if (std::abs(n.z()) < 0.5) radii.inner = std::min(radii.inner, n.dot(a));
  }
  for (const auto& v : mesh.vertices) radii.outer = std::max(radii.outer, v.head<2>().norm());
  return radii;
}

TEST(PrimitivesTest, BoxIsClosedAndOutward) {
  TriangleMesh box = MakeBox({2.0, 3.0, 4.0});
  EXPECT_NEAR(SignedVolume(box), 24.0, 1e-12);
  EXPECT_EQ(CheckMesh(&box).defect, "");
  EXPECT_TRUE(box.watertight);
  EXPECT_EQ(box.triangles.size(), 12u);
}

TEST(PrimitivesTest, CylindersContainTheTrueOneWithinTheSagitta) {
  for (const double radius : {0.5, 6.0, 31.75, 250.0, 2000.0}) {
    double excess = 0.0;
    TriangleMesh mesh = MakeCylinder(radius, 100.0, &excess);
    const Radii radii = CylinderRadii(mesh);
    EXPECT_GE(radii.inner, radius * (1.0 - 1e-12)) << radius;
    EXPECT_LE(radii.outer, radius + kPrimitiveSagitta * (1.0 + 1e-6)) << radius;
    EXPECT_NEAR(radii.outer - radius, excess, 1e-9);
    EXPECT_LE(mesh.triangles.size(), static_cast<std::size_t>(kMaxPrimitiveTriangles));
    EXPECT_GT(SignedVolume(mesh), kPi * radius * radius * 100.0);
    EXPECT_EQ(CheckMesh(&mesh).defect, "");
  }
}

TEST(PrimitivesTest, SpheresContainTheTrueOne) {
  for (const double radius : {1.0, 5.0, 16.0, 100.0}) {
    double excess = 0.0;
    TriangleMesh mesh = MakeSphere(radius, &excess);
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
      const Eigen::Vector3d n = (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                                    .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                                    .normalized();
      ASSERT_GE(n.dot(a), radius * (1.0 - 1e-12));
    }
    for (const auto& v : mesh.vertices) ASSERT_LE(v.norm(), radius + excess + 1e-9);
    if (radius <= 16.0) {
      EXPECT_LE(excess, kPrimitiveSagitta) << radius;
    }
    EXPECT_LE(mesh.triangles.size(), static_cast<std::size_t>(kMaxPrimitiveTriangles));
    EXPECT_EQ(CheckMesh(&mesh).defect, "");
  }
}

/// Every triangle with corners of its own, as STL has them.
TriangleMesh Soup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    const int base = static_cast<int>(soup.vertices.size());
    for (const int i : t) soup.vertices.push_back(mesh.vertices[static_cast<std::size_t>(i)]);
    soup.triangles.push_back({base, base + 1, base + 2});
  }
  return soup;
}

TEST(CheckMeshTest, WeldsASoup) {
  TriangleMesh mesh = Soup(MakeBox({10.0, 10.0, 10.0}));
  EXPECT_EQ(CheckMesh(&mesh).defect, "");
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_TRUE(mesh.watertight);
}

TEST(CheckMeshTest, WeldsWhatRoundingTookApartButNoMore) {
  TriangleMesh mesh = Soup(MakeBox({100.0, 100.0, 100.0}));
  mesh.vertices[0].x() += 1e-5;  // diagonal 173 mm: tolerance 1.7e-4
  EXPECT_EQ(CheckMesh(&mesh).defect, "");
  EXPECT_EQ(mesh.vertices.size(), 8u);
  TriangleMesh torn = Soup(MakeBox({100.0, 100.0, 100.0}));
  torn.vertices[0].x() += 1e-3;
  EXPECT_THAT(CheckMesh(&torn).defect, ::testing::StartsWith("is not watertight: "));
}

TEST(CheckMeshTest, AHoleIsADefect) {
  TriangleMesh mesh = MakeBox({10.0, 10.0, 10.0});
  mesh.triangles.pop_back();
  EXPECT_EQ(CheckMesh(&mesh).defect, "is not watertight: 3 open edges");
  EXPECT_FALSE(mesh.watertight);
}

TEST(CheckMeshTest, ATurnedTriangleIsADefect) {
  TriangleMesh mesh = MakeBox({10.0, 10.0, 10.0});
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_EQ(CheckMesh(&mesh).defect, "is not watertight: 3 open edges");
}

TEST(CheckMeshTest, TrianglesThereTwiceAreADefect) {
  TriangleMesh mesh = MakeBox({10.0, 10.0, 10.0});
  mesh.triangles.insert(mesh.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  EXPECT_EQ(CheckMesh(&mesh).defect, "is not a solid: 12 triangles are there twice");
}

// Two solids that touch in an edge share it four times: closed all the same.
TEST(CheckMeshTest, TwoBoxesThatTouchInAnEdgeAreClosed) {
  TriangleMesh mesh = Soup(MakeBox({10.0, 10.0, 10.0}));
  TriangleMesh other = Soup(MakeBox({10.0, 10.0, 10.0}));
  Translate({10.0, 10.0, 0.0}, &other);
  const int base = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) {
    mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  EXPECT_EQ(CheckMesh(&mesh).defect, "");
  EXPECT_TRUE(mesh.watertight);
}

TEST(CheckMeshTest, InsideOutIsTurned) {
  TriangleMesh mesh = MakeBox({10.0, 10.0, 10.0});
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const MeshCheck check = CheckMesh(&mesh);
  EXPECT_EQ(check.defect, "");
  EXPECT_EQ(check.note, "is inside out; its triangles were turned");
  EXPECT_GT(SignedVolume(mesh), 0.0);
}

TEST(CheckMeshTest, SizeAndNumbersMustMakeSense) {
  TriangleMesh huge = MakeBox({50001.0, 1.0, 1.0});
  EXPECT_EQ(CheckMesh(&huge).defect, "is 50 m large: wrong unit or scale?");
  TriangleMesh large = MakeBox({50000.0, 1.0, 1.0});
  EXPECT_EQ(CheckMesh(&large).defect, "");
  TriangleMesh tiny = MakeBox({0.0254, 0.5, 0.9});
  EXPECT_EQ(CheckMesh(&tiny).defect, "is only 0.9 mm large: wrong unit or scale?");
  TriangleMesh small = MakeBox({0.0254, 0.5, 1.0});
  EXPECT_EQ(CheckMesh(&small).defect, "");
  TriangleMesh nan = MakeBox({1.0, 1.0, 1.0});
  nan.vertices[3].y() = std::nan("");
  EXPECT_EQ(CheckMesh(&nan).defect, "has a vertex that is not a number");
  EXPECT_TRUE(nan.triangles.empty());
  TriangleMesh empty;
  EXPECT_EQ(CheckMesh(&empty).defect, "is empty: no triangle");
}

TEST(CheckMeshTest, ManyVerticesInOnePlaneAreWeldedInTime) {
  // An open sheet of 300 x 300 squares at x = 0: welding must not compare all with all.
  TriangleMesh sheet;
  constexpr int kSide = 300;
  for (int i = 0; i <= kSide; ++i) {
    for (int j = 0; j <= kSide; ++j) sheet.vertices.emplace_back(0.0, i, j);
  }
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const int a = i * (kSide + 1) + j;
      sheet.triangles.push_back({a, a + 1, a + kSide + 1});
      sheet.triangles.push_back({a + 1, a + kSide + 2, a + kSide + 1});
    }
  }
  EXPECT_EQ(CheckMesh(&sheet).defect, "is not watertight: 1200 open edges");
}

// ---- files ----

std::string BinaryStl(const TriangleMesh& mesh, const std::string& header = "") {
  std::string bytes = header;
  bytes.resize(80, ' ');
  const auto append = [&](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append(&count, 4);
  for (const auto& t : mesh.triangles) {
    const float normal[3] = {0.0f, 0.0f, 0.0f};
    append(normal, 12);
    for (const int i : t) {
      const Eigen::Vector3f v = mesh.vertices[static_cast<std::size_t>(i)].cast<float>();
      append(v.data(), 12);
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string TextStl(const TriangleMesh& mesh) {
  std::string text = "solid box\n";
  for (const auto& t : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : t) {
      const Eigen::Vector3d& v = mesh.vertices[static_cast<std::size_t>(i)];
      text += "vertex " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
              std::to_string(v.z()) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

class MeshFileTest : public ::testing::Test {
 protected:
  MeshFile Read(const std::string& name, const std::string& bytes,
                const Eigen::Vector3d& scale = Eigen::Vector3d::Ones()) {
    return ReadMeshFile(folder_.Write(name, bytes), scale);
  }

  TempFolder folder_;
  TriangleMesh box_ = MakeBox({10.0, 20.0, 30.0});
};

TEST_F(MeshFileTest, ReadsBinaryAndTextStl) {
  for (const std::string& bytes :
       {BinaryStl(box_), BinaryStl(box_, "solid says the header"), TextStl(box_)}) {
    const MeshFile file = Read("box.stl", bytes);
    EXPECT_EQ(file.defect, "");
    EXPECT_EQ(file.mesh.triangles.size(), 12u);
    EXPECT_NEAR(SignedVolume(file.mesh), 6000.0, 1e-3);
  }
}

TEST_F(MeshFileTest, TrailingBytesOfAnStlAreNoFault) {
  for (const std::string& tail : {std::string(2, '\0'), std::string(100, 'x')}) {
    const MeshFile file = Read("box.STL", BinaryStl(box_) + tail);
    EXPECT_EQ(file.defect, "");
    EXPECT_EQ(file.mesh.triangles.size(), 12u);
  }
}

TEST_F(MeshFileTest, ATruncatedStlLoadsWhatItHasAndSaysSo) {
  const MeshFile file = Read("box.stl", BinaryStl(box_).substr(0, 84 + 50 * 7 + 13));
  EXPECT_EQ(file.defect, "is truncated: its header says 12 triangles, the file has 7");
  EXPECT_EQ(file.mesh.triangles.size(), 7u);
  EXPECT_FALSE(file.mesh.watertight);
}

TEST_F(MeshFileTest, AnEnormousTriangleCountEatsNoMemory) {
  std::string bytes = BinaryStl(box_);
  bytes.replace(80, 4, "\xff\xff\xff\xff");
  const MeshFile file = Read("box.stl", bytes);
  EXPECT_EQ(file.defect, "is truncated: its header says 4294967295 triangles, the file has 12");
  EXPECT_EQ(file.mesh.triangles.size(), 12u);
}

TEST_F(MeshFileTest, BrokenFilesAreDefectsNotCrashes) {
  const std::string text = TextStl(box_);
  EXPECT_EQ(Read("a.stl", "").defect, "is truncated: 0 bytes are no STL");
  EXPECT_EQ(Read("a.stl", "garbage").defect, "is truncated: 7 bytes are no STL");
  EXPECT_EQ(Read("a.stl", std::string(84, '\0')).defect, "is empty: no triangle");
  EXPECT_EQ(Read("a.stl", text.substr(0, text.size() / 2)).defect,
            "is truncated: a text STL without endsolid");
  EXPECT_NE(Read("a.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex\nendsolid").defect, "");
  EXPECT_NE(Read("a.obj", "v 1\nf 1 2 3\n").defect, "");
  EXPECT_NE(Read("a.obj", "v 0 0 0\nf 1000000 2 3\n").defect, "");
  EXPECT_NE(Read("a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n").defect, "");
  EXPECT_NE(Read("a.dae", "<COLLADA>").defect, "");
  EXPECT_NE(Read("a.glb", "glTF\x02").defect, "");
  EXPECT_EQ(Read("a.step", "ISO-10303-21;").defect,
            "is of a format that is not read: STL, OBJ, PLY, DAE and GLB are");
  EXPECT_EQ(ReadMeshFile(folder_.path() + "/QQQ.stl", Eigen::Vector3d::Ones()).defect,
            "is missing: no such file");
  EXPECT_EQ(ReadMeshFile(folder_.path() + "/.stl/", Eigen::Vector3d::Ones()).defect,
            "is of a format that is not read: STL, OBJ, PLY, DAE and GLB are");
}

// assimp 5.2 reads past the end of its vertices here, and dies: in the child process.
TEST_F(MeshFileTest, WhatBreaksAssimpBreaksNothingElse) {
  const std::string defect =
      Read("a.obj",
           "mtllib a.mtl\no a\na 0 0 0\nv 20 0 0\nv 0 20 0\nv 0 0 30\nvn 0 0 1\nvt 0 0\nusemtl\n"
           "s off\nf 1/1/1 3//1 2\nf 1/1/1 2//1 4\nf 1/1/1 4//1 3\nf 2/1/1 3//1 4\n")
          .defect;
  EXPECT_THAT(defect, ::testing::StartsWith("cannot be read: "));
  EXPECT_EQ(Read("box.stl", BinaryStl(box_)).defect, "");
}

TEST_F(MeshFileTest, HeadersThatPromiseTooMuchAreRefusedBeforeAssimp) {
  EXPECT_EQ(Read("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\n").defect,
            "is broken: no complete PLY header");
  EXPECT_EQ(
      Read("a.ply",
           "ply\nformat binary_little_endian 1.0\nelement vertex 400000000\nproperty float x\n"
           "end_header\n0000")
          .defect,
      "is truncated: its header says more elements than the file holds");
  EXPECT_EQ(
      Read("a.ply", "ply\nformat ascii 1.0\nelement vertex many\nproperty float x\nend_header\n0\n")
          .defect,
      "is broken: its PLY header makes no sense");
  std::string deep = "<COLLADA>";
  for (int i = 0; i < 100000; ++i) deep += "<node>";
  EXPECT_EQ(Read("a.dae", deep).defect, "is nested too deeply to be a mesh");
}

TEST_F(MeshFileTest, ReadsTextAndBinaryPly) {
  const std::string head =
      " 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n";
  const MeshFile text = Read("a.ply", "ply\nformat ascii" + head +
                                          "0 0 0\n20 0 0\n0 20 0\n0 0 30\n"
                                          "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  EXPECT_EQ(text.defect, "");
  EXPECT_NEAR(SignedVolume(text.mesh), 2000.0, 1e-3);
  const float points[12] = {0, 0, 0, 20, 0, 0, 0, 20, 0, 0, 0, 30};
  const std::int32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string binary = "ply\nformat binary_little_endian" + head;
  binary.append(reinterpret_cast<const char*>(points), sizeof(points));
  for (const auto& face : faces) {
    binary += '\3';
    binary.append(reinterpret_cast<const char*>(face), sizeof(face));
  }
  const MeshFile packed = Read("b.ply", binary);
  EXPECT_EQ(packed.defect, "");
  EXPECT_NEAR(SignedVolume(packed.mesh), 2000.0, 1e-3);
}

TEST_F(MeshFileTest, ScalesAndMirrors) {
  const MeshFile metres = Read("box.stl", BinaryStl(box_), Eigen::Vector3d::Constant(1000.0));
  EXPECT_NEAR(SignedVolume(metres.mesh), 6000.0e9, 1e3);
  const MeshFile mirrored = Read("box.stl", BinaryStl(box_), {1.0, -1.0, 1.0});
  EXPECT_EQ(mirrored.note, "");  // a mirror is meant; the triangles still face outward
  EXPECT_NEAR(SignedVolume(mirrored.mesh), 6000.0, 1e-3);
}

TEST_F(MeshFileTest, ReadsObjWithPolygons) {
  const MeshFile file =
      Read("box.obj",
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
           "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
           Eigen::Vector3d::Constant(10.0));
  EXPECT_EQ(file.defect, "");
  EXPECT_EQ(file.mesh.triangles.size(), 12u);
  EXPECT_NEAR(SignedVolume(file.mesh), 1000.0, 1e-6);
}

// The unit of a COLLADA file is kept, its up axis ignored: as RViz and MoveIt show robots.
TEST_F(MeshFileTest, ReadsDaeInMetresAndIgnoresItsUpAxis) {
  const std::string dae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 20 0 0 0 20 0 0 0 30</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  const MeshFile file = Read("a.dae", dae, Eigen::Vector3d::Constant(1000.0));
  EXPECT_EQ(file.defect, "");
  Eigen::Vector3d lower, upper;
  BoundingBox(file.mesh, &lower, &upper);
  EXPECT_LT((upper - Eigen::Vector3d(20.0, 20.0, 30.0)).norm(), 1e-3);
}

// glTF 2.0, section 3.4: metres, Y up. Turned to Z up: (x, y, z) -> (x, -z, y).
TEST_F(MeshFileTest, ReadsGlbInMetresAndTurnsItUpright) {
  const float points[12] = {0, 0, 0, 0.02f, 0, 0, 0, 0.03f, 0, 0, 0, 0.04f};
  const std::uint16_t indices[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  std::string bin(reinterpret_cast<const char*>(points), sizeof(points));
  bin.append(reinterpret_cast<const char*>(indices), sizeof(indices));
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",)"
      R"("min":[0,0,0],"max":[0.02,0.03,0.04]},)"
      R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
      R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},)"
      R"({"buffer":0,"byteOffset":48,"byteLength":24}],"buffers":[{"byteLength":72}]})";
  while (json.size() % 4 != 0) json += ' ';
  const auto word = [](std::uint32_t value) {
    return std::string(reinterpret_cast<const char*>(&value), 4);
  };
  const auto length = [](const std::string& chunk) {
    return static_cast<std::uint32_t>(chunk.size());
  };
  const std::string glb = "glTF" + word(2) + word(12 + 8 + length(json) + 8 + length(bin)) +
                          word(length(json)) + "JSON" + json + word(length(bin)) +
                          std::string("BIN\0", 4) + bin;
  const MeshFile file = Read("a.glb", glb, Eigen::Vector3d::Constant(1000.0));
  EXPECT_EQ(file.defect, "");
  Eigen::Vector3d lower, upper;
  BoundingBox(file.mesh, &lower, &upper);
  EXPECT_LT((lower - Eigen::Vector3d(0.0, -40.0, 0.0)).norm(), 1e-3);
  EXPECT_LT((upper - Eigen::Vector3d(20.0, 0.0, 30.0)).norm(), 1e-3);
}

}  // namespace
}  // namespace ncsim::machine
