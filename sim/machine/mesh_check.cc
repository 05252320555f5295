// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/mesh_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "sim/base/text.h"

namespace ncsim::machine {
namespace {

constexpr double kWeldFraction = 1e-6;

const Eigen::Vector3d& Vertex(const TriangleMesh& mesh, int index) {
  return mesh.vertices[static_cast<std::size_t>(index)];
}

/// For each vertex the first one that is equal to it.
std::vector<int> EqualVertices(const TriangleMesh& mesh) {
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) {
    const Eigen::Vector3d& v = Vertex(mesh, i);
    return std::tuple(v.x(), v.y(), v.z(), i);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<int> representative(order.size());
  int first = -1;
  for (const int i : order) {
    if (first < 0 || Vertex(mesh, i) != Vertex(mesh, first)) first = i;
    representative[static_cast<std::size_t>(i)] = first;
  }
  return representative;
}

/// For each vertex one that is within `tolerance` of it. A grid of cells of that size: a partner
/// lies in one of 27, and a cell holds one representative. The grid has less than 2^21 cells a side
/// (tolerance >= 1e-6 of the diagonal).
std::vector<int> NearVertices(const TriangleMesh& mesh, double tolerance) {
  Eigen::Vector3d lower, upper;
  BoundingBox(mesh, &lower, &upper);
  std::unordered_map<std::uint64_t, int> cells;
  std::vector<int> representative(mesh.vertices.size());
  for (int i = 0; i < static_cast<int>(mesh.vertices.size()); ++i) {
    const Eigen::Vector3d& v = Vertex(mesh, i);
    const Eigen::Vector3d grid = (v - lower) / tolerance + Eigen::Vector3d::Ones();
    std::uint64_t own = 0;
    int found = -1;
    for (int offset = 0; offset < 27; ++offset) {
      const std::array<int, 3> step = {offset % 3 - 1, offset / 3 % 3 - 1, offset / 9 - 1};
      std::uint64_t cell = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto coordinate = static_cast<std::int64_t>(grid[static_cast<int>(k)]) + step[k];
        cell = (cell << 21) | static_cast<std::uint64_t>(coordinate);
      }
      if (offset == 13) own = cell;
      const auto it = cells.find(cell);
      if (it == cells.end()) continue;
      if ((Vertex(mesh, it->second) - v).cwiseAbs().maxCoeff() <= tolerance) found = it->second;
    }
    if (found < 0) {
      found = i;
      cells.emplace(own, i);
    }
    representative[static_cast<std::size_t>(i)] = found;
  }
  return representative;
}

/// Gives every triangle the representatives of its corners, and drops the vertices that no triangle
/// uses.
void Weld(const std::vector<int>& representative, TriangleMesh* mesh) {
  std::vector<int> compact(representative.size(), -1);
  std::vector<Eigen::Vector3d> kept;
  for (std::array<int, 3>& triangle : mesh->triangles) {
    for (int& index : triangle) {
      const int source = representative[static_cast<std::size_t>(index)];
      int& target = compact[static_cast<std::size_t>(source)];
      if (target < 0) {
        target = static_cast<int>(kept.size());
        kept.push_back(Vertex(*mesh, source));
      }
      index = target;
    }
  }
  mesh->vertices = std::move(kept);
}

/// Drops triangles with a corner twice. A sliver with three different corners stays: its neighbours
/// share its edges.
void DropDegenerate(TriangleMesh* mesh) {
  std::erase_if(mesh->triangles, [](const std::array<int, 3>& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

struct EdgeCount {
  std::size_t open = 0;     // edges that some triangle uses without a partner
  std::size_t doubled = 0;  // triangles that are there twice
};

EdgeCount CountEdges(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> balance;
  balance.reserve(mesh.triangles.size() * 3 / 2 + 1);
  for (const std::array<int, 3>& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::uint64_t>(t[k]);
      const auto b = static_cast<std::uint64_t>(t[(k + 1) % 3]);
      balance[(std::min(a, b) << 32) | std::max(a, b)] += a < b ? 1 : -1;
    }
  }
  EdgeCount count;
  for (const auto& [edge, sum] : balance) count.open += sum != 0 ? 1 : 0;

  std::vector<std::array<int, 3>> sorted = mesh.triangles;
  for (std::array<int, 3>& t : sorted) std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) count.doubled += sorted[i] == sorted[i - 1];
  return count;
}

std::string SizeDefect(const TriangleMesh& mesh) {
  Eigen::Vector3d lower, upper;
  BoundingBox(mesh, &lower, &upper);
  const double size = (upper - lower).maxCoeff();
  if (size > kLargestBody) {
    return "is " + Short(size / 1000.0, 1) + " m large: wrong unit or scale?";
  }
  if (size < kSmallestBody) return "is only " + Short(size, 4) + " mm large: wrong unit or scale?";
  return "";
}

}  // namespace

double SignedVolume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  const Eigen::Vector3d origin = mesh.vertices.front();  // near the body: less cancellation
  double volume = 0.0;
  for (const std::array<int, 3>& t : mesh.triangles) {
    const Eigen::Vector3d a = Vertex(mesh, t[0]) - origin;
    const Eigen::Vector3d b = Vertex(mesh, t[1]) - origin;
    const Eigen::Vector3d c = Vertex(mesh, t[2]) - origin;
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

void BoundingBox(const TriangleMesh& mesh, Eigen::Vector3d* lower, Eigen::Vector3d* upper) {
  lower->setZero();
  upper->setZero();
  if (mesh.vertices.empty()) return;
  *lower = *upper = mesh.vertices.front();
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    *lower = lower->cwiseMin(vertex);
    *upper = upper->cwiseMax(vertex);
  }
}

MeshCheck CheckMesh(TriangleMesh* mesh) {
  MeshCheck check;
  mesh->watertight = false;
  const auto finite = [](const Eigen::Vector3d& v) { return v.allFinite(); };
  if (!std::all_of(mesh->vertices.begin(), mesh->vertices.end(), finite)) {
    *mesh = TriangleMesh();
    check.defect = "has a vertex that is not a number";
    return check;
  }
  Weld(EqualVertices(*mesh), mesh);
  DropDegenerate(mesh);
  if (mesh->triangles.empty()) {
    check.defect = "is empty: no triangle";
    return check;
  }
  EdgeCount edges = CountEdges(*mesh);
  if (edges.open > 0) {
    TriangleMesh welded = *mesh;
    Eigen::Vector3d lower, upper;
    BoundingBox(welded, &lower, &upper);
    Weld(NearVertices(welded, kWeldFraction * (upper - lower).norm()), &welded);
    DropDegenerate(&welded);
    const EdgeCount after = CountEdges(welded);
    if (after.open == 0 && !welded.triangles.empty()) {
      *mesh = std::move(welded);
      edges = after;
    }
  }
  mesh->watertight = edges.open == 0 && edges.doubled == 0;
  if (edges.open > 0) {
    check.defect = "is not watertight: " + std::to_string(edges.open) + " open edges";
  } else if (edges.doubled > 0) {
    check.defect =
        "is not a solid: " + std::to_string(edges.doubled) + " triangles are there twice";
  } else if (SignedVolume(*mesh) < 0.0) {
    for (std::array<int, 3>& triangle : mesh->triangles) std::swap(triangle[1], triangle[2]);
    check.note = "is inside out; its triangles were turned";
  }
  if (check.defect.empty()) check.defect = SizeDefect(*mesh);
  return check;
}

}  // namespace ncsim::machine
