// SPDX-License-Identifier: BSD-3-Clause
// The one place where FCL is used, and only the parts of it that were found trustworthy: mesh
// against mesh, OBBRSS, distance and collide (docs/decisions/0006-fcl.md). No Eigen alignment of
// FCL's leaves this module's .cc.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <utility>

#include "sim/machine/mesh.h"

namespace ncsim::collision {

/// What is taken off every distance that FCL reports, mm. fcl_characterization_test.cc measures the
/// worst over-estimate on closed forms (about 1e-12 mm at machine size) and holds it below a tenth
/// of this.
inline constexpr double kFclDistanceError = 1e-4;

/// A mesh for FCL. Its tree is made when it is first asked for, since that takes longer and more
/// memory than all else, and most bodies never need it.
class FclMesh {
 public:
  explicit FclMesh(machine::TriangleMesh mesh);
  ~FclMesh();
  FclMesh(FclMesh&&) noexcept;
  FclMesh& operator=(FclMesh&&) noexcept;

  /// False of a mesh without triangles: nothing about this body can be certified.
  bool ok() const { return model_ != nullptr; }

 private:
  struct Model;
  friend std::optional<double> Distance(const FclMesh&, const FclMesh&, const Eigen::Isometry3d&,
                                        double);
  friend std::optional<bool> Collide(const FclMesh&, const FclMesh&, const Eigen::Isometry3d&);
  friend std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> CommonOrNearestPoints(
      const FclMesh&, const FclMesh&, const Eigen::Isometry3d&);
  std::unique_ptr<Model> model_;
};

/// The lesser of `cut` and the distance between the two SURFACES as FCL finds it (0 where they
/// meet), with A at X_BA in the frame of B. nullopt: FCL failed, in this or in making its trees;
/// the pair cannot be certified at this pose. A small `cut` is what makes it fast.
std::optional<double> Distance(const FclMesh& a, const FclMesh& b, const Eigen::Isometry3d& X_BA,
                               double cut);

/// Do the two surfaces meet? nullopt: FCL failed.
std::optional<bool> Collide(const FclMesh& a, const FclMesh& b, const Eigen::Isometry3d& X_BA);

/// A point on the surface of A and one on that of B, in B's frame: where the surfaces meet, one
/// that both have; else where they are nearest. nullopt: FCL failed, or the triangles that meet
/// only graze each other in a plane.
std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> CommonOrNearestPoints(
    const FclMesh& a, const FclMesh& b, const Eigen::Isometry3d& X_BA);

}  // namespace ncsim::collision
