// SPDX-License-Identifier: BSD-3-Clause
// LinuxCNC's own kinematics module xyzbc-trt-kins as the judge of ours (corpus:
// linuxcnc/oracle/kins).
#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>

#include "kinematics/five_axis.h"
#include "kinematics/test_machines.h"

namespace ncsim::kinematics {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

/// Columns: 3 offsets, 3 of the rotation point, tool offset; x y z b c of the pose; 5 joints.
using Row = std::array<double, 17>;

bool ParseRow(const std::string& line, Row* row) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t i = 0; i < row->size(); ++i) {
    if (i > 0) {
      if (at == end || *at != ',') return false;
      ++at;
    }
    const auto [next, error] = std::from_chars(at, end, (*row)[i]);
    if (error != std::errc()) return false;
    at = next;
  }
  return true;
}

// x-offset and z-offset lead from the C axis to the B axis, rot-point is where the C axis passes,
// tool-offset the tool length; all positions are those of the gauge line. B and C are the table's
// own rotation.
TEST(FiveAxisCorpusTest, AgreesWithLinuxCncXyzbcTrt) {
  const char* corpus = std::getenv("NCSIM_CORPUS");
  if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
  std::ifstream file(std::string(corpus) + "/linuxcnc/oracle/kins/xyzbc_trt_grid.csv");
  ASSERT_TRUE(file.is_open());
  std::string line;
  std::getline(file, line);  // header
  int rows = 0;
  Row row;
  while (std::getline(file, line)) {
    ASSERT_TRUE(ParseRow(line, &row)) << line;
    ++rows;
    const Eigen::Vector3d pivot_c(row[3], row[4], row[5]);
    const Eigen::Vector3d pivot_b = pivot_c + Eigen::Vector3d(row[0], row[1], row[2]);
    const double length = row[6];
    const TestMachine machine = TrunnionBC(pivot_b, pivot_c, 1.0);
    const auto five_axis = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(five_axis.has_value());
    JointVector q = JointVector::Zero(5);
    q[3] = row[10] * kDeg;
    q[4] = row[11] * kDeg;
    five_axis->SolveLinear({row[7], row[8], row[9] - length}, length, &q);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(q[i], row[12 + static_cast<std::size_t>(i)], 2e-9) << line;
    }
    EXPECT_NEAR(q[3] / kDeg, row[15], 1e-9);
    EXPECT_NEAR(q[4] / kDeg, row[16], 1e-9);
  }
  EXPECT_EQ(rows, 300);
}

}  // namespace
}  // namespace ncsim::kinematics
