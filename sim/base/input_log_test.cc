// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/input_log.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sim/base/file.h"

namespace ncsim {
namespace {

namespace fs = std::filesystem;

class InputLogTest : public ::testing::Test {
 protected:
  InputLogTest() : folder_(::testing::TempDir() + "/ncsim_input_log_" + std::to_string(getpid())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    StartInputLog();
  }
  ~InputLogTest() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + "/" + name, std::ios::binary) << text;
  }
  /// Those that are not as they were when they were logged.
  static int Changed() {
    const std::vector<Input> inputs = LoggedInputs();
    return static_cast<int>(std::count_if(inputs.begin(), inputs.end(), [](const Input& input) {
      return StateNow(input.kind, input.name) != input.state;
    }));
  }

  std::string folder_, reason_;
};

TEST_F(InputLogTest, ContentsAreSteadyUntilAByteChanges) {
  Write("a", "one");
  ReadFile(folder_ + "/a", 100, &reason_);
  EXPECT_EQ(LoggedInputs().size(), 1U);
  EXPECT_EQ(Changed(), 0);
  Write("a", "onf");
  EXPECT_EQ(Changed(), 1);
  Write("a", "one");
  EXPECT_EQ(Changed(), 0);
  fs::remove(folder_ + "/a");
  EXPECT_EQ(Changed(), 1);
}

TEST_F(InputLogTest, WhatWasNotThereAndAppearsIsAChange) {
  ReadFile(folder_ + "/read", 100, &reason_);
  IsThere(folder_ + "/there");
  IsFile(folder_ + "/file");
  IsFolder(folder_ + "/folder");
  EXPECT_EQ(LoggedInputs().size(), 4U);
  EXPECT_EQ(Changed(), 0);
  for (const char* name : {"read", "there", "file", "folder"}) Write(name, "");
  EXPECT_EQ(Changed(), 4);
}

TEST_F(InputLogTest, ANameMoreInAFolderThatWasListedIsAChange) {
  Write("b", "");
  Write("a", "");
  EXPECT_EQ(NamesIn(folder_), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(NamesIn(folder_ + "/none"), std::vector<std::string>());
  EXPECT_EQ(Changed(), 0);
  fs::create_directories(folder_ + "/none");
  EXPECT_EQ(Changed(), 2);
}

TEST_F(InputLogTest, EnvironmentIsAnInput) {
  setenv("NCSIM_INPUT_LOG_TEST", "", 1);
  EXPECT_EQ(EnvironmentVariable("NCSIM_INPUT_LOG_TEST"), "");
  EXPECT_EQ(Changed(), 0);
  unsetenv("NCSIM_INPUT_LOG_TEST");
  EXPECT_EQ(Changed(), 1);
  EXPECT_EQ(EnvironmentVariable("NCSIM_INPUT_LOG_TEST"), std::nullopt);
}

TEST_F(InputLogTest, WhatWasSeenInTwoStatesIsNeverSteady) {
  Write("a", "one");
  ReadFile(folder_ + "/a", 100, &reason_);
  Write("a", "two");
  ReadFile(folder_ + "/a", 100, &reason_);
  ASSERT_EQ(LoggedInputs().size(), 1U);
  EXPECT_EQ(LoggedInputs().front().state, kUnsteady);
  EXPECT_EQ(Changed(), 1);
}

}  // namespace
}  // namespace ncsim
