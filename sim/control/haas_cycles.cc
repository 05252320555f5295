// SPDX-License-Identifier: BSD-3-Clause
// Canned cycles, hole patterns and circular pockets (Haas NGC Mill Operator's Manual 2017, "Canned
// Cycles", G12/G13, G70-G72): from words to the dialect-neutral geometry.
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/control/haas_interpreter.h"
#include "sim/control/hole_patterns.h"
#include "sim/control/limits.h"
#include "sim/control/pocket_cycles.h"

namespace ncsim::control {

bool HaasInterpreter::pattern() const {
  if (non_modal_ == nullptr) return false;
  const int code = non_modal_->spec->number_x10;
  return code >= 700 && code <= 720;
}

// A motion code cancels a cycle as G80 does (manual, G00); of the two in one block the later
// counts.
void HaasInterpreter::UpdateCycle() {
  const CodeUse* motion = CodeOf(kGroupMotion);
  const CodeUse* cycle = CodeOf(kGroupCycle);
  if (motion != nullptr) codes_[kGroupMotion] = motion->spec->number_x10;
  const bool starts = cycle != nullptr && cycle->spec->number_x10 != 800 &&
                      (motion == nullptr || motion->word->column < cycle->word->column);
  if (!starts) {
    if (motion == nullptr && cycle == nullptr) return;
    codes_[kGroupCycle] = 800;
    cycle_.dwell = 0.0;  // P holds until G00, G01 or G80.
    return;
  }
  if (!cycle_active()) {
    const double dwell = cycle_.dwell;
    cycle_ = CycleWords();
    cycle_.r = cycle_.z = std::nan("");
    cycle_.dwell = dwell;
    cycle_initial_level_ = position_[static_cast<std::size_t>(AxesOf(plane_).normal)];
  }
  codes_[kGroupCycle] = cycle->spec->number_x10;
  cycle_.code = cycle->spec->number_x10 / 10;
  defining_ = true;
}

// In G91, R counts from the level now and Z from R.
bool HaasInterpreter::TakeCycleWords() {
  const int normal = AxesOf(plane_).normal;
  const double level = position_[static_cast<std::size_t>(normal)];
  if (block_.Has('R')) cycle_.r = block_.Length('R') + (incremental() ? level : 0.0);
  if ((MachineAxisWords() & 1U << normal) != 0) {
    cycle_.z = block_.Axis(normal) + (incremental() ? cycle_.r : 0.0);
  }
  if (block_.Has('Q')) cycle_.q = block_.Length('Q');
  if (block_.Has('P')) cycle_.dwell = block_.Seconds('P');
  const bool tapping = cycle_.code == 74 || cycle_.code == 84;
  if (!pattern()) {
    if (tapping && block_.Has('J')) cycle_.retract_feed_factor = block_.Number('J');
    if (block_.Has('I')) cycle_.i = block_.Length('I');
    if (block_.Has('J')) cycle_.j = block_.Length('J');
    if (block_.Has('K')) cycle_.k = block_.Length('K');
  }
  block_.Take("E");  // Speed of the reversal that throws chips off.
  cycle_.return_to_initial = IsSet(kGroupReturn, 98);
  if (!(cycle_.retract_feed_factor > 0.0)) {
    Alarm('J', "J must be greater than 0");
    return false;
  }
  return true;
}

// A cycle drills in each block that names an axis of its plane or a rotary one; its own block also
// without one when setting 28 is on; never with L0 (manual, "Canned Cycles").
bool HaasInterpreter::ExecuteCycle() {
  if (!TakeCycleWords()) return false;
  if (pattern()) return ExecutePattern();
  const unsigned words = MachineAxisWords();
  const AxisValues values = TakeAxisWords(words);
  int repeats = 1;
  if (block_.Has('L')) {
    const std::optional<int> l = block_.Integer('L', 0, kMaxHoleRepeats);
    if (!l) return false;
    repeats = *l;
  }
  if (words == 0) {
    if (!defining_ || repeats == 0) return true;
    AssumeUnlessStated("setting 28", "setting 28",
                       "ON: a canned cycle drills in its own block without X or Y");
    if (!settings_.cycle_without_xy) return true;
  }
  for (int i = 0; i < repeats; ++i) {
    command_.named = static_cast<std::uint8_t>(words);
    if (!DrillHole(Target(words, values))) return false;
  }
  return true;
}

bool HaasInterpreter::DrillHole(const AxisValues& hole) {
  if (tcp()) {
    Unsupported("cycle under G234", block_.where(),
                "the manual does not say how canned cycles run while G234 is active");
  }
  if (dwo() && (command_.named & kRotaryAxes) != 0) {
    Unsupported("cycle turns under G254", block_.where(),
                "a canned cycle that turns a rotary axis while G254 is active is not simulated");
    return true;
  }
  if (cycle_.code == 73 || cycle_.code == 83) {
    AssumeUnlessStated("setting 22", "setting 22", "0: no distance above the last depth");
  }
  // A cycle starts the spindle, forward if no direction was commanded; after M05 it does not turn.
  if (spindle_ == 0) spindle_ = spindle_command_.value_or(1);
  command_.spindle_on = spindle_ != 0 && rpm_ > 0.0;
  if (!CheckFeed()) return false;
  BeforeLinearMotion(true);
  command_.cycle = ++cycle_count_;
  std::string error;
  const auto end = ExpandCycle(
      cycle_, settings_.cycles, command_, position_, hole, cycle_initial_level_,
      [this](const Command& command) { contour_.Push(command); }, &error);
  if (!end) {
    log_.Alarm(Rule::kControlAlarm, block_.where(), std::move(error));
    return false;
  }
  position_ = *end;
  return !log_.stopped();
}

bool HaasInterpreter::ExecutePattern() {
  PatternWords words;
  words.code = non_modal_->spec->number_x10 / 10;
  words.distance = block_.OptionalLength('I').value_or(0.0);
  if (block_.Has('J')) words.angle = block_.Angle('J');
  if (block_.Has('K')) words.spacing = block_.Angle('K');
  if (block_.Has('L')) words.count = block_.Number('L');
  std::string error;
  const auto holes = HolePattern(words, plane_, position_, &error);
  if (!holes) {
    log_.Alarm(Rule::kControlAlarm, block_.where(), std::move(error));
    return false;
  }
  if (const unsigned axes = MachineAxisWords(); axes != 0) {
    TakeAxisWords(axes);
    Unsupported("pattern with axes", block_.where(),
                CodeName('G', words.code) + " with axis words: the manual wants it alone");
  }
  for (const AxisValues& hole : *holes) {
    command_.named = 0;
    if (!DrillHole(hole)) return false;
  }
  return true;
}

// G12, G13: D is the last one where the block has none (manual, G12/G13). In G91, L repeats step Z.
bool HaasInterpreter::ExecutePocket(bool clockwise) {
  CircularPocketWords words;
  words.clockwise = clockwise;
  words.first_radius = block_.OptionalLength('I').value_or(0.0);
  words.radius = block_.OptionalLength('K');
  words.stepover = block_.OptionalLength('Q');
  const double d = parts_.registers->Tool(ToolRegister::kDiameter, d_) +
                   parts_.registers->Tool(ToolRegister::kDiameterWear, d_);
  words.tool_radius = settings_.diameter_d ? 0.5 * d : d;
  if (!has_d_) {
    Unsupported("pocket without D", block_.where(), "G12 or G13 with no D in force");
  }
  int repeats = 1;
  if (block_.Has('L')) {
    const std::optional<int> l = block_.Integer('L', 0, kMaxHoleRepeats);
    if (!l) return false;
    repeats = *l;
  }
  const bool has_z = (MachineAxisWords() & 1U << kZ) != 0;
  const double z = has_z ? block_.Axis(kZ) : 0.0;
  if (!CheckFeed()) return false;
  BeforeLinearMotion(true);
  command_.comp = Command::Comp::kOff;
  for (int i = 0; i < repeats; ++i) {
    words.depth = !has_z ? position_[kZ] : incremental() ? position_[kZ] + z : z;
    std::string error;
    const auto end = ExpandCircularPocket(
        words, command_, position_, [this](const Command& command) { contour_.Push(command); },
        &error);
    if (!end) {
      log_.Alarm(Rule::kControlAlarm, block_.where(), std::move(error));
      return false;
    }
    position_ = *end;
    if (log_.stopped()) return false;
  }
  return true;
}

}  // namespace ncsim::control
