// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/scratch.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/nightly/test_folder.h"

namespace ncsim::nightly {
namespace {

namespace fs = std::filesystem;
using ::testing::MatchesRegex;

/// Another process that has a scratch folder with a file in it.
class OtherNight {
 public:
  explicit OtherNight(const std::string& folder) {
    std::array<int, 2> told{};
    if (pipe2(told.data(), O_CLOEXEC) != 0) return;
    pid_ = fork();
    if (pid_ == 0) Work(folder, told[1]);
    close(told[1]);
    std::array<char, 4096> path{};
    const ssize_t count = read(told[0], path.data(), path.size());
    close(told[0]);
    if (count > 0) path_.assign(path.data(), static_cast<std::size_t>(count));
  }
  ~OtherNight() { Kill(); }
  OtherNight(const OtherNight&) = delete;
  OtherNight& operator=(const OtherNight&) = delete;

  void Kill() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  const std::string& path() const { return path_; }

 private:
  [[noreturn]] static void Work(const std::string& folder, int tell) {
    std::string reason;
    const auto scratch = Scratch::Make(folder, &reason);
    if (scratch == nullptr) _exit(1);
    const int file = open((scratch->path() + "/0.json").c_str(), O_CREAT | O_WRONLY, 0600);
    const bool written =
        file >= 0 && write(tell, scratch->path().data(), scratch->path().size()) > 0;
    if (!written) _exit(1);
    while (true) pause();
  }

  pid_t pid_ = -1;
  std::string path_;
};

TEST(ScratchTest, GoesWithItsNight) {
  const TestFolder folder("scratch");
  std::string path, reason;
  {
    const auto scratch = Scratch::Make(folder.path(), &reason);
    ASSERT_TRUE(scratch) << reason;
    path = scratch->path();
    EXPECT_THAT(path, MatchesRegex(".*/ncsim-scratch-.+-[A-Za-z0-9]{6}"));
    EXPECT_TRUE(fs::is_empty(path));
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all);
    fs::create_directory(path + "/more");
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ScratchTest, TheNextNightRemovesWhatAKilledOneHasLeft) {
  const TestFolder folder("scratch");
  OtherNight dead(folder.path());
  const OtherNight living(folder.path());
  ASSERT_TRUE(fs::exists(dead.path() + "/0.json"));
  ASSERT_TRUE(fs::exists(living.path() + "/0.json"));
  std::string reason;
  const auto first = Scratch::Make(folder.path(), &reason);
  ASSERT_TRUE(first) << reason;
  EXPECT_TRUE(fs::exists(dead.path() + "/0.json")) << "it lives still";
  dead.Kill();
  EXPECT_TRUE(fs::exists(dead.path() + "/0.json")) << "nobody has cleared up yet";
  const auto second = Scratch::Make(folder.path(), &reason);
  ASSERT_TRUE(second) << reason;
  EXPECT_FALSE(fs::exists(dead.path()));
  EXPECT_TRUE(fs::exists(living.path() + "/0.json"));
  EXPECT_TRUE(fs::exists(first->path()));
  EXPECT_NE(first->path(), second->path());
}

// Another computer's, another user's, and what is no folder of a night at all.
TEST(ScratchTest, WhatIsNotOursStays) {
  const TestFolder folder("scratch"), outside("scratch_outside");
  outside.Write("kept", "");
  std::string name, reason;
  {
    const auto scratch = Scratch::Make(folder.path(), &reason);
    ASSERT_TRUE(scratch) << reason;
    name = fs::path(scratch->path()).filename();
  }
  const std::string random = "Abc123";
  const std::string prefix = name.substr(0, name.size() - random.size());
  const auto make = [&](const std::string& one) {
    fs::create_directory(folder / one);
    fs::permissions(folder / one, fs::perms::owner_all);
  };
  std::vector<std::string> kept = {"ncsim-nightly-" + random, "ncsim-scratch-other-host-" + random,
                                   prefix + "host-" + random, prefix + "mine"};
  for (const std::string& one : kept) make(one);
  fs::create_directory(folder / (prefix + "public"));
  kept.push_back(prefix + "public");
  folder.Write(prefix + "a_file", "");
  fs::create_directory_symlink(outside.path(), folder / (prefix + "a_link"));
  make(prefix + "theirs");
  // Only root can give a folder away.
  if (chown((folder / (prefix + "theirs")).c_str(), 12345, 12345) == 0) {
    kept.push_back(prefix + "theirs");
  }
  make(prefix + random);
  ASSERT_TRUE(Scratch::Make(folder.path(), &reason)) << reason;
  EXPECT_FALSE(fs::exists(folder / (prefix + random))) << "the test must be able to fail";
  for (const std::string& one : kept) EXPECT_TRUE(fs::exists(folder / one)) << one;
  EXPECT_TRUE(fs::exists(folder / (prefix + "a_file")));
  EXPECT_TRUE(fs::is_symlink(folder / (prefix + "a_link")));
  EXPECT_TRUE(fs::exists(outside / "kept"));
}

TEST(ScratchTest, WhereThereIsNoPlaceItSaysSo) {
  const TestFolder folder("scratch");
  std::string reason;
  EXPECT_FALSE(Scratch::Make(folder / "QQQ", &reason));
  EXPECT_EQ(reason, "No such file or directory");
}

}  // namespace
}  // namespace ncsim::nightly
