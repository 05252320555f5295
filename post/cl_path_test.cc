// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "post/test_cl.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// As NX writes a blade of an impeller: i, j, k stay until they are named again.
constexpr const char* kBlade =
    "TOOL PATH/BLADE,TOOL,BALL10\nTLDATA/MILL,10.0,5.0,35.0,0.0,0.0\n"
    "MSYS/0.0,0.0,15.1884,1.0,0.0,0.0,0.0,1.0,0.0\n$$ centerline data\nPAINT/PATH\n"
    "LOAD/TOOL,1,ADJUST,2\nRAPID\nGOTO/54.0,-0.36,-14.9,0.8450443,0.1657414,0.5083600\n"
    "FEDRAT/MMPM,250.0\nGOTO/52.2507,-0.7056,-16.244\nEND-OF-PATH\n";

TEST(ClPathTest, AnOperationOfNx) {
  const ClRun run = RunCl(kBlade, ClOptions{});
  EXPECT_THAT(run.messages(), IsEmpty());
  const auto motions = run.motions();
  ASSERT_EQ(motions.size(), 2u);
  EXPECT_TRUE(motions[0].rapid);
  EXPECT_FALSE(motions[0].start) << "after a tool change";
  EXPECT_FALSE(motions[1].rapid) << "RAPID is for one motion";
  EXPECT_NEAR(motions[1].feed.value, 250.0 / 60.0, 1e-12);
  EXPECT_EQ(motions[1].end.axis_M, motions[0].end.axis_M);
  EXPECT_NEAR(motions[1].end.axis_M.norm(), 1.0, 1e-15);
  EXPECT_EQ(motions[1].start->tip_M, Vector3d(54.0, -0.36, -14.9));

  // The event of the operation knows its MSYS, though that stands after it.
  const ClEvent& begin = run.events.front();
  ASSERT_TRUE(std::holds_alternative<ClOperationBegin>(begin.what));
  EXPECT_EQ(begin.where.line, 1);
  EXPECT_EQ(begin.modal->operation->name, "BLADE");
  EXPECT_EQ(begin.modal->operation->X_AM->translation(), Vector3d(0, 0, 15.1884));
  const ClTool& tool = *run.events.back().modal->tool;
  EXPECT_EQ(*tool.number, 1);
  EXPECT_EQ(*tool.length_register, 2);
  EXPECT_EQ(tool.name, "BALL10");
  EXPECT_EQ(*tool.diameter, 10.0);
  EXPECT_EQ(*tool.corner_radius, 5.0);
  EXPECT_TRUE(std::holds_alternative<ClEnd>(run.events.back().what));
}

TEST(ClPathTest, PointsWithoutAnAxis) {
  const std::string body = "RAPID\nGOTO/0,0,9,1,0,0\nRAPID\nGOTO/0,0,8\n";
  EXPECT_EQ(RunNx(body).motions()[1].end.axis_M, Vector3d::UnitX());
  EXPECT_EQ(RunCreo(body).motions()[1].end.axis_M, Vector3d::UnitZ());
  EXPECT_EQ(RunSolidWorks(body).motions()[1].end.axis_M, Vector3d::UnitZ());
  EXPECT_THAT(RunCl(body + "FINI\n", ClFlavour::kApt).messages(),
              ElementsAre(HasSubstr("4:1: a point without a tool axis after a tilt depends on the "
                                    "system that wrote the file")));
  // An operation of NX begins upright.
  const ClRun two = RunNx(body + "END-OF-PATH\nTOOL PATH/B,TOOL,T\nRAPID\nGOTO/0,0,7\n");
  EXPECT_EQ(two.motions()[2].end.axis_M, Vector3d::UnitZ());
}

// NX help: "axis vector (assuming a clockwise direction)". Creo help: (0,0,1) is counter-clockwise.
TEST(ClPathTest, SenseOfACircle) {
  const std::string body = "FEDRAT/100,MMPM\nGOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n";
  EXPECT_NEAR(RunNx(body).motions()[1].arc->sweep, 1.5 * kPi, 1e-12);
  EXPECT_EQ(RunNx(body).motions()[1].arc->normal_M, -Vector3d::UnitZ());
  EXPECT_NEAR(RunCreo(body).motions()[1].arc->sweep, 0.5 * kPi, 1e-12);
  EXPECT_NEAR(RunSolidWorks(body).motions()[1].arc->sweep, 0.5 * kPi, 1e-12);
  EXPECT_THAT(RunCl(body + "FINI\n", ClFlavour::kApt).messages(),
              ElementsAre(HasSubstr("3:1: the sense of a CIRCLE depends on the system")));
}

TEST(ClPathTest, AListOfPointsOfCreo) {
  const ClRun run = RunCreo(
      "FEDRAT / 100, MMPM\nGOTO / 10,0,0\nCIRCLE / 0,0,0,0,0,-1,10\nGOTO / 0,-10,0\n-10,0,0\n"
      "0,10,0\n10,0,0\nGOTO / 20,0,0\n21,0,0\n22,0,0, 0,1,0\n");
  EXPECT_THAT(run.messages(), IsEmpty());
  const auto motions = run.motions();
  ASSERT_EQ(motions.size(), 5u) << "the points on the circle are no motions";
  EXPECT_NEAR(motions[1].arc->sweep, 2 * kPi, 1e-12);
  EXPECT_EQ(motions[1].arc->normal_M, -Vector3d::UnitZ());
  EXPECT_EQ(motions[1].end.tip_M, Vector3d(10, 0, 0));
  EXPECT_EQ(motions[3].end.tip_M, Vector3d(21, 0, 0));
  EXPECT_EQ(motions[4].end.axis_M, Vector3d::UnitY());
  EXPECT_THAT(RunCreo("RAPID\nGOTO / 1,0,0\n2,0,0\n").messages(),
              ElementsAre(HasSubstr("4:1: a list of points after RAPID")));
  EXPECT_THAT(RunCreo("GOTO / 1,0,0\nSTOP\n2,0,0\n").messages(),
              testing::Contains(HasSubstr("4:1: a line of numbers that follows no GOTO")));
}

TEST(ClPathTest, UnitsAndFeeds) {
  const ClRun inch = RunCl(
      "PARTNO/P\nUNITS/INCHES\n$$-> X / 1\nLOADTL/3, LENGTH, 2\nFEDRAT/10,IPM\nGOTO/1,2,3\n"
      "FEDRAT/0.01,IPR\nGOTO/1,2,4\nFEDRAT/0.02\nGOTO/1,2,5\nFEDRAT/60,MMPM\nGOTO/1,2,6\nFINI\n",
      ClOptions{});
  const auto motions = inch.motions();
  ASSERT_EQ(motions.size(), 4u);
  EXPECT_TRUE(motions[0].end.tip_M.isApprox(Vector3d(25.4, 50.8, 76.2)));
  EXPECT_NEAR(motions[0].feed.value, 254.0 / 60.0, 1e-12);
  EXPECT_NEAR(motions[1].feed.value, 0.254, 1e-15);
  EXPECT_TRUE(motions[1].feed.per_revolution);
  EXPECT_NEAR(motions[2].feed.value, 0.508, 1e-15) << "as the one before it, in the file's unit";
  EXPECT_NEAR(motions[3].feed.value, 1.0, 1e-15);
  EXPECT_NEAR(*inch.events.back().modal->tool->length, 50.8, 1e-12);
  EXPECT_THAT(inch.messages(),
              ElementsAre(HasSubstr("warning: points and feed rates are in different units: "
                                    "UNITS/INCHES at line 2, MMPM at line 11"),
                          HasSubstr("9:1: warning: a feed rate without a unit")));
}

TEST(ClPathTest, AUnitThatIsOpenIsAnError) {
  ClOptions options;
  options.need_tool = false;
  const std::string open = "PARTNO/P\nRAPID\nGOTO/1,2,3\nFINI\n";
  EXPECT_THAT(RunCl(open, options).messages(), ElementsAre(HasSubstr("neither UNITS nor")));
  options.unit = ClUnit::kInch;
  EXPECT_EQ(RunCl(open, options).motions()[0].end.tip_M.x(), 25.4);
  EXPECT_THAT(RunCl("UNITS/MM\n" + open, options).messages(),
              ElementsAre(HasSubstr("said to be in inch, the file has UNITS/MM at line 1")));
  const std::string two = "FEDRAT/MMPM,5\nFEDRAT/IPM,5\nGOTO/1,2,3\nFINI\n";
  EXPECT_THAT(RunCl(two, options).messages(), IsEmpty());
  options.unit.reset();
  EXPECT_THAT(RunCl(two, options).messages(),
              ElementsAre(HasSubstr("two units: MMPM at line 1, IPM at line 2")));
}

TEST(ClPathTest, HolesOfThreeSystems) {
  // NX: the depth is signed; AUTO is the level before the cycle.
  const ClRun nx = RunNx(
      "RAPID\nGOTO/0,0,50\nCYCLE/DRILL,RAPTO,3.,FEDTO,-33.,RTRCTO,AUTO,MMPM,240.\n"
      "GOTO/66,0,20\nGOTO/70,0,30\nCYCLE/OFF\nFEDRAT/MMPM,60\nGOTO/70,0,60\n");
  EXPECT_THAT(nx.messages(), IsEmpty());
  ASSERT_EQ(nx.holes().size(), 2u);
  const ClHole first = nx.holes()[0];
  EXPECT_EQ(first.cycle->clearance, 3.0);
  EXPECT_EQ(first.cycle->bottom, -33.0);
  EXPECT_EQ(first.cycle->feed.value, 4.0);
  EXPECT_EQ(first.level, ClHole::Level::kInitial);
  EXPECT_EQ(first.retract, 30.0);
  EXPECT_EQ(nx.holes()[1].retract, 20.0);
  EXPECT_EQ(nx.holes()[1].start->tip_M, Vector3d(66, 0, 50));
  EXPECT_EQ(nx.motions()[1].start->tip_M, Vector3d(70, 0, 50)) << "where the cycle leaves it";
  EXPECT_EQ(nx.All<ClCycleOff>().size(), 1u);

  // Creo: the depth has no sign; without RETURN, the clearance.
  const ClRun creo = RunCreo(
      "CYCLE / DEEP, DEPTH, 20, STEP, 5, MMPM, 100, CLEAR, 2\nGOTO / 0,0,10\nCYCLE / OFF\n");
  EXPECT_THAT(creo.messages(), IsEmpty());
  EXPECT_EQ(creo.holes()[0].cycle->bottom, -20.0);
  EXPECT_EQ(creo.holes()[0].retract, 2.0);
  EXPECT_FALSE(creo.holes()[0].start);
  EXPECT_THAT(creo.holes()[0].cycle->steps, ElementsAre(5.0));
  EXPECT_THAT(RunCreo("CYCLE/DRILL,DEPTH,-2,MMPM,100,CLEAR,2\nGOTO/0,0,10\nCYCLE/OFF\n").messages(),
              ElementsAre("2:1: the depth of a CYCLE should not be negative"));

  // SolidWorks CAM, along a tilted tool.
  const ClRun solidworks = RunSolidWorks(
      "RAPID/\nGOTO/-25,25,-30,-1,0,0\nCYCLE/INIT\n"
      "CYCLE/DEEP2,FEDTO,54.9527,1STPECK,5.,SUBPECK,2.,MMPM,60,RAPTO,3.,RTRCTO,25.\n"
      "GOTO/0,25,-30,-1,0,0\nCYCLE/OFF\nRAPID/\nGOTO/-25,0,0,-1,0,0\n");
  EXPECT_THAT(solidworks.messages(), IsEmpty());
  EXPECT_EQ(solidworks.holes()[0].cycle->bottom, -54.9527);
  EXPECT_EQ(solidworks.motions()[1].start->tip_M, Vector3d(-25, 25, -30));
  EXPECT_THAT(
      RunCl("CYCLE/DRILL,FEDTO,5,RAPTO,2,MMPM,9\nGOTO/0,0,1\nCYCLE/OFF\nFINI\n", ClFlavour::kApt)
          .messages(),
      ElementsAre(HasSubstr("1:1: the sign of a CYCLE's depth depends on the system")));
}

TEST(ClPathTest, ModalFacts) {
  const ClRun run = RunNx(
      "SPINDL/RPM,1000,CCLW\nCOOLNT/FLOOD\nCUTCOM/LEFT,4,XYPLAN\nRAPID\nGOTO/0,0,5\nSPINDL/OFF\n"
      "CUTCOM/OFF\nSPINDL/ON\nCUTCOM/ON\nRAPID\nGOTO/0,0,6\n");
  EXPECT_THAT(run.messages(), IsEmpty());
  int motions = 0;
  for (const ClEvent& event : run.events) {
    if (!std::holds_alternative<ClMotion>(event.what)) continue;
    ++motions;
    EXPECT_EQ(event.modal->spindle.mode, cl::Spindle::Mode::kRpm);
    EXPECT_EQ(event.modal->spindle.speed, 1000.0);
    EXPECT_EQ(event.modal->spindle.clockwise, false);
    EXPECT_EQ(event.modal->coolant.mode, cl::Coolant::Mode::kFlood);
    EXPECT_EQ(event.modal->comp.side, cl::CutterComp::Side::kLeft);
    EXPECT_EQ(*event.modal->comp.diameter_register, 4);
  }
  EXPECT_EQ(motions, 2);
  EXPECT_EQ(run.All<cl::Spindle>()[1].mode, cl::Spindle::Mode::kOff);
}

TEST(ClPathTest, PlacesThatAreNoMotion) {
  const ClRun run = RunNx(
      "FROM/1,2,3,0,0,1\nRAPID\nGODLTA/0,0,5\nRAPID\nGODLTA/-2\nGOHOME/9,9,9\nDELAY/1.5\n"
      "GOHOME\nRAPID\nGOTO/0,0,0\n");
  EXPECT_THAT(run.messages(), IsEmpty());
  const auto motions = run.motions();
  ASSERT_EQ(motions.size(), 4u);
  EXPECT_EQ(motions[0].start->tip_M, Vector3d(1, 2, 3));
  EXPECT_EQ(motions[0].end.tip_M, Vector3d(1, 2, 8));
  EXPECT_EQ(motions[1].end.tip_M, Vector3d(1, 2, 6));
  EXPECT_TRUE(motions[2].rapid && motions[2].home);
  EXPECT_FALSE(motions[3].start) << "GOHOME without a point leaves it open";
  EXPECT_EQ(run.All<ClDwell>()[0].value, 1.5);
}

TEST(ClPathTest, ASetupOfSolidWorksBeginsAnOperation) {
  const ClRun run = RunSolidWorks(
      "CSYS/0,0,-1.,0,-1.,0,0,0,0,1.,0,0\nRAPID/\nGOTO/0,0,9,-1,0,0\n"
      "CSYS/1,0,0,5,0,1,0,0,0,0,1,0\nRAPID/\nGOTO/0,0,9\n");
  EXPECT_THAT(run.messages(), IsEmpty());
  ASSERT_EQ(run.All<ClOperationBegin>().size(), 2u);
  EXPECT_EQ(run.events.back().modal->operation->index, 2);
  EXPECT_EQ(run.events.back().modal->operation->setup->translation(), Vector3d(5, 0, 0));
  // Its Z axis is that of the tool.
  EXPECT_EQ(run.events[1].modal->operation->setup->linear().col(2), -Vector3d::UnitX());
  EXPECT_THAT(RunSolidWorks("CSYS/1,0,0,0,0,1,0,0,0,0,-1,0\nRAPID/\nGOTO/0,0,9\n").messages(),
              ElementsAre("2:1: the rows of CSYS are no rotation"));
}

TEST(ClPathTest, AnotherMsysLeavesThePlaceOpen) {
  const std::string first = "MSYS/0,0,0,1,0,0,0,1,0\nRAPID\nGOTO/0,0,5\nEND-OF-PATH\n";
  const auto start = [&](const std::string& msys) {
    const ClRun run = RunNx(first + "TOOL PATH/B,TOOL,T\n" + msys + "RAPID\nGOTO/0,0,6\n");
    EXPECT_THAT(run.messages(), IsEmpty());
    return run.motions()[1].start.has_value();
  };
  EXPECT_TRUE(start(""));
  EXPECT_TRUE(start("MSYS/0,0,0,1,0,0,0,1,0\n"));
  EXPECT_FALSE(start("MSYS/0,0,1,1,0,0,0,1,0\n"));
  EXPECT_THAT(RunNx("MSYS/0,0,0,1,0,0,1,0,0\nRAPID\nGOTO/0,0,5\n").messages(),
              ElementsAre(HasSubstr("2:1: the axes of MSYS are not of length 1 and square")));
}

TEST(ClPathTest, Tools) {
  ClOptions options;
  options.unit = ClUnit::kMillimetre;
  const std::string without =
      "TOOL PATH/A,TOOL,T\nRAPID\nGOTO/0,0,5\nRAPID\nGOTO/0,0,6\nEND-OF-PATH\n";
  EXPECT_THAT(RunCl(without, options).messages(),
              ElementsAre("3:1: a motion, and no tool is loaded: LOAD/TOOL or LOADTL is missing"));
  options.first_tool = 7;
  const ClRun given = RunCl(without, options);
  EXPECT_THAT(given.messages(), IsEmpty());
  EXPECT_EQ(given.All<ClToolLoad>().size(), 1u);
  EXPECT_EQ(*given.events.back().modal->tool->number, 7);
  EXPECT_EQ(given.events.back().modal->tool->name, "T");
  EXPECT_THAT(
      RunCl(without + "TOOL PATH/B,TOOL,U\nRAPID\nGOTO/0,0,5\nEND-OF-PATH\n", options).messages(),
      ElementsAre("9:1: the operation uses the tool 'U' and loads none, with 'T' in the spindle"));
  // The same tool again is no change: where it stands is still known.
  const ClRun again = RunCl(
      "TOOL PATH/A,TOOL,T\nLOAD/TOOL,1\nRAPID\nGOTO/0,0,5\nLOAD/TOOL,1\nRAPID\nGOTO/0,0,6\n"
      "LOAD/TOOL,2\nRAPID\nGOTO/0,0,7\nEND-OF-PATH\n",
      options);
  EXPECT_TRUE(again.motions()[1].start);
  EXPECT_FALSE(again.motions()[2].start);
  EXPECT_FALSE(again.All<ClToolLoad>()[1].change);
}

// Creo prints CUTTER after LOADTL, SolidWorks CAM before LOAD.
TEST(ClPathTest, TheShapeOfATool) {
  const ClRun creo = RunCreo("LOADTL / 2\n$$-> CUTTER / 6.0\nRAPID\nGOTO / 0,0,5\n");
  EXPECT_EQ(*creo.events.back().modal->tool->diameter, 6.0);
  const ClRun solidworks = RunSolidWorks(
      "CUTTER/14.,0.5,7.,0,0,0,84.\nLOAD/TOOL,1\nRAPID\nGOTO/0,0,5\nCUTTER/3.\nLOAD/TOOL,2\n"
      "RAPID\nGOTO/0,0,5\n");
  std::vector<double> diameters;
  for (const ClEvent& event : solidworks.events) {
    if (std::holds_alternative<ClMotion>(event.what)) {
      diameters.push_back(*event.modal->tool->diameter);
    }
  }
  EXPECT_THAT(diameters, ElementsAre(14.0, 3.0));
}

TEST(ClPathTest, FlavoursThatContradict) {
  ClOptions options;
  options.need_tool = false;
  const std::string text = "UNITS/MM\nPPWORD/A,1\nTRNTYP/WORLD,0,0,0\nRAPID\nGOTO/1,2,3\nFINI\n";
  EXPECT_THAT(RunCl(text, options).messages(),
              ElementsAre(HasSubstr("words of two systems: PPWORD at line 2, TRNTYP at line 3")));
  options.flavour = ClFlavour::kCreo;
  EXPECT_THAT(RunCl(text, options).messages(), IsEmpty());
}

TEST(ClPathBadInputTest, CutFiles) {
  EXPECT_THAT(RunCl("TOOL PATH/A,TOOL,T\nRAPID\nGOTO/1,2,3\n", ClFlavour::kNx).messages(),
              ElementsAre("3:1: the file ends inside the operation 'A': END-OF-PATH is missing"));
  EXPECT_THAT(RunCl("RAPID\nGOTO/1,2,3\nEND-OF-PATH\n", ClFlavour::kNx).messages(),
              ElementsAre("2:1: a motion outside of TOOL PATH and END-OF-PATH",
                          "3:1: END-OF-PATH without its TOOL PATH"));
  EXPECT_THAT(RunCl("RAPID\nGOTO/1,2,3\n", ClFlavour::kCreo).messages(),
              ElementsAre("2:1: the file ends without FINI"));
  EXPECT_THAT(RunCreo("RAPID\nGOTO/1,2,3\nFEDRAT/9,MMPM\nCIRCLE/0,2,3,0,0,1,1\n").messages(),
              ElementsAre("5:1: no GOTO follows the CIRCLE"));
  EXPECT_THAT(RunCreo("").messages(), ElementsAre(HasSubstr("a file without a motion")));
  EXPECT_THAT(RunCreo("RAPID\nGOTO/1,2,3\nFINI\nRAPID\n").messages(),
              ElementsAre("5:1: a statement after FINI: what follows is not read"));
}

TEST(ClPathBadInputTest, BinaryFiles) {
  // Without NUL bytes, which nc::Program refuses, it is a text of unknown statements.
  std::string bytes;
  for (int i = 0; i < 20'000; ++i) bytes += static_cast<char>(1 + (i * 7919 + i / 255) % 255);
  const ClRun run = RunCl(bytes, ClOptions{});
  EXPECT_TRUE(run.motions().empty());
  EXPECT_TRUE(run.diagnostics.has_errors());
  const std::string path = testing::TempDir() + "ncsim_cl_path_test.cls";
  std::ofstream(path, std::ios::binary) << "TOOL PATH/A,TOOL,T\n" << std::string(3, '\0');
  Diagnostics diagnostics;
  EXPECT_EQ(nc::Program::Load(path, &diagnostics), nullptr);
  EXPECT_THAT(ToString(diagnostics.all().front()), HasSubstr(":2: error: is not a text"));
  std::filesystem::remove(path);
}

TEST(ClPathBadInputTest, AxesThatAreNone) {
  for (const char* axis : {"0,0,0", "0,0,2", "0.8,0.8,0.8"}) {
    const ClRun run = RunNx("RAPID\nGOTO/1,2,3," + std::string(axis) + "\n");
    EXPECT_THAT(run.messages()[0], HasSubstr("3:1: the tool axis has the length")) << axis;
  }
  EXPECT_THAT(RunNx("RAPID\nGOTO/1,2,3,0,0,2\n").messages()[0],
              "3:1: the tool axis has the length 2, not 1");
  // Four decimals are enough.
  EXPECT_THAT(RunNx("RAPID\nGOTO/1,2,3,0.5774,0.5774,0.5773\n").messages(), IsEmpty());
  EXPECT_THAT(RunNx("FEDRAT/MMPM,9\nGOTO/1,2,3\nCIRCLE/0,2,3,0,0,0,1\nGOTO/1,2,3\n").messages()[0],
              "4:1: the axis of the CIRCLE has the length 0, not 1");
}

TEST(ClPathBadInputTest, CirclesThatAreNone) {
  const std::string begin = "FEDRAT/MMPM,9\nGOTO/10,0,0\n";
  EXPECT_THAT(RunNx(begin + "CIRCLE/0,0,0,0,0,1,10\nGOTO/0,12,0\n").messages()[0],
              HasSubstr("5:1: the circle does not meet its end"));
  EXPECT_THAT(RunNx(begin + "CIRCLE/0,0,0,0,0,1,9\nGOTO/0,10,0\n").messages()[0],
              HasSubstr("5:1: the circle does not meet its start"));
  EXPECT_THAT(RunNx(begin + "RAPID\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n").messages()[0],
              HasSubstr("5:1: RAPID before a CIRCLE"));
  EXPECT_THAT(RunNx("FEDRAT/MMPM,9\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n").messages()[0],
              HasSubstr("3:1: CIRCLE, and where the tool stands is not known"));
  EXPECT_EQ(RunNx(begin + "CIRCLE/0,0,0,0,0,1,10\nGOTO/0,12,0\n").motions().size(), 1u)
      << "no arc is made of it";
}

TEST(ClPathBadInputTest, FeedsAndRapids) {
  EXPECT_THAT(RunNx("GOTO/1,2,3\nGOTO/1,2,4\n").messages(),
              ElementsAre("2:1: a feed motion without a feed rate: FEDRAT is missing"));
  EXPECT_THAT(RunNx("FEDRAT/MMPM,0\nRAPID\nGOTO/1,2,3\n").messages(),
              ElementsAre("2:1: a feed rate should be greater than 0"));
  EXPECT_THAT(RunNx("RAPID\nFEDRAT/MMPM,5\nGOTO/1,2,3\n").messages(),
              ElementsAre(HasSubstr("3:1: FEDRAT between RAPID and its motion")));
  EXPECT_THAT(RunNx("RAPID\nGOTO/1,2,3\nRAPID\n").messages(),
              ElementsAre("5:1: an operation ends after RAPID, before its motion"));
  EXPECT_THAT(RunNx("GODLTA/1,2,3\nRAPID\nGOTO/1,2,3\n").messages(),
              ElementsAre("2:1: GODLTA, and where the tool stands is not known"));
}

TEST(ClPathBadInputTest, GivesUpAfterAHundredErrors) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "\x80\x81 \x07/\n";
  const ClRun run = RunNx(text);
  EXPECT_LE(run.diagnostics.all().size(), 110u);
  EXPECT_EQ(run.diagnostics.all().back().message, "too many errors: the rest is not read");
  EXPECT_EQ(run.messages()[0], "2:1: unknown statement '?? ?'");
}

}  // namespace
}  // namespace ncsim::post
