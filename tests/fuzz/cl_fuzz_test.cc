// SPDX-License-Identifier: BSD-3-Clause
// Mutated cutter-location files through reader and state machine: no crash, no hang, nothing that
// is not finite, no event that contradicts itself.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "post/test_cl.h"
#include "tests/fuzz/mutate.h"

namespace ncsim::post {
namespace {

constexpr std::array<std::string_view, 5> kSeeds = {
    "TOOL PATH/OP,TOOL,T1\nTLDATA/MILL,10.0,5.0,35.0,0.0,0.0\nMSYS/0,0,15.1884,1,0,0,0,1,0\n"
    "$$ centerline data\nLOAD/TOOL,1,ADJUST,1\nSPINDL/RPM,1000,CLW\nRAPID\nGOTO/10,0,5,0,0,1\n"
    "FEDRAT/MMPM,250.0\nCIRCLE/0,0,0,0,0,1,10,0.06,0.5,10,1,TIMES,3\nGOTO/0,10,0\n"
    "CUTCOM/LEFT,1,XYPLAN\nGOTO/0,20,0,0.6,0,0.8\nGOHOME/0,0,100\nEND-OF-PATH\n",
    "TOOL PATH/H,TOOL,D\nLOAD/TOOL,2\nFROM/0,0,90\nRAPID\nGOTO/0,0,50\n"
    "CYCLE/DRILL,DEEP,RAPTO,3,FEDTO,-33.0043,RTRCTO,AUTO,MMPM,250.,STEP,5,4,DWELL,REV,2\n"
    "GOTO/66,0,20\nGOTO/1,2,3\nCYCLE/OFF\nDELAY/2\nEND-OF-PATH\n",
    "PARTNO / MFG0001\n$$* Pro/CLfile Version\n$$-> FEATNO / 7\nMACHIN / UNCX01, 1\nUNITS / "
    "INCHES\n"
    "LOADTL / 2, OSETNO, 2\n$$-> CUTTER / 6.0\n$$-> CSYS / 1,0,0,0, $\n 0,1,0,0, $\n 0,0,1,0\n"
    "MULTAX / ON\nSPINDL / RPM, 7957.7,  CLW\nRAPID\nGOTO / 245.1, -22.7, 43.5,  $\n0.6, 0, 0.8\n"
    "FEDRAT / 10, IPM\nGOTO / 10,0,0\nCIRCLE / 0,0,0,0,0,-1,10\nGOTO / 0,-10,0\n-10,0,0\n0,10,0\n"
    "CYCLE/TAP,DEPTH,9,CLEAR,2,TPI,20\nGOTO/1,1,1\nCYCLE/OFF\nFINI\n",
    "PARTNO/1\nUNIT/MM\nINSERT/3MM DRILL\nCUTTER/3.,0,1.5,.62132,22.5,0,46.\nLOAD/TOOL,14\n"
    "CSI_SET_FLUTE_LENGTH/16.\nSELECT/TOOL,11\nCOOLNT/FLOOD\nTRNTYP/WORLD,0,0,0\n"
    "CSYS/0,0,-1.,0,-1.,0,0,0,0,1.,0,0\nRAPID/\nGOTO/1,2,25.,-1,0,0\nCYCLE/INIT\n"
    "CYCLE/DEEP2,FEDTO,24.6205,1STPECK,5.,SUBPECK,2.,MMPM,670.56,RAPTO,3.,RTRCTO,25.\n"
    "GOTO/1,2,0,-1,0,0\nCYCLE/OFF\nFEDRAT/9.,MMPM\nGOTO/2,0,0\nCIRCLE/0,0,0,0,0,1.\nGOTO/2,0,0\n"
    "FINI\n",
    "UNITS/MM\nTURRET/3\nAUXFUN/8,NEXT\nPREFUN/68\nROTATE/TABLE,ATANGL,90\nSET/MODE,1\nOPSTOP\n"
    "FEDRAT/PERMIN,5\nGOTO/1,1,1\nGODLTA/1,0,0\nGODLTA/-2\nGOHOME/Z\nFINI\n"};

constexpr std::array<std::string_view, 34> kTokens = {"GOTO/",
                                                      "CIRCLE/",
                                                      "RAPID\n",
                                                      "TIMES,",
                                                      "$\n",
                                                      "$$",
                                                      "$$-> ",
                                                      "REMARK ",
                                                      "CYCLE/",
                                                      "CYCLE/OFF\n",
                                                      "END-OF-PATH\n",
                                                      "FINI\n",
                                                      "TOOL PATH/",
                                                      "MSYS/",
                                                      "nan",
                                                      "inf",
                                                      "1e308",
                                                      "-1e308",
                                                      "1e-320",
                                                      "9999999999",
                                                      "0,0,0",
                                                      "0,0,2",
                                                      ",,",
                                                      "\n1,2,3\n",
                                                      "\r",
                                                      "\r\n",
                                                      "FROM/",
                                                      "LOAD/TOOL,",
                                                      "MMPM",
                                                      "IPM",
                                                      "IPR",
                                                      "AUTO",
                                                      "GODLTA/",
                                                      "UNITS/INCHES\n"};

const FuzzLanguage kLanguage = {kSeeds, kTokens, ",/$9-E. \n"};

int CountLines(std::string_view text) {
  int lines = 1;
  for (const char c : text) lines += c == '\n' || c == '\r';
  return lines;
}

void CheckPose(const ClPose& pose) {
  ASSERT_TRUE(pose.tip_M.allFinite());
  ASSERT_NEAR(pose.axis_M.norm(), 1.0, 1e-12);
}

/// Turned by its sweep and moved by its rise, the start of an arc is its end.
void CheckArc(const ClMotion& motion) {
  const ClArc& arc = *motion.arc;
  ASSERT_TRUE(motion.start && !motion.rapid);
  ASSERT_TRUE(arc.sweep > 0.0 && arc.sweep < 1e6 && arc.radius > kClArcTolerance);
  const Eigen::Vector3d arm = motion.start->tip_M - arc.centre_M;
  const Eigen::Vector3d end =
      arc.centre_M + Eigen::AngleAxisd(arc.sweep, arc.normal_M) * arm + arc.rise * arc.normal_M;
  const double size = arc.radius + arc.centre_M.norm() + std::abs(arc.rise);
  ASSERT_LE((end - motion.end.tip_M).norm(), kClArcTolerance * 1.01 + 1e-9 * size);
}

void CheckMotion(const ClMotion& motion, bool clean) {
  CheckPose(motion.end);
  if (motion.start) CheckPose(*motion.start);
  if (motion.arc) CheckArc(motion);
  ASSERT_TRUE(std::isfinite(motion.feed.value));
  ASSERT_TRUE(!motion.home || motion.rapid);
  // Of a text without an error each feed has a rate.
  ASSERT_TRUE(!clean || (motion.feed.value > 0.0) == !motion.rapid);
}

void CheckHole(const ClHole& hole, bool clean) {
  CheckPose(hole.point);
  ASSERT_NE(hole.cycle, nullptr);
  ASSERT_TRUE(std::isfinite(hole.retract) && std::isfinite(hole.cycle->feed.value));
  if (!clean) return;
  ASSERT_LE(hole.cycle->bottom, hole.cycle->clearance);
  ASSERT_GE(hole.retract, hole.cycle->bottom);
  ASSERT_GT(hole.cycle->feed.value, 0.0);
}

void RunText(const std::string& text, const ClOptions& options, int* clean_texts = nullptr) {
  const int lines = CountLines(text);
  const ClRun run = RunCl(text, options);
  const bool clean = !run.diagnostics.has_errors();
  ASSERT_LE(run.diagnostics.all().size(), 110u);
  for (const Diagnostic& diagnostic : run.diagnostics.all()) {
    ASSERT_FALSE(diagnostic.message.empty());
    ASSERT_TRUE(diagnostic.line >= 0 && diagnostic.line <= lines);
    ASSERT_LT(diagnostic.message.size(), 300u);
  }
  for (const ClEvent& event : run.events) {
    ASSERT_TRUE(event.where.line >= 1 && event.where.line <= lines);
    ASSERT_TRUE(event.modal && event.modal->tool && event.modal->operation);
    if (const auto* motion = std::get_if<ClMotion>(&event.what)) CheckMotion(*motion, clean);
    if (const auto* hole = std::get_if<ClHole>(&event.what)) CheckHole(*hole, clean);
    if (testing::Test::HasFatalFailure()) return;
  }
  if (clean) {
    if (clean_texts != nullptr) ++*clean_texts;
    ASSERT_TRUE(std::holds_alternative<ClEnd>(run.events.back().what));
    ASSERT_FALSE(run.motions().empty() && run.holes().empty());
  }
}

ClOptions AnyOptions(Random* random) {
  ClOptions options;
  if (random->Below(3) == 0) options.flavour = static_cast<ClFlavour>(random->Below(4));
  if (random->Below(2) == 0) options.unit = static_cast<ClUnit>(random->Below(2));
  options.need_tool = random->Below(2) == 0;
  return options;
}

TEST(ClFuzzTest, TheSeedsAreFine) {
  for (const std::string_view seed : kSeeds) {
    EXPECT_FALSE(RunCl(std::string(seed), ClOptions{}).diagnostics.has_errors()) << seed;
  }
}

TEST(ClFuzzTest, MutatedFiles) {
  Random random(20261122);
  int clean = 0;
  for (int i = 0; i < 40'000; ++i) {
    std::string text(kSeeds[random.Below(kSeeds.size())]);
    const std::size_t mutations = 1 + random.Below(5);
    for (std::size_t m = 0; m < mutations && text.size() < 4000; ++m) {
      Mutate(kLanguage, &random, &text);
    }
    RunText(text, AnyOptions(&random), &clean);
    if (HasFailure()) FAIL() << "iteration " << i << ", text:\n" << testing::PrintToString(text);
  }
  EXPECT_GT(clean, 500) << "hardly a text passes: the checks of clean ones see nothing";
}

TEST(ClFuzzTest, RandomBytes) {
  Random random(11);
  for (int i = 0; i < 10'000; ++i) {
    std::string text(random.Below(300), ' ');
    for (char& c : text) c = static_cast<char>(random.Below(256));
    RunText(text, AnyOptions(&random));
    if (HasFailure()) FAIL() << "iteration " << i << ": " << testing::PrintToString(text);
  }
}

TEST(ClFuzzTest, CutAnywhere) {
  for (const std::string_view seed : kSeeds) {
    for (std::size_t size = 0; size < seed.size(); ++size) {
      const std::string text(seed.substr(0, size));
      RunText(text, ClOptions{});
      // Without its last line a file is not whole; without that line's end it is.
      if (size + 1 < seed.size()) {
        EXPECT_TRUE(RunCl(text, ClOptions{}).diagnostics.has_errors()) << text;
      }
      if (HasFailure()) FAIL() << text;
    }
  }
}

TEST(ClFuzzTest, LongLines) {
  for (const char* piece :
       {"1,", "$", "$\n", "1,$\n", "GOTO/", "/", ",", " ", "A", "-", "TOOL PATH/", "$$->",
        "REMARK ->", "\n1,2,3", "CIRCLE/0,0,0,0,0,1,5\n", "9"}) {
    std::string text = "GOTO/1,2,3\nGOTO/";
    while (text.size() < 3'000'000) text += piece;
    RunText(text + "\nGOTO/1,2,3\nFINI\n", ClOptions{});
    if (HasFailure()) FAIL() << piece;
  }
}

}  // namespace
}  // namespace ncsim::post
