// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/haas_settings.h"

#include <cstddef>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/rotary_centre.h"

namespace ncsim::control {
namespace {

// Haas NGC Mill Operator's Manual 2017, setting 85: default .0250 in.
constexpr double kDefaultCornerRounding = 0.025 * kMmPerInch;

// The number after a G at `at`, and that only: G20, G020 and g20 are 20, G200 and G20.1 are not.
int CodeAt(std::string_view text, std::size_t at) {
  std::size_t i = at + 1;
  while (i < text.size() && (text[i] == ' ' || text[i] == '\t' || text[i] == '0')) ++i;
  if (i + 1 >= text.size() || text[i] != '2' || (text[i + 1] != '0' && text[i + 1] != '1'))
    return 0;
  if (i + 2 < text.size() && (IsDigit(text[i + 2]) || text[i + 2] == '.')) return 0;
  return text[i + 1] == '0' ? 20 : 21;
}

class Reader {
 public:
  Reader(const SettingSource& source, RunLog* log) : source_(&source), log_(log) {}

  // True where the text is `yes`; the default, with an assumption, where nobody says.
  bool Choose(int number, std::string_view yes, bool by_default, const std::string& words) {
    const std::string name = "setting " + std::to_string(number);
    if (const auto text = source_->Text(name)) return *text == yes;
    log_->Assume(name, words, false);
    return by_default;
  }
  bool Quiet(std::string_view name, bool by_default) {
    return source_->Switch(name).value_or(by_default);
  }
  double Number(int number, double by_default) {
    return source_->Number("setting " + std::to_string(number)).value_or(by_default);
  }
  std::string Text(std::string_view name) { return source_->Text(name).value_or(""); }

 private:
  const SettingSource* source_;
  RunLog* log_;
};

RapidMode ReadRapidMode(const SettingSource& source, RunLog* log) {
  const auto text = source.Text("setting 335");
  if (!text) {
    log->Assume("setting 335", "NONE: in a rapid each axis runs at its own rate", false);
    return RapidMode::kIndependent;
  }
  if (*text == "linear") return RapidMode::kLinearXyz;
  return *text == "linear+rotary" ? RapidMode::kLinearRotary : RapidMode::kIndependent;
}

// Each of settings 255-257 alone may be stated; the others are the model's.
std::optional<Eigen::Vector3d> ReadCentre(const SettingSource& source,
                                          const machine::Machine& machine) {
  std::optional<Eigen::Vector3d> centre = machine.control.rotary_centre;
  for (int i = 0; i < 3; ++i) {
    const auto value = source.Number("setting " + std::to_string(255 + i));
    if (!value) continue;
    if (!centre) centre = machine::RotaryCentre(machine);
    if (!centre) return std::nullopt;
    (*centre)[i] = *value;
  }
  return centre;
}

int ReadShiftDirection(const std::string& text) {
  if (text == "x-") return 1;
  if (text == "y+") return 2;
  return text == "y-" ? 3 : 0;
}

// Settings 34 and 79 belong to the fourth and the fifth axis: the rotary ones in the order A, B, C.
std::array<double, 3> ReadDiameters(const machine::Machine& machine, Reader* reader) {
  std::array<double, 3> diameters{};
  int setting = 34;
  for (std::size_t i = 0; i < 3; ++i) {
    if (machine.FindAxis("ABC"[i]) == nullptr) continue;
    diameters[i] = reader->Number(setting, 0.0);
    setting = 79;
  }
  return diameters;
}

// Settings that move metal elsewhere and are not simulated: said where they are not neutral.
void ReportUnsupported(const SettingSource& source, RunLog* log) {
  constexpr std::array<int, 13> kSettings = {45,  46,  47,  48,  80,  250, 254,
                                             300, 301, 302, 303, 304, 305};
  for (const int number : kSettings) {
    const std::string name = "setting " + std::to_string(number);
    const auto text = source.Text(name);
    if (!text || *text == "off" || source.Number(name).value_or(1.0) == 0.0) continue;
    log->Report(Rule::kUnsupportedCode, {}, name + " = " + *text + " is not simulated");
  }
}

}  // namespace

int FirstUnitCode(std::string_view text) {
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(') comment = true;
    if (c == ')' || c == '\n' || c == '\r') comment = false;
    if (comment || (c != 'G' && c != 'g')) continue;
    if (const int code = CodeAt(text, i)) return code;
  }
  return 0;
}

HaasSettings ReadHaasSettings(const SettingSource& source, const machine::Machine& machine,
                              const nc::Program& program, RunLog* log) {
  Reader reader(source, log);
  HaasSettings settings;
  const int code = FirstUnitCode(program.text());
  const std::string unit = code == 21 ? "mm" : "inch";
  settings.inch =
      reader.Choose(9, "inch", code != 21,
                    unit + (code == 0 ? ": the control's default"
                                      : ": the program's first G" + std::to_string(code)));
  settings.h_t_agreement =
      reader.Choose(15, "on", true, "ON: H must be the number of the tool in the spindle");
  settings.integer_feed = reader.Choose(77, "integer", true, "INTEGER: F10 is 10 per minute");
  settings.quick_rotary_home =
      reader.Choose(108, "on", false, "OFF: G28 unwinds every turn of a rotary axis");
  settings.default_float = reader.Choose(
      162, "on", false, "OFF: a word without a decimal point counts the smallest increments");
  settings.rapid = ReadRapidMode(source, log);

  settings.cycle_without_xy = reader.Quiet("setting 28", true);
  settings.g91_non_modal = reader.Quiet("setting 29", false);
  settings.rotary_diameter = ReadDiameters(machine, &reader);
  settings.diameter_d = reader.Text("setting 40") != "radius";
  settings.g68_angle = Radians(reader.Number(72, 0.0));
  settings.g68_incremental = reader.Quiet("setting 73", false);
  settings.corner_rounding = reader.Number(85, kDefaultCornerRounding);
  if (!source.Number("setting 85")) {
    log->Assume(
        "setting 85",
        "0.0250 in (0.635 mm): holder, shank and machine must clear by this in feeds; how far "
        "the flutes round a corner of the part is not checked",
        false);
  }
  settings.tool_change_together = reader.Quiet("setting 247", false);
  settings.rotary_centre = ReadCentre(source, machine);
  for (std::size_t i = 0; i < settings.tool_change_mid.size(); ++i) {
    settings.tool_change_mid[i] = source.Number("setting " + std::to_string(293 + i));
    if (i >= kA && settings.tool_change_mid[i]) *settings.tool_change_mid[i] *= kPi / 180.0;
  }
  const auto tcp_rapid = source.Text("tcp_rapid");
  settings.track_tcp_rapids = tcp_rapid.value_or(machine.control.tcp_rapid) == "track";
  settings.block_skip = reader.Quiet("block_skip", false);
  settings.optional_stop = reader.Quiet("optional_stop", false);
  settings.cycles.setting22 = reader.Number(22, 0.0);
  settings.cycles.setting52 = reader.Number(52, 0.0);
  settings.cycles.setting27 = ReadShiftDirection(reader.Text("setting 27"));
  settings.contour.type_b = reader.Text("setting 43") == "b";
  settings.contour.fanuc_corners = reader.Text("setting 58") != "yasnac";
  settings.contour.least_arc_feed = reader.Number(44, 100.0) / 100.0;
  ReportUnsupported(source, log);
  return settings;
}

}  // namespace ncsim::control
