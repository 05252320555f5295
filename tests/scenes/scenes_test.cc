// SPDX-License-Identifier: BSD-3-Clause
// The scenes as a user runs them: what passes passes without a word, and each program of the crash
// gallery is found out by the rule that it is named after (.nc: of a Haas, .mpf: of a SINUMERIK),
// at the line that its first comment states, in the words that docs/findings.md shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "sim/app/app.h"
#include "sim/base/finding.h"

namespace {

using namespace ncsim;
namespace fs = std::filesystem;

const fs::path kRoot(NCSIM_SOURCE_DIR);

struct Outcome {
  int code = 0;
  std::string text;
};

Outcome Check(const fs::path& program) {
  std::ostringstream out, err;
  Outcome outcome;
  outcome.code = app::Run({"check", program.string()}, out, err);
  outcome.text = out.str() + err.str();
  return outcome;
}

std::vector<std::string> Gallery() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kRoot / "scenes/crash_gallery")) {
    const fs::path extension = entry.path().extension();
    if (extension == ".nc" || extension == ".mpf")
      names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string Findings() {
  std::stringstream text;
  text << std::ifstream(kRoot / "docs/findings.md").rdbuf();
  return text.str();
}

TEST(Scenes, ThreePlusTwoPasses) {
  const Outcome outcome = Check(kRoot / "scenes/three_plus_two/angle_block.nc");
  EXPECT_EQ(outcome.code, app::kExitPass) << outcome.text;
}

TEST(Scenes, FiveAxisPasses) {
  const Outcome outcome = Check(kRoot / "scenes/five_axis/dome.nc");
  EXPECT_EQ(outcome.code, app::kExitPass) << outcome.text;
}

// Every line that the README shows after "$ ncsim check PROGRAM", but for "...".
TEST(Scenes, TheReadmeShowsRealOutput) {
  std::ifstream readme(kRoot / "README.md");
  const std::string prompt = "$ ncsim check ";
  fs::current_path(kRoot);
  std::string printed;
  int shown = 0;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with(prompt)) printed = "\n" + Check(line.substr(prompt.size())).text;
    if (line.starts_with("```")) printed.clear();
    if (printed.empty() || line.starts_with(prompt) || line == "  ...") continue;
    EXPECT_NE(printed.find("\n" + line + "\n"), std::string::npos) << line;
    ++shown;
  }
  EXPECT_GE(shown, 8);
}

TEST(Scenes, TheGalleryHasEveryRule) {
  const std::vector<std::string> names = Gallery();
  for (const RuleInfo& rule : Rules()) {
    EXPECT_TRUE(std::count(names.begin(), names.end(), std::string(rule.id) + ".nc"))
        << "no program in scenes/crash_gallery shows " << rule.id;
  }
}

class CrashGallery : public ::testing::TestWithParam<std::string> {};

// Line 0 in EXPECT is a finding about the whole run.
TEST_P(CrashGallery, IsFoundAtItsLine) {
  const fs::path program = kRoot / "scenes/crash_gallery" / GetParam();
  const std::string rule = program.stem().string();
  std::ifstream in(program);
  std::string first;
  std::getline(in, first);
  std::smatch expect;
  ASSERT_TRUE(
      std::regex_match(first, expect, std::regex(R"((?:\(|; )EXPECT (\d+): ([a-z-]+)\)?\r?)")))
      << first;
  ASSERT_EQ(expect[2], rule);
  const Outcome outcome = Check(program);
  const std::string where =
      "/" + GetParam() + "(" + (expect[1] == "0" ? ": " : ":" + expect[1].str() + R"(:\d+: )");
  std::smatch said;
  ASSERT_TRUE(
      std::regex_search(outcome.text, said, std::regex(where + "[^\\n]*\\[" + rule + "\\])")))
      << outcome.text;
  const std::string example = "\n" + GetParam() + said[1].str() + "\n";
  EXPECT_NE(Findings().find(example), std::string::npos) << "docs/findings.md lacks" << example;
  const Severity severity = Info(*RuleFromId(rule)).severity;
  if (severity == Severity::kError) {
    EXPECT_EQ(outcome.code, app::kExitFail) << outcome.text;
  }
  if (severity == Severity::kUnproven) {
    EXPECT_EQ(outcome.code, app::kExitUnproven) << outcome.text;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryProgram, CrashGallery, ::testing::ValuesIn(Gallery()),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name) c = c == '-' || c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
