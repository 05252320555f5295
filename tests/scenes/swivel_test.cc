// SPDX-License-Identifier: BSD-3-Clause
// A 3+2 program with CYCLE800 on models/bc_table_840d, with the model's own data: it swivels into a
// plane and back. B turns the block's upper edge past the tool; how high it comes is known.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "sim/app/app.h"
#include "sim/base/text.h"

namespace {

using namespace ncsim;
using nlohmann::json;
namespace fs = std::filesystem;

// G54 is the middle of the block's upper face, the block 60 x 60, where B and C meet kDown below
// it: about them an edge 30 off the middle comes as high as hypot(30, kDown).
constexpr double kDown = 650.0 - 595.0;
const double kHighest = std::hypot(30.0, kDown) - kDown;

std::string Program(double height, const std::string& direction) {
  const std::string end = "," + direction + ",0,1)\n", h = Short(height);
  return "N10 G17 G90 G94 G71 G40 G60\nN20 SUPA G0 Z0 D0\nN30 T1 M6\nN40 G54 D1 S3000 M3 F200\n"
         "N50 CYCLE800(1,\"TABLE\",200000,57,0,0,0,0,0,0,0,0,0" +
         end + "N60 G0 X0 Y0\nN70 G0 Z" + h + "\nN80 CYCLE81(" + h +
         ",4,1,3)\n"
         "N90 CYCLE800(0,\"TABLE\",200000,57,30,0,0,0,30,0,0,0,0" +
         end +
         "N100 G0 X0 Y0\nN110 G0 Z20\nN120 CYCLE82(20,4,1,3,,0.5)\n"
         "N130 CYCLE800(1,\"TABLE\",200000,57,0,0,0,0,0,0,0,0,0" +
         end +
         "N140 G0 X-10 Y0\nN150 G0 Z20\nN160 CYCLE81(20,4,1,3)\n"
         "N170 CYCLE800(1,\"0\",200000,57,0,0,0,0,0,0,0,0,0" +
         end + "N180 SUPA G0 Z0 D0\nN190 M30\n";
}

constexpr const char* kJob = R"(schema = 1
units = "mm"
model = "bc_table_840d.urdf"
[start]
X = 0.0
Y = 0.0
Z = 0.0
B = 0.0
C = 0.0
[offsets]
G54 = { X = 0.0, Y = 0.0, Z = -595.0 }
[[tool]]
number = 1
length = 165.0
cutter = { type = "end", diameter = 6.0, flute_length = 50.0 }
shank = [ { lower = 6.0, upper = 6.0, height = 15.0 } ]
holder = "BT40-ER32-100"
[[fixture]]
name = "block"
mesh = "block.stl"
unit = "mm"
at = { on = "G54" }
[check]
clearance = 2.0
)";

/// A block of 60 x 60 x 60 whose upper face is at z 0.
std::string Block() {
  const double corners[8][3] = {{-30, -30, -60}, {30, -30, -60}, {30, 30, -60}, {-30, 30, -60},
                                {-30, -30, 0},   {30, -30, 0},   {30, 30, 0},   {-30, 30, 0}};
  const int faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                            {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  std::ostringstream text;
  text << "solid block\n";
  for (const auto& face : faces) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) {
      text << "vertex " << corners[corner][0] << ' ' << corners[corner][1] << ' '
           << corners[corner][2] << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid block\n";
  return text.str();
}

json Check(double height, const std::string& direction, int expected_exit) {
  const fs::path folder = fs::temp_directory_path() / ("ncsim_swivel_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path program = folder / "swivel.mpf";
  std::ofstream(program) << Program(height, direction);
  std::ofstream(folder / "swivel.mpf.job.toml") << kJob;
  std::ofstream(folder / "block.stl") << Block();
  std::ostringstream out, err;
  EXPECT_EQ(app::Run({"check", program.string(), "--format", "json"}, out, err), expected_exit)
      << err.str() << out.str().substr(0, 4000);
  fs::remove_all(folder);
  return json::parse(out.str(), nullptr, false);
}

TEST(SwivelScene, APostsProgramPassesAndSaysWhatItAssumes) {
  for (const bool plus : {true, false}) {
    // With -1 C comes back from 180 degrees and brings the corners up.
    const json report = Check(plus ? kHighest + 2.1 : 20.0, plus ? "1" : "-1", app::kExitPass);
    EXPECT_EQ(report["verdict"], "pass");
    EXPECT_EQ(report["findings"].size(), 0u) << report["findings"];
    std::string assumed;
    for (const json& assumption : report["assumptions"]) {
      assumed += assumption["name"].get<std::string>() + " ";
    }
    EXPECT_NE(assumed.find("SD55221 "), std::string::npos) << assumed;
    EXPECT_NE(assumed.find("TC_CARR40 "), std::string::npos) << assumed;
    for (const json& pair : report["clearances"]) {
      if (!plus || pair["bodies"] != json({"T1.flutes", "block"})) continue;
      EXPECT_NEAR(pair["seen_mm"].get<double>(), 2.1, 0.05) << pair;
      EXPECT_EQ(pair["line"], 9);
    }
  }
}

TEST(SwivelScene, TheEdgeThatComesUpIsMetOnThatBlock) {
  const json near = Check(kHighest + 1.9, "1", app::kExitPass);
  ASSERT_EQ(near["findings"].size(), 1u) << near["findings"];
  EXPECT_EQ(near["findings"][0]["rule"], "near-miss");
  EXPECT_EQ(near["findings"][0]["line"], 9);
  const json hit = Check(kHighest - 0.1, "1", app::kExitFail);
  ASSERT_FALSE(hit["findings"].empty());
  EXPECT_EQ(hit["findings"][0]["rule"], "collision");
  EXPECT_EQ(hit["findings"][0]["line"], 9);
}

}  // namespace
