// SPDX-License-Identifier: BSD-3-Clause
// What a user of FCL would write for two meshes of which one moves. A peer, not an oracle.
#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "sim/machine/mesh.h"

namespace ncsim::peers {

/// How fcl::continuousCollide is asked; both with CCDM_LINEAR (the translation in proportion, the
/// rotation about one axis).
enum class Solver {
  kDefault,                  ///< CCDC_NAIVE: 10 poses.
  kConservativeAdvancement,  ///< CCDC_CONSERVATIVE_ADVANCEMENT.
};

/// A mesh as BVHModel<OBBRSS>.
class FclBody {
 public:
  explicit FclBody(const machine::TriangleMesh& mesh);
  ~FclBody();
  FclBody(const FclBody&) = delete;
  FclBody& operator=(const FclBody&) = delete;

 private:
  friend bool Collides(const FclBody&, const FclBody&, const Eigen::Isometry3d&);
  friend double Distance(const FclBody&, const FclBody&, const Eigen::Isometry3d&, double);
  friend bool ContinuousCollides(const FclBody&, const FclBody&, const Eigen::Isometry3d&,
                                 const Eigen::Isometry3d&, Solver);
  struct Model;
  std::unique_ptr<Model> model_;
};

/// fcl::collide of `a` at X_BA with `b` at rest.
bool Collides(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA);

/// fcl::distance, mm; of surfaces that meet 0 or less, of any that are further apart `cut`.
double Distance(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA, double cut);

/// fcl::continuousCollide of `a` from one pose to the other with `b` at rest.
bool ContinuousCollides(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA0,
                        const Eigen::Isometry3d& X_BA1, Solver solver);

}  // namespace ncsim::peers
