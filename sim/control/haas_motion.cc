// SPDX-License-Identifier: BSD-3-Clause
// Motion: G00-G03, G04, G53, G28, G29 (Haas NGC Mill Operator's Manual 2017, same sections).
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/haas_interpreter.h"
#include "sim/control/limits.h"

namespace ncsim::control {

bool HaasInterpreter::ExecuteNonModal() {
  if (CodeOf(kGroupNonModal) != nullptr && !Dwell()) return false;
  for (const CodeUse& use : block_.g_codes()) {
    if (use.spec->number_x10 == 1870) SetCornerRounding();
  }
  if (non_modal_ == nullptr) return true;
  switch (non_modal_->spec->number_x10 / 10) {
    case 10:
      return SetOffsets();
    case 12:
      return ExecutePocket(true);
    case 13:
      return ExecutePocket(false);
    case 28:
      return ReturnHome();
    case 29:
      return ReturnFromReference();
    case 52:
      return SetShift();
    case 53:
      return MachineMove();
    case 92:
      return SetG92();
    default:
      return true;  // G70-G72 belong to the canned cycle.
  }
}

bool HaasInterpreter::Dwell() {
  if (!block_.Has('P')) {
    Alarm('G', "G04 needs P");
    return false;
  }
  command_.kind = CommandKind::kDwell;
  command_.dwell = block_.Seconds('P');
  command_.end = position_;
  command_.named = 0;
  contour_.Push(command_);
  return true;
}

// G187 Pn En; without E setting 85 holds again (manual, G187).
void HaasInterpreter::SetCornerRounding() {
  block_.Take("P");
  corner_rounding_ = block_.OptionalLength('E').value_or(settings_.corner_rounding);
  command_.corner_rounding = corner_rounding_;
}

unsigned HaasInterpreter::MachineAxisWords() const {
  unsigned words = block_.AxisWords();
  for (int axis = kX; axis < kNumAxes; ++axis) {
    if (!axes_.has(axis)) words &= ~(1U << axis);
  }
  return words;
}

AxisValues HaasInterpreter::TakeAxisWords(unsigned words) {
  AxisValues values{};
  for (int axis = kX; axis < kNumAxes; ++axis) {
    if ((words & 1U << axis) != 0) values[static_cast<std::size_t>(axis)] = block_.Axis(axis);
  }
  return values;
}

AxisValues HaasInterpreter::Target(unsigned words, const AxisValues& values) const {
  AxisValues end = position_;
  const bool adds = incremental();
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    if ((words & 1U << axis) != 0) end[axis] = adds ? end[axis] + values[axis] : values[axis];
  }
  return end;
}

ArcWords HaasInterpreter::TakeArcWords() {
  ArcWords arc;
  arc.clockwise = IsSet(kGroupMotion, 2);
  for (std::size_t i = 0; i < 3; ++i) arc.ijk[i] = block_.OptionalLength("IJK"[i]);
  arc.r = block_.OptionalLength('R');
  return arc;
}

bool HaasInterpreter::ExecuteMotion() {
  if (cycle_active()) return ExecuteCycle();
  if (pattern()) {
    Alarm('G', CodeName('G', non_modal_->word->value) + " needs an active canned cycle");
    return false;
  }
  const bool is_arc = IsSet(kGroupMotion, 2) || IsSet(kGroupMotion, 3);
  const unsigned words = MachineAxisWords();
  if (words == 0 && !(is_arc && block_.HasAnyOf("IJKR"))) return true;
  if (IsSet(kGroupMotion, 0)) block_.Take("E");  // Percentage of the rapid rate.
  const AxisValues values = TakeAxisWords(words);
  const ArcWords arc = is_arc ? TakeArcWords() : ArcWords();
  int repeats = 1;
  if (block_.Has('L')) {
    const std::optional<int> l = block_.Integer('L', 0, kMaxHoleRepeats);
    if (!l) return false;
    repeats = *l;
  }
  if (IsSet(kGroupMotion, 1)) {
    command_.corner_radius = block_.CommaLength('R').value_or(0.0);
    command_.corner_chamfer = block_.CommaLength('C').value_or(0.0);
  }
  if (!IsSet(kGroupMotion, 0)) {
    if (!CheckFeed()) return false;
    CheckCancelledTcp(words);
  }
  if ((words & kLinearAxes) != 0 || is_arc) BeforeLinearMotion((words & 1U << kZ) != 0 || tcp());
  for (int i = 0; i < repeats && !log_.stopped(); ++i) {
    if (!Move(words, values, arc)) return false;
  }
  return !log_.stopped();
}

bool HaasInterpreter::Move(unsigned words, const AxisValues& values, const ArcWords& arc) {
  command_.end = Target(words, values);
  command_.named = static_cast<std::uint8_t>(words);
  const bool turned = dwo() && (words & kRotaryAxes) != 0;
  if (IsSet(kGroupMotion, 0)) {
    command_.kind = CommandKind::kRapid;
  } else if (IsSet(kGroupMotion, 1)) {
    command_.kind = CommandKind::kFeed;
  } else {
    std::string error;
    if (!MakeArc(position_, arc, kHaasArcTolerance, &command_, &error)) {
      log_.Alarm(Rule::kArcError, block_.where(), std::move(error));
      return false;
    }
    if (turned) {
      Unsupported("arc under G254", block_.where(),
                  "an arc that turns a rotary axis while G254 is active is not simulated");
      return true;
    }
  }
  contour_.Push(command_);
  position_ = command_.end;
  // DWO follows the table: coordinates of axes that did not move have changed.
  if (turned) ResyncPosition();
  return !log_.stopped();
}

void HaasInterpreter::ResyncPosition() {
  position_ = parts_.frames->ToProgram(frame_, MachinePosition(true));
  contour_.SetPosition(position_);
}

bool HaasInterpreter::CheckFeed() {
  if (tool_ == 0 && !no_tool_reported_) {
    no_tool_reported_ = true;
    log_.Report(Rule::kToolMissing, block_.where(), "a feed move with no tool in the spindle");
  }
  const bool inverse = command_.feed_mode == Command::FeedMode::kInverseTime;
  if (command_.feed > 0.0 && (!inverse || feed_in_block_)) return true;
  std::string message = "a feed move without F";
  if (inverse) message = "G93 needs F in every block that feeds";
  if (feed_word_ > 0.0 && !inverse) message = "feed per revolution with the spindle speed 0";
  log_.Alarm(Rule::kFeedMissing, block_.where(), std::move(message));
  return false;
}

// A simultaneous feed in G94 is meant for G234 (without it the manual wants G93): where G43 or G44
// has cancelled it, the program runs in a frame that is no longer there.
void HaasInterpreter::CheckCancelledTcp(unsigned words) {
  if (!tcp_cancelled_ || tcp() || (words & kLinearAxes) == 0 || (words & kRotaryAxes) == 0 ||
      command_.feed_mode != Command::FeedMode::kPerMinute) {
    return;
  }
  tcp_cancelled_ = false;
  log_.Report(Rule::kFrameCancelled, block_.where(),
              "a simultaneous five-axis feed, but G43 or G44 has cancelled G234");
}

void HaasInterpreter::PushMachine(CommandKind kind, unsigned named, const AxisValues& target) {
  command_.kind = kind;
  command_.named = static_cast<std::uint8_t>(named);
  command_.end = target;
  command_.corner_radius = command_.corner_chamfer = 0.0;
  contour_.Push(command_);
  position_ = parts_.frames->ToProgram(frame_, parts_.to_motion->position());
  contour_.SetPosition(position_);
}

// G53 is absolute whatever G90/G91, and ignores offset, length, G234 and G254 (manual, G53).
bool HaasInterpreter::MachineMove() {
  const unsigned words = MachineAxisWords();
  const AxisValues values = TakeAxisWords(words);
  if (words == 0) return true;
  CommandKind kind = CommandKind::kMachineRapid;
  if (IsSet(kGroupMotion, 1)) {
    if (!CheckFeed()) return false;
    kind = CommandKind::kMachineFeed;
  } else if (!IsSet(kGroupMotion, 0)) {
    Unsupported("G53 arc", block_.where(), "G53 with G02 or G03 is not simulated");
    return true;
  }
  PushMachine(kind, words, values);
  return !log_.stopped();
}

// The point of G28 and G29, which ignore G234 and G254 (manual, G234 and G254).
AxisValues HaasInterpreter::PlainMachineTarget(unsigned words, const AxisValues& from) {
  AxisValues target = from;
  const AxisValues values = TakeAxisWords(words);
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    if ((words & 1U << axis) == 0) continue;
    const double length = axis == kZ ? frame_->tool_length : 0.0;
    target[axis] =
        incremental() ? from[axis] + values[axis] : frame_->offset[axis] + values[axis] + length;
  }
  return target;
}

// Setting 108 ON: a rotary axis keeps its whole turns, and reads home after less than one turn.
double HaasInterpreter::HomeTarget(int axis, double from) const {
  const machine::Axis& data = axes_.data(axis);
  if (!data.rotary || !settings_.quick_rotary_home) return data.home;
  const double turns = (from - data.home) / (2.0 * kPi);
  return data.home + 2.0 * kPi * std::trunc(turns + std::copysign(1e-9, turns));
}

bool HaasInterpreter::ReturnHome() {
  const AxisValues from = MachinePosition(true);
  unsigned words = MachineAxisWords();
  AxisValues target = from;
  if (words != 0) {
    target = PlainMachineTarget(words, from);
    PushMachine(CommandKind::kMachineRapid, words, target);
  } else {
    for (int axis = kX; axis < kNumAxes; ++axis) {
      if (axes_.has(axis)) words |= 1U << axis;
    }
  }
  g28_point_ = target;
  AxisValues home{};
  for (int axis = kX; axis < kNumAxes; ++axis) {
    const std::size_t i = static_cast<std::size_t>(axis);
    if ((words & 1U << axis) != 0) home[i] = HomeTarget(axis, target[i]);
  }
  PushMachine(CommandKind::kMachineRapid, words, home);
  if (!settings_.quick_rotary_home || log_.stopped()) return !log_.stopped();
  for (int axis = kA; axis < kNumAxes; ++axis) {
    if ((words & 1U << axis) != 0) parts_.to_motion->Renumber(axis, axes_.data(axis).home);
  }
  ResyncPosition();
  return true;
}

bool HaasInterpreter::ReturnFromReference() {
  if (!g28_point_) {
    Alarm('G', "G29 without a G28 before it");
    return false;
  }
  const AxisValues from = MachinePosition(true);
  const unsigned words = MachineAxisWords();
  if (words == 0) return true;
  const AxisValues target = PlainMachineTarget(words, from);
  PushMachine(CommandKind::kMachineRapid, words, *g28_point_);
  PushMachine(CommandKind::kMachineRapid, words, target);
  return !log_.stopped();
}

}  // namespace ncsim::control
