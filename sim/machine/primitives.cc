// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/primitives.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/units.h"

namespace ncsim::machine {

TriangleMesh MakeBox(const Eigen::Vector3d& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                                 (i & 4) != 0 ? 1.0 : -1.0);
    mesh.vertices.push_back(0.5 * corner.cwiseProduct(size));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  mesh.watertight = true;
  return mesh;
}

TriangleMesh MakeCylinder(double radius, double height, double* excess) {
  // Facets touch the cylinder at their middles; the vertices stand out by radius (1 / cos(pi / n) -
  // 1).
  const double half_angle = std::acos(radius / (radius + kPrimitiveSagitta));
  const double wanted = std::ceil(kPi / half_angle);
  const int n = static_cast<int>(std::clamp(wanted, 16.0, kMaxPrimitiveTriangles / 4.0));
  const double outer = radius / std::cos(kPi / n);
  if (excess != nullptr) *excess = outer - radius;

  TriangleMesh mesh;
  mesh.vertices.reserve(static_cast<std::size_t>(2 * n + 2));
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * kPi * i / n;
    const double x = outer * std::cos(angle), y = outer * std::sin(angle);
    mesh.vertices.emplace_back(x, y, -0.5 * height);
    mesh.vertices.emplace_back(x, y, 0.5 * height);
  }
  mesh.vertices.emplace_back(0.0, 0.0, -0.5 * height);
  mesh.vertices.emplace_back(0.0, 0.0, 0.5 * height);
  mesh.triangles.reserve(static_cast<std::size_t>(4 * n));
  for (int i = 0; i < n; ++i) {
    const int low = 2 * i, high = low + 1, next_low = 2 * ((i + 1) % n), next_high = next_low + 1;
    mesh.triangles.push_back({low, next_low, next_high});
    mesh.triangles.push_back({low, next_high, high});
    mesh.triangles.push_back({2 * n, next_low, low});
    mesh.triangles.push_back({2 * n + 1, high, next_high});
  }
  mesh.watertight = true;
  return mesh;
}

namespace {

/// The unit icosahedron, each face cut into frequency^2 triangles whose corners are moved onto the
/// unit sphere.
TriangleMesh Geodesic(int frequency) {
  const double phi = std::numbers::phi;
  const std::array<Eigen::Vector3d, 12> corners = {{{-1, phi, 0},
                                                    {1, phi, 0},
                                                    {-1, -phi, 0},
                                                    {1, -phi, 0},
                                                    {0, -1, phi},
                                                    {0, 1, phi},
                                                    {0, -1, -phi},
                                                    {0, 1, -phi},
                                                    {phi, 0, -1},
                                                    {phi, 0, 1},
                                                    {-phi, 0, -1},
                                                    {-phi, 0, 1}}};
  constexpr std::array<std::array<int, 3>, 20> kFaces = {
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  TriangleMesh mesh;
  // A point is named by its weights at the icosahedron's corners: exact, and the same from both
  // sides of an edge.
  std::map<std::array<int, 12>, int> index;
  const auto vertex = [&](const std::array<int, 3>& face, int i, int j) {
    std::array<int, 12> weights{};
    weights[static_cast<std::size_t>(face[0])] = frequency - i - j;
    weights[static_cast<std::size_t>(face[1])] = i;
    weights[static_cast<std::size_t>(face[2])] = j;
    const auto [it, is_new] = index.emplace(weights, static_cast<int>(mesh.vertices.size()));
    if (is_new) {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < 12; ++k) p += weights[k] * corners[k];
      mesh.vertices.push_back(p.normalized());
    }
    return it->second;
  };
  for (const std::array<int, 3>& face : kFaces) {
    for (int i = 0; i < frequency; ++i) {
      for (int j = 0; i + j < frequency; ++j) {
        mesh.triangles.push_back(
            {vertex(face, i, j), vertex(face, i + 1, j), vertex(face, i, j + 1)});
        if (i + j + 1 < frequency) {
          mesh.triangles.push_back(
              {vertex(face, i + 1, j), vertex(face, i + 1, j + 1), vertex(face, i, j + 1)});
        }
      }
    }
  }
  mesh.watertight = true;
  return mesh;
}

/// Distance from the origin to the nearest facet's plane.
double InnerRadius(const TriangleMesh& mesh) {
  double least = 1.0;
  for (const std::array<int, 3>& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d& b = mesh.vertices[static_cast<std::size_t>(t[1])];
    const Eigen::Vector3d& c = mesh.vertices[static_cast<std::size_t>(t[2])];
    least = std::min(least, (b - a).cross(c - a).normalized().dot(a));
  }
  return least;
}

}  // namespace

TriangleMesh MakeSphere(double radius, double* excess) {
  // The widest facet of frequency f stands off by about 0.29 / f^2 of the radius: a start value,
  // measured below.
  const double wanted = std::sqrt(0.29 * radius / kPrimitiveSagitta);
  const int most = static_cast<int>(std::sqrt(kMaxPrimitiveTriangles / 20.0));
  int frequency = static_cast<int>(std::clamp(std::ceil(wanted), 4.0, static_cast<double>(most)));
  TriangleMesh mesh = Geodesic(frequency);
  double inner = InnerRadius(mesh);
  while (frequency < most && radius * (1.0 / inner - 1.0) > kPrimitiveSagitta) {
    mesh = Geodesic(++frequency);
    inner = InnerRadius(mesh);
  }
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= radius / inner;
  if (excess != nullptr) *excess = radius / inner - radius;
  return mesh;
}

void Translate(const Eigen::Vector3d& offset, TriangleMesh* mesh) {
  for (Eigen::Vector3d& vertex : mesh->vertices) vertex += offset;
}

}  // namespace ncsim::machine
