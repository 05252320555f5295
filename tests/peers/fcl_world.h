// SPDX-License-Identifier: BSD-3-Clause
// Collision checking by sampling poses with FCL, as programs without a certificate do it: what the
// certified checker is measured against. Same bodies and same pairs, but for flutes and part, which
// touch by design. FCL stays behind this header.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/machine/machine.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"
#include "sim/motion/motion.h"

namespace ncsim::peers {

enum class Arrangement {
  kPlain,     ///< The tool as cylinders and a sphere; fcl::collide for every pair.
  kBest,      ///< The tool as OBBRSS meshes; dynamic AABB trees for spindle, table and the rest.
  kDistance,  ///< As kBest, but fcl::distance for every pair: what a least clearance costs.
};

/// Poses of a motion that sampling looks at beyond its start: every 0.1 mm of the tip's way over
/// the table and every 0.05 degrees of a rotary axis. (Links far from the table may move more than
/// 0.1 mm between two of them.)
int SampleCount(const machine::Machine& machine, double tool_length, const motion::Motion& motion);

class FclWorld {
 public:
  FclWorld(const machine::Machine& machine, const machine::Scene& scene, const machine::Tool& tool,
           Arrangement arrangement);
  ~FclWorld();

  /// Samples one motion. False from the first contact on.
  bool Check(const motion::Motion& motion);

  /// Names of the two bodies in contact, tool first; empty where there is none.
  const std::vector<std::string>& contact() const;
  /// Names of all pairs, tool first.
  std::vector<std::vector<std::string>> pairs() const;
  std::uint64_t samples() const;
  /// Calls of fcl::collide or fcl::distance.
  std::uint64_t calls() const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace ncsim::peers
