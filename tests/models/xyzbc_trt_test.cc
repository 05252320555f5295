// SPDX-License-Identifier: BSD-3-Clause
// LinuxCNC's kinematics module xyzbc-trt-kins as the judge of a machine that is loaded from a URDF:
// 300 poses of the corpus, linuxcnc/oracle/kins, with four sets of offsets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <fstream>
#include <string>

#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "sim/machine/test_files.h"

namespace ncsim::machine {
namespace {

/// Columns: x, y, z offset from the C axis to the B axis; rotation point x, y, z; tool offset; x y
/// z b c of the pose; 5 joints. mm, degrees.
using Row = std::array<double, 17>;

bool ParseRow(const std::string& line, Row* row) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t i = 0; i < row->size(); ++i) {
    if (i > 0 && (at == end || *at++ != ',')) return false;
    const auto [next, error] = std::from_chars(at, end, (*row)[i]);
    if (error != std::errc()) return false;
    at = next;
  }
  return true;
}

std::string Metres(const Eigen::Vector3d& p) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "%.17g %.17g %.17g", p.x() / 1000.0, p.y() / 1000.0,
                p.z() / 1000.0);
  return text.data();
}

/// X, Y, Z carry the spindle, B on the base carries C; the values of B and C are the table's own
/// rotation. Frame B of the table is M at B0 C0.
std::string Urdf(const Row& row) {
  const Eigen::Vector3d pivot_c(row[3], row[4], row[5]);
  const Eigen::Vector3d pivot_b = pivot_c + Eigen::Vector3d(row[0], row[1], row[2]);
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"xyzbc_trt\">\n";
  for (const char* link : {"base", "x", "y", "spindle_gauge", "z", "b", "c", "workpiece_mount"}) {
    text += std::string("  <link name=\"") + link + "\"/>\n";
  }
  const auto joint = [&](const char* name, const char* type, const char* parent, const char* child,
                         const char* axis, const std::string& xyz, const char* rpy) {
    text += std::string("  <joint name=\"") + name + "\" type=\"" + type + "\"><origin xyz=\"" +
            xyz + "\" rpy=\"" + rpy + "\"/><parent link=\"" + parent + "\"/><child link=\"" +
            child + "\"/><axis xyz=\"" + axis +
            "\"/><limit lower=\"-9\" upper=\"9\" velocity=\"1\" effort=\"0\"/></joint>\n";
  };
  joint("X", "prismatic", "base", "x", "1 0 0", "0 0 0", "0 0 0");
  joint("Y", "prismatic", "x", "y", "0 1 0", "0 0 0", "0 0 0");
  joint("Z", "prismatic", "y", "z", "0 0 1", "0 0 0", "0 0 0");
  joint("S", "fixed", "z", "spindle_gauge", "1 0 0", "0 0 0", "3.14159265358979312 0 0");
  joint("B", "continuous", "base", "b", "0 1 0", Metres(pivot_b), "0 0 0");
  joint("C", "continuous", "b", "c", "0 0 1", Metres(pivot_c - pivot_b), "0 0 0");
  joint("mount", "fixed", "c", "workpiece_mount", "1 0 0", Metres(-pivot_c), "0 0 0");
  return text + "</robot>\n";
}

TEST(XyzbcTrt, UrdfAgreesWithLinuxCnc) {
  NCSIM_REQUIRE_CORPUS();
  std::ifstream file(CorpusFile("linuxcnc/oracle/kins/xyzbc_trt_grid.csv"));
  ASSERT_TRUE(file.is_open());
  TempFolder folder;
  std::string line;
  std::getline(file, line);  // header
  std::string loaded;
  std::optional<Machine> machine;
  int rows = 0, machines = 0;
  Row row{};
  while (std::getline(file, line)) {
    ASSERT_TRUE(ParseRow(line, &row)) << line;
    ++rows;
    if (Urdf(row) != loaded) {
      loaded = Urdf(row);
      Diagnostics diagnostics;
      machine = LoadMachine(folder.Write("xyzbc_trt.urdf", loaded), &diagnostics);
      ASSERT_TRUE(machine.has_value() && machine->five_axis.has_value());
      EXPECT_FALSE(diagnostics.has_errors());
      // Its rotary axes are the table's own, and ncsim says so.
      EXPECT_THAT(Reported(diagnostics),
                  ::testing::Contains(::testing::HasSubstr("axis B points the wrong way")));
      ++machines;
    }
    const double length = row[6];
    const Eigen::Vector3d tip(row[7], row[8], row[9] - length);
    kinematics::JointVector q = machine->Home();
    const double b = Radians(row[10]), c = Radians(row[11]);
    q[machine->FindAxis('B')->joint] = b;
    q[machine->FindAxis('C')->joint] = c;
    machine->five_axis->SolveLinear(tip, length, &q);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(q[machine->FindAxis("XYZ"[i])->joint], row[12 + i], 2e-9) << line;
      q[machine->FindAxis("XYZ"[i])->joint] = row[12 + i];
    }
    // Back from its joints: the tip in the part, and the tool axis Rz(-C) Ry(-B) z.
    Eigen::Vector3d reached, axis;
    machine->five_axis->TipInTable(q, length, &reached, &axis);
    EXPECT_LT((reached - tip).norm(), 5e-9) << line;
    const Eigen::Vector3d expected(-std::sin(b) * std::cos(c), std::sin(b) * std::sin(c),
                                   std::cos(b));
    EXPECT_LT((axis - expected).norm(), 1e-12) << line;
  }
  EXPECT_EQ(rows, 300);
  EXPECT_GE(machines, 4);
}

}  // namespace
}  // namespace ncsim::machine
