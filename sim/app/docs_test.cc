// SPDX-License-Identifier: BSD-3-Clause
// The documents against what they speak of.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "sim/app/explain.h"
#include "sim/base/finding.h"

namespace ncsim::app {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = NCSIM_SOURCE_DIR;

std::string Read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Each example of docs/findings.md is of a program of one of the galleries, whose first line says
// which rule is to be found where (tests/scenes runs them).
TEST(DocsTest, ExamplesOfFindingsAreOfTheGalleries) {
  const std::regex example(R"(\n```\n([a-z-]+\.(?:nc|mpf)):(?:(\d+):\d+:)? .*\[([a-z-]+)\]\n```)");
  const std::string text(FindingsText());
  int examples = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), example), end; it != end; ++it) {
    std::string program = Read(kSource / "scenes/crash_gallery" / (*it)[1].str());
    if (program.empty()) program = Read(kSource / "scenes/compare_gallery" / (*it)[1].str());
    const std::string line = (*it)[2].matched ? (*it)[2].str() : "0";
    const std::string expect = "EXPECT " + line + ": " + (*it)[3].str();
    const bool haas = (*it)[1].str().ends_with(".nc");
    EXPECT_EQ(program.substr(0, program.find_first_of("\r\n")),
              haas ? "(" + expect + ")" : "; " + expect)
        << it->str();
    if (haas) ++examples;
  }
  EXPECT_EQ(examples, static_cast<int>(Rules().size()));
}

TEST(DocsTest, VerificationNamesTestsThatExist) {
  const std::regex definition(R"(TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\))");
  std::set<std::string> tests;
  for (const char* folder : {"sim", "kinematics", "post", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
      if (!entry.path().string().ends_with("_test.cc")) continue;
      const std::string text = Read(entry.path());
      for (std::sregex_iterator it(text.begin(), text.end(), definition), end; it != end; ++it) {
        tests.insert((*it)[1].str() + "." + (*it)[2].str());
      }
    }
  }
  ASSERT_GT(tests.size(), 100U);
  const std::regex name(R"(`(?:\w+/)?([A-Z]\w+\.[A-Z]\w+)`)");
  const std::string text = Read(kSource / "docs/verification.md");
  int named = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it, ++named) {
    EXPECT_EQ(tests.count((*it)[1].str()), 1U) << (*it)[1].str();
  }
  EXPECT_GT(named, 30);
}

}  // namespace
}  // namespace ncsim::app
