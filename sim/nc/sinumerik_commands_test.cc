// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_commands.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "sim/nc/sinumerik_coverage.h"

namespace ncsim::nc {
namespace {

TEST(SinumerikCommandsTest, ByNameInAnyCase) {
  EXPECT_EQ(FindSinumerikCommand("traori")->name, "TRAORI");
  EXPECT_EQ(FindSinumerikCommand("G01")->name, "G1");
  EXPECT_EQ(FindSinumerikCommand("M06")->name, "M6");
  EXPECT_EQ(FindSinumerikCommand("G599")->name, "G505");
  EXPECT_EQ(FindSinumerikCommand("TRAOOF"), nullptr);
  EXPECT_EQ(FindSinumerikCommand("G504"), nullptr);
  EXPECT_EQ(FindSinumerikG(505.0)->group, 8);
  EXPECT_EQ(FindSinumerikG(0.0)->name, "G0");
  EXPECT_EQ(FindSinumerikG(1.5), nullptr);
  EXPECT_EQ(FindSinumerikG(-1.0), nullptr);
  EXPECT_EQ(FindSinumerikG(1e9), nullptr);
  EXPECT_EQ(*FindSinumerikConstant("_ori_rough"), 13.0);
  EXPECT_EQ(FindSinumerikConstant("_ORI"), nullptr);
}

// NC programming 12/2019, "G functions/preparatory functions".
TEST(SinumerikCommandsTest, GroupsOfNamedGCodes) {
  const std::map<std::string, int> groups = {
      {"CIP", 1},      {"G4", 2},      {"TRANS", 3},    {"G17", 6},    {"G41", 7},   {"G54", 8},
      {"SUPA", 9},     {"G642", 10},   {"G9", 11},      {"G601", 12},  {"G710", 13}, {"G91", 14},
      {"G93", 15},     {"ORIMKS", 25}, {"COMPCAD", 30}, {"FNORM", 37}, {"PTP", 49},  {"ORIRPY", 50},
      {"ORIAXES", 51}, {"RTLIOF", 55}, {"DYNROUGH", 59}};
  for (const auto& [name, group] : groups) {
    ASSERT_NE(FindSinumerikCommand(name), nullptr) << name;
    EXPECT_EQ(FindSinumerikCommand(name)->group, group) << name;
  }
}

// MD20150: one member of each modal group is active at power-up; G1 in group 1, G500 in 8, G60 in
// 10.
TEST(SinumerikCommandsTest, StartState) {
  std::map<int, std::string> start;
  std::set<std::string> names;
  for (const SinumerikCommand& command : Sinumerik840dGCodes()) {
    EXPECT_TRUE(names.insert(std::string(command.name)).second) << command.name;
    EXPECT_TRUE(command.group >= 1 && command.group <= 64) << command.name;
    if (!command.is_default) continue;
    EXPECT_TRUE(start.emplace(command.group, command.name).second) << command.name;
  }
  EXPECT_EQ(start.at(1), "G1");
  EXPECT_EQ(start.at(8), "G500");
  EXPECT_EQ(start.at(10), "G60");
  EXPECT_EQ(start.at(13), "G71");
  EXPECT_EQ(start.at(51), "ORIVECT");
  for (const int once : {2, 3, 9, 11, 62}) EXPECT_EQ(start.count(once), 0U) << once;
}

TEST(SinumerikCommandsTest, TheDocumentIsTheTable) {
  const std::string path = std::string(NCSIM_SOURCE_DIR) + "/docs/dialects/sinumerik-840d.md";
  const std::string table = SinumerikCoverageTable();
  const char* update = std::getenv("NCSIM_UPDATE_DOCS");
  if (update != nullptr && std::string(update) == "1") std::ofstream(path) << table;
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), table) << path << " is not what SinumerikCoverageTable() prints; run this "
                               << "test with NCSIM_UPDATE_DOCS=1 to write it";
}

TEST(SinumerikCommandsTest, RowsAreInUpperCaseAndUnique) {
  std::set<std::string> names;
  for (const SinumerikCommand& command : Sinumerik840dNames()) {
    EXPECT_TRUE(names.insert(std::string(command.name)).second) << command.name;
    for (const char c : command.name) EXPECT_FALSE(c >= 'a' && c <= 'z') << command.name;
    EXPECT_EQ(command.group, 0) << command.name;
    EXPECT_FALSE(command.meaning.empty()) << command.name;
  }
}

}  // namespace
}  // namespace ncsim::nc
