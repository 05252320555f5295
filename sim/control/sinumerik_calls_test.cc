// SPDX-License-Identifier: BSD-3-Clause
// Subprograms, cycles and modal calls of the SINUMERIK language (NC programming 12/2019,
// "Subprogram technique").
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sim/control/sinumerik_test_run.h"

namespace ncsim::control {
namespace {

namespace fs = std::filesystem;

/// A text with a main program and subprograms.
std::string Archive(const std::string& main, const std::string& subprograms) {
  return "%_N_PART_MPF\n;$PATH=/_N_MPF_DIR\n" + main + "M30\n" + subprograms;
}
std::string Trace(const std::string& main, const std::string& subprograms) {
  return SinumerikTestRun(Archive(main, subprograms)).trace;
}
std::string First(const std::string& main, const std::string& subprograms) {
  return SinumerikTestRun(Archive(main, subprograms)).First();
}

TEST(SinumerikCallsTest, ByNameAndByL) {
  EXPECT_EQ(Trace("POCK\nX2\n", "%_N_POCK_SPF\nX1\nM17\n"), "X1|M17|X2|M30|");
  EXPECT_EQ(Trace("pock\nX2\n", "%_N_POCK_SPF\nX1\nRET\n"), "X1|X2|M30|");
  EXPECT_EQ(Trace("L0054\nL54\n", "%_N_L54_SPF\nX54\nRET\n%_N_L0054_SPF\nX0054\nRET\n"),
            "X0054|X54|M30|");
  EXPECT_EQ(Trace("POCK P3\n", "%_N_POCK_SPF\nX1\n"), "X1|X1|X1|M30|");  // The text's end returns.
  EXPECT_EQ(Trace("L7 P=R1+2\n", "%_N_L7_SPF\nX1\nM2\n"), "X1|M2|X1|M2|M30|");
  EXPECT_EQ(Trace("CALL \"PO\"<<\"CK\"\n", "%_N_POCK_SPF\nX1\n"), "X1|M30|");
  EXPECT_EQ(Trace("PCALL /_N_CUS_DIR/_N_POCK_SPF(4)\n", "%_N_POCK_SPF\nPROC POCK(REAL AA)\nX=AA\n"),
            "X=4|M30|");
  EXPECT_EQ(Trace("EXTCALL(\"SUB/POCK.SPF\")\n", "%_N_POCK_SPF\nX1\n"), "X1|M30|");
}

TEST(SinumerikCallsTest, TheFirstMainProgramOfAnArchiveIsRun) {
  EXPECT_EQ(
      SinumerikTestRun("%_N_SUB_SPF\nX1\nM17\n%_N_PART_MPF\nSUB\nX2\nM30\n%_N_B_MPF\nX3\n").trace,
      "X1|M17|X2|M30|");
}

TEST(SinumerikCallsTest, AProgramEndsAtTheNextHeader) {
  EXPECT_EQ(Trace("EMPTY P2\n", "%_N_EMPTY_SPF\n; nothing\n%_N_NEXT_SPF\nX1\n"), "M30|");
  EXPECT_EQ(SinumerikTestRun("%_N_A_MPF\n%_N_B_SPF\nX1\n").trace, "");
  EXPECT_EQ(SinumerikTestRun("; made by hand\n%_N_A_MPF\nX1\n%_N_B_SPF\nX2\n").trace, "X1|");
}

TEST(SinumerikCallsTest, Parameters) {
  const std::string head =
      "%_N_SUB_SPF\nPROC SUB(REAL AA, INT BB=9, STRING[20] CC, AXIS DD=X, BOOL EE)\n";
  const std::string body = "X=AA Y=BB T=CC AX[DD]=EE\nRET\n";
  EXPECT_EQ(Trace("SUB(1.5,2.5,\"a\",Y,TRUE)\n", head + body), "X=1.5 Y=3 T=a AX=1|M30|");
  EXPECT_EQ(Trace("SUB(1,,\"b\")\n", head + body), "X=1 Y=9 T=b AX=0|M30|");
  EXPECT_EQ(Trace("SUB\n", head + body), "X=0 Y=9 T= AX=0|M30|");
  EXPECT_EQ(Trace("SUB(,5)\n", head + "R1=$P_SUBPAR[1] R2=$P_SUBPAR[2]\nX=R1 Y=R2\n"),
            "X=0 Y=1|M30|");
  EXPECT_EQ(First("SUB(1,2,\"a\",X,1,7)\n", head + body), "3:1 12340");
  EXPECT_EQ(First("SUB(\"a\")\n", head + body), "3:1 12150");
  EXPECT_EQ(First("OTHER(1)\n", "%_N_OTHER_SPF\nX1\n"), "3:1 12340");
}

TEST(SinumerikCallsTest, VarParametersChangeTheirArguments) {
  const std::string sub = "%_N_SUB_SPF\nPROC SUB(VAR REAL AA, REAL BB)\nAA=AA+1 BB=BB+1\nRET\n";
  EXPECT_EQ(Trace("DEF REAL UU=1,VV=1\nSUB(UU,VV)\nX=UU Y=VV\n", sub), "X=2 Y=1|M30|");
  EXPECT_EQ(Trace("R5=7\nSUB(R5,1)\nX=R5\n", sub), "X=8|M30|");
  EXPECT_EQ(Trace("DEF REAL AF[3]\nSUB(AF[1],1)\nX=AF[0] Y=AF[1]\n", sub), "X=0 Y=1|M30|");
  EXPECT_EQ(Trace("DEF REAL AF[2]\nSUB(AF)\nX=AF[1]\n",
                  "%_N_SUB_SPF\nPROC SUB(VAR REAL FF[2])\nFF[1]=4\n"),
            "X=4|M30|");
  EXPECT_EQ(First("SUB(1,1)\n", sub), "3:1 12320");
  EXPECT_EQ(First("DEF INT II\nSUB(II,1)\n", sub), "4:1 12330");
}

TEST(SinumerikCallsTest, VariablesBelongToTheirProgram) {
  // MD11120 = 0: a subprogram does not see what the main program defines.
  EXPECT_EQ(First("DEF REAL VV=1\nSUB\n", "%_N_SUB_SPF\nX=VV\n"), "7:3 12550");
  EXPECT_EQ(Trace("DEF REAL VV=1\nSUB\nX=VV\n", "%_N_SUB_SPF\nDEF REAL VV=2\nX=VV\n"),
            "X=2|X=1|M30|");
  EXPECT_EQ(Trace("SUB P2\n", "%_N_SUB_SPF\nDEF REAL VV\nVV=VV+1\nX=VV\n"), "X=1|X=1|M30|");
}

TEST(SinumerikCallsTest, SaveIsHandedOut) {
  EXPECT_EQ(Trace("SUB\nX2\n", "%_N_SUB_SPF\nPROC SUB SAVE DISPLOF\nG91 X1\nM17\n"),
            "<save>G91 X1|M17|<restore>X2|M30|");
}

TEST(SinumerikCallsTest, CallOfABlock) {
  EXPECT_EQ(Trace("CALL BLOCK LA TO LB\nGOTOF LE\nLA: X1\nX2\nLB: X3\nLE: X4\n", ""),
            "X1|X2|X3|X4|M30|");
  EXPECT_EQ(Trace("CALL \"SUB\" BLOCK LA TO LA\n", "%_N_SUB_SPF\nX1\nLA: X2\nX3\n"), "X2|M30|");
  EXPECT_EQ(First("CALL BLOCK LA TO LB\nLA: X1\n", ""), "3:18 14082");
  EXPECT_EQ(Trace("CALL \"SUB\" BLOCK LA TO LB\nX9\n",
                  "%_N_SUB_SPF\nLA: R1=R1+1\nX=R1\nIF R1<2 GOTOB LA\nLB: X3\n"),
            "X=1|X=2|X3|X9|M30|");
}

TEST(SinumerikCallsTest, NestingIsBounded) {
  EXPECT_EQ(First("SUB\n", "%_N_SUB_SPF\nSUB\n"), "6:1 14012");
}

TEST(SinumerikCallsTest, WhatIsNotFoundIsNamedAndTheProgramGoesOn) {
  SinumerikTestRun run("TRAOOF\nFAZOWANIE(1,2,,3)\nX1\n");
  ASSERT_EQ(run.findings.size(), 2u);
  EXPECT_EQ(run.findings[0].rule, Rule::kUnsupportedCode);
  EXPECT_NE(run.findings[0].message.find("did you mean 'TRAFOOF'"), std::string::npos);
  EXPECT_NE(run.findings[1].message.find("FAZOWANIE"), std::string::npos);
  EXPECT_NE(run.findings[1].message.find("14011"), std::string::npos);
  EXPECT_EQ(run.trace, "X1|");
}

TEST(SinumerikCallsTest, FilesOfTheSearchFolders) {
  const fs::path folder =
      fs::temp_directory_path() / ("ncsim_sinumerik_calls_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "Pock.spf") << "PROC POCK(REAL AA)\nX=AA\nRET\n";
  std::ofstream(folder / "_N_L77_SPF") << "X77\nM17\n";
  SinumerikFlowOptions options;
  options.subprogram_folders = {folder.string()};
  SinumerikTestRun run("POCK(3)\nL77\nM30\n", options);
  fs::remove_all(folder);
  EXPECT_EQ(run.First(), "");
  EXPECT_EQ(run.trace, "X=3|X77|M17|M30|");
  EXPECT_EQ(fs::path(run.files.name(1)).filename(), "Pock.spf");
}

// --- cycles and procedures of the control ---

TEST(SinumerikCallsTest, CyclesWithOmittedArguments) {
  EXPECT_EQ(
      Trace("CYCLE83(R1+10,0,2,,,-5,,2.,,0)\nCYCLE800()\nTRAORI\nTRAORI(1)\nMSG(\"A;b\")\n", ""),
      "CYCLE83(10,0,2,,,-5,,2,,0)|CYCLE800()|TRAORI()|TRAORI(1)|MSG(A;b)|M30|");
  // Words of its own stand beside a procedure.
  EXPECT_EQ(Trace("TRAFOOF G54 X1\nSUPA G0 Z=R1 D0\n", ""), "TRAFOOF() G54 X1|SUPA G0 Z=0 D0|M30|");
  EXPECT_EQ(First("COMPOF(1)\n", ""), "3:1 12080");
  EXPECT_EQ(First("CR\n", ""), "3:1 12080");
}

TEST(SinumerikCallsTest, ModalCycle) {
  // The arguments are those of the MCALL; only blocks with path motion call it.
  EXPECT_EQ(Trace("R1=1\nMCALL CYCLE81(R1,,2)\nX1\nR1=2\nM8\nX2\nMCALL\nX3\n", ""),
            "X1|<CYCLE81(1,,2)>M8|X2|<CYCLE81(1,,2)>X3|M30|");
}

TEST(SinumerikCallsTest, ACycleThatIsThereAsText) {
  // CYCLE92 is not simulated: the user's own text of that name is run.
  EXPECT_EQ(Trace("CYCLE92(3)\nX9\n", "%_N_CYCLE92_SPF\nPROC CYCLE92(REAL AA)\nX=AA\nRET\n"),
            "X=3|X9|M30|");
  EXPECT_EQ(Trace("CYCLE92(3)\nX9\n", ""), "CYCLE92(3)|X9|M30|");
}

TEST(SinumerikCallsTest, PassesOfWhatIsNotFoundAreNoWord) {
  EXPECT_EQ(Trace("L99 P3\nX1\n", ""), "X1|M30|");
  EXPECT_EQ(Trace("POCK P0\nX1\n", "%_N_POCK_SPF\nX2\n"), "X1|M30|");
  EXPECT_EQ(First("L99 P-1\n", ""), "3:1 unsupported-code");
}

TEST(SinumerikCallsTest, ModalSubprogram) {
  const std::string sub = "%_N_DRILL_SPF\nPROC DRILL(REAL AA)\nX=AA\nZ1\nRET\n";
  // Its own motion calls nothing.
  EXPECT_EQ(Trace("MCALL DRILL(7)\nX1\nX2\nMCALL\nX3\n", sub), "X1|X=7|Z1|X2|X=7|Z1|X3|M30|");
  // Nor does the motion of what it calls.
  EXPECT_EQ(Trace("MCALL DRILL\nX1\n", "%_N_DRILL_SPF\nDEEP\nRET\n%_N_DEEP_SPF\nX5\nRET\n"),
            "X1|X5|M30|");
  EXPECT_EQ(First("MCALL NODRILL(7)\nX1\n", ""), "3:1 unsupported-code");
}

TEST(SinumerikCallsTest, Setal) {
  EXPECT_EQ(First("X1\n  SETAL(61101)\n", ""), "4:3 control-alarm");
  SinumerikTestRun run("SETAL(66021,\"no clamp\")\nX1\n");
  EXPECT_NE(run.findings.at(0).message.find("66021"), std::string::npos);
  EXPECT_NE(run.findings.at(0).message.find("no clamp"), std::string::npos);
  EXPECT_EQ(run.last, SinumerikEvent::kStopped);
  EXPECT_EQ(Trace("SETAL(65000)\nX1\n", ""), "X1|M30|");  // A message.
}

TEST(SinumerikCallsTest, TheEndOfTheProgram) {
  EXPECT_EQ(SinumerikTestRun("X1\nM30\nX2\n").trace, "X1|M30|");
  EXPECT_EQ(SinumerikTestRun("X1 M2\nX2\n").trace, "X1 M2|");
  EXPECT_EQ(SinumerikTestRun("X1\n").last, SinumerikEvent::kEnd);
}

}  // namespace
}  // namespace ncsim::control
