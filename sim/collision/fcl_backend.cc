// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/fcl_backend.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <array>
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

namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

Corners CornersOf(const Bvh& bvh, intptr_t triangle) {
  const fcl::Triangle& t = bvh.tri_indices[triangle];
  return {bvh.vertices[t[0]], bvh.vertices[t[1]], bvh.vertices[t[2]]};
}

// Where edges of one triangle pass through the other: appended to `points`.
void AddPiercings(const Corners& edges, const Corners& face, std::vector<Vector3d>* points) {
  const Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& from = edges[i];
    const Vector3d& to = edges[(i + 1) % 3];
    const double start = normal.dot(from - face[0]);
    const double end = normal.dot(to - face[0]);
    if (start * end > 0.0 || start == end) continue;
    const Vector3d p = from + (start / (start - end)) * (to - from);
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& corner = face[k];
      inside = inside && (face[(k + 1) % 3] - corner).cross(p - corner).dot(normal) >= 0.0;
    }
    if (inside) points->push_back(p);
  }
}

// The middle of what two triangles have in common.
std::optional<Vector3d> CommonPoint(const Corners& a, const Corners& b) {
  std::vector<Vector3d> points;
  AddPiercings(a, b, &points);
  AddPiercings(b, a, &points);
  if (points.empty()) return std::nullopt;
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::optional<std::pair<Vector3d, Vector3d>> CommonOrNearestPoints(const FclMesh& a,
                                                                   const FclMesh& b,
                                                                   const Eigen::Isometry3d& X_BA) {
  if (!a.ok() || !b.ok() || !X_BA.matrix().allFinite()) return std::nullopt;
  constexpr std::size_t kTriangles = 64;  // pairs that meet, until one does not only graze
  try {
    const Bvh* const bvh_a = a.model_->bvh();
    const Bvh* const bvh_b = b.model_->bvh();
    if (bvh_a == nullptr || bvh_b == nullptr) return std::nullopt;
    fcl::CollisionResultd met;
    fcl::collide(bvh_a, X_BA, bvh_b, fcl::Transform3d::Identity(),
                 fcl::CollisionRequestd(kTriangles, false), met);
    for (std::size_t i = 0; i < met.numContacts(); ++i) {
      const fcl::Contactd& contact = met.getContact(i);
      Corners of_a = CornersOf(*bvh_a, contact.b1);
      for (Vector3d& corner : of_a) corner = X_BA * corner;
      const std::optional<Vector3d> common = CommonPoint(of_a, CornersOf(*bvh_b, contact.b2));
      if (common) return std::pair(*common, *common);
    }
    if (met.isCollision()) return std::nullopt;
    fcl::DistanceResultd apart;
    fcl::distance(bvh_a, X_BA, bvh_b, fcl::Transform3d::Identity(),
                  fcl::DistanceRequestd(true, false), apart);
    const std::pair<Vector3d, Vector3d> points{apart.nearest_points[0], apart.nearest_points[1]};
    if (!points.first.allFinite() || !points.second.allFinite()) return std::nullopt;
    return points;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace ncsim::collision
