// SPDX-License-Identifier: BSD-3-Clause
// Jumps, control structures and repetitions of the SINUMERIK language (NC programming 12/2019,
// "Program jumps and branches", "Repeat program section", "Control structures").
#include "sim/control/sinumerik_flow.h"

#include <gtest/gtest.h>

#include "sim/control/sinumerik_test_run.h"

namespace ncsim::control {
namespace {

std::string Trace(const std::string& text) { return SinumerikTestRun(text).trace; }
std::string First(const std::string& text) { return SinumerikTestRun(text).First(); }

TEST(SinumerikFlowTest, JumpsByLabelNumberAndText) {
  EXPECT_EQ(Trace("GOTOF LA\nX1\nLA: X2\nM30\n"), "X2|M30|");
  EXPECT_EQ(Trace("GOTOF N20\nN10 X1\nN20 X2\n"), "X2|");
  EXPECT_EQ(Trace("GOTO LB\nLA: X1\nGOTOF LC\nLB: X2\nGOTO LA\nLC: X3\n"), "X2|X1|X3|");
  EXPECT_EQ(Trace("R1=2\nGOTOF \"LBL\"<<R1\nLBL1: X1\nLBL2: X2\n"), "X2|");
  EXPECT_EQ(Trace("DEF STRING[8] DEST=\"LB\"\nGOTOF DEST\nX1\nLB: X2\n"), "X2|");
  EXPECT_EQ(Trace("R1=R1+1\nX1\nIF R1<3 GOTOS\nX2\n"), "X1|X1|X1|X2|");
}

TEST(SinumerikFlowTest, DirectionOfAJump) {
  // The label stands on both sides.
  EXPECT_EQ(Trace("LA: X1\nR1=R1+1\nIF R1==2 GOTOF LE\nGOTOB LA\nLA: X2\nLE: X3\n"), "X1|X1|X3|");
  EXPECT_EQ(Trace("LA: X1\nR1=R1+1\nIF R1==2 GOTOF LE\nGOTOF LA\nLA: X2\nLE: X3\n"), "X1|X2|X3|");
  EXPECT_EQ(Trace("LA: X1\nR1=R1+1\nIF R1==2 GOTOF LE\nGOTO LA\nLA: X2\nLE: X3\n"), "X1|X2|X3|");
}

TEST(SinumerikFlowTest, AMissingTargetIsAlarm14080ExceptForGotoc) {
  EXPECT_EQ(First("X1\nN10 GOTOF LX\n"), "2:11 14080");
  EXPECT_EQ(First("LX: X1\nGOTOF LX\n"), "2:7 14080");
  EXPECT_EQ(First("GOTOB LX\nLX: X1\n"), "1:7 14080");
  EXPECT_EQ(Trace("GOTOC LX\nX1\n"), "X1|");
  EXPECT_EQ(First("GOTOC LX\nX1\n"), "");
}

TEST(SinumerikFlowTest, IfOnOneLine) {
  const std::string text =
      "IF DP==0 GOTOF _MM0 IF DP==1 GOTOF _MM1\nX9\nM30\n_MM0: X0\nM30\n_MM1: X1\n";
  EXPECT_EQ(Trace("DEF INT DP=0\n" + text), "X0|M30|");
  EXPECT_EQ(Trace("DEF INT DP=1\n" + text), "X1|");
  EXPECT_EQ(Trace("DEF INT DP=2\n" + text), "X9|M30|");
}

TEST(SinumerikFlowTest, IfElse) {
  const std::string text = "IF R1==1\nX1\nIF R2\nX2\nELSE\nX3\nENDIF\nELSE\nX4\nENDIF\nX5\n";
  EXPECT_EQ(Trace("R1=1 R2=1\n" + text), "X1|X2|X5|");
  EXPECT_EQ(Trace("R1=1 R2=0\n" + text), "X1|X3|X5|");
  EXPECT_EQ(Trace("R1=0 R2=0\n" + text), "X4|X5|");
}

TEST(SinumerikFlowTest, Loops) {
  EXPECT_EQ(Trace("FOR R1=1 TO 3\nX=R1\nENDFOR\nY1\n"), "X=1|X=2|X=3|Y1|");
  EXPECT_EQ(Trace("FOR R1=4 TO 3\nX=R1\nENDFOR\nY1\n"), "Y1|");
  EXPECT_EQ(Trace("DEF INT II,JJ\nFOR II=1 TO 2\nFOR JJ=II TO 2\nX=10*II+JJ\nENDFOR\nENDFOR\n"),
            "X=11|X=12|X=22|");
  EXPECT_EQ(Trace("WHILE R1<2\nR1=R1+1\nX=R1\nENDWHILE\n"), "X=1|X=2|");
  EXPECT_EQ(Trace("REPEAT\nR1=R1+1\nX=R1\nUNTIL R1>=2\n"), "X=1|X=2|");
  EXPECT_EQ(Trace("LOOP\nR1=R1+1\nX=R1\nIF R1==2 GOTOF LE\nENDLOOP\nLE: Y1\n"), "X=1|X=2|Y1|");
}

TEST(SinumerikFlowTest, AnEndlessLoopIsStopped) {
  SinumerikTestRun run("LOOP\nENDLOOP\n");
  EXPECT_EQ(run.last, SinumerikEvent::kStopped);
  EXPECT_EQ(run.First(), "1:1 unsupported-code");
}

TEST(SinumerikFlowTest, StructuresThatDoNotMatch) {
  EXPECT_EQ(First("IF R1\nX1\n"), "1:1 12640");
  EXPECT_EQ(First("X1\nENDIF\n"), "2:1 12640");
  EXPECT_EQ(First("WHILE R1==0\nIF R1==0\nENDWHILE\nENDIF\n"), "1:1 12640");
  EXPECT_EQ(First("LA: IF R1\nENDIF\n"), "1:5 12630");
  EXPECT_EQ(First("/ENDIF\n"), "1:2 12630");
  std::string deep;
  for (int i = 0; i < 17; ++i) deep += "IF 1\n";
  for (int i = 0; i < 17; ++i) deep += "ENDIF\n";
  EXPECT_EQ(First(deep), "17:1 12641");
}

TEST(SinumerikFlowTest, Case) {
  const std::string text =
      "CASE R1 OF 1 GOTOF LA -2 GOTOF LB DEFAULT GOTOF LC\nLA: X1\nM30\nLB: X2\nM30\nLC: X3\n";
  EXPECT_EQ(Trace("R1=1\n" + text), "X1|M30|");
  EXPECT_EQ(Trace("R1=-2\n" + text), "X2|M30|");
  EXPECT_EQ(Trace("R1=7\n" + text), "X3|");
  EXPECT_EQ(Trace("CASE 5 OF 1 GOTOF LA\nX9\nLA: X1\n"), "X9|X1|");
}

TEST(SinumerikFlowTest, RepeatOfSections) {
  // From the label to the REPEAT, P more times.
  EXPECT_EQ(Trace("LA: X1\nX2\nREPEAT LA P=2\nX3\n"), "X1|X2|X1|X2|X1|X2|X3|");
  EXPECT_EQ(Trace("LA: X1\nREPEAT LA\nX3\n"), "X1|X1|X3|");
  EXPECT_EQ(Trace("LA: X1\nREPEAT LA P=0\nX3\n"), "X1|X3|");
  // To ENDLABEL.
  EXPECT_EQ(Trace("LA: X1\nENDLABEL: X2\nX3\nREPEAT LA\nX4\n"), "X1|X2|X3|X1|X2|X4|");
  // Two labels, both blocks included.
  EXPECT_EQ(Trace("LA: X1\nLB: X2\nX3\nREPEAT LA LB P=1\nX4\n"), "X1|X2|X3|X1|X2|X4|");
  // One block.
  EXPECT_EQ(Trace("X0\nLA: X1\nX2\nREPEATB LA P=2\nX3\n"), "X0|X1|X2|X1|X1|X3|");
  // In front of what it repeats.
  EXPECT_EQ(Trace("REPEAT LA LB\nGOTOF LE\nLA: X1\nLB: X2\nLE: X3\n"), "X1|X2|X3|");
  EXPECT_EQ(First("REPEAT LX\n"), "1:8 14080");
}

TEST(SinumerikFlowTest, AJumpOutOfARepetitionEndsIt) {
  EXPECT_EQ(Trace("LA: X1\nR1=R1+1\nIF R1==2 GOTOF LE\nREPEAT LA P=5\nX2\nLE: X3\n"), "X1|X1|X3|");
}

TEST(SinumerikFlowTest, BlockSkip) {
  SinumerikFlowOptions options;
  options.skip_levels = 1u << 0 | 1u << 3;
  EXPECT_EQ(SinumerikTestRun("/X1\n/1 X2\n/3 X3\nX4\n", options).trace, "X2|X4|");
  EXPECT_EQ(Trace("/X1\n/3 X3\n"), "X1|X3|");
  // What is skipped may be wrong.
  EXPECT_EQ(SinumerikTestRun("/ X=\nX4\n", options).First(), "");
}

TEST(SinumerikFlowTest, ASyntaxErrorStopsAndTheOthersAreReported) {
  SinumerikTestRun run("X1\nX=\nX2\nY=(1\n");
  EXPECT_EQ(run.last, SinumerikEvent::kStopped);
  EXPECT_EQ(run.trace, "X1|");
  ASSERT_EQ(run.findings.size(), 2u);
  EXPECT_EQ(run.findings[1].where.line, 4);
  EXPECT_EQ(run.findings[1].rule, Rule::kSyntax);
}

TEST(SinumerikFlowTest, WhatIsNotSimulatedIsNamed) {
  SinumerikTestRun run("ID=1 WHEN TRUE DO M8 X100\nSETINT(1) PRIO=2 LIFT\nR1=1 X1\n");
  ASSERT_EQ(run.findings.size(), 2u);
  EXPECT_NE(run.findings[0].message.find("synchronised action (ID)"), std::string::npos);
  EXPECT_NE(run.findings[1].message.find("SETINT"), std::string::npos);
  EXPECT_EQ(run.findings[1].rule, Rule::kUnsupportedCode);
  EXPECT_EQ(run.trace, "X1|");  // None of its words is left to the block.
}

TEST(SinumerikFlowTest, MacrosStandForTheirText) {
  // NC programming 12/2019, "Macro technique": names, M functions, parts of expressions; not in
  // strings and comments, and only in the program that defines them.
  SinumerikTestRun run(
      "DEFINE GOHOME AS G0 X0 ; home\nDEFINE M6 AS L6\nDEFINE _DEC2 AS MOD 100 DIV 10\n"
      "GOHOME Y1 ; GOHOME\nR1=1234 _DEC2\nMSG(\"GOHOME\")\nX=R1 M6\nM60\nM30\n"
      "%_N_L6_SPF\nZ1\nGOHOME\nM17\n");
  EXPECT_EQ(run.Value("R1"), 3.0);
  EXPECT_EQ(run.trace.substr(0, run.trace.find("Z1")), "G0 X0 Y1|MSG(GOHOME)|X=3|") << run.trace;
  ASSERT_FALSE(run.findings.empty());
  EXPECT_EQ(run.findings[0].where.line, 12);
}

TEST(SinumerikFlowTest, FindingsInAMacroStandWhereItsNameDoes) {
  SinumerikTestRun run("DEFINE GOHOME AS G0 X0 Y=NOTHING\nX1\nZ1 GOHOME Z2\n");
  EXPECT_EQ(run.First(), "3:4 12550");
}

TEST(SinumerikFlowTest, AMacroThatIsNotSimulatedIsNamedWhereItIsUsed) {
  // What is looked up in the text itself, and macros of macros.
  for (const char* name : {"G0", "R1", "TRANS", "X1"}) {
    EXPECT_FALSE(SinumerikTestRun(std::string("DEFINE ") + name + " AS G1\n").findings.empty());
  }
  for (const char* body : {"WHILE R1<2", "LA: X1", "OTHER X1", "DEF REAL AA", "ROUND_X"}) {
    SinumerikTestRun run(std::string("DEFINE OTHER AS G0\nDEFINE ROUND_X AS ") + body +
                         "\nX1\nROUND_X\nX=ROUND_X\n");
    ASSERT_GE(run.findings.size(), 2u) << body;
    for (const Finding& finding : run.findings) EXPECT_EQ(finding.rule, Rule::kUnsupportedCode);
  }
}

}  // namespace
}  // namespace ncsim::control
