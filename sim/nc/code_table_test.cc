// SPDX-License-Identifier: BSD-3-Clause
// Codes and groups: Haas NGC Mill Operator's Manual 2017, "List of G-codes", "List of M-codes".
#include "sim/nc/code_table.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace ncsim::nc {
namespace {

TEST(CodeTableTest, SortedAndUnique) {
  std::pair<char, int> last = {'A', -1};
  for (const CodeSpec& spec : HaasNgc().codes) {
    const std::pair<char, int> key = {spec.address, spec.number_x10};
    EXPECT_LT(last, key);
    last = key;
  }
}

TEST(CodeTableTest, FindsEveryCodeAndNoOther) {
  const Dialect& dialect = HaasNgc();
  for (const CodeSpec& spec : dialect.codes) {
    EXPECT_EQ(dialect.Find(spec.address, spec.number_x10 / 10.0), &spec);
  }
  EXPECT_EQ(dialect.Find('G', 43.4), nullptr);
  EXPECT_EQ(dialect.Find('G', 30.0), nullptr);
  EXPECT_EQ(dialect.Find('G', 1.00001), nullptr);
  EXPECT_EQ(dialect.Find('M', 17.0), nullptr);
  EXPECT_EQ(dialect.Find('X', 1.0), nullptr);
  EXPECT_EQ(dialect.Find('G', -1.0), nullptr);
  EXPECT_EQ(dialect.Find('G', 1e300), nullptr);
}

// One row of the manual's list each, or a run of them.
TEST(CodeTableTest, GroupsOfTheManual) {
  const std::map<int, int> groups = {
      {0, 1},    {3, 1},    {4, 0},   {10, 0},   {12, 0},  {17, 2},  {19, 2},  {20, 6},   {28, 0},
      {31, 0},   {40, 7},   {42, 7},  {43, 8},   {49, 8},  {51, 11}, {53, 0},  {54, 12},  {59, 12},
      {60, 0},   {61, 15},  {64, 15}, {65, 0},   {68, 16}, {69, 16}, {70, 0},  {73, 9},   {80, 9},
      {89, 9},   {90, 3},   {92, 0},  {93, 5},   {95, 5},  {98, 10}, {99, 10}, {101, 0},  {107, 0},
      {110, 12}, {129, 12}, {136, 0}, {141, 7},  {143, 8}, {150, 0}, {153, 9}, {154, 12}, {169, 9},
      {174, 0},  {187, 0},  {234, 8}, {254, 23}, {255, 23}};
  for (const auto& [code, group] : groups) {
    const CodeSpec* spec = HaasNgc().Find('G', code);
    ASSERT_NE(spec, nullptr) << "G" << code;
    EXPECT_EQ(spec->group, group) << "G" << code;
  }
}

TEST(CodeTableTest, OneDefaultAModalGroup) {
  std::map<int, int> defaults;
  std::set<int> groups;
  for (const CodeSpec& spec : HaasNgc().codes) {
    if (spec.address != 'G' || spec.group == 0) continue;
    groups.insert(spec.group);
    defaults[spec.group] += spec.is_default ? 1 : 0;
  }
  for (const int group : groups) EXPECT_EQ(defaults[group], 1) << "group " << group;
}

TEST(CodeTableTest, EveryCodeHasAMeaning) {
  for (const CodeSpec& spec : HaasNgc().codes) {
    EXPECT_FALSE(spec.meaning.empty());
    for (const char word : spec.words) EXPECT_TRUE(word >= 'A' && word <= 'Z');
  }
}

TEST(CodeTableTest, Dialects) {
  EXPECT_EQ(FindDialect("haas-ngc"), &HaasNgc());
  EXPECT_EQ(FindDialect("haas"), nullptr);
}

TEST(CodeTableTest, TheDocumentIsTheTable) {
  const std::string path = std::string(NCSIM_SOURCE_DIR) + "/docs/dialects/haas-ngc.md";
  const std::string table = CoverageTable(HaasNgc());
  const char* update = std::getenv("NCSIM_UPDATE_DOCS");
  if (update != nullptr && std::string(update) == "1") std::ofstream(path) << table;
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), table) << path << " is not what CoverageTable() prints; run this test with "
                               << "NCSIM_UPDATE_DOCS=1 to write it";
}

}  // namespace
}  // namespace ncsim::nc
