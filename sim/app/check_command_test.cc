// SPDX-License-Identifier: BSD-3-Clause
// `ncsim check` from its arguments to its bytes and exit code, in-process, on the model that ships.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/app/app.h"

namespace ncsim::app {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kJob = R"(schema = 1
units = "mm"
model = "umc750.urdf"
[offsets]
G54 = { on = "workpiece_mount" }
[[tool]]
number = 1
length = 180.0
cutter = { type = "end", diameter = 10.0, flute_length = 30.0 }
shank = [ { lower = 10.0, upper = 10.0, height = 50.0 } ]
holder = "CAT40-ER32-100"
)";

/// A harmless program; `body` goes in its middle, at line 7 and on.
std::string Program(const std::string& body) {
  return "%\nO0001\nG21 G17 G90 G94\nT1 M06\nG54 S3000 M03\nG00 G43 H01 X0. Y0. Z200.\n" + body +
         "\nG53 G00 Z0.\nM30\n%\n";
}

class CheckCommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("ncsim_check_" + std::to_string(getpid()) + "_" + info->name());
    fs::create_directories(folder_);
    Write("job.toml", kJob);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(Path(name), std::ios::binary) << text;
    return Path(name);
  }
  std::string Read(const std::string& name) const {
    std::ifstream in(Path(name), std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
  /// Runs `ncsim check` with the job; output in out_ and err_.
  int CheckWithJob(std::vector<std::string> args) {
    args.insert(args.end(), {"--job", Path("job.toml")});
    return CheckPlain(std::move(args));
  }
  int CheckPlain(std::vector<std::string> args) {
    args.insert(args.begin(), "check");
    std::ostringstream out, err;
    const int code = app::Run(std::move(args), out, err);
    out_ = out.str();
    err_ = err.str();
    return code;
  }
  std::string LastLine() const {
    const std::size_t end = out_.find_last_not_of('\n');
    return out_.substr(out_.rfind('\n', end) + 1, end - out_.rfind('\n', end));
  }

  fs::path folder_;
  std::string out_, err_;
};

TEST_F(CheckCommandTest, AHarmlessProgramPasses) {
  EXPECT_EQ(CheckWithJob({Write("a.nc", Program("G01 Z150. F500."))}), kExitPass) << out_ << err_;
  EXPECT_THAT(LastLine(), StartsWith("pass, stock not simulated: 0 errors, 0 unproven, 0 warnings; "
                                     "9 blocks, "));
  EXPECT_THAT(LastLine(), HasSubstr(", least clearance "));
  EXPECT_EQ(err_, "");
}

TEST_F(CheckCommandTest, AFaultIsPrintedAsCompilersDo) {
  const std::string program = Write("a.nc", Program("G53 G00 X12.5"));
  EXPECT_EQ(CheckWithJob({program}), kExitFail);
  EXPECT_THAT(out_, HasSubstr(program + ":7:1: error: axis X reaches 12.500 mm, limit 0 mm; it "
                                        "leaves at X0.000 "));
  EXPECT_THAT(out_, HasSubstr(" [travel-limit]\n  G53 G00 X12.5\n  ^\n"));
  EXPECT_THAT(LastLine(), StartsWith("fail, stock not simulated: 1 error, "));
}

// The tip rests on the B axis' height (50.8 above the platter), 386 mm beside it: under G234
// machine X is -381 + 386 cos(B), inside at both ends and 5 mm beyond the limit at B0.
TEST_F(CheckCommandTest, ATcpBulgeIsFoundInTheMiddleOfABlock) {
  const std::string body = "G49 G00 B-15.\nG00 G234 H01 X386. Y0. Z50.8\nG01 B15. F2000.";
  EXPECT_EQ(CheckWithJob({Write("a.nc", Program(body)), "--interpret-only"}), kExitFail) << out_;
  EXPECT_THAT(out_,
              HasSubstr("a.nc:9:1: error: axis X reaches 5.000 mm, limit 0 mm; it leaves at"));
  EXPECT_THAT(LastLine(), HasSubstr(": 1 error, "));
}

TEST_F(CheckCommandTest, FormatsOfServicesHaveAllProgramsInOneDocument) {
  const std::string good = Write("good.nc", Program("G01 X10. F100."));
  const std::string bad = Write("bad.nc", Program("G01 X900. F100."));
  const std::string none = Path("none.nc");
  const auto text = [&](const std::string& format) {
    EXPECT_EQ(CheckWithJob({good, bad, none, "--format", format}), kExitBadInput);
    return out_;
  };
  for (const char* format : {"sarif", "junit", "github"}) {
    const std::string report = text(format);
    EXPECT_THAT(report, HasSubstr("travel-limit")) << format;
    EXPECT_THAT(report, HasSubstr("none.nc: error: cannot be read")) << format;
    EXPECT_EQ(report.find("not-checked") != std::string::npos, true) << format;
  }
  EXPECT_THAT(text("junit"), HasSubstr("tests=\"3\" failures=\"1\" errors=\"1\""));
  // Into a file, with a summary line a program on standard output.
  CheckWithJob({good, bad, "--format", "sarif", "--out", Path("r.sarif")});
  EXPECT_THAT(out_, HasSubstr("bad.nc: fail"));
  EXPECT_THAT(Read("r.sarif"), HasSubstr("\"version\": \"2.1.0\""));
}

TEST_F(CheckCommandTest, AProgramThatMovesNothingIsBadInput) {
  EXPECT_EQ(CheckWithJob({Write("a.nc", "%\nG21\nM30\n%\n")}), kExitBadInput);
  EXPECT_EQ(out_, "");
  EXPECT_THAT(err_, HasSubstr("a.nc: error: the program moves no axis"));
  EXPECT_EQ(CheckWithJob({Write("b.nc", "hello world [\n")}), kExitBadInput);
  EXPECT_THAT(err_, AllOf(HasSubstr("b.nc:1:"), HasSubstr("[syntax]")));
}

TEST_F(CheckCommandTest, AnAlarmBeforeTheFirstMotionIsAFailure) {
  EXPECT_EQ(CheckWithJob({Write("a.nc", "%\nG20 G21\nG00 X0.\nM30\n%\n")}), kExitFail) << err_;
  EXPECT_THAT(out_, HasSubstr("a.nc:2:"));
  EXPECT_THAT(out_, HasSubstr("[control-alarm]"));
}

TEST_F(CheckCommandTest, UnreadableInputsAreBadInput) {
  const std::string good = Write("a.nc", Program(""));
  EXPECT_EQ(CheckWithJob({Path("none.nc")}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("none.nc: error: "));
  EXPECT_EQ(CheckWithJob({Write("empty.nc", "")}), kExitBadInput);
  EXPECT_EQ(CheckWithJob({Write("binary.nc", std::string("G0\0X1", 5))}), kExitBadInput);
  EXPECT_EQ(CheckPlain({good, "--job", Path("none.toml")}), kExitBadInput);
  EXPECT_EQ(CheckPlain({good, "--job", Write("bad.toml", "schema = 1\nfoo = 3\n")}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("bad.toml:2:"));
  EXPECT_EQ(CheckPlain({good}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("no machine is named"));
  EXPECT_EQ(CheckPlain({good, "--model", "no_such_machine"}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("there is no model 'no_such_machine'"));
  EXPECT_EQ(CheckWithJob({good, "--out", Path("no/such/folder.txt")}), kExitBadInput);
  EXPECT_EQ(CheckWithJob({good, "--trace", Path("no/such/folder.csv")}), kExitBadInput);
}

// The tip passes 4 mm above the block.
TEST_F(CheckCommandTest, AMarginOfTheJobGoesBeforeTheClearanceOfTheCommandLine) {
  const std::string program = Write("a.nc", Program("G00 Z50.\nG01 Z24. F2000.\nG00 Z200."));
  const auto check = [&](const std::string& body, const std::string& clearance) {
    Write("job.toml", std::string(kJob) +
                          "[[fixture]]\nname = \"block\"\nbox = [80.0, 80.0, 20.0]\n"
                          "at = { on = \"workpiece_mount\" }\n[[check.margin]]\nbodies = [\"" +
                          body + "\", \"block\"]\nclearance = " + clearance + "\n");
    return CheckWithJob({program, "--clearance", "4.5"});
  };
  EXPECT_EQ(check("T1.flutes", "3.95"), kExitPass) << out_ << err_;
  EXPECT_THAT(out_, Not(HasSubstr("[near-miss]")));
  EXPECT_EQ(check("flutes", "4.05"), kExitPass) << out_ << err_;
  EXPECT_THAT(out_, HasSubstr("flutes of T1 come within 4 mm of block (clearance 4.05 mm) at "));
  EXPECT_EQ(check("T2.flutes", "4.05"), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("job.toml:17:11: error: there is no body 'T2.flutes' in the scene or "
                              "among the tools (did you mean 'T1.flutes'?)\n"));
  EXPECT_EQ(out_, "");
}

TEST_F(CheckCommandTest, AssumptionsKeepFromPassingUntilAccepted) {
  const std::string program = Write("a.nc", Program("G01 Z150. F500."));
  EXPECT_EQ(CheckPlain({program, "--model", "umc750"}), kExitUnproven);
  EXPECT_THAT(out_, HasSubstr("--assume \"offset G54\" [assumed]"));
  EXPECT_THAT(out_, HasSubstr("--assume \"tool T1\" [assumed]"));
  EXPECT_EQ(CheckPlain({program, "--model", "umc750", "--assume", "offset g54"}), kExitUnproven);
  EXPECT_THAT(out_, Not(HasSubstr("--assume \"offset G54\"")));
  EXPECT_EQ(CheckPlain({program, "--model", "umc750", "--assume", "offset G54,tool T1"}), kExitPass)
      << out_;
  EXPECT_EQ(CheckPlain({program, "--model", "umc750", "--assume", "all", "--strict"}), kExitPass);
  EXPECT_EQ(CheckWithJob({program, "--strict"}), kExitUnproven);
  EXPECT_EQ(CheckWithJob({program, "--assume", "tool T9"}), kExitPass);
  EXPECT_THAT(err_, HasSubstr("warning: --assume 'tool T9': nothing of that name was assumed"));
}

TEST_F(CheckCommandTest, InterpretOnlyNeverPasses) {
  EXPECT_EQ(CheckWithJob({Write("a.nc", Program("")), "--interpret-only"}), kExitUnproven);
  EXPECT_THAT(LastLine(), StartsWith("unproven, stock not simulated, collision not checked: "));
}

TEST_F(CheckCommandTest, TheJobBesideTheProgramIsUsed) {
  const std::string program = Write("a.nc", Program("G01 Z150. F500."));
  Write("a.nc.job.toml", kJob);
  EXPECT_EQ(CheckPlain({program}), kExitPass) << err_;
  Write("a.job.toml", kJob);
  EXPECT_EQ(CheckPlain({program}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("name one of them with --job"));
  fs::remove(Path("a.nc.job.toml"));
  EXPECT_EQ(CheckPlain({program}), kExitPass) << err_;
}

TEST_F(CheckCommandTest, ClearanceOfTheCommandLineOverridesTheJobs) {
  const std::string program = Write("a.nc", Program("G01 Z5. F500."));
  Write("job.toml", std::string(kJob) + "[check]\nclearance = 1.0\n");
  EXPECT_EQ(CheckWithJob({program, "--assume", "nominal shapes"}), kExitPass);
  EXPECT_THAT(out_, Not(HasSubstr("[near-miss]")));
  EXPECT_EQ(CheckWithJob({program, "--assume", "nominal shapes", "--clearance", "6"}), kExitPass);
  EXPECT_THAT(out_, HasSubstr("warning: flutes of T1 come within 5 mm of c_platter"));
}

TEST_F(CheckCommandTest, ANominalShapeWithinTenMillimetresIsAnAssumption) {
  EXPECT_EQ(CheckWithJob({Write("far.nc", Program("G01 Z10.5 F500."))}), kExitPass) << out_;
  EXPECT_EQ(CheckWithJob({Write("near.nc", Program("G01 Z9.5 F500."))}), kExitUnproven);
  EXPECT_THAT(out_, HasSubstr("nominal shapes is assumed: the shapes of "));
  EXPECT_EQ(CheckWithJob({Path("near.nc"), "--assume", "nominal shapes"}), kExitPass);
}

// The tool changes at X-736.6 Y-203.2 Z0; its tip is 180 below, and the mount stands at -381, -254,
// -546.5: a box under the tip there has its top at 366.5 less the gap, in the mount's frame.
TEST_F(CheckCommandTest, ANominalToolChangePoseWithinTenMillimetresIsAnAssumption) {
  const std::string program =
      Write("a.nc", "O1\nG21 G90 G94 G54\nT1 M06\nG00 X0. Y0.\nG43 H01 Z250.\nM30\n");
  const auto job = [](const std::string& gap_from_mount) {
    return std::string(kJob) + "[[fixture]]\nname = \"post\"\nbox = [10.0, 10.0, 10.0]\n" +
           "at = { on = \"workpiece_mount\", xyz = [-355.6, 50.8, " + gap_from_mount + "] }\n";
  };
  Write("job.toml", job("344.5"));
  EXPECT_EQ(CheckWithJob({program}), kExitPass) << out_;
  Write("job.toml", job("347.5"));
  EXPECT_EQ(CheckWithJob({program}), kExitUnproven) << out_;
  EXPECT_THAT(out_,
              HasSubstr("tool-change pose is assumed: the place where the machine changes tools "
                        "is nominal, not measured, and there "));
}

TEST_F(CheckCommandTest, PicturesAreWrittenOrThereAreNone) {
  const std::string good = Write("good.nc", Program("G01 X10. F500."));
  EXPECT_EQ(CheckWithJob({good, "--report", Path("r.html"), "--gltf", Path("g.glb")}), kExitPass);
  EXPECT_THAT(Read("r.html"), AllOf(StartsWith("<!DOCTYPE html>"), EndsWith("</html>\n")));
  EXPECT_THAT(Read("g.glb"), StartsWith("glTF"));
  EXPECT_EQ(CheckWithJob({good, "--report", Path("no/such/r.html")}), kExitBadInput);
  EXPECT_THAT(err_, HasSubstr("r.html: error: cannot be written"));
  const std::string still = Write("still.nc", "%\nO0001\nG21\nM30\n%\n");
  EXPECT_EQ(CheckWithJob({still, "--report", Path("s.html"), "--gltf", Path("s.glb")}),
            kExitBadInput);
  EXPECT_FALSE(fs::exists(Path("s.html")));
  EXPECT_FALSE(fs::exists(Path("s.glb")));
}

TEST_F(CheckCommandTest, TraceHasARowForEachMotion) {
  const std::string program = Write("a.nc", Program("G01 X10. Z150. F500."));
  EXPECT_EQ(CheckWithJob({program, "--trace", Path("t.csv")}), kExitPass);
  const std::string trace = Read("t.csv");
  EXPECT_THAT(trace, StartsWith("file,line,kind,time_s,X,Y,Z,A,B,C,px,py,pz,ui,uj,uk,feed\n"));
  EXPECT_THAT(trace, HasSubstr(program + ",7,feed,"));
  // The mount of the model stands at -381, -254, -546.5; the tool is 180 long.
  EXPECT_THAT(trace, HasSubstr(",-371.000000,"));
  EXPECT_THAT(trace, HasSubstr(",-216.500000,,0.000000,0.000000,10.000000,"));
  EXPECT_THAT(trace, HasSubstr(",150.000000,0.000000,0.000000,1.000000,500.000000\n"));
}

TEST_F(CheckCommandTest, ReportFileAndSummary) {
  const std::string program = Write("a.nc", Program(""));
  EXPECT_EQ(CheckWithJob({program, "--format", "json", "--out", Path("r.json")}), kExitPass);
  EXPECT_THAT(Read("r.json"), AllOf(StartsWith("{\n"), HasSubstr("\"verdict\": \"pass\""),
                                    HasSubstr("\"not_checked\": [\n  \"stock\"\n ]")));
  EXPECT_THAT(out_, StartsWith(program + ": pass, stock not simulated: "));
}

TEST_F(CheckCommandTest, SeveralProgramsGiveTheSameBytesOnAnyNumberOfThreads) {
  const std::string good = Write("a.nc", Program(""));
  const std::string bad = Write("b.nc", Program("G53 G00 X5."));
  EXPECT_EQ(CheckWithJob({good, bad, good, "--format", "json"}), kExitFail);
  const std::string one = out_;
  EXPECT_THAT(one, AllOf(StartsWith("[\n{\n"), EndsWith("}\n]\n")));
  EXPECT_EQ(std::count(one.begin(), one.end(), '\0'), 0);
  EXPECT_EQ(CheckWithJob({good, bad, good, "--format", "json", "--jobs", "3"}), kExitFail);
  EXPECT_EQ(out_, one);
  EXPECT_EQ(CheckWithJob({good, Path("none.nc"), bad}), kExitBadInput);
  EXPECT_THAT(out_, HasSubstr("pass, stock"));
  EXPECT_THAT(out_, HasSubstr("fail, stock"));
}

TEST_F(CheckCommandTest, ACacheChangesNoByteOfAReport) {
  const std::string good = Write("a.nc", Program("G01 Z10.5 F500."));
  const std::string bad = Write("b.nc", Program("G01 Z-3. F500."));
  const std::string cache = Path("deep/cache");
  for (const std::string format : {"json", "text"}) {
    const std::vector<std::string> plain{good, bad, "--format", format};
    std::vector<std::string> cached = plain;
    cached.insert(cached.end(), {"--cache", cache, "--jobs", "2"});
    EXPECT_EQ(CheckWithJob(plain), kExitFail);
    const std::string without = out_;
    EXPECT_EQ(err_, "");
    fs::remove_all(cache);
    EXPECT_EQ(CheckWithJob(cached), kExitFail);
    EXPECT_EQ(out_, without);
    EXPECT_THAT(err_, StartsWith(cache + ": cache: "));
    EXPECT_EQ(CheckWithJob(cached), kExitFail);
    EXPECT_EQ(out_, without);
    const std::string all = err_.substr(err_.find(" of ") + 4);
    EXPECT_EQ(err_, cache + ": cache: " + all.substr(0, all.find(' ')) + " of " + all);
  }
  EXPECT_FALSE(fs::is_empty(cache));
  EXPECT_EQ(CheckWithJob({good, "--interpret-only", "--cache", cache}), kExitUnproven);
  EXPECT_EQ(err_, "") << "nothing to be known";
}

// The same program with lines above it: nothing is computed, and all is told of the new lines.
TEST_F(CheckCommandTest, ACacheKnowsAProgramThatHasMovedDown) {
  const std::string above = "(a)\n(b)\n";
  const std::string body = "G01 Z-3. F500.";
  const std::string before = Write("a.nc", Program(body));
  const std::string after = Write("b.nc", "%\n" + above + Program(body).substr(2));
  EXPECT_EQ(CheckWithJob({before, "--cache", Path("c")}), kExitFail);
  EXPECT_THAT(out_, HasSubstr("a.nc:7:1: error: "));
  EXPECT_EQ(CheckWithJob({after, "--cache", Path("c")}), kExitFail);
  const std::string all = err_.substr(err_.find(" of ") + 4);
  EXPECT_THAT(err_, HasSubstr("cache: " + all.substr(0, all.find(' ')) + " of "));
  EXPECT_THAT(out_, HasSubstr("b.nc:9:1: error: "));
  const std::string warm = out_;
  EXPECT_EQ(CheckWithJob({after}), kExitFail);
  EXPECT_EQ(out_, warm);
}

TEST_F(CheckCommandTest, ACacheThatCannotBeMadeIsBadInput) {
  const std::string program = Write("a.nc", Program(""));
  EXPECT_EQ(CheckWithJob({program, "--cache", program}), kExitBadInput);
  EXPECT_EQ(out_, "");
  EXPECT_THAT(err_, StartsWith(program + ": error: cannot be a cache: "));
}

TEST_F(CheckCommandTest, ACacheThatCannotBeWrittenIsSaidOnce) {
  const std::string program = Write("a.nc", Program(""));
  EXPECT_EQ(CheckWithJob({program, program, "--cache", "/proc"}), kExitPass);
  EXPECT_THAT(err_, HasSubstr("/proc: warning: the cache cannot be written: "));
  EXPECT_EQ(std::count(err_.begin(), err_.end(), '\n'), 2);
}

TEST_F(CheckCommandTest, ALineOfAMegabyteIsReportedInShort) {
  const std::string body = "G01 F500. (" + std::string(1'000'000, 'x') + ") Q[1 Z150.";
  EXPECT_EQ(CheckWithJob({Write("a.nc", Program(body))}), kExitFail);
  EXPECT_THAT(out_, HasSubstr("[syntax]"));
  EXPECT_LT(out_.size(), 10'000U);
}

TEST_F(CheckCommandTest, UsageErrorsExitWith3) {
  EXPECT_EQ(CheckPlain({}), kExitBadInput);
  EXPECT_THAT(out_, IsEmpty());
  EXPECT_THAT(err_, StartsWith("ncsim: check needs a program"));
}

}  // namespace
}  // namespace ncsim::app
