// SPDX-License-Identifier: BSD-3-Clause
// What `ncsim post --map` leaves, and what check makes of it. Where findings come from is held
// against what `ncsim compare` says, which aligns the two motions and knows no map.
#include "sim/app/line_origins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "sim/app/app.h"
#include "sim/base/file.h"
#include "sim/nightly/test_folder.h"
#include "sim/report/json_values.h"

namespace ncsim::app {
namespace {

namespace fs = std::filesystem;
using report::Json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The second GOTO of the feed, its line 10, leaves the machine: 500 mm in X.
constexpr const char* kFar =
    "TOOL PATH/FAR,TOOL,EM10\nTLDATA/MILL,10.0,0.0,75.0,0.0,0.0\n"
    "MSYS/0,0,0,1,0,0,0,1,0\nLOAD/TOOL,1\nSPINDL/RPM,3000,CLW\nRAPID\n"
    "GOTO/0,0,50,0,0,1\nFEDRAT/MMPM,300\nGOTO/0,0,0\nGOTO/-500,0,0\nGOTO/0,0,0\nRAPID\n"
    "GOTO/0,0,50\nEND-OF-PATH\n";
constexpr int kFarLine = 10;

constexpr const char* kJob =
    "schema = 1\nunits = \"mm\"\nmodel = \"MODEL\"\n[offsets]\n"
    "G54 = { on = \"workpiece_mount\", xyz = [0.0, 0.0, 150.0] }\n[[tool]]\nnumber = 1\n"
    "length = 165.0\ncutter = { type = \"end\", diameter = 10.0, flute_length = 30.0 }\n"
    "shank = [ { lower = 10.0, upper = 10.0, height = 35.0 } ]\nholder = \"CAT40-ER32-100\"\n";

class LineOriginsTest : public ::testing::Test {
 protected:
  LineOriginsTest() {
    folder_.Write("cam/far.cls", kFar);
    WriteJob("far.nc", "umc750.urdf");
  }
  void WriteJob(const std::string& program, const std::string& model) {
    folder_.Write(program + ".job.toml",
                  std::regex_replace(std::string(kJob), std::regex("MODEL"), model));
  }
  std::string Read(const std::string& name) const {
    std::string reason;
    return ReadFile(folder_ / name, 1 << 24, &reason).value_or(reason);
  }
  int Run(std::vector<std::string> args) {
    out_.str("");
    err_.str("");
    return app::Run(std::move(args), out_, err_);
  }
  int Post(std::vector<std::string> options = {"--map"}) {
    options.insert(options.begin(), {"post", folder_ / "cam/far.cls", "-o", folder_ / "far.nc"});
    return Run(std::move(options));
  }
  /// `ncsim check far.nc --format FORMAT`
  std::string Check(const std::string& format, const std::string& program = "far.nc") {
    Run({"check", folder_ / program, "--format", format});
    return out_.str();
  }
  /// Where the overtravels come from that say so.
  std::vector<std::pair<std::string, int>> Origins(const std::string& program = "far.nc") {
    std::vector<std::pair<std::string, int>> origins;
    const Json report = Json::parse(Check("json", program));
    for (const Json& finding : report.at("findings")) {
      if (finding.at("rule") != "travel-limit" || !finding.contains("posted_from")) continue;
      const Json& from = finding.at("posted_from");
      origins.emplace_back(from.at("file"), from.at("line"));
    }
    return origins;
  }

  /// As check tells it.
  std::string Told(const std::string& name) const {
    return fs::path(folder_ / name).lexically_normal().string();
  }

  nightly::TestFolder folder_{"line_origins"};
  std::ostringstream out_, err_;
};

TEST_F(LineOriginsTest, PostTellsTheRecordsOfItsFindings) {
  EXPECT_EQ(Post({}), kExitFail);
  EXPECT_THAT(out_.str(), AllOf(HasSubstr("axis X reaches"),
                                HasSubstr("  from " + (folder_ / "cam/far.cls") + ":" +
                                          std::to_string(kFarLine) + ": GOTO/-500,0,0\n")));
  EXPECT_FALSE(fs::exists(LineMapPath(folder_ / "far.nc")));
  EXPECT_EQ(Origins().size(), 0U) << "nothing is known without a map";
  EXPECT_EQ(err_.str(), "");
}

TEST_F(LineOriginsTest, CheckKnowsThemFromTheMap) {
  Post();
  const std::string cl = Told("cam/far.cls"), place = cl + ":" + std::to_string(kFarLine);
  EXPECT_EQ(Origins(), (std::vector<std::pair<std::string, int>>{{cl, kFarLine}}));
  EXPECT_THAT(Check("text"), HasSubstr("  from " + place + ": GOTO/-500,0,0\n"));
  EXPECT_THAT(Check("junit"), HasSubstr(" (from " + place + ")"));
  EXPECT_THAT(Check("github"), HasSubstr(" (from " + place + ")\n"));
  const Json run = Json::parse(Check("sarif")).at("runs").at(0);
  int related = 0;
  for (const Json& result : run.at("results")) {
    if (result.at("ruleId") != "travel-limit") continue;
    const Json& from = result.at("relatedLocations").at(0);
    EXPECT_EQ(from.at("physicalLocation").at("region"), Json({{"startLine", kFarLine}}));
    EXPECT_THAT(from.at("physicalLocation").at("artifactLocation").at("uri").get<std::string>(),
                HasSubstr("/cam/far.cls"));
    ++related;
  }
  EXPECT_EQ(related, 1);
  EXPECT_EQ(err_.str(), "");
}

TEST_F(LineOriginsTest, AMapThatDoesNotFitIsNotUsed) {
  Post();
  const std::string program = Read("far.nc"), map = Read("far.nc.lines");
  folder_.Write("far.nc", "\n" + program);  // Everything stands a line lower.
  EXPECT_EQ(Origins().size(), 0U);
  EXPECT_THAT(err_.str(), HasSubstr("far.nc.lines: note: not used: "));
  EXPECT_THAT(err_.str(), HasSubstr("far.nc is not what was posted"));
  folder_.Write("far.nc", program);
  EXPECT_EQ(Origins().size(), 1U);
  for (const std::string& bad : {map.substr(0, map.size() / 2), std::string(), map + "\n"}) {
    folder_.Write("far.nc.lines", bad);
    EXPECT_EQ(Origins().size(), 0U);
    EXPECT_THAT(err_.str(), HasSubstr("not used: it is not as ncsim post writes it"));
  }
}

TEST_F(LineOriginsTest, ACutterLocationFileThatHasChangedIsNotPointedAt) {
  Post();
  folder_.Write("cam/far.cls", std::string("$$ new\n") + kFar);
  EXPECT_EQ(Origins().size(), 0U);
  EXPECT_THAT(err_.str(), HasSubstr("cam/far.cls has changed since "));
  // Where it is not there, as on the machine that checks at night, it is still what was posted.
  fs::remove(folder_ / "cam/far.cls");
  EXPECT_EQ(Origins().size(), 1U);
  EXPECT_THAT(Check("text"), HasSubstr("cam/far.cls:" + std::to_string(kFarLine) + "\n"));
  EXPECT_EQ(err_.str(), "");
}

// Names in it are seen from the program's folder, so a folder may be moved, and no path of a
// machine is in it.
TEST_F(LineOriginsTest, MapsMoveWithTheirFolder) {
  Post();
  EXPECT_THAT(Read("far.nc.lines"), HasSubstr(" cam/far.cls\n"));
  EXPECT_THAT(Read("far.nc.lines"), Not(HasSubstr(folder_.path())));
  for (const char* name : {"far.nc", "far.nc.lines", "far.nc.job.toml", "cam/far.cls"}) {
    folder_.Write(std::string("moved/") + name, Read(name));
  }
  EXPECT_EQ(Origins("moved/far.nc"),
            (std::vector<std::pair<std::string, int>>{{Told("moved/cam/far.cls"), kFarLine}}));
}

// Each file of an operation has its own map, and what post itself says of them agrees.
TEST_F(LineOriginsTest, FilesOfOperationsHaveTheirOwn) {
  std::string near = kFar;
  near.replace(near.find("GOTO/-500"), 9, "GOTO/-5");
  folder_.Write("cam/two.cls", near + kFar);
  WriteJob("two.mpf", "bc_table_840d.urdf");
  const int line = 14 + kFarLine;
  Run({"post", folder_ / "cam/two.cls", "-o", folder_ / "two.mpf", "--split", "--map"});
  const std::string place = folder_ / "cam/two.cls" + (":" + std::to_string(line));
  EXPECT_THAT(out_.str(), HasSubstr("  from " + place + ": GOTO/-500,0,0\n")) << err_.str();
  EXPECT_EQ(Origins("two.mpf"),
            (std::vector<std::pair<std::string, int>>{{Told("cam/two.cls"), line}}))
      << err_.str();
  EXPECT_THAT(Read("two_2.mpf.lines"), HasSubstr(" cam/two.cls\n"));
}

TEST_F(LineOriginsTest, AMapNeedsAFileBesideWhichItGoes) {
  EXPECT_EQ(Run({"post", folder_ / "cam/far.cls", "--map"}), kExitBadInput);
  EXPECT_THAT(err_.str(), HasSubstr("--map needs --out"));
}

// One line of the finish of a cone is moved at a time: compare finds the record by the motion.
TEST_F(LineOriginsTest, AgreeWithWhatTheMotionSays) {
  const std::string scene = std::string(NCSIM_SOURCE_DIR) + "/scenes/posted/";
  const std::string nc = folder_ / "hub.nc", job = scene + "hub.nc.job.toml";
  ASSERT_EQ(Run({"post", scene + "hub.cls", "--job", job, "-o", nc, "--map", "--no-check"}),
            kExitPass);
  const auto file = post::ReadLineMap(Read("hub.nc.lines"));
  ASSERT_TRUE(file);
  const std::string text = Read("hub.nc");
  for (const int line : {300, 301, 302, 303, 1000, 1777, 2500}) {
    std::istringstream in(text);
    std::string moved, word;
    for (int i = 1; std::getline(in, word); ++i) {
      if (i == line) {
        std::smatch z;
        ASSERT_TRUE(std::regex_search(word, z, std::regex("Z(-?[0-9.]+)"))) << word;
        word = z.prefix().str() + "Z" + std::to_string(std::stod(z[1]) + 1.0) + z.suffix().str();
      }
      moved += word + "\n";
    }
    const std::string edited = folder_.Write("edited.nc", moved);
    Run({"compare", scene + "hub.cls", edited, "--job", job, "--format", "json"});
    const Json findings = Json::parse(out_.str()).at("findings");
    ASSERT_FALSE(findings.empty()) << line;
    EXPECT_EQ(findings[0].at("line"), line);
    EXPECT_EQ(file->map.At(line), findings[0].at("other").at("line")) << line;
  }
}

}  // namespace
}  // namespace ncsim::app
