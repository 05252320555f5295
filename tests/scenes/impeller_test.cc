// SPDX-License-Identifier: BSD-3-Clause
// scenes/impeller_840d held against a closed form: how near T3's holder comes to the ring.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/app/app.h"
#include "sim/base/units.h"

namespace {

using namespace ncsim;
using nlohmann::json;
namespace fs = std::filesystem;

const fs::path kScene = fs::path(NCSIM_SOURCE_DIR) / "scenes/impeller_840d";
constexpr double kHolder = 100.0;  // gauge line to the lower face of BT40-ER16-100
constexpr double kLength = 182.0;  // of T3

// N5030 ends with the tip at X35.37822 Z-29 and the tool at B60: the ring's upper outer edge, r 96
// at Z-10, is under the lower face of the holder (13.9 mm off its axis, and the face is 16 in
// radius), and no other point of the ring is as high along the tool.
double ClearanceOfTheHolder(double length) {
  const double high =
      (96.0 - 35.37822) * std::sin(Radians(60.0)) + (-10.0 + 29.0) * std::cos(Radians(60.0));
  return length - kHolder - high;
}

std::string TextOf(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

int LineOf(const std::string& text, const std::string& block) {
  const std::size_t at = text.find("\n" + block);
  if (at == std::string::npos) throw std::runtime_error("there is no " + block);
  return 2 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

json CheckAsJson(const fs::path& program, int expected_exit) {
  std::ostringstream out, err;
  const int code = app::Run({"check", program.string(), "--format", "json"}, out, err);
  EXPECT_EQ(code, expected_exit) << err.str() << out.str().substr(0, 4000);
  return json::parse(out.str(), nullptr, false);
}

/// The scene in a folder of its own, where something is changed.
class SceneCopy {
 public:
  explicit SceneCopy(const std::string& name)
      : folder_(fs::temp_directory_path() /
                ("ncsim_impeller_scene_" + name + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::copy(kScene, folder_);
  }
  ~SceneCopy() { fs::remove_all(folder_); }
  SceneCopy(const SceneCopy&) = delete;
  SceneCopy& operator=(const SceneCopy&) = delete;

  const fs::path& folder() const { return folder_; }
  fs::path program() const { return folder_ / "impeller.mpf"; }

  void Replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = TextOf(folder_ / file);
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error(from + " is not in " + file);
    std::ofstream(folder_ / file, std::ios::binary) << text.replace(at, from.size(), to);
  }
  json Check(int expected_exit) const { return CheckAsJson(program(), expected_exit); }
  std::string Text() const {
    std::ostringstream out;
    app::Run({"check", program().string()}, out, out);
    return out.str();
  }

 private:
  fs::path folder_;
};

json ClearanceOf(const json& report, const std::string& a, const std::string& b) {
  for (const json& clearance : report["clearances"]) {
    if (clearance["bodies"] == json({a, b})) return clearance;
  }
  return {};
}

TEST(ImpellerScene, PassesAndTheRingIsAsNearAsTheClosedFormSays) {
  const fs::path program = kScene / "impeller.mpf";
  const json report = CheckAsJson(program, app::kExitPass);
  EXPECT_EQ(report["verdict"], "pass");
  EXPECT_EQ(report["findings"].size(), 0u) << report["findings"];
  const double clearance = ClearanceOfTheHolder(kLength);
  EXPECT_NEAR(clearance, 20.0, 1e-4);
  const json told = ClearanceOf(report, "T3.holder", "ring");
  EXPECT_NEAR(told["seen_mm"].get<double>(), clearance, 0.05);
  EXPECT_NEAR(told["proven_mm"].get<double>(), clearance, 0.05);
  EXPECT_LE(told["proven_mm"].get<double>(), clearance);
  EXPECT_EQ(told["line"], LineOf(TextOf(program), "N5030 "));
  // CYCLE832(0.06, _ORI_ROUGH, 1): by no less than the farthest point of the holder may lean off.
  EXPECT_EQ(report["orientation_tolerance_deg"], 1.0);
  const double widened = 0.06 + std::hypot(kLength, 31.5) * std::tan(Radians(1.0));
  EXPECT_NEAR(told["widened_mm"].get<double>(), widened, 0.006);
}

TEST(ImpellerScene, WithAShorterToolTheHolderHitsTheRingOnThatBlock) {
  SceneCopy copy("short");
  copy.Replace("impeller.mpf.job.toml", "length = 182.0", "length = 152.0");
  copy.Replace("impeller.mpf.job.toml", "height = 62.0", "height = 32.0");
  copy.Replace("offsets.ini", "$TC_DP3[3,1]=182", "$TC_DP3[3,1]=152");
  EXPECT_NEAR(ClearanceOfTheHolder(kLength - 30.0), -10.0, 1e-4);
  const json report = copy.Check(app::kExitFail);
  ASSERT_EQ(report["findings"].size(), 1u) << report["findings"];
  const json& finding = report["findings"][0];
  EXPECT_EQ(finding["rule"], "collision");
  EXPECT_EQ(finding["line"], LineOf(TextOf(copy.program()), "N5030 "));
  EXPECT_EQ(finding["bodies"], json({"T3.holder", "ring"}));
}

// Edge 2 of T3 is a millimetre longer than the metal, so the holder stays that much further up
// along the tool; stated in the job or in the data file.
TEST(ImpellerScene, AnEdgeIsStatedInTheJobOrInTheDataFile) {
  for (const bool in_job : {true, false}) {
    SceneCopy copy("edges");
    copy.Replace("impeller.mpf", "N5010 G1 ", "N5010 D2 G1 ");
    if (in_job) {
      copy.Replace("impeller.mpf.job.toml", "length = 182.0",
                   "length = 182.0\nedges = [ { number = 1 }, { number = 2, length = 183.0 } ]");
      copy.Replace("offsets.ini", "$TC_DP3[3,1]=182\n", "");
    } else {
      copy.Replace("offsets.ini", "$TC_DP3[3,1]=182\n", "$TC_DP3[3,1]=182 $TC_DP3[3,2]=183\n");
    }
    const json report = copy.Check(app::kExitPass);
    ASSERT_EQ(report["findings"].size(), 1u) << report["findings"];
    EXPECT_EQ(report["findings"][0]["rule"], "tool-length");
    EXPECT_EQ(
        report["findings"][0]["message"],
        "D2 of T3 is 183.000 mm, the tool in the spindle is 182.000 mm from gauge line to tip");
    const json told = ClearanceOf(report, "T3.holder", "ring");
    EXPECT_NEAR(told["seen_mm"].get<double>(), ClearanceOfTheHolder(kLength) + 1.0, 0.05);
  }
}

// An error in a data file is told at its line and column there, with the line and a caret.
// With what tool management and magazines add to it, and zeros of all that is not simulated.
TEST(ImpellerScene, ADataFileMayBeAsTheControlWritesIt) {
  const std::string right = "$TC_DP6[2,1]=5";
  const std::string written =
      "CHANDATA(1)\n$TC_TP1[2]=1\n$TC_TP2[2]=\"BALLMILL_10\"\n$TC_TPC1[2]=3\n$TC_TP8[2]=2\n"
      "$TC_DP6[2,1]=5\n$TC_DP12[2,1]=0\n$TC_DPCE[2,1]=1\n$TC_DPH[2,1]=2\n$TC_MOP1[2,1]=50\n"
      "$TC_SCP13[2,1]=0\n$TC_CARR34[1]=\"\"\n$TC_MPP6[1,2]=2\n"
      "$P_CHBFR[0]=CTRANS(X,0,Y,0):CROT(Z,0)";
  SceneCopy copy("written");
  copy.Replace("offsets.ini", right, written);
  const json report = copy.Check(app::kExitPass);
  EXPECT_EQ(report["findings"].size(), 0u) << report["findings"];
  for (const char* other : {"CHANDATA(2)", "$TC_SCP13[2,1]=0.1", "$TC_CARR34[1]=\"X\""}) {
    SceneCopy wrong("written");
    wrong.Replace("offsets.ini", right, right + std::string("\n") + other);
    EXPECT_NE(wrong.Text().find("offsets.ini:8:1: unproven: "), std::string::npos) << other;
  }
}

TEST(ImpellerScene, ErrorsInADataFileAreToldAtTheirLines) {
  const std::string right = "$TC_DP6[2,1]=5";
  const std::vector<std::array<std::string, 2>> wrong = {
      {"$TC_DP6[2,1]=\"five\"",
       "offsets.ini:7:1: error: $TC_DPn[tool, edge] needs a number (alarm 17020) [control-alarm]"},
      {"$TC_DP6[2,1]=5 +",
       "offsets.ini:7:17: error: an operand is missing here (alarm 12080) [syntax]"},
      {"$TC_DP6[2,1]=5 G0 X5",
       "offsets.ini:7:1: unproven: a file of offsets may set variables only [unsupported-code]"},
      {"$TC_QQQ[2,1]=5",
       "offsets.ini:7:1: unproven: setting the system variable $TC_QQQ was not simulated "
       "[unsupported-code]"}};
  for (const auto& [line, message] : wrong) {
    SceneCopy copy("data");
    copy.Replace("offsets.ini", right, line);
    const std::string text = copy.Text();
    EXPECT_NE(text.find(message + "\n  " + line + "\n"), std::string::npos) << text;
  }
  SceneCopy copy("data");
  fs::remove(copy.folder() / "offsets.ini");
  const std::string text = copy.Text();
  EXPECT_NE(text.find("offsets.ini: error: the file of offsets cannot be read [control-alarm]\n"),
            std::string::npos)
      << text;
}

}  // namespace
