// SPDX-License-Identifier: BSD-3-Clause
// The real UMC-750 program, from text to motions, on the shipped model. The program is read a
// second time here, by eye so to speak: a dozen lines that follow its few codes and know nothing of
// the interpreter. The ranges of B and C are those of LinuxCNC's rs274 on the same text (corpus,
// linuxcnc/oracle).
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "sim/base/units.h"
#include "sim/control/controller.h"
#include "sim/machine/load.h"

namespace ncsim {
namespace {

// What the text says at the end of each line.
struct Said {
  Eigen::Vector3d xyz_inch = Eigen::Vector3d::Zero();
  bool tcp = false, dwo = false;
  unsigned known = 0;  // Bits of X, Y, Z: named since the frame changed or the axis left it.
};

std::vector<Said> ReadByEye(const std::string& path) {
  std::vector<Said> lines(1);
  std::ifstream in(path);
  Said now;
  for (std::string line; std::getline(in, line);) {
    if (const auto comment = line.find('('); comment != std::string::npos) line.resize(comment);
    const auto has = [&](const char* code) { return line.find(code) != std::string::npos; };
    if (has("G234")) now.tcp = true;
    if (has("G43") || has("G49")) now.tcp = false;
    if (has("G254")) now.dwo = true;
    if (has("G255")) now.dwo = false;
    if (has("G234") || has("G254") || has("G53") || has("G28") || has("M06")) now.known = 0;
    for (int i = 0; i < 3 && !has("G53") && !has("G28"); ++i) {
      const auto at = line.find("XYZ"[i]);
      if (at == std::string::npos) continue;
      std::from_chars(line.data() + at + 1, line.data() + line.size(), now.xyz_inch[i]);
      now.known |= 1U << i;
    }
    lines.push_back(now);
  }
  return lines;
}

class Umc750Program : public ::testing::Test, public control::RunSink {
 protected:
  void SetUp() override {
    const char* corpus = std::getenv("NCSIM_CORPUS");
    if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
    path_ = std::string(corpus) +
            "/haas/umc750-ubc/NCcodeForHAAS-UMC750Machine/FinalToolPath.stripped.nc";
    Diagnostics diagnostics;
    machine_ = machine::LoadMachine(
        std::string(NCSIM_SOURCE_DIR) + "/models/haas_umc750/umc750.urdf", &diagnostics);
    ASSERT_TRUE(machine_.has_value());
    // The part's corner 150 mm above the platter's centre; 4 x 4 in about it.
    machine::WorkOffset g54;
    g54.name = "G54";
    g54.placement.emplace();
    g54.placement->on = "workpiece_mount";
    g54.placement->X_OG.translation() = Eigen::Vector3d(-50.8, -50.8, 150.0);
    job_.offsets["G54"] = g54;
    for (int number = 1; number <= 3; ++number) {
      machine::Tool tool;
      tool.number = number;
      tool.length = tool.h_geometry = 180.0;
      tools_.tools.push_back(tool);
    }
  }

  void OnMotion(const motion::Motion& motion) override { motions_.push_back(motion); }
  void OnFinding(Finding finding) override {
    if (finding.severity != Severity::kWarning) {
      errors_ += std::to_string(finding.where.line) + ": " + finding.message + "\n";
    }
  }

  void Run() {
    Diagnostics diagnostics;
    const auto program = nc::Program::Load(path_, &diagnostics);
    ASSERT_NE(program, nullptr);
    SourceFiles files;
    summary_ = control::RunProgram(program, *machine_, job_, tools_, &files, &part_frames_, this);
  }

  std::string path_, errors_;
  std::optional<machine::Machine> machine_;
  machine::Job job_;
  machine::ToolTable tools_;
  std::vector<motion::Motion> motions_;
  std::vector<control::PartFrame> part_frames_;
  control::RunSummary summary_;
};

TEST_F(Umc750Program, IsSimulatedWholeWithTheTipWhereItSays) {
  Run();
  EXPECT_TRUE(summary_.finished);
  EXPECT_EQ(errors_, "");
  EXPECT_GT(motions_.size(), 15'000u);

  const std::vector<Said> said = ReadByEye(path_);
  const int joint_b = machine_->FindAxis('B')->joint, joint_c = machine_->FindAxis('C')->joint;
  double least_b = 0.0, most_b = 0.0, least_c = 0.0, most_c = 0.0, worst = 0.0;
  int held = 0, worst_line = 0;
  for (const motion::Motion& motion : motions_) {
    const double b = motion.q1()[joint_b], c = motion.q1()[joint_c];
    least_b = std::min(least_b, b);
    most_b = std::max(most_b, b);
    least_c = std::min(least_c, c);
    most_c = std::max(most_c, c);
    const Said& line = said.at(static_cast<std::size_t>(motion.where.line));
    if (!motion.facts.names_linear || line.known != 7U || (!line.tcp && !line.dwo)) continue;
    Eigen::Vector3d p_BT_B, u_B;
    machine_->five_axis->TipInTable(motion.q1(), 180.0, &p_BT_B, &u_B);
    const Eigen::Isometry3d& X_BP =
        part_frames_.at(static_cast<std::size_t>(motion.facts.offset)).X_BP;
    Eigen::Vector3d wanted = line.xyz_inch * kMmPerInch;
    if (line.dwo) {
      wanted = Eigen::AngleAxisd(c, Eigen::Vector3d::UnitZ()) *
               (Eigen::AngleAxisd(b, Eigen::Vector3d::UnitY()) * wanted);
    }
    const double error = (X_BP.inverse() * p_BT_B - wanted).cwiseAbs().maxCoeff();
    if (error > worst) worst_line = motion.where.line;
    worst = std::max(worst, error);
    ++held;
  }
  EXPECT_LT(worst, 0.003) << "at line " << worst_line;
  EXPECT_GT(held, 14'000);
  EXPECT_NEAR(Degrees(least_b), -25.239, 1e-9);
  EXPECT_NEAR(Degrees(most_b), 95.865, 1e-9);
  EXPECT_NEAR(Degrees(least_c), -663.055, 1e-9);
  EXPECT_NEAR(Degrees(most_c), 458.675, 1e-9);
}

// Counts joints that leave their limits at the ends and in the middle of motions.
int Overruns(const machine::Machine& machine, const std::vector<motion::Motion>& motions,
             std::map<int, int>* lines) {
  int count = 0;
  for (const motion::Motion& motion : motions) {
    for (const machine::Axis& axis : machine.axes) {
      for (const double s : {0.25, 0.5, 0.75, 1.0}) {
        const double value = motion.At(s)[axis.joint];
        if (value >= axis.lower - 1e-9 && value <= axis.upper + 1e-9) continue;
        ++count;
        ++(*lines)[motion.where.line];
        break;
      }
    }
  }
  return count;
}

TEST_F(Umc750Program, HeldRapidsStayWithinTravelTrackedOnesDoNot) {
  Run();
  std::map<int, int> lines;
  EXPECT_EQ(Overruns(*machine_, motions_, &lines), 0) << "first at line " << lines.begin()->first;
  motions_.clear();
  job_.control["tcp_rapid"] = "track";
  Run();
  Overruns(*machine_, motions_, &lines);
  EXPECT_FALSE(lines.empty());
}

// Leaving out the G255 of line 1653 lets G234 meet G254 at line 1670.
TEST_F(Umc750Program, WithoutG255TheControlStopsAtG234) {
  std::ifstream in(path_);
  std::string text;
  int number = 0;
  for (std::string line; std::getline(in, line);) text += (++number == 1653 ? "" : line) + "\n";
  SourceFiles files;
  summary_ = control::RunProgram(nc::Program::FromText("part.nc", text), *machine_, job_, tools_,
                                 &files, &part_frames_, this);
  EXPECT_FALSE(summary_.finished);
  EXPECT_EQ(errors_.substr(0, 5), "1670:") << errors_;
}

}  // namespace
}  // namespace ncsim
