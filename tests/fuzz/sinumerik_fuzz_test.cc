// SPDX-License-Identifier: BSD-3-Clause
// Mutated SINUMERIK texts through blocks, index, expressions and flow: no crash, no hang, no
// silence.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/control/sinumerik_flow.h"
#include "sim/nc/sinumerik_index.h"
#include "tests/fuzz/mutate.h"

namespace ncsim {
namespace {

constexpr std::array<std::string_view, 10> kSeeds = {
    "%_N_PART_MPF\n;$PATH=/_N_MPF_DIR\nN10 G90 G54 G0 X1.5 Y=IC(-.25)\nSUB(1,,R1) P2\nM30\n"
    "%_N_SUB_SPF\nPROC SUB(REAL AA, VAR REAL BB, STRING[9] CC=\"x\", AXIS DD=X) SAVE\nX=AA "
    "BB=2\nM17\n",
    "DEF INT II,JJ[3,2]=SET(1,2,,4)\nFOR II=0 TO 2\nX=JJ[II,1]*2.5EX1\nENDFOR\n",
    "WHILE R1<3\nR1=R1+1\nIF R1==2\nGOTOF LE\nELSE\nX=R1\nENDIF\nENDWHILE\nLE: M30\n",
    "LA: R1=R1+1\nLB: X=R1\nREPEAT LA LB P=2\nREPEATB LA\nREPEAT LA\nENDLABEL: Y1\n",
    "CASE R1 OF 1 GOTOF LA -2 GOTOB LB DEFAULT GOTO \"L\"<<R1\nLA: CALL BLOCK LB TO LC\nLB: "
    "X1\nLC:\n",
    "MCALL CYCLE83(R1,,2,-20)\nX1\nMCALL SUB\nX2\nMCALL\nCYCLE832(0.01,_ORI_ROUGH,1)\nTRAORI(1)\n",
    "DEF FRAME FF=CTRANS(X,1):CROT(Z,90)\n$P_UIFR[1]=FF\nFF[X,TR]=5\nR1=FF[X,TR]\nTRANS X1 Y=R1\n",
    "DEF STRING[20] SS=\"abc\"<<1\nR1=STRLEN(SS<<\"d\") R2=NUMBER(\"1.5\") "
    "R3=INDEX(SS,\"b\")\nMSG(SS)\n",
    "/3 N5 LOOP\nR[R1+1]=SIN(30)*'H1F' DIV 3 MOD 2 B_AND 7\nIF (R1>3) AND NOT (R2==1) GOTOF LE\n"
    "ENDLOOP\nLE: REPEAT\nR1=R1-1\nUNTIL R1<=0\n",
    "ID=1 WHEN $A_IN[1]==1 DO M8\nSETINT(1) PRIO=1 LIFT\nDEFINE AB AS "
    "G0\nSETAL(65000)\nEXTCALL(\"A/B\")\n"};

constexpr std::array<std::string_view, 36> kTokens = {
    "GOTOF ",    "GOTOB LA", "GOTO N10",    "IF ",    "ELSE\n", "ENDIF\n",
    "ENDFOR\n",  "WHILE ",   "REPEAT ",     "UNTIL ", "LOOP\n", "CASE ",
    "DEF REAL ", "PROC ",    "MCALL ",      "CALL ",  "SUB",    "RET\n",
    "M17",       "SET(",     "REP(",        "IC(",    "<<",     "==",
    "\"",        "'H",       "99999999999", "1EX300", "R[",     "%_N_B_SPF\n",
    "\n",        "\r",       "/1 ",         ";",      "$P_",    "ENDLABEL"};

const FuzzLanguage kLanguage = {kSeeds, kTokens, "[(-R9X\"<"};

class AnySystem : public control::SinumerikSystem {
 public:
  bool IsAxis(std::string_view name) const override { return name == "X" || name == "Y"; }
  Access Read(std::string_view name, const std::vector<nc::SinumerikValue>& indices,
              nc::SinumerikValue* value, std::string* message) override {
    *value = nc::SinumerikValue::Real(static_cast<double>(name.size() + indices.size()));
    *message = "an alarm";
    return static_cast<Access>(name.size() % 3);
  }
  Access Write(std::string_view name, const std::vector<nc::SinumerikValue>&,
               const nc::SinumerikValue&, std::string* message) override {
    *message = "an alarm";
    return static_cast<Access>(name.size() % 3);
  }
  void AssumeZero(const std::string&) override {}
};

void CheckBlock(const nc::SinumerikBlock& block, std::size_t size) {
  ASSERT_GT(block.next, block.offset);
  ASSERT_LE(block.next, size);
  const int columns = static_cast<int>(block.next - block.offset) + 1;
  for (const nc::SinumerikPart& part : block.parts) {
    ASSERT_TRUE(std::isfinite(part.value));
    ASSERT_TRUE(part.column >= 1 && part.column <= columns);
    if (!block.errors.empty()) continue;
    ASSERT_LE(part.expression.end, block.code.size());
    ASSERT_LE(part.first_argument + part.argument_count, block.arguments.size());
    ASSERT_LE(part.first_index + part.index_count, block.arguments.size());
  }
  for (const nc::SyntaxError& error : block.errors) {
    ASSERT_TRUE(error.column >= 1 && error.column <= columns);
    ASSERT_NE(error.message.find("(alarm "), std::string::npos);
  }
}

void RunText(std::string text) {
  const auto program = nc::Program::FromText("fuzz.mpf", std::move(text));
  nc::SinumerikBlock block;
  int line = 0;
  for (std::size_t at = program->begin(); at < program->text().size(); at = block.next) {
    nc::ParseSinumerikBlock(*program, at, ++line, &block);
    CheckBlock(block, program->text().size());
    if (testing::Test::HasFatalFailure()) return;
  }
  const nc::SinumerikIndex index(*program);
  ASSERT_FALSE(index.sections().empty());
  AnySystem system;
  SourceFiles files;
  control::SinumerikFlowOptions options;
  options.max_blocks = 200;
  options.r_parameters = 20;
  options.skip_levels = 1;
  int findings = 0;
  control::SinumerikFlow flow(program, options, &system, &files, [&](const Finding& finding) {
    ++findings;
    EXPECT_FALSE(finding.message.empty());
    EXPECT_GE(finding.where.line, 1);
    EXPECT_LE(finding.where.line, line);
  });
  control::SinumerikStep step;
  control::SinumerikEvent event = control::SinumerikEvent::kStep;
  while (event != control::SinumerikEvent::kEnd && event != control::SinumerikEvent::kStopped) {
    event = flow.Next(&step);
    if (event != control::SinumerikEvent::kStep) continue;
    for (const control::SinumerikItem& item : step.items) {
      ASSERT_TRUE(std::isfinite(item.value) && std::abs(item.value) <= 1e9);
      ASSERT_LE(item.first_value + item.value_count + (item.is_text ? 1 : 0), step.values.size());
    }
    flow.PathMotionDone();
  }
  if (event == control::SinumerikEvent::kStopped) {
    ASSERT_GT(findings, 0) << "stopped without saying why";
  }
  ASSERT_LE(flow.blocks_executed(), options.max_blocks);
}

TEST(SinumerikFuzzTest, MutatedPrograms) {
  Random random(20241122);
  for (int i = 0; i < 30'000; ++i) {
    std::string text(kSeeds[random.Below(kSeeds.size())]);
    const std::size_t mutations = 1 + random.Below(6);
    for (std::size_t m = 0; m < mutations && text.size() < 2000; ++m) {
      Mutate(kLanguage, &random, &text);
    }
    RunText(text);
    if (HasFailure()) {
      FAIL() << "iteration " << i << ", text:\n" << testing::PrintToString(text);
    }
  }
}

TEST(SinumerikFuzzTest, RandomBytes) {
  Random random(11);
  for (int i = 0; i < 5'000; ++i) {
    std::string text(random.Below(300), ' ');
    for (char& c : text) c = static_cast<char>(random.Below(256));
    RunText(text);
    if (HasFailure()) FAIL() << "iteration " << i << ": " << testing::PrintToString(text);
  }
}

TEST(SinumerikFuzzTest, LongLines) {
  for (const char* piece :
       {"(", "[", "R1=", "X1", "-", "NOT ", "<<", "IF ", "AA,", "\"", ";", "'H"}) {
    std::string text = "R1=";
    while (text.size() < 200'000) text += piece;
    RunText(text + "\nX1\n");
    if (HasFailure()) FAIL() << piece;
  }
}

}  // namespace
}  // namespace ncsim
