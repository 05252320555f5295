// SPDX-License-Identifier: BSD-3-Clause
#include "tests/peers/fcl_pair.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>

#include <vector>

namespace ncsim::peers {

struct FclBody::Model {
  fcl::BVHModel<fcl::OBBRSSd> bvh;
};

FclBody::FclBody(const machine::TriangleMesh& mesh) : model_(std::make_unique<Model>()) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  model_->bvh.beginModel();
  model_->bvh.addSubModel(mesh.vertices, triangles);
  model_->bvh.endModel();
  model_->bvh.computeLocalAABB();
}

FclBody::~FclBody() = default;

bool Collides(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA) {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  fcl::collide(&a.model_->bvh, X_BA, &b.model_->bvh, fcl::Transform3d::Identity(), request, result);
  return result.isCollision();
}

double Distance(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA, double cut) {
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result(cut);
  return fcl::distance(&a.model_->bvh, X_BA, &b.model_->bvh, fcl::Transform3d::Identity(), request,
                       result);
}

bool ContinuousCollides(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA0,
                        const Eigen::Isometry3d& X_BA1, Solver solver) {
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_LINEAR;
  if (solver == Solver::kConservativeAdvancement) {
    request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  }
  fcl::ContinuousCollisionResultd result;
  const fcl::Transform3d rest = fcl::Transform3d::Identity();
  fcl::continuousCollide(&a.model_->bvh, X_BA0, X_BA1, &b.model_->bvh, rest, rest, request, result);
  return result.is_collide;
}

}  // namespace ncsim::peers
