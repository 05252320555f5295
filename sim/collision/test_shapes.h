// SPDX-License-Identifier: BSD-3-Clause
// Shapes with closed forms, for this module's tests.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <random>
#include <vector>

#include "sim/machine/mesh.h"
#include "sim/machine/tool.h"

namespace ncsim::collision {

inline machine::TriangleMesh BoxMesh(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  machine::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? upper.x() : lower.x(),
                               (i & 2) != 0 ? upper.y() : lower.y(),
                               (i & 4) != 0 ? upper.z() : lower.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.watertight = true;
  return mesh;
}

/// A latitude and longitude sphere with its vertices on the sphere.
inline machine::TriangleMesh SphereMesh(const Eigen::Vector3d& centre, double radius, int rings) {
  machine::TriangleMesh mesh;
  const int sides = 2 * rings;
  mesh.vertices.emplace_back(centre + Eigen::Vector3d(0, 0, -radius));
  for (int k = 1; k < rings; ++k) {
    const double polar = 3.14159265358979 * (static_cast<double>(k) / rings - 0.5);
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * 3.14159265358979 * i / sides;
      mesh.vertices.emplace_back(
          centre + radius * Eigen::Vector3d(std::cos(polar) * std::cos(angle),
                                            std::cos(polar) * std::sin(angle), std::sin(polar)));
    }
  }
  mesh.vertices.emplace_back(centre + Eigen::Vector3d(0, 0, radius));
  const int top = static_cast<int>(mesh.vertices.size()) - 1;
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    mesh.triangles.push_back({0, 1 + j, 1 + i});
    for (int k = 0; k + 2 < rings; ++k) {
      const int a = 1 + k * sides;
      const int b = a + sides;
      mesh.triangles.push_back({a + i, a + j, b + j});
      mesh.triangles.push_back({a + i, b + j, b + i});
    }
    mesh.triangles.push_back({top, top - sides + i, top - sides + j});
  }
  mesh.watertight = true;
  return mesh;
}

/// A profile of straight elements through (z, r) points.
inline machine::Profile PolyProfile(const std::vector<Eigen::Vector2d>& points) {
  machine::Profile profile;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    profile.elements.push_back({points[i], points[i + 1], false, Eigen::Vector2d::Zero()});
  }
  return profile;
}

inline machine::Profile CylinderProfile(double z0, double z1, double radius) {
  return PolyProfile({{z0, 0.0}, {z0, radius}, {z1, radius}, {z1, 0.0}});
}

/// A ball nose of `radius` with its tip at z = 0, up to z = top.
inline machine::Profile BallProfile(double radius, double top) {
  machine::Profile profile;
  profile.elements.push_back({{0.0, 0.0}, {radius, radius}, true, {radius, 0.0}});
  profile.elements.push_back({{radius, radius}, {top, radius}, false, Eigen::Vector2d::Zero()});
  profile.elements.push_back({{top, radius}, {top, 0.0}, false, Eigen::Vector2d::Zero()});
  return profile;
}

inline Eigen::Isometry3d RandomPose(std::mt19937& random, double reach) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-reach, reach);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                   .normalized()
                   .toRotationMatrix();
  X.translation() = Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  return X;
}

}  // namespace ncsim::collision
