// SPDX-License-Identifier: BSD-3-Clause
// Commands: a block's effect in PROGRAM coordinates (absolute; mm, rad), with every modal fact it
// needs. Later stages never read modal state, so a command may wait in the contour stage.
//
//   block -> Command -> contour stage (contour.h) -> frames and TCP (to_motion.h) -> motion::Motion
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "sim/base/finding.h"
#include "sim/motion/motion.h"

namespace ncsim::control {

enum AxisIndex { kX, kY, kZ, kA, kB, kC, kNumAxes };
/// X, Y, Z in mm; A, B, C in rad.
using AxisValues = std::array<double, kNumAxes>;
inline constexpr std::string_view kLetters = "XYZABC";
/// Bits by AxisIndex.
inline constexpr unsigned kLinearAxes = 1U << kX | 1U << kY | 1U << kZ;
inline constexpr unsigned kRotaryAxes = 1U << kA | 1U << kB | 1U << kC;

inline Eigen::Vector3d Linear(const AxisValues& values) {
  return {values[kX], values[kY], values[kZ]};
}

/// The plane of arcs, cycles and compensation: first, second and normal axis.
enum class Plane : std::uint8_t { kXY, kZX, kYZ };  // G17, G18, G19

/// How the axes share the time of a rapid.
enum class RapidMode : std::uint8_t {
  kIndependent,   ///< Each axis at its own rate; the block ends when all have arrived.
  kLinearXyz,     ///< X, Y, Z in a straight line, rotary axes independent.
  kLinearRotary,  ///< All arrive together.
};

/// How rotary axes go under TCP.
enum class Orientation : std::uint8_t {
  kAxes,    ///< In proportion.
  kVector,  ///< The tool axis on a great circle; rotary axes end where that leads.
};

/// Where program coordinates X, Y, Z lie in those of the work offset: an affine frame that turns,
/// scales and mirrors about a point (G68; TRANS, ROT, SCALE, MIRROR).
struct ProgramFrame {
  bool active = false;                                   ///< False: as if there were none.
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();  ///< Not singular.
  Eigen::Vector3d from = Eigen::Vector3d::Zero();        ///< A point in program coordinates ...
  Eigen::Vector3d to = Eigen::Vector3d::Zero();          ///< ... and where it lies.
};

/// What turns program coordinates into machine ones. Immutable; commands share it until a modal
/// change.
struct Frame {
  AxisValues offset{};       ///< Active work offset + G52 + G92 shift: machine values.
  int offset_index = 0;      ///< Index into the run's OffsetTable (motion::Facts::offset).
  double tool_length = 0.0;  ///< Along Z, signed: Haas G43 +H, G44 -H; SINUMERIK D.
  enum class Rotation : std::uint8_t {
    kNone,
    kDwo,
    kTcp
  } rotation = Rotation::kNone;  ///< Haas: G255 / G254 / G234; SINUMERIK: TRAFOOF / - / TRAORI.
  ProgramFrame program;
};

enum class CommandKind : std::uint8_t {
  kRapid,
  kFeed,
  kArc,
  kDwell,
  kMachineRapid,
  kMachineFeed,
  kToolChange
};

struct Command {
  CommandKind kind = CommandKind::kFeed;
  SourcePosition where;
  std::shared_ptr<const Frame> frame;
  /// Program coordinates at the end, all axes (those not named keep theirs). kMachine*: machine
  /// values (G53, G28, M06).
  AxisValues end{};
  std::uint8_t named = 0;  ///< Bit per AxisIndex: named in the block.
  // Arc (program coordinates).
  Plane plane = Plane::kXY;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  bool clockwise = false;
  bool full_circle = false;
  /// Unit; zero: the plane's normal axis. An arc that lies in no coordinate plane (CIP).
  Eigen::Vector3d arc_normal = Eigen::Vector3d::Zero();
  RapidMode rapid = RapidMode::kIndependent;
  Orientation orientation = Orientation::kAxes;
  // Feed: exactly one of the modes.
  enum class FeedMode : std::uint8_t {
    kPerMinute,
    kInverseTime,
    kPerRevolution
  } feed_mode = FeedMode::kPerMinute;
  double feed = 0.0;   ///< mm/s; for inverse time 1/s; for per revolution already times the spindle
                       ///< speed: mm/s.
  double dwell = 0.0;  ///< s.
  bool spindle_on = false;
  bool exact_stop = false;
  std::uint8_t brakes = 0;             ///< Bit per AxisIndex: rotary brake commanded on.
  int tool = 0;                        ///< T number in the spindle while this command runs.
  int cycle = 0;                       ///< motion::Facts::cycle.
  double corner_rounding = 0.0;        ///< mm.
  double orientation_tolerance = 0.0;  ///< rad: motion::Facts::orientation_tolerance.
  std::string_view wrap_note;          ///< motion::Facts::wrap_note.
  // What the contour stage acts on.
  enum class Comp : std::uint8_t { kOff, kLeft, kRight } comp = Comp::kOff;  ///< G40 / G41 / G42.
  double comp_radius = 0.0;                                                  ///< mm, signed.
  double corner_radius = 0.0;                                                ///< ,R; RND=
  double corner_chamfer = 0.0;                                               ///< ,C; CHR=
  double corner_chamfer_length = 0.0;  ///< CHF=: of the chamfer itself.
};

}  // namespace ncsim::control
