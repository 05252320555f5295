// SPDX-License-Identifier: BSD-3-Clause
// The parts of the job reader; load.h is its face.
#pragma once

#include <optional>
#include <string>

#include "sim/base/toml_reader.h"
#include "sim/machine/job.h"

namespace ncsim::machine {

/// What every part of a job file needs.
struct JobContext {
  std::string folder;        ///< Of the job file; mesh paths are relative to it.
  double mm_per_unit = 1.0;  ///< Of the file's lengths.
};

/// The [[tool]] table; nullopt (reported) when no assembly can be made of it.
std::optional<Tool> ReadTool(const JobContext& context, TomlTable table);

/// A [[fixture]], [part] or [stock]; nullopt (reported) when it cannot be placed or has no shape.
std::optional<PlacedBody> ReadBody(const JobContext& context, BodyKind kind, TomlTable table);

/// `on` and `xyz` (and `rpy_deg` if `with_rotation`) of an inline table.
std::optional<Placement> ReadPlacement(const JobContext& context, bool with_rotation,
                                       TomlTable* table);

}  // namespace ncsim::machine
