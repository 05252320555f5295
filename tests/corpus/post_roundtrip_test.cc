// SPDX-License-Identifier: BSD-3-Clause
// Every milling file of the corpus through every post and mode, and back: `ncsim post`, and what it
// wrote held against the file by `ncsim compare`. What a machine or a mode cannot carry is refused
// at its line, with nothing written.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/app/app.h"
#include "tests/post/post_rig.h"

namespace ncsim::posting {
namespace {

namespace fs = std::filesystem;

/// What each file meets: a mode, the line of the file that it cannot carry, and why.
struct Refusal {
  int line;
  const char* why;
};
constexpr const char* kTurns = "a feed turns the tool axis, and this mode holds the rotary axes";
constexpr const char* kHoles = "the mode has no drilling cycles";
constexpr const char* kComp = "the mode has no cutter compensation (CUTCOM)";
constexpr const char* kTilt = "the machine cannot tilt the tool to the axis";
constexpr const char* kThree = "turns no rotary axis, and the tool axis needs it";
constexpr const char* kPockets = "has 16 pockets";
constexpr const char* kPecks = "the cycle has no depth of its pecks";
constexpr const char* kFast = "is more than axis ";

/// By file, machine (h: UMC-750, s: BC table) and mode ("": as the operations need).
using Refusals = std::map<std::pair<std::string, std::string>, Refusal>;

const Refusals& Known() {
  static const Refusals known = {
      {{"finition.ncl", "h axes"}, {88, kFast}},
      {{"finition.ncl", "h three"}, {186, kTurns}},
      {{"finition.ncl", "s rot"}, {186, kTurns}},
      {{"finition.ncl", "s three"}, {186, kTurns}},
      {{"cutcom.clsf", "h tcp"}, {17, kComp}},
      {{"cutcom.clsf", "h axes"}, {17, kComp}},
      {{"cutcom.clsf", "s rot"}, {17, kComp}},
      {{"cutcom.clsf", "s tcp"}, {17, kComp}},
      {{"cutcom.clsf", "s vectors"}, {17, kComp}},
      {{"deep drill.clsf", "h "}, {9, kPecks}},
      {{"deep drill.clsf", "h tcp"}, {9, kHoles}},
      {{"deep drill.clsf", "h axes"}, {9, kHoles}},
      {{"deep drill.clsf", "h three"}, {9, kPecks}},
      {{"deep drill.clsf", "s "}, {9, kPecks}},
      {{"deep drill.clsf", "s rot"}, {9, kPecks}},
      {{"deep drill.clsf", "s tcp"}, {9, kHoles}},
      {{"deep drill.clsf", "s vectors"}, {9, kHoles}},
      {{"deep drill.clsf", "s three"}, {9, kPecks}},
      {{"standart drill.clsf", "h tcp"}, {9, kHoles}},
      {{"standart drill.clsf", "h axes"}, {9, kHoles}},
      {{"standart drill.clsf", "s tcp"}, {9, kHoles}},
      {{"standart drill.clsf", "s vectors"}, {9, kHoles}},
      {{"ust_a.cls", "h "}, {11, kTilt}},
      {{"ust_a.cls", "h tcp"}, {11, kTilt}},
      {{"ust_a.cls", "h axes"}, {11, kTilt}},
      {{"ust_a.cls", "h three"}, {177, kTurns}},
      {{"ust_a.cls", "s "}, {11, kTilt}},
      {{"ust_a.cls", "s rot"}, {177, kTurns}},
      {{"ust_a.cls", "s tcp"}, {11, kTilt}},
      {{"ust_a.cls", "s vectors"}, {11, kTilt}},
      {{"ust_a.cls", "s three"}, {177, kTurns}},
      {{"Sacrifice-Board.apt", "h "}, {523, kTilt}},
      {{"Sacrifice-Board.apt", "h tcp"}, {18, kHoles}},
      {{"Sacrifice-Board.apt", "h axes"}, {18, kHoles}},
      {{"Sacrifice-Board.apt", "h three"}, {523, kTilt}},
      {{"Sacrifice-Board.apt", "s "}, {523, kTilt}},
      {{"Sacrifice-Board.apt", "s rot"}, {62, kComp}},
      {{"Sacrifice-Board.apt", "s tcp"}, {18, kHoles}},
      {{"Sacrifice-Board.apt", "s vectors"}, {18, kHoles}},
      {{"Sacrifice-Board.apt", "s three"}, {523, kTilt}},
      {{"Teste-Metrologia.apt", "h tcp"}, {221, kComp}},
      {{"Teste-Metrologia.apt", "h axes"}, {221, kComp}},
      {{"Teste-Metrologia.apt", "h three"}, {278, kThree}},
      {{"Teste-Metrologia.apt", "s rot"}, {221, kComp}},
      {{"Teste-Metrologia.apt", "s tcp"}, {221, kComp}},
      {{"Teste-Metrologia.apt", "s vectors"}, {221, kComp}},
      {{"Teste-Metrologia.apt", "s three"}, {278, kThree}},
      {{"basemach.apt", "h tcp"}, {18, kHoles}},
      {{"basemach.apt", "h axes"}, {18, kHoles}},
      {{"basemach.apt", "s "}, {2064, kPockets}},
      {{"basemach.apt", "s rot"}, {2064, kPockets}},
      {{"basemach.apt", "s tcp"}, {2064, kPockets}},
      {{"basemach.apt", "s vectors"}, {2064, kPockets}},
      {{"basemach.apt", "s three"}, {2064, kPockets}},
      {{"Dem-target1.apt", "h tcp"}, {17, kHoles}},
      {{"Dem-target1.apt", "h axes"}, {17, kHoles}},
      {{"Dem-target1.apt", "s tcp"}, {17, kHoles}},
      {{"Dem-target1.apt", "s vectors"}, {17, kHoles}},
      {{"Dem-target2.apt", "h tcp"}, {18, kHoles}},
      {{"Dem-target2.apt", "h axes"}, {18, kHoles}},
      {{"Dem-target2.apt", "s rot"}, {43, kComp}},
      {{"Dem-target2.apt", "s tcp"}, {18, kHoles}},
      {{"Dem-target2.apt", "s vectors"}, {18, kHoles}},
      {{"Interface-glue.apt", "h tcp"}, {18, kHoles}},
      {{"Interface-glue.apt", "h axes"}, {18, kHoles}},
      {{"Interface-glue.apt", "s "}, {27, kPockets}},
      {{"Interface-glue.apt", "s rot"}, {27, kPockets}},
      {{"Interface-glue.apt", "s tcp"}, {27, kPockets}},
      {{"Interface-glue.apt", "s vectors"}, {27, kPockets}},
      {{"Interface-glue.apt", "s three"}, {27, kPockets}},
      {{"SupPetriLED.apt", "h tcp"}, {18, kHoles}},
      {{"SupPetriLED.apt", "h axes"}, {18, kHoles}},
      {{"SupPetriLED.apt", "s "}, {27, kPockets}},
      {{"SupPetriLED.apt", "s rot"}, {27, kPockets}},
      {{"SupPetriLED.apt", "s tcp"}, {27, kPockets}},
      {{"SupPetriLED.apt", "s vectors"}, {27, kPockets}},
      {{"SupPetriLED.apt", "s three"}, {27, kPockets}},
      {{"Top-light-cover.apt", "h tcp"}, {18, kHoles}},
      {{"Top-light-cover.apt", "h axes"}, {18, kHoles}},
      {{"Top-light-cover.apt", "s rot"}, {1843, kComp}},
      {{"Top-light-cover.apt", "s tcp"}, {18, kHoles}},
      {{"Top-light-cover.apt", "s vectors"}, {18, kHoles}},
      {{"shimemcunha.apt", "h tcp"}, {44, kHoles}},
      {{"shimemcunha.apt", "h axes"}, {44, kHoles}},
      {{"shimemcunha.apt", "h three"}, {15, kThree}},
      {{"shimemcunha.apt", "s rot"}, {79, kComp}},
      {{"shimemcunha.apt", "s tcp"}, {44, kHoles}},
      {{"shimemcunha.apt", "s vectors"}, {44, kHoles}},
      {{"shimemcunha.apt", "s three"}, {15, kThree}},
      {{"Teflon-gasket.apt", "h tcp"}, {18, kHoles}},
      {{"Teflon-gasket.apt", "h axes"}, {18, kHoles}},
      {{"Teflon-gasket.apt", "s rot"}, {51, kComp}},
      {{"Teflon-gasket.apt", "s tcp"}, {18, kHoles}},
      {{"Teflon-gasket.apt", "s vectors"}, {18, kHoles}},
      {{"wall-holes.apt", "h tcp"}, {79, kComp}},
      {{"wall-holes.apt", "h axes"}, {79, kComp}},
      {{"wall-holes.apt", "h three"}, {2119, kThree}},
      {{"wall-holes.apt", "s "}, {238, kPockets}},
      {{"wall-holes.apt", "s rot"}, {238, kPockets}},
      {{"wall-holes.apt", "s tcp"}, {238, kPockets}},
      {{"wall-holes.apt", "s vectors"}, {238, kPockets}},
      {{"wall-holes.apt", "s three"}, {238, kPockets}},
      {{"blade_finish_excerpt.cls", "h three"}, {22, kTurns}},
      {{"blade_finish_excerpt.cls", "s rot"}, {22, kTurns}},
      {{"blade_finish_excerpt.cls", "s three"}, {22, kTurns}},
  };
  return known;
}

class PostRoundTrip : public testing::Test {
 protected:
  void SetUp() override {
    const char* corpus = std::getenv("NCSIM_CORPUS");
    if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
    corpus_ = corpus;
    for (const char* folder : {"clsf/hum", "clsf/creo-ncl", "clsf/sw-cam-apt", "seed004"}) {
      for (const auto& entry : fs::recursive_directory_iterator(corpus_ / folder)) {
        const std::string extension = entry.path().extension().string();
        for (const char* known : {".cls", ".clsf", ".ncl", ".apt"}) {
          if (extension == known) files_.push_back(entry.path());
        }
      }
    }
    std::sort(files_.begin(), files_.end());
    ASSERT_EQ(files_.size(), 27u);
  }

  static std::vector<Way> Ways(const std::vector<std::string>& more) {
    std::vector<Way> ways;
    for (const char* mode : {"", "tcp", "axes", "three"}) ways.push_back({kUmc750, mode, more});
    for (const char* mode : {"", "rot", "tcp", "vectors", "three"}) {
      ways.push_back({kBcTable, mode, more});
    }
    return ways;
  }

  static std::string NameOf(const Way& way) {
    return std::string(way.model == kUmc750 ? "h" : "s") + " " + way.mode;
  }

  /// There and back; counts what holds.
  void RoundTrip(const fs::path& file, const Way& way, double tolerance, PostRig* rig) {
    SCOPED_TRACE(file.filename().string() + " " + NameOf(way));
    const int posted = rig->Post(file, way);
    const auto refusal = Known().find({file.filename().string(), NameOf(way)});
    if (refusal != Known().end()) {
      ++refused_;
      EXPECT_EQ(posted, app::kExitBadInput);
      EXPECT_FALSE(fs::exists(rig->program()));
      const std::string first = rig->said().substr(0, rig->said().find('\n'));
      const std::string place = file.string() + ":" + std::to_string(refusal->second.line) + ":";
      EXPECT_EQ(first.rfind(place, 0), 0u) << first;
      EXPECT_NE(first.find(refusal->second.why), std::string::npos) << first;
      return;
    }
    ++held_;
    ASSERT_EQ(posted, app::kExitPass) << rig->said();
    ASSERT_EQ(rig->Compare(file, way), app::kExitPass) << rig->said();
    EXPECT_GE(rig->position(), 0.0);
    EXPECT_LE(rig->position(), tolerance);
    EXPECT_LE(rig->angle(), 0.01);
  }

  fs::path corpus_;
  std::vector<fs::path> files_;
  int held_ = 0, refused_ = 0;
};

// 0.005 mm and one increment of the output; `compare` itself sees to feeds, and that nothing is
// lost.
TEST_F(PostRoundTrip, EachFileInMillimetres) {
  PostRig rig("roundtrip_mm");
  for (const fs::path& file : files_) {
    for (const Way& way : Ways({"--unit", "mm"})) RoundTrip(file, way, 0.006, &rig);
  }
  EXPECT_EQ(held_ + refused_, 27 * 9);
  EXPECT_EQ(refused_, static_cast<int>(Known().size()));
  std::cout << held_ << " round trips, " << refused_ << " refused at their lines\n";
}

TEST_F(PostRoundTrip, EachFileInInches) {
  PostRig rig("roundtrip_inch");
  for (const fs::path& file : files_) {
    for (const Way& way : Ways({"--unit", "inch"})) {
      RoundTrip(file, way, way.model == kUmc750 ? 0.0076 : 0.006, &rig);
    }
  }
}

TEST_F(PostRoundTrip, AFileForEachOperation) {
  PostRig rig("roundtrip_split");
  for (const fs::path& file : files_) RoundTrip(file, {kBcTable, "", {"--split"}}, 0.006, &rig);
  // The Haas post has no calls.
  EXPECT_EQ(rig.Post(files_.back(), {kUmc750, "", {"--split"}}), app::kExitBadInput);
  EXPECT_NE(rig.said().find("error: the post writes one file"), std::string::npos) << rig.said();
}

// The three-axis post writes what the same control reads: tools along Z alone.
TEST_F(PostRoundTrip, ThreeAxesFanucStyle) {
  PostRig rig("roundtrip_fanuc");
  const std::string post = NCSIM_SOURCE_DIR "/models/fanuc_3axis.post.toml";
  for (const fs::path& file : files_) {
    RoundTrip(file, {kUmc750, "three", {"--post", post}}, 0.006, &rig);
  }
}

}  // namespace
}  // namespace ncsim::posting
