// SPDX-License-Identifier: BSD-3-Clause
// Mutated cutter-location files through planner and writer, in every mode of every post: no crash,
// no hang, no memory without end, and no program without an error for what cannot be said.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "post/post_options.h"
#include "post/post_program.h"
#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "tests/fuzz/cl_language.h"

namespace ncsim::post {
namespace {

/// What any of the posts has words for.
constexpr std::array<std::string_view, 3> kPostSeeds = {
    "TOOL PATH/OP,TOOL,T1\nTLDATA/MILL,10,5,35,0,0\nMSYS/0,0,15,1,0,0,0,1,0\nLOAD/TOOL,1\n"
    "SPINDL/RPM,1000,CLW\nCOOLNT/ON\nRAPID\nGOTO/10,0,5,0,0,1\nFEDRAT/MMPM,250.0\n"
    "CIRCLE/0,0,5,0,0,1,10,0.06,0.5,10,1,TIMES,3\nGOTO/0,10,2\nGOTO/0,20,0,0.6,0,0.8\n"
    "GOTO/5,20,0,0,0,1\nGOTO/5,25,0,-0.6,0,0.8\nEND-OF-PATH\n"
    "TOOL PATH/OP2,TOOL,T2\nTLDATA/MILL,8,0,35,0,0\nMSYS/0,0,25,1,0,0,0,1,0\nLOAD/TOOL,2\n"
    "SPINDL/RPM,900,CCLW\nRAPID\nGOTO/1,2,30,0,0,1\nFEDRAT/IPM,10\nGOTO/1,2,3\nDELAY/2\n"
    "OPSTOP\nGOTO/4,5,3\nEND-OF-PATH\n",
    "TOOL PATH/H,TOOL,D\nTLDATA/DRILL,8,0,100,118,50\nLOAD/TOOL,2\nSPINDL/RPM,500,CLW\nRAPID\n"
    "GOTO/0,0,50,0,0,1\nCYCLE/DRILL,DEEP,RAPTO,3,FEDTO,-33,RTRCTO,AUTO,MMPM,250.,STEP,5,4\n"
    "GOTO/66,0,20\nGOTO/1,2,3\nCYCLE/OFF\nRAPID\nGOTO/40,0,60,0.6,0,0.8\n"
    "CYCLE/DRILL,RAPTO,3,FEDTO,-10,MMPM,100\nGOTO/30,0,20,0.6,0,0.8\nCYCLE/OFF\nPPRINT/DONE\n"
    "END-OF-PATH\n",
    "PARTNO / MFG0001\nUNITS / INCHES\nLOADTL / 2, OSETNO, 2\n$$-> CUTTER / 6.0\nMULTAX / ON\n"
    "SPINDL / RPM, 7957.7,  CLW\nRAPID\nGOTO / 2.1, -2.7, 4.5,  $\n0.6, 0, 0.8\n"
    "FEDRAT / 10, IPM\nGOTO / 1,0,0,0,0,1\nGOTO / 1,0.5,0,-0.6,0,0.8\nFINI\n"};

/// A machine with its post.
class Site {
 public:
  Site(const std::string& urdf, const std::string& post) {
    Diagnostics diagnostics;
    const std::string models = NCSIM_SOURCE_DIR "/models/";
    machine_ = *machine::LoadMachine(models + urdf, &diagnostics);
    std::stringstream text;
    text << std::ifstream(models + post).rdbuf();
    post_ = *LoadPost(text.str(), post, {}, &diagnostics);
    geometry_.emplace(machine_, Eigen::Isometry3d::Identity(), Radians(0.001));
  }

  const PostData& post() const { return post_; }

  PostedProgram Run(const std::string& text, const std::string& mode, bool split,
                    Diagnostics* diagnostics) const {
    PostJob job;
    job.cl = nc::Program::FromText("x.cls", text);
    job.cl_options.unit = ClUnit::kMillimetre;
    job.cl_options.first_tool = 1;
    job.post = &post_;
    job.geometry = &*geometry_;
    job.info = {"x", 1, "x.cls", mode, {}};
    job.file_for_operation = split;
    PlanOptions options = PlanOptionsOf(post_, mode);
    options.separate = split;
    job.info.tools = ReadCl(job.cl, job.cl_options, diagnostics).tools;
    if (diagnostics->has_errors()) return {};
    return PostProgram(job, options, diagnostics);
  }

 private:
  machine::Machine machine_;
  PostData post_;
  std::optional<PartGeometry> geometry_;
};

class PostFuzzTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    sites_ = new std::vector<std::unique_ptr<Site>>();
    sites_->push_back(
        std::make_unique<Site>("haas_umc750/umc750.urdf", "haas_umc750/umc750.post.toml"));
    sites_->push_back(std::make_unique<Site>("bc_table_840d/bc_table_840d.urdf",
                                             "bc_table_840d/bc_table_840d.post.toml"));
    sites_->push_back(std::make_unique<Site>("haas_umc750/umc750.urdf", "fanuc_3axis.post.toml"));
  }
  static void TearDownTestSuite() { delete sites_; }

  /// Names of the file stand in comments, whatever they are.
  static std::string WithoutComments(const std::string& text, const std::string& open) {
    std::string words, line;
    for (std::istringstream lines(text); std::getline(lines, line);) {
      words += line.substr(0, line.find(open)) + "\n";
    }
    return words;
  }

  /// True where it can be posted.
  static bool RunAnywhere(const std::string& text, Random* random) {
    const Site& site = *(*sites_)[random->Below(sites_->size())];
    const std::size_t mode = random->Below(site.post().modes.size() + 1);
    const std::string name =
        mode < site.post().modes.size() ? site.post().modes[mode].name : std::string();
    Diagnostics diagnostics;
    const PostedProgram program = site.Run(text, name, random->Below(4) == 0, &diagnostics);
    if (diagnostics.has_errors()) return false;
    EXPECT_FALSE(program.files.empty());
    for (const PostedFile& file : program.files) {
      EXPECT_LT(file.text.size(), 20'000'000u);
      const std::string words = WithoutComments(file.text, site.post().comments.open);
      EXPECT_EQ(words.find("nan"), std::string::npos);
      EXPECT_EQ(words.find("inf"), std::string::npos);
    }
    return true;
  }

  static std::vector<std::unique_ptr<Site>>* sites_;
};
std::vector<std::unique_ptr<Site>>* PostFuzzTest::sites_ = nullptr;

TEST_F(PostFuzzTest, MutatedFiles) {
  Random random(20261123);
  int posted = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text(kPostSeeds[random.Below(kPostSeeds.size())]);
    const std::size_t mutations = random.Below(4);
    for (std::size_t m = 0; m < mutations && text.size() < 4000; ++m) {
      Mutate(kClLanguage, &random, &text);
    }
    posted += RunAnywhere(text, &random) ? 1 : 0;
    if (HasFailure()) FAIL() << "iteration " << i << ", text:\n" << testing::PrintToString(text);
  }
  EXPECT_GT(posted, 500) << "hardly a text is posted: the checks see nothing";
}

// A motion that would be points without end is an error with its line, where the mode has no arcs.
TEST_F(PostFuzzTest, CirclesWithoutEnd) {
  const std::string head =
      "TOOL PATH/OP,TOOL,T1\nTLDATA/MILL,10,5,35,0,0\nLOAD/TOOL,1\nSPINDL/RPM,1000,CLW\nRAPID\n"
      "GOTO/0,0,0,0,0,1\nFEDRAT/MMPM,250\n";
  for (const std::string circle :
       {"CIRCLE/0,1000000,0,0,0,-1,1000000,0.06,0.5,10,1,TIMES,10000\nGOTO/0,0,-1000\n",
        "CIRCLE/0,1e12,0,0,0,-1,1e12,0.06,0.5,10,1,TIMES,10000\nGOTO/0,0,-1000\n"}) {
    Diagnostics diagnostics;
    (*sites_)[0]->Run(head + circle + "END-OF-PATH\n", "tcp", false, &diagnostics);
    ASSERT_TRUE(diagnostics.has_errors());
    EXPECT_EQ(ToString(diagnostics.all()[0]),
              "x.cls:8:1: error: the tool cannot be led along here within 0.005 deg and 0.004 mm "
              "with 100000 points");
  }
  // One of a kilometre is no mistake.
  Diagnostics diagnostics;
  const PostedProgram program = (*sites_)[0]->Run(
      head + "CIRCLE/0,1e6,0,0,0,-1,1e6,0.06,0.5,10,1\nGOTO/0,2e6,0\nEND-OF-PATH\n", "tcp", false,
      &diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_GT(program.moves, 10'000u);
}

}  // namespace
}  // namespace ncsim::post
