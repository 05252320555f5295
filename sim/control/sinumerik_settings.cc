// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_settings.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sim/base/units.h"

namespace ncsim::control {
namespace {

struct Meaning {
  std::string_view name;
  std::string_view text;
};
constexpr std::array<Meaning, 13> kMeanings = {{
    {"MD10602", "what TRAORI and TRAFOOF do to the active frame (0: cancelled)"},
    {"MD10760", "whether G53, G153 and SUPA also suppress the tool length (0: no)"},
    {"MD20150[7]", "the work offset at the start"},
    {"MD20150[9]", "exact stop or continuous path at the start"},
    {"MD20270", "the edge after a tool change (1: D1)"},
    {"MD21104", "what leads the orientation (1: ORIAXES or ORIVECT, 0: ORIMKS or ORIWKS)"},
    {"MD21180", "a rotary axis that would leave its limits (0: alarm 10720)"},
    {"MD30455[C]", "how C goes to a position (bit 2 = 0: within 0 to 360, = 1: the shortest way)"},
    {kSwivelMask, "CYCLE800 at the pole (bit 13: _DIR = -1 turns the last table 180 degrees more)"},
    {kSwivelReference, "the rotary axis, 1 or 2, whose angle _DIR of CYCLE800 compares"},
    {kSwivelRetract[0], "the machine value of X where CYCLE800 retracts to"},
    {kSwivelRetract[1], "the machine value of Y where CYCLE800 retracts to"},
    {kSwivelRetract[2], "the machine value of Z where CYCLE800 retracts to"},
}};

std::string MeaningOf(const std::string& name) {
  for (const Meaning& meaning : kMeanings) {
    if (meaning.name == name) return ": " + std::string(meaning.text);
  }
  return "";
}

bool IsOfSwivel(std::string_view name) {
  return name == kSwivelMask || name == kSwivelReference ||
         std::find(kSwivelRetract.begin(), kSwivelRetract.end(), name) != kSwivelRetract.end();
}

int Whole(const SettingSource& source, const std::string& name, int standard) {
  const auto value = source.Number(name);
  return value ? static_cast<int>(std::lround(*value)) : standard;
}

/// By the job, or by a model that does not call it nominal.
bool IsStated(const std::string& name, const SettingSource& source, const machine::Machine& machine,
              const machine::Job& job) {
  const auto& nominal = machine.control.nominal_settings;
  const bool read = std::find(nominal.begin(), nominal.end(), name) == nominal.end();
  return job.control.count(name) != 0 || (read && source.Text(name).has_value());
}

void ReadRotary(const SettingSource& source, SinumerikSettings* settings) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string index = std::string("[") + "ABC"[i] + "]";
    SinumerikSettings::RotaryAxis& axis = settings->rotary[i];
    const auto mask = static_cast<unsigned>(Whole(source, "MD30455" + index, 0));
    axis.modulo = Whole(source, "MD30310" + index, 0) == 1;
    axis.folds = (mask & 1U) != 0;
    axis.shortest = (mask & 4U) != 0;
  }
}

void ReadFixedPoints(const SettingSource& source, SinumerikSettings* settings) {
  for (std::size_t point = 0; point < kNumFixedPoints; ++point) {
    for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
      const std::string name = "MD30600[" + std::to_string(point) + "," + "XYZABC"[axis] + "]";
      const auto value = source.Number(name);
      if (value) settings->fixed_points[point][axis] = axis < kA ? *value : Radians(*value);
    }
  }
}

void ReadOrientation(const SettingSource& source, const machine::Machine& machine,
                     const machine::Job& job, SinumerikSettings* settings) {
  settings->orientation_euler = Whole(source, "MD21100", 1) == 1;
  settings->orientation_by_g50 =
      Whole(source, "MD21102", 0) == 1 || Whole(source, "MD21103", 0) == 1;
  settings->orientation_by_g51 = Whole(source, "MD21104", 0) == 1;
  settings->leaning_mode = Whole(source, "MD21094", 0);
  settings->pole_mode = Whole(source, "MD21108", 0);
  settings->pole_stated = source.Text("MD21108").has_value();
  if (const auto limit = source.Number("MD24540")) settings->pole_limit = Radians(*limit);
  settings->limit_mode = Whole(source, "MD21180", 0);
  settings->limit_mode_stated = IsStated("MD21180", source, machine, job);
  settings->tolerance_factors = {std::nullopt, source.Number("SD55443"), source.Number("SD55442"),
                                 source.Number("SD55441"), source.Number("SD55444")};
}

}  // namespace

SinumerikSettings ReadSinumerikSettings(const SettingSource& source,
                                        const machine::Machine& machine, const machine::Job& job,
                                        RunLog* log) {
  SinumerikSettings settings;
  for (const std::string& name : machine.control.nominal_settings) {
    if (job.control.count(name) != 0) continue;
    const std::string text = source.Text(name).value_or("?") + MeaningOf(name);
    if (IsOfSwivel(name)) {
      settings.swivel_nominal[name] = text;
    } else {
      log->Assume(name, text, false);
    }
  }
  constexpr int kGroups = 64;
  for (int group = 1; group <= kGroups; ++group) {
    const auto code = source.Text("MD20150[" + std::to_string(group - 1) + "]");
    if (code) settings.start_codes[group] = *code;
  }
  if (Whole(source, "MD20730", 1) == 0 && job.control.count("MD20150[54]") == 0) {
    settings.start_codes[55] = "RTLIOF";
  }
  ReadRotary(source, &settings);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = std::string("MD30330[") + "ABC"[i] + "]";
    constexpr double kTurn = 360.0;
    if (settings.rotary[i].modulo && source.Number(name).value_or(kTurn) != kTurn) {
      log->Assume(name, "taken as 360: another modulo range is not simulated", true);
    }
  }
  ReadFixedPoints(source, &settings);
  const int frame_mode = Whole(source, "MD10602", 0);
  settings.rpy = Whole(source, "MD10600", 1) == 1;
  settings.frame_keeps_translations = frame_mode == 1;
  settings.frame_stays = frame_mode == 2;
  if (const auto apart = source.Number("MD24000")) settings.fine_shift = *apart == 1.0;
  settings.suppress_length = Whole(source, "MD10760", 0);
  settings.edge_after_change = Whole(source, "MD20270", 1);
  settings.circle_error = source.Number("MD21000").value_or(settings.circle_error);
  settings.circle_error_factor = source.Number("MD21010").value_or(settings.circle_error_factor);
  ReadOrientation(source, machine, job, &settings);
  settings.m6_changes = Whole(source, "MD22550", 1) == 1;
  settings.incremental_frame = Whole(source, "SD42440", 1) == 1;
  settings.incremental_tool = Whole(source, "SD42442", 1) == 1;
  settings.length_plane = Whole(source, "SD42940", 0);
  if (const auto mask = source.Number(std::string(kSwivelMask))) {
    settings.swivel_mask = static_cast<unsigned>(std::lround(*mask));
  }
  settings.swivel_reference = Whole(source, std::string(kSwivelReference), 0);
  for (std::size_t i = 0; i < 3; ++i) {
    settings.swivel_retract[i] = source.Number(std::string(kSwivelRetract.at(i)));
  }
  settings.optional_stop = source.Switch("optional_stop").value_or(false);
  if (source.Switch("block_skip").value_or(false)) settings.skip_levels |= 1U;
  for (unsigned level = 1; level <= 9; ++level) {
    if (source.Switch("block_skip " + std::to_string(level)).value_or(false)) {
      settings.skip_levels |= 1U << level;
    }
  }
  return settings;
}

}  // namespace ncsim::control
