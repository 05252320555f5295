// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/fcl_backend.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <exception>
#include <vector>

namespace ncsim::collision {

struct FclMesh::Model {
  fcl::BVHModel<fcl::OBBRSSd> bvh;
};

FclMesh::FclMesh(const machine::TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return;
  auto model = std::make_unique<Model>();
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  try {
    bool ok = model->bvh.beginModel() == fcl::BVH_OK;
    ok = ok && model->bvh.addSubModel(mesh.vertices, triangles) == fcl::BVH_OK;
    ok = ok && model->bvh.endModel() == fcl::BVH_OK;
    if (!ok) return;
    model->bvh.computeLocalAABB();
  } catch (const std::exception&) {
    return;
  }
  model_ = std::move(model);
}

FclMesh::~FclMesh() = default;
FclMesh::FclMesh(FclMesh&&) noexcept = default;
FclMesh& FclMesh::operator=(FclMesh&&) noexcept = default;

std::optional<double> Distance(const FclMesh& a, const FclMesh& b, const Eigen::Isometry3d& X_BA,
                               double cut) {
  if (!a.ok() || !b.ok() || !X_BA.matrix().allFinite()) return std::nullopt;
  try {
    const fcl::DistanceRequestd request(false, false);
    // The traversal prunes at result.min_distance: that is what makes a cut.
    fcl::DistanceResultd result(cut);
    fcl::distance(&a.model_->bvh, X_BA, &b.model_->bvh, fcl::Transform3d::Identity(), request,
                  result);
    const double distance = result.min_distance;
    if (std::isnan(distance)) return std::nullopt;
    return distance < 0.0 ? 0.0 : distance;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::optional<bool> Collide(const FclMesh& a, const FclMesh& b, const Eigen::Isometry3d& X_BA) {
  if (!a.ok() || !b.ok() || !X_BA.matrix().allFinite()) return std::nullopt;
  try {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    fcl::collide(&a.model_->bvh, X_BA, &b.model_->bvh, fcl::Transform3d::Identity(), request,
                 result);
    return result.isCollision();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace ncsim::collision
