// SPDX-License-Identifier: BSD-3-Clause
// A machine of models/: kinematics, axes, collision bodies and the control's data. Immutable once loaded.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinematics/five_axis.h"
#include "kinematics/tree.h"
#include "sim/machine/mesh.h"

namespace ncsim::machine {

/// A programmable axis. The joint's value is the NC value (the URDF's axis vector carries the sense).
struct Axis {
  char letter = 0;
  int joint = 0;             ///< JointVector index.
  bool rotary = false;
  double lower = 0.0;        ///< mm or rad; +-inf where endless.
  double upper = 0.0;
  double rapid = 0.0;        ///< mm/s or rad/s.
  double acceleration = 0.0; ///< mm/s^2 or rad/s^2.
  double home = 0.0;         ///< mm or rad.
};

/// A collision shape of a link. Detailed visual shapes are not loaded for checking.
struct LinkBody {
  std::string name;  ///< Link name; "link/2" for the second and later shapes of a link.
  int link = 0;
  TriangleMesh mesh;  ///< In link coordinates, mm.
  /// Non-empty: this shape cannot be trusted (missing, not watertight ...). Pairs with it are `uncertified`.
  std::string defect;
};

/// A control's own settings, as data: "setting 335" -> "none". Typed access in the control module.
struct ControlData {
  std::string dialect;                            ///< "haas-ngc".
  std::map<std::string, std::string> settings;    ///< By the control's names, lower case, as text.
  std::map<std::string, double> numbers;          ///< Numeric settings, mm / rad / s.
  std::map<char, double> tool_change_pose;        ///< Axis letter -> machine value (mm, rad), in the order Z, X, Y.
  std::optional<Eigen::Vector3d> rotary_centre;   ///< Settings 255-257: machine values; default from the URDF.
  std::vector<std::string> subprogram_folders;
  std::vector<int> m_codes_without_motion;
  std::string tcp_rapid = "hold";                 ///< "hold" or "track".
  int tool_pockets = 0;                           ///< Highest T number; 0 = not stated.
};

/// Links that are not a pair, and a margin a pair (mm) where the SRDF states one.
struct LinkPair {
  int link_a = 0;
  int link_b = 0;
  std::string reason;  ///< Adjacent, User, Always.
};

struct Machine {
  std::string name;
  std::string path;  ///< The URDF file.
  kinematics::KinematicTree tree;
  std::optional<kinematics::FiveAxis> five_axis;  ///< Absent for a machine that has not three linear axes.
  int spindle_link = 0;                           ///< Frame S, "spindle_gauge".
  int table_link = 0;                             ///< Frame B, "workpiece_mount".
  std::vector<Axis> axes;                         ///< In the order X Y Z A B C.
  std::vector<LinkBody> bodies;
  std::vector<LinkPair> disabled_pairs;
  std::map<std::string, kinematics::JointVector> named_poses;
  ControlData control;
  bool nominal_shapes = false;  ///< The model's README says that its shapes are nominal (TOML: shapes = "nominal").

  const Axis* FindAxis(char letter) const;
  kinematics::JointVector Home() const;
};

}  // namespace ncsim::machine
