// SPDX-License-Identifier: BSD-3-Clause
// Expected values: the syntax and the examples of the Haas NGC Mill Operator's Manual 2017, "Macros
// (Optional)", "Address Substitution", "Control Statements", "M97" to "M99", "DPRNT"; numbers by
// strtod's grammar without exponent.
#include "sim/nc/block.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/text.h"
#include "sim/nc/program.h"

namespace ncsim::nc {
namespace {

std::string WordText(const Word& word) {
  std::string text(word.comma ? "," : "");
  text += word.address;
  if (word.is_expression) return text + "[]";
  if (!word.has_value) return text + "?";
  return text + Short(word.value, 9) + (word.has_point ? "." : "");
}

std::string StatementText(const Block& block, const Statement& statement) {
  const std::string loop = std::to_string(statement.loop);
  switch (statement.kind) {
    case StatementKind::kWord:
      return WordText(block.words.at(static_cast<std::size_t>(statement.word)));
    case StatementKind::kAssignment:
      return "assign";
    case StatementKind::kCondition:
      return "if";
    case StatementKind::kIfGoto:
      return "if-goto";
    case StatementKind::kGoto:
      return "goto";
    case StatementKind::kWhile:
      return "while" + loop;
    case StatementKind::kDo:
      return "do" + loop;
    case StatementKind::kEnd:
      return "end" + loop;
    case StatementKind::kPrint:
      return "print";
  }
  return "";
}

/// One word a part: "N10 / G1 X1.5." for `/N10 G01 X1.5`, then the errors as "!column".
std::string Describe(const Block& block) {
  std::vector<std::string> parts;
  if (block.program_mark) parts.emplace_back("%");
  if (block.block_delete) parts.emplace_back("/");
  if (block.program >= 0) parts.push_back("O" + std::to_string(block.program));
  if (block.sequence >= 0) parts.push_back("N" + std::to_string(block.sequence));
  if (block.statements.empty()) {
    for (const Word& word : block.words) parts.push_back(WordText(word));
  }
  for (const Statement& statement : block.statements) {
    parts.push_back(StatementText(block, statement));
  }
  for (const std::string_view comment : block.comments) {
    parts.push_back("(" + std::string(comment) + ")");
  }
  for (const SyntaxError& error : block.errors) parts.push_back("!" + std::to_string(error.column));
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : " ") + part;
  return text;
}

/// The text lives until the next call: comments are views of it.
Block Parse(std::string text) {
  static std::shared_ptr<const Program> program;
  program = Program::FromText("test.nc", std::move(text));
  Block block;
  ParseBlock(*program, program->begin(), 1, &block);
  return block;
}

struct Case {
  const char* text;
  const char* expected;
};

void Check(const std::vector<Case>& cases) {
  for (const Case& row : cases) {
    const Block block = Parse(row.text);
    EXPECT_EQ(Describe(block), row.expected)
        << row.text << "\n"
        << (block.errors.empty() ? "" : block.errors[0].message);
  }
}

TEST(BlockTest, Words) {
  Check({{"", ""},
         {"   \t ", ""},
         {"G01 X1.5 Y-2. Z.25 F100", "G1 X1.5. Y-2. Z0.25. F100"},
         {"G0G90X0Y+1.0", "G0 G90 X0 Y1."},
         {"g1 x2. y3", "G1 X2. Y3"},
         {"X-.0005", "X-0.0005."},
         {"N10 G54", "N10 G54"},
         {"N99;", "N99"},
         {"N0(1030=0,        1031=0)      ;", "N0 (1030=0,        1031=0)"},
         {"/N20 M30", "/ N20 M30"},
         {"N20 /M30", "/ N20 M30"},
         {"O00001 (FINAL TOOLPATH)", "O1 (FINAL TOOLPATH)"},
         {"o0001; (coded)", "O1 (coded)"},
         {"%", "%"},
         {" % ;", "%"},
         {"T1 M06 (A) (B)", "T1 M6 (A) (B)"},
         {"G01 X1. ,R.1", "G1 X1. ,R0.1."},
         {"G01 X1. ,C0.05 R2", "G1 X1. ,C0.05. R2"},
         {"X", "X?"},
         {"G28 X Y", "G28 X? Y?"},
         {"X1E3", "X1 E3"},  // No exponents: two words.
         {"G65 P2000 I1 J2 K3 I4 J5 K6", "G65 P2000 I1 J2 K3 I4 J5 K6"},
         {"G40 G17 G80 M3 M8", "G40 G17 G80 M3 M8"}});
}

TEST(BlockTest, AddressExpressions) {
  Check({{"A#101", "A[]"},
         {"A-#101", "A[]"},
         {"Z[#5041+3.5]", "Z[]"},
         {"Z-[SIN[#1]]", "Z[]"},
         {"N1 G#7 G#11 X#1 Y#2", "N1 G[] G[] X[] Y[]"},
         {"G01 G90 X [COS [90]] Y3.0", "G1 G90 X[] Y3."},
         {"X#[#1+1]Y##2", "X[] Y[]"},
         {",R#1", ",R[]"}});
}

TEST(BlockTest, Statements) {
  Check({{"#1=1.714;", "assign"},
         {"#[#2+#19]=#22          (V=value)", "assign (V=value)"},
         {"#1=1 #2=2", "assign assign"},
         {"#3000=11(NO FEED RATE)", "assign (NO FEED RATE)"},
         {"N1 IF [#2 NE #0] GOTO2 (B)", "N1 if-goto (B)"},
         {"IF[#9NE#0]GOTO3", "if-goto"},
         {"IF [#590 GT 100] THEN #590=0.0", "if assign"},
         {"IF [#1 NE #0] THEN G01 X#24 Y#26 F#9", "if G1 X[] Y[] F[]"},
         {"IF [#1 GE 180] THEN #101=0.0 M99", "if assign M99"},
         {"N50 [#10000 LT 10] M99 P10", "N50 if M99 P10"},
         {"G00 X0 Y0 [#1EQ#2] M99 P5;", "G0 X0 Y0 if M99 P5"},
         {"WHILE [#10101 LT 10] DO1", "while1"},
         {"WH [#3001 LT 500] DO1", "while1"},
         {"while[#1]do3", "while3"},
         {"DO1", "do1"},
         {"N5 END1", "N5 end1"},
         {"X1. END2", "X1. end2"},
         {"GOTO100", "goto"},
         {"GOTO#7 (Now)", "goto (Now)"},
         {"GOTO [[#1030*2]+#1031]", "goto"},
         {"G01 X1. GOTO 5", "G1 X1. goto"},
         {"DPRNT[X#1[44]*Z#1[03]*T#1[40]] ;", "print"},
         {"DPRNT[] ;", "print"},
         {"POPEN", "print"}});
}

TEST(BlockTest, ErrorsStandAtTheirColumn) {
  Check({{"G01 X 0 Y3.0", "G1 Y3. !5"},  // "Editing": no space between the X and the zero.
         {"X-0.25 Y -0.25", "X-0.25. !8"},
         {"X1.2.3", "X1.2. !5"},
         {"X--1", "!1"},
         {"X-", "!1"},
         {"X.", "!1"},
         {"XNAN", "!1"},
         {"X1 Yinf", "X1 !4"},
         {"G1 X1 X2", "G1 X1 X2 !7"},
         {"X1 I1 I2", "X1 I1 I2 !7"},
         {"(never closed", "!1"},
         {"X1 (never closed", "X1 !4"},
         {"X1) Y2", "X1 Y2 !3"},
         {"X[#1", "!2"},
         {"X1 ] Y2", "X1 Y2 !4"},
         {"X1 = Y2", "X1 Y2 !4"},
         {"12 X1", "X1 !1"},
         {"X1; Y2", "X1 !5"},
         {"X1 N10", "X1 !4"},
         {"N", "!1"},
         {"N1.5", "N1 !3"},
         {"N#1 X1", "!1"},
         {"O123456", "!1"},
         {"X1 O5", "X1 !4"},
         {"X1 / Y2", "X1 Y2 !4"},
         {"% O5", "% !3"},
         {"X1 %", "X1 !4"},
         {"o100 sub", "O100 !6"},
         {"X1 ,Z5", "X1 Z5 !4"},
         {"X1 ,R", "X1 !4"},
         {"#1", "!1"},
         {"#1=", "!4"},
         {"#1 2=3", "!1"},
         {"#<name>=1", "!2"},
         {"IF [#1] X1", "!9"},
         {"IF #1 GOTO 5", "!4"},
         {"IF [#1] THEN GOTO5", "if goto !14"},
         {"GOTO", "!1"},
         {"GOTO 5 GOTO 6", "goto goto !8"},
         {"[#1] X1", "if X1 !1"},
         {"THEN X1", "X1 !1"},
         {"WH [#1] D01", "!9"},  // The manual's own example of a zero for an O.
         {"DO4", "!3"},
         {"DO", "!3"},
         {"DO1 X1", "do1 X1 !1"},
         {"END1 X1", "end1 X1 !1"},
         {"DPRNT[X", "!1"},
         {"DPRNT[X] G0", "print G0 !1"},
         {"X\xC3\xA4", "X? !2 !3"},
         {"\xFF", "!1"},
         {"======", "!1"}});
}

TEST(BlockTest, MessagesSayWhatIsWrong) {
  EXPECT_EQ(Parse("(never closed").errors.at(0).message,
            "the comment is never closed: ')' is missing");
  EXPECT_EQ(Parse("X[1+[2]").errors.at(0).message, "'[' is never closed");
  EXPECT_EQ(Parse("#1=LN[2]").errors.at(0).message, "'LN' is not a function of this control");
  EXPECT_EQ(Parse("X\x80").errors.at(0).message, "byte 0x80 has no meaning in a block");
  EXPECT_EQ(Parse("Y1 Y2").errors.at(0).message, "the address Y stands twice in the block");
}

TEST(BlockTest, NumbersAreExact) {
  EXPECT_EQ(Parse("X0.1").words.at(0).value, 0.1);
  EXPECT_EQ(Parse("X123456.789012").words.at(0).value, 123456.789012);
  EXPECT_EQ(Parse("X-2.3803").words.at(0).value, -2.3803);
  EXPECT_EQ(Parse("X0.1234567890123456789").words.at(0).value, 0.1234567890123456789);
  EXPECT_EQ(Parse("X999999999").words.at(0).value, 999999999.0);
  EXPECT_EQ(Parse("X0010").words.at(0).digits, 4);
}

TEST(BlockTest, HugeNumbersAreErrors) {
  EXPECT_TRUE(Parse("X1000000000").errors.empty());
  EXPECT_EQ(Parse("X1000000001").errors.size(), 1u);
  EXPECT_EQ(Parse("X1" + std::string(30, '0')).errors.at(0).message,
            "the number after X is too large for the control");
  EXPECT_EQ(Parse("X" + std::string(100000, '9') + ".5").errors.size(), 1u);
  EXPECT_EQ(Parse("#1=1" + std::string(400, '0')).errors.at(0).column, 4);
}

TEST(BlockTest, PlacesInTheText) {
  const Block block = Parse("N10 G01 X[#1+2.]  Y-1.5\nX1");
  ASSERT_EQ(block.words.size(), 3u);
  EXPECT_EQ(block.words[1].column, 9);
  EXPECT_EQ(block.words[1].length, 8u);
  EXPECT_EQ(block.words[2].column, 19);
  EXPECT_EQ(block.words[2].length, 5u);
  EXPECT_EQ(block.next, 24u);
}

TEST(BlockTest, LineEnds) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const std::string text = std::string("X1") + end + end + "Y2" + end;
    const auto program = Program::FromText("test.nc", text);
    Block block;
    std::string all;
    std::size_t offset = program->begin();
    for (int line = 1; offset < program->text().size(); ++line) {
      ParseBlock(*program, offset, line, &block);
      all += Describe(block) + "|";
      offset = block.next;
    }
    EXPECT_EQ(all, "X1||Y2|");
  }
}

TEST(BlockTest, AReusedBlockForgets) {
  const auto first = Program::FromText("a", "/N1 IF [#1] THEN X1 (C) $ AND");
  const auto second = Program::FromText("b", "Y2");
  Block block;
  ParseBlock(*first, 0, 1, &block);
  ParseBlock(*second, 0, 1, &block);
  EXPECT_EQ(Describe(block), "Y2");
  EXPECT_TRUE(block.code.empty());
  EXPECT_TRUE(block.doubts.empty());
}

TEST(BlockTest, DoubtfulExpressionsAreMarked) {
  const std::vector<const char*> doubtful = {"IF [#1 AND #2 EQ #3] GOTO1", "#1=1+2 AND 3",
                                             "#1=#2 OR #3 AND #4", "#1=ATAN[1]/[2]"};
  for (const char* text : doubtful) EXPECT_EQ(Parse(text).doubts.size(), 1u) << text;
  const std::vector<const char*> clear = {"IF [[#1 EQ 1] AND [#2 LT 5]] GOTO1", "#1=1+2*3",
                                          "IF [#1+1 GT 2] GOTO1", "#1=#2 AND #3 AND #4",
                                          "#1=ATAN[1]/2"};
  for (const char* text : clear) EXPECT_TRUE(Parse(text).doubts.empty()) << text;
}

// Hostile lines: bounded in time and memory, one clear error.
TEST(BlockTest, ALineOfTenMegabytes) {
  const std::size_t size = 10'000'000;
  const std::vector<std::string> units = {"X1 ",   "G1 ",       "()", "#1=1 ",    "a", "[",
                                          "#",     "9",         ";",  "=!",       "-", "X#1 ",
                                          "DPRNT", "IF[1]THEN", "%",  "\xC3\xA4", "(", "N1 "};
  for (const std::string& unit : units) {
    std::string text;
    text.reserve(size + unit.size());
    while (text.size() < size) text += unit;
    const Block block = Parse(text);
    EXPECT_LE(block.errors.size(), 8u) << unit;
    EXPECT_LE(block.words.capacity() + block.statements.capacity() + block.code.capacity(), 8192u);
    EXPECT_EQ(block.next, text.size()) << unit;
    if (unit != ";") {
      EXPECT_FALSE(block.errors.empty()) << unit;
    }
  }
}

TEST(BlockTest, DeepNesting) {
  const Block open = Parse("X" + std::string(100'000, '['));
  EXPECT_EQ(open.errors.at(0).message, "brackets are nested deeper than 32 levels");
  const Block minus = Parse("#1=" + std::string(100'000, '-') + "1");
  EXPECT_EQ(minus.errors.at(0).message, "the expression is nested too deeply");
  std::string functions;
  for (int i = 0; i < 10'000; ++i) functions += "SIN[";
  EXPECT_EQ(Parse("#1=" + functions).errors.size(), 1u);
  EXPECT_TRUE(Parse("X" + std::string(32, '[') + "1" + std::string(32, ']')).errors.empty());
}

TEST(BlockTest, WordsStaySmall) { EXPECT_LE(sizeof(Word), 32u); }

}  // namespace
}  // namespace ncsim::nc
