// SPDX-License-Identifier: BSD-3-Clause
// Tools that a program's own header comments list.
#pragma once

#include <string>
#include <vector>

#include "sim/nc/program.h"

namespace ncsim::nc {

/// Lengths are in the unit of the program, which is not known here.
struct HeaderTool {
  int number = 0;
  std::string name;
  double diameter = 0.0;
  double corner_radius = 0.0;
  bool has_corner_radius = false;
  int line = 0;
};

/// NX's TOOL TABLE SUMMARY and the `(T1 D=0.5 CR=0.25 - ZMIN=... - BALL END MILL)` lines of
/// Autodesk's posts. Reads comments up to the first block that moves an axis.
std::vector<HeaderTool> ReadHeaderTools(const Program& program);
/// The same of a SINUMERIK program, whose comments begin with a semicolon.
std::vector<HeaderTool> ReadSinumerikHeaderTools(const Program& program);

}  // namespace ncsim::nc
