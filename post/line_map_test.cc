// SPDX-License-Identifier: BSD-3-Clause
#include "post/line_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncsim::post {
namespace {

using testing::ElementsAre;
using testing::Pair;

const std::string kDigest = "0123456789abcdef0123456789abcdef";

LineMapFile Example() {
  LineMapFile file{kDigest, std::string(kDigest.rbegin(), kDigest.rend()), "cam/my part.cls", {}};
  file.map.Add(1, 3);
  file.map.Add(4, 9);
  file.map.Add(5, 9);
  file.map.Add(8, 7);
  return file;
}

TEST(LineMapTest, ALineIsOfTheStepBeforeIt) {
  const LineMap map = Example().map;
  EXPECT_THAT(map.steps(), ElementsAre(Pair(1, 3), Pair(4, 9), Pair(8, 7)));
  EXPECT_EQ(map.At(0), 0);
  EXPECT_EQ(map.At(1), 3);
  EXPECT_EQ(map.At(3), 3);
  EXPECT_EQ(map.At(7), 9);
  EXPECT_EQ(map.At(1000), 7);
  EXPECT_EQ(LineMap().At(1), 0);
}

TEST(LineMapTest, IsReadAsItWasWritten) {
  const LineMapFile file = Example();
  const std::string text = WriteLineMap(file);
  EXPECT_EQ(text, "ncsim lines 1\nprogram " + kDigest + "\ncl " + file.cl +
                      " cam/my part.cls\n1 3\n4 9\n8 7\nend\n");
  const auto read = ReadLineMap(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->program, file.program);
  EXPECT_EQ(read->cl, file.cl);
  EXPECT_EQ(read->cl_name, file.cl_name);
  EXPECT_EQ(read->map, file.map);
}

TEST(LineMapTest, WhatIsNotWholeIsNotRead) {
  const std::string text = WriteLineMap(Example());
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_FALSE(ReadLineMap(text.substr(0, size))) << size;
  }
  for (const char* bad : {"4 9\n3 8\n", "4 9\n4 8\n", "0 9\n", "4 0\n", "4 -1\n", "4 9\n5 9\n",
                          "4 9 ", "4 9 \n", "4\n", "x\n", "99999999999 1\n", "end\n"}) {
    EXPECT_FALSE(ReadLineMap(text.substr(0, text.find("1 3")) + bad + "end\n")) << bad;
  }
}

}  // namespace
}  // namespace ncsim::post
