// SPDX-License-Identifier: BSD-3-Clause
// M codes: all take effect at the block's end (Haas NGC Mill Operator's Manual 2017, "M-codes").
#include <utility>

#include "sim/base/text.h"
#include "sim/control/haas_interpreter.h"
#include "sim/control/tool_change.h"

namespace ncsim::control {

void HaasInterpreter::ExecuteM() {
  // The brakes of the fourth and the fifth axis: the rotary ones in the order A, B, C.
  std::uint8_t fourth = 0, fifth = 0;
  switch (block_.m_code() / 10) {
    case 0:
    case 1:
    case 2:
    case 30:
      if (block_.m_code() >= 0) StopProgram(block_.m_code() == 20 || block_.m_code() == 300);
      return;
    case 3:
      return CommandSpindle(1);
    case 4:
      return CommandSpindle(-1);
    case 5:
      return CommandSpindle(0);
    case 19:
    case 88:
    case 89:
      spindle_ = 0;
      return;
    case 6:
    case 16:
      return ToolChange();
    case 10:
    case 11:
    case 12:
    case 13:
      break;
    default:
      return;
  }
  for (int axis = kA; axis < kNumAxes; ++axis) {
    if (!axes_.has(axis)) continue;
    const auto bit = static_cast<std::uint8_t>(1U << axis);
    if (fourth == 0) {
      fourth = bit;
    } else if (fifth == 0) {
      fifth = bit;
    }
  }
  const int code = block_.m_code() / 10;
  const std::uint8_t bit = code <= 11 ? fourth : fifth;
  const bool on = code == 10 || code == 12;
  brakes_ = static_cast<std::uint8_t>(on ? brakes_ | bit : brakes_ & ~bit);
}

// M03, M04, M05. M19, M88 and M89 also stop the spindle, and M89 does not start it again.
void HaasInterpreter::CommandSpindle(int direction) {
  spindle_ = direction;
  spindle_command_ = direction;
}

void HaasInterpreter::StopProgram(bool end) {
  const bool optional = block_.m_code() == 10;
  if (optional) {
    AssumeUnlessStated("optional_stop", "optional stop", "off: M01 does not stop");
    if (!settings_.optional_stop) return;
  }
  contour_.Stop(block_.where(), !IsSet(kGroupComp, 40));
  spindle_ = 0;
  ended_ = end;
}

// T and M06: stop, Z up, X and Y to the change position, change; the axes stay there.
void HaasInterpreter::ToolChange() {
  if (next_tool_ < 0) {
    Alarm('M', "M06 without a T");
    return;
  }
  const std::string name = "T" + std::to_string(next_tool_);
  const machine::Tool* tool = parts_.tools->Find(next_tool_);
  const int pockets = parts_.machine->control.tool_pockets;
  if (pockets > 0 && next_tool_ > pockets) {
    log_.Report(Rule::kToolMissing, block_.WhereOf('T'),
                name + ": the tool changer has " + std::to_string(pockets) + " pockets");
  } else if (next_tool_ > 0 && tool == nullptr) {
    log_.Report(Rule::kToolMissing, block_.WhereOf('T'), name + " is not in the tool table");
  }
  spindle_ = 0;
  command_.spindle_on = false;
  MoveToToolChange();
  if (log_.stopped()) return;
  tool_ = next_tool_;
  command_.tool = tool_;
  PushMachine(CommandKind::kToolChange, 0, {});
  length_checked_ = false;
  tcp_cancelled_ = false;
  if (tool != nullptr && !tool->assumed.empty()) {
    log_.Assume("tool " + name, tool->assumed, true);
  }
}

// By settings 293-298 where they are stated, then to the model's pose; setting 247 ON: Z, X and Y
// at the same time.
void HaasInterpreter::MoveToToolChange() {
  AxisValues mid{};
  unsigned mid_stated = 0;
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    if (!settings_.tool_change_mid[axis]) continue;
    mid[axis] = *settings_.tool_change_mid[axis];
    mid_stated |= 1U << axis;
  }
  const ToolChangeWay way(parts_.machine->control);
  way.AssumePose(&log_);
  const auto go = [this](const AxisValues& target, unsigned axes) {
    if (axes != 0 && !log_.stopped()) PushMachine(CommandKind::kMachineRapid, axes, target);
  };
  go(mid, mid_stated & 1U << kZ);
  go(mid, mid_stated & ~(1U << kZ));
  if (settings_.tool_change_together) return go(way.pose, way.stated);
  for (const unsigned axes : way.steps) go(way.pose, axes);
}

}  // namespace ncsim::control
