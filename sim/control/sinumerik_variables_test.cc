// SPDX-License-Identifier: BSD-3-Clause
// Variables and values of the SINUMERIK language as a program uses them (NC programming 12/2019,
// "User variables", "Arrays", "Indirect programming").
#include "sim/control/sinumerik_variables.h"

#include <gtest/gtest.h>

#include "sim/control/sinumerik_test_run.h"

namespace ncsim::control {
namespace {

std::string Trace(const std::string& text) { return SinumerikTestRun(text).trace; }
std::string First(const std::string& text) { return SinumerikTestRun(text).First(); }

TEST(SinumerikVariablesTest, EveryType) {
  SinumerikTestRun run(
      "DEF INT II=2.5\n"
      "DEF REAL RR=1, RS\n"
      "DEF BOOL BB=7\n"
      "DEF CHAR CC=\"A\"\n"
      "DEF STRING[5] SS=\"abc\"\n"
      "DEF AXIS AA=X1\n"
      "DEF FRAME FF=CTRANS(X,1,Y,2)\n"
      "DEF NCK REAL GG=3\n"
      "SS=SS<<II FF[X,TR]=5 RS=FF[X,TR]+FF[Y,TR] AX[AA]=RS\n");
  EXPECT_EQ(run.First(), "");
  EXPECT_EQ(run.Value("II"), 3.0);  // REAL is rounded to INT.
  EXPECT_EQ(run.Value("BB"), 1.0);
  EXPECT_EQ(run.Text("CC"), "A");
  EXPECT_EQ(run.Text("SS"), "abc3");
  EXPECT_EQ(run.Text("AA"), "X1");
  EXPECT_EQ(run.Value("RS"), 7.0);
  EXPECT_EQ(run.Value("GG"), 3.0);
  EXPECT_EQ(run.trace, "AX=7|");
}

TEST(SinumerikVariablesTest, StartValues) {
  SinumerikTestRun run("DEF INT II\nDEF STRING[5] SS\nDEF REAL RR\nDEF BOOL BB\n");
  EXPECT_EQ(run.Value("II"), 0.0);
  EXPECT_EQ(run.Text("SS"), "");
  EXPECT_EQ(run.Value("BB"), 0.0);
}

TEST(SinumerikVariablesTest, Arrays) {
  SinumerikTestRun run(
      "DEF REAL MM[2,3]=SET(1,2,3,,5), NN[4]=REP(7)\n"
      "NN[1]=SET(8,9)\n"
      "R1=MM[0,2] R2=MM[1,0] R3=MM[1,1] R4=NN[0] R5=NN[1] R6=NN[2] R7=NN[3]\n"
      "MM=REP(0)\n"
      "R8=MM[0,0]\n");
  EXPECT_EQ(run.First(), "");
  const double expected[] = {3, 0, 5, 7, 8, 9, 7, 0};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(run.Value("R" + std::to_string(i + 1)), expected[i]) << i;
}

TEST(SinumerikVariablesTest, CharactersOfAString) {
  EXPECT_EQ(Trace("DEF STRING[5] SS=\"abc\"\nDEF STRING[9] TT\nTT=<<SS[2]<<SS[0]\nT=TT\n"),
            "T=ca|");
  EXPECT_EQ(First("DEF STRING[5] SS=\"abc\"\nR1=SS[3]\n"), "2:4 17020");
}

TEST(SinumerikVariablesTest, RParametersAreKeptByTheControl) {
  SinumerikTestRun run("R1=R102+1 R[R1+1]=R102\nX=R1\n");
  EXPECT_EQ(run.trace, "X=1|");
  EXPECT_EQ(run.system.assumed, "R102 ");  // Once; R1 has been set.
}

TEST(SinumerikVariablesTest, OtherWaysToAnRParameter) {
  EXPECT_EQ(Trace("$R3=5 R[2]=$R3+1\nX=R2\nFOR R[4]=1 TO 2\nY=R4\nENDFOR\n"), "X=6|Y=1|Y=2|");
  EXPECT_EQ(First("R1=ISVAR(\"R5\")+2*ISVAR(\"_NONE\")\nX=_V\n"), "2:3 12550");
  EXPECT_EQ(SinumerikTestRun("DEF REAL VV\nR1=ISVAR(\"VV\")+2*ISVAR(\"_NONE\")\n").Value("R1"),
            1.0);
  EXPECT_EQ(First("R1=RG5\n"), "1:4 unsupported-code");
}

TEST(SinumerikVariablesTest, NamesHaveNoCaseAndStringsHave) {
  EXPECT_EQ(Trace("DEF REAL _Home=3\nx=_HOME T=\"Mill\"\n"), "x=3 T=Mill|");
}

TEST(SinumerikVariablesTest, ConstantsOfCycles) {
  // CYCLE832(tolerance, type, 1): _ORI_ROUGH is 13, rough with orientation tolerance.
  EXPECT_EQ(Trace("CYCLE832(0.01,_ORI_ROUGH,1)\n"), "CYCLE832(0.01,13,1)|");
}

TEST(SinumerikVariablesTest, AlarmsAtTheirPlaces) {
  EXPECT_EQ(First("X1\nX=_NONE\n"), "2:3 12550");
  EXPECT_EQ(First("_NONE=1\n"), "1:1 12550");
  EXPECT_EQ(First("DEF INT II=1\nDEF REAL II\n"), "2:10 12170");
  EXPECT_EQ(First("DEF REAL TRAORI\n"), "1:10 12170");
  EXPECT_EQ(First("DEF INT AA[3]\nR1=AA[3]\n"), "2:4 17020");
  EXPECT_EQ(First("DEF INT AA[3,2]\nR1=AA[0,-1]\n"), "2:4 17030");
  EXPECT_EQ(First("DEF INT AA[3]\nR1=AA\n"), "2:4 12400");
  EXPECT_EQ(First("DEF INT AA[2]=SET(1,2,3)\n"), "1:9 12260");
  EXPECT_EQ(First("DEF INT AA[0]\n"), "1:9 12430");
  EXPECT_EQ(First("DEF INT II=\"A\"\n"), "1:9 12150");
  EXPECT_EQ(First("DEF INT II=3EX9\n"), "1:9 12160");
  EXPECT_EQ(First("DEF STRING[2] SS=\"abc\"\n"), "1:15 12210");
  EXPECT_EQ(First("R1=1/0\n"), "1:5 14051");
  EXPECT_EQ(First("R1=\"A\"*2\n"), "1:7 12150");
  EXPECT_EQ(First("R1000=1\n"), "1:1 17020");
  EXPECT_EQ(First("DEF REAL BIG[65535,2]\n"), "1:10 12430");
}

TEST(SinumerikVariablesTest, MemoryIsBounded) {
  std::string text;
  for (int i = 0; i < 5; ++i) text += "DEF REAL BB" + std::to_string(i) + "[65000]\n";
  EXPECT_EQ(First(text), "4:10 12380");
}

TEST(SinumerikVariablesTest, SystemVariables) {
  SinumerikTestRun run(
      "$P_UIFR[1,X,TR]=-250.5\n"
      "$TC_DP3[2,1]=120\n"
      "$P_UIFR[1]=CTRANS(X,1):CROT(Z,90)\n"
      "Z=$TC_DP3[2,1]+$P_UIFR[1,X,TR]\n"
      "R1=$PI\n"
      "X=$AC_TIMER[1]\n"
      "X9\n");
  EXPECT_EQ(run.trace, "Z=-130.5|");
  EXPECT_EQ(run.system.values.at("$P_UIFR[1]").frame->chain.size(), 2u);
  EXPECT_NEAR(run.Value("R1"), 3.14159265, 1e-8);
  // What is not known is no guess: the program stops there, unproven.
  EXPECT_EQ(run.First(), "6:3 unsupported-code");
  EXPECT_EQ(run.last, SinumerikEvent::kStopped);
  EXPECT_EQ(SinumerikTestRun("$AN_NO=1\nX1\n").First(), "1:1 unsupported-code");
}

TEST(SinumerikVariablesTest, WordsWithTheirModifiers) {
  SinumerikTestRun run("X1\n");
  SinumerikStep step;
  SinumerikTestSystem system;
  SourceFiles files;
  SinumerikFlow flow(
      nc::Program::FromText(
          "t", "G1 X=IC(2*3) C=DC(-5) I=AC(R0+1) M1=6 S3=2400 CR=5 AX[X1]=IC(7) POS[B]=2 G505\n"),
      {}, &system, &files, [](const Finding& finding) { ADD_FAILURE() << finding.message; });
  ASSERT_EQ(flow.Next(&step), SinumerikEvent::kStep);
  ASSERT_EQ(step.items.size(), 10u);
  EXPECT_EQ(step.items[0].command->group, 1);
  EXPECT_EQ(step.items[1].letter, 'X');
  EXPECT_EQ(step.items[1].value, 6.0);
  EXPECT_EQ(step.items[1].modifier, nc::SinumerikModifier::kIc);
  EXPECT_EQ(step.items[2].value, -5.0);
  EXPECT_EQ(step.items[3].modifier, nc::SinumerikModifier::kAc);
  EXPECT_EQ(step.items[4].extension, 1);
  EXPECT_EQ(step.items[4].value, 6.0);
  EXPECT_EQ(step.items[5].extension, 3);
  EXPECT_EQ(step.items[6].command->name, "CR");
  EXPECT_EQ(step.argument(step.items[7], 0).text, "X1");
  EXPECT_EQ(step.items[7].modifier, nc::SinumerikModifier::kIc);
  EXPECT_EQ(step.items[8].command->name, "POS");
  EXPECT_EQ(step.items[9].command->name, "G505");
  EXPECT_EQ(step.items[9].column, 74);
}

TEST(SinumerikVariablesTest, WordsThatStandTwice) {
  EXPECT_EQ(First("X1 Y2 X3\n"), "1:7 16420");
  EXPECT_EQ(First("F1 F2\n"), "1:4 12010");
  EXPECT_EQ(First("S1=100 S2=200 M3 M8\n"), "");
  EXPECT_EQ(First("M1 M2=3 M4 M5 M7 M8\n"), "1:18 12010");
  EXPECT_EQ(First("G0 G1 X1\n"), "1:4 12060");
  EXPECT_EQ(First("G0 G90 G54 X1\n"), "");
  EXPECT_EQ(First("TRANS X1 ROT\n"), "1:10 12070");
  EXPECT_EQ(First("G4 F1 TRANS\n"), "1:7 12070");
  EXPECT_EQ(First("G8\n"), "1:1 12470");
  EXPECT_EQ(First("G=8\n"), "1:1 12475");
  EXPECT_EQ(Trace("G=54 G00 X1\n"), "G G00 X1|");
}

}  // namespace
}  // namespace ncsim::control
