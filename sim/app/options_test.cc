// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "sim/app/app.h"

namespace ncsim::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class OptionsTest : public ::testing::Test {
 protected:
  Command Parse(std::vector<std::string> args) {
    return ParseCommandLine(std::move(args), out_, err_);
  }
  /// The message of a usage error.
  std::string Error(std::vector<std::string> args) {
    err_.str("");
    const Command command = Parse(std::move(args));
    EXPECT_EQ(command.kind, Command::Kind::kDone);
    EXPECT_EQ(command.exit_code, kExitBadInput);
    return err_.str();
  }
  std::ostringstream out_, err_;
};

TEST_F(OptionsTest, EverythingThatCheckTakes) {
  const Command command = Parse({"check",
                                 "a.nc",
                                 "--model",
                                 "umc750.urdf",
                                 "--job=j.toml",
                                 "--assume",
                                 "offset G54,tool T3",
                                 "--assume",
                                 "all",
                                 "--strict",
                                 "--clearance",
                                 "2.5",
                                 "--jobs",
                                 "4",
                                 "--format",
                                 "json",
                                 "--out",
                                 "r.json",
                                 "--interpret-only",
                                 "b.nc"});
  ASSERT_EQ(command.kind, Command::Kind::kCheck) << err_.str();
  const CheckOptions& check = command.check;
  EXPECT_THAT(check.programs, ElementsAre("a.nc", "b.nc"));
  EXPECT_EQ(check.model, "umc750.urdf");
  EXPECT_EQ(check.job, "j.toml");
  EXPECT_THAT(check.assume, ElementsAre("offset G54", "tool T3", "all"));
  EXPECT_TRUE(check.strict);
  EXPECT_EQ(check.clearance, 2.5);
  EXPECT_EQ(check.jobs, 4);
  EXPECT_EQ(check.format, Format::kJson);
  EXPECT_EQ(check.out, "r.json");
  EXPECT_TRUE(check.interpret_only);
}

TEST_F(OptionsTest, DefaultsLeaveTheJobItsClearance) {
  const Command command = Parse({"check", "a.nc"});
  ASSERT_EQ(command.kind, Command::Kind::kCheck) << err_.str();
  EXPECT_FALSE(command.check.clearance.has_value());
  EXPECT_EQ(command.check.format, Format::kText);
  EXPECT_EQ(command.check.jobs, 0);
}

TEST_F(OptionsTest, MistypedNamesGetASuggestion) {
  EXPECT_EQ(Error({"check", "a.nc", "--modle", "x.urdf"}),
            "ncsim: unknown option '--modle' (did you mean '--model'?)\n");
  EXPECT_EQ(Error({"chekc", "a.nc"}), "ncsim: unknown command 'chekc' (did you mean 'check'?)\n");
  EXPECT_EQ(
      Error({"check", "a.nc", "--format", "jsno"}),
      "ncsim: unknown format 'jsno' (did you mean 'json'?); there are text, json, sarif, junit "
      "and github\n");
  EXPECT_EQ(Error({"compare", "a.nc", "b.nc", "--format", "sarif"}),
            "ncsim: unknown format 'sarif'; there are text and json\n");
  EXPECT_EQ(Error({"check", "a.nc", "--zzzzzzzzzz"}), "ncsim: unknown option '--zzzzzzzzzz'\n");
  EXPECT_EQ(Error({"inspect", "a.urdf", "b.urdf"}), "ncsim: unexpected argument 'b.urdf'\n");
}

TEST_F(OptionsTest, EverythingThatPostTakes) {
  const Command command =
      Parse({"post",      "a.cls",      "--model",     "umc750.urdf", "--mode",       "tcp",
             "--job",     "j.toml",     "-o",          "a.nc",        "--post",       "p.toml",
             "--set",     "offset=G55", "--set",       "text=a=b",    "--number",     "7",
             "--unit",    "inch",       "--tolerance", "0.01",        "--first-tool", "3",
             "--cl-unit", "mm",         "--cl-system", "creo",        "--split",      "--no-check",
             "--assume",  "all",        "--strict"});
  ASSERT_EQ(command.kind, Command::Kind::kPost) << err_.str();
  const PostCommandOptions& post = command.post;
  EXPECT_EQ(post.cl_file, "a.cls");
  EXPECT_EQ(post.model, "umc750.urdf");
  EXPECT_EQ(post.mode, "tcp");
  EXPECT_EQ(post.job, "j.toml");
  EXPECT_EQ(post.out, "a.nc");
  EXPECT_EQ(post.post, "p.toml");
  EXPECT_THAT(post.constants, ElementsAre(std::pair("offset", "G55"), std::pair("text", "a=b")));
  EXPECT_EQ(post.number, 7);
  EXPECT_EQ(post.unit, post::ClUnit::kInch);
  EXPECT_EQ(post.tolerance, 0.01);
  EXPECT_EQ(post.first_tool, 3);
  EXPECT_EQ(post.cl.unit, post::ClUnit::kMillimetre);
  EXPECT_EQ(post.cl.flavour, post::ClFlavour::kCreo);
  EXPECT_TRUE(post.file_for_operation);
  EXPECT_FALSE(post.check);
  EXPECT_THAT(post.assume, ElementsAre("all"));
  EXPECT_TRUE(post.strict);
}

TEST_F(OptionsTest, BadUsageOfPost) {
  EXPECT_THAT(Error({"post"}), HasSubstr("post needs a CL file"));
  EXPECT_THAT(Error({"post", "a.cls", "--unit", "cm"}), HasSubstr("--unit takes mm or inch"));
  EXPECT_THAT(Error({"post", "a.cls", "--cl-unit", "cm"}), HasSubstr("--cl-unit takes mm or inch"));
  EXPECT_THAT(Error({"post", "a.cls", "--cl-system", "creao"}), HasSubstr("did you mean 'creo'"));
  EXPECT_THAT(Error({"post", "a.cls", "--set", "offset"}), HasSubstr("--set takes NAME=TEXT"));
  EXPECT_THAT(Error({"post", "a.cls", "--number", "0"}), HasSubstr("--number takes"));
  EXPECT_THAT(Error({"post", "a.cls", "--first-tool", "0"}), HasSubstr("--first-tool takes"));
  EXPECT_THAT(Error({"post", "a.cls", "--tolerance", "0"}), HasSubstr("--tolerance takes"));
  EXPECT_THAT(Error({"post", "a.cls", "--split"}), HasSubstr("--split needs --out"));
}

TEST_F(OptionsTest, Nightly) {
  const Command command =
      Parse({"nightly", "parts", "--out", "o", "--model", "m", "--assume", "a,b", "--strict",
             "--baseline", "b.toml", "--timeout", "2.5", "--jobs", "3", "--today", "2026-11-22"});
  ASSERT_EQ(command.kind, Command::Kind::kNightly);
  const NightlyOptions& o = command.nightly;
  EXPECT_EQ(o.what + o.out + o.model + o.baseline + o.today, "partsomb.toml2026-11-22");
  EXPECT_THAT(o.assume, ElementsAre("a", "b"));
  EXPECT_TRUE(o.strict);
  EXPECT_EQ(o.timeout, 2.5);
  EXPECT_EQ(o.jobs, 3);
  const NightlyOptions shard = Parse({"nightly", "p", "--all", "--shard", "3/4"}).nightly;
  EXPECT_EQ(shard.out, "ncsim-nightly");
  EXPECT_TRUE(shard.all);
  EXPECT_EQ(shard.shard, 3);
  EXPECT_EQ(shard.shard_count, 4);
  EXPECT_TRUE(Parse({"nightly", "p", "--merge"}).nightly.merge);
}

TEST_F(OptionsTest, BadUsageOfNightly) {
  EXPECT_THAT(Error({"nightly"}), HasSubstr("nightly needs a folder or a manifest"));
  for (const char* shard : {"4/4", "-1/4", "0", "0/0", "a/b", "1/2/3", "/", "0/1x", ""}) {
    EXPECT_THAT(Error({"nightly", "p", "--shard", shard}), HasSubstr("--shard takes I/N")) << shard;
  }
  EXPECT_THAT(Error({"nightly", "p", "--merge", "--all"}), HasSubstr("--merge makes a night"));
  EXPECT_THAT(Error({"nightly", "p", "--merge", "--shard", "0/1"}),
              HasSubstr("--merge makes a night"));
  EXPECT_THAT(Error({"nightly", "p", "--merge", "--reports"}),
              HasSubstr("--reports goes with --shard"));
  EXPECT_THAT(Error({"nightly", "p", "--shard", "0/1", "--baseline", "b"}),
              HasSubstr("--baseline goes with --merge"));
  EXPECT_THAT(Error({"nightly", "p", "--today", "2026-02-30"}), HasSubstr("--today takes a day"));
  EXPECT_THAT(Error({"nightly", "p", "--timeout", "0"}), HasSubstr("--timeout takes"));
  EXPECT_THAT(Error({"nightly", "p", "--jobs", "0"}), HasSubstr("--jobs takes"));
  EXPECT_THAT(Error({"nightly", "p", "--out", ""}), HasSubstr("--out takes a folder"));
}

TEST_F(OptionsTest, BadUsage) {
  EXPECT_EQ(Error({"check", "a.nc", "--cache", ""}), "ncsim: --cache takes a folder\n");
  EXPECT_THAT(Error({}), HasSubstr("which command?"));
  EXPECT_THAT(Error({"check"}), HasSubstr("check needs a program"));
  EXPECT_THAT(Error({"inspect"}), HasSubstr("inspect needs a model"));
  EXPECT_THAT(Error({"check", "a.nc", "b.nc", "--trace", "t.csv"}), HasSubstr("--trace takes one"));
  EXPECT_THAT(Error({"check", "a.nc", "b.nc", "--gltf", "g.glb"}), HasSubstr("--gltf takes one"));
  EXPECT_THAT(Error({"check", "a.nc", "b.nc", "--report", "r"}), HasSubstr("--report takes one"));
  EXPECT_THAT(Error({"check", "a.nc", "--jobs", "0"}), HasSubstr("--jobs takes a number from 1"));
  EXPECT_THAT(Error({"check", "a.nc", "--jobs", "two"}), HasSubstr("--jobs"));
  EXPECT_THAT(Error({"check", "a.nc", "--clearance=-1"}), HasSubstr("--clearance takes"));
  EXPECT_THAT(Error({"check", "a.nc", "--clearance", "nan"}), HasSubstr("--clearance takes"));
  EXPECT_THAT(Error({"check", "a.nc", "--assume", ","}), HasSubstr("--assume needs a name"));
  EXPECT_THAT(Error({"check", "a.nc", "--model"}), HasSubstr("--model"));
}

TEST_F(OptionsTest, HelpAndVersionGoToStandardOutput) {
  EXPECT_EQ(Parse({"--help"}).exit_code, kExitPass);
  EXPECT_THAT(out_.str(), HasSubstr("ncsim explain rotary-wrap"));
  EXPECT_THAT(out_.str(), HasSubstr("Exit code: 0 pass, 1 fail"));
  out_.str("");
  EXPECT_EQ(Parse({"check", "--help"}).exit_code, kExitPass);
  EXPECT_THAT(out_.str(), HasSubstr("--assume all|NAME,..."));
  EXPECT_THAT(out_.str(), HasSubstr("--report R.html"));
  out_.str("");
  EXPECT_EQ(Parse({"--version"}).exit_code, kExitPass);
  EXPECT_THAT(out_.str(), ::testing::StartsWith("ncsim "));
  EXPECT_EQ(err_.str(), "");
}

TEST(CombinedExitTest, FirstPresentOf43120) {
  EXPECT_EQ(CombinedExit({0, 2, 1, 3, 4}), 4);
  EXPECT_EQ(CombinedExit({0, 2, 1, 3}), 3);
  EXPECT_EQ(CombinedExit({0, 2, 1}), 1);
  EXPECT_EQ(CombinedExit({0, 2}), 2);
  EXPECT_EQ(CombinedExit({0, 0}), 0);
}

}  // namespace
}  // namespace ncsim::app
