// SPDX-License-Identifier: BSD-3-Clause
// Block syntax of the SINUMERIK 840D sl. "ONE" is the NC programming manual 12/2019.
#include "sim/nc/sinumerik_block.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ncsim::nc {
namespace {

using Kind = SinumerikPartKind;

class Parsed {
 public:
  explicit Parsed(std::string text) : program_(Program::FromText("t.mpf", std::move(text))) {
    ParseSinumerikBlock(*program_, 0, 1, &block);
  }
  const SinumerikPart& part(std::size_t i) const { return block.parts.at(i); }
  SinumerikBlock block;

 private:
  std::shared_ptr<const Program> program_;
};

/// "column alarm", or "" where the block has no error.
std::string ErrorOf(const std::string& text) {
  const Parsed parsed(text);
  if (parsed.block.errors.empty()) return "";
  const SyntaxError& error = parsed.block.errors.front();
  const std::size_t at = error.message.rfind("(alarm ");
  if (at == std::string::npos) return "no alarm: " + error.message;
  return std::to_string(error.column) + " " + error.message.substr(at + 7, 5);
}

std::vector<Kind> Kinds(const std::string& text) {
  const Parsed parsed(text);
  EXPECT_TRUE(parsed.block.errors.empty()) << text << ": " << ErrorOf(text);
  std::vector<Kind> kinds;
  for (const SinumerikPart& part : parsed.block.parts) kinds.push_back(part.kind);
  return kinds;
}

TEST(SinumerikBlockTest, WordsWithoutBlanks) {
  // ONE p. 44: sign, leading zeros and point are free; EX is the exponent.
  const Parsed parsed("N10G0G54X-10Y.20Z30.4EX-4B0T100S400.0M3H12");
  ASSERT_TRUE(parsed.block.errors.empty());
  EXPECT_EQ(parsed.block.sequence, 10);
  std::string letters;
  for (const SinumerikPart& part : parsed.block.parts) letters += part.letter;
  EXPECT_EQ(letters, "GGXYZBTSMH");
  EXPECT_EQ(parsed.part(2).value, -10.0);
  EXPECT_EQ(parsed.part(3).value, 0.20);
  EXPECT_EQ(parsed.part(4).value, 30.4e-4);
  EXPECT_TRUE(parsed.part(2).is_integer);
  EXPECT_FALSE(parsed.part(7).is_integer);
}

TEST(SinumerikBlockTest, AddressAndLetterCase) {
  const Parsed parsed("x1=5 m1=6 S3 = 2400 cr=7 AX[X1]=1 R[R2]=3 T=\"Mill 8\" L0054 P2");
  ASSERT_TRUE(parsed.block.errors.empty());
  EXPECT_EQ(parsed.part(0).letter, 'X');
  EXPECT_EQ(parsed.part(0).extension, 1);
  EXPECT_EQ(parsed.part(0).name, "x1");
  EXPECT_EQ(parsed.part(1).letter, 'M');
  EXPECT_EQ(parsed.part(2).extension, 3);
  EXPECT_EQ(parsed.part(3).letter, 0);
  EXPECT_EQ(parsed.part(3).name, "cr");
  EXPECT_EQ(parsed.part(4).index_count, 1u);
  EXPECT_EQ(parsed.part(5).letter, 'R');
  EXPECT_EQ(parsed.block.code[parsed.part(6).expression.begin].name, "Mill 8");
  EXPECT_EQ(parsed.part(7).name, "L0054");  // L54 is another subprogram.
}

TEST(SinumerikBlockTest, HeadOfABlock) {
  const Parsed skip("/3 N1 _MM0: DP=HH2 ; a comment");
  ASSERT_TRUE(skip.block.errors.empty());
  EXPECT_EQ(skip.block.skip_level, 3);
  EXPECT_EQ(skip.block.sequence, 1);
  EXPECT_EQ(skip.block.label, "_MM0");
  EXPECT_EQ(skip.block.comment, " a comment");
  EXPECT_EQ(Parsed("/N1 X1").block.skip_level, 0);
  EXPECT_EQ(Parsed(":100 X1").block.sequence, 100);
  EXPECT_EQ(Parsed("_MM1B:AX[_Z]=1 G0").block.label, "_MM1B");
  EXPECT_EQ(Parsed("%_N_PART_MPF").block.header, "_N_PART_MPF");
  EXPECT_EQ(ErrorOf("/12 X1"), "1 12080");
  EXPECT_EQ(ErrorOf("X1 N20"), "4 12080");
  EXPECT_EQ(ErrorOf("N1234567890 X1"), "1 12160");
}

TEST(SinumerikBlockTest, ModifiersOfValues) {
  const Parsed parsed("X=IC(1) Y=AC(2) C=DC(3) B=ACP(4) A=ACN(5) I=ac(_V+1) M=QU(3)");
  ASSERT_TRUE(parsed.block.errors.empty());
  const std::vector<SinumerikModifier> expected = {
      SinumerikModifier::kIc,    SinumerikModifier::kAc,  SinumerikModifier::kDc,
      SinumerikModifier::kAcp,   SinumerikModifier::kAcn, SinumerikModifier::kAc,
      SinumerikModifier::kOutput};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(parsed.part(i).modifier, expected[i]) << i;
  }
}

TEST(SinumerikBlockTest, ArgumentsAndWhatIsOmitted) {
  const Parsed parsed("MCALL CYCLE83(10,0,,-20,,-5.5,,2,)");
  ASSERT_TRUE(parsed.block.errors.empty());
  const SinumerikPart& call = parsed.part(0);
  EXPECT_EQ(call.kind, Kind::kModalCall);
  EXPECT_EQ(call.name, "CYCLE83");
  ASSERT_EQ(call.argument_count, 9u);
  std::string given;
  for (std::uint32_t i = 0; i < call.argument_count; ++i) {
    given += parsed.block.arguments[call.first_argument + i].empty() ? '-' : 'x';
  }
  EXPECT_EQ(given, "xx-x-x-x-");
  EXPECT_EQ(Parsed("CYCLE832()").part(0).argument_count, 0u);
  EXPECT_TRUE(Parsed("CYCLE832()").part(0).has_arguments);
  EXPECT_FALSE(Parsed("MCALL").part(0).has_arguments);
}

TEST(SinumerikBlockTest, Statements) {
  EXPECT_EQ(Kinds("IF(DTB>=0)"), (std::vector{Kind::kIf}));
  EXPECT_EQ(Kinds("IF DP==0 GOTOF _MM0 IF DP==HH2 GOTOF _MM1"),
            (std::vector{Kind::kIfGoto, Kind::kGoto, Kind::kIfGoto, Kind::kGoto}));
  EXPECT_EQ(Kinds("CASE _I OF-1 GOTOF LBL1-2 GOTOB LBL2 'HC' GOTO N10 DEFAULT GOTOC LD"),
            (std::vector{Kind::kCase, Kind::kCaseBranch, Kind::kCaseBranch, Kind::kCaseBranch,
                         Kind::kCaseDefault}));
  EXPECT_EQ(Kinds("FOR R1=1 TO R2+1"), (std::vector{Kind::kFor}));
  EXPECT_EQ(Kinds("REPEAT"), (std::vector{Kind::kRepeat}));
  EXPECT_EQ(Kinds("REPEAT L_A L_B P=3"), (std::vector{Kind::kRepeatSection}));
  EXPECT_EQ(Kinds("REPEATB L_A P3"), (std::vector{Kind::kRepeatBlock}));
  EXPECT_EQ(Kinds("CALL BLOCK L_A TO \"L\"<<R1"), (std::vector{Kind::kCallBlock}));
  EXPECT_EQ(Kinds("PCALL /_N_MPF_DIR/SHAFT(1,,3)"), (std::vector{Kind::kCallPath}));
  EXPECT_EQ(Kinds("EXTCALL(\"A/B\")"), (std::vector{Kind::kCallName}));
  EXPECT_EQ(Kinds("GOTOS"), (std::vector{Kind::kGoto}));
  EXPECT_EQ(Kinds("TRAORI(1)"), (std::vector{Kind::kCall}));
  EXPECT_EQ(Kinds("TRANS X10 Y=R1"), (std::vector{Kind::kName, Kind::kWord, Kind::kAssign}));
}

TEST(SinumerikBlockTest, Definitions) {
  const Parsed parsed(
      "DEF NCK APW 5 REAL PHU 5 LLI -100.0 ULI +100.0 MAT[3,3] = SET(1,0,,1), BB=2, CC[2]=(7,8)");
  ASSERT_TRUE(parsed.block.errors.empty());
  EXPECT_TRUE(parsed.part(0).is_global);
  EXPECT_EQ(parsed.part(0).type, SinumerikType::kReal);
  EXPECT_EQ(parsed.part(1).index_count, 2u);
  EXPECT_EQ(parsed.part(1).list, SinumerikList::kSet);
  EXPECT_EQ(parsed.part(1).argument_count, 4u);
  EXPECT_FALSE(parsed.part(2).expression.empty());
  EXPECT_EQ(parsed.part(3).list, SinumerikList::kSet);
  const Parsed proc(
      "PROC CYC(REAL AA, VAR INT BB, AXIS CC, STRING[20] DD, REAL EE=-1.0) SAVE SBLOF");
  ASSERT_TRUE(proc.block.errors.empty());
  EXPECT_TRUE(proc.part(2).by_reference);
  EXPECT_EQ(proc.part(4).type, SinumerikType::kString);
  EXPECT_FALSE(proc.part(5).expression.empty());
  EXPECT_EQ(proc.part(6).kind, Kind::kAttribute);
}

TEST(SinumerikBlockTest, WhatIsKnownByNameOnly) {
  EXPECT_EQ(Parsed("ID=1 WHENEVER $A_IN[1]==1 DO OVR=0 M8").part(0).kind, Kind::kSynchronous);
  EXPECT_EQ(Parsed("WHEN TRUE DO M5=10").part(0).kind, Kind::kSynchronous);
  EXPECT_EQ(Parsed("SETINT(1) PRIO=4 CYC<<\"T\" LIFTFAST").part(0).kind, Kind::kUnsimulated);
  EXPECT_EQ(Parsed("DEFINE GORAP AS G0 X0").part(0).kind, Kind::kUnsimulated);
  EXPECT_EQ(Parsed("REDEF $SN_X APR 7").part(0).kind, Kind::kUnsimulated);
}

TEST(SinumerikBlockTest, AlarmsAtTheirColumns) {
  EXPECT_EQ(ErrorOf("N10 X10 Y"), "9 12080");
  EXPECT_EQ(ErrorOf("N10 X=10+"), "10 12080");
  EXPECT_EQ(ErrorOf("N10 G0=10"), "7 12080");
  EXPECT_EQ(ErrorOf("N10 _R=(1+2"), "8 12080");
  EXPECT_EQ(ErrorOf("N10 _R='B1102'"), "8 12080");
  EXPECT_EQ(ErrorOf("N10 _R='H1FFFFFFFF'"), "8 12230");
  EXPECT_EQ(ErrorOf("N10 _R=1EX400"), "8 12160");
  EXPECT_EQ(ErrorOf("N10 MSG(\"open)"), "9 12080");
  EXPECT_EQ(ErrorOf("DEF INT AA[1][2]"), "14 12080");
  EXPECT_EQ(ErrorOf("DEF INT AA[1,2,3,4]"), "11 12190");
  EXPECT_EQ(ErrorOf("DEF REAL " + std::string(32, 'A')), "10 12420");
  EXPECT_EQ(ErrorOf("IF R1 X10"), "7 12080");
  EXPECT_EQ(ErrorOf("/ENDIF"), "2 12630");
  EXPECT_EQ(ErrorOf("LBL: WHILE R1"), "6 12630");
  EXPECT_EQ(ErrorOf("X" + std::string(600, '0')), "1 12540");
  EXPECT_EQ(ErrorOf("; " + std::string(600, 'x')), "");
}

TEST(SinumerikBlockTest, AStringMayHoldASemicolon) {
  const Parsed parsed("MSG(\"A;B\") ; C");
  ASSERT_TRUE(parsed.block.errors.empty());
  EXPECT_EQ(parsed.block.comment, " C");
}

TEST(SinumerikBlockTest, NestingIsBounded) {
  EXPECT_EQ(ErrorOf("R1=" + std::string(200, '(') + "1" + std::string(200, ')')).substr(3),
            "12540");
  std::string nots = "R1=";
  for (int i = 0; i < 100; ++i) nots += "NOT ";
  EXPECT_EQ(ErrorOf(nots + "1").substr(4), "12540");
}

}  // namespace
}  // namespace ncsim::nc
