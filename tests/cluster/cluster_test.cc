// SPDX-License-Identifier: BSD-3-Clause
// The scripts of docs/cluster as a team uses them, on a Slurm of two nodes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/nightly/child.h"
#include "tests/cluster/private_cluster.h"

namespace {

using namespace ncsim;
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path kScripts = fs::path(NCSIM_SOURCE_DIR) / "docs/cluster";

constexpr const char* kBaseline = R"(schema = 1
[[accept]]
program = "gallery/collision.nc"
rule = "collision"
line_text = "N95 G01 X75."
reason = "the jaw is soft"
expires = "2026-01-31"
)";

std::string Read(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::map<std::string, nlohmann::json> RowsOf(const fs::path& night) {
  std::map<std::string, nlohmann::json> rows;
  const nlohmann::json document = nlohmann::json::parse(Read(night / "nightly.json"));
  for (const nlohmann::json& row : document.at("programs")) rows[row.at("name")] = row;
  return rows;
}

class ClusterTest : public ::testing::Test {
 protected:
  ClusterTest()
      : root_(fs::path(::testing::TempDir()) / ("ncsim_cluster_" + std::to_string(getpid()))) {}
  ~ClusterTest() override {
    cluster_.reset();
    for (const char* folder : {"slurm", "night/logs"}) {
      if (!HasFailure() || !fs::exists(root_ / folder)) continue;
      for (const auto& entry : fs::directory_iterator(root_ / folder)) {
        if (!std::regex_search(entry.path().string(), std::regex("\\.(err|log)$"))) continue;
        std::cerr << "== " << entry.path() << "\n" << Read(entry.path());
      }
    }
    fs::remove_all(root_);
  }

  void SetUp() override {
    const std::string missing = cluster::PrivateCluster::Missing();
    if (!missing.empty()) GTEST_SKIP() << missing;
    fs::create_directories(root_ / "parts");
    setenv("NCSIM", NCSIM_PROGRAM, 1);
  }

  /// Parts are the gallery, `domes` that take a while, and one that is not there.
  void StartCluster(int max_array_size, int domes) {
    const fs::path scenes = fs::path(NCSIM_SOURCE_DIR) / "scenes";
    fs::copy(scenes / "crash_gallery", root_ / "parts/gallery");
    fs::copy(scenes / "five_axis", root_ / "parts/dome");
    std::ofstream manifest(root_ / "parts/night.toml");
    manifest << "schema = 1\n[[program]]\nprogram = \"not-there.nc\"\n";
    for (const auto& entry : fs::directory_iterator(root_ / "parts/gallery")) {
      const std::string extension = entry.path().extension();
      if (extension != ".nc" && extension != ".mpf") continue;
      manifest << "[[program]]\nprogram = \"gallery/" << entry.path().filename().string() << "\"\n";
    }
    for (int i = 0; i < domes; ++i) {
      manifest << "[[program]]\nname = \"dome " << i << "\"\nprogram = \"dome/dome.nc\"\n"
               << "clearance = 0." << 10 + i << "\n";
    }
    manifest.close();
    std::ofstream(root_ / "baseline.toml") << kBaseline;
    cluster_ = std::make_unique<cluster::PrivateCluster>(root_ / "slurm", max_array_size);
  }

  /// Runs it to its end in the folder that a team would have; returns the exit code.
  int Run(const std::vector<std::string>& command) const {
    return nightly::RunChild(command, root_.string(), (root_ / "out").string(),
                             (root_ / "err").string(), 300.0)
        .exit_code;
  }
  /// What one machine says, with an option or two more, is what the cluster says.
  void ExpectAsOneMachine(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> single = {
        NCSIM_PROGRAM, "nightly",    "parts/night.toml", "--out",  "single", "--today",
        "2026-01-01",  "--baseline", "baseline.toml",    "--jobs", "2"};
    single.insert(single.end(), more.begin(), more.end());
    Run(single);
    for (const char* file : {"nightly.json", "nightly.xml", "index.html"}) {
      const std::string text = Read(root_ / "single" / file);
      EXPECT_GT(text.size(), 1000U) << Read(root_ / "err");
      EXPECT_EQ(Read(root_ / out / file), text) << file;
    }
  }
  std::string Queue(const std::vector<std::string>& options) const {
    std::vector<std::string> command = {"squeue", "--noheader"};
    command.insert(command.end(), options.begin(), options.end());
    // A machine that has much to do may keep it waiting for longer than it likes.
    for (int i = 0; i < 5; ++i) {
      try {
        return cluster_->Ask(command);
      } catch (const std::runtime_error&) {
      }
    }
    return cluster_->Ask(command);
  }

  fs::path root_;
  std::unique_ptr<cluster::PrivateCluster> cluster_;
};

TEST_F(ClusterTest, ANodeThatDiesChangesNothing) {
  StartCluster(1001, 12);
  ASSERT_EQ(Run({kScripts / "submit", "4", "parts/night.toml", "--out", "night", "--today",
                 "2026-01-01", "--baseline", "baseline.toml", "--all", "--reports"}),
            0)
      << Read(root_ / "err");
  std::string shard;
  ASSERT_TRUE(cluster::Wait(120.0, [&] {
    shard = Queue({"--states=RUNNING", "--nodelist=n1", "--name=ncsim-shard", "--format=%K"});
    shard = shard.substr(0, shard.find('\n'));
    return Read(root_ / ("night/logs/shard-" + shard + ".log")).find("[1/") != std::string::npos;
  }));
  cluster_->KillNode("n1");
  EXPECT_FALSE(fs::exists(root_ / ("night/shards/" + shard + "-of-4.json"))) << "killed too late";
  EXPECT_TRUE(cluster::Wait(240.0, [&] { return Queue({}).empty(); })) << Queue({});
  const std::string log = Read(root_ / ("night/logs/shard-" + shard + ".log"));
  EXPECT_THAT(log, HasSubstr("shard " + shard + "/4 on n1, time 1\n"));
  EXPECT_THAT(log, HasSubstr("shard " + shard + "/4 on n2, time 2\n"));
  EXPECT_THAT(Read(root_ / "night/logs/merge.log"), HasSubstr("the jaw is soft; 1 found"));
  ExpectAsOneMachine("night", {"--reports"});
  std::size_t pages = 0;
  for (const auto& entry : fs::directory_iterator(root_ / "single/reports")) {
    const fs::path page = root_ / "night/reports" / entry.path().filename();
    EXPECT_TRUE(Read(page) == Read(entry.path())) << page;
    ++pages;
  }
  EXPECT_EQ(pages, RowsOf(root_ / "night").size() - 1) << "all but the one that is not there";
}

TEST_F(ClusterTest, AShardThatNeverComesIsSaidInItsRows) {
  StartCluster(3, 4);
  cluster_->Ask({"scontrol", "update", "nodename=n1,n2", "state=drain", "reason=test"});
  pid_t submit = 0;
  ASSERT_EQ(nightly::StartChild({kScripts / "submit", "--wait", "9", "parts/night.toml",
                                 "--out=night", "--today=2026-01-01", "--baseline=baseline.toml"},
                                root_.string(), (root_ / "table").string(),
                                (root_ / "words").string(), &submit),
            0);
  std::string tasks;
  ASSERT_TRUE(cluster::Wait(60.0, [&] {
    tasks = Queue({"--array", "--format=%i"});
    return std::count(tasks.begin(), tasks.end(), '\n') == 4;  // Three shards and the merge.
  })) << Read(root_ / "words");
  EXPECT_THAT(Read(root_ / "words"), HasSubstr("3 shards, not 9: MaxArraySize of this cluster"));
  std::size_t lost = tasks.find("_1\n");
  ASSERT_NE(lost, std::string::npos);
  lost = tasks.rfind('\n', lost) + 1;  // Of npos: 0.
  cluster_->Ask({"scancel", tasks.substr(lost, tasks.find('\n', lost) - lost)});
  cluster_->Ask({"scontrol", "update", "nodename=n1,n2", "state=resume"});
  int status = 0;
  waitpid(submit, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 4) << Read(root_ / "words");
  EXPECT_THAT(Read(root_ / "table"), HasSubstr("error: shard 1/3 left nothing"));
  const auto rows = RowsOf(root_ / "night");
  std::size_t missing = 0;
  for (const auto& [name, row] : rows) missing += row.at("trouble") == "shard 1/3 left nothing";
  EXPECT_GT(missing, rows.size() / 4);
  EXPECT_LT(missing, rows.size() / 2);

  // What the scripts say of a shard that was lost.
  ASSERT_EQ(
      Run({"/usr/bin/sbatch", "--array=1", "--output=night/logs/shard-%a.log", kScripts / "shard",
           "3", NCSIM_PROGRAM, "nightly", "parts/night.toml", "--out", "night"}),
      0);
  EXPECT_TRUE(cluster::Wait(120.0, [&] { return Queue({}).empty(); })) << Queue({});
  EXPECT_EQ(Run({NCSIM_PROGRAM, "nightly", "parts/night.toml", "--out", "night", "--merge",
                 "--baseline", "baseline.toml", "--today", "2026-01-01"}),
            3)
      << "the program that is not there";
  ExpectAsOneMachine("night");
}

TEST_F(ClusterTest, WhatMakesNoSenseIsRefused) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"4"},
                                                {"0", "parts"},
                                                {"many", "parts"},
                                                {"4", "parts", "--out"},
                                                {"4", "parts", "--shard", "0/4"},
                                                {"4", "parts", "--merge"}}) {
    std::vector<std::string> command = {kScripts / "submit"};
    command.insert(command.end(), words.begin(), words.end());
    EXPECT_EQ(Run(command), 3) << words.size();
    EXPECT_THAT(Read(root_ / "err"), HasSubstr("submit: error: "));
  }
  setenv("NCSIM", "/QQQ/ncsim", 1);
  EXPECT_EQ(Run({kScripts / "submit", "4", "parts"}), 3);
  EXPECT_THAT(Read(root_ / "err"), HasSubstr("no program /QQQ/ncsim"));
}

}  // namespace
