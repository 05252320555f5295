// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/haas_registers.h"

#include "sim/control/part_frames.h"

namespace ncsim::control {
namespace {

constexpr std::uint8_t kXyz = 1U << kX | 1U << kY | 1U << kZ;

}  // namespace

HaasRegisters::HaasRegisters(const machine::Machine& machine, const machine::Job& job,
                             const machine::ToolTable& tools, bool radius_d)
    : at_mount_(GaugeAtMount(machine)) {
  for (int index = 0; index < kNumWorkOffsets; ++index) {
    const auto values =
        job.offsets.empty() ? std::nullopt : JobOffset(machine, job, OffsetName(index));
    if (!values) continue;
    Offset& offset = offsets_[static_cast<std::size_t>(index)];
    offset.stated = (1U << kNumAxes) - 1;
    offset.values = *values;
  }
  for (const machine::Tool& tool : tools.tools) {
    if (tool.number < 1 || tool.number > kMaxToolOffset) continue;
    SetTool(ToolRegister::kLength, tool.number, tool.h_geometry);
    SetTool(ToolRegister::kLengthWear, tool.number, tool.h_wear);
    // A D that the job does not state is the cutter's diameter, as a radius where those are held.
    const bool halve = radius_d && tool.d_geometry == tool.diameter;
    SetTool(ToolRegister::kDiameter, tool.number, halve ? 0.5 * tool.diameter : tool.d_geometry);
    SetTool(ToolRegister::kDiameterWear, tool.number, tool.d_wear);
  }
}

std::string HaasRegisters::OffsetName(int index) {
  if (index <= kFirstG154) return "G" + std::to_string(54 + index);
  return "G154 P" + std::to_string(index - kFirstG154);
}

AxisValues HaasRegisters::WorkOffset(int index) const {
  const Offset& offset = offsets_[static_cast<std::size_t>(index)];
  AxisValues values = offset.values;
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    if ((offset.stated & 1U << axis) == 0) values[axis] = at_mount_[axis];
  }
  return values;
}

void HaasRegisters::SetWorkOffset(int index, int axis, double value) {
  Offset& offset = offsets_[static_cast<std::size_t>(index)];
  offset.values[static_cast<std::size_t>(axis)] = value;
  offset.stated |= static_cast<std::uint8_t>(1U << axis);
}

bool HaasRegisters::IsStated(int index) const {
  return (offsets_[static_cast<std::size_t>(index)].stated & kXyz) == kXyz;
}

double HaasRegisters::Tool(ToolRegister which, int number) const {
  if (number < 1 || number > kMaxToolOffset) return 0.0;
  return tools_[static_cast<std::size_t>(which)][static_cast<std::size_t>(number)];
}

void HaasRegisters::SetTool(ToolRegister which, int number, double value) {
  if (number < 1 || number > kMaxToolOffset) return;
  tools_[static_cast<std::size_t>(which)][static_cast<std::size_t>(number)] = value;
}

}  // namespace ncsim::control
