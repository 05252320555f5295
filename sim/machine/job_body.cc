// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/job_reader.h"
#include "sim/machine/mesh_file.h"
#include "sim/machine/offset_name.h"
#include "sim/machine/primitives.h"

namespace ncsim::machine {
namespace {

void ReadMesh(const JobContext& context, const std::string& file, TomlTable* table,
              PlacedBody* body) {
  const std::optional<std::string> unit = table->Word("unit", {"mm", "inch", "m"});
  const std::string path =
      (std::filesystem::path(context.folder) / file).lexically_normal().string();
  double mm_per_unit = context.mm_per_unit;
  if (StatesUnit(path)) {
    mm_per_unit = kMmPerMetre;
    if (unit && *unit != "m") {
      table->ErrorAt(*table->Get("unit"),
                     "a DAE or GLB file states its own unit, and is read in m");
    }
  } else if (unit) {
    mm_per_unit = *unit == "mm" ? 1.0 : (*unit == "inch" ? kMmPerInch : kMmPerMetre);
  }
  MeshFile read = ReadMeshFile(path, Eigen::Vector3d::Constant(mm_per_unit));
  body->mesh = std::move(read.mesh);
  const TomlValue& where = *table->Get("mesh");
  if (!read.note.empty()) table->WarningAt(where, "mesh " + file + " " + read.note);
  if (read.defect.empty()) return;
  if (read.defect.starts_with("is missing")) {
    table->ErrorAt(where, "mesh " + file + " " + read.defect);
    return;
  }
  body->defect = "mesh " + file + " " + read.defect;
  table->WarningAt(where, body->defect + ": no pair with '" + body->name + "' can be certified");
}

void ReadCylinder(const JobContext& context, TomlTable cylinder, PlacedBody* body) {
  const auto diameter = cylinder.RequiredNumber("diameter", NumberRule::kPositive);
  const auto height = cylinder.RequiredNumber("height", NumberRule::kPositive);
  cylinder.Finish();
  if (!diameter || !height) return;
  const double h = *height * context.mm_per_unit;
  body->mesh = MakeCylinder(0.5 * *diameter * context.mm_per_unit, h);
  Translate({0.0, 0.0, 0.5 * h}, &body->mesh);
}

/// Exactly one of mesh, box and cylinder.
void ReadShape(const JobContext& context, TomlTable* table, PlacedBody* body) {
  const std::optional<std::string> mesh = table->String("mesh");
  const std::optional<Eigen::Vector3d> box = table->Vector3("box", NumberRule::kPositive);
  std::optional<TomlTable> cylinder = table->Table("cylinder");
  const TomlValue& value = table->value();
  const auto stated = [&](const char* key) { return value.Find(key) == nullptr ? 0 : 1; };
  if (stated("mesh") + stated("box") + stated("cylinder") != 1) {
    table->ErrorAt(value, "'" + body->name + "' needs one shape: mesh, box or cylinder");
  }
  if (mesh) {
    ReadMesh(context, *mesh, table, body);
  } else if (box) {
    body->mesh = MakeBox(*box * context.mm_per_unit);
    Translate({0.0, 0.0, 0.5 * box->z() * context.mm_per_unit}, &body->mesh);
  } else if (cylinder) {
    ReadCylinder(context, std::move(*cylinder), body);
  }
}

}  // namespace

std::optional<Placement> ReadPlacement(const JobContext& context, bool with_rotation,
                                       TomlTable* table) {
  const std::optional<std::string> on = table->RequiredString("on");
  const std::optional<Eigen::Vector3d> xyz = table->Vector3("xyz");
  std::optional<Eigen::Vector3d> rpy_deg;
  if (with_rotation) rpy_deg = table->Vector3("rpy_deg");
  if (!on) return std::nullopt;
  Placement placement;
  placement.on = OffsetName(*on).value_or(*on);
  const TomlValue& where = *table->Get("on");
  placement.line = where.line;
  placement.column = where.column;
  if (xyz) placement.X_OG.translation() = *xyz * context.mm_per_unit;
  if (rpy_deg) {
    const Eigen::Vector3d rpy = rpy_deg->unaryExpr(&Radians);
    placement.X_OG.linear() = (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
                                  .toRotationMatrix();
  }
  return placement;
}

std::optional<PlacedBody> ReadBody(const JobContext& context, BodyKind kind, TomlTable table) {
  PlacedBody body;
  body.kind = kind;
  if (kind == BodyKind::kFixture) {
    body.name = table.RequiredString("name").value_or("");
    if (body.name.empty() && table.value().Find("name") != nullptr) {
      table.ErrorAt(*table.Get("name"), "a fixture needs a name");
    }
  } else {
    body.name = kind == BodyKind::kPart ? "part" : "stock";
  }
  ReadShape(context, &table, &body);
  bool placed = false;
  if (table.Require("at") != nullptr) {
    if (std::optional<TomlTable> at = table.Table("at")) {
      if (auto placement = ReadPlacement(context, true, &*at)) {
        body.at = std::move(*placement);
        placed = true;
      }
      at->Finish();
    }
  }
  table.Finish();
  if (body.name.empty() || !placed) return std::nullopt;
  if (body.mesh.triangles.empty() && body.defect.empty()) return std::nullopt;
  return body;
}

}  // namespace ncsim::machine
