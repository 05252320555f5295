// SPDX-License-Identifier: BSD-3-Clause
// Mutated cutter-location files through planner and writer, in every mode of every post: no crash,
// no hang, no memory without end, and no program without an error for what cannot be said.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "post/post_options.h"
#include "post/post_program.h"
#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "tests/fuzz/cl_language.h"

namespace ncsim::post {
namespace {

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
      EXPECT_EQ(file.text.find("nan"), std::string::npos);
      EXPECT_EQ(file.text.find("inf"), std::string::npos);
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
    std::string text(kClSeeds[random.Below(kClSeeds.size())]);
    const std::size_t mutations = random.Below(4);
    for (std::size_t m = 0; m < mutations && text.size() < 4000; ++m) {
      Mutate(kClLanguage, &random, &text);
    }
    posted += RunAnywhere(text, &random) ? 1 : 0;
    if (HasFailure()) FAIL() << "iteration " << i << ", text:\n" << testing::PrintToString(text);
  }
  EXPECT_GT(posted, 500) << "hardly a text is posted: the checks see nothing";
}

// What would be a program without end is an error with its line.
TEST_F(PostFuzzTest, CirclesWithoutEnd) {
  for (const char* circle :
       {"CIRCLE/0,1000000000000,0,0,0,1,1000000000000,0.06,0.5,10,1\nGOTO/1,1000000000000,0\n",
        "CIRCLE/0,10,0,0,0,1,10,0.06,0.5,10,1,TIMES,150000\nGOTO/0,20,-1000\n",
        "CIRCLE/0,10,0,0,0,1,10,0.06,0.5,10,1,TIMES,999999\nGOTO/0,20,0\n"}) {
    const std::string text = std::string(
                                 "TOOL PATH/OP,TOOL,T1\nTLDATA/MILL,10,5,35,0,0\n"
                                 "LOAD/TOOL,1\nSPINDL/RPM,1000,CLW\nRAPID\n"
                                 "GOTO/0,0,0,0,0,1\nFEDRAT/MMPM,250\n") +
                             circle + "END-OF-PATH\n";
    for (const auto& site : *sites_) {
      for (const PostMode& mode : site->post().modes) {
        Diagnostics diagnostics;
        const PostedProgram program = site->Run(text, mode.name, false, &diagnostics);
        if (diagnostics.has_errors()) continue;
        EXPECT_LT(program.files.front().text.size(), 20'000'000u) << mode.name;
      }
    }
  }
}

}  // namespace
}  // namespace ncsim::post
