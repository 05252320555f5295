// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/toml_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncsim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> Texts(const Diagnostics& diagnostics) {
  std::vector<std::string> texts;
  for (const Diagnostic& diagnostic : diagnostics.all()) texts.push_back(ToString(diagnostic));
  return texts;
}

class TomlReaderTest : public ::testing::Test {
 protected:
  TomlTable Read(const std::string& text) {
    value_ = ParseToml(text, "job.toml", &diagnostics_);
    EXPECT_TRUE(value_.has_value());
    return TomlTable(*value_, "job.toml", &diagnostics_);
  }

  Diagnostics diagnostics_;
  std::optional<TomlValue> value_;
};

TEST_F(TomlReaderTest, ReadsEveryTypeAndFindsNothingUnknown) {
  TomlTable table = Read(
      "name = \"vise\"\nlength = 120\nratio = -0.5\non = true\nxyz = [1, 2.5, -3]\n"
      "files = [\"a\", \"b\"]\ncodes = [21, 22]\n[inner]\nkey = 1\n[[tool]]\nn = 1\n[[tool]]\nn = "
      "2\n");
  EXPECT_EQ(table.RequiredString("name"), "vise");
  EXPECT_EQ(table.RequiredNumber("length", NumberRule::kPositive), 120.0);
  EXPECT_EQ(table.Number("ratio"), -0.5);
  EXPECT_EQ(table.Boolean("on"), true);
  EXPECT_EQ(table.Vector3("xyz"), Eigen::Vector3d(1.0, 2.5, -3.0));
  EXPECT_THAT(table.Strings("files"), ElementsAre("a", "b"));
  EXPECT_THAT(table.Integers("codes", 0, 999), ElementsAre(21, 22));
  std::optional<TomlTable> inner = table.Table("inner");
  ASSERT_TRUE(inner.has_value());
  EXPECT_EQ(inner->Integer("key", 1, 1), 1);
  std::vector<TomlTable> tools = table.Tables("tool");
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[1].Integer("n", 1, 99), 2);
  table.Finish();
  inner->Finish();
  EXPECT_THAT(Texts(diagnostics_), IsEmpty());
}

TEST_F(TomlReaderTest, AbsentKeysAreNotErrorsUnlessRequired) {
  TomlTable table = Read("a = 1\n");
  EXPECT_EQ(table.Number("length"), std::nullopt);
  EXPECT_THAT(table.Tables("tool"), IsEmpty());
  EXPECT_THAT(Texts(diagnostics_), IsEmpty());
  EXPECT_EQ(table.RequiredNumber("length"), std::nullopt);
  EXPECT_THAT(Texts(diagnostics_), ElementsAre("job.toml:1:1: error: the key 'length' is missing"));
}

TEST_F(TomlReaderTest, UnknownKeysAreErrorsWithPositionAndSuggestion) {
  TomlTable table = Read("length = 1\n  lenght = 2\nqqq_qqq_qqq = 3\n");
  table.Number("length");
  table.Finish();
  EXPECT_THAT(Texts(diagnostics_),
              ElementsAre("job.toml:2:3: error: unknown key 'lenght' (did you mean 'length'?)",
                          "job.toml:3:1: error: unknown key 'qqq_qqq_qqq'"));
}

TEST_F(TomlReaderTest, WrongTypesAndSenselessNumbersAreErrors) {
  TomlTable table = Read(
      "text = \"12.0\"\nn = nan\ninf = -inf\nhuge = 1e10\nzero = 0.0\nminus = -2.5\npair = [1, 2]\n"
      "half = 1.5\nmode = \"eror\"\n");
  table.Number("text");
  table.Number("n");
  table.Number("inf");
  table.Number("huge");
  table.Number("zero", NumberRule::kPositive);
  table.Number("minus", NumberRule::kNotNegative);
  table.Vector3("pair");
  table.Integer("half", 0, 9);
  table.Word("mode", {"error", "warning", "off"});
  table.Finish();
  EXPECT_THAT(
      Texts(diagnostics_),
      ElementsAre("job.toml:1:8: error: 'text' must be a number, not a string",
                  "job.toml:2:5: error: 'n' is not a number (nan)",
                  "job.toml:3:7: error: 'inf' is infinite",
                  "job.toml:4:8: error: 'huge' is beyond 1000000000: absurd here",
                  "job.toml:5:8: error: 'zero' must be greater than 0, not 0",
                  "job.toml:6:9: error: 'minus' must not be negative, and is -2.5",
                  "job.toml:7:8: error: 'pair' must be an array of three numbers",
                  "job.toml:8:8: error: 'half' must be a whole number",
                  "job.toml:9:8: error: 'mode' must be \"error\", \"warning\" or \"off\", not "
                  "\"eror\" (did you mean 'error'?)"));
}

// As near as honest input comes to the faults above.
TEST_F(TomlReaderTest, EdgeValuesAreTaken) {
  TomlTable table = Read("tiny = 1e-9\nzero = -0.0\nlarge = 1e9\nwhole = 7\n");
  EXPECT_EQ(table.Number("tiny", NumberRule::kPositive), 1e-9);
  EXPECT_EQ(table.Number("zero", NumberRule::kNotNegative), 0.0);
  EXPECT_EQ(table.Number("large"), 1e9);
  EXPECT_EQ(table.Number("whole"), 7.0);
  EXPECT_THAT(Texts(diagnostics_), IsEmpty());
}

TEST(ParseTomlTest, BadSyntaxAndDuplicateKeysAreErrors) {
  Diagnostics diagnostics;
  EXPECT_FALSE(ParseToml("a = 1\na = 2\n", "j.toml", &diagnostics));
  EXPECT_FALSE(ParseToml("t = 010\n", "j.toml", &diagnostics));
  EXPECT_FALSE(ParseToml("a = [1, 2\n", "j.toml", &diagnostics));
  EXPECT_FALSE(ParseToml(std::string(100000, '['), "j.toml", &diagnostics));
  EXPECT_FALSE(ParseToml(std::string("\0\xff\xfe", 3), "j.toml", &diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 5u);
  EXPECT_EQ(diagnostics.all()[0].line, 2);
  EXPECT_THAT(diagnostics.all()[0].message, ::testing::StartsWith("not TOML: "));
  EXPECT_EQ(diagnostics.all()[1].line, 1);
}

TEST(ParseTomlTest, KeepsTheOrderOfTheFile) {
  Diagnostics diagnostics;
  const auto value = ParseToml("z = 1\na = 2\n[m]\n[b]\n", "j.toml", &diagnostics);
  ASSERT_TRUE(value.has_value());
  std::vector<std::string> keys;
  for (const TomlValue& child : value->children) keys.push_back(child.key);
  EXPECT_THAT(keys, ElementsAre("z", "a", "m", "b"));
}

}  // namespace
}  // namespace ncsim
