// SPDX-License-Identifier: BSD-3-Clause
// What a run looks like: the bodies as they are shown, and their motion. Its writers are gltf.cc
// and html_report.cc.
#pragma once

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include "sim/machine/load.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"
#include "sim/report/recording.h"

namespace ncsim::report {

struct ShownBody {
  std::string name;  ///< As findings call it; a machine's visual shape has its link's name.
  machine::BodyKind kind = machine::BodyKind::kMachine;
  int link = 0;
  int tool = 0;                  ///< T number; 0: always there.
  machine::TriangleMesh mesh;    ///< In link coordinates, mm.
  std::array<float, 4> color{};  ///< Red, green, blue (sRGB), opacity; 0 to 1.
};

/// A tool that was in the spindle.
struct ShownTool {
  int number = 0;
  std::string name;
  double length = 0.0;    ///< Gauge line to tip, mm.
  double diameter = 0.0;  ///< mm
};

struct Picture {
  const machine::Machine* machine = nullptr;
  std::vector<ShownBody> bodies;
  std::vector<ShownTool> tools;
  Recording recording;
};

/// Links as their visual shapes, or their collision shapes where they have none; tools in the order
/// of `used_tools`. The machine must outlive the picture.
Picture MakePicture(const machine::Machine& machine, std::vector<machine::Visual> visuals,
                    const machine::Scene& scene, const machine::ToolTable& tools,
                    const std::vector<int>& used_tools, Recording recording);

/// Binary glTF 2.0 with one animation: metres, Y up; a node a link. docs/gltf.md describes it.
void WriteGltf(const Picture& picture, std::ostream& out);

}  // namespace ncsim::report
