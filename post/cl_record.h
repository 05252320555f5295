// SPDX-License-Identifier: BSD-3-Clause
// The statements of a cutter-location file as they are written: lengths, feeds and signs are the
// file's own. cl_event.h has the same in mm, s, rad with everything modal resolved.
//
// Sources: NX help, "CLSF Manager"; Creo help, "CL Output for Circular Interpolation"; the G-POST
// vocabulary that Creo prints into its files (PPWORD); ANSI X3.37 (APT).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/base/finding.h"

namespace ncsim::post {

enum class ClUnit : std::uint8_t { kMillimetre, kInch };

/// Of a feed rate.
enum class ClFeedUnit : std::uint8_t {
  kMmPerMinute,    ///< MMPM
  kInchPerMinute,  ///< IPM
  kMmPerRev,       ///< MMPR
  kInchPerRev,     ///< IPR
  kPerMinute,      ///< PERMIN: in the unit of the file.
  kPerRev,         ///< PERREV
};

/// What a hole cycle does below the clearance plane.
enum class ClCycleKind : std::uint8_t {
  kDrill,        ///< DRILL: feed to the bottom, rapid out.
  kFace,         ///< FACE: dwell at the bottom, rapid out.
  kCounterSink,  ///< CSINK
  kDeep,         ///< DEEP, DEEP2: pecks, each with a retract to the clearance plane.
  kBreakChip,    ///< BRKCHP: pecks with a short retract.
  kTap,          ///< TAP: out with the spindle reversed.
  kReam,         ///< REAM: out at the feed.
  kBore,         ///< BORE: out at the feed.
  kBoreDrag,     ///< BORE,DRAG: the spindle stops, out in rapid.
  kBoreNoDrag,   ///< BORE,NODRAG: the spindle stops in position, the tool steps aside, rapid out.
  kBoreBack,     ///< BORE,BACK
  kBoreManual,   ///< BORE,MANUAL
  kThru,         ///< THRU: through several walls.
};

namespace cl {

using Vector3 = Eigen::Vector3d;

/// TOOL PATH/operation,TOOL,tool (NX), `$$-> FEATNO / n` (Creo).
struct OperationBegin {
  std::string name;
  std::string tool;
};
/// END-OF-PATH
struct OperationEnd {};
/// TLDATA/MILL,d,r,length,taper,tip; TLDATA/DRILL,MILL,...; CUTTER/d,r,...; `$$-> CUTTER / d`.
struct ToolShape {
  std::string kind;  ///< "MILL", "DRILL,MILL", ...; "CUTTER" for the seven APT values.
  std::vector<double> values;
};
/// MSYS: origin, X and Y axes of the coordinate system of all points that follow, in the absolute
/// system of the part model.
struct Msys {
  Vector3 origin, x, y;
};
/// CSYS (SolidWorks CAM), `$$-> CSYS` (Creo): three rows of a rotation and an offset each. Tells
/// which way a set-up lies; the points that follow are not in it.
struct Csys {
  std::array<double, 12> rows{};
};
/// LOAD/TOOL,n[,ADJUST,a], LOADTL/n[,OSETNO,h][,LENGTH,l], TURRET/n[,...]
struct LoadTool {
  int number = 0;
  std::optional<int> length_register;
  std::optional<double> length;
};
/// SELECT/TOOL,n: the next one is brought to the changer.
struct SelectTool {
  int number = 0;
};
/// RAPID: the next motion only.
struct Rapid {};
struct Feed {
  double value = 0.0;
  std::optional<ClFeedUnit> unit;
};
/// GOTO/x,y,z[,i,j,k]
struct Goto {
  Vector3 point;
  std::optional<Vector3> axis;
};
/// A line of numbers alone: one more point of the GOTO before it (Creo).
struct Point {
  Vector3 point;
  std::optional<Vector3> axis;
};
/// GODLTA/dx,dy,dz; GODLTA/d goes along the tool axis.
struct GoDelta {
  Vector3 delta;
  std::optional<double> along_axis;
};
/// FROM/x,y,z[,i,j,k]: where the tool stands; no motion.
struct From {
  Vector3 point;
  std::optional<Vector3> axis;
};
/// GOHOME[/x,y,z[,i,j,k]] or GOHOME/axis words.
struct GoHome {
  std::optional<Vector3> point;
  std::optional<Vector3> axis;
  std::string words;
};
/// CIRCLE/x,y,z,i,j,k[,r[,...]][,TIMES,n]
struct Circle {
  Vector3 centre, normal;
  std::optional<double> radius;
  std::optional<int> times;
};
struct Spindle {
  enum class Mode : std::uint8_t {
    kOff,      ///< SPINDL/OFF
    kOn,       ///< SPINDL/ON: as before.
    kRpm,      ///< SPINDL/RPM,n,CLW and SPINDL/n,RPM,CLW
    kSurface,  ///< SPINDL/SFM,n,CLW, SPINDL/SMM,n,CLW: constant surface speed.
    kLocked,   ///< SPINDL/LOCK[,angle]
  } mode = Mode::kOff;
  double speed = 0.0;             ///< 1/min; m/min for kSurface; degrees for kLocked.
  std::optional<bool> clockwise;  ///< CLW, CCLW; not stated: as before.
  std::string range;              ///< RANGE,n, LOW, MEDIUM, HIGH.
};
struct Coolant {
  enum class Mode : std::uint8_t {
    kOff,
    kOn,
    kFlood,
    kMist,
    kTap,
    kThrough,
    kAir
  } mode = Mode::kOff;
};
struct CutterComp {
  enum class Side : std::uint8_t { kOff, kLeft, kRight, kOn } side = Side::kOff;
  enum class Plane : std::uint8_t { kUnstated, kXY, kYZ, kZX } plane = Plane::kUnstated;
  std::optional<int> diameter_register;  ///< The D number.
};
/// CYCLE/..., distances as written: whether a depth has a sign is the flavour's matter.
struct Cycle {
  ClCycleKind kind = ClCycleKind::kDrill;
  std::optional<double> clearance;  ///< RAPTO, CLEAR
  std::optional<double> depth;      ///< FEDTO, DEPTH
  enum class Retract : std::uint8_t {
    kUnstated,
    kAuto,      ///< RTRCTO,AUTO: to where the tool was before the cycle.
    kDistance,  ///< RTRCTO,d; RETURN,d
  } retract = Retract::kUnstated;
  double retract_distance = 0.0;
  std::optional<Feed> feed;
  std::vector<double> steps;    ///< STEP, INCR, PECK; 1STPECK and SUBPECK.
  std::optional<double> dwell;  ///< DWELL: s, or revolutions.
  bool dwell_in_revolutions = false;
  std::optional<double> sink_diameter;  ///< CSINK,d
};
/// CYCLE/OFF, CYCLE/ON (the last one again), and SolidWorks CAM's CYCLE/INIT and CYCLE/CLEAR.
struct CycleSwitch {
  enum class What : std::uint8_t { kOff, kOn, kInit, kClear } what = What::kOff;
};
struct Delay {
  double value = 0.0;  ///< s, or revolutions.
  bool revolutions = false;
};
/// AUXFUN/m, PREFUN/g: a code of the machine.
struct Code {
  char letter = 'M';  ///< 'M' or 'G'.
  double number = 0.0;
  bool with_next = false;  ///< NEXT: in the next block.
};
struct Stop {
  bool optional_stop = false;  ///< OPSTOP
};
/// What has a meaning to people or to the site's own post.
struct Text {
  enum class Kind : std::uint8_t {
    kPartNo,
    kInsert,
    kPrint,
    kRemark,
    kLetter,
    kComment,
    kData
  } kind = Kind::kRemark;
  std::string text;
};
struct Units {
  ClUnit unit = ClUnit::kMillimetre;
};
/// MULTAX/ON, MULTAX/OFF: whether points carry tool axes.
struct MultiAxis {
  bool on = false;
};
/// FINI
struct End {};
/// Known and passed on as written: what it does is the post's matter, and a post that has no use
/// for it must say so (ROTATE, SET, SEQNO, OPSKIP, CLEARP, RETRCT, ...).
struct PostWord {
  std::string major;                ///< "ROTATE"
  std::vector<std::string> values;  ///< As written.
};
/// Known, and of no effect on the motion (PAINT, PPWORD, MACHIN, CAMERA, TRNTYP, CSI_SET_*).
struct Ignored {};
/// Not known, or not to be carried out. The reader has reported it.
struct Unknown {};

}  // namespace cl

using ClStatement =
    std::variant<cl::Unknown, cl::Ignored, cl::Goto, cl::Point, cl::Rapid, cl::Feed, cl::Circle,
                 cl::OperationBegin, cl::OperationEnd, cl::ToolShape, cl::Msys, cl::Csys,
                 cl::LoadTool, cl::SelectTool, cl::GoDelta, cl::From, cl::GoHome, cl::Spindle,
                 cl::Coolant, cl::CutterComp, cl::Cycle, cl::CycleSwitch, cl::Delay, cl::Code,
                 cl::Stop, cl::Text, cl::Units, cl::MultiAxis, cl::End, cl::PostWord>;

struct ClRecord {
  SourcePosition where;
  ClStatement statement;
};

}  // namespace ncsim::post
