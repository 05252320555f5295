// SPDX-License-Identifier: BSD-3-Clause
// The five impeller programs of source paper 004 on the shipped BC table machine. The programs are
// read a second time here by a dozen lines that follow the letters X Y Z B C and know nothing of
// the interpreter; tip and axis are worked out by the closed form of a BC table.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/checks/check.h"
#include "sim/control/controller.h"
#include "sim/machine/load.h"

namespace ncsim {
namespace {

namespace fs = std::filesystem;

// What the text says at the end of each line.
struct Said {
  std::map<char, double> words;  // Modal X Y Z B C, mm and deg.
  bool tcp = false;
};

std::vector<Said> ReadByEye(const std::string& text) {
  std::vector<Said> lines(1);
  std::istringstream in(text);
  Said now;
  for (std::string line; std::getline(in, line);) {
    if (const auto comment = line.find(';'); comment != std::string::npos) line.resize(comment);
    if (line.find("TRAORI") != std::string::npos) now = {{}, true};
    if (line.find("TRAFOOF") != std::string::npos) now.tcp = false;
    const bool other =
        line.find('=') != std::string::npos || line.find("DEF") != std::string::npos ||
        line.find("SUPA") != std::string::npos || line.find('(') != std::string::npos;
    for (std::size_t i = 0; i + 1 < line.size() && !other; ++i) {
      if (std::string("XYZBC").find(line[i]) == std::string::npos) continue;
      double value = 0.0;
      const auto end = std::from_chars(line.data() + i + 1, line.data() + line.size(), value);
      if (end.ec == std::errc()) now.words[line[i]] = value;
    }
    lines.push_back(now);
  }
  return lines;
}

class Impeller : public ::testing::Test, public control::RunSink {
 protected:
  void SetUp() override {
    const char* corpus = std::getenv("NCSIM_CORPUS");
    if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
    folder_ = fs::path(corpus) / "seed004";
    Diagnostics diagnostics;
    machine_ = machine::LoadMachine(
        std::string(NCSIM_SOURCE_DIR) + "/models/bc_table_840d/bc_table_840d.urdf", &diagnostics);
    ASSERT_TRUE(machine_.has_value());
    machine::WorkOffset g54;
    g54.name = "G54";
    g54.placement.emplace();
    g54.placement->on = "workpiece_mount";
    g54.placement->X_OG.translation() = kPart;
    job_.offsets["G54"] = g54;
    for (int number = 1; number <= 3; ++number) {
      machine::Tool tool;
      tool.number = number;
      tool.length = tool.h_geometry = kLength;
      tool.diameter = tool.d_geometry = 10.0;
      tools_.tools.push_back(tool);
    }
    tools_.tools[1].name = "UGT0203_004";
  }

  void OnMotion(const motion::Motion& motion) override {
    motions_.push_back(motion);
    for (const auto& check : checks_) check->OnMotion(motion, &findings_);
  }
  void OnFinding(Finding finding) override { findings_.push_back(std::move(finding)); }

  std::string Read(const std::string& name) const {
    std::ifstream in(folder_ / (name + ".mpf"), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void Run(const std::string& text) {
    motions_.clear();
    findings_.clear();
    part_frames_.clear();
    checks_ = checks::AllChecks(*machine_);
    SourceFiles files;
    summary_ = control::RunProgram(nc::Program::FromText("impeller.mpf", text), *machine_, job_,
                                   tools_, &files, &part_frames_, this);
    for (const auto& check : checks_) check->Finish(&findings_);
  }

  std::string Findings() const {
    std::string text;
    for (const Finding& finding : findings_) {
      if (finding.rule == Rule::kAxisSpeed) continue;
      text += std::to_string(finding.where.line) + " " + std::string(Info(finding.rule).id) + "\n";
    }
    return text;
  }

  static constexpr double kLength = 170.0;
  const Eigen::Vector3d kPart{3.0, -4.0, 60.0};  // Of G54 on the table.
  fs::path folder_;
  std::optional<machine::Machine> machine_;
  machine::Job job_;
  machine::ToolTable tools_;
  std::vector<std::unique_ptr<checks::Check>> checks_;
  std::vector<motion::Motion> motions_;
  std::vector<Finding> findings_;
  std::vector<control::PartFrame> part_frames_;
  control::RunSummary summary_;
};

TEST_F(Impeller, AllAreReadWholeWithTheTipWhereTheySay) {
  int programs = 0, blocks = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() != ".mpf") continue;
    ++programs;
    const std::string name = entry.path().stem().string();
    const std::string text = Read(name);
    Run(text);
    // Where blocks were left out, number 1 as printed goes on with an arc from elsewhere.
    const bool printed = name.find("as_printed") != std::string::npos;
    const bool cut = name == "impeller_1_contour_rough.as_printed";
    EXPECT_EQ(summary_.finished, !cut) << name;
    for (const Finding& finding : findings_) {
      EXPECT_NE(finding.rule, Rule::kUnsupportedCode) << name << finding.message;
      if (printed || finding.severity != Severity::kError) continue;
      EXPECT_EQ(finding.rule, Rule::kRotaryWrap) << name << ": " << finding.message;
    }
    const std::vector<Said> said = ReadByEye(text);
    for (const motion::Motion& motion : motions_) {
      const auto& words = said.at(static_cast<std::size_t>(motion.where.line)).words;
      const bool known = words.count('X') != 0 && words.count('Y') != 0 && words.count('Z') != 0;
      if (!motion.facts.tcp || !motion.facts.names_linear || !known) continue;
      Eigen::Vector3d p_B, u_B;
      machine_->five_axis->TipInTable(motion.q1(), kLength, &p_B, &u_B);
      const Eigen::Vector3d p(words.at('X'), words.at('Y'), words.at('Z'));
      EXPECT_LT((p_B - kPart - p).norm(), 1e-5) << name << " line " << motion.where.line;
      ++blocks;
      if (words.count('B') == 0 || words.count('C') == 0) continue;
      const double b = Radians(words.at('B')), c = Radians(words.at('C'));
      const Eigen::Vector3d u(std::sin(b) * std::cos(c), std::sin(b) * std::sin(c), std::cos(b));
      EXPECT_LT((u_B - u).norm(), 1e-9) << name << " line " << motion.where.line;
    }
  }
  EXPECT_EQ(programs, 13);
  EXPECT_GT(blocks, 400);
}

// Hub finish N809570 -> N809590: 39.34508 mm along the tool (closed form from the printed numbers).
TEST_F(Impeller, DepartureOfTheHubFinishIsAPureRetract) {
  Run(Read("impeller_4_hub_finish.tail"));
  const motion::Motion* departure = nullptr;
  for (const motion::Motion& motion : motions_) {
    if (motion.kind == motion::MotionKind::kRapid && motion.facts.tcp) departure = &motion;
  }
  ASSERT_NE(departure, nullptr);
  const auto way = [&](char letter) {
    const int joint = machine_->FindAxis(letter)->joint;
    return (departure->q1() - departure->q0())[joint];
  };
  EXPECT_NEAR(way('Z'), 39.345, 5e-4);
  EXPECT_NEAR(way('X'), 0.0, 1e-3);
  EXPECT_NEAR(way('Y'), 0.0, 1e-3);
  EXPECT_EQ(way('B'), 0.0);
  EXPECT_EQ(way('C'), 0.0);
}

TEST_F(Impeller, WrapsAreWhereTheMachineDataSay) {
  const std::map<std::string, std::string> expected = {
      {"impeller_1_contour_rough.head", ""},
      {"impeller_2_hub_rough.head", ""},
      {"impeller_3_blade_finish.head", ""},
      {"impeller_3_blade_finish.tail", ""},
      {"impeller_4_hub_finish.head", ""},
      {"impeller_4_hub_finish.tail", "51 rotary-wrap\n"},
      {"impeller_5_blend_finish.head", "60 rotary-wrap\n"},
      {"impeller_5_blend_finish.tail", ""}};
  for (const auto& [name, findings] : expected) {
    job_.control.clear();
    Run(Read(name));
    EXPECT_EQ(Findings(), findings) << name;
    for (const Finding& finding : findings_) {
      if (finding.rule != Rule::kRotaryWrap) continue;
      EXPECT_EQ(finding.severity, Severity::kError);
      for (const char* words : {"MD30455 bit 2 = 0", "MD30455 bit 2 = 1", "MD21104 = 0"}) {
        EXPECT_NE(finding.message.find(words), std::string::npos) << finding.message;
      }
    }
    job_.control = {{"MD30455[C]", "4"}};
    Run(Read(name));
    EXPECT_EQ(Findings(), "") << name << " with the shortest way";
    job_.control = {{"MD21104", "0"}};
    Run(Read(name));
    EXPECT_EQ(Findings(), "") << name << " along the tool vector";
  }
}

// As the paper's post wrote them (its figure 3-22): the first rotary move, N450, behind TRAORI and
// N440. Number 1 has no TRAORI. `text` gets the move back there; the line on which it then stands.
int PutRotaryMoveBehindTraori(std::string* text) {
  const auto move = text->find("N450 G0 B");
  if (move == std::string::npos) return 0;
  const std::string block = text->substr(move, text->find('\n', move) + 1 - move);
  text->erase(move, block.size());
  const auto behind = text->find("N460 ");
  EXPECT_LT(text->find("TRAORI"), behind);
  text->insert(behind, block);
  return 1 + static_cast<int>(std::count(text->begin(), text->begin() + behind, '\n'));
}

TEST_F(Impeller, FirstRotaryMoveBehindTraoriIsNamed) {
  int programs = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() != ".mpf") continue;
    const std::string name = entry.path().stem().string();
    std::string text = Read(name);
    Run(text);
    EXPECT_EQ(Findings().find("rotary-under-tcp"), std::string::npos) << name << Findings();
    const int line = PutRotaryMoveBehindTraori(&text);
    EXPECT_EQ(line == 0, name.find("_1_") != std::string::npos) << name;
    if (line == 0) continue;
    ++programs;
    Run(text);
    const Finding* found = nullptr;
    for (const Finding& finding : findings_) {
      if (finding.rule == Rule::kRotaryUnderTcp) found = &finding;
    }
    ASSERT_NE(found, nullptr) << name << Findings();
    EXPECT_EQ(found->where.line, line) << name;
    // The tip stands in X0 Y0 on the axis of C, 650 mm less the tool above that of B: to stay over
    // the part it swings about that.
    const double b = Radians(std::stod(text.substr(text.find("N450 G0 B") + 9)));
    for (const std::string& words :
         {std::string("a rapid turns axis B"), std::string("the linear axes swing at rapid"),
          "X by up to " + Fixed((650.0 - kLength) * std::sin(b), 1),
          std::string("turn the axis before TCP is switched on")}) {
      EXPECT_NE(found->message.find(words), std::string::npos) << found->message;
    }
  }
  EXPECT_EQ(programs, 11);
}

TEST_F(Impeller, CancelledOffsetIsOneFinding) {
  std::string text = Read("impeller_4_hub_finish.head");
  const auto traori = text.find("TRAORI");
  text.insert(text.rfind("N", traori), "G54\n");
  const auto g54 = text.find("G54", traori + 8);
  text.replace(g54, 3, "   ");
  Run(text);
  ASSERT_EQ(findings_.size(), 1u) << Findings();
  EXPECT_EQ(findings_[0].rule, Rule::kFrameCancelled);
}

TEST_F(Impeller, ToolsAreFoundByTheirNames) {
  std::string text = Read("impeller_4_hub_finish.head");
  const auto t = text.find("T=2");
  ASSERT_NE(t, std::string::npos);
  Run(std::string(text).replace(t, 3, "T=\"UGT0203_004\""));
  EXPECT_EQ(Findings(), "");
  EXPECT_EQ(motions_.back().facts.tool, 2);
  Run(text.replace(t, 3, "T=\"UGT0203_005\""));
  ASSERT_EQ(findings_.size(), 1u);
  EXPECT_EQ(findings_[0].rule, Rule::kToolMissing);
}

}  // namespace
}  // namespace ncsim
