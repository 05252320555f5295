// SPDX-License-Identifier: BSD-3-Clause
// Settings of a Haas NGC mill that a simulation needs, typed (Haas NGC Mill Operator's Manual 2017,
// "Settings"). From the job, else the model, else a default that is printed as an assumption.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "sim/control/contour.h"
#include "sim/control/cycles.h"
#include "sim/control/rapid.h"
#include "sim/control/run_log.h"
#include "sim/control/setting_source.h"
#include "sim/machine/machine.h"
#include "sim/nc/program.h"

namespace ncsim::control {

struct HaasSettings {
  bool inch = true;                              ///< 9.
  bool h_t_agreement = true;                     ///< 15.
  bool cycle_without_xy = true;                  ///< 28: the defining block fires without X or Y.
  bool g91_non_modal = false;                    ///< 29.
  std::array<double, 3> rotary_diameter{};       ///< 34, 79: mm for A, B, C; 0 = not stated.
  bool diameter_d = true;                        ///< 40: D registers are diameters.
  double g68_angle = 0.0;                        ///< 72, rad.
  bool g68_incremental = false;                  ///< 73.
  bool integer_feed = true;                      ///< 77: F10 = 10.
  double corner_rounding = 0.0;                  ///< 85, mm.
  bool quick_rotary_home = false;                ///< 108.
  bool default_float = false;                    ///< 162: X2 = 2.
  bool tool_change_together = false;             ///< 247: Z, X and Y at the same time.
  std::optional<Eigen::Vector3d> rotary_centre;  ///< 255-257, mm.
  std::array<std::optional<double>, 6> tool_change_mid;  ///< 293-298: mm, rad; X Y Z A B C.
  RapidMode rapid = RapidMode::kIndependent;             ///< 335.
  bool track_tcp_rapids = false;                         ///< tcp_rapid = "track".
  bool block_skip = false;
  bool optional_stop = false;
  CycleSettings cycles;    ///< 22, 27, 52.
  ContourOptions contour;  ///< 43, 44, 58.
  double mm_per_unit() const { return inch ? 25.4 : 1.0; }
  /// Smallest increment: .0001 in, .001 mm.
  double increments_per_unit() const { return inch ? 1e4 : 1e3; }
};

/// Reads what job and model state; the rest are defaults. Those that decide how every program is
/// read (9, 15, 77, 108, 162, 335) are noted in `log` as assumptions at once; others when they
/// matter. `program`: setting 9 follows its first G20 or G21.
HaasSettings ReadHaasSettings(const SettingSource& source, const machine::Machine& machine,
                              const nc::Program& program, RunLog* log);

/// 20 or 21: the first such G code outside comments; 0 where the text has none.
int FirstUnitCode(std::string_view text);

}  // namespace ncsim::control
