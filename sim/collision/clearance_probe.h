// SPDX-License-Identifier: BSD-3-Clause
// The least clearance at single poses, for a plot. Nothing is proven with it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/machine/machine.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"

namespace ncsim::collision {

struct SeenClearance {
  double clearance_mm = 0.0;                         ///< To 0.05 mm or 2 %; 0 or less in contact.
  const std::vector<std::string>* bodies = nullptr;  ///< Tool side first; of the probe.
};

/// Looks at the pairs that must never touch: neither flutes nor thin shanks against the part, and
/// nothing against the blank.
class ClearanceProbe {
 public:
  /// All outlive it.
  ClearanceProbe(const machine::Machine& machine, const machine::Scene& scene,
                 const machine::ToolTable& tools);
  ~ClearanceProbe();

  /// With T`tool` in the spindle (0: none). nullopt: there is no such pair.
  std::optional<SeenClearance> At(const kinematics::JointVector& q, int tool);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::collision
