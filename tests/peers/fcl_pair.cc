// SPDX-License-Identifier: BSD-3-Clause
#include "tests/peers/fcl_pair.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <vector>

namespace ncsim::peers {

namespace {

template <typename Volume>
void Fill(const machine::TriangleMesh& mesh, fcl::BVHModel<Volume>* model) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  model->beginModel();
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  model->computeLocalAABB();
}

}  // namespace

struct FclBody::Model {
  fcl::BVHModel<fcl::OBBRSSd> obb_rss;
  fcl::BVHModel<fcl::RSSd> rss;
};

FclBody::FclBody(const machine::TriangleMesh& mesh) : model_(std::make_unique<Model>()) {
  Fill(mesh, &model_->obb_rss);
  Fill(mesh, &model_->rss);
}

FclBody::~FclBody() = default;

bool Collides(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA) {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  fcl::collide(&a.model_->obb_rss, X_BA, &b.model_->obb_rss, fcl::Transform3d::Identity(), request,
               result);
  return result.isCollision();
}

bool ContinuousCollides(const FclBody& a, const FclBody& b, const Eigen::Isometry3d& X_BA0,
                        const Eigen::Isometry3d& X_BA1, Volumes volumes) {
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_LINEAR;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  fcl::ContinuousCollisionResultd result;
  const fcl::Transform3d rest = fcl::Transform3d::Identity();
  if (volumes == Volumes::kRss) {
    fcl::continuousCollide(&a.model_->rss, X_BA0, X_BA1, &b.model_->rss, rest, rest, request,
                           result);
  } else {
    fcl::continuousCollide(&a.model_->obb_rss, X_BA0, X_BA1, &b.model_->obb_rss, rest, rest,
                           request, result);
  }
  return result.is_collide;
}

}  // namespace ncsim::peers
