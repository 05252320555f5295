// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/file.h"

#include <gtest/gtest.h>

#include <fstream>

namespace ncsim {
namespace {

TEST(ReadFileTest, ReadsBytesAndSaysWhyNot) {
  const std::string path = ::testing::TempDir() + "/ncsim_file_test.bin";
  const std::string bytes("a\r\n\0b", 5);
  std::ofstream(path, std::ios::binary) << bytes;
  std::string reason;
  EXPECT_EQ(ReadFile(path, 5, &reason), bytes);
  EXPECT_EQ(reason, "");
  EXPECT_EQ(ReadFile(path, 4, &reason), std::nullopt);
  EXPECT_EQ(reason, "the file has 5 bytes; at most 4 are read");
  EXPECT_EQ(ReadFile(path + ".QQQ", 5, &reason), std::nullopt);
  EXPECT_EQ(reason, "no such file");
  EXPECT_EQ(ReadFile(::testing::TempDir(), 5, &reason), std::nullopt);
  EXPECT_EQ(reason, "not a file");
  std::remove(path.c_str());
}

}  // namespace
}  // namespace ncsim
