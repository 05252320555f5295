// SPDX-License-Identifier: BSD-3-Clause
// What a machine is to do, in order: the seam between the planner, which knows kinematics and no
// text, and the writer, which knows words and no kinematics.
//
// mm, s, rad. P: the program's part frame, riding on the table: the coordinate system of the file's
// first operation, which the work offset places. Program coordinates are what X, Y, Z are to say in
// the mode that is on:
//   kTcp      the tip in P
//   kIndexed  the tip in P's directions as the rotary axes have turned them, from P's zero (Haas
//             G254), or in the plane's own directions (CYCLE800): PlanIndex says which
//   kAxes     the tip along the linear axes from the rotary centre, which is program zero
//
// Rotary values are on the control's grid, and program coordinates follow from these, so that what
// is lost in rounding a rotary word is made good in the linear ones. They are not rounded
// themselves.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "post/cl_event.h"

namespace ncsim::post {

enum class PlanMode : std::uint8_t { kIndexed, kTcp, kAxes };

struct PlanPose {
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero();      ///< Program coordinates.
  std::array<double, 2> rotary{};                     ///< In FiveAxis::rotary() order, unwound.
  Eigen::Vector3d axis_P = Eigen::Vector3d::UnitZ();  ///< Of the file, not of the rounded rotary.
};

/// The normal of the plane of arcs and cycles, in program coordinates.
enum class PlanPlane : std::uint8_t { kXY, kZX, kYZ };  // G17, G18, G19

/// An arc or helix in a plane of the program coordinates.
struct PlanArc {
  PlanPlane plane = PlanPlane::kXY;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< In the plane of the start.
  bool clockwise = false;                            ///< Against the plane's positive normal.
  int turns = 0;  ///< Whole turns before the one that ends at the end; a circle has 0.
  double radius = 0.0;
};

struct PlanMove {
  bool rapid = false;
  PlanPose end;
  std::optional<PlanArc> arc;  ///< Feeds only.
  ClFeed feed;                 ///< Of the tip, as the file has it. Feeds only.
  double time = 0.0;           ///< s that the feed takes; 0 for feeds per revolution.
  /// The move ends at a point of the file; false for points that the planner put in between.
  bool of_file = true;
};

/// Rotary axes go to where the next motions need them, the tool being clear of the part: the
/// machine retracts, turns, and comes back above the point `approach`.
struct PlanIndex {
  std::array<double, 2> rotary{};
  PlanMode mode = PlanMode::kIndexed;
  /// The turned plane in P: its directions in columns. kTcp: those of the machine, as the rotary
  /// axes have turned P under them. Not of kAxes.
  Eigen::Matrix3d plane_P = Eigen::Matrix3d::Identity();
  /// The first pose of the motions that follow. kRewind: `retract` above where the feed goes on;
  /// the moves out to there and back are steps of their own.
  PlanPose approach;
  enum class Why : std::uint8_t {
    kOperation,  ///< An operation begins, with its tool in the spindle.
    kAxis,       ///< A rapid of the file changes the tool axis.
    kRewind,     ///< A rotary axis is at its limit, or the other branch goes on: in a feed.
  } why = Why::kOperation;
  /// kRewind: mm along the tool axis.
  double retract = 0.0;
};

/// One hole, in program coordinates; the cycle's plane is that of the tool axis.
struct PlanHole {
  ClHole hole;  ///< Distances along the axis.
  PlanPose point;
  PlanPlane plane = PlanPlane::kXY;
  bool negative = false;  ///< The tool axis points against the plane's normal.
};

struct PlanOperation {
  PlanMode mode = PlanMode::kIndexed;
  bool tool_change = false;
  std::optional<int> next_tool;  ///< The tool of the next operation that has another one.
};

struct PlanEnd {};

struct PlanStep {
  SourcePosition where;                  ///< In the CL file.
  std::shared_ptr<const ClModal> modal;  ///< Never null.
  std::variant<PlanMove, PlanHole, ClCycleOff, PlanOperation, ClOperationEnd, PlanIndex, ClHome,
               cl::Spindle, cl::Coolant, cl::CutterComp, ClDwell, cl::Code, cl::Stop, cl::Text,
               cl::PostWord, PlanEnd>
      what;
};

/// Takes steps in order.
class PlanSink {
 public:
  virtual ~PlanSink() = default;
  virtual void OnStep(const PlanStep& step) = 0;
};

}  // namespace ncsim::post
