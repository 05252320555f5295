// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "post/cl_words.h"

namespace ncsim::post {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;

class ClReaderTest : public testing::Test {
 protected:
  /// The first statement of `text` as a Record.
  template <class Record>
  Record Read(const std::string& text) {
    diagnostics_ = {};
    ClReader reader(nc::Program::FromText("t.cls", text), 3, &diagnostics_);
    EXPECT_TRUE(reader.Next(&record_)) << text;
    const Record* found = std::get_if<Record>(&record_.statement);
    EXPECT_NE(found, nullptr) << text << Message();
    return found ? *found : Record{};
  }
  std::string Message() const {
    return diagnostics_.all().empty() ? "" : ToString(diagnostics_.all().front());
  }
  /// The message of a statement that is wrong.
  std::string Wrong(const std::string& text) {
    Read<cl::Unknown>(text);
    EXPECT_EQ(diagnostics_.all().size(), 1u) << text;
    return Message();
  }

  ClRecord record_;
  Diagnostics diagnostics_;
};

TEST_F(ClReaderTest, EachRecordHasItsPlace) {
  ClReader reader(nc::Program::FromText("t.cls", "FINI\n\n  GOTO/1,2, $\n3\nRAPID\n"), 3,
                  &diagnostics_);
  std::vector<int> lines, columns;
  while (reader.Next(&record_)) {
    EXPECT_EQ(record_.where.file, 3);
    lines.push_back(record_.where.line);
    columns.push_back(record_.where.column);
  }
  EXPECT_THAT(lines, ElementsAre(1, 3, 5));
  EXPECT_THAT(columns, ElementsAre(1, 3, 1));
}

TEST_F(ClReaderTest, Motion) {
  const auto to = Read<cl::Goto>("GOTO/54.0941,-0.36,-14.9755,0.8450443,0.1657414,0.50836");
  EXPECT_EQ(to.point, Vector3d(54.0941, -0.36, -14.9755));
  EXPECT_EQ(*to.axis, Vector3d(0.8450443, 0.1657414, 0.50836));
  EXPECT_FALSE(Read<cl::Goto>("GOTO/1,2,3").axis);
  EXPECT_EQ(Read<cl::Point>("1,2,3").point, Vector3d(1, 2, 3));
  EXPECT_EQ(Read<cl::GoDelta>("GODLTA/1,2,3").delta, Vector3d(1, 2, 3));
  EXPECT_EQ(*Read<cl::GoDelta>("GODLTA/-5").along_axis, -5.0);
  EXPECT_EQ(Read<cl::From>("FROM/0,0,100").point, Vector3d(0, 0, 100));
  EXPECT_EQ(*Read<cl::GoHome>("GOHOME/1,2,3").point, Vector3d(1, 2, 3));
  EXPECT_EQ(Read<cl::GoHome>("GOHOME / Z").words, "Z");
  Read<cl::Rapid>("RAPID/");
}

// NX help, CLSF Manager: x,y,z, i,j,k, r, tolerance, its ratio, tool diameter, corner radius,
// TIMES.
TEST_F(ClReaderTest, Circle) {
  const auto nx =
      Read<cl::Circle>("CIRCLE/297.5,-402.5,466.0,0.0,0.0,-1.0,25.0,0.06,0.5,125.0,1.0,TIMES,3");
  EXPECT_EQ(nx.centre, Vector3d(297.5, -402.5, 466));
  EXPECT_EQ(nx.normal, Vector3d(0, 0, -1));
  EXPECT_EQ(*nx.radius, 25.0);
  EXPECT_EQ(*nx.times, 3);
  EXPECT_FALSE(Read<cl::Circle>("CIRCLE/1,2,3,0,0,1.").radius);
  EXPECT_EQ(*Read<cl::Circle>("CIRCLE/1,2,3,0,0,1.,5").radius, 5.0);
}

TEST_F(ClReaderTest, FeedInEachOrderAndUnit) {
  EXPECT_EQ(Read<cl::Feed>("FEDRAT/MMPM,85.5").value, 85.5);
  EXPECT_EQ(Read<cl::Feed>("FEDRAT/85.5,MMPM").unit, ClFeedUnit::kMmPerMinute);
  EXPECT_EQ(Read<cl::Feed>("FEDRAT / 1193.663081,  IPM").unit, ClFeedUnit::kInchPerMinute);
  EXPECT_EQ(Read<cl::Feed>("FEDRAT/MMPR,0.1").unit, ClFeedUnit::kMmPerRev);
  EXPECT_EQ(Read<cl::Feed>("FEDRAT/0.01,IPR").unit, ClFeedUnit::kInchPerRev);
  EXPECT_EQ(Read<cl::Feed>("FEDRAT/PERMIN,5").unit, ClFeedUnit::kPerMinute);
  EXPECT_FALSE(Read<cl::Feed>("FEDRAT/200").unit);
}

TEST_F(ClReaderTest, OperationAndTool) {
  const auto begin = Read<cl::OperationBegin>("TOOL PATH/A/B, C,TOOL,R390-25A25L");
  EXPECT_EQ(begin.name, "A/B, C");
  EXPECT_EQ(begin.tool, "R390-25A25L");
  EXPECT_EQ(Read<cl::OperationBegin>("$$-> FEATNO / 73").name, "FEATNO 73");
  Read<cl::OperationEnd>("END-OF-PATH");
  const auto drill = Read<cl::ToolShape>("TLDATA/DRILL,MILL,63.0,0.0,239.0,178.0,35.0");
  EXPECT_EQ(drill.kind, "DRILL,MILL");
  EXPECT_THAT(drill.values, ElementsAre(63, 0, 239, 178, 35));
  EXPECT_THAT(Read<cl::ToolShape>("CUTTER/3.,0,1.5,.62132,22.5,0,46.").values,
              ElementsAre(3, 0, 1.5, .62132, 22.5, 0, 46));
  EXPECT_THAT(Read<cl::ToolShape>("REMARK -> CUTTER / 6.000000").values, ElementsAre(6));
  const auto load = Read<cl::LoadTool>("LOAD/TOOL,2,ADJUST,3 ");
  EXPECT_EQ(load.number, 2);
  EXPECT_EQ(*load.length_register, 3);
  const auto creo = Read<cl::LoadTool>("LOADTL / 7, OSETNO, 17, LENGTH, 5.0");
  EXPECT_EQ(creo.number, 7);
  EXPECT_EQ(*creo.length_register, 17);
  EXPECT_EQ(*creo.length, 5.0);
  EXPECT_EQ(Read<cl::LoadTool>("TURRET / 4").number, 4);
  EXPECT_EQ(Read<cl::SelectTool>("SELECT/TOOL,11").number, 11);
  EXPECT_EQ(Read<cl::Msys>("MSYS/1,2,3,0,1,0,1,0,0").x, Vector3d(0, 1, 0));
  EXPECT_EQ(Read<cl::Csys>("CSYS/1.,0,0,-59.5,0,1.,0,-59.5,0,0,1.,19.").rows[11], 19.0);
}

TEST_F(ClReaderTest, SpindleInEachOrder) {
  using Mode = cl::Spindle::Mode;
  for (const char* text : {"SPINDL/RPM,1000,CLW", "SPINDL/1000,RPM,CLW", "SPINDL / 1000, CLW"}) {
    const auto spindle = Read<cl::Spindle>(text);
    EXPECT_EQ(spindle.mode, Mode::kRpm);
    EXPECT_EQ(spindle.speed, 1000.0);
    EXPECT_EQ(spindle.clockwise, true);
  }
  EXPECT_EQ(Read<cl::Spindle>("SPINDL/RPM,80,CCLW,RANGE,2").range, "2");
  EXPECT_EQ(Read<cl::Spindle>("SPINDL/800,CCLW").clockwise, false);
  EXPECT_EQ(Read<cl::Spindle>("SPINDL/OFF").mode, Mode::kOff);
  EXPECT_EQ(Read<cl::Spindle>("SPINDL/ON").mode, Mode::kOn);
  EXPECT_EQ(Read<cl::Spindle>("SPINDL/LOCK,90").mode, Mode::kLocked);
  EXPECT_NEAR(Read<cl::Spindle>("SPINDL/SFM,300,CLW").speed, 91.44, 1e-12);  // 300 ft
  EXPECT_EQ(Read<cl::Spindle>("SPINDL/SMM,100").speed, 100.0);
}

TEST_F(ClReaderTest, CoolantCompensationAndCodes) {
  EXPECT_EQ(Read<cl::Coolant>("COOLNT/MIST").mode, cl::Coolant::Mode::kMist);
  EXPECT_EQ(Read<cl::Coolant>("COOLNT/OFF").mode, cl::Coolant::Mode::kOff);
  const auto comp = Read<cl::CutterComp>("CUTCOM/LEFT,12,XYPLAN");
  EXPECT_EQ(comp.side, cl::CutterComp::Side::kLeft);
  EXPECT_EQ(comp.plane, cl::CutterComp::Plane::kXY);
  EXPECT_EQ(*comp.diameter_register, 12);
  EXPECT_EQ(Read<cl::CutterComp>("CUTCOM/OFF").side, cl::CutterComp::Side::kOff);
  EXPECT_EQ(Read<cl::Delay>("DELAY / 2.5").value, 2.5);
  EXPECT_TRUE(Read<cl::Delay>("DELAY/3,REV").revolutions);
  const auto code = Read<cl::Code>("AUXFUN/58,NEXT");
  EXPECT_EQ(code.letter, 'M');
  EXPECT_EQ(code.number, 58.0);
  EXPECT_TRUE(code.with_next);
  EXPECT_EQ(Read<cl::Code>("PREFUN/68.1").letter, 'G');
  EXPECT_TRUE(Read<cl::Stop>("OPSTOP").optional_stop);
  EXPECT_FALSE(Read<cl::Stop>("STOP").optional_stop);
  EXPECT_EQ(Read<cl::Units>("UNITS / INCHES").unit, ClUnit::kInch);
  EXPECT_FALSE(Read<cl::MultiAxis>("MULTAX / OFF").on);
  Read<cl::End>("FINI");
}

TEST_F(ClReaderTest, CyclesOfThreeSystems) {
  const auto nx =
      Read<cl::Cycle>("CYCLE/DRILL,RAPTO,3.,FEDTO,-33.0043,RTRCTO,AUTO,MMPM,250.,DWELL,REV,2");
  EXPECT_EQ(nx.kind, ClCycleKind::kDrill);
  EXPECT_EQ(*nx.clearance, 3.0);
  EXPECT_EQ(*nx.depth, -33.0043);
  EXPECT_EQ(nx.retract, cl::Cycle::Retract::kAuto);
  EXPECT_EQ(nx.feed->value, 250.0);
  EXPECT_EQ(*nx.dwell, 2.0);
  EXPECT_TRUE(nx.dwell_in_revolutions);
  EXPECT_EQ(Read<cl::Cycle>("CYCLE/DRILL,DEEP,RAPTO,3.,FEDTO,0.,MMPM,250.").kind,
            ClCycleKind::kDeep);
  const auto creo =
      Read<cl::Cycle>("CYCLE / BRKCHP, DEPTH, 20, STEP, 5, 4, IPM, 10, CLEAR, .5, RETURN, 25");
  EXPECT_EQ(creo.kind, ClCycleKind::kBreakChip);
  EXPECT_EQ(*creo.depth, 20.0);
  EXPECT_EQ(*creo.clearance, 0.5);
  EXPECT_THAT(creo.steps, ElementsAre(5, 4));
  EXPECT_EQ(creo.retract_distance, 25.0);
  const auto solidworks = Read<cl::Cycle>(
      "CYCLE/DEEP2,FEDTO,24.6205,1STPECK,5.,SUBPECK,2.,MMPM,670.56,RAPTO,3.,RTRCTO,25.");
  EXPECT_EQ(solidworks.kind, ClCycleKind::kDeep);
  EXPECT_THAT(solidworks.steps, ElementsAre(5, 2));
  EXPECT_EQ(Read<cl::Cycle>("CYCLE/BORE,NODRAG,RAPTO,1,FEDTO,-2").kind, ClCycleKind::kBoreNoDrag);
  EXPECT_EQ(*Read<cl::Cycle>("CYCLE/TAP,DEPTH,9,CLEAR,2,TPI,20").feed->unit,
            ClFeedUnit::kInchPerRev);
  EXPECT_EQ(Read<cl::CycleSwitch>("CYCLE/OFF").what, cl::CycleSwitch::What::kOff);
  EXPECT_EQ(Read<cl::CycleSwitch>("CYCLE/INIT").what, cl::CycleSwitch::What::kInit);
}

TEST_F(ClReaderTest, TextsAndWhatIsPassedOn) {
  EXPECT_EQ(Read<cl::Text>("PARTNO / MFG0001").kind, cl::Text::Kind::kPartNo);
  EXPECT_EQ(Read<cl::Text>("INSERT/STOP  change fixture").text, "STOP  change fixture");
  EXPECT_EQ(Read<cl::Text>("PPRINT hello").kind, cl::Text::Kind::kPrint);
  EXPECT_EQ(Read<cl::Text>("$$ centerline data").kind, cl::Text::Kind::kComment);
  EXPECT_EQ(Read<cl::Text>("$$-> MFGNO / MFG0001").text, "MFGNO / MFG0001");
  const auto word = Read<cl::PostWord>("ROTATE/TABLE,ATANGL,90,CLW");
  EXPECT_EQ(word.major, "ROTATE");
  EXPECT_THAT(word.values, ElementsAre("TABLE", "ATANGL", "90", "CLW"));
  for (const char* text : {"PAINT/COLOR,186", "PPWORD/3DCOMP,3155", "TRNTYP/WORLD,0,0,0",
                           "MACHIN / UNCX01, 1", "CSI_SET_FLUTE_LENGTH/16."}) {
    Read<cl::Ignored>(text);
  }
}

TEST_F(ClReaderTest, WhatIsNotKnownIsReported) {
  EXPECT_EQ(Wrong("GOTTO/1,2,3"),
            "t.cls:1:1: error: unknown statement 'GOTTO' (did you mean 'GOTO'?)");
  EXPECT_EQ(Wrong("TRANS/1,2,3"),
            "t.cls:1:1: error: TRANS is not supported: it shifts or turns the coordinates of what "
            "follows");
  EXPECT_EQ(Wrong("GOTO/1,2"), "t.cls:1:1: error: GOTO without x, y, z");
  EXPECT_EQ(Wrong("GOTO/1,,2"), "t.cls:1:8: error: GOTO without x, y, z");
  EXPECT_EQ(Wrong("GOTO/1,2,nan"),
            "t.cls:1:10: error: x, y, z of GOTO should be a number and is 'nan'");
  EXPECT_EQ(Wrong("GOTO/1,2,3,0,0"), "t.cls:1:1: error: GOTO without i, j, k");
  EXPECT_EQ(Wrong("GOTO/1,2,3,0,0,1,7"), "t.cls:1:18: error: '7' is not known in GOTO");
  EXPECT_EQ(Wrong("RAPID/FAST"), "t.cls:1:7: error: 'FAST' is not known in RAPID");
  EXPECT_EQ(Wrong("SPINDL/RPM,1000,CLW,TURBO"),
            "t.cls:1:21: error: 'TURBO' is not known in SPINDL");
  EXPECT_EQ(Wrong("SPINDL/RPM,CLW"), "t.cls:1:1: error: SPINDL without a speed above 0");
  EXPECT_EQ(Wrong("LOAD/TOOL,1.5"),
            "t.cls:1:11: error: a tool number of LOAD should be a whole number from 0 to 99999999");
  EXPECT_EQ(Wrong("CYCLE/MILL,DEPTH,1"), "t.cls:1:7: error: 'MILL' is no cycle that is known");
  EXPECT_EQ(Wrong("CYCLE/DRILL,RAPTO,3"), "t.cls:1:1: error: CYCLE without FEDTO or DEPTH");
  EXPECT_EQ(Wrong("CYCLE/DRILL,RAPTO,3,FEDTO,-2,CAM,1"),
            "t.cls:1:30: error: 'CAM' is not known in CYCLE");
  EXPECT_EQ(Wrong("FEDRAT/MMPM"), "t.cls:1:1: error: FEDRAT without a feed rate");
  EXPECT_EQ(Wrong("UNITS/CM"), "t.cls:1:7: error: UNITS knows MM and INCHES");
  EXPECT_EQ(Wrong("CUTCOM/UP"), "t.cls:1:8: error: CUTCOM knows LEFT, RIGHT, ON and OFF");
  EXPECT_EQ(Wrong("COOLNT/HOT"), "t.cls:1:8: error: 'HOT' is not known in COOLNT");
  EXPECT_EQ(Wrong("CIRCLE/0,0,0,0,0,1,5,TIMES,0"),
            "t.cls:1:28: error: TIMES of CIRCLE should be a whole number from 1 to 10000");
}

TEST(ClWordsTest, AreInOrderAndSayWhatTheyAre) {
  const std::span<const ClWord> words = ClWords();
  EXPECT_TRUE(std::is_sorted(words.begin(), words.end(),
                             [](const ClWord& a, const ClWord& b) { return a.major < b.major; }));
  for (const ClWord& word : words) {
    EXPECT_EQ(FindClWord(word.major), &word);
    EXPECT_FALSE(word.meaning.empty()) << word.major;
    EXPECT_EQ(word.parse != nullptr, word.use == ClWord::Use::kRead) << word.major;
  }
  EXPECT_EQ(FindClWord(""), nullptr);
  EXPECT_EQ(FindClWord("ZZZ"), nullptr);
}

TEST(ClWordsTest, TheDocumentHasTheTable) {
  std::ifstream file(std::string(NCSIM_SOURCE_DIR) + "/docs/cl-files.md");
  std::stringstream text;
  text << file.rdbuf();
  std::string table = "| word | what is done | meaning |\n|---|---|---|\n";
  for (const ClWord& word : ClWords()) {
    table += "| " + std::string(word.major) + " | " + std::string(ToString(word.use)) + " | " +
             std::string(word.meaning) + " |\n";
  }
  EXPECT_NE(text.str().find(table), std::string::npos) << table;
}

}  // namespace
}  // namespace ncsim::post
