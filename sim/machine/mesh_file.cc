// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/mesh_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "sim/base/file.h"
#include "sim/machine/load.h"
#include "sim/machine/mesh_check.h"
#include "sim/machine/mesh_guard.h"
#include "sim/machine/mesh_import.h"

namespace ncsim::machine {
namespace {

constexpr std::uint64_t kMaxMeshBytes = std::uint64_t{1} << 29;
constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;

std::string Extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension.empty() ? extension : extension.substr(1);
}

std::uint32_t LittleEndian32(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return value;
}

void SetLittleEndian32(std::uint32_t value, std::size_t at, std::string* bytes) {
  for (std::size_t i = 0; i < 4; ++i) {
    (*bytes)[at + i] = static_cast<char>((value >> (8 * i)) & 0xffu);
  }
}

bool LooksLikeTextStl(const std::string& bytes) {
  return bytes.starts_with("solid") && bytes.substr(0, 4096).find("facet") != std::string::npos;
}

std::size_t CountFacets(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find("facet"); at != std::string::npos;
       at = text.find("facet", at + 5)) {
    const bool end = at >= 3 && text.compare(at - 3, 3, "end") == 0;
    count += end ? 0 : 1;
  }
  return count;
}

}  // namespace

bool StatesUnit(const std::string& path) {
  const std::string extension = Extension(path);
  return extension == "dae" || extension == "glb";
}

void MendStl(std::string* bytes, std::string* defect) {
  const bool has_header = bytes->size() >= kStlHeader;
  const std::uint64_t said = has_header ? LittleEndian32(*bytes, 80) : 0;
  const bool fits = has_header && kStlHeader + kStlTriangle * said == bytes->size();
  if (!fits && LooksLikeTextStl(*bytes)) {
    if (bytes->find("endsolid") == std::string::npos) {
      *defect = "is truncated: a text STL without endsolid";
    }
    return;
  }
  if (!has_header) {
    *defect = "is truncated: " + std::to_string(bytes->size()) + " bytes are no STL";
    bytes->clear();
    return;
  }
  const std::uint64_t there = (bytes->size() - kStlHeader) / kStlTriangle;
  if (said > there) {
    *defect = "is truncated: its header says " + std::to_string(said) +
              " triangles, the file has " + std::to_string(there);
    SetLittleEndian32(static_cast<std::uint32_t>(there), 80, bytes);
  }
  bytes->resize(kStlHeader + kStlTriangle * static_cast<std::size_t>(std::min(said, there)));
}

MeshFile ReadMeshFile(const std::string& path, const Eigen::Vector3d& scale_to_mm) {
  MeshFile file;
  const std::string extension = Extension(path);
  constexpr std::array<std::string_view, 5> kKnown = {"stl", "obj", "ply", "dae", "glb"};
  if (std::find(kKnown.begin(), kKnown.end(), extension) == kKnown.end()) {
    file.defect = "is of a format that is not read: STL, OBJ, PLY, DAE and GLB are";
    return file;
  }
  std::string reason;
  std::optional<std::string> bytes = ReadFile(path, kMaxMeshBytes, &reason);
  if (!bytes) {
    file.defect = "is missing: " + reason;
    return file;
  }
  if (extension == "stl") MendStl(&*bytes, &file.defect);
  const bool text_stl = extension == "stl" && LooksLikeTextStl(*bytes);
  if (bytes->empty() || (extension == "stl" && bytes->size() == kStlHeader)) {
    if (file.defect.empty()) file.defect = "is empty: no triangle";
    return file;
  }
  std::string defect = GuardMesh(extension, *bytes);
  if (!defect.empty()) {
    file.defect = std::move(defect);
    return file;
  }
  file.mesh = ImportMesh(*bytes, extension, &defect);
  const std::size_t facets = text_stl ? CountFacets(*bytes) : file.mesh.triangles.size();
  if (defect.empty() && text_stl && facets != file.mesh.triangles.size()) {
    defect = "is broken: " + std::to_string(facets) + " facets, of which " +
             std::to_string(file.mesh.triangles.size()) + " could be read";
  }
  for (Eigen::Vector3d& vertex : file.mesh.vertices) vertex = vertex.cwiseProduct(scale_to_mm);
  if (scale_to_mm.prod() < 0.0) {
    for (std::array<int, 3>& triangle : file.mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  if (file.defect.empty()) file.defect = defect;
  const MeshCheck check = CheckMesh(&file.mesh);
  if (file.defect.empty()) file.defect = check.defect;
  file.note = check.note;
  return file;
}

TriangleMesh LoadMesh(const std::string& path, const Eigen::Vector3d& scale_to_mm,
                      std::string* defect) {
  MeshFile file = ReadMeshFile(path, scale_to_mm);
  *defect = std::move(file.defect);
  return std::move(file.mesh);
}

}  // namespace ncsim::machine
