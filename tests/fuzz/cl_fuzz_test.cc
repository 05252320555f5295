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
#include "tests/fuzz/cl_language.h"

namespace ncsim::post {
namespace {

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
  for (const std::string_view seed : kClSeeds) {
    EXPECT_FALSE(RunCl(std::string(seed), ClOptions{}).diagnostics.has_errors()) << seed;
  }
}

TEST(ClFuzzTest, MutatedFiles) {
  Random random(20261122);
  int clean = 0;
  for (int i = 0; i < 40'000; ++i) {
    std::string text(kClSeeds[random.Below(kClSeeds.size())]);
    const std::size_t mutations = 1 + random.Below(5);
    for (std::size_t m = 0; m < mutations && text.size() < 4000; ++m) {
      Mutate(kClLanguage, &random, &text);
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
  for (const std::string_view seed : kClSeeds) {
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
