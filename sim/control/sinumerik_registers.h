// SPDX-License-Identifier: BSD-3-Clause
// What a SINUMERIK keeps: settable frames ($P_UIFR) and the edges of tools ($TC_DP). mm, rad.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/control/command.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/tool.h"

namespace ncsim::control {

/// G500, G54 ... G57, G505 ... G599: indices 0 ... 99 of $P_UIFR.
inline constexpr int kNumSettableFrames = 100;

/// Within a frame an axis is shifted (coarse and fine), then turned, scaled, mirrored.
struct SettableFrame {
  AxisValues coarse{};
  AxisValues fine{};
  std::array<double, 3> turn{};  ///< rad, about X, Y, Z.
  std::array<double, 3> scale{1.0, 1.0, 1.0};
  std::array<bool, 3> mirror{};
  bool stated = true;  ///< False: the shift is assumed.

  AxisValues shift() const;
  /// Rotation, scaling and mirroring.
  Eigen::Matrix3d Linear() const;
};

/// The rotation of ROT X Y Z and of frames, angles in rad: about Z, the new Y, the new X (MD10600 =
/// 1). With one angle there is no order.
Eigen::Matrix3d SinumerikRotation(const std::array<double, 3>& angles);

struct EdgeData {
  double length = 0.0;  ///< $TC_DP3 + $TC_DP12.
  double radius = 0.0;  ///< $TC_DP6 + $TC_DP15.
};

class SinumerikRegisters {
 public:
  SinumerikRegisters(const machine::Machine& machine, const machine::Job& job,
                     const machine::ToolTable& tools);

  static std::string FrameName(int index);
  const SettableFrame& frame(int index) const { return frames_[static_cast<std::size_t>(index)]; }
  SettableFrame* MutableFrame(int index) { return &frames_[static_cast<std::size_t>(index)]; }

  /// Null: the tool has no such edge. D0 is an edge of zeros.
  std::optional<EdgeData> Edge(int tool, int edge) const;
  /// $TC_DPn[tool, edge], mm; 0 where nobody has set it.
  double Parameter(int number, int tool, int edge) const;
  void SetParameter(int number, int tool, int edge, double value);

 private:
  std::array<SettableFrame, kNumSettableFrames> frames_;
  std::map<std::pair<int, int>, std::map<int, double>> edges_;  ///< (tool, edge) -> $TC_DPn.
};

}  // namespace ncsim::control
