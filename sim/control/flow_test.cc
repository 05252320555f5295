// SPDX-License-Identifier: BSD-3-Clause
// Expected behaviour: Haas NGC Mill Operator's Manual 2017, "Macros (Optional)", "M96" to "M99";
// the programs marked "manual" are its own examples.
#include "sim/control/flow.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/text.h"

namespace ncsim::control {
namespace {

class System : public SystemVariables {
 public:
  bool Read(long number, nc::MacroValue* value) override {
    if (number < 2000 || number > 20999) return false;
    const auto found = values.find(number);
    *value = found == values.end() ? nc::MacroValue() : found->second;
    return true;
  }
  bool Write(long number, nc::MacroValue value) override {
    if (number < 2000 || number > 20999) return false;
    values[number] = value;
    return true;
  }
  void AssumeUndefined(long number) override { assumed.push_back(number); }
  int length_decimals() const override { return decimals; }

  std::vector<long> assumed;
  std::map<long, nc::MacroValue> values;
  int decimals = 4;
};

struct Result {
  std::string blocks;    ///< "G1 X1.5 | Y2": what was handed out.
  std::string findings;  ///< "3:5 control-alarm; ..."
  std::vector<Finding> all;
  bool stopped = false;
  std::uint64_t executed = 0;
  std::vector<std::string> files;
};

std::string WordsText(const ResolvedBlock& block) {
  std::string text;
  for (const ResolvedWord& word : block.words) {
    if (!text.empty()) text += ' ';
    if (word.comma) text += ',';
    text += word.address + Short(word.value, 6);
  }
  return text;
}

class FlowTest : public testing::Test {
 protected:
  Result RunProgram(std::shared_ptr<const nc::Program> program) {
    Result result;
    SourceFiles files;
    Flow flow(std::move(program), options_, &system_, &files, [&](Finding finding) {
      if (!result.findings.empty()) result.findings += "; ";
      result.findings += std::to_string(finding.where.line) + ":" +
                         std::to_string(finding.where.column) + " " +
                         std::string(Info(finding.rule).id);
      result.all.push_back(std::move(finding));
    });
    ResolvedBlock block;
    FlowEvent event = FlowEvent::kBlock;
    while ((event = flow.Next(&block)) == FlowEvent::kBlock) {
      if (!result.blocks.empty()) result.blocks += " | ";
      result.blocks += WordsText(block);
      const ResolvedWord* m = block.Find('M');
      if (m != nullptr && m->value == 30.0) flow.End();
    }
    result.stopped = event == FlowEvent::kStopped;
    result.executed = flow.blocks_executed();
    EXPECT_EQ(flow.Next(&block), event);
    for (const Finding& finding : result.all)
      result.files.push_back(files.name(finding.where.file));
    return result;
  }
  Result Run(const std::string& text) { return RunProgram(nc::Program::FromText("test.nc", text)); }
  /// Blocks, then findings if there are any.
  std::string Text(const std::string& text) {
    const Result result = Run(text);
    return result.findings.empty() ? result.blocks : result.blocks + " ! " + result.findings;
  }

  System system_;
  FlowOptions options_;
};

TEST_F(FlowTest, PlainBlocks) {
  EXPECT_EQ(Text("%\nO1 (HEAD)\n\nN10 G01 X1.5\n(C)\nY-2 ,R.1\nM30\nX99\n%\n"),
            "G1 X1.5 | Y-2 ,R0.1 | M30");
  EXPECT_EQ(Text("X1\n%\nX2\n"), "X1");
  EXPECT_EQ(Text("X1"), "X1");
  EXPECT_EQ(Text("O1\nX1\nO2\nX2\n"), "X1");
}

TEST_F(FlowTest, PlacesAndCounts) {
  const Result result = Run("X1\n\n  Y2 Z\n");
  EXPECT_EQ(result.findings, "3:6 syntax");
  EXPECT_EQ(result.executed, 3u);
  EXPECT_TRUE(result.stopped);
}

TEST_F(FlowTest, BlockDelete) {
  const std::string text = "/X1\nN5 /X2\nX3\n/ $$$\n";
  EXPECT_EQ(Run(text).findings, "4:3 syntax");
  options_.block_delete = true;
  EXPECT_EQ(Text(text), "X3");
}

// manual, "Macro Variables": #7=0 ... N1 G#7 G#11 X#1 Y#2, and "Address Substitution".
TEST_F(FlowTest, Substitution) {
  EXPECT_EQ(Text("#7=0\n#11=90\n#1=1.0\n#2=0.0\nN1 G#7 G#11 X#1 Y#2"), "G0 G90 X1 Y0");
  EXPECT_EQ(Text("G00 X1.0 Y#1"), "G0 X1");
  EXPECT_EQ(Text("G00 X1.0 Y-#1"), "G0 X1");
  EXPECT_EQ(Text("#1=.123456\nG01 X#1"), "G1 X0.1235");
  EXPECT_EQ(Text("D[1.67]"), "D2");
  EXPECT_EQ(Text("#1=1.00333\nG00 X[#1 + #1]\nA[#1+#1]"), "G0 X2.0067 | A2.007");
  system_.decimals = 3;
  EXPECT_EQ(Text("#1=.123456\nG01 X#1"), "G1 X0.123");
  EXPECT_EQ(Text("X-[#0+1.5]"), "X-1.5");
}

TEST_F(FlowTest, ComputedWordsAreNeverScaled) {
  SourceFiles files;
  Flow flow(nc::Program::FromText("t", "#1=2\nX#1 Y3 Z4."), {}, &system_, &files,
            [](const Finding&) {});
  ResolvedBlock block;
  ASSERT_EQ(flow.Next(&block), FlowEvent::kBlock);
  EXPECT_TRUE(block.Find('X')->has_point);
  EXPECT_TRUE(block.Find('X')->from_expression);
  EXPECT_FALSE(block.Find('Y')->has_point);
  EXPECT_TRUE(block.Find('Z')->has_point);
  EXPECT_EQ(block.where.line, 2);
}

TEST_F(FlowTest, Assignments) {
  EXPECT_EQ(Text("#[1+1]=3\n#3=#2*2 #4=#3+1\nX#2 Y#3 Z#4"), "X3 Y6 Z7");
  // "Internal to the machine, 10000 is added to 3-digit macro variables".
  EXPECT_EQ(Text("#100=5\n#10599=6\n#999=7\nX#10100 Y#599 Z#10999"), "X5 Y6 Z7");
  EXPECT_EQ(Text("#5221=1.5\nX#5221"), "X1.5");
  EXPECT_EQ(Text("#1=#0\nX1 Y#1"), "X1");
  EXPECT_EQ(Text("#0=1"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("#300=1"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("#[#1]=1"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("X#300"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("X1\nX[1/0]\nX2"), "X1 ! 2:1 control-alarm");
  EXPECT_EQ(Text("#1=100000\nX[#1*#1]"), " ! 2:1 control-alarm");
}

TEST_F(FlowTest, ACommonVariableThatTheProgramDidNotSet) {
  const Result result = Run("X1 Y#501\nX#501\n#502=1\nX#502\nX#10501\n");
  EXPECT_EQ(system_.assumed, std::vector<long>{501});
  EXPECT_EQ(result.blocks, "X1 | X1");
}

TEST_F(FlowTest, IfThen) {
  EXPECT_EQ(Text("#1=101\nIF [#1 GT 100] THEN #1=0.0\nX#1"), "X0");
  EXPECT_EQ(Text("IF [#1 NE #0] THEN G01 X#24\nY1"), "Y1");
  EXPECT_EQ(Text("#1=0 #24=7\nIF [#1 NE #0] THEN G01 X#24\nY1"), "G1 X7 | Y1");
  EXPECT_EQ(Text("IF [#1] THEN X1\nX2"), "X2");
}

TEST_F(FlowTest, Goto) {
  EXPECT_EQ(Text("GOTO20\nX1\nN20 X2"), "X2");
  EXPECT_EQ(Text("#1=4.49\nGOTO#1\nN4 X4\nM30\nN5 X5"), "X4 | M30");
  EXPECT_EQ(Text("#1=4.5\nGOTO#1\nN4 X4\nM30\nN5 X5"), "X5");
  EXPECT_EQ(Text("GOTO[2*1+1]\nX1\nN3 X3"), "X3");
  // Executed after the other words of its block, and found before it too.
  EXPECT_EQ(Text("GOTO2\nN1 X1\nM30\nN2 G01 X2 GOTO1"), "G1 X2 | X1 | M30");
  EXPECT_EQ(Text("X1\nGOTO7\n"), "X1 ! 2:1 control-alarm");
  EXPECT_EQ(Text("GOTO[0-5]"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("GOTO1\nN1 X1\nM30\nN1 X2"), "X1 | M30 ! 1:1 unsupported-code");
  // Block numbers of another program of the same file do not count.
  EXPECT_EQ(Text("O1\nGOTO5\nO2\nN5 X1"), " ! 2:1 control-alarm");
}

TEST_F(FlowTest, M99WithP) {
  EXPECT_EQ(Text("M99 P15\nX1\nN15 X2"), "X2");
  EXPECT_EQ(Text("#10000=5\nN50 [#10000 LT 10] M99 P10\nX1\nN10 X2"), "X2");
  EXPECT_EQ(Text("#10000=10\nN50 [#10000 LT 10] M99 P10\nX1\nN10 X2"), "X1 | X2");
  // "The machine tool is instructed to go to X0, Y0 whether or not the expression evaluates to
  // True".
  EXPECT_EQ(Text("#1=1 #2=2\nG00 X0 Y0 [#1EQ#2] M99 P5\nX1\nN5 X2"), "G0 X0 Y0 | X1 | X2");
  EXPECT_EQ(Text("#1=1 #2=1\nG00 X0 Y0 [#1EQ#2] M99 P5\nX1\nN5 X2"), "G0 X0 Y0 | X2");
}

TEST_F(FlowTest, While) {
  EXPECT_EQ(Text("#1=0\nWHILE [#1 LT 3] DO1\n#1=#1+1\nX#1\nEND1\nY1"), "X1 | X2 | X3 | Y1");
  EXPECT_EQ(Text("#1=9\nWH [#1 LT 3] DO1\nX1\nEND1\nY1"), "Y1");
  EXPECT_EQ(Text("#1=0\nDO1\n#1=#1+1\nIF [#1 GT 2] GOTO9\nX#1\nEND1\nN9 Y1"), "X1 | X2 | Y1");
  EXPECT_EQ(Text("#1=0\nWH[#1LT2]DO1\n#1=#1+1\n#2=0\nWH[#2LT2]DO2\n#2=#2+1\nX#1 Y#2\nEND2\nEND1"),
            "X1 Y1 | X1 Y2 | X2 Y1 | X2 Y2");
  // "Two separate WHILE loops can use the same nesting index".
  EXPECT_EQ(Text("#1=0\nWH[#1LT1]DO1\n#1=#1+1\nEND1\nWH[#1LT2]DO1\n#1=#1+1\nX#1\nEND1"), "X2");
  // "Jumping around inside a DO-END region using a GOTO is allowed".
  EXPECT_EQ(Text("#1=0\nWH[#1LT2]DO1\n#1=#1+1\nGOTO5\nX9\nN5 X#1 END1"), "X1 | X2");
}

// manual, "Assignment Statements": the whole macro, called as there.
TEST_F(FlowTest, InitialiseASequenceOfVariables) {
  const std::string macro =
      "O50001 (INITIALIZE A SEQUENCE OF VARIABLES) ;\n"
      "N1 IF [#2 NE #0] GOTO2 (B=base variable) ;\n#3000=1 (Base variable not given) ;\n"
      "N2 IF [#19 NE #0] GOTO3 (S=size of array) ;\n#3000=2 (Size of array not given) ;\n"
      "N3 WHILE [#19 GT 0] DO1 ;\n#19=#19-1 (Decrement count) ;\n#[#2+#19]=#22 (V=value) ;\n"
      "END1 ;\nM99 ;\n";
  EXPECT_EQ(Text("G65 P50001 B501. S5 V1.\nX#501 Y#505\nM30\n" + macro), "X1 Y1 | M30");
  EXPECT_EQ(Text("#550=3\nG65 P50001 B550. S5 V0\nX#550 Y#554\nM30\n" + macro), "X0 Y0 | M30");
  EXPECT_EQ(Text("#101=3\nG65 P50001 B101. S20\nX1 Y#101\nM30\n" + macro), "X1 | M30");
  const Result result = Run("G65 P50001 S5\nM30\n" + macro);
  EXPECT_EQ(result.findings, "5:1 control-alarm");
  EXPECT_EQ(result.all.at(0).message, "alarm 1001 of the program itself: Base variable not given");
}

// manual, "G65 Macro Subprogram Call Option", example 3.
TEST_F(FlowTest, DiagonalHolePattern) {
  EXPECT_EQ(Text("G00 G90 X1.0 Y1.0 Z.05 S1000 M03\nG65 P9010 X.5 Y.25 Z.05 F10. T3\nM30\n"
                 "O09010 (Diagonal hole pattern)\nF#9 (F=Feedrate)\nWHILE [#20 GT 0] DO1\n"
                 "G91 G81 Z#26\n#20=#20-1\nIF [#20 EQ 0] GOTO5\nG00 X#24 Y#25\nN5 END1\nM99\n"),
            "G0 G90 X1 Y1 Z0.05 S1000 M3 | F10 | G91 G81 Z0.05 | G0 X0.5 Y0.25 | G91 G81 Z0.05 | "
            "G0 X0.5 Y0.25 | G91 G81 Z0.05 | M30");
}

TEST_F(FlowTest, LoopErrors) {
  EXPECT_EQ(Text("DO1\nX1\n"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("X1\nEND1"), "X1 ! 2:1 control-alarm");
  EXPECT_EQ(Text("GOTO5\nDO1\nN5 X1\nEND1"), "X1 ! 4:1 control-alarm");  // A jump into a loop.
  EXPECT_EQ(Text("DO1\nDO2\nEND1\nEND2"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("DO1\nDO1\nEND1\nEND1"), " ! 1:1 control-alarm");
  // Left by a jump, it is no longer active.
  EXPECT_EQ(Text("DO1\nGOTO5\nEND1\nN5 X1\nEND1"), "X1 ! 5:1 control-alarm");
}

TEST_F(FlowTest, LocalSubprograms) {
  // manual, "M97 Local Subprogram Call".
  EXPECT_EQ(
      Text("%\nO00001 ;\nM97 P100 L4 (CALLS N100 SUBPROGRAM) ;\nM30 ;\nN100 (SUBPROGRAM) ; ;\n"
           "M00 ;\nM99 (RETURNS TO MAIN PROGRAM) ;\n%\n"),
      "M0 | M0 | M0 | M0 | M30");
  EXPECT_EQ(Text("G00 X1 M97 P5\nY2\nM30\nN5 Z#1\nX3 M99"), "G0 X1 | X3 | Y2 | M30");
  // "Calling a subprogram via an M97 or M98 does not nest the local variables."
  EXPECT_EQ(Text("#1=1\nM97 P5\nX#1\nM30\nN5 #1=#1+1\nM99"), "X2 | M30");
  EXPECT_EQ(Text("M97"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("M97 P5"), " ! 1:5 control-alarm");
  EXPECT_EQ(Text("M97 P5 L0\nN5 M99"), " ! 1:8 control-alarm");
  EXPECT_EQ(Text("M97 P5 L100\nN5 M99"), " ! 1:8 control-alarm");
}

TEST_F(FlowTest, SubprogramsOfTheSameFile) {
  EXPECT_EQ(Text("O1\nM98 P100 L2\nM30\nO00100\nX1\nM99\n"), "X1 | X1 | M30");
  EXPECT_EQ(Text("M98 P100\nM30\nO100\nX1\n"), "X1 ! 4:1 control-alarm");
  const Result result = Run("M98 P100\nM30\nO100\nX1\nO200\nM99");
  EXPECT_EQ(result.all.at(0).message, "the subprogram ends without M99 (alarm 312)");
  EXPECT_EQ(Text("M98"), " ! 1:1 control-alarm");
  EXPECT_EQ(Text("M98 P1.5"), " ! 1:5 control-alarm");
  // manual, "M99": M99 P in a subprogram jumps there; it does not return.
  EXPECT_EQ(Text("M98 P2\nM30\nO2\nM99 P7\nX1\nN7 X2\nM99"), "X2 | M30");
}

TEST_F(FlowTest, M99InTheMainProgramEndsIt) {
  const Result result = Run("X1\nM99\nX2");
  EXPECT_EQ(result.blocks, "X1");
  EXPECT_FALSE(result.stopped);
}

TEST_F(FlowTest, MissingSubprogramIsUnsupportedAndTheProgramGoesOn) {
  const Result result = Run("M98 P9810\nX1\nG65 P9832 Z1.\nX2\nM98 (no/such.nc)\nX3");
  EXPECT_EQ(result.blocks, "X1 | X2 | X3");
  EXPECT_EQ(result.findings, "1:5 unsupported-code; 3:5 unsupported-code; 5:1 unsupported-code");
  EXPECT_NE(result.all[0].message.find("subprogram O09810 was not found"), std::string::npos);
}

TEST_F(FlowTest, SubprogramFiles) {
  const std::filesystem::path folder = testing::TempDir() + "ncsim_flow_test";
  std::filesystem::create_directories(folder / "subs");
  const auto write = [&](const char* name, const char* text) {
    std::ofstream(folder / name) << text;
  };
  write("main.nc",
        "%\nO1\nM98 P100\nM98 P1234\nM98 (USB0/path.nc)\nM98 (/subs/deep)\nM98 P55\nM30\n%\n");
  write("O00100.nc", "%\nO00100\nX1\nM99\n%\n");
  write("subs/1234.NC", "X2\nM98 P7\nM99\nO7\nX3\nM99\n");
  write("path.nc", "X4\nM99\n");
  write("subs/deep.txt", "X5\nM99\n");
  write("o0055", "X6\n$\n");
  options_.subprogram_folders = {(folder / "subs").string()};
  Diagnostics diagnostics;
  const auto main = nc::Program::Load((folder / "main.nc").string(), &diagnostics);
  ASSERT_NE(main, nullptr);
  const Result result = RunProgram(main);
  EXPECT_EQ(result.blocks, "X1 | X2 | X3 | X4 | X5 | X6");
  EXPECT_EQ(result.findings, "2:1 syntax");
  EXPECT_EQ(result.files.at(0), (folder / "o0055").string());
  std::filesystem::remove_all(folder);
}

// "Alphabetic Addressing", "Alternate Alphabetic Addressing", "Integer Argument Passing".
TEST_F(FlowTest, MacroArguments) {
  const std::string macro = "\nM30\nO9\n";
  EXPECT_EQ(Text("G65 P9 A1. B2. C3. I4. J5. K6. D7 E8 F9" + macro +
                 "X#1 Y#2 Z#3 A#4 B#5 C#6 U#7 V#8 W#9\nM99"),
            "X1 Y2 Z3 A4 B5 C6 U7 V8 W9 | M30");
  EXPECT_EQ(Text("G65 P9 H11 M13 Q17. R18. S19 T20 U21. V22. W23. X24. Y25. Z26." + macro +
                 "X#11 Y#13 Z#17 A#18 B#19 C#20\nX#21 Y#22 Z#23 A#24 B#25 C#26\nM99"),
            "X11 Y13 Z17 A18 B19 C20 | X21 Y22 Z23 A24 B25 C26 | M30");
  EXPECT_EQ(Text("G65 P9 I1. J2. K3. I4. J5. K6." + macro + "X#4 Y#6 Z#7 A#9\nM99"),
            "X1 Y3 Z4 A6 | M30");
  EXPECT_EQ(Text("G65 P9 A#5 B#6" + macro + "X1 Y#1\nM99"), "X1 | M30");
  // "If a decimal is not included": A is .0001, D is 1.
  const Result result = Run("G65 P9 A1 D1 S5 X0" + macro + "X#1 Y#7 S#19 Z#24\nM99");
  EXPECT_EQ(result.blocks, "X0.0001 Y1 S5 Z0 | M30");
  EXPECT_EQ(result.findings, "1:1 number-scale");
  system_.decimals = 3;
  EXPECT_EQ(Run("G65 P9 A1" + macro + "X#1\nM99").blocks, "X0.001 | M30");
}

// "The arguments are set only on the first repetition"; a new set of locals is available for use.
TEST_F(FlowTest, MacroLocals) {
  EXPECT_EQ(Text("#1=7\nG65 P9 L3 A1.\nX#1\nM30\nO9\nY#1 Z1\n#1=#1+1\nM99"),
            "Y1 Z1 | Y2 Z1 | Y3 Z1 | X7 | M30");
  EXPECT_EQ(Text("#2=7\nG65 P9\nM30\nO9\nZ1 X#2\nM99"), "Z1 | M30");
  EXPECT_EQ(Text("G65 P9 L2 N1"), " ! 1:11 syntax");
  EXPECT_EQ(Text("G90 G65 P9 A1.\nM30\nO9\nX#1\nM99"), "G90 | X1 | M30");
}

TEST_F(FlowTest, NestingIsBounded) {
  EXPECT_EQ(Text("O1\nM98 P1"), " ! 2:1 control-alarm");
  EXPECT_EQ(Run("O1\nM98 P1").all.at(0).message, "subprograms are nested deeper than 10 levels");
  EXPECT_EQ(Text("N1 M97 P1"), " ! 1:4 control-alarm");
  EXPECT_EQ(Run("O1\nG65 P1").all.at(0).message, "G65 calls are nested deeper than 9 levels");
}

TEST_F(FlowTest, AlarmsAndStops) {
  const Result result = Run("X1\n#3000=11(NO FEED \xE9)\nX2");
  EXPECT_EQ(result.blocks, "X1");
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.all.at(0).message, "alarm 1011 of the program itself: NO FEED ?");
  EXPECT_EQ(Text("X1\n#3006=1 (TURN THE PART)\nX2"), "X1 | X2");
  EXPECT_EQ(Text("X1\nM98 P1 GOTO5\nN5 X2\nO1\nM99"), "X1 ! 2:1 control-alarm");
}

TEST_F(FlowTest, M96IsNotSimulated) {
  EXPECT_EQ(Text("M96 P10 Q18\nX1\nN10 X2"), "X1 | X2 ! 1:1 unsupported-code");
}

TEST_F(FlowTest, PrintingMovesNothing) {
  EXPECT_EQ(Text("POPEN\nDPRNT[X#1[44]]\nPCLOS\nX1"), "X1");
}

TEST_F(FlowTest, DoubtsMakeItUnproven) {
  EXPECT_EQ(Text("#1=1\nIF [#1 EQ 1 AND #1 EQ 1] GOTO5\nN5 X1\n"), "X1 ! 2:13 unsupported-code");
}

TEST_F(FlowTest, EndlessLoopsAreStopped) {
  options_.max_blocks = 1000;
  for (const char* text : {"DO1\nEND1", "N1 GOTO1", "N1 M99 P1", "WH[1EQ1]DO1\nX1\nEND1",
                           "#1=1\nN1 X1\nIF[#1]GOTO1"}) {
    const Result result = Run(text);
    EXPECT_TRUE(result.stopped) << text;
    ASSERT_EQ(result.all.size(), 1u) << text;
    EXPECT_EQ(result.all[0].rule, Rule::kUnsupportedCode);
    EXPECT_NE(result.all[0].message.find("stopped after 1000 blocks"), std::string::npos);
  }
  const Result enough = Run("#1=0\nWH[#1LT300]DO1\n#1=#1+1\nEND1\nX1");
  EXPECT_EQ(enough.blocks, "X1");
}

// Jumps must stay cheap in a long program: 20,000 jumps back over 100,000 lines.
TEST_F(FlowTest, JumpsInALongProgram) {
  std::string text = "#1=0\nN1 #1=#1+1\nGOTO2\n";
  for (int i = 0; i < 100'000; ++i) text += "X1 Y1\n";
  text += "N2 IF [#1 LT 20000] GOTO1\nX5\n";
  EXPECT_EQ(Text(text), "X5");
}

TEST_F(FlowTest, SyntaxErrorsOfTheRestAreReportedTooUpToABound) {
  const Result few = Run("X1\nX--2\nY1\nZ=\nM30\n");
  EXPECT_EQ(few.findings, "2:1 syntax; 4:2 syntax");
  EXPECT_EQ(few.blocks, "X1");
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "X--2\n";
  EXPECT_EQ(Run(many).all.size(), 20u);
}

TEST_F(FlowTest, CodesOfTheFlowMayBeComputed) {
  EXPECT_EQ(Text("#1=97.4\nM#1 P5\nN5"), "M97.4 P5");
  EXPECT_EQ(Text("#1=97 #2=5\nM#1 P#2\nX2\nM30\nN5 X1\nM99"), "X1 | X2 | M30");
}

}  // namespace
}  // namespace ncsim::control
