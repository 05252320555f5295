// SPDX-License-Identifier: BSD-3-Clause
// A night of the scenes, of programs that are broken on purpose, and with NCSIM_CORPUS of programs
// that nobody here wrote, each with three jobs: more than 200 rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sim/app/app.h"
#include "sim/base/finding.h"
#include "tests/nightly/night_rig.h"

namespace ncsim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// Tools of three lengths, at the offsets of the galleries.
constexpr const char* kJob = R"(schema = 1
units = "mm"
model = "MODEL"
[offsets]
G54 = OFFSET
)";
constexpr const char* kTool = R"([[tool]]
number = NUMBER
length = LENGTH
cutter = { type = "end", diameter = 10.0, flute_length = 30.0 }
shank = [ { lower = 10.0, upper = 10.0, height = 20.0 } ]
holder = "HOLDER"
)";
// They lie deep in the machine for most of their way, which takes seconds to tell in full.
const std::set<std::string> kSlow = {"PROGRAM2.NC", "TEST_G90.NC"};
constexpr std::array<const char*, 3> kLengths = {"150.0", "180.0", "220.0"};

std::string Fill(std::string text, const std::string& what, const std::string& with) {
  return std::regex_replace(text, std::regex(what), with);
}

std::string JobOf(bool sinumerik, const std::string& length) {
  std::string job = Fill(kJob, "MODEL", sinumerik ? "bc_table_840d.urdf" : "umc750.urdf");
  job = Fill(
      job, "OFFSET",
      sinumerik ? "{ X = 0.0, Y = 0.0, Z = -535.0 }" : "{ X = -381.0, Y = -254.0, Z = -346.5 }");
  for (int i = 1; i <= 24; ++i) {
    job += Fill(Fill(Fill(kTool, "NUMBER", std::to_string(i)), "LENGTH", length), "HOLDER",
                sinumerik ? "BT40-ER16-100" : "CAT40-ER32-100");
  }
  return job;
}

/// Which verdict it must have, and what else: "" for nothing.
struct Truth {
  std::string verdict, rule, trouble;
  int line = 0;
};

class LargeNightTest : public NightRig {
 protected:
  void SetUp() override {
    options_.what = (root_ / "parts/night.toml").string();
    options_.timeout = 600.0;
    fs::create_directories(root_ / "parts/scenes");
    AddScenes();
    AddBrokenOnes();
    AddCorpus();
    WriteText(root_ / "parts/night.toml", "schema = 1\n" + manifest_);
  }

  void List(const std::string& program, const std::string& more = "") {
    manifest_ += "[[program]]\nprogram = '" + program + "'\n" + more;
  }

  /// The first line of a program of the gallery is its truth; the others pass.
  void AddScenes() {
    const fs::path scenes = fs::path(NCSIM_SOURCE_DIR) / "scenes";
    for (const char* folder :
         {"crash_gallery", "five_axis", "impeller_840d", "posted", "three_plus_two"}) {
      fs::copy(scenes / folder, root_ / "parts/scenes" / folder, fs::copy_options::recursive);
      for (const auto& entry : fs::directory_iterator(scenes / folder)) {
        const std::string job = entry.path().string() + ".job.toml";
        if (!fs::exists(job)) continue;
        const std::string name = fs::path("scenes") / folder / entry.path().filename();
        std::smatch match;
        std::string text = ReadText(entry.path());
        text = text.substr(0, text.find_first_of("\r\n"));
        Truth truth{"pass", "", "", 0};
        if (std::regex_search(text, match, std::regex(R"(EXPECT (\d+): ([a-z-]+))"))) {
          truth.line = std::stoi(match[1]);
          truth.rule = match[2];
          const Severity severity = Info(RuleFromId(truth.rule).value()).severity;
          truth.verdict = severity == Severity::kError      ? "fail"
                          : severity == Severity::kUnproven ? "unproven"
                                                            : "pass";
        }
        truths_[name] = truth;
        List(name);
      }
    }
  }

  void AddBrokenOnes() {
    for (const char* name : {"crash.nc", "half.nc", "hang.nc", "job.nc", "mesh.nc"}) {
      AddBroken(name);
      List(std::string("broken/") + name, name == std::string("hang.nc") ? "timeout_s = 2\n" : "");
    }
    List("broken/gone.nc");
    WriteText(root_ / "parts/broken/job.nc.job.toml", "this is no job");
    fs::copy(root_ / "parts/scenes/crash_gallery/uncertified.nc", root_ / "parts/broken/mesh.nc",
             fs::copy_options::overwrite_existing);
    fs::copy(root_ / "parts/scenes/crash_gallery/uncertified.nc.job.toml",
             root_ / "parts/broken/mesh.nc.job.toml", fs::copy_options::overwrite_existing);
    truths_["broken/crash.nc"] = {"error", "", "crashed: signal 11", 0};
    truths_["broken/half.nc"] = {"error", "", "the report is not what a check writes", 0};
    truths_["broken/hang.nc"] = {"error", "", "took longer than 2 s and was stopped", 0};
    truths_["broken/job.nc"] = {"bad-input", "", "job.nc.job.toml:1", 0};
    truths_["broken/mesh.nc"] = {"bad-input", "", "open_box.stl", 0};
    truths_["broken/gone.nc"] = {"bad-input", "", "gone.nc", 0};
  }

  /// Programs of a Haas, a Fanuc or a SINUMERIK that are quickly checked.
  void AddCorpus() {
    const char* corpus = std::getenv("NCSIM_CORPUS");
    if (corpus == nullptr) {
      std::cout << "NCSIM_CORPUS is not set: a night of the scenes alone\n";
      return;
    }
    for (const char* folder :
         {"fanuc/easy-gcode-plot", "fanuc/nist-mtc", "haas", "seed004", "siemens"}) {
      for (const auto& entry : fs::recursive_directory_iterator(fs::path(corpus) / folder)) {
        std::string extension = entry.path().extension();
        for (char& c : extension)
          c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if ((extension != ".nc" && extension != ".mpf") || entry.file_size() > 60'000) continue;
        if (kSlow.count(entry.path().filename()) > 0) continue;
        const std::string name = "corpus/" + fs::relative(entry.path(), corpus).string();
        WriteText(root_ / "parts" / name, ReadText(entry.path()));
        for (const char* length : kLengths) {
          const std::string job = name + "." + length + ".job.toml";
          WriteText(root_ / "parts" / job, JobOf(extension == ".mpf", length));
          List(name, "name = '" + name + ", tools of " + length + "'\njob = '" + job + "'\n");
          corpus_.push_back({name, job});
        }
      }
    }
  }

  void ExpectTruth(const std::string& name, const json& row) const {
    const Truth& truth = truths_.at(name);
    EXPECT_EQ(row.at("verdict"), truth.verdict) << name;
    if (!truth.trouble.empty()) {
      EXPECT_THAT(row.at("trouble"), HasSubstr(truth.trouble)) << name;
    }
    const json& findings = row.at("findings");
    EXPECT_TRUE(truth.rule.empty() || std::any_of(findings.begin(), findings.end(),
                                                  [&](const json& finding) {
                                                    return finding.at("rule") == truth.rule &&
                                                           finding.at("line") == truth.line;
                                                  }))
        << name;
  }

  std::string manifest_;
  std::map<std::string, Truth> truths_;
  struct Job {
    std::string program, job;
  };
  std::vector<Job> corpus_;
};

// What a check of its own says, in this process.
std::string VerdictOf(const fs::path& program, const fs::path& job) {
  std::ostringstream out, err;
  const int code = app::Run({"check", program.string(), "--job", job.string()}, out, err);
  return std::array{"pass", "fail", "unproven", "bad-input", "error"}.at(
      static_cast<std::size_t>(code));
}

TEST_F(LargeNightTest, EveryRowIsRightAndShardsMergedAreTheSingleRun) {
  const NightOutcome first = Run("out");
  EXPECT_EQ(first.code, 4);
  const std::map<std::string, json> rows = Rows("out");
  EXPECT_EQ(rows.size(), truths_.size() + corpus_.size());
  EXPECT_EQ(first.checked, static_cast<int>(rows.size())) << "nobody stops the others";
  EXPECT_TRUE(corpus_.empty() || rows.size() > 200U);
  for (const auto& [name, truth] : truths_) ExpectTruth(name, rows.at(name));
  int again = 0;
  for (const auto& [name, row] : rows) {
    const std::string verdict = row.at("verdict");
    again += verdict == "bad-input" || verdict == "error" ? 1 : 0;
    EXPECT_THAT(first.out,
                HasSubstr("\n" + verdict + std::string(11 - verdict.size(), ' ') + name));
  }
  for (std::size_t i = 0; i < corpus_.size(); ++i) {
    const auto& [program, job] = corpus_[i];
    const std::string name = program + ", tools of " + kLengths.at(i % kLengths.size());
    const std::string verdict = rows.at(name).at("verdict");
    EXPECT_NE(verdict, "error") << name;
    if (i % 10 > 0) continue;
    EXPECT_EQ(verdict, VerdictOf(root_ / "parts" / program, root_ / "parts" / job)) << name;
  }

  const std::string junit = ReadText(root_ / "out/nightly.xml");
  const std::regex test_case("<testcase ");
  EXPECT_EQ(rows.size(), static_cast<std::size_t>(std::distance(
                             std::sregex_iterator(junit.begin(), junit.end(), test_case), {})));

  // Counted in checks, not in seconds: those that have no report.
  const std::string text = ReadText(root_ / "out/nightly.json");
  const NightOutcome second = Run("out");
  EXPECT_EQ(second.checked, again);
  EXPECT_TRUE(corpus_.empty() || 10 * second.checked < first.checked) << again;
  EXPECT_EQ(ReadText(root_ / "out/nightly.json"), text) << "the same night says the same";

  RunShards("merged", 4);
  EXPECT_EQ(Run("merged").code, 4);
  for (const char* file : {"nightly.json", "nightly.xml", "index.html"}) {
    const std::string single = ReadText(root_ / "out" / file);
    EXPECT_GT(single.size(), 1000U);
    EXPECT_EQ(ReadText(root_ / "merged" / file), single) << file;
    EXPECT_EQ(single.find(root_.string()), std::string::npos) << "no absolute path";
  }
}

}  // namespace
}  // namespace ncsim
