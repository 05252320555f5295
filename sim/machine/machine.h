// SPDX-License-Identifier: BSD-3-Clause
// A machine of models/: kinematics, axes, collision bodies and the control's data. Immutable once
// loaded.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinematics/five_axis.h"
#include "kinematics/tree.h"
#include "sim/base/finding.h"
#include "sim/machine/mesh.h"

namespace ncsim::machine {

/// A programmable axis. The joint's value is the NC value (the URDF's axis vector carries the
/// sense).
struct Axis {
  char letter = 0;
  int joint = 0;  ///< JointVector index.
  bool rotary = false;
  double lower = 0.0;  ///< mm or rad; +-inf where endless.
  double upper = 0.0;
  double rapid = 0.0;         ///< mm/s or rad/s.
  double acceleration = 0.0;  ///< mm/s^2 or rad/s^2.
  double home = 0.0;          ///< mm or rad.
};

/// A collision shape of a link. Detailed visual shapes are not loaded for checking.
struct LinkBody {
  std::string name;  ///< Link name; "link/2" for the second and later shapes of a link.
  int link = 0;
  TriangleMesh mesh;  ///< In link coordinates, mm.
  /// Non-empty: this shape cannot be trusted (missing, not watertight ...). Pairs with it are
  /// `uncertified`.
  std::string defect;
};

/// A control's own settings, as data: "setting 335" -> "none". Typed access in the control module.
struct ControlData {
  std::string dialect;  ///< "haas-ngc", "sinumerik-840d".
  std::map<std::string, std::string>
      settings;  ///< By the control's names, as settings.h spells and normalises them.
  /// Those of them that nobody has read off the machine: an assumption where the job is silent.
  std::vector<std::string> nominal_settings;
  std::map<std::string, double> numbers;    ///< Those of them that are numbers: mm, rad, or plain.
  std::map<char, double> tool_change_pose;  ///< Axis letter -> machine value (mm, rad).
  std::vector<std::string> tool_change_order = {"Z", "XY"};  ///< Letters of a step go together.
  bool tool_change_nominal =
      true;  ///< The pose is nobody's measured one (TOML: pose = "measured").
  std::optional<Eigen::Vector3d>
      rotary_centre;  ///< Settings 255-257: machine values X Y Z; default from the URDF.
  std::vector<std::string> subprogram_folders;
  std::vector<int> m_codes_without_motion;
  std::string tcp_rapid = "hold";  ///< "hold" or "track".
  int tool_pockets = 0;            ///< Highest T number; 0 = not stated.
  double max_tool_length = 0.0;    ///< mm; 0 = not stated.
  double max_tool_diameter = 0.0;  ///< mm; 0 = not stated.
  double max_spindle_rpm = 0.0;    ///< 0 = not stated.
  std::string spindle_interface;   ///< "CAT40"; for people, and for holders that are assumed.
};

/// Two links that are not checked against each other.
struct LinkPair {
  int link_a = 0;
  int link_b = 0;
  std::string reason;  ///< Adjacent, User, Always.
};

/// A margin of a pair above this, mm, is a mistaken unit.
inline constexpr double kGreatestMargin = 1000.0;

/// Two links that are to keep a clearance of their own.
struct LinkMargin {
  int link_a = 0;  ///< The lesser index.
  int link_b = 0;
  double clearance = 0.0;  ///< mm.
  int line = 0;            ///< In the SRDF.
};

/// Nominal shapes that come closer than this to anything, mm, are an assumption that places metal.
inline constexpr double kNominalMargin = 10.0;

struct Machine {
  std::string name;
  std::string path;  ///< The URDF file.
  kinematics::KinematicTree tree;
  std::optional<kinematics::FiveAxis>
      five_axis;           ///< Absent for a machine that has not three linear axes.
  int spindle_link = 0;    ///< Frame S, "spindle_gauge".
  int table_link = 0;      ///< Frame B, "workpiece_mount".
  std::vector<Axis> axes;  ///< In the order X Y Z A B C.
  std::vector<LinkBody> bodies;
  std::vector<LinkPair> disabled_pairs;
  std::vector<LinkMargin> margins;
  std::map<std::string, kinematics::JointVector> named_poses;
  ControlData control;
  bool nominal_shapes =
      false;  ///< The model does not call its shapes measured (TOML: shapes = "measured").

  const Axis* FindAxis(char letter) const;
  /// The model declares that the two links need no check.
  bool Disabled(int link_a, int link_b) const;
  kinematics::JointVector Home() const;
  /// What the control would show as X, Y, Z (mm) if the gauge line stood at a point of frame M,
  /// with the rotary axes as they are in q.
  Eigen::Vector3d Coordinates(const Eigen::Vector3d& p_M, const kinematics::JointVector& q) const;
  /// NC letters and values (mm, deg) at q.
  AxisReadout Readout(const kinematics::JointVector& q) const;
};

}  // namespace ncsim::machine
