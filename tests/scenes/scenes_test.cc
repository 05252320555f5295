// SPDX-License-Identifier: BSD-3-Clause
// The scenes as a user runs them: what passes passes without a word, and each program of the
// galleries is found out by the rule that it is named after (.nc: of a Haas, .mpf: of a SINUMERIK),
// at the line that its first comment states, in the words that docs/findings.md shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
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

Outcome RunNcsim(const std::vector<std::string>& args) {
  std::ostringstream out, err;
  Outcome outcome;
  outcome.code = app::Run(args, out, err);
  outcome.text = out.str() + err.str();
  return outcome;
}

Outcome Check(const fs::path& program) { return RunNcsim({"check", program.string()}); }

std::vector<std::string> ProgramsOf(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kRoot / "scenes" / folder)) {
    const fs::path extension = entry.path().extension();
    const std::string name = entry.path().filename().string();
    if ((extension == ".nc" || extension == ".mpf") && name != "reference.nc") {
      names.push_back(name);
    }
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

/// A night is run by the program itself, which starts itself; its folder goes with the test.
std::string RunNightly(const std::string& words) {
  const fs::path folder = fs::path(::testing::TempDir()) / "ncsim_readme_night";
  const std::string command =
      std::string(NCSIM_PROGRAM) + " " + words + " --out " + folder.string() + " 2>/dev/null";
  std::string text;
  FILE* out = popen(command.c_str(), "r");
  for (int c = 0; out != nullptr && (c = std::getc(out)) != EOF;) text += static_cast<char>(c);
  if (out != nullptr) pclose(out);
  fs::remove_all(folder);
  return text;
}

// Every line that the README shows after "$ ncsim ...", but for "...".
TEST(Scenes, TheReadmeShowsRealOutput) {
  std::ifstream readme(kRoot / "README.md");
  const std::string prompt = "$ ncsim ";
  fs::current_path(kRoot);
  std::string printed;
  int shown = 0;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with(prompt)) {
      const std::string command = line.substr(prompt.size());
      std::istringstream words(command);
      printed = "\n" + (command.starts_with("nightly")
                            ? RunNightly(command)
                            : RunNcsim({std::istream_iterator<std::string>(words), {}}).text);
    }
    if (line.starts_with("```")) printed.clear();
    if (printed.empty() || line.starts_with(prompt) || line == "  ...") continue;
    EXPECT_NE(printed.find("\n" + line + "\n"), std::string::npos) << line;
    ++shown;
  }
  EXPECT_GE(shown, 8);
}

TEST(Scenes, TheGalleriesHaveEveryRule) {
  std::vector<std::string> names = ProgramsOf("crash_gallery");
  const std::vector<std::string> compared = ProgramsOf("compare_gallery");
  names.insert(names.end(), compared.begin(), compared.end());
  for (const RuleInfo& rule : Rules()) {
    EXPECT_TRUE(std::count(names.begin(), names.end(), std::string(rule.id) + ".nc"))
        << "no program of the galleries shows " << rule.id;
  }
}

// Line 0 in EXPECT is a finding about the whole run.
void ExpectFound(const fs::path& program, const Outcome& outcome) {
  const std::string rule = program.stem().string();
  std::ifstream in(program);
  std::string first;
  std::getline(in, first);
  std::smatch expect;
  ASSERT_TRUE(
      std::regex_match(first, expect, std::regex(R"((?:\(|; )EXPECT (\d+): ([a-z-]+)\)?\r?)")))
      << first;
  ASSERT_EQ(expect[2], rule);
  const std::string where = "/" + program.filename().string() + "(" +
                            (expect[1] == "0" ? ": " : ":" + expect[1].str() + R"(:\d+: )");
  std::smatch said;
  ASSERT_TRUE(
      std::regex_search(outcome.text, said, std::regex(where + "[^\\n]*\\[" + rule + "\\])")))
      << outcome.text;
  const std::string example = "\n" + program.filename().string() + said[1].str() + "\n";
  EXPECT_NE(Findings().find(example), std::string::npos) << "docs/findings.md lacks" << example;
  const Severity severity = Info(*RuleFromId(rule)).severity;
  if (severity == Severity::kError) {
    EXPECT_EQ(outcome.code, app::kExitFail) << outcome.text;
  }
  if (severity == Severity::kUnproven) {
    EXPECT_EQ(outcome.code, app::kExitUnproven) << outcome.text;
  }
}

std::string TestName(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  for (char& c : name) c = c == '-' || c == '.' ? '_' : c;
  return name;
}

class CrashGallery : public ::testing::TestWithParam<std::string> {};

TEST_P(CrashGallery, IsFoundAtItsLine) {
  const fs::path program = kRoot / "scenes/crash_gallery" / GetParam();
  ExpectFound(program, Check(program));
}

INSTANTIATE_TEST_SUITE_P(EveryProgram, CrashGallery,
                         ::testing::ValuesIn(ProgramsOf("crash_gallery")), TestName);

class CompareGallery : public ::testing::TestWithParam<std::string> {};

TEST_P(CompareGallery, IsFoundAtItsLine) {
  const fs::path folder = kRoot / "scenes/compare_gallery";
  const fs::path program = folder / GetParam();
  const Outcome outcome =
      RunNcsim({"compare", (folder / "reference.nc").string(), program.string()});
  ExpectFound(program, outcome);
  EXPECT_NE(outcome.text.find(": 1 error, 0 unproven, 0 warnings; ") == std::string::npos,
            outcome.text.find(": 0 errors, 0 unproven, 1 warning; ") == std::string::npos)
      << outcome.text;
}

INSTANTIATE_TEST_SUITE_P(EveryProgram, CompareGallery,
                         ::testing::ValuesIn(ProgramsOf("compare_gallery")), TestName);

}  // namespace
