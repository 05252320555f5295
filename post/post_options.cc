// SPDX-License-Identifier: BSD-3-Clause
#include "post/post_options.h"

namespace ncsim::post {

PlanOptions PlanOptionsOf(const PostData& post, std::string_view mode) {
  PlanOptions options;
  if (const PostMode* named = post.ModeNamed(mode)) options.mode = named->kind;
  for (const PlanMode kind : {PlanMode::kIndexed, PlanMode::kTcp, PlanMode::kAxes}) {
    PlanAbilities& abilities = options.abilities[static_cast<std::size_t>(kind)];
    abilities = {{false, false, false}, false, false, false, 0.0, false, false};
    const PostMode* one = post.Mode(kind, mode);
    if (one == nullptr) continue;
    for (const PlanPlane plane : one->arc_planes) {
      abilities.arcs[static_cast<std::size_t>(plane)] = true;
    }
    abilities.helices = one->helices;
    abilities.holes = one->cycles;
    abilities.great_circle = one->great_circle;
    abilities.pole_limit = one->pole_limit;
    abilities.compensation = one->compensation;
    abilities.rate_alarm = one->rate_alarm;
    if (kind == PlanMode::kIndexed) {
      options.turned_planes = one->frame == PostMode::Frame::kPlane;
    }
  }
  return options;
}

}  // namespace ncsim::post
