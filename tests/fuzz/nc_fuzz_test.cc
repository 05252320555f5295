// SPDX-License-Identifier: BSD-3-Clause
// Mutated NC texts through lexer, expressions, header reader and flow: no crash, no hang, no
// silence. Deterministic: the same seed gives the same texts on every machine.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/control/flow.h"
#include "sim/nc/header_tools.h"
#include "sim/nc/program.h"
#include "tests/fuzz/mutate.h"

namespace ncsim {
namespace {

constexpr std::array<std::string_view, 8> kSeeds = {
    "%\nO1 (HEAD)\nN10 G90 G54 G00 X1.5 Y-.25\nG43 H1 Z3.1\nG01 Z-.5 F10.\nM30\n%\n",
    "#1=0\nWHILE [#1 LT 3] DO1\n#1=#1+1\nX#1 Y-[SIN[#1*10]/2]\nEND1\nM30\n",
    "G65 P9 L2 A1. I1 J2 K3 I4\nM98 P9\nM97 P5 L3\nM30\nN5 #[#1+100]=#4\nM99\nO9\nX#24 M99\n",
    "N1 IF [[#2 NE #0] AND [#7 LE 9]] GOTO2\n#3000=1 (TEXT)\nN2 #2=ATAN[1]/[2]\nGOTO[1+1]\n",
    "(TOOL TABLE SUMMARY)\n(TOOL-NO. NAME DIAMETER)\n(1 MILL 0.5)\n(T3 D=0.125 CR=0.0625 - "
    "BALL)\nX1\n",
    "DPRNT[X#1[44]*Z]\nPOPEN\nG01 X1. ,R.1\nY2. ,C-#3\n/M01\n[#1 EQ #2] M99 P5\nN5\n",
    "DO1\nDO2\nDO3\nIF[#1GT2]THEN#1=#[#1]MOD 3 M99\nEND3\nEND2\nGOTO7\nEND1\nN7 M99 P7\n",
    "\xEF\xBB\xBFG1X1Y2\r\nG2 I1 R-2.5;\rM96 P1 Q2\r\n(Fr\xE4ser)\r\n#599=ROUND[FIX[-3.5]]"};

constexpr std::array<std::string_view, 28> kTokens = {
    "#",   "[",    "]",   "(",      ")",      "GOTO",   "WHILE", "DO1", "END1",
    "IF[", "THEN", "M99", "M98 P9", "G65 P9", "M97 P5", "=",     "-",   "9999999999999999",
    "#0",  "O9",   "N5",  "%",      "\n",     "\r",     "/",     ";",   "SQRT[",
    "AND"};

const FuzzLanguage kLanguage = {kSeeds, kTokens, "[(-#9X"};

class AnySystem : public control::SystemVariables {
 public:
  bool Read(long number, nc::MacroValue* value) override {
    *value = static_cast<double>(number % 7);
    return number % 3 != 0;
  }
  bool Write(long number, nc::MacroValue) override { return number % 3 != 0; }
  void AssumeUndefined(long) override {}
};

void CheckBlock(const nc::Block& block, std::size_t size) {
  ASSERT_GT(block.next, block.offset);
  ASSERT_LE(block.next, size);
  const int columns = static_cast<int>(block.next - block.offset) + 1;
  for (const nc::Word& word : block.words) {
    ASSERT_TRUE(word.address >= 'A' && word.address <= 'Z');
    ASSERT_TRUE(std::isfinite(word.value));
    ASSERT_TRUE(word.column >= 1 && word.column <= columns);
    ASSERT_LE(word.expression.end, block.code.size());
  }
  for (const nc::SyntaxError& error : block.errors) {
    ASSERT_TRUE(error.column >= 1 && error.column <= columns);
    ASSERT_FALSE(error.message.empty());
  }
}

void RunText(std::string text) {
  const auto program = nc::Program::FromText("fuzz.nc", std::move(text));
  nc::Block block;
  int line = 0;
  for (std::size_t offset = program->begin(); offset < program->text().size();
       offset = block.next) {
    nc::ParseBlock(*program, offset, ++line, &block);
    CheckBlock(block, program->text().size());
    if (testing::Test::HasFatalFailure()) return;
  }
  nc::ReadHeaderTools(*program);
  AnySystem system;
  SourceFiles files;
  control::FlowOptions options;
  options.max_blocks = 200;
  int findings = 0;
  control::Flow flow(program, options, &system, &files, [&](const Finding& finding) {
    ++findings;
    EXPECT_FALSE(finding.message.empty());
    EXPECT_GE(finding.where.line, 1);
    EXPECT_LE(finding.where.line, line);
  });
  control::ResolvedBlock resolved;
  control::FlowEvent event = control::FlowEvent::kBlock;
  while ((event = flow.Next(&resolved)) == control::FlowEvent::kBlock) {
    for (const control::ResolvedWord& word : resolved.words) {
      ASSERT_TRUE(std::isfinite(word.value) && std::abs(word.value) <= 1e9);
    }
  }
  if (event == control::FlowEvent::kStopped) {
    ASSERT_GT(findings, 0) << "stopped without saying why";
  }
  ASSERT_LE(flow.blocks_executed(), options.max_blocks);
}

TEST(NcFuzzTest, MutatedPrograms) {
  Random random(20240229);
  for (int i = 0; i < 50'000; ++i) {
    std::string text(kSeeds[random.Below(kSeeds.size())]);
    const std::size_t mutations = 1 + random.Below(6);
    for (std::size_t m = 0; m < mutations && text.size() < 2000; ++m)
      Mutate(kLanguage, &random, &text);
    RunText(text);
    if (HasFailure()) {
      FAIL() << "iteration " << i << ", text:\n" << testing::PrintToString(text);
    }
  }
}

TEST(NcFuzzTest, RandomBytes) {
  Random random(7);
  for (int i = 0; i < 5'000; ++i) {
    std::string text(random.Below(300), ' ');
    for (char& c : text) c = static_cast<char>(random.Below(256));
    RunText(text);
    if (HasFailure()) FAIL() << "iteration " << i << ": " << testing::PrintToString(text);
  }
}

}  // namespace
}  // namespace ncsim
