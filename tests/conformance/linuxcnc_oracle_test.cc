// SPDX-License-Identifier: BSD-3-Clause
// Programs of others through this Haas interpreter and through LinuxCNC's: docs/conformance.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "tests/conformance/cases.h"
#include "tests/conformance/conformance_report.h"

namespace ncsim::conformance {
namespace {

using ::testing::HasSubstr;

const std::string kPage = std::string(NCSIM_SOURCE_DIR) + "/docs/conformance.md";
const std::string kAgreements = std::string(NCSIM_SOURCE_DIR) + "/tests/conformance/agreements.txt";

std::vector<std::string> Lines(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(CanonReader, AppliesUnitsOffsetsRotationAndLength) {
  const Canon canon = ReadCanon(
      "   1 N..... USE_LENGTH_UNITS(CANON_UNITS_INCHES)\n"
      "   2 N..... SET_G5X_OFFSET(1, 1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
      "   3 N..... SET_XY_ROTATION(90.0000)\n"
      "   4 N..... USE_TOOL_LENGTH_OFFSET(0.0000 0.0000 2.0000, 0.0000 0.0000 0.0000, 0.0 0.0 "
      "0.0)\n"
      "   5 N..... SET_FEED_RATE(60.0000)\n"
      "   6 N5     COMMENT(\"STRAIGHT_FEED(1)\")\n"
      "   7 N5     STRAIGHT_FEED(1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 30.0000)\n"
      "   8 N5     SELECT_PLANE(CANON_PLANE_XZ)\n"
      "   9 N5     PROGRAM_END()\n");
  ASSERT_EQ(canon.steps.size(), 1U);
  EXPECT_NEAR(canon.steps[0].end[0], 25.4, 1e-9);
  EXPECT_NEAR(canon.steps[0].end[1], 25.4, 1e-9);
  EXPECT_NEAR(canon.steps[0].end[2], 50.8, 1e-9);
  EXPECT_NEAR(canon.steps[0].end[5], 30.0, 1e-9);
  EXPECT_TRUE(canon.ends);
}

TEST(CanonReader, ArcsOfAllPlanes) {
  // G18 gives Z, then X (emccanon.cc, ARC_FEED): a quarter turn about +Y from Z10 to X10.
  const Canon canon = ReadCanon(
      " N1 STRAIGHT_FEED(0.0, 0.0, 10.0, 0.0, 0.0, 0.0)\n"
      " N1 SELECT_PLANE(CANON_PLANE_XZ)\n"
      " N1 ARC_FEED(0.0, 10.0, 0.0, 0.0, 1, 5.0, 0.0, 0.0, 0.0)\n"
      " N1 ARC_FEED(0.0, 10.0, 0.0, 0.0, -1, 5.0, 0.0, 0.0, 0.0)\n");
  ASSERT_EQ(canon.steps.size(), 3U);
  EXPECT_EQ(canon.steps[1].normal, 1);
  EXPECT_NEAR(canon.steps[1].sweep_deg, 90.0, 1e-9);
  EXPECT_NEAR(canon.steps[1].end[0], 10.0, 1e-9);
  EXPECT_NEAR(canon.steps[1].end[1], 5.0, 1e-9);
  EXPECT_NEAR(canon.steps[2].sweep_deg, -360.0, 1e-9);
}

TEST(CanonReader, StopsAtACallThatItDoesNotKnow) {
  const Canon canon =
      ReadCanon(" N1 STRAIGHT_PROBE(0.0, 0.0, 1.0, 0.0, 0.0, 0.0)\n N1 PROGRAM_END()\n");
  EXPECT_EQ(canon.unknown_call, "STRAIGHT_PROBE");
  EXPECT_FALSE(canon.ends);
}

Step To(StepKind kind, double x, double z) {
  Step step;
  step.kind = kind;
  step.end = {x, 0.0, z, 0.0, 0.0, 0.0};
  return step;
}

TEST(CanonStep, SeesASmallDifferenceAndGoesOnBehindIt) {
  const std::vector<Step> ours = {To(StepKind::kFeed, 1, 0), To(StepKind::kFeed, 2.0002, 0),
                                  To(StepKind::kFeed, 3, 0)};
  std::vector<Step> reference = {To(StepKind::kFeed, 1, 0), To(StepKind::kFeed, 2, 0),
                                 To(StepKind::kFeed, 3, 0)};
  const Comparison comparison = Compare(ours, reference);
  EXPECT_FALSE(comparison.agree);
  EXPECT_EQ(comparison.agreed, 2);
  EXPECT_THAT(comparison.difference, HasSubstr("end of X"));
  reference[1].end[0] = 2.00015;
  EXPECT_TRUE(Compare(ours, reference).agree);
}

TEST(CanonStep, AnAxisIsFreeFromAToolChangeToItsNextMove) {
  // One machine lifts Z at the change, the other stays.
  const std::vector<Step> ours = {To(StepKind::kRapid, 1, 5), To(StepKind::kToolChange, 1, 0),
                                  To(StepKind::kRapid, 2, 0), To(StepKind::kRapid, 2, 7)};
  std::vector<Step> reference = {To(StepKind::kRapid, 1, 5), To(StepKind::kToolChange, 1, 5),
                                 To(StepKind::kRapid, 2, 5), To(StepKind::kRapid, 2, 7)};
  EXPECT_TRUE(Compare(ours, reference).agree);
  reference[3].end[2] = 8;
  EXPECT_FALSE(Compare(ours, reference).agree);
}

TEST(HaasRun, NormalisesSpellingOnly) {
  EXPECT_EQ(Normalise("n1.5 g1 x 1 y-2 ; note\ng4 p2\nt3 m6 (load)\ng41 x1 (on)\n(G4 p1)\n"),
            " G1 X1 Y-2 \nG4 P2.\nT3 M6 (load)\nG41 D3  X1 (on)\n(G4 p1)\n");
}

class LinuxCncOracle : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* corpus = std::getenv("NCSIM_CORPUS");
    if (corpus == nullptr || !std::filesystem::is_directory(corpus)) {
      GTEST_SKIP() << "NCSIM_CORPUS does not name the folder of third-party programs";
    }
    HaasRunOptions options;
    options.yasnac_corners = true;
    options.subprogram_folders = {std::string(corpus) + "/linuxcnc/oracle/subs"};
    for (const Case& item : FindCases(corpus)) {
      const auto program = ReadText(item.program);
      const auto reference = ReadText(item.reference);
      ASSERT_TRUE(program && reference) << item.name;
      results_.push_back(
          Judge(item.name, RunHaas(item.program, *program, options), ReadCanon(*reference)));
    }
  }

  std::vector<Result> results_;
};

TEST_F(LinuxCncOracle, EveryDifferenceHasAReasonAndNoAgreementIsLost) {
  ASSERT_GT(results_.size(), 100U);
  std::set<std::string> agree;
  for (const Result& result : results_) {
    EXPECT_NE(result.outcome, Outcome::kUnexplained) << result.name << ": " << result.difference;
    if (result.outcome == Outcome::kAgree || result.outcome == Outcome::kAgreeButCompEnds) {
      agree.insert(result.name);
    }
  }
  const std::vector<std::string> expected = Lines(kAgreements);
  for (const std::string& name : expected) {
    EXPECT_TRUE(agree.count(name) > 0) << name << " agreed once";
  }
  const std::string page = ToMarkdown(results_);
  if (std::getenv("NCSIM_UPDATE_DOCS") != nullptr) {
    std::ofstream(kPage) << page;
    agree.insert(expected.begin(), expected.end());  // Never shorter.
    std::ofstream list(kAgreements);
    for (const std::string& name : agree) list << name << "\n";
    return;
  }
  EXPECT_EQ(expected.size(), agree.size()) << "run once with NCSIM_UPDATE_DOCS=1";
  std::ifstream in(kPage);
  const std::string written((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_EQ(written, page) << "run once with NCSIM_UPDATE_DOCS=1";
}

}  // namespace
}  // namespace ncsim::conformance
