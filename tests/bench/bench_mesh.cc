// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/bench_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>

#include "sim/base/units.h"

namespace ncsim::bench {
namespace {

using Cell = std::array<int, 3>;

/// The lattice that the faces of all blocks lie on.
class Lattice {
 public:
  Lattice(const std::vector<Block>& blocks, double pitch) : blocks_(&blocks) {
    for (int k = 0; k < 3; ++k) {
      std::vector<double> edges;
      for (const Block& block : blocks) {
        edges.push_back(block.lower[k]);
        edges.push_back(block.upper[k]);
      }
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const int parts =
            std::max(1, static_cast<int>(std::ceil((edges[i + 1] - edges[i]) / pitch)));
        for (int j = 0; j < parts; ++j) {
          lines_[k].push_back(edges[i] + (edges[i + 1] - edges[i]) * j / parts);
        }
      }
      lines_[k].push_back(edges.back());
    }
  }

  int cells(int k) const { return static_cast<int>(lines_[k].size()) - 1; }
  Eigen::Vector3d Corner(const Cell& at) const {
    return {lines_[0][at[0]], lines_[1][at[1]], lines_[2][at[2]]};
  }
  bool Solid(const Cell& cell) const {
    for (int k = 0; k < 3; ++k) {
      if (cell[k] < 0 || cell[k] >= cells(k)) return false;
    }
    const Eigen::Vector3d middle =
        0.5 * (Corner(cell) + Corner({cell[0] + 1, cell[1] + 1, cell[2] + 1}));
    bool solid = false;
    for (const Block& block : *blocks_) {
      const bool inside = (middle.array() > block.lower.array()).all() &&
                          (middle.array() < block.upper.array()).all();
      if (inside) solid = !block.hollow;
    }
    return solid;
  }

 private:
  const std::vector<Block>* blocks_;
  std::array<std::vector<double>, 3> lines_;
};

}  // namespace

machine::TriangleMesh GlobeMesh(int rings, int sides, const Eigen::Vector3d& first_pole,
                                const Eigen::Vector3d& last_pole,
                                const std::function<Eigen::Vector3d(int, int)>& point) {
  machine::TriangleMesh mesh;
  mesh.vertices.push_back(first_pole);
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) mesh.vertices.push_back(point(ring, side));
  }
  mesh.vertices.push_back(last_pole);
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    mesh.triangles.push_back({0, 1 + j, 1 + i});
    for (int ring = 0; ring + 1 < rings; ++ring) {
      const int a = 1 + ring * sides;
      const int b = a + sides;
      mesh.triangles.push_back({a + i, a + j, b + j});
      mesh.triangles.push_back({a + i, b + j, b + i});
    }
    mesh.triangles.push_back({last, last - sides + i, last - sides + j});
  }
  mesh.watertight = true;
  return mesh;
}

machine::TriangleMesh RevolvedMesh(const std::vector<Eigen::Vector2d>& meridian, double pitch,
                                   int sides) {
  std::vector<Eigen::Vector2d> points;
  const auto divide = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from).norm() / pitch)));
    for (int i = 1; i <= parts; ++i) points.emplace_back(from + (to - from) * i / parts);
  };
  const Eigen::Vector2d first(meridian.front().x(), 0.0);
  const Eigen::Vector2d last(meridian.back().x(), 0.0);
  divide(first, meridian.front());
  for (std::size_t i = 0; i + 1 < meridian.size(); ++i) divide(meridian[i], meridian[i + 1]);
  divide(meridian.back(), last);
  points.pop_back();
  return GlobeMesh(static_cast<int>(points.size()), sides, {0, 0, first.x()}, {0, 0, last.x()},
                   [&](int ring, int side) {
                     const Eigen::Vector2d& p = points[static_cast<std::size_t>(ring)];
                     const double angle = 2.0 * kPi * side / sides;
                     return Eigen::Vector3d(p.y() * std::cos(angle), p.y() * std::sin(angle),
                                            p.x());
                   });
}

machine::TriangleMesh BlockMesh(const std::vector<Block>& blocks, double pitch) {
  const Lattice lattice(blocks, pitch);
  machine::TriangleMesh mesh;
  std::map<Cell, int> corners;
  const auto corner = [&](const Cell& at) {
    const auto [entry, is_new] = corners.try_emplace(at, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(lattice.Corner(at));
    return entry->second;
  };
  // The face of `cell` across axis k, seen from outside counter-clockwise.
  const auto face = [&](Cell cell, int k, bool upper) {
    if (upper) ++cell[k];
    const int u = (k + (upper ? 1 : 2)) % 3;
    const int v = (k + (upper ? 2 : 1)) % 3;
    std::array<Cell, 4> at{cell, cell, cell, cell};
    ++at[1][u];
    ++at[2][u];
    ++at[2][v];
    ++at[3][v];
    const std::array<int, 4> c{corner(at[0]), corner(at[1]), corner(at[2]), corner(at[3])};
    mesh.triangles.push_back({c[0], c[1], c[2]});
    mesh.triangles.push_back({c[0], c[2], c[3]});
  };
  for (int x = 0; x < lattice.cells(0); ++x) {
    for (int y = 0; y < lattice.cells(1); ++y) {
      for (int z = 0; z < lattice.cells(2); ++z) {
        const Cell cell{x, y, z};
        if (!lattice.Solid(cell)) continue;
        for (int k = 0; k < 3; ++k) {
          for (const bool upper : {false, true}) {
            Cell beside = cell;
            beside[k] += upper ? 1 : -1;
            if (!lattice.Solid(beside)) face(cell, k, upper);
          }
        }
      }
    }
  }
  mesh.watertight = true;
  return mesh;
}

bool WriteStl(const machine::TriangleMesh& mesh, const std::string& path) {
  std::string bytes(84, '\0');
  const auto append = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  bytes.reserve(84 + 50 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
    const Eigen::Vector3d& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
    const Eigen::Vector3d& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    for (const Eigen::Vector3d& v : {normal, a, b, c}) {
      const Eigen::Vector3f f = v.cast<float>();
      append(f.data(), 3 * sizeof(float));
    }
    const std::uint16_t none = 0;
    append(&none, sizeof none);
  }
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<bool>(out);
}

}  // namespace ncsim::bench
