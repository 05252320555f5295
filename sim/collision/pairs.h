// SPDX-License-Identifier: BSD-3-Clause
// Which bodies can meet, and in what role.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/collision/bodies.h"
#include "sim/collision/swept.h"
#include "sim/machine/machine.h"
#include "sim/motion/motion.h"

namespace ncsim::collision {

/// What a contact of the pair means.
enum class PairRole {
  kNeverTouch,      ///< `collision`
  kFlutesPart,      ///< `gouge`, `rapid-contact`
  kThinShankPart,   ///< As flutes within the tolerance, else `collision`.
  kFlutesBlank,     ///< `stock-contact` in a rapid; in a feed the first cut.
  kThinShankBlank,  ///< `stock-contact` until the first cut, then nothing.
  kOtherBlank,      ///< `stock-contact`: an error until the first cut, then a warning.
};

/// Two bodies that can move against each other. A is a tool body or, in a pair of meshes, whichever
/// gives the smaller motion bound; names are tool side first.
struct Pair {
  PairRole role = PairRole::kNeverTouch;
  std::shared_ptr<const ToolBody> tool;  ///< Null for a pair of meshes.
  std::shared_ptr<const MeshBody> mesh_a;
  std::shared_ptr<const MeshBody> b;
  std::vector<std::string> names;
  /// The same pair with one body blown up to what it sweeps about its own rotary joint, or null.
  /// Its clearance is never more than the pair's, and that joint does not move it: a turning
  /// platter costs it nothing.
  std::shared_ptr<const SweptPair> swept;

  const kinematics::Extent& extent_a() const { return tool ? tool->extent : mesh_a->extent; }
  int link_b() const { return b->extent.link; }
};

using MeshBodies = std::vector<std::shared_ptr<const MeshBody>>;

/// Pairs among the scene's bodies. Bodies that are rigid to each other are none, nor are two
/// machine links that the model declares so (Machine::disabled_pairs); nothing else is left out,
/// and nothing by sampling.
std::vector<Pair> ScenePairs(const machine::Machine& machine, const MeshBodies& bodies);

/// Pairs of a tool's bodies with the scene; those with a blank first, flutes before all.
std::vector<Pair> ToolPairs(const machine::Machine& machine, const machine::Tool& tool,
                            const MeshBodies& bodies);

}  // namespace ncsim::collision
