// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>

#include "sim/collision/clearance_probe.h"
#include "sim/report/page.h"

namespace ncsim::report {
namespace {

constexpr std::size_t kNearest = 12;
constexpr int kMostVisits = 4;
constexpr int kLooksInABlock = 40;

int ToolAt(const Recording& recording, std::uint32_t tick) {
  const auto after =
      std::upper_bound(recording.steps.begin(), recording.steps.end(), tick,
                       [](std::uint32_t t, const Step& step) { return t < step.begin; });
  return after == recording.steps.begin() ? 0 : std::prev(after)->tool;
}

/// Instants in the blocks that the nearest pairs' clearances are told of.
void AddNearest(const Recording& recording, std::vector<collision::PairClearance> clearances,
                std::set<std::uint32_t>* ticks) {
  const auto count = std::min(kNearest, clearances.size());
  std::partial_sort(clearances.begin(), clearances.begin() + static_cast<std::ptrdiff_t>(count),
                    clearances.end(),
                    [](const auto& a, const auto& b) { return a.proven_mm < b.proven_mm; });
  const std::vector<Step>& steps = recording.steps;
  for (std::size_t i = 0; i < count; ++i) {
    const SourcePosition& where = clearances[i].where;
    int visits = 0;
    for (std::size_t k = 0; k < steps.size() && visits < kMostVisits; ++k) {
      if (steps[k].where.file != where.file || steps[k].where.line != where.line) continue;
      ++visits;
      const double begin = steps[k].begin;
      const double end = k + 1 < steps.size() ? steps[k + 1].begin : recording.end;
      for (int part = 0; part <= kLooksInABlock; ++part) {
        const double tick = std::lerp(begin, end, static_cast<double>(part) / kLooksInABlock);
        ticks->insert(static_cast<std::uint32_t>(std::llround(tick)));
      }
    }
  }
}

}  // namespace

ClearanceTrack LookAtClearance(const machine::Machine& machine, const machine::Scene& scene,
                               const machine::ToolTable& tools, const Recording& recording,
                               const CheckResult& result, int count) {
  ClearanceTrack track;
  if (recording.ticks.empty()) return track;
  std::set<std::uint32_t> ticks;
  for (int i = 0; i <= count; ++i) {
    ticks.insert(static_cast<std::uint32_t>(std::llround(1.0 * recording.end * i / count)));
  }
  for (const Finding& finding : result.findings) {
    if (!finding.time_s || ticks.size() > 2U * static_cast<std::size_t>(count)) continue;
    ticks.insert(static_cast<std::uint32_t>(std::llround(*finding.time_s * kTicksPerSecond)));
  }
  AddNearest(recording, result.clearances, &ticks);
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
