// SPDX-License-Identifier: BSD-3-Clause
// Nights of the crash gallery: what is checked again, what is new, what is merged.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/nightly/night_rig.h"
#include "tests/support/start_child.h"

namespace {

using namespace ncsim;
namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

class NightlyTest : public NightRig {
 protected:
  NightlyTest() {
    fs::create_directories(root_ / "parts");
    fs::copy(fs::path(NCSIM_SOURCE_DIR) / "scenes/crash_gallery", root_ / "parts/gallery",
             fs::copy_options::recursive);
    AddBroken("crash.nc");
    AddBroken("job.nc");
    WriteText(root_ / "parts/broken/job.nc.job.toml", "this is no job");
  }
};

// Counted in checks, not in seconds: the two that are broken are tried again.
TEST_F(NightlyTest, TheSecondRunTakesUnderATenthOfTheFirst) {
  const int first = Run("out").checked;
  const std::string table = ReadText(root_ / "out/nightly.json");
  const int second = Run("out").checked;
  EXPECT_EQ(second, 2);
  EXPECT_LT(10 * second, first);
  EXPECT_EQ(ReadText(root_ / "out/nightly.json"), table) << "the same night says the same";
  options_.all = true;
  EXPECT_EQ(Run("out").checked, first);
}

class SmallNightTest : public NightlyTest {
 protected:
  SmallNightTest() {
    fs::remove_all(root_ / "parts/broken");
    for (const auto& entry : fs::directory_iterator(root_ / "parts/gallery")) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with("near-miss.nc") && !name.starts_with("collision.nc") &&
          !name.starts_with("uncertified.nc") && name != "open_box.stl") {
        fs::remove(entry.path());
      }
    }
  }
  void Replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = ReadText(root_ / "parts/gallery" / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    WriteText(root_ / "parts/gallery" / file, text.replace(at, from.size(), to));
  }
};

TEST_F(SmallNightTest, WhatItWasCheckedWithIsLookedAt) {
  EXPECT_EQ(Run("out").checked, 3);
  EXPECT_EQ(Run("out").checked, 0);
  Replace("near-miss.nc", "F800.", "F801.");
  EXPECT_EQ(Run("out").checked, 1) << "the program";
  Replace("collision.nc.job.toml", "length = 150.0", "length = 150.5");
  EXPECT_EQ(Run("out").checked, 1) << "the job";
  std::string mesh = ReadText(root_ / "parts/gallery/open_box.stl");
  mesh[40] = mesh[40] == 'x' ? 'y' : 'x';
  WriteText(root_ / "parts/gallery/open_box.stl", mesh);
  EXPECT_EQ(Run("out").checked, 1) << "a mesh";
  WriteText(root_ / "parts/gallery/near-miss.job.toml", "schema = 1\n");
  EXPECT_EQ(Run("out").code, 3) << "a second job has appeared: which one is meant?";
  fs::remove(root_ / "parts/gallery/near-miss.job.toml");
  // A model of the same name where one is looked for first.
  fs::copy(fs::path(NCSIM_SOURCE_DIR) / "models/haas_umc750", root_ / "parts/gallery",
           fs::copy_options::recursive);
  EXPECT_EQ(Run("out").checked, 3) << "a model has appeared beside the jobs";
}

// What is found by searching upward may be another there.
TEST_F(SmallNightTest, AFolderThatWasMovedIsCheckedAgain) {
  EXPECT_EQ(Run("out").checked, 3);
  fs::rename(root_ / "parts", root_ / "moved");
  options_.what = (root_ / "moved").string();
  EXPECT_EQ(Run("out").checked, 3);
}

TEST_F(SmallNightTest, SaysWhatIsNewAndWhatCameCloser) {
  Run("out");
  options_.today = "2026-01-02";
  Replace("near-miss.nc", "Y14.", "Y16.");   // The holder now hits the jaw.
  Replace("collision.nc", "X75.", "X-75.");  // It stays where it is.
  const NightOutcome night = Run("out");
  EXPECT_EQ(night.checked, 2);
  const std::map<std::string, json> rows = Rows("out");
  EXPECT_EQ(rows.at("gallery/near-miss.nc").at("before"), "pass");
  EXPECT_EQ(rows.at("gallery/near-miss.nc").at("verdict"), "fail");
  EXPECT_EQ(rows.at("gallery/near-miss.nc").at("closer").empty(), false);
  EXPECT_EQ(rows.at("gallery/collision.nc").at("fixed").at(0).at("rule"), "collision");
  EXPECT_THAT(night.out, HasSubstr("compared with 2026-01-01"));
  EXPECT_THAT(night.out, HasSubstr("closer: T1.holder and jaw fell from "));
}

TEST_F(SmallNightTest, TheBaselineCountsInTheExitCode) {
  WriteText(
      root_ / "baseline.toml",
      "schema = 1\n[[accept]]\nprogram = \"gallery/collision.nc\"\nrule = \"collision\"\n"
      "line_text = \"N95 G01 X75.\"\nreason = \"the jaw is soft\"\nexpires = \"2026-01-31\"\n");
  EXPECT_EQ(Run("out").code, 1);
  options_.baseline = (root_ / "baseline.toml").string();
  const NightOutcome accepted = Run("out");
  EXPECT_EQ(Rows("out").at("gallery/collision.nc").at("verdict"), "pass");
  EXPECT_EQ(accepted.code, 2) << "the uncertified one";
  EXPECT_EQ(accepted.checked, 0);
  for (const char* file : {"nightly.json", "nightly.xml", "index.html"}) {
    EXPECT_THAT(ReadText(root_ / "out" / file), HasSubstr("the jaw is soft")) << file;
  }
  EXPECT_THAT(accepted.out, HasSubstr("the jaw is soft; 1 found"));
  options_.today = "2026-02-01";
  EXPECT_EQ(Run("out").code, 1);
}

TEST_F(SmallNightTest, EachProgramHasItsPage) {
  const auto pages = [&] {
    std::map<std::string, std::string> found;
    for (const auto& [name, row] : Rows("out")) {
      if (row.at("page").is_string()) found[name] = row.at("page");
    }
    return found;
  };
  EXPECT_EQ(Run("out").checked, 3);
  EXPECT_TRUE(pages().empty());
  options_.reports = true;
  EXPECT_EQ(Run("out").checked, 3) << "there is none yet";
  const auto first = pages();
  ASSERT_EQ(first.size(), 3U);
  const std::string index = ReadText(root_ / "out/index.html");
  for (const auto& [name, page] : first) {
    EXPECT_THAT(index, HasSubstr("<a href=\"" + page + "\">" + name + "</a>"));
    EXPECT_THAT(ReadText(root_ / "out" / page), HasSubstr("</html>")) << page;
  }
  EXPECT_EQ(Run("out").checked, 0);
  fs::remove(root_ / "out" / first.at("gallery/near-miss.nc"));
  EXPECT_EQ(Run("out").checked, 1);
  EXPECT_EQ(pages(), first);
  // A page is of what was checked: when it is not made anew, there is no link to the old one.
  Replace("near-miss.nc", "F800.", "F801.");
  options_.reports = false;
  EXPECT_EQ(Run("out").checked, 1);
  EXPECT_EQ(pages().count("gallery/near-miss.nc"), 0U);
  EXPECT_EQ(pages().size(), 2U);
  EXPECT_FALSE(fs::exists(root_ / "out" / first.at("gallery/near-miss.nc")));
  options_.reports = true;
  EXPECT_EQ(Run("out").checked, 1);
  EXPECT_NE(pages().at("gallery/near-miss.nc"), first.at("gallery/near-miss.nc"));
  // Of shards too.
  RunShards("merged", 2);
  options_.reports = false;
  Run("merged");
  EXPECT_EQ(ReadText(root_ / "merged/index.html"), ReadText(root_ / "out/index.html"));
}

TEST_F(SmallNightTest, AShardThatIsMissingIsAnErrorInItsRows) {
  RunShards("out", 3);
  fs::remove(root_ / "out/shards/1-of-3.json");
  const NightOutcome night = Run("out");
  EXPECT_EQ(night.code, 4);
  EXPECT_THAT(night.err, HasSubstr("error: shard 1/3 left nothing"));
  int missing = 0;
  for (const auto& [name, row] : Rows("out")) {
    if (row.at("verdict") != "error") continue;
    ++missing;
    EXPECT_EQ(row.at("trouble"), "shard 1/3 left nothing");
  }
  EXPECT_EQ(missing, 1);
}

TEST_F(SmallNightTest, WhatHasChangedSinceAShardIsNotMerged) {
  RunShards("out", 1);
  Replace("near-miss.nc.job.toml", "length = 150.0", "length = 140.0");
  EXPECT_EQ(Run("out").code, 4);
  EXPECT_EQ(Rows("out").at("gallery/near-miss.nc").at("trouble"),
            "what it was checked with has changed since");
  WriteText(root_ / "parts/gallery/new.nc.job.toml", "schema = 1\n");
  WriteText(root_ / "parts/gallery/new.nc", "M30\n");
  EXPECT_THAT(Run("out").err, HasSubstr("shard 0/1 is of another list of programs"));
}

TEST_F(SmallNightTest, NothingToMergeIsBadInput) {
  options_.merge = true;
  EXPECT_EQ(Run("out").code, 3);
  WriteText(root_ / "out/shards/0-of-2.json", "{}");
  EXPECT_EQ(Run("out").code, 4);
  WriteText(root_ / "out/shards/0-of-3.json", "{}");
  EXPECT_EQ(Run("out").code, 3);
}

/// The system's temporary folder for a while.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const fs::path& path) : before_(fs::temp_directory_path()) {
    fs::create_directory(path);
    setenv("TMPDIR", path.c_str(), 1);
  }
  ~TemporaryFolder() { setenv("TMPDIR", before_.c_str(), 1); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

 private:
  fs::path before_;
};

// The program as a batch system runs and kills it.
TEST_F(NightlyTest, AKilledShardLeavesNothingHalf) {
  const TemporaryFolder temporary(root_ / "tmp");
  const std::string out = (root_ / "out").string();
  const std::string log = (root_ / "log").string();
  const int err = open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  const pid_t pid =
      StartChild({NCSIM_PROGRAM, "nightly", options_.what, "--shard", "0/1", "--out", out},
                 {{STDERR_FILENO, err}});
  close(err);
  ASSERT_GT(pid, 0);
  while (ReadText(log).find("[5/") == std::string::npos && kill(pid, 0) == 0) usleep(2000);
  kill(pid, SIGKILL);
  int status = 0;
  waitpid(pid, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(fs::is_empty(root_ / "out/shards"));
  ASSERT_FALSE(fs::is_empty(root_ / "tmp"));
  options_.what = (root_ / "parts/broken").string();
  Run("out");
  EXPECT_TRUE(fs::is_empty(root_ / "tmp")) << "the next night clears up";
}

}  // namespace
