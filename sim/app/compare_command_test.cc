// SPDX-License-Identifier: BSD-3-Clause
// `ncsim compare` from its arguments to its bytes and exit code: faults planted in the scenes'
// programs and in one of a SINUMERIK, and changes that change nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "sim/app/app.h"

namespace ncsim::app {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const fs::path kScenes = fs::path(NCSIM_SOURCE_DIR) / "scenes";
const fs::path kDome = kScenes / "five_axis/dome.nc";
const fs::path kBlock = kScenes / "three_plus_two/angle_block.nc";

std::string Read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

constexpr const char* kSinumerikJob = R"(schema = 1
units = "mm"
model = "bc_table_840d.urdf"
[offsets]
G54 = { X = 0.0, Y = 0.0, Z = -350.0 }
[[tool]]
number = 2
name = "BALL_10"
length = 160.0
cutter = { type = "ball", diameter = 10.0, corner_radius = 5.0, flute_length = 30.0 }
)";
constexpr const char* kHaasJob = R"(schema = 1
units = "mm"
model = "umc750.urdf"
[offsets]
G54 = { X = -381.0, Y = -254.0, Z = -350.0 }
[[tool]]
number = 2
length = 150.0
cutter = { type = "end", diameter = 10.0, flute_length = 30.0 }
)";
constexpr const char* kSinumerik =
    "N10 G40 G17 G710 G94 G90 G64\nN20 T=2\nN30 M6\nN40 G0 B39. C37.\nN50 TRAORI\nN60 G54\n"
    "N70 ORIWKS\nN80 ORIAXES\nN90 G0 X54. Y-6. Z-28. S2500 D1 M3\nN100 G1 X53. Y-6.3 F250.\n"
    "N110 X51. Y-4. B39.5 C38.\nN120 X48. Y-2. Z-29. B40. C38.5\nN130 X45. Y1. B41. C39.\n"
    "N140 G0 Z40.\nN150 TRAFOOF\nN160 M5\nN170 M30\n";

class CompareCommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("ncsim_compare_" + std::to_string(getpid()) + "_" + info->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  int Compare(std::vector<std::string> args) {
    args.insert(args.begin(), "compare");
    std::ostringstream out, err;
    const int code = app::Run(std::move(args), out, err);
    out_ = out.str();
    err_ = err.str();
    return code;
  }
  /// The program against itself with `from` (a regular expression; must be there) made `to`.
  int Plant(const fs::path& program, const std::string& from, const std::string& to) {
    const std::string text = Read(program), job = program.string() + ".job.toml";
    const std::string changed = std::regex_replace(text, std::regex(from), to);
    EXPECT_NE(changed, text) << from;
    return Compare({program.string(), Write("new.nc", changed), "--job", job});
  }
  /// One error, of this rule, at this line of both.
  void ExpectFault(const std::string& rule, int line, int other) const {
    EXPECT_THAT(out_, HasSubstr("/new.nc:" + std::to_string(line) + ":1: error: "));
    EXPECT_THAT(out_, HasSubstr(" [" + rule + "]\n"));
    EXPECT_THAT(out_, HasSubstr(".nc:" + std::to_string(other) + ": N"));
    EXPECT_THAT(out_, HasSubstr("\nfail: 1 error, 0 unproven, 0 warnings; "));
  }
  int CompareSinumerik(const std::string& from, const std::string& to) {
    const std::string job = Write("job.toml", kSinumerikJob);
    std::string text = kSinumerik;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    return Compare(
        {Write("old.nc", kSinumerik), Write("new.nc", text), "--job", job, "--assume", "all"});
  }

  fs::path folder_;
  std::string out_, err_;
};

TEST_F(CompareCommandTest, AProgramIsItself) {
  for (const fs::path& program : {kDome, kBlock}) {
    EXPECT_EQ(Compare({program.string(), program.string()}), kExitPass) << out_ << err_;
    EXPECT_THAT(out_, Not(HasSubstr("added")));
  }
}

TEST_F(CompareCommandTest, ASwappedSignOfB) {
  EXPECT_EQ(Plant(kDome, "N360 G00 B-15. C0.", "N360 G00 B15. C0."), kExitFail);
  ExpectFault("path-deviation", 84, 84);
  EXPECT_THAT(out_, HasSubstr("the tool axis is 30.000 deg off that of dome.nc:84"));
}

TEST_F(CompareCommandTest, CTurnedByHalfATurnWithoutB) {
  EXPECT_EQ(Plant(kDome, "N360 G00 B-15. C0.", "N360 G00 B-15. C180."), kExitFail);
  ExpectFault("path-deviation", 84, 84);
  EXPECT_THAT(out_, HasSubstr("the tool axis is 30.000 deg off"));
}

// 2 r = 89.130: both are at opposite ends of a diameter half way.
TEST_F(CompareCommandTest, AnArcTheWrongWay) {
  EXPECT_EQ(Plant(kDome, "N260 G02", "N260 G03"), kExitFail);
  ExpectFault("path-deviation", 62, 62);
  EXPECT_THAT(out_, HasSubstr("the tip goes 89.1"));
  EXPECT_THAT(out_, HasSubstr("the arc goes the other way round"));
}

TEST_F(CompareCommandTest, ALostPoint) {
  EXPECT_EQ(Plant(kDome, "N600 [^\n]*\n", ""), kExitFail);
  ExpectFault("path-deviation", 133, 133);
  EXPECT_THAT(out_, HasSubstr("the point at the end of dome.nc:133 is left out"));
}

// A turn of 3 mm rise laid flat, the next one with twice the rise.
TEST_F(CompareCommandTest, AFlattenedHelix) {
  EXPECT_EQ(Plant(kBlock, "N255 G03 I-8. Z-6.", "N255 G03 I-8."), kExitFail);
  ExpectFault("path-deviation", 62, 62);
}

TEST_F(CompareCommandTest, AFeedInTheWrongUnit) {
  EXPECT_EQ(Plant(kDome, "N400 (.*)F1500.", "N400 $1F59.055"), kExitFail);
  ExpectFault("feed-rate", 93, 93);
  EXPECT_THAT(out_, HasSubstr("the feed is 59.1 mm/min, that of dome.nc:93 is 1500: inch for mm"));
}

TEST_F(CompareCommandTest, AMissingG254) {
  EXPECT_EQ(Plant(kBlock, "N1000 G254", "N1000"), kExitFail);
  ExpectFault("path-deviation", 156, 160);
}

TEST_F(CompareCommandTest, ARapidForAFeed) {
  EXPECT_EQ(Plant(kBlock, "N190 G01", "N190 G00"), kExitFail);
  ExpectFault("feed-lost", 47, 47);
}

TEST_F(CompareCommandTest, AFaultOfASubprogramIsOneFinding) {
  EXPECT_EQ(Plant(kBlock, "N1105[^\n]*\n", ""), kExitFail);
  ExpectFault("path-deviation", 174, 174);
  EXPECT_THAT(out_, HasSubstr("(6 times)"));
}

TEST_F(CompareCommandTest, WhatIsWrittenAnotherWayIsTheSame) {
  const std::pair<const char*, const char*> ways[] = {
      {"N195 G02 X50. Y32. I0. J-8.", "N195 G02 X50. Y32. R8."},
      {"N220 G01 Y-15.", "N220 G01 Y-20.\nN221 G91 Y2.5\nN222 Y2.5\nN223 G90"},
      {"N255 G03 I-8. Z-6.", "N255 G03 X-8. Y0. I-8. Z-4.5\nN256 G03 X8. Y0. I8. Z-6."},
      {"N585 G98 G83 X22. Y-25. Z15. R43. Q6. F300.", "N585 G98 G81 X22. Y-25. Z15. R43. F300."},
      {"N85 G01 X85. F1400.", "N85 G01 X85.003 F1404."},
      {"N70 M08", "N70 M08\nN71 G04 P500"},
  };
  for (const auto& [from, to] : ways) {
    EXPECT_EQ(Plant(kBlock, from, to), kExitPass) << from << "\n" << out_ << err_;
  }
}

// The same program in inches, four decimals: the tolerance has the greater of both increments.
TEST_F(CompareCommandTest, InchesAreMillimetres) {
  const std::string begin = "T2 M06\nG54 S3000 M03\nG00 X0. Y0.\nG43 H02 Z";
  const std::string mm =
      "G21 G90 G94\n" + begin + "10.\nG01 Z-1. F254.\nX33.333 Y7.\nG00 Z10.\nM30\n";
  const std::string inch =
      "G20 G90 G94\n" + begin + ".3937\nG01 Z-.0394 F10.\nX1.3123 Y.2756\nG00 Z.3937\nM30\n";
  const auto job = [&](const std::string& unit) {
    return Write(unit + ".toml",
                 std::string(kHaasJob) + "[control]\n\"setting 9\" = \"" + unit + "\"\n");
  };
  std::vector<std::string> args = {
      Write("old.nc", mm), Write("new.nc", inch), "--job",    job("mm"),
      "--job-b",           job("inch"),           "--assume", "all"};
  EXPECT_EQ(Compare(args), kExitPass) << out_;
  args.insert(args.end(), {"--tolerance", "0.0005"});
  EXPECT_EQ(Compare(args), kExitFail);
}

TEST_F(CompareCommandTest, ARewindIsListedAsAdded) {
  EXPECT_EQ(Plant(kBlock, "N100 G01 Z0. F2000.",
                  "N100 G01 Z0. F2000.\nN101 G00 Z50.\nN102 G00 B30.\nN103 G00 B0.\nN104 G00 Z0."),
            kExitPass)
      << out_;
  EXPECT_THAT(out_, HasSubstr("new.nc:28: rapids away from the feed and back to the same place"));
}

TEST_F(CompareCommandTest, Sinumerik) {
  EXPECT_EQ(CompareSinumerik("M30", "M30"), kExitPass) << out_ << err_;
  EXPECT_EQ(CompareSinumerik("N110 X51. Y-4. B39.5 C38.", "N110 X51. Y-4. B39.4 C38."), kExitFail);
  ExpectFault("path-deviation", 11, 11);
  EXPECT_THAT(out_, HasSubstr(": the tool axis is 0.099 deg off that of old.nc:11"));
  EXPECT_EQ(CompareSinumerik("N40 G0 B39. C37.", "N40 G0 B-39. C37."), kExitFail);
  ExpectFault("path-deviation", 4, 4);
  EXPECT_EQ(CompareSinumerik("F250.", "F2500."), kExitFail);
  ExpectFault("feed-rate", 10, 10);
  EXPECT_EQ(CompareSinumerik("N120 X48. Y-2. Z-29. B40. C38.5\n", ""), kExitFail);
  ExpectFault("path-deviation", 12, 12);
  // The other solution of the rotary axes has the same tool axis.
  EXPECT_EQ(CompareSinumerik("N90 G0", "N85 D1\nN90 G0"), kExitPass) << out_;
}

// A Haas program against one of a SINUMERIK, each with its own machine and job.
TEST_F(CompareCommandTest, TwoMachines) {
  const std::string haas =
      "G21 G90 G94\nT2 M06\nG54 S2500 M03\nG00 B0. C0.\nG00 X54. Y-6.\nG43 H02 Z28.\n"
      "G01 X53. Y-6.3 F250.\nX51. Y-4.\nG00 Z40.\nM30\n";
  const std::string sinumerik =
      "G17 G710 G94 G90\nT=2\nM6\nG54 D1 S2500 M3\nG0 B0 C0\nG0 X54 Y-6\nG0 Z28\n"
      "G1 X53 Y-6.3 F250\nX51 Y-4\nG0 Z40\nM30\n";
  const std::string haas_job =
      Write("haas.toml", std::string(kHaasJob) + "[control]\n\"setting 9\" = \"mm\"\n");
  const std::vector<std::string> args = {Write("haas.nc", haas),
                                         Write("siemens.nc", sinumerik),
                                         "--job",
                                         haas_job,
                                         "--job-b",
                                         Write("sin.toml", kSinumerikJob),
                                         "--assume",
                                         "all"};
  EXPECT_EQ(Compare(args), kExitPass) << out_ << err_;
  Write("siemens.nc", std::regex_replace(sinumerik, std::regex("Y-4"), "Y-4.1"));
  EXPECT_EQ(Compare(args), kExitFail);
  EXPECT_THAT(out_, HasSubstr("/siemens.nc:9:1: error: the tip goes 0.100 mm away"));
}

// What NX writes (CIRCLE about (0, 0, -1) is counter-clockwise), and a program of it for each
// machine; the feed of the hole is 100.
constexpr const char* kCl =
    "TOOL PATH/CUT,TOOL,MILL\nTLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\n"
    "MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\n"
    "LOAD/TOOL,2\nRAPID\nGOTO/10.0000,0.0000,5.0000,0.0000000,0.0000000,1.0000000\n"
    "FEDRAT/MMPM,250.0000\nGOTO/10.0000,0.0000,0.0000\n"
    "CIRCLE/0.0000,0.0000,0.0000,0.0000000,0.0000000,-1.0000000,10.0000,0.0600,0.5000,10.0000,"
    "0.0000\nGOTO/-10.0000,0.0000,0.0000\nGOTO/-20.0000,3.0000,0.0000,0.5000000,0.0000000,"
    "0.8660254\nRAPID\nGOTO/-20.0000,3.0000,30.0000\nEND-OF-PATH\n";

TEST_F(CompareCommandTest, ACutterLocationFile) {
  const std::string nc =
      "G21 G90 G94\nT2 M06\nG54 S2500 M03\nG00 B0. C0.\nG00 X10. Y0.\nG00 G234 H02 Z5.\n"
      "G01 Z0. F250.\nG03 X-10. Y0. I-10. J0.\nG01 X-20. Y3. B30.\nG00 Z30.\nM30\n";
  const std::string job =
      Write("job.toml", std::string(kHaasJob) + "[control]\n\"setting 9\" = \"mm\"\n");
  const std::string cl = Write("a.cls", kCl);
  const auto compare = [&](const std::string& text) {
    return Compare({cl, Write("a.nc", text), "--job", job, "--assume", "all"});
  };
  EXPECT_EQ(compare(nc), kExitPass) << out_ << err_;
  EXPECT_EQ(Compare({(folder_ / "a.nc").string(), cl, "--job", job, "--assume", "all"}), kExitPass);
  EXPECT_EQ(compare(std::regex_replace(nc, std::regex("G03"), "G02")), kExitFail);
  EXPECT_THAT(out_, HasSubstr("/a.nc:8:1: error: the tip goes 20.0"));
  EXPECT_THAT(out_, HasSubstr("/a.cls:9: CIRCLE/"));
  EXPECT_EQ(compare(std::regex_replace(nc, std::regex("B30"), "B-30")), kExitFail);
  EXPECT_THAT(out_, HasSubstr("/a.nc:9:1: error: the tool axis is 60.0"));
  EXPECT_EQ(compare(std::regex_replace(nc, std::regex("F250"), "F9")), kExitFail);
  EXPECT_THAT(out_, HasSubstr("/a.nc:7:1: error: the feed is 9 mm/min, that of a.cls:8 is 250"));
  Write("a.cls", std::string(kCl) + "NONSENSE/1\n");
  EXPECT_EQ(compare(nc), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("a.cls:15:1: error: unknown statement"));
}

TEST_F(CompareCommandTest, WhatIsNotSimulatedIsNotProven) {
  EXPECT_EQ(Plant(kBlock, "N85 G01 X85. F1400.", "N85 G01 X85. F1400.\nN86 G47 P1"), kExitUnproven);
  EXPECT_THAT(out_, HasSubstr("[unsupported-code]"));
  const std::string program =
      "G21 G90\nT1 M06\nG54\nG00 X0. Y0.\nG43 H01 Z5.\nG01 Z0. F100.\nM30\n";
  const std::string a = Write("a.nc", program);
  EXPECT_EQ(Compare({a, a, "--model", "umc750.urdf"}), kExitUnproven) << out_;
  EXPECT_THAT(out_, HasSubstr("[assumed]"));
  EXPECT_EQ(Compare({a, a, "--model", "umc750.urdf", "--assume", "all"}), kExitPass) << out_;
  EXPECT_THAT(out_, HasSubstr("offset G54"));
}

TEST_F(CompareCommandTest, WithoutAFeedNothingIsProven) {
  const std::string a = Write("a.nc", "G21 G90\nG53 G00 Z-10.\nM30\n");
  EXPECT_EQ(Compare({a, a, "--model", "umc750.urdf", "--assume", "all"}), kExitUnproven) << out_;
  EXPECT_THAT(out_, HasSubstr("nothing was held together [uncertified]"));
}

TEST_F(CompareCommandTest, BadInput) {
  EXPECT_EQ(Compare({kDome.string(), (folder_ / "none.nc").string()}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("none.nc: error: "));
  EXPECT_EQ(Compare({kDome.string(), Write("b.nc", "%\nG21\nM30\n%\n")}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("moves no axis"));
  EXPECT_EQ(Compare({kDome.string()}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("compare needs two programs"));
  EXPECT_EQ(Compare({"a", "b", "--tolerance", "0"}), kExitBadInput);
  EXPECT_EQ(Compare({"a", "b", "--angle-tolerance", "-1"}), kExitBadInput);
  EXPECT_EQ(Compare({"a", "b", "--format", "sarif"}), kExitBadInput);
}

TEST_F(CompareCommandTest, Json) {
  const std::string text = std::regex_replace(Read(kDome), std::regex("N600 [^\n]*\n"), "");
  const std::string out = (folder_ / "r.json").string();
  EXPECT_EQ(Compare({kDome.string(), Write("new.nc", text), "--format", "json", "--out", out,
                     "--job", kDome.string() + ".job.toml"}),
            kExitFail);
  EXPECT_THAT(out_, StartsWith("fail: 1 error, "));
  const std::string json = Read(out);
  EXPECT_THAT(json, AllOf(HasSubstr("\"rule\": \"path-deviation\""), HasSubstr("\"other\": {"),
                          HasSubstr("\"line\": 133"), HasSubstr("\"verdict\": \"fail\""),
                          HasSubstr("\"tolerance_mm\": 0.006"), HasSubstr("\"largest_mm\": {")));
}

}  // namespace
}  // namespace ncsim::app
