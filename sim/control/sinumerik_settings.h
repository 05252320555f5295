// SPDX-License-Identifier: BSD-3-Clause
// Machine and setting data of a SINUMERIK 840D sl that a simulation needs, typed (by their numbers
// as in the List Manual, detailed machine data). From the job, else the model, else the standard
// value.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sim/base/units.h"
#include "sim/control/command.h"
#include "sim/control/run_log.h"
#include "sim/control/setting_source.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"

namespace ncsim::control {

inline constexpr int kNumFixedPoints = 4;

/// What CYCLE800 reads, by the names in model and job.
inline constexpr std::string_view kSwivelMask = "SD55221", kSwivelReference = "swivel_reference";
inline constexpr std::array<std::string_view, 3> kSwivelRetract = {"TC_CARR38", "TC_CARR39",
                                                                   "TC_CARR40"};

struct SinumerikSettings {
  /// A, B, C.
  struct RotaryAxis {
    bool modulo = false;    ///< MD30310.
    bool shortest = false;  ///< MD30455 bit 2: a plain position goes the shortest way.
    bool folds = false;     ///< MD30455 bit 0: positions beyond 0..360 are allowed.
  };
  std::array<RotaryAxis, 3> rotary{};
  std::map<int, std::string> start_codes;  ///< MD20150, by G group.
  bool rpy = true;                         ///< MD10600 = 1.
  std::optional<bool> fine_shift;          ///< MD24000: ATRANS makes a shift of its own.
  bool frame_keeps_translations = false;   ///< MD10602 = 1.
  bool frame_stays = false;                ///< MD10602 = 2.
  int suppress_length = 0;                 ///< MD10760.
  int edge_after_change = 1;               ///< MD20270.
  double circle_error = 0.01;              ///< MD21000, mm.
  double circle_error_factor = 0.001;      ///< MD21010.
  bool orientation_euler = true;           ///< MD21100.
  bool orientation_by_g50 = false;         ///< MD21102, MD21103: group 50 decides on A2, B2, C2.
  bool orientation_by_g51 = true;          ///< MD21104: group 51 decides on the path, not group 25.
  int pole_mode = 0;                       ///< MD21108.
  double pole_limit = 2.0 * kPi / 180.0;   ///< MD24540, rad: about the pole, what MD21108 is for.
  bool pole_stated = false;                ///< Whether anybody states MD21108.
  int leaning_mode = 0;                    ///< MD21094.
  int limit_mode = 0;                      ///< MD21180.
  bool limit_mode_stated = false;          ///< Not only by a nominal model.
  /// SD5544n by the units of CYCLE832's type, where anybody states them: deg for each mm.
  std::array<std::optional<double>, 5> tolerance_factors{};
  bool m6_changes = true;               ///< MD22550.
  bool incremental_frame = true;        ///< SD42440: G91 goes a new frame's shift too.
  bool incremental_tool = true;         ///< SD42442: likewise a new tool's length.
  int length_plane = 0;                 ///< SD42940: whose plane's axis length 1 counts along.
  std::optional<unsigned> swivel_mask;  ///< SD55221.
  int swivel_reference = 0;             ///< Rotary axis that _DIR refers to, 1 or 2; 0: unstated.
  std::array<std::optional<double>, 3> swivel_retract;  ///< $TC_CARR38 to 40: X, Y, Z; mm.
  /// Of the three above, those that only a nominal model states: assumptions of programs that use
  /// them, by name.
  std::map<std::string, std::string> swivel_nominal;
  /// MD30600: machine values of each axis; mm, rad.
  std::array<std::array<std::optional<double>, kNumAxes>, kNumFixedPoints> fixed_points{};
  unsigned skip_levels = 0;  ///< Bit n: `/n` is left out.
  bool optional_stop = false;
};

/// Reads what job and model state; those that the model calls nominal and the job does not state
/// become assumptions.
SinumerikSettings ReadSinumerikSettings(const SettingSource& source,
                                        const machine::Machine& machine, const machine::Job& job,
                                        RunLog* log);

}  // namespace ncsim::control
