// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>

#include "sim/collision/clearance_probe.h"
#include "sim/report/page.h"

namespace ncsim::report {
namespace {

int ToolAt(const Recording& recording, std::uint32_t tick) {
  const auto after =
      std::upper_bound(recording.steps.begin(), recording.steps.end(), tick,
                       [](std::uint32_t t, const Step& step) { return t < step.begin; });
  return after == recording.steps.begin() ? 0 : std::prev(after)->tool;
}

}  // namespace

ClearanceTrack LookAtClearance(const machine::Machine& machine, const machine::Scene& scene,
                               const machine::ToolTable& tools, const Recording& recording,
                               const std::vector<Finding>& findings, int count) {
  ClearanceTrack track;
  if (recording.ticks.empty()) return track;
  std::set<std::uint32_t> ticks;
  for (int i = 0; i <= count; ++i) {
    ticks.insert(static_cast<std::uint32_t>(std::llround(1.0 * recording.end * i / count)));
  }
  for (const Finding& finding : findings) {
    if (!finding.time_s || ticks.size() > 2U * static_cast<std::size_t>(count)) continue;
    ticks.insert(static_cast<std::uint32_t>(std::llround(*finding.time_s * kTicksPerSecond)));
  }
  collision::ClearanceProbe probe(machine, scene, tools);
  for (const std::uint32_t tick : ticks) {
    const auto seen = probe.At(recording.PoseAt(tick), ToolAt(recording, tick));
    if (!seen) continue;
    const auto known = std::find(track.pairs.begin(), track.pairs.end(), *seen->bodies);
    const auto pair = static_cast<int>(known - track.pairs.begin());
    if (known == track.pairs.end()) track.pairs.push_back(*seen->bodies);
    track.samples.push_back({tick, seen->clearance_mm, pair});
  }
  return track;
}

}  // namespace ncsim::report
