// SPDX-License-Identifier: BSD-3-Clause
// `ncsim post` from its arguments to its files and exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/app/app.h"

namespace ncsim::app {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const fs::path kModels = fs::path(NCSIM_SOURCE_DIR) / "models";

constexpr const char* kSlant =
    "TOOL PATH/SLANT,TOOL,EM10\nTLDATA/MILL,10.0,0.0,75.0,0.0,0.0\n"
    "MSYS/0,0,0,1,0,0,0,1,0\nLOAD/TOOL,1\nSPINDL/RPM,3000,CLW\nRAPID\n"
    "GOTO/25,0,43.301270,0.5,0,0.8660254\nFEDRAT/MMPM,300\nGOTO/0,0,0\nGOTO/0,20,0\nRAPID\n"
    "GOTO/25,20,43.301270\nEND-OF-PATH\n";

/// The part's zero 150 mm above the platter, and beside its middle.
std::string JobAt(const std::string& x) {
  return "schema = 1\nunits = \"mm\"\nmodel = \"umc750.urdf\"\n[start]\nX = 0.0\nY = 0.0\nZ = 0.0\n"
         "B = 0.0\nC = 0.0\n[offsets]\nG54 = { on = \"workpiece_mount\", xyz = [" +
         x +
         ", 0.0, 150.0] }\n[[tool]]\nnumber = 1\nlength = 165.0\n"
         "cutter = { type = \"end\", diameter = 10.0, flute_length = 30.0 }\n"
         "shank = [ { lower = 10.0, upper = 10.0, height = 35.0 } ]\nholder = "
         "\"CAT40-ER32-100\"\n[check]\nclearance = 2.0\n[control]\n"
         "\"setting 9\" = \"mm\"\n\"setting 15\" = \"on\"\n\"setting 22\" = 1.0\n\"setting 52\" = "
         "0.0\n"
         "\"setting 77\" = \"integer\"\n\"setting 85\" = 0.05\n\"setting 108\" = \"off\"\n"
         "\"setting 162\" = \"off\"\n\"setting 335\" = \"none\"\nblock_skip = \"off\"\n"
         "optional_stop = \"off\"\n";
}

class PostCommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ncsim_post_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    Write("slant.cls", kSlant);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string Read(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
  fs::path Path(const std::string& name) const { return folder_ / name; }
  bool Exists(const std::string& name) const { return fs::exists(folder_ / name); }

  /// `ncsim post slant.cls OPTIONS`
  int Post(std::vector<std::string> options, const std::string& cl = "slant.cls") {
    out_.str("");
    err_.str("");
    std::vector<std::string> args = {"post", (folder_ / cl).string()};
    args.insert(args.end(), options.begin(), options.end());
    return app::Run(args, out_, err_);
  }

  fs::path folder_;
  std::ostringstream out_, err_;
};

TEST_F(PostCommandTest, WritesHoldsAgainstTheFileAndChecks) {
  Write("slant.job.toml", JobAt("0.0"));
  EXPECT_EQ(Post({"-o", Path("slant.nc")}), kExitPass) << out_.str() << err_.str();
  EXPECT_THAT(out_.str(), AllOf(HasSubstr("slant.nc: written: 37 lines, 4 moves of 1 operation"),
                                HasSubstr("slant.cls: tip within 0.000"),
                                HasSubstr("\npass, stock not simulated")));
  // By hand: tilted by 30 degrees towards X the point 50 above it lies at Z50 of the turned part.
  EXPECT_THAT(Read("slant.nc"), HasSubstr("N40 G00 B30. C0.\nN45 M10\nN50 M12\nN55 G254\n"
                                          "N60 G00 X0. Y0.\nN65 G43 H01 Z50.\n"));
}

TEST_F(PostCommandTest, WithoutAFileTheProgramGoesToStandardOutput) {
  Write("slant.job.toml", JobAt("0.0"));
  EXPECT_EQ(Post({}), kExitPass) << err_.str();
  EXPECT_THAT(out_.str(), StartsWith("%\nO00001 (SLANT)\n"));
  EXPECT_THAT(err_.str(), HasSubstr("pass, stock not simulated"));
  EXPECT_FALSE(Exists("slant.nc"));
}

TEST_F(PostCommandTest, WithoutAJobItIsNotCheckedAndSaysSo) {
  const std::vector<std::string> options = {"--model", "umc750.urdf", "-o", Path("slant.nc")};
  EXPECT_EQ(Post(options), kExitUnproven) << err_.str();
  EXPECT_THAT(out_.str(), AllOf(HasSubstr("slant.cls: tip within"),
                                HasSubstr("unproven: not checked, for no job says")));
  std::vector<std::string> unchecked = options;
  unchecked.push_back("--no-check");
  EXPECT_EQ(Post(unchecked), kExitPass);
  EXPECT_THAT(out_.str(), Not(HasSubstr("tip within")));
}

// X -740 is 22 mm less than the machine has. B30 C0 takes the axis to X-755 (the check says so, by
// the metal); the mirrored position B-30 C180 leads it as far to the other side of the table's
// middle: X-7.
TEST_F(PostCommandTest, ThePositionThatCheckPassesIsTaken) {
  fs::copy(kModels / "haas_umc750", folder_ / "machine", fs::copy_options::recursive);
  std::string urdf = Read("machine/umc750.urdf");
  const std::string lower = "lower=\"-0.762\"";
  urdf.replace(urdf.find(lower), lower.size(), "lower=\"-0.740\"");
  Write("machine/umc750.urdf", urdf);
  const std::vector<std::string> options = {"--model", Path("machine/umc750.urdf"), "-o",
                                            Path("slant.nc")};
  Write("slant.job.toml", JobAt("-375.0"));
  EXPECT_EQ(Post(options), kExitPass) << out_.str() << err_.str();
  EXPECT_THAT(err_.str(), HasSubstr("note: operation 1: way 1 of 6 fails: axis X reaches -755.3"));
  EXPECT_THAT(Read("slant.nc"), HasSubstr("G00 B-30. C-180.\n"));
  // As near to it as one that is good: 2 mm from the limit.
  Write("slant.job.toml", JobAt("-355.0"));
  EXPECT_EQ(Post(options), kExitPass);
  EXPECT_THAT(Read("slant.nc"), HasSubstr("G00 B30. C0.\n"));
  EXPECT_EQ(err_.str(), "");
}

TEST_F(PostCommandTest, ToolsThatAreNotThoseOfTheFile) {
  std::string job = JobAt("0.0");
  const std::string diameter = "diameter = 10.0";
  job.replace(job.find(diameter), diameter.size(), "diameter = 12.0");
  Write("slant.job.toml", job);
  Post({"-o", Path("slant.nc")});
  EXPECT_THAT(err_.str(), HasSubstr("warning: T1 cuts 12 mm wide in the job, and 10 mm in "));
  job.replace(job.find("diameter = 12.0"), diameter.size(), "diameter = 10.004");
  Write("slant.job.toml", job);
  Post({"-o", Path("slant.nc")});
  EXPECT_THAT(err_.str(), Not(HasSubstr("warning")));
}

TEST_F(PostCommandTest, WhatCannotBePostedLeavesNoFile) {
  std::string text = kSlant;
  text.replace(text.find("GOTO/0,20,0"), 11, "GOTO/0,20,0,0,0,-1");
  Write("under.cls", text);
  const std::vector<std::string> options = {"--model", "umc750.urdf", "-o", Path("under.nc")};
  EXPECT_EQ(Post(options, "under.cls"), kExitBadInput);
  EXPECT_THAT(err_.str(), HasSubstr("under.cls:10:1: error: the machine cannot tilt the tool to "
                                    "the axis 0.000000, 0.000000, -1.000000"));
  EXPECT_FALSE(Exists("under.nc"));
  Write("cut.cls", std::string(kSlant).substr(0, 120));
  EXPECT_EQ(Post(options, "cut.cls"), kExitBadInput);
  EXPECT_NE(err_.str(), "");
  EXPECT_FALSE(Exists("under.nc"));
}

TEST_F(PostCommandTest, WrongNamesAreErrorsWithWhatThereIs) {
  const auto error = [&](std::vector<std::string> options) {
    EXPECT_EQ(Post(std::move(options)), kExitBadInput);
    return err_.str();
  };
  EXPECT_THAT(
      error({"--model", "umc750.urdf", "--mode", "tpc"}),
      HasSubstr("no mode 'tpc' (did you mean 'tcp'?); there are indexed, tcp, axes, three"));
  EXPECT_THAT(error({"--model", "umc750.urdf", "--set", "ofset=G55"}),
              HasSubstr("the post has no constant 'ofset' (did you mean 'offset'?)"));
  EXPECT_THAT(
      error({"--model", "umc750.urdf", "--post",
             (kModels / "bc_table_840d/bc_table_840d.post.toml").string()}),
      HasSubstr("it writes sinumerik-840d, and the control of Haas UMC-750 reads haas-ngc"));
  EXPECT_THAT(error({"--model", "umc750.urdf", "--post", "none.toml"}),
              HasSubstr("none.toml: error: cannot be read"));
  EXPECT_THAT(error({}), HasSubstr("no machine is named"));
}

TEST_F(PostCommandTest, NumberUnitAndConstants) {
  EXPECT_EQ(Post({"--model", "umc750.urdf", "-o", Path("O01234.nc"), "--unit", "inch", "--set",
                  "offset=G55", "--no-check"}),
            kExitPass)
      << err_.str();
  // 50 mm are 1.9685 inch.
  EXPECT_THAT(Read("O01234.nc"), AllOf(HasSubstr("O01234 (O01234)"), HasSubstr("G20 G17"),
                                       HasSubstr("G55\n"), HasSubstr("Z1.9685\n")));
}

// The control calls what lies beside the program; compare and check follow it there.
TEST_F(PostCommandTest, AFileForEachOperation) {
  std::string text = kSlant;
  text += text;
  text.replace(text.rfind("SLANT"), 5, "AGAIN");
  Write("two.cls", text);
  EXPECT_EQ(Post({"--model", "bc_table_840d.urdf", "--split", "-o", Path("two.mpf")}, "two.cls"),
            kExitUnproven)
      << err_.str();
  EXPECT_THAT(out_.str(), AllOf(HasSubstr("in 3 files"), HasSubstr("two.cls: tip within")));
  EXPECT_THAT(Read("two.mpf"), HasSubstr("EXTCALL(\"two_1\")"));
  EXPECT_THAT(Read("two.mpf"), HasSubstr("EXTCALL(\"two_2\")"));
  EXPECT_THAT(Read("two_1.mpf"), AllOf(HasSubstr("CYCLE800("), HasSubstr("M17\n")));
}

}  // namespace
}  // namespace ncsim::app
