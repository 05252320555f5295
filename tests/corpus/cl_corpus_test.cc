// SPDX-License-Identifier: BSD-3-Clause
// Every cutter-location file of the corpus: read whole, with as many records as its lines say, and
// circles in the sense that its own neighbouring lines have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "post/test_cl.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

std::vector<fs::path> ClFiles() {
  std::vector<fs::path> files;
  const char* corpus = std::getenv("NCSIM_CORPUS");
  if (corpus == nullptr) return files;
  for (const char* folder : {"clsf", "seed004"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(corpus) / folder)) {
      const std::string extension = entry.path().extension().string();
      for (const char* known : {".cls", ".clsf", ".ncl", ".apt"}) {
        if (extension == known) files.push_back(entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Of no system, and its author's own words: see WhatIsNotRead.
bool IsForeign(const fs::path& file) { return file.parent_path().filename() == "rybakov"; }

ClRun Read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  ClOptions options;
  options.need_tool = false;  // Some of NX load none.
  return RunCl(std::string(std::istreambuf_iterator<char>(in), {}), options);
}

class ClCorpus : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("NCSIM_CORPUS") == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
    files_ = ClFiles();
    ASSERT_EQ(files_.size(), 28u);
  }
  std::vector<fs::path> files_;
};

/// The lines that begin with each word, blanks left out.
std::map<std::string, int> CountWords(const fs::path& file) {
  std::map<std::string, int> count;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::erase_if(line, [](char c) { return c == ' ' || c == '\r'; });
    const std::string word = line.substr(0, line.find('/'));
    ++count[word];
    if (line.rfind("CYCLE/", 0) == 0) {
      ++count[line == "CYCLE/OFF" ? line : "CYCLE"];
      --count[word];
    }
  }
  return count;
}

TEST_F(ClCorpus, EachFileIsReadWhole) {
  std::size_t goto_lines = 0, circles = 0;
  for (const fs::path& file : files_) {
    if (IsForeign(file)) continue;
    const ClRun run = Read(file);
    EXPECT_TRUE(run.messages().empty()) << file << " " << run.messages().front();
    std::map<std::string, int> count = CountWords(file);
    const auto motions = run.motions();
    const auto number = [&](auto predicate) {
      return std::count_if(motions.begin(), motions.end(), predicate);
    };
    EXPECT_EQ(motions.size() + run.holes().size(), count["GOTO"] + count["GOHOME"]) << file;
    EXPECT_EQ(number([](const ClMotion& motion) { return motion.arc.has_value(); }),
              count["CIRCLE"])
        << file;
    EXPECT_EQ(number([](const ClMotion& motion) { return motion.rapid; }),
              count["RAPID"] + count["GOHOME"])
        << file;
    EXPECT_EQ(run.All<ClOperationBegin>().size(),
              count["TOOLPATH"] + count["CSYS"] + count["REMARK->FEATNO"])
        << file;
    EXPECT_EQ(run.All<ClToolLoad>().size(), count["LOAD"] + count["LOADTL"]) << file;
    EXPECT_EQ(run.All<ClPosition>().size(), count["FROM"]) << file;
    EXPECT_EQ(run.All<ClCycleOff>().size(), count["CYCLE/OFF"]) << file;
    EXPECT_EQ(run.All<cl::CutterComp>().size(), count["CUTCOM"]) << file;
    EXPECT_EQ(run.All<cl::Spindle>().size(), count["SPINDL"]) << file;
    goto_lines += static_cast<std::size_t>(count["GOTO"]);
    circles += static_cast<std::size_t>(count["CIRCLE"]);
  }
  // `grep -c` over the files.
  EXPECT_EQ(goto_lines, 50'315u);
  EXPECT_EQ(circles, 2102u);
}

TEST_F(ClCorpus, WhatIsNotRead) {
  for (const fs::path& file : files_) {
    if (!IsForeign(file)) continue;
    const std::vector<std::string> expected = {
        "8:1: warning: a feed rate without a unit is taken for one per minute",
        "13:1: TLCOMP is not supported: it is compensation of a system that is not known",
        "15:1: TLCOMP is not supported: it is compensation of a system that is not known",
        "16:1: unknown statement 'CYCLE81' (did you mean 'CYCLE'?)",
        "17:1: unknown statement 'CYCLE83' (did you mean 'CYCLE'?)",
        "18:1: unknown statement 'WPLANE'",
        "19:1: CALLSUB is not supported: it calls or defines a program",
        "20:1: ENDSUB is not supported: it calls or defines a program"};
    EXPECT_EQ(Read(file).messages(), expected);
  }
}

TEST_F(ClCorpus, EachFileSaysWhoWroteIt) {
  const std::map<std::string, ClFlavour> kFolders = {{"samples", ClFlavour::kNx},
                                                     {"seed004", ClFlavour::kNx},
                                                     {"assets", ClFlavour::kCreo},
                                                     {"rybakov", ClFlavour::kApt}};
  for (const fs::path& file : files_) {
    const auto program = nc::Program::Load(file.string(), std::make_unique<Diagnostics>().get());
    const ClSurvey survey = Survey(*program);
    const auto known = kFolders.find(file.parent_path().filename().string());
    EXPECT_EQ(survey.flavour, known == kFolders.end() ? ClFlavour::kSolidWorksCam : known->second)
        << file;
    EXPECT_EQ(survey.flavour_contradiction, "") << file;
    EXPECT_EQ(survey.unit, survey.flavour == ClFlavour::kCreo ? ClUnit::kInch : ClUnit::kMillimetre)
        << file;
  }
}

/// Unit direction of travel at an end of a motion; zero where there is none.
Vector3d Direction(const ClMotion& motion, bool at_end) {
  if (!motion.arc) {
    return motion.start ? Vector3d((motion.end.tip_M - motion.start->tip_M).normalized())
                        : Vector3d::Zero();
  }
  const Vector3d& point = at_end ? motion.end.tip_M : motion.start->tip_M;
  return motion.arc->normal_M.cross(point - motion.arc->centre_M).normalized();
}

struct Joints {
  int smooth = 0, back = 0, other = 0;  ///< The way goes on; turns back on itself; has a corner.
};

/// Of arcs with the straight lines before and behind them.
Joints CountJoints(const std::vector<ClMotion>& motions) {
  Joints joints;
  for (std::size_t i = 0; i + 1 < motions.size(); ++i) {
    const ClMotion& a = motions[i];
    const ClMotion& b = motions[i + 1];
    if (a.arc.has_value() == b.arc.has_value()) continue;
    const double cosine = Direction(a, true).dot(Direction(b, false));
    if (cosine > 0.999) {
      ++joints.smooth;
    } else if (cosine < -0.999) {
      ++joints.back;
    } else {
      ++joints.other;
    }
  }
  return joints;
}

// With the other sense of CIRCLE, smooth joints would be those that turn back. Where a way does
// turn back (40 of SolidWorks CAM's), it goes over a stretch again that it has cut.
TEST_F(ClCorpus, LinesRunIntoCirclesSmoothly) {
  std::map<ClFlavour, Joints> all;
  for (const fs::path& file : files_) {
    const ClRun run = Read(file);
    const bool nx = file.extension() != ".apt" && file.extension() != ".ncl";
    const Joints joints = CountJoints(run.motions());
    Joints& sum = all[nx ? ClFlavour::kNx : ClFlavour::kSolidWorksCam];
    sum.smooth += joints.smooth;
    sum.back += joints.back;
    EXPECT_GE(joints.smooth, 9 * joints.back) << file;
  }
  EXPECT_EQ(all[ClFlavour::kNx].smooth, 162);
  EXPECT_EQ(all[ClFlavour::kNx].back, 0);
  EXPECT_EQ(all[ClFlavour::kSolidWorksCam].smooth, 1513);
  EXPECT_EQ(all[ClFlavour::kSolidWorksCam].back, 40);
}

// TIMES,n counts begun turns: only then the ramps of NX have the round angles that somebody typed.
TEST_F(ClCorpus, HelicesRampAtRoundAngles) {
  int helices = 0;
  for (const fs::path& file : files_) {
    for (const ClMotion& motion : Read(file).motions()) {
      if (!motion.arc || motion.arc->sweep <= 2 * kPi) continue;
      ++helices;
      const double ramp =
          Degrees(std::atan2(std::abs(motion.arc->rise), motion.arc->radius * motion.arc->sweep));
      EXPECT_NEAR(ramp, ramp < 1.0 ? 0.4 : 2.0, 0.001) << file;
    }
  }
  EXPECT_EQ(helices, 6);
}

TEST_F(ClCorpus, HolesGoBackToWhereTheyCameFrom) {
  int holes = 0;
  for (const fs::path& file : files_) {
    if (file.extension() != ".apt" || IsForeign(file)) continue;
    for (const ClHole& hole : Read(file).holes()) {
      // SolidWorks CAM: RTRCTO from the point of the hole is the level of the GOTO before the
      // cycle.
      ASSERT_TRUE(hole.start);
      EXPECT_NEAR(hole.point.axis_M.dot(hole.start->tip_M - hole.point.tip_M), hole.retract, 1e-6)
          << file;
      ++holes;
    }
  }
  EXPECT_EQ(holes, 89);
}

}  // namespace
}  // namespace ncsim::post
