// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/fcl_backend.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

namespace ncsim::collision {

using Bvh = fcl::BVHModel<fcl::OBBRSSd>;

namespace {

std::unique_ptr<Bvh> Build(const machine::TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  auto bvh = std::make_unique<Bvh>();
  try {
    bool ok = bvh->beginModel() == fcl::BVH_OK;
    ok = ok && bvh->addSubModel(mesh.vertices, triangles) == fcl::BVH_OK;
    ok = ok && bvh->endModel() == fcl::BVH_OK;
    if (!ok) return nullptr;
    bvh->computeLocalAABB();
  } catch (const std::exception&) {
    return nullptr;
  }
  return bvh;
}

}  // namespace

struct FclMesh::Model {
  explicit Model(machine::TriangleMesh triangles) : mesh(std::move(triangles)) {}

  // Null: FCL would not.
  const Bvh* bvh() {
    std::call_once(once, [this] {
      tree = Build(mesh);
      mesh = {};
    });
    return tree.get();
  }

  machine::TriangleMesh mesh;  // until there is a tree
  std::unique_ptr<Bvh> tree;
  std::once_flag once;
};

FclMesh::FclMesh(machine::TriangleMesh mesh) {
  if (!mesh.triangles.empty()) model_ = std::make_unique<Model>(std::move(mesh));
}

FclMesh::~FclMesh() = default;
FclMesh::FclMesh(FclMesh&&) noexcept = default;
FclMesh& FclMesh::operator=(FclMesh&&) noexcept = default;

std::optional<double> Distance(const FclMesh& a, const FclMesh& b, const Eigen::Isometry3d& X_BA,
                               double cut) {
  if (!a.ok() || !b.ok() || !X_BA.matrix().allFinite()) return std::nullopt;
  const Bvh* const bvh_a = a.model_->bvh();
  const Bvh* const bvh_b = b.model_->bvh();
  if (bvh_a == nullptr || bvh_b == nullptr) return std::nullopt;
  try {
    const fcl::DistanceRequestd request(false, false);
    // The traversal prunes at result.min_distance: that is what makes a cut.
    fcl::DistanceResultd result(cut);
    fcl::distance(bvh_a, X_BA, bvh_b, fcl::Transform3d::Identity(), request, result);
    const double distance = result.min_distance;
    if (std::isnan(distance)) return std::nullopt;
    return distance < 0.0 ? 0.0 : distance;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::optional<bool> Collide(const FclMesh& a, const FclMesh& b, const Eigen::Isometry3d& X_BA) {
  if (!a.ok() || !b.ok() || !X_BA.matrix().allFinite()) return std::nullopt;
  const Bvh* const bvh_a = a.model_->bvh();
  const Bvh* const bvh_b = b.model_->bvh();
  if (bvh_a == nullptr || bvh_b == nullptr) return std::nullopt;
  try {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    fcl::collide(bvh_a, X_BA, bvh_b, fcl::Transform3d::Identity(), request, result);
    return result.isCollision();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace ncsim::collision
