// SPDX-License-Identifier: BSD-3-Clause
// SINUMERIK programs put together from blocks at random and mutated, run on the shipped BC table
// machine: no crash, no hang, no silence, and motions that chain bit for bit.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/control/sinumerik_840d.h"
#include "sim/machine/load.h"
#include "tests/fuzz/mutate.h"

namespace ncsim {
namespace {

constexpr std::uint64_t kMaxBlocks = 300;

constexpr std::array<std::string_view, 104> kBlocks = {
    "G54 G0 G90 X0 Y0 Z50 B0 C0 D1",
    "T2 M6",
    "T=\"BALL\" M6",
    "G1 A3=-0.02 B3=0.05 C3=1 Y2",
    "T0 M6",
    "D0",
    "D2",
    "S2000 M3",
    "M5",
    "G1 F500",
    "G1 X10 Y5 Z-3",
    "G1 B30 C40",
    "C=DC(350)",
    "C=ACP(10) B=IC(-5)",
    "C359.99503",
    "C.00926",
    "X=IC(3) Y=AC(2)",
    "G91",
    "G90",
    "TRAORI\nG54",
    "TRAORI(1)\nG54 ORIVECT",
    "TRAFOOF",
    "G54",
    "G500",
    "G505",
    "ORIWKS ORIAXES",
    "ORIMKS ORIVECT",
    "ORIVECT",
    "G1 A3=1 B3=1 C3=1 X5",
    "G1 A3=-0.1 B3=0 C3=1",
    "C3=1",
    "A3=0 B3=0 C3=-1",
    "A2=30 B2=20 C2=10 Z5",
    "ORIRPY",
    "B10 C0 X1",
    "G0 B-5 C180 Y1",
    "SUPA G0 Z0 D0",
    "SUPA G0 X0 Y0 B0 C0 D1",
    "G153 G0 Z-10",
    "G53 X1",
    "TRANS X10 C30",
    "ATRANS Z-5",
    "ROT Z30",
    "AROT X10 Y20 Z30",
    "ROT RPL=45",
    "SCALE X2 Y2 Z2",
    "SCALE X0.5",
    "AMIRROR X0",
    "TRANS",
    "G2 X10 Y10 I10 J0",
    "G3 X20 Y0 CR=10",
    "G2 I10 J0 AR=90",
    "G3 X1 Y1 I5 TURN=3",
    "CIP X20 Y0 Z0 I1=10 J1=6 K1=8",
    "CT X30 Y10",
    "G110 X1 Y1",
    "AP=45 RP=20",
    "G3 RP=10 AP=270",
    "G17",
    "G18",
    "G19",
    "G41 X5 Y5",
    "G42 Y10",
    "G40 X0",
    "G70 X1",
    "G710",
    "G95 F.1 G1 X3",
    "G93 F10 X2",
    "G94 F300",
    "G33 Z-5 K1.5",
    "G331 Z-5 K1",
    "G4 F1",
    "POS[C]=IC(5)",
    "TOROT",
    "TOROTOF",
    "CYCLE800(1,\"\",200000,57,0,0,0,20,10,30,0,0,0,-1,100,1)",
    "CYCLE800()",
    "MCALL CYCLE81(20,0,2,-5)",
    "CYCLE83(20,0,2,-25,,-8,,2,0,0,0.8,1)",
    "CYCLE84(20,0,2,-10,,0,5,,1.5,0,300,300)",
    "MCALL",
    "HOLES2(5,5,12,0,60,6)",
    "G1 X15 Y12 RND=2",
    "G64 CYCLE832(0.01,_ORI_ROUGH,1)",
    "G642 COMPCAD CTOL=0.02 OTOL=0.5",
    "$P_UIFR[1]=CTRANS(X,5,Z,-300):CROT(Z,30)",
    "$P_PFRAME=$P_PFRAME:CROT(Y,20):CSCALE(X,1.5)",
    "$TC_DP3[2,1]=R1+150",
    "G1 X8 Y3 LEAD=5 TILT=10",
    "G1 X2 A5=1 C5=1 LEAD=-8 TILT=0",
    "ORIPATH",
    "G3 X12 Y9 CR=40 LEAD=3 TILT=2",
    "G58 X2 C10",
    "G59 Y-3",
    "ROTS X10 Y-20",
    "AROTS Y90 Z1",
    "RNDM=1.5",
    "RNDM=0",
    "POSA[Y]=12",
    "WAITP(Y)",
    "AX[X]=IC(3)",
    "CYCLE800(2,\"\",11,185,1,2,3,10,20,30,0,0,0,1)",
    "$P_UBFR=CTRANS(X,R1)",
    "SUB(3) P2"};

constexpr std::string_view kSubprogram =
    "\nM30\n%_N_SUB_SPF\nPROC SUB(REAL AA) SAVE\nG91 X=AA\nTRANS X=AA\nM17\n";

constexpr std::array<std::string_view, 24> kTokens = {
    "X",  "Y1",   "Z=",   "B90", "C-1",    "A3=",   "1EX9",    "0",
    "G1", "G0",   "G2 ",  "-",   "9999",   "IC(",   "R1",      "=",
    "\n", "M30 ", "G91 ", "D1 ", "TRANS ", "SUPA ", "TRAORI ", "1EX-300"};

const FuzzLanguage kLanguage = {kBlocks, kTokens, "(X9"};

machine::Tool MakeTool(int number, double length, const char* name) {
  machine::Tool tool;
  tool.number = number;
  tool.name = name;
  tool.length = tool.h_geometry = length;
  tool.diameter = tool.d_geometry = 10.0;
  return tool;
}

class Sink : public control::RunSink {
 public:
  void OnMotion(const motion::Motion& motion) override {
    ++motions;
    EXPECT_TRUE(motion.q0().allFinite() && motion.q1().allFinite());
    EXPECT_TRUE(motion.At(0.37).allFinite());
    EXPECT_TRUE(std::isfinite(motion.duration) && motion.duration >= 0.0);
    EXPECT_TRUE(motions == 1 || motion.q0() == last);
    last = motion.q1();
  }
  void OnFinding(Finding finding) override {
    ++findings;
    EXPECT_FALSE(finding.message.empty());
    EXPECT_GE(finding.where.line, 1);
  }
  motion::JointVector last;
  int motions = 0, findings = 0;
};

class SinumerikRunFuzz : public ::testing::Test {
 protected:
  void SetUp() override {
    Diagnostics diagnostics;
    machine_ = machine::LoadMachine(
        std::string(NCSIM_SOURCE_DIR) + "/models/bc_table_840d/bc_table_840d.urdf", &diagnostics);
    ASSERT_TRUE(machine_.has_value());
    tools_.tools = {MakeTool(1, 120.0, "MILL"), MakeTool(2, 150.0, "BALL")};
    job_.start_tool = 1;
  }
  void Run(const std::string& text) {
    Sink sink;
    SourceFiles files;
    std::vector<control::PartFrame> part_frames;
    const control::RunSummary summary =
        control::RunSinumerik840d(nc::Program::FromText("fuzz.mpf", text), *machine_, job_, tools_,
                                  &files, &part_frames, &sink, kMaxBlocks);
    EXPECT_TRUE(summary.finished || sink.findings > 0) << "stopped without saying why";
    EXPECT_LE(summary.blocks, kMaxBlocks);
    motions_ += sink.motions;
  }

  std::optional<machine::Machine> machine_;
  machine::Job job_;
  machine::ToolTable tools_;
  long motions_ = 0;
};

TEST_F(SinumerikRunFuzz, MutatedPrograms) {
  Random random(20261122);
  constexpr int kPrograms = 30'000;
  for (int i = 0; i < kPrograms; ++i) {
    std::string text = "G54 G0 X0 Y0 Z50 D1\nS1000 M3 F500\n";
    const std::size_t blocks = 3 + random.Below(25);
    for (std::size_t b = 0; b < blocks; ++b) {
      text += std::string(kBlocks[random.Below(kBlocks.size())]) + "\n";
    }
    text += kSubprogram;
    const std::size_t mutations = random.Below(5);
    for (std::size_t m = 0; m < mutations && text.size() < 3000; ++m) {
      Mutate(kLanguage, &random, &text);
    }
    job_.control = {{"MD21104", random.Below(4) == 0 ? "0" : "1"},
                    {"MD21108", random.Below(2) == 0 ? "0" : "1"},
                    {"MD21180", std::string(1, "012"[random.Below(3)])},
                    {"MD10602", std::string(1, "012"[random.Below(3)])},
                    {"MD30455[C]", random.Below(2) == 0 ? "0" : "5"},
                    {"SD42940", random.Below(2) == 0 ? "0" : "17"}};
    Run(text);
    if (HasFailure()) FAIL() << "program " << i << ":\n" << testing::PrintToString(text);
  }
  // The programs do something.
  EXPECT_GT(motions_, 2L * kPrograms);
}

}  // namespace
}  // namespace ncsim
