// SPDX-License-Identifier: BSD-3-Clause
// The SRDF beside a URDF: pairs of links that need no check or have a
// margin of their own, and named poses. docs/model-format.md
// lists what is read.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinematics/tree.h"
#include "sim/base/diagnostics.h"
#include "sim/machine/machine.h"

namespace ncsim::machine {

struct Srdf {
  std::vector<LinkPair> disabled_pairs;
  std::vector<LinkMargin> margins;
  /// Pose name -> joint index (JointVector) -> mm or rad; joints that a pose does not name are left
  /// out.
  std::map<std::string, std::map<int, double>> poses;
};

Srdf ReadSrdf(const std::string& path, const kinematics::KinematicTree& tree,
              Diagnostics* diagnostics);

}  // namespace ncsim::machine
