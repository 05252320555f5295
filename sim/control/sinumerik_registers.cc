// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_registers.h"

#include "sim/control/part_frames.h"

namespace ncsim::control {
namespace {

constexpr int kLength = 3, kRadius = 6, kLengthWear = 12, kRadiusWear = 15;  // $TC_DPn
constexpr int kFirstExtended = 5;                                            // G505 is $P_UIFR[5]

}  // namespace

SinumerikRegisters::SinumerikRegisters(const machine::Machine& machine, const machine::Job& job,
                                       const machine::ToolTable& tools) {
  const AxisValues at_mount = GaugeAtMount(machine);
  for (int index = 0; index < kNumSettableFrames; ++index) {
    SettableFrame& frame = frames_[static_cast<std::size_t>(index)];
    const auto values =
        job.offsets.empty() ? std::nullopt : JobOffset(machine, job, FrameName(index));
    frame.stated = values.has_value() || index == 0;
    if (values) frame.coarse = *values;
    if (!frame.stated) frame.coarse = at_mount;
  }
  const auto set = [&](int tool, int edge, double length, double wear, double radius,
                       double radius_wear) {
    edges_[{tool, edge}] = {
        {kLength, length}, {kLengthWear, wear}, {kRadius, radius}, {kRadiusWear, radius_wear}};
  };
  for (const machine::Tool& tool : tools.tools) {
    if (tool.edges.empty()) {
      set(tool.number, 1, tool.h_geometry, tool.h_wear, 0.5 * tool.d_geometry, 0.5 * tool.d_wear);
    }
    for (const machine::ToolEdge& edge : tool.edges) {
      set(tool.number, edge.number, edge.length, edge.length_wear, 0.5 * edge.diameter,
          0.5 * edge.diameter_wear);
    }
  }
}

std::string SinumerikRegisters::FrameName(int index) {
  if (index == 0) return "G500";
  return "G" + std::to_string(index < kFirstExtended ? 53 + index : 500 + index);
}

std::optional<EdgeData> SinumerikRegisters::Edge(int tool, int edge) const {
  if (edge == 0 || tool == 0) return EdgeData{};
  if (edges_.count({tool, edge}) == 0) return std::nullopt;
  const auto sum = [&](int a, int b) {
    return Parameter(a, tool, edge) + Parameter(b, tool, edge);
  };
  return EdgeData{sum(kLength, kLengthWear), sum(kRadius, kRadiusWear)};
}

double SinumerikRegisters::Parameter(int number, int tool, int edge) const {
  const auto found = edges_.find({tool, edge});
  if (found == edges_.end()) return 0.0;
  const auto value = found->second.find(number);
  return value == found->second.end() ? 0.0 : value->second;
}

void SinumerikRegisters::SetParameter(int number, int tool, int edge, double value) {
  edges_[{tool, edge}][number] = value;
}

}  // namespace ncsim::control
