// SPDX-License-Identifier: BSD-3-Clause
// Readers of models/ and jobs. urdfdom, tinyxml2, assimp and toml++ stay behind them. Trouble goes
// to Diagnostics with file and line; a reader returns nullopt only when nothing useful is left.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/diagnostics.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"

namespace ncsim::machine {

/// Path of the model named on the command line: a path, or else a name looked up in $NCSIM_MODELS,
/// beside the installed program (`program_dir`/../share/ncsim/models) and in the source tree
/// (NCSIM_SOURCE_MODELS, compiled in): as NAME, NAME.urdf or */NAME.urdf. Empty if there is none.
std::string FindModel(const std::string& name, const std::string& program_dir);

/// Loads NAME.urdf with the NAME.srdf and NAME.toml beside it (each optional; its absence is a
/// warning).
std::optional<Machine> LoadMachine(const std::string& urdf_path, Diagnostics* diagnostics);

/// What a link looks like. For pictures: nothing is checked against it.
struct Visual {
  std::string name;  ///< Link name; "link/2" for the second and later ones of a link.
  int link = 0;
  TriangleMesh mesh;             ///< In link coordinates, mm; it need not be closed.
  std::array<float, 4> color{};  ///< Red, green, blue, opacity, 0 to 1; all 0 if not stated.
};

/// The visual shapes of a machine that has been loaded. Trouble is a warning.
std::vector<Visual> LoadVisuals(const Machine& machine, Diagnostics* diagnostics);

/// Loads a job file; an empty path gives the default job.
std::optional<Job> LoadJob(const std::string& path, Diagnostics* diagnostics);

/// Reads a mesh file, scaled to mm; `defect` says why it cannot be trusted ("" if it can). STL
/// files are trimmed to their 84 + 50 n bytes before assimp sees them.
TriangleMesh LoadMesh(const std::string& path, const Eigen::Vector3d& scale_to_mm,
                      std::string* defect);

/// The machine in words, and what its lint found: `ncsim inspect`.
std::string Inspect(const Machine& machine, const Diagnostics& diagnostics);

}  // namespace ncsim::machine
