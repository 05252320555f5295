// SPDX-License-Identifier: BSD-3-Clause
// What a user of FCL would write for two meshes of which one moves. A peer, not an oracle.
#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "sim/machine/mesh.h"

namespace ncsim::peers {

/// Bounding volumes of a BVHModel: OBBRSS is what FCL's own examples use; RSS is the only one for
/// which its conservative advancement knows a motion bound.
enum class Volumes { kObbRss, kRss };

/// A mesh, as models of both kinds.
class FclBody {
 public:
  explicit FclBody(const machine::TriangleMesh& mesh);
  ~FclBody();
  FclBody(const FclBody&) = delete;
  FclBody& operator=(const FclBody&) = delete;

 private:
  friend bool Collides(const FclBody&, const FclBody&, const Eigen::Isometry3d&);
  friend bool ContinuousCollides(const FclBody&, const FclBody&, const Eigen::Isometry3d&,
                                 const Eigen::Isometry3d&, Volumes);
  struct Model;
  std::unique_ptr<Model> model_;
};

/// fcl::collide (OBBRSS) of `a` at X_BA with `b` at rest.
bool Collides(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA);

/// fcl::continuousCollide of `a` from one pose to the other with `b` at rest: linear and spherical
/// interpolation (CCDM_LINEAR), conservative advancement.
bool ContinuousCollides(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA0,
                        const Eigen::Isometry3d& X_BA1, Volumes volumes);

}  // namespace ncsim::peers
