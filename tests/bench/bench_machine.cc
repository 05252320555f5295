// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/bench_machine.h"

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/bench_mesh.h"

namespace ncsim::bench {
namespace {

namespace fs = std::filesystem;

struct LinkShape {
  std::string name;
  machine::TriangleMesh mesh;
};

/// In link coordinates (mm), as the links stand with all axes at machine zero.
std::vector<LinkShape> LinkShapes() {
  std::vector<LinkShape> shapes;
  shapes.push_back({"base", BlockMesh({{{-980, -750, -1150}, {220, 400, -900}}}, 50)});
  shapes.push_back({"rear", BlockMesh({{{-1050, 400, -1150}, {290, 1000, -150}}}, 80)});
  shapes.push_back({"tool_changer", BlockMesh({{{-1150, -600, 0}, {-1020, -100, 500}},
                                               {{-1150, -400, 500}, {-1080, -300, 900}}},
                                              40)});
  shapes.push_back({"b_drive", BlockMesh({{{-581, 120, -680}, {-181, 380, -360}}}, 40)});
  shapes.push_back({"column", BlockMesh({{{-250, 500, -100}, {250, 900, 900}},
                                         {{-150, 500, 240}, {150, 900, 560}, true}},
                                        60)});
  shapes.push_back({"ram", BlockMesh({{{-140, 170, 250}, {140, 900, 550}}}, 50)});
  shapes.push_back(
      {"head",
       BlockMesh({{{-150, -130, 80}, {150, 160, 650}}, {{-60, -60, 650}, {60, 60, 900}}}, 40)});
  shapes.push_back(
      {"nose", RevolvedMesh({{0, 30}, {0, 44}, {25, 44}, {30, 64}, {80, 64}}, 8.0, 72)});
  shapes.push_back({"trunnion", BlockMesh({{{-170, -360, -175}, {170, 360, -115}},
                                           {{-110, -360, -115}, {110, -285, 90}},
                                           {{-110, 285, -115}, {110, 360, 90}}},
                                          35)});
  shapes.push_back(
      {"platter", RevolvedMesh({{-58, 90}, {-40, 250}, {-2, 250}, {0, 248}, {0, 30}}, 20.0, 96)});
  return shapes;
}

struct JointText {
  std::string name, type, parent, child, xyz, rpy, axis, limit;
};

/// Metres and radians, as URDF has them.
std::vector<JointText> Joints() {
  const std::string zero = "0 0 0";
  const std::string speed = "velocity=\"0.38166\" effort=\"0\"";
  const std::string turn = "velocity=\"0.87266\" effort=\"0\"";
  return {
      {"rear_mount", "fixed", "base", "rear", zero, zero, "", ""},
      {"tool_changer_mount", "fixed", "base", "tool_changer", zero, zero, "", ""},
      {"b_drive_mount", "fixed", "base", "b_drive", zero, zero, "", ""},
      {"X", "prismatic", "base", "column", zero, zero, "1 0 0",
       "lower=\"-0.762\" upper=\"0\" " + speed},
      {"Y", "prismatic", "column", "ram", zero, zero, "0 1 0",
       "lower=\"-0.508\" upper=\"0\" " + speed},
      {"Z", "prismatic", "ram", "head", zero, zero, "0 0 1",
       "lower=\"-0.4445\" upper=\"0.0635\" " + speed},
      {"nose_mount", "fixed", "head", "nose", zero, zero, "", ""},
      {"spindle_gauge_mount", "fixed", "nose", "spindle_gauge", zero, "3.141592653589793 0 0", "",
       ""},
      {"B", "revolute", "base", "trunnion", "-0.381 -0.254 -0.4957", zero, "0 -1 0",
       "lower=\"-0.6108652381980153\" upper=\"2.0943951023931953\" " + turn},
      {"C", "revolute", "trunnion", "platter", "0 0 -0.0508", zero, "0 0 -1",
       "lower=\"-232.4778563656447\" upper=\"232.4778563656447\" " + turn},
      {"workpiece_mount_joint", "fixed", "platter", "workpiece_mount", zero, zero, "", ""},
  };
}

std::string Urdf(const std::vector<LinkShape>& shapes) {
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"bench\">\n";
  for (const LinkShape& shape : shapes) {
    text += "<link name=\"" + shape.name + "\"><collision><geometry><mesh filename=\"" +
            shape.name + ".stl\" scale=\"0.001 0.001 0.001\"/></geometry></collision></link>\n";
  }
  text += "<link name=\"spindle_gauge\"/>\n<link name=\"workpiece_mount\"/>\n";
  for (const JointText& joint : Joints()) {
    text += "<joint name=\"" + joint.name + "\" type=\"" + joint.type + "\"><origin xyz=\"" +
            joint.xyz + "\" rpy=\"" + joint.rpy + "\"/><parent link=\"" + joint.parent +
            "\"/><child link=\"" + joint.child + "\"/>";
    if (!joint.axis.empty()) {
      text += "<axis xyz=\"" + joint.axis + "\"/><limit " + joint.limit + "/>";
    }
    text += "</joint>\n";
  }
  return text + "</robot>\n";
}

/// Guides and bearings.
std::string Srdf() {
  const std::vector<std::pair<std::string, std::string>> adjacent = {
      {"rear", "column"},   {"column", "ram"},       {"ram", "head"},
      {"base", "trunnion"}, {"b_drive", "trunnion"}, {"trunnion", "platter"}};
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"bench\">\n";
  for (const auto& [a, b] : adjacent) {
    text += "<disable_collisions link1=\"" + a + "\" link2=\"" + b + "\" reason=\"Adjacent\"/>\n";
  }
  return text + "</robot>\n";
}

std::string Toml() {
  std::string text =
      "schema = 1\nunits = \"mm\"\nname = \"Benchmark machine\"\nshapes = \"measured\"\n"
      "[frames]\nspindle = \"spindle_gauge\"\ntable = \"workpiece_mount\"\n";
  for (const char* axis : {"X", "Y", "Z"}) {
    text += std::string("[axes.") + axis + "]\njoint = \"" + axis +
            "\"\nrapid_m_per_min = 22.9\nacceleration_mm_per_s2 = 3000.0\nhome = 0.0\n";
  }
  for (const char* axis : {"B", "C"}) {
    text += std::string("[axes.") + axis + "]\njoint = \"" + axis +
            "\"\nrapid_deg_per_s = 50.0\nacceleration_deg_per_s2 = 1000.0\nhome = 0.0\n";
  }
  return text +
         "[spindle]\nmax_rpm = 8100.0\ninterface = \"CAT40\"\n"
         "[tool_change]\nX = -736.6\nY = -203.2\nZ = 0.0\norder = [\"Z\", \"XY\"]\n"
         "pose = \"measured\"\npockets = 40\nmax_tool_length = 305.0\n"
         "max_tool_diameter = 127.0\n"
         "[control]\ndialect = \"haas-ngc\"\n[control.settings]\n"
         "\"setting 254\" = 0.0\n\"setting 255\" = -381.0\n\"setting 256\" = -254.0\n"
         "\"setting 257\" = -495.7\n\"setting 34\" = 0.0\n\"setting 79\" = 0.0\n"
         "\"setting 247\" = \"off\"\ntcp_rapid = \"hold\"\n";
}

}  // namespace

bool WriteMachine(const fs::path& folder) {
  const std::vector<LinkShape> shapes = LinkShapes();
  for (const LinkShape& shape : shapes) {
    if (!WriteStl(shape.mesh, (folder / (shape.name + ".stl")).string())) return false;
  }
  std::ofstream urdf(folder / "bench.urdf");
  std::ofstream srdf(folder / "bench.srdf");
  std::ofstream toml(folder / "bench.toml");
  urdf << Urdf(shapes);
  srdf << Srdf();
  toml << Toml();
  return urdf.flush() && srdf.flush() && toml.flush();
}

}  // namespace ncsim::bench
