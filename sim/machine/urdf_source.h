// SPDX-License-Identifier: BSD-3-Clause
// A pass over a URDF's XML that knows lines. It refuses what urdfdom drops or takes in silence;
// urdfdom then gives the values. tinyxml2 stays behind it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/base/diagnostics.h"

namespace ncsim::machine {

/// What the XML states, in the order of the file.
struct UrdfSource {
  struct Link {
    std::string name;
    int line = 0;
    std::vector<int> collision_lines;
    std::vector<int> visual_lines;
    bool faulty = false;  ///< An error was reported inside it.
  };
  struct Joint {
    std::string name;
    int line = 0;
    std::string parent, child;
  };
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
  bool broken =
      false;  ///< Something was reported that urdfdom must not see, or that leaves no tree.
};

/// Reports everything wrong in `text`. nullopt when it is not XML, or not a URDF.
std::optional<UrdfSource> ReadUrdfSource(const std::string& text, const std::string& file,
                                         Diagnostics* diagnostics);

}  // namespace ncsim::machine
