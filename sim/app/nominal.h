// SPDX-License-Identifier: BSD-3-Clause
// Nominal data near a contact: a shape of the machine, or the tool-change pose, that nobody
// measured and that something comes close to. Within kNominalMargin the verdict rests on it.
#pragma once

#include <vector>

#include "sim/base/finding.h"
#include "sim/collision/checker.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"
#include "sim/motion/window.h"

namespace ncsim::app {

/// "nominal shapes", where the model's shapes are nominal and one of them was seen nearer than the
/// margin to something.
std::vector<Assumption> NominalShapes(const machine::Machine& machine, const machine::Scene& scene,
                                      const std::vector<collision::PairClearance>& clearances);

/// Poses in which the machine changes tools, each with the old and with the new tool.
class ToolChangePoses {
 public:
  /// Motions in program order.
  void OnMotion(const motion::Motion& motion);
  const motion::Window& poses() const { return poses_; }

 private:
  void Add(const motion::Motion& change, int tool);

  motion::Window poses_;
  bool waiting_ = false;  // for the motion that shows the new tool
  motion::Motion change_;
};

/// "tool-change pose", where the model's pose is nominal and a body is nearer than the margin to
/// another in it.
std::vector<Assumption> NominalToolChange(const machine::Machine& machine,
                                          const machine::Scene& scene,
                                          const machine::ToolTable& tools,
                                          const ToolChangePoses& poses);

}  // namespace ncsim::app
