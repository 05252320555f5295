// SPDX-License-Identifier: BSD-3-Clause
// The workflows of the documents: they fit the schemas of GitHub and GitLab, and their commands do
// what the text says. The services themselves are not here; run_workflow.cjs does their steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "sim/nightly/test_folder.h"
#include "tests/report/shown_run.h"
#include "tests/report/tools.h"

namespace ncsim::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* kGithub = "github-workflow.json";
constexpr const char* kGitlab =
    "gitlab.com/gitlab-org/gitlab/-/raw/master/app/assets/javascripts/editor/schema/ci.json";

class WorkflowsOfTheDocs : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string missing = WhyNoPackages();
    if (!missing.empty()) GTEST_SKIP() << missing;
    // The example's folder: a crash that is accepted, one that is not, and a near miss.
    for (const char* name : {"collision.nc", "gouge.nc", "near-miss.nc"}) {
      for (const std::string& file : {std::string(name), name + std::string(".job.toml")}) {
        folder_.Write("source/parts/" + file, ReadBytes(ScenePath("crash_gallery/" + file)));
      }
    }
    folder_.Write(
        "source/baseline.toml",
        "schema = 1\n[[accept]]\nprogram = \"collision.nc\"\nrule = \"collision\"\n"
        "line_text = \"N95 G01 X75.\"\nreason = \"soft jaw\"\nexpires = \"2999-12-31\"\n");
    const std::string path = std::getenv("PATH");
    setenv("PATH", (fs::path(NCSIM_PROGRAM).parent_path().string() + ":" + path).c_str(), 1);
  }

  /// The YAML blocks of a document; at least one.
  static std::vector<std::string> Blocks(const std::string& document) {
    const std::string text = ReadBytes(fs::path(NCSIM_SOURCE_DIR) / document);
    const std::regex block("\n```yaml\n([^`]*)```");
    std::vector<std::string> blocks;
    for (std::sregex_iterator it(text.begin(), text.end(), block), end; it != end; ++it) {
      blocks.push_back((*it)[1]);
    }
    EXPECT_FALSE(blocks.empty()) << document;
    return blocks;
  }
  static bool IsGithub(const std::string& block) { return block.find("\njobs:") != block.npos; }

  /// Runs of a workflow, each the steps as run_workflow.cjs has done them.
  json Run(const std::string& block, int runs) {
    const std::string file = folder_.Write("workflow.yml", block);
    const Said valid = RunNode("validate_json.cjs",
                               Quoted(IsGithub(block) ? kGithub : kGitlab) + " " + Quoted(file));
    EXPECT_EQ(valid.exit_code, 0) << valid.text << block;
    fs::remove_all(folder_ / "runs");
    const Said said =
        RunNode("run_workflow.cjs", Quoted(file) + " " + Quoted(folder_ / "source") + " " +
                                        Quoted(folder_ / "runs") + " " + std::to_string(runs));
    EXPECT_EQ(said.exit_code, 0) << said.text;
    return said.exit_code == 0 ? json::parse(said.text) : json::array();
  }

  /// gouge.nc fails, and so do the commands; what is behind them is done all the same.
  static void ExpectDone(const json& steps) {
    int failed = 0;
    for (const json& step : steps) {
      EXPECT_FALSE(step.contains("left_out")) << step;
      if (step.contains("run")) {
        EXPECT_EQ(step.at("exit_code"), 1) << step;
        ++failed;
      } else {
        EXPECT_EQ(step.at("exit_code"), 0) << step;
      }
    }
    EXPECT_GE(failed, 1);
  }

  nightly::TestFolder folder_{"workflows"};
};

TEST_F(WorkflowsOfTheDocs, NightlyKeepsItsHistoryAndHandsOverItsFiles) {
  int github = 0, gitlab = 0;
  for (const std::string& block : Blocks("docs/nightly.md")) {
    ++(IsGithub(block) ? github : gitlab);
    const json runs = Run(block, 2);
    ASSERT_EQ(runs.size(), 2U);
    std::vector<std::string> checked;
    for (const json& steps : runs) {
      ExpectDone(steps);
      for (const json& step : steps) {
        if (!step.contains("run")) continue;
        EXPECT_THAT(step.at("out").get<std::string>(), HasSubstr("soft jaw; 1 found"));
        EXPECT_THAT(step.at("out").get<std::string>(), HasSubstr("3 programs: 2 pass, 1 fail"));
        checked.push_back(step.at("err"));
      }
    }
    ASSERT_EQ(checked.size(), 2U);
    EXPECT_THAT(checked[0], HasSubstr("3 of 3 programs were checked"));
    EXPECT_THAT(checked[1], HasSubstr("0 of 3 programs were checked")) << "the cache";
  }
  EXPECT_EQ(github, 1);
  EXPECT_EQ(gitlab, 1);
}

TEST_F(WorkflowsOfTheDocs, ChecksAreShownAtTheirLines) {
  int github = 0, gitlab = 0;
  for (const std::string& block : Blocks("docs/services.md")) {
    ++(IsGithub(block) ? github : gitlab);
    const json runs = Run(block, 1);
    ASSERT_EQ(runs.size(), 1U);
    ExpectDone(runs[0]);
    if (!IsGithub(block)) continue;
    std::string log;
    for (const json& step : runs[0]) log += step.value("out", "");
    EXPECT_THAT(log, HasSubstr("::error file=parts/gouge.nc,line="));
    const Said valid = RunNode("validate_json.cjs",
                               "sarif-2.1.0.json " + Quoted(folder_ / "runs/checkout/ncsim.sarif"));
    EXPECT_EQ(valid.exit_code, 0) << valid.text;
  }
  EXPECT_EQ(github, 1);
  EXPECT_EQ(gitlab, 1);
}

// What the examples rely on: without "always" nothing behind a failure is done.
TEST_F(WorkflowsOfTheDocs, AStepThatIsLeftOutIsSeen) {
  std::string block = Blocks("docs/nightly.md").front();
  const std::size_t at = block.find("- if: always()");
  ASSERT_NE(at, block.npos);
  block.replace(at, block.find('\n', at) - at, "- name: save");
  int left_out = 0;
  for (const json& steps : Run(block, 1)) {
    for (const json& step : steps) left_out += step.value("left_out", false) ? 1 : 0;
  }
  EXPECT_EQ(left_out, 1);
}

}  // namespace
}  // namespace ncsim::report
