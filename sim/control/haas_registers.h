// SPDX-License-Identifier: BSD-3-Clause
// What a Haas NGC keeps in its offset pages: work offsets, the G52 and G92 shifts, tool lengths and
// diameters. Inside units (mm, rad).
#pragma once

#include <array>
#include <string>

#include "sim/control/command.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/tool.h"

namespace ncsim::control {

/// G54 ... G59 are 0 ... 5; G154 P1 ... P99 (G110 ... G129 are P1 ... P20) are 6 ... 104.
inline constexpr int kNumWorkOffsets = 105;
inline constexpr int kFirstG154 = 5;  ///< G154 Pn is kFirstG154 + n.
/// Numbers of H and D (Haas NGC Mill Operator's Manual 2017, G10: P 1-200).
inline constexpr int kMaxToolOffset = 200;

enum class ToolRegister { kLength, kLengthWear, kDiameter, kDiameterWear };

class HaasRegisters {
 public:
  /// `radius_d`: setting 40 is RADIUS, so D registers hold radii.
  HaasRegisters(const machine::Machine& machine, const machine::Job& job,
                const machine::ToolTable& tools, bool radius_d);

  static std::string OffsetName(int index);
  AxisValues WorkOffset(int index) const;
  void SetWorkOffset(int index, int axis, double value);
  /// False: X, Y or Z come neither from the job nor from the program, so WorkOffset() assumes them.
  bool IsStated(int index) const;

  double Tool(ToolRegister which, int number) const;
  void SetTool(ToolRegister which, int number, double value);

  AxisValues g52{};  ///< Global shift.
  AxisValues g92{};

 private:
  struct Offset {
    AxisValues values{};
    std::uint8_t stated = 0;  ///< Bit per AxisIndex.
  };
  std::array<Offset, kNumWorkOffsets> offsets_;
  AxisValues at_mount_{};  ///< Gauge line on the table's mount, rotary axes at 0.
  std::array<std::array<double, kMaxToolOffset + 1>, 4> tools_{};
};

}  // namespace ncsim::control
