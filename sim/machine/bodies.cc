// SPDX-License-Identifier: BSD-3-Clause
// Shapes of a URDF as bodies.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "sim/base/file.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/mesh_file.h"
#include "sim/machine/primitives.h"
#include "sim/machine/urdf.h"

namespace ncsim::machine {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxPackageXml = 1 << 20;

bool IsPackage(const fs::path& folder, const std::string& name) {
  if (folder.filename() == name && IsFolder(folder.string())) return true;
  std::string reason;
  const auto text = ReadFile((folder / "package.xml").string(), kMaxPackageXml, &reason);
  if (!text) return false;
  const std::size_t begin = text->find("<name>");
  const std::size_t end = text->find("</name>");
  if (begin == std::string::npos || end == std::string::npos || end < begin + 6) return false;
  const std::string stated = text->substr(begin + 6, end - begin - 6);
  const std::size_t first = stated.find_first_not_of(" \t\r\n");
  const std::size_t last = stated.find_last_not_of(" \t\r\n");
  return first != std::string::npos && stated.substr(first, last - first + 1) == name;
}

/// Upward from the URDF: a folder that is the package, or that holds a folder of its name.
fs::path FindPackage(const std::string& name, const fs::path& urdf_path) {
  std::error_code error;
  for (fs::path folder = fs::absolute(urdf_path, error).lexically_normal().parent_path(); !error;
       folder = folder.parent_path()) {
    if (IsPackage(folder, name)) return folder;
    if (IsFolder((folder / name).string())) return folder / name;
    if (folder == folder.parent_path()) break;
  }
  return {};
}

/// Reports a shape whose triangles stand out further than promised.
void ReportExcess(double excess, const UrdfShape& shape, const std::string& path,
                  Diagnostics* diagnostics) {
  if (excess <= 1.001 * kPrimitiveSagitta) return;
  diagnostics->Warning(path, shape.line, 0,
                       "a round shape of link '" + shape.link + "' is checked " + Short(excess, 3) +
                           " mm larger than it is: facets");
}

LinkBody MakeBody(const UrdfShape& shape, const std::string& path, Diagnostics* diagnostics) {
  LinkBody body;
  double excess = 0.0;
  switch (shape.kind) {
    case UrdfShape::Kind::kBox:
      body.mesh = MakeBox(shape.size);
      break;
    case UrdfShape::Kind::kCylinder:
      body.mesh = MakeCylinder(shape.size.x(), shape.size.y(), &excess);
      break;
    case UrdfShape::Kind::kSphere:
      body.mesh = MakeSphere(shape.size.x(), &excess);
      break;
    case UrdfShape::Kind::kMesh: {
      std::string reason;
      const std::string file = ResolveMeshUri(shape.uri, path, &reason);
      if (file.empty()) {
        body.defect = "mesh " + shape.uri + " is missing: " + reason;
        break;
      }
      MeshFile read = ReadMeshFile(file, kMmPerMetre * shape.scale);
      body.mesh = std::move(read.mesh);
      if (!read.defect.empty()) body.defect = "mesh " + shape.uri + " " + read.defect;
      if (!read.note.empty()) {
        diagnostics->Warning(path, shape.line, 0, "mesh " + shape.uri + " " + read.note);
      }
      break;
    }
  }
  ReportExcess(excess, shape, path, diagnostics);
  for (Eigen::Vector3d& vertex : body.mesh.vertices) vertex = shape.X_LG * vertex;
  return body;
}

}  // namespace

std::string ResolveMeshUri(const std::string& uri, const std::string& urdf_path,
                           std::string* reason) {
  const fs::path folder = fs::path(urdf_path).parent_path();
  fs::path path;
  const std::size_t scheme = uri.find("://");
  if (scheme == std::string::npos) {
    path = folder / uri;
  } else if (uri.starts_with("file://")) {
    path = uri.substr(7);
  } else if (uri.starts_with("package://") || uri.starts_with("model://")) {
    const std::string rest = uri.substr(scheme + 3);
    const std::size_t slash = rest.find('/');
    const std::string package = rest.substr(0, slash);
    const fs::path root = package.empty() ? fs::path() : FindPackage(package, urdf_path);
    if (root.empty() || slash == std::string::npos) {
      *reason = "no folder above the URDF is the package '" + package + "'";
      return "";
    }
    path = root / rest.substr(slash + 1);
  } else {
    *reason = "'" + uri.substr(0, scheme) +
              "://' is not read: package://, model://, file:// and "
              "relative paths are";
    return "";
  }
  return path.lexically_normal().string();
}

std::vector<LinkBody> MakeBodies(const Urdf& urdf, const std::string& path,
                                 Diagnostics* diagnostics) {
  std::vector<LinkBody> bodies;
  std::map<std::string, int> shapes_of_link;
  for (const UrdfShape& shape : urdf.shapes) {
    const int number = ++shapes_of_link[shape.link];
    if (shape.visual && number == 1) {
      diagnostics->Warning(
          path, shape.line, 0,
          "link '" + shape.link + "' has no <collision>: its <visual> is checked instead");
    }
    LinkBody body = MakeBody(shape, path, diagnostics);
    body.link = urdf.tree.FindLink(shape.link);
    body.name = number == 1 ? shape.link : shape.link + "/" + std::to_string(number);
    if (!body.defect.empty()) {
      diagnostics->Warning(path, shape.line, 0,
                           body.defect + ": no pair with '" + body.name + "' can be certified");
    }
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<Visual> MakeVisuals(const Urdf& urdf, const std::string& path,
                                Diagnostics* diagnostics) {
  std::vector<Visual> visuals;
  std::map<std::string, int> shapes_of_link;
  for (const UrdfShape& shape : urdf.visuals) {
    Diagnostics ignored;  // What a checker must know does not concern a picture.
    LinkBody body = MakeBody(shape, path, &ignored);
    if (body.mesh.triangles.empty()) {
      diagnostics->Warning(path, shape.line, 0, body.defect + ": it is not shown");
      continue;
    }
    const int number = ++shapes_of_link[shape.link];
    visuals.push_back({number == 1 ? shape.link : shape.link + "/" + std::to_string(number),
                       urdf.tree.FindLink(shape.link), std::move(body.mesh), shape.color});
  }
  return visuals;
}

}  // namespace ncsim::machine
