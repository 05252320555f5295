// SPDX-License-Identifier: BSD-3-Clause
// CYCLE statements. The words of NX, Creo (whose vocabulary gives FEDTO and DEPTH, RAPTO and CLEAR,
// RTRCTO and RETURN one number each) and SolidWorks CAM do not clash, so one grammar reads all.
#include <array>
#include <utility>

#include "post/cl_words.h"

namespace ncsim::post {
namespace {

using Kind = ClCycleKind;

bool TakeAny(ClArguments& arguments, std::initializer_list<std::string_view> words) {
  for (const std::string_view word : words) {
    if (arguments.Take(word)) return true;
  }
  return false;
}

bool TakeKind(ClArguments& arguments, Kind* kind) {
  constexpr std::array<std::pair<std::string_view, Kind>, 10> kKinds = {
      {{"DRILL", Kind::kDrill},
       {"DEEP", Kind::kDeep},
       {"DEEP2", Kind::kDeep},
       {"BRKCHP", Kind::kBreakChip},
       {"TAP", Kind::kTap},
       {"REAM", Kind::kReam},
       {"BORE", Kind::kBore},
       {"FACE", Kind::kFace},
       {"CSINK", Kind::kCounterSink},
       {"THRU", Kind::kThru}}};
  for (const auto& [word, meaning] : kKinds) {
    if (!arguments.Take(word)) continue;
    *kind = meaning;
    return true;
  }
  return false;
}

/// DEEP or BRKCHP after DRILL, and how a boring bar comes out.
void TakeVariant(ClArguments& arguments, Kind* kind) {
  if (*kind == Kind::kDrill) {
    if (arguments.Take("DEEP")) *kind = Kind::kDeep;
    if (arguments.Take("BRKCHP")) *kind = Kind::kBreakChip;
  } else if (*kind == Kind::kBore) {
    if (arguments.Take("DRAG")) *kind = Kind::kBoreDrag;
    if (arguments.Take("NODRAG")) *kind = Kind::kBoreNoDrag;
    if (arguments.Take("BACK")) *kind = Kind::kBoreBack;
    if (arguments.Take("MANUAL")) *kind = Kind::kBoreManual;
  }
}

void TakeRetract(ClArguments& arguments, cl::Cycle* cycle) {
  if (arguments.Take("AUTO")) {
    cycle->retract = cl::Cycle::Retract::kAuto;
    return;
  }
  cycle->retract = cl::Cycle::Retract::kDistance;
  cycle->retract_distance = arguments.Number("a retract distance");
  arguments.Take("MANUAL");
}

void TakeDwell(ClArguments& arguments, cl::Cycle* cycle) {
  cycle->dwell_in_revolutions = arguments.Take("REV");
  cycle->dwell = arguments.Number("a dwell");
  if (*cycle->dwell < 0.0) arguments.Error("a dwell of less than nothing");
}

/// Distances, dwell and steps; false where the next value is none of them.
bool TakeParameter(ClArguments& arguments, cl::Cycle* cycle) {
  if (TakeAny(arguments, {"RAPTO", "CLEAR"})) {
    cycle->clearance = arguments.Number("a clearance");
  } else if (TakeAny(arguments, {"FEDTO", "DEPTH"})) {
    cycle->depth = arguments.Number("a depth");
  } else if (TakeAny(arguments, {"RTRCTO", "RETURN"})) {
    TakeRetract(arguments, cycle);
  } else if (arguments.Take("DWELL")) {
    TakeDwell(arguments, cycle);
  } else if (TakeAny(arguments, {"STEP", "INCR", "PECK", "1STPECK", "SUBPECK"})) {
    cycle->steps.push_back(arguments.Number("a step"));
    for (const double step : arguments.Numbers()) cycle->steps.push_back(step);
  } else if (arguments.Take("CSINK")) {
    cycle->sink_diameter = arguments.Number("a diameter");
  } else if (arguments.Take("TPI")) {
    const double threads = arguments.Number("threads per inch");
    if (threads <= 0.0) arguments.Error("TPI without threads");
    cycle->feed = cl::Feed{1.0 / threads, ClFeedUnit::kInchPerRev};
  } else if (const std::optional<ClFeedUnit> unit = TakeFeedUnit(arguments)) {
    cycle->feed = cl::Feed{arguments.Number("a feed rate"), unit};
  } else {
    return false;
  }
  return true;
}

}  // namespace

ClStatement ParseCycle(ClArguments& arguments) {
  using What = cl::CycleSwitch::What;
  constexpr std::array<std::pair<std::string_view, What>, 4> kSwitches = {
      {{"OFF", What::kOff}, {"ON", What::kOn}, {"INIT", What::kInit}, {"CLEAR", What::kClear}}};
  for (const auto& [word, what] : kSwitches) {
    if (arguments.left() == 1 && arguments.Take(word)) return cl::CycleSwitch{what};
  }
  cl::Cycle cycle;
  if (!TakeKind(arguments, &cycle.kind)) {
    arguments.Error(Quoted(arguments.Peek()) + " is no cycle that is known");
  }
  TakeVariant(arguments, &cycle.kind);
  while (arguments.ok() && !arguments.done() && TakeParameter(arguments, &cycle)) {
  }
  if (arguments.done() && !cycle.depth) arguments.Error("CYCLE without FEDTO or DEPTH");
  if (arguments.done() && !cycle.clearance) arguments.Error("CYCLE without RAPTO or CLEAR");
  for (const double step : cycle.steps) {
    if (step <= 0.0) arguments.Error("a step should be greater than 0");
  }
  return cycle;
}

}  // namespace ncsim::post
