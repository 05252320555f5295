// SPDX-License-Identifier: BSD-3-Clause
// A URDF as links, joints and shapes, in mm and rad. urdfdom stays behind it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/tree.h"
#include "sim/base/diagnostics.h"
#include "sim/machine/machine.h"

namespace ncsim::machine {

struct UrdfShape {
  enum class Kind { kMesh, kBox, kCylinder, kSphere };
  Kind kind = Kind::kMesh;
  std::string link;
  int line = 0;
  bool visual = false;  ///< From <visual>, because the link has no <collision>.
  Eigen::Isometry3d X_LG = Eigen::Isometry3d::Identity();  ///< mm.
  Eigen::Vector3d size =
      Eigen::Vector3d::Zero();  ///< mm: box edges; cylinder radius, length; sphere radius.
  std::string uri;              ///< As written.
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< As written.
};

struct Urdf {
  std::string name;
  kinematics::KinematicTree tree;
  std::map<std::string, double>
      velocity;  ///< Moving joint -> mm/s or rad/s; 0 where the file says 0.
  std::map<std::string, int> joint_lines;
  std::vector<UrdfShape> shapes;  ///< In the order of the file.
};

/// nullopt where no tree can be built (reported). A URDF with errors that leave a tree is returned.
std::optional<Urdf> ReadUrdf(const std::string& path, Diagnostics* diagnostics);

/// The file that a mesh URI of `urdf_path` means; "" and a reason where none can be found.
std::string ResolveMeshUri(const std::string& uri, const std::string& urdf_path,
                           std::string* reason);

/// The shapes as bodies: meshes read, primitives tessellated, in link coordinates. Trouble is
/// reported at the shape's line.
std::vector<LinkBody> MakeBodies(const Urdf& urdf, const std::string& path,
                                 Diagnostics* diagnostics);

}  // namespace ncsim::machine
