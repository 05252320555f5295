// SPDX-License-Identifier: BSD-3-Clause
// What a cutter-location file does, in order, with everything modal resolved: the seam between the
// reader and whoever plans motion from it (post) or holds motion against it (sim/compare).
//
// mm, s, rad. M: the coordinate system of the file's points (NX: MSYS). Poses are of the tool tip
// (the control point of the file) and the unit vector along the tool from the tip to the holder.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "post/cl_record.h"

namespace ncsim::post {

struct ClPose {
  Eigen::Vector3d tip_M = Eigen::Vector3d::Zero();    ///< mm
  Eigen::Vector3d axis_M = Eigen::Vector3d::UnitZ();  ///< Unit.
};

struct ClFeed {
  double value = 0.0;  ///< mm/s along the tip's path; mm per revolution.
  bool per_revolution = false;
};

/// What a file says of a tool. It need not say anything.
struct ClTool {
  std::optional<int> number;            ///< None: the file loads no tool (or has not yet).
  std::optional<int> length_register;   ///< ADJUST, OSETNO.
  std::optional<double> length;         ///< LENGTH of LOADTL, mm.
  std::string name;                     ///< NX: of TOOL PATH.
  std::string kind;                     ///< "MILL", "DRILL,MILL", "CUTTER"; "" where not stated.
  std::optional<double> diameter;       ///< mm
  std::optional<double> corner_radius;  ///< mm
  std::vector<double> values;           ///< Of TLDATA or CUTTER, in the file's unit.
};

struct ClOperation {
  int index = 0;     ///< From 1; 0 for what stands before the first.
  std::string name;  ///< NX: of TOOL PATH; Creo: "FEATNO n"; else "".
  SourcePosition where;
  /// NX: pose of M in the absolute system of the part model. Operations may differ in it.
  std::optional<Eigen::Isometry3d> X_AM;
  /// SolidWorks CAM, Creo: the directions of the set-up in M, its Z axis that of the tool. Of its
  /// offset only that it differs between set-ups is known.
  std::optional<Eigen::Isometry3d> setup;
};

/// The modal facts of an event. Immutable, shared until one of them changes.
struct ClModal {
  std::shared_ptr<const ClTool> tool;            ///< Never null.
  std::shared_ptr<const ClOperation> operation;  ///< Never null.
  cl::Spindle spindle;                           ///< `clockwise` has a value unless off or locked.
  cl::Coolant coolant;
  cl::CutterComp comp;
};

/// A circle or helix. The tip goes from the motion's start to its end about the line through
/// `centre_M` along `normal_M`, by the right hand; its distance along the normal goes linearly with
/// the angle.
struct ClArc {
  Eigen::Vector3d centre_M = Eigen::Vector3d::Zero();   ///< In the plane of the start.
  Eigen::Vector3d normal_M = Eigen::Vector3d::UnitZ();  ///< Unit; the sense is in it.
  double radius = 0.0;  ///< At the start; the end's differs by at most kClArcTolerance.
  double sweep = 0.0;   ///< rad, > 0; more than 2 pi for a helix of several turns.
  double rise = 0.0;    ///< mm along the normal, from start to end.
};

/// How far the ends of an arc may lie off its circle: files are printed with four decimals, some in
/// inches.
inline constexpr double kClArcTolerance = 0.005;  // mm

struct ClMotion {
  bool rapid = false;
  bool home = false;            ///< GOHOME; a rapid.
  std::optional<ClPose> start;  ///< None: not known (start of the file, after a tool change).
  ClPose end;
  std::optional<ClArc> arc;  ///< None: a straight line. Never of a rapid.
  ClFeed feed;               ///< Of feeds.
};

/// The cycle of a hole. Distances are along the tool axis from the point of the hole, positive away
/// from the part.
struct ClHoleCycle {
  ClCycleKind kind = ClCycleKind::kDrill;
  double clearance = 0.0;  ///< mm: where rapid ends and feed begins.
  double bottom = 0.0;     ///< mm: where the feed ends; below `clearance`.
  ClFeed feed;
  std::vector<double> steps;  ///< mm: of pecks; the last one is repeated.
  double dwell = 0.0;         ///< At the bottom: s, or revolutions.
  bool dwell_in_revolutions = false;
  std::optional<double> sink_diameter;  ///< mm
  SourcePosition where;                 ///< Of its CYCLE statement.
};

/// One hole of a cycle: rapid to the clearance plane above the point, the cycle, rapid (or as the
/// kind says) out to `retract`.
struct ClHole {
  std::shared_ptr<const ClHoleCycle> cycle;
  std::optional<ClPose> start;  ///< As ClMotion::start.
  ClPose point;
  double retract = 0.0;  ///< mm along the axis from the point: where the tool is afterwards.
  enum class Level : std::uint8_t {
    kClearance,  ///< No more than the clearance plane (G99).
    kInitial,    ///< The level before the cycle (G98). Where that is not known, `retract` is the
                 ///< clearance.
    kDistance,   ///< The distance that the file names.
  } level = Level::kClearance;
};
/// The cycle ends.
struct ClCycleOff {};

/// A new operation begins, and with it the one before ends: ClModal::operation. (SolidWorks CAM and
/// Creo load its tool before it.)
struct ClOperationBegin {};
/// NX says so.
struct ClOperationEnd {};
/// The tool of ClModal::tool is to be in the spindle. (Creo says its shape only afterwards: that of
/// the first motion's ClModal is complete.)
struct ClToolLoad {
  bool change =
      true;  ///< Another one was there, or none: where the next motion starts is not known.
};
/// FROM: the tool stands there.
struct ClPosition {
  ClPose pose;
};
/// GOHOME without a point: where the tool is afterwards is not known.
struct ClHome {
  std::string words;
};
struct ClDwell {
  double value = 0.0;  ///< s, or revolutions.
  bool revolutions = false;
};
/// FINI, or the end of the text.
struct ClEnd {};

struct ClEvent {
  SourcePosition where;
  std::shared_ptr<const ClModal> modal;  ///< Never null; after what the event changes.
  /// Spindle, Coolant, CutterComp: what ClModal has now. The others of cl:: as written.
  std::variant<ClMotion, ClHole, ClCycleOff, ClOperationBegin, ClOperationEnd, ClToolLoad,
               cl::SelectTool, ClPosition, ClHome, cl::Spindle, cl::Coolant, cl::CutterComp,
               ClDwell, cl::Code, cl::Stop, cl::Text, cl::PostWord, ClEnd>
      what;
};

}  // namespace ncsim::post
