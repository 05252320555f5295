// SPDX-License-Identifier: BSD-3-Clause
// Everything solid that is there before the first tool: links' shapes, fixtures, part, blank, each
// in its link's frame.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/base/diagnostics.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"

namespace ncsim::machine {

struct SceneBody {
  std::string name;
  BodyKind kind = BodyKind::kMachine;
  int link = 0;
  TriangleMesh mesh;  ///< Link coordinates, mm.
  std::string defect;
};

struct Scene {
  std::vector<SceneBody> bodies;
};

/// Machine values of a work offset of the job (mm, rad; all of X Y Z A B C present), worked out
/// from its placement where it has one: the axis values that put the gauge line on the frame's
/// origin at its B, C. nullopt: the job has none of that name, or its placement cannot be resolved
/// (reported).
std::optional<std::map<char, double>> OffsetValues(const Machine& machine, const Job& job,
                                                   const std::string& name,
                                                   Diagnostics* diagnostics);

/// X_BP: the work offset as a frame, riding on the table: origin where the gauge line stands at
/// these machine values, machine directions at their B, C. By the metal (the URDF).
Eigen::Isometry3d OffsetFrame(const Machine& machine, const std::map<char, double>& values);

/// Resolves every placement, and refuses what the job says to another control than the machine's.
/// Meshes of bodies are moved, not copied, out of `job` copies.
Scene BuildScene(const Machine& machine, const Job& job, Diagnostics* diagnostics);

}  // namespace ncsim::machine
