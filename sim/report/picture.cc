// SPDX-License-Identifier: BSD-3-Clause
#include "sim/report/picture.h"

#include <algorithm>
#include <utility>

#include "sim/collision/tessellate.h"

namespace ncsim::report {
namespace {

using machine::BodyKind;
using Color = std::array<float, 4>;

constexpr double kToolSagitta = 0.05;  // mm

Color ColorOf(BodyKind kind) {
  switch (kind) {
    case BodyKind::kFixture:
      return {0.36F, 0.47F, 0.60F, 1.0F};
    case BodyKind::kPart:
      return {0.72F, 0.66F, 0.50F, 1.0F};
    case BodyKind::kStock:
      return {0.72F, 0.74F, 0.76F, 0.35F};
    case BodyKind::kFlutes:
      return {0.86F, 0.70F, 0.26F, 1.0F};
    case BodyKind::kShank:
      return {0.66F, 0.68F, 0.71F, 1.0F};
    case BodyKind::kHolder:
      return {0.38F, 0.41F, 0.46F, 1.0F};
    case BodyKind::kMachine:
      break;
  }
  return {0.66F, 0.68F, 0.71F, 1.0F};
}

void AddTool(const machine::Tool& tool, int link, Picture* picture) {
  const auto add = [&](const char* word, BodyKind kind, const machine::Profile& profile) {
    if (profile.empty()) return;
    picture->bodies.push_back({machine::ToolBodyName(tool.number, word), kind, link, tool.number,
                               collision::Tessellate(profile, tool.length, kToolSagitta),
                               ColorOf(kind)});
  };
  add("flutes", BodyKind::kFlutes, tool.flutes);
  add("shank", BodyKind::kShank, tool.shank);
  add("holder", BodyKind::kHolder, tool.holder);
  picture->tools.push_back({tool.number, tool.name, tool.length, tool.diameter});
}

}  // namespace

Picture MakePicture(const machine::Machine& machine, std::vector<machine::Visual> visuals,
                    const machine::Scene& scene, const machine::ToolTable& tools,
                    const std::vector<int>& used_tools, Recording recording) {
  Picture picture;
  picture.machine = &machine;
  std::vector<bool> has_visual(machine.tree.links().size(), false);
  for (machine::Visual& visual : visuals) {
    has_visual[static_cast<std::size_t>(visual.link)] = true;
    const bool stated = visual.color != Color{};
    picture.bodies.push_back({std::move(visual.name), BodyKind::kMachine, visual.link, 0,
                              std::move(visual.mesh),
                              stated ? visual.color : ColorOf(BodyKind::kMachine)});
  }
  for (const machine::SceneBody& body : scene.bodies) {
    if (body.mesh.triangles.empty()) continue;
    const bool seen =
        body.kind == BodyKind::kMachine && has_visual[static_cast<std::size_t>(body.link)];
    if (seen) continue;
    picture.bodies.push_back({body.name, body.kind, body.link, 0, body.mesh, ColorOf(body.kind)});
  }
  for (const int number : used_tools) {
    const machine::Tool* tool = tools.Find(number);
    if (tool != nullptr) AddTool(*tool, machine.spindle_link, &picture);
  }
  picture.recording = std::move(recording);
  return picture;
}

}  // namespace ncsim::report
