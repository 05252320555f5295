// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/nightly/test_folder.h"

namespace ncsim::nightly {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> Names(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

std::string Fault(const TestFolder& folder, const std::string& text) {
  Diagnostics diagnostics;
  const auto manifest = ReadManifest(folder.Write("m.toml", text), {}, &diagnostics);
  EXPECT_EQ(manifest.has_value(), diagnostics.all().empty());
  return diagnostics.all().empty() ? "" : ToString(diagnostics.all().front());
}

TEST(FindProgramsTest, ThoseThatHaveAJobBesideThem) {
  const TestFolder folder("find_programs");
  for (const char* name :
       {"b/one.nc", "b/one.nc.job.toml", "a.MPF", "a.job.toml", "none.nc", "text.txt", "odd.xyz",
        "odd.xyz.job.toml", "left.nc.job.toml", ".git/x.nc", ".git/x.nc.job.toml"}) {
    folder.Write(name, "x");
  }
  Diagnostics diagnostics;
  const auto found = FindPrograms(folder.path(), {}, &diagnostics);
  ASSERT_TRUE(found);
  EXPECT_THAT(Names(found->entries), ElementsAre("a.MPF", "b/one.nc", "odd.xyz"));
  EXPECT_THAT(found->notes, ElementsAre("1 without a job, not checked (--model M.urdf): none.nc",
                                        "1 without a program beside it: left.nc.job.toml"));
  EntryDefaults with_model;
  with_model.model = "umc750.urdf";
  EXPECT_THAT(Names(FindPrograms(folder.path(), with_model, &diagnostics)->entries),
              ElementsAre("a.MPF", "b/one.nc", "none.nc", "odd.xyz"));
}

TEST(FindProgramsTest, NothingToCheckIsAnError) {
  const TestFolder folder("find_nothing");
  Diagnostics diagnostics;
  EXPECT_FALSE(FindPrograms(folder.path(), {}, &diagnostics));
  EXPECT_FALSE(FindPrograms(folder / "QQQ", {}, &diagnostics));
  EXPECT_EQ(diagnostics.all().size(), 3U);
}

TEST(ManifestTest, EachProgramWithWhatItIsCheckedWith) {
  const TestFolder folder("manifest");
  const std::string path = folder.Write("m.toml", R"toml(
schema = 1
model = "umc750.urdf"
timeout_s = 60
assume = ["offset G54"]
[[program]]
program = "z.nc"
cost = 3
[[program]]
name = "a with the long vise"
program = "a.nc"
job = "long.job.toml"
model = "mill.urdf"
assume = ["all"]
strict = true
clearance = 1.5
timeout_s = 5
cost = 2.5
)toml");
  Diagnostics diagnostics;
  const auto manifest = ReadManifest(path, {}, &diagnostics);
  ASSERT_TRUE(manifest) << ToString(diagnostics.all().front());
  ASSERT_EQ(manifest->entries.size(), 2U);
  EXPECT_EQ(manifest->root, folder.path());
  const Entry& a = manifest->entries[0];
  EXPECT_EQ(a.name, "a with the long vise");
  EXPECT_THAT(a.Words(),
              ElementsAre("check", "a.nc", "--model", "mill.urdf", "--job", "long.job.toml",
                          "--assume", "all", "--clearance", "1.5", "--strict"));
  EXPECT_EQ(a.timeout, 5.0);
  EXPECT_THAT(manifest->entries[1].Words(),
              ElementsAre("check", "z.nc", "--model", "umc750.urdf", "--assume", "offset G54"));
  EXPECT_EQ(manifest->entries[1].timeout, 60.0);
  EXPECT_EQ(manifest->entries[1].cost, 3.0);
}

TEST(ManifestTest, IsStrict) {
  const TestFolder folder("manifest_faults");
  EXPECT_THAT(Fault(folder, "[[program]]\nprogram = \"a.nc\"\n"), HasSubstr("'schema' is missing"));
  EXPECT_THAT(Fault(folder, "schema = 1\n"), HasSubstr("no [[program]] is listed"));
  EXPECT_THAT(Fault(folder, "schema = 1\n[[program]]\nprogram = \"a.nc\"\njobs = \"b\"\n"),
              HasSubstr("m.toml:4:1: error: unknown key 'jobs' (did you mean 'job'?)"));
  EXPECT_THAT(
      Fault(folder, "schema = 1\n[[program]]\nprogram = \"a\"\n[[program]]\nprogram = \"a\"\n"),
      HasSubstr("'a' is listed twice"));
  EXPECT_THAT(
      Fault(folder,
            "schema = 1\n[[program]]\nprogram = \"a\"\ncost = 1\n[[program]]\nprogram = \"b\"\n"),
      HasSubstr("'cost' must be stated of every program, or of none"));
  EXPECT_THAT(Fault(folder, "schema = 1\n[[program]]\nprogram = \"a\"\ntimeout_s = 0\n"),
              HasSubstr("must be greater than 0"));
}

std::vector<Entry> EntriesOf(const std::vector<double>& costs) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    Entry entry;
    entry.name = std::string(1, static_cast<char>('a' + i));
    entry.cost = costs[i];
    entries.push_back(entry);
  }
  return entries;
}

// Graham, "Bounds on multiprocessing timing anomalies" (1969), the example for which LPT is worst:
// five jobs 5 5 4 4 3 3 3 on three machines, LPT gives 11, the best is 9.
TEST(ShardTest, TheCostliestFirst) {
  const std::vector<Entry> entries = EntriesOf({3, 5, 4, 3, 5, 4, 3});
  EXPECT_THAT(Names(Shard(entries, 0, 3)), ElementsAre("a", "b", "g"));
  EXPECT_THAT(Names(Shard(entries, 1, 3)), ElementsAre("d", "e"));
  EXPECT_THAT(Names(Shard(entries, 2, 3)), ElementsAre("c", "f"));
}

TEST(ShardTest, EveryProgramIsInOneShard) {
  const std::vector<Entry> entries = EntriesOf({9, 0, 4, 4, 0, 1, 7, 2, 2, 2, 0});
  for (int count = 1; count < 15; ++count) {
    std::vector<std::string> all;
    for (int index = 0; index < count; ++index) {
      for (const std::string& name : Names(Shard(entries, index, count))) all.push_back(name);
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, Names(entries)) << count;
  }
}

}  // namespace
}  // namespace ncsim::nightly
