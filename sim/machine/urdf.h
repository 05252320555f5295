// SPDX-License-Identifier: BSD-3-Clause
// A URDF as links, joints and shapes, in mm and rad. urdfdom stays behind it.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/tree.h"
#include "sim/base/diagnostics.h"
#include "sim/machine/load.h"

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
  std::array<float, 4> color{};  ///< Of a visual: red, green, blue, opacity; all 0 if not stated.
};

struct Urdf {
  std::string name;
  kinematics::KinematicTree tree;
  std::map<std::string, double>
      velocity;  ///< Moving joint -> mm/s or rad/s; 0 where the file says 0.
  std::map<std::string, int> joint_lines;
  std::vector<UrdfShape> shapes;   ///< To be checked; in the order of the file.
  std::vector<UrdfShape> visuals;  ///< To be shown; in the order of the file.
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

/// What is to be shown of each link, likewise; shapes that cannot be read are left out (reported).
std::vector<Visual> MakeVisuals(const Urdf& urdf, const std::string& path,
                                Diagnostics* diagnostics);

}  // namespace ncsim::machine
